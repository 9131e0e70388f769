//! Eight triangles of a star side by side, one in each lane of a vector.
//!
//! Lanes are only ever added, multiplied, divided, rooted and compared with lanes, and summed in one fixed tree, so every
//! instruction set finds the same bits. Nothing here is fused, approximated, or left to how a machine takes the minimum
//! of a NaN.
//!
//! Whatever handles lanes is `inline(always)` and calls nothing that is not, no closure of its own included: only what
//! ends up inside `dispatch!` is compiled for the instruction set that was chosen.

use fearless_simd::prelude::*;
use fearless_simd::{f64x8, mask64x8};
use glam::DVec3;

/// Triangles in a chunk.
pub(crate) const LANES: usize = 8;

/// A number for each triangle of a chunk.
pub(crate) type Numbers<S> = f64x8<S>;

/// A truth for each triangle of a chunk.
pub(crate) type Truths<S> = mask64x8<S>;

/// A vector for each triangle of a chunk.
#[derive(Clone, Copy)]
pub(crate) struct Vectors<S: Simd> {
    pub x: Numbers<S>,
    pub y: Numbers<S>,
    pub z: Numbers<S>,
}

impl<S: Simd> Vectors<S> {
    #[inline(always)]
    pub fn splat(simd: S, v: DVec3) -> Self {
        Self { x: Numbers::splat(simd, v.x), y: Numbers::splat(simd, v.y), z: Numbers::splat(simd, v.z) }
    }

    /// `points[i]` in lane i.
    #[inline(always)]
    pub fn of(simd: S, points: [DVec3; LANES]) -> Self {
        let [p0, p1, p2, p3, p4, p5, p6, p7] = points;
        Self {
            x: Numbers::load_array(simd, [p0.x, p1.x, p2.x, p3.x, p4.x, p5.x, p6.x, p7.x]),
            y: Numbers::load_array(simd, [p0.y, p1.y, p2.y, p3.y, p4.y, p5.y, p6.y, p7.y]),
            z: Numbers::load_array(simd, [p0.z, p1.z, p2.z, p3.z, p4.z, p5.z, p6.z, p7.z]),
        }
    }

    #[inline(always)]
    pub fn from_arrays(simd: S, [x, y, z]: &[[f64; LANES]; 3]) -> Self {
        Self {
            x: Numbers::load_array_ref(simd, x),
            y: Numbers::load_array_ref(simd, y),
            z: Numbers::load_array_ref(simd, z),
        }
    }

    #[inline(always)]
    pub fn store(self, [x, y, z]: &mut [[f64; LANES]; 3]) {
        self.x.store_array(x);
        self.y.store_array(y);
        self.z.store_array(z);
    }

    /// Each lane's next one; `last` behind the last.
    #[inline(always)]
    pub fn next(self, simd: S, last: DVec3) -> Self {
        let last = Self::splat(simd, last);
        Self { x: self.x.slide::<1>(last.x), y: self.y.slide::<1>(last.y), z: self.z.slide::<1>(last.z) }
    }

    #[inline(always)]
    pub fn plus(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }

    #[inline(always)]
    pub fn minus(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }

    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> Numbers<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub fn square(self) -> Numbers<S> {
        self.dot(self)
    }

    /// `self` where `truths` hold, else `other`.
    #[inline(always)]
    pub fn or(self, truths: Truths<S>, other: Self) -> Self {
        Self { x: truths.select(self.x, other.x), y: truths.select(self.y, other.y), z: truths.select(self.z, other.z) }
    }

    /// Sum over the lanes.
    #[inline(always)]
    pub fn sum(self) -> DVec3 {
        DVec3::new(sum(self.x), sum(self.y), sum(self.z))
    }
}

/// Sum over the lanes: halves, then quarters, then the last two.
#[inline(always)]
pub(crate) fn sum<S: Simd>(numbers: Numbers<S>) -> f64 {
    let (low, high) = numbers.split();
    let (low, high) = (low + high).split();
    let pair = low + high;
    pair[0] + pair[1]
}

/// The least of the lanes, none of which is NaN.
#[inline(always)]
pub(crate) fn least<S: Simd>(numbers: Numbers<S>) -> f64 {
    let (low, high) = numbers.split();
    let (low, high) = low.simd_lt(high).select(low, high).split();
    let pair = low.simd_lt(high).select(low, high);
    if pair[0] < pair[1] { pair[0] } else { pair[1] }
}

/// Holds for the triangles of chunk `chunk` whose number is below `count`.
#[inline(always)]
pub(crate) fn below<S: Simd>(simd: S, chunk: usize, count: usize) -> Truths<S> {
    const NUMBERS: [f64; LANES] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
    let bound = count as f64 - (chunk * LANES) as f64;
    Numbers::load_array(simd, NUMBERS).simd_lt(bound)
}
