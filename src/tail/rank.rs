//! Which of two states of a patch is better.

use std::cmp::Ordering;

use super::limits::Limits;
use super::patch::Shape;

/// The excesses above 1 in a patch, worst first.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rank(Vec<f64>);

impl Rank {
    pub fn of(limits: &Limits, shape: &Shape) -> Self {
        let mut tail: Vec<_> = shape.pieces.iter().map(|p| limits.excess(shape.corners(p))).filter(|&x| x > 1.0).collect();
        tail.sort_unstable_by(|a, b| b.total_cmp(a));
        Self(tail)
    }

    /// Less is better: the worst triangle decides, among equals the next.
    pub fn compare(&self, other: &Self) -> Ordering {
        let differing = self.0.iter().zip(&other.0).map(|(a, b)| a.total_cmp(b)).find(|o| o.is_ne());
        differing.unwrap_or_else(|| self.0.len().cmp(&other.0.len()))
    }

    /// Whether this is better than `before` and has fewer triangles in the tail.
    pub fn cures(&self, before: &Self) -> bool {
        self.0.len() < before.0.len() && self.compare(before).is_lt()
    }
}
