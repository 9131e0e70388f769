//! The positions that sweeps work on: read by every thread, written only for vertices whose neighbours nobody writes.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use glam::DVec3;

use crate::error::Error;
use crate::threads::Threads;

/// Where the vertices are. Plain loads and stores on every machine of today, and no data race whatever the order of the
/// visits; that no visit sees a half-written position is up to that order.
pub(crate) struct Places(Vec<[AtomicU64; 3]>);

impl Places {
    /// A copy of `positions`.
    pub fn new(positions: &[DVec3], threads: &Threads<'_>) -> Result<Self, Error> {
        let at = |v: usize| positions[v].to_array().map(|x| AtomicU64::new(x.to_bits()));
        Ok(Self(threads.collect(positions.len(), at)?))
    }

    /// Position of vertex `v`.
    #[inline(always)]
    pub fn get(&self, v: u32) -> DVec3 {
        self.reader()(v)
    }

    /// Tells where a vertex is, without another look at where all places lie.
    #[inline(always)]
    pub fn reader(&self) -> impl Fn(u32) -> DVec3 {
        let places = &self.0[..];
        move |v| {
            let [x, y, z] = &places[v as usize];
            let load = |x: &AtomicU64| f64::from_bits(x.load(Relaxed));
            DVec3::new(load(x), load(y), load(z))
        }
    }

    /// Moves vertex `v`.
    #[inline(always)]
    pub fn set(&self, v: u32, position: DVec3) {
        for (place, x) in self.0[v as usize].iter().zip(position.to_array()) {
            place.store(x.to_bits(), Relaxed);
        }
    }

    /// All positions, in the same memory.
    pub fn into_positions(self) -> Vec<DVec3> {
        self.0.into_iter().map(|p| DVec3::from_array(p.map(|x| f64::from_bits(x.into_inner())))).collect()
    }
}
