//! The positions that sweeps work on: read by every thread, written only for vertices whose neighbours nobody writes.

use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

use glam::DVec3;

use crate::error::Error;
use crate::mesh::{Positions, Stars};
use crate::star::{LocalStars, Number};
use crate::threads::Threads;

/// Where the vertices are, in the precision of the caller's buffer. Plain loads and stores on every machine of today, and no data
/// race whatever the order of the visits; that no visit sees a half-written position is up to that order.
pub(crate) enum Places {
    Single(Vec<[AtomicU32; 3]>),
    Double(Vec<[AtomicU64; 3]>),
}

impl Places {
    /// A copy of `positions`.
    pub fn new(positions: &Positions, threads: &Threads<'_>) -> Result<Self, Error> {
        Ok(match positions {
            Positions::Single(all) => {
                Self::Single(threads.collect(all.len(), |v| all[v].map(|x| AtomicU32::new(x.to_bits())))?)
            }
            Positions::Double(all) => {
                Self::Double(threads.collect(all.len(), |v| all[v].map(|x| AtomicU64::new(x.to_bits())))?)
            }
        })
    }

    /// Position of vertex `v`.
    #[inline(always)]
    pub fn get(&self, v: u32) -> DVec3 {
        match self {
            Self::Single(places) => single(&places[v as usize]),
            Self::Double(places) => double(&places[v as usize]),
        }
    }

    /// Looks up where the vertices of stars are: nothing is relative to the centres yet.
    #[inline(always)]
    pub fn gather<N: Number>(&self, stars: &Stars, local: &mut LocalStars<N>, vertices: &N::Vertices) {
        match self {
            Self::Single(places) => {
                let places = &places[..];
                local.gather(stars, |v| single(&places[v as usize]), vertices);
            }
            Self::Double(places) => {
                let places = &places[..];
                local.gather(stars, |v| double(&places[v as usize]), vertices);
            }
        }
    }

    /// Moves vertex `v`. In single precision the position has to be one of that.
    #[inline(always)]
    pub fn set(&self, v: u32, position: DVec3) {
        match self {
            Self::Single(places) => {
                for (place, x) in places[v as usize].iter().zip(position.to_array()) {
                    debug_assert!(f64::from(x as f32) == x, "{x} is none of single precision");
                    place.store((x as f32).to_bits(), Relaxed);
                }
            }
            Self::Double(places) => {
                for (place, x) in places[v as usize].iter().zip(position.to_array()) {
                    place.store(x.to_bits(), Relaxed);
                }
            }
        }
    }

    /// All positions, in the same memory.
    pub fn into_positions(self) -> Positions<'static> {
        match self {
            Self::Single(places) => {
                let position = |place: [AtomicU32; 3]| place.map(|x| f32::from_bits(x.into_inner()));
                Positions::Single(places.into_iter().map(position).collect::<Vec<_>>().into())
            }
            Self::Double(places) => {
                let position = |place: [AtomicU64; 3]| place.map(|x| f64::from_bits(x.into_inner()));
                Positions::Double(places.into_iter().map(position).collect::<Vec<_>>().into())
            }
        }
    }
}

#[inline(always)]
fn single([x, y, z]: &[AtomicU32; 3]) -> DVec3 {
    let load = |x: &AtomicU32| f64::from(f32::from_bits(x.load(Relaxed)));
    DVec3::new(load(x), load(y), load(z))
}

#[inline(always)]
fn double([x, y, z]: &[AtomicU64; 3]) -> DVec3 {
    let load = |x: &AtomicU64| f64::from_bits(x.load(Relaxed));
    DVec3::new(load(x), load(y), load(z))
}
