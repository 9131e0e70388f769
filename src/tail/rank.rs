//! Which of two states of a patch is better.

use std::cmp::Ordering;

use super::limits::Limits;
use super::patch::{Freedom, Patch, Piece, Shape};

/// The excesses above 1 in a patch, worst first.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rank(Vec<f64>);

impl Rank {
    /// Of all triangles of a shape.
    pub fn of(limits: &Limits, shape: &Shape) -> Self {
        Self::of_pieces(limits, shape, |_| true)
    }

    /// Of the triangles that no move can change: no shape that moves lead to from here is better.
    pub fn of_frozen(limits: &Limits, patch: &Patch, shape: &Shape) -> Self {
        let is_fixed = |v: usize| matches!(patch.freedom[v], Freedom::None(_));
        Self::of_pieces(limits, shape, |p| p.corners.into_iter().all(is_fixed))
    }

    fn of_pieces(limits: &Limits, shape: &Shape, counts: impl Fn(&Piece) -> bool) -> Self {
        let excess = |p: &Piece| limits.excess(shape.corners(p));
        let mut tail: Vec<_> = shape.pieces.iter().filter(|p| counts(p)).map(excess).filter(|&x| x > 1.0).collect();
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
