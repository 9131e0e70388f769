//! The edge ratio a, longest over shortest edge: the paper's own parameter, and itself the variable.

use fearless_simd::prelude::*;
use glam::DVec2;

use crate::star::lanes::{self, LANES, Numbers, Truths};

/// Points of a plane, one in each lane.
#[derive(Clone, Copy)]
pub(in crate::star) struct Points<S: Simd> {
    pub x: Numbers<S>,
    pub y: Numbers<S>,
}

impl<S: Simd> Points<S> {
    #[inline(always)]
    pub fn zero(simd: S) -> Self {
        Self { x: Numbers::splat(simd, 0.0), y: Numbers::splat(simd, 0.0) }
    }

    #[inline(always)]
    fn from_arrays(simd: S, [x, y]: &[[f64; LANES]; 2]) -> Self {
        Self { x: Numbers::load_array_ref(simd, x), y: Numbers::load_array_ref(simd, y) }
    }

    #[inline(always)]
    fn store(self, [x, y]: &mut [[f64; LANES]; 2]) {
        self.x.store_array(x);
        self.y.store_array(y);
    }

    #[inline(always)]
    fn square(self) -> Numbers<S> {
        self.x * self.x + self.y * self.y
    }

    #[inline(always)]
    pub fn plus(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }

    /// Sum over the lanes.
    #[inline(always)]
    pub fn sum(self) -> DVec2 {
        DVec2::new(lanes::sum(self.x), lanes::sum(self.y))
    }

    /// Zero where `truths` don't hold.
    #[inline(always)]
    pub fn only(self, simd: S, truths: Truths<S>) -> Self {
        let zero = Self::zero(simd);
        Self { x: truths.select(self.x, zero.x), y: truths.select(self.y, zero.y) }
    }
}

/// Eight triangles with the apex at the origin, projected into their plane.
#[derive(Clone, Copy, Default)]
pub(in crate::star) struct Flat {
    /// Starts of the rim edges.
    a: [[f64; LANES]; 2],
    /// From the starts to the ends.
    edge: [[f64; LANES]; 2],
    /// 1 where the start is nearer to the apex than the end, else 0.
    leans: [f64; LANES],
}

impl Flat {
    /// Takes up the triangles over the rim edges a → b. Returns their edge ratios, longest over shortest edge: infinite if
    /// the shortest has no length.
    #[inline(always)]
    pub fn take<S: Simd>(&mut self, simd: S, a: Points<S>, b: Points<S>) -> Numbers<S> {
        let edge = Points { x: b.x - a.x, y: b.y - a.y };
        let (x, y, z) = (a.square(), b.square(), edge.square());
        let leans = x.simd_lt(y);
        let (near, far) = (leans.select(x, y), leans.select(y, x));
        let shortest = near.simd_lt(z).select(near, z);
        let longest = far.simd_lt(z).select(z, far);
        let (one, none) = (Numbers::splat(simd, 1.0), Numbers::splat(simd, 0.0));
        let ratio = shortest.simd_eq(none).select(Numbers::splat(simd, f64::INFINITY), longest / shortest);
        a.store(&mut self.a);
        edge.store(&mut self.edge);
        leans.select(one, none).store_array(&mut self.leans);
        ratio.sqrt()
    }

    /// Potential centers for the modelled values `ideal` ≥ 1; the inner side is to the left of the edge.
    ///
    /// Up to √2 the form is isosceles with both sides of length |ab| / ideal. Beyond, the apex is the right-angled point
    /// of the semicircle over the edge whose short side has that length, on the side to which the present apex is nearer.
    /// Both meet at half the edge's length above its middle.
    #[inline(always)]
    pub fn center<S: Simd>(&self, simd: S, ideal: Numbers<S>) -> Points<S> {
        let (a, edge) = (Points::from_arrays(simd, &self.a), Points::from_arrays(simd, &self.edge));
        let leans = Numbers::load_array_ref(simd, &self.leans).simd_gt(0.0);
        let one = Numbers::splat(simd, 1.0);
        let side = one / (ideal * ideal);
        let isosceles = side.simd_ge(0.5);
        let foot = isosceles.select(Numbers::splat(simd, 0.5), leans.select(side, one - side));
        let height = isosceles.select(side - 0.25, side * (one - side)).sqrt();
        Points { x: a.x + edge.x * foot - edge.y * height, y: a.y + edge.y * foot + edge.x * height }
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};

    use super::*;

    const A: DVec2 = DVec2::new(1.0, -1.0);
    const B: DVec2 = DVec2::new(2.0, 1.0);

    #[inline(always)]
    fn flat<S: Simd>(simd: S, a: DVec2, b: DVec2) -> (Flat, Numbers<S>) {
        let points = |p: DVec2| Points { x: Numbers::splat(simd, p.x), y: Numbers::splat(simd, p.y) };
        let mut flat = Flat::default();
        let edge_ratio = flat.take(simd, points(a), points(b));
        (flat, edge_ratio)
    }

    fn edge_ratio(a: DVec2, b: DVec2) -> f64 {
        dispatch!(Level::new(), simd => flat(simd, a, b).1[3])
    }

    fn center(a: DVec2, b: DVec2, ideal: f64) -> DVec2 {
        dispatch!(Level::new(), simd => {
            let center = flat(simd, a, b).0.center(simd, Numbers::splat(simd, ideal));
            DVec2::new(center.x[5], center.y[5])
        })
    }

    /// Edge ratio of the potential form.
    fn formed(ideal: f64) -> f64 {
        let c = center(A, B, ideal);
        edge_ratio(A - c, B - c)
    }

    #[test]
    fn the_form_has_the_modelled_edge_ratio() {
        for ideal in [1.0, 1.1, 1.4, std::f64::consts::SQRT_2, 1.5, 2.0, 5.0, 100.0] {
            assert!((formed(ideal) / ideal - 1.0).abs() < 1e-9, "{ideal}: {}", formed(ideal));
        }
    }

    #[test]
    fn both_branches_meet_at_half_the_edge_above_its_middle() {
        let middle = (A + B) * 0.5 + (B - A).perp() * 0.5;
        for ideal in [std::f64::consts::SQRT_2 - 1e-12, std::f64::consts::SQRT_2 + 1e-12] {
            assert!(center(A, B, ideal).distance(middle) < 1e-5);
        }
    }

    #[test]
    fn the_short_side_lies_where_the_apex_is() {
        let c = center(A, B, 4.0);
        assert!(A.length() < B.length() && c.distance(A) < c.distance(B));
        let mirrored = center(-B, -A, 4.0);
        assert!(mirrored.distance(-A) < mirrored.distance(-B));
    }

    #[test]
    fn the_apex_is_to_the_left_of_the_edge() {
        for ideal in [1.0, 1.3, 3.0, 1e6] {
            assert!((B - A).perp_dot(center(A, B, ideal) - A) > 0.0);
        }
    }

    #[test]
    fn a_side_without_length_has_no_finite_ratio() {
        assert_eq!(edge_ratio(DVec2::ZERO, B), f64::INFINITY);
        assert_eq!(edge_ratio(A, A), f64::INFINITY);
        assert_eq!(edge_ratio(DVec2::ZERO, DVec2::ZERO), f64::INFINITY);
    }
}
