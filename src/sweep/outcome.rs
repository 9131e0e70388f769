//! What became of each vertex.

use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

use crate::error::Error;
use crate::threads::Threads;

/// What became of a vertex at its last visit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Outcome {
    /// Never visited, or its role keeps it where it is.
    Unvisited,
    Moved,
    /// Already at its target.
    Settled,
    Degenerate,
    Guard,
    Deviation,
}

impl Outcome {
    const ALL: [Self; 6] =
        [Self::Unvisited, Self::Moved, Self::Settled, Self::Degenerate, Self::Guard, Self::Deviation];
}

/// An outcome for each vertex, noted by whichever thread visits it.
pub(crate) struct Outcomes(Vec<AtomicU8>);

impl Outcomes {
    /// Nothing visited yet.
    pub fn new(vertex_count: usize, threads: &Threads<'_>) -> Result<Self, Error> {
        Ok(Self(threads.collect(vertex_count, |_| AtomicU8::new(Outcome::Unvisited as u8))?))
    }

    #[inline(always)]
    pub fn set(&self, v: u32, outcome: Outcome) {
        self.0[v as usize].store(outcome as u8, Relaxed);
    }

    pub fn get(&self, v: u32) -> Outcome {
        Outcome::ALL[usize::from(self.0[v as usize].load(Relaxed))]
    }
}
