//! The caller's buffer of positions, wherever it lies.

use super::Coordinate;
use crate::threads::{PART, Threads};

/// Positions that are read vertex by vertex, and at the end written where they have changed.
pub(crate) trait Vertices<T: Coordinate>: Sync {
    /// How many vertices there are.
    fn count(&self) -> usize;

    /// Position of vertex `v`.
    fn get(&self, v: usize) -> [T; 3];

    /// The position that comes as number `place` in memory, for those who look at all of them in any order.
    fn at(&self, place: usize) -> [T; 3] {
        self.get(place)
    }

    /// All positions, if they lie in memory one after the other.
    fn as_slice(&self) -> Option<&[[T; 3]]> {
        None
    }

    /// Writes the position of each vertex that `changed` has one for, knowing its number and where it has been.
    fn set(&mut self, changed: impl Fn(usize, [T; 3]) -> Option<[T; 3]> + Sync, threads: &Threads<'_>);
}

impl<T: Coordinate> Vertices<T> for [[T; 3]] {
    fn count(&self) -> usize {
        self.len()
    }

    fn get(&self, v: usize) -> [T; 3] {
        self[v]
    }

    fn as_slice(&self) -> Option<&[[T; 3]]> {
        Some(self)
    }

    fn set(&mut self, changed: impl Fn(usize, [T; 3]) -> Option<[T; 3]> + Sync, threads: &Threads<'_>) {
        threads.each(self.chunks_mut(PART).enumerate().collect(), |(part, positions)| {
            for (v, stored) in (part * PART..).zip(positions) {
                if let Some(new) = changed(v, *stored) {
                    *stored = new;
                }
            }
        });
    }
}
