//! Normal and shape of a triangle of each star.

use super::number::Arithmetic;
use super::vectors::Vectors;

/// Original shape below which a triangle's normal says nothing: comparing with it would freeze exactly those triangles
/// that need to move.
pub(crate) const MEANINGLESS: f64 = 1e-3;

/// Original shape below which a triangle's own normal is not believed, nor its plane worth keeping.
pub(crate) const THIN: f64 = 0.3;

/// Largest angle in degrees by which a triangle's normal may turn against its original one.
pub(crate) const LARGEST_TURN: f64 = 75.0;

/// Shape from which on single precision tells where a triangle faces.
pub(crate) const CLEAR: f64 = 0.005;

/// What is computed in single precision keeps its digits while fourth powers of lengths are within these bounds.
pub(super) const TINY: f64 = 1e-30;
const HUGE: f64 = 1e30;

/// Triangles with the apex at the origin. Shapes are compared by their squares, which saves the square roots.
pub(crate) struct Witness<N> {
    /// Twice as long as the areas.
    pub normal: Vectors<N>,
    /// The squares of the normals.
    pub square: N,
    /// The squared sums of the squared edges: the squared mean-ratio shape is twelve squares over this.
    bulk: N,
}

/// A rim vertex relative to the centre, and its squared distance from it: two triangles share it.
#[derive(Clone, Copy)]
pub(crate) struct Arm<N> {
    pub end: Vectors<N>,
    pub square: N,
}

impl<N: Arithmetic> Arm<N> {
    #[inline(always)]
    pub fn new(end: Vectors<N>) -> Self {
        Self { end, square: end.square() }
    }
}

impl<N: Arithmetic> Witness<N> {
    /// The triangles (0, a, b).
    #[inline(always)]
    pub fn new(a: Arm<N>, b: Arm<N>) -> Self {
        let normal = a.end.cross(b.end);
        let sum = a.square + b.square + b.end.minus(a.end).square();
        Self { normal, square: normal.square(), bulk: sum * sum }
    }

    #[inline(always)]
    fn area(&self, token: N::Token) -> N {
        self.square * N::splat(token, 12.0)
    }

    /// Squared shapes; 0 for a triangle without edges.
    #[inline(always)]
    pub fn squared_shape(&self, token: N::Token) -> N {
        let zero = N::splat(token, 0.0);
        N::choose(zero.below(self.bulk), self.area(token) / self.bulk, zero)
    }

    /// Where the shape is above a bound.
    #[inline(always)]
    pub fn exceeds(&self, token: N::Token, shape: f64) -> N::Truth {
        self.surpasses(token, N::splat(token, shape * shape))
    }

    /// Where the squared shape is above `bar`.
    #[inline(always)]
    pub fn surpasses(&self, token: N::Token, bar: N) -> N::Truth {
        (self.bulk * bar).below(self.area(token))
    }

    /// Where the triangle is neither too small nor too large for single precision.
    #[inline(always)]
    pub fn is_measurable(&self, token: N::Token) -> N::Truth {
        N::splat(token, TINY).below(self.bulk) & self.bulk.below(N::splat(token, HUGE))
    }

    /// Where the squared shape is not below `bar`.
    #[inline(always)]
    pub fn reaches(&self, token: N::Token, bar: N) -> N::Truth {
        let has_edges = N::splat(token, 0.0).below(self.bulk);
        (self.bulk * bar).at_most(self.area(token)) & (has_edges | bar.at_most(self.bulk))
    }

    /// Where the triangle turns against the direction `outward`.
    #[inline(always)]
    pub fn opposes(&self, token: N::Token, outward: Vectors<N>) -> N::Truth {
        self.normal.dot(outward).below(N::splat(token, 0.0))
    }

    /// Where a triangle that opposes is not folded, or not in better shape folded than `before`.
    #[inline(always)]
    pub fn unfolds(&self, token: N::Token, before: &Self, outward: Vectors<N>) -> N::Truth {
        let had = before.opposes(token, outward) & self.squared_shape(token).at_most(before.squared_shape(token));
        !self.opposes(token, outward) | had | self.square.equals(N::splat(token, 0.0))
    }
}
