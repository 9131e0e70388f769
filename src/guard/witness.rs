//! What the guard knows of the shapes of a chunk of triangles.

use fearless_simd::prelude::*;

use crate::star::{Numbers, Truths, Vectors, least};

/// Triangles with the apex at the origin. Shapes are compared by their squares, which saves the square roots.
pub(super) struct Witness<S: Simd> {
    /// Twice as long as the areas.
    pub normal: Vectors<S>,
    /// Twelve times the squares of the normals: the squared mean-ratio shape is this over `bulk`.
    area: Numbers<S>,
    /// The squared sum of the squared edges.
    bulk: Numbers<S>,
}

impl<S: Simd> Witness<S> {
    /// The triangles (0, a, b).
    #[inline(always)]
    pub fn new(a: Vectors<S>, b: Vectors<S>) -> Self {
        let normal = a.cross(b);
        let sum = a.square() + b.square() + b.minus(a).square();
        Self { normal, area: normal.square() * 12.0, bulk: sum * sum }
    }

    /// Squared shapes; 0 for a triangle without edges.
    #[inline(always)]
    fn squared_shape(&self, simd: S) -> Numbers<S> {
        self.bulk.simd_gt(0.0).select(self.area / self.bulk, Numbers::splat(simd, 0.0))
    }

    /// The least squared shape of those that are `present`.
    #[inline(always)]
    pub fn least(&self, simd: S, present: Truths<S>) -> f64 {
        least(present.select(self.squared_shape(simd), Numbers::splat(simd, f64::INFINITY)))
    }

    /// Where the shape is above a bound.
    #[inline(always)]
    pub fn exceeds(&self, shape: f64) -> Truths<S> {
        self.area.simd_gt(self.bulk * (shape * shape))
    }

    /// Where the squared shape is not below `bar`.
    #[inline(always)]
    pub fn reaches(&self, bar: f64) -> Truths<S> {
        self.area.simd_ge(self.bulk * bar) & (self.bulk.simd_gt(0.0) | self.bulk.simd_ge(bar))
    }

    /// Where the triangles turn against the directions `outward`.
    #[inline(always)]
    pub fn oppose(&self, outward: Vectors<S>) -> Truths<S> {
        self.normal.dot(outward).simd_lt(0.0)
    }

    /// Where triangles that oppose are not folded, or not in better shape folded than `before`.
    #[inline(always)]
    pub fn unfolds(&self, simd: S, before: &Self, outward: Vectors<S>) -> Truths<S> {
        let had = before.oppose(outward) & before.squared_shape(simd).simd_ge(self.squared_shape(simd));
        !self.oppose(outward) | had | self.area.simd_eq(0.0)
    }
}
