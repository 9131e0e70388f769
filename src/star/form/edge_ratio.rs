//! The edge ratio a, longest over shortest edge: the paper's own parameter, and itself the variable.

use crate::star::number::Number;
use crate::star::vectors::Points;

/// A triangle of each star with the apex at the origin, projected into its plane.
pub(in crate::star) struct Flat<N: Number> {
    /// Start of the rim edge.
    a: [N::Row; 2],
    /// From the start to the end.
    edge: [N::Row; 2],
    /// 1 where the start is nearer to the apex than the end, else 0.
    leans: N::Row,
}

impl<N: Number> Default for Flat<N> {
    fn default() -> Self {
        let row = N::Row::default();
        Self { a: [row; 2], edge: [row; 2], leans: row }
    }
}

impl<N: Number> Flat<N> {
    /// Takes up the triangles over the rim edges a → b, whose ends have these squares. Returns their edge ratios, longest over shortest edge: infinite if
    /// the shortest has no length.
    #[inline(always)]
    pub fn take(&mut self, token: N::Token, [a, b]: [Points<N>; 2], [x, y]: [N; 2]) -> N {
        let edge = b.minus(a);
        let z = edge.square();
        let leans = x.below(y);
        let (near, far) = (N::choose(leans, x, y), N::choose(leans, y, x));
        let shortest = N::choose(near.below(z), near, z);
        let longest = N::choose(far.below(z), z, far);
        let (one, none) = (N::splat(token, 1.0), N::splat(token, 0.0));
        let ratio = N::choose(shortest.equals(none), N::splat(token, f64::INFINITY), longest / shortest);
        a.store(&mut self.a);
        edge.store(&mut self.edge);
        one.only(token, leans).store(&mut self.leans);
        ratio.root()
    }

    /// Potential centers for a form; the inner side is to the left of the edge.
    #[inline(always)]
    pub fn center(&self, token: N::Token, form: Proportions<N>) -> Points<N> {
        let (a, edge) = (Points::<N>::load(token, &self.a), Points::<N>::load(token, &self.edge));
        let leans = N::splat(token, 0.0).below(N::load(token, &self.leans));
        let foot = N::choose(leans, form.foot, N::splat(token, 1.0) - form.foot);
        Points { x: a.x + edge.x * foot - edge.y * form.height, y: a.y + edge.y * foot + edge.x * form.height }
    }
}

/// Where the apex of a potential form is over its edge, in units of the edge's length, if the apex is to lean to the start.
#[derive(Clone, Copy)]
pub(in crate::star) struct Proportions<N> {
    foot: N,
    height: N,
}

/// The same in memory.
#[derive(Clone, Copy)]
pub(in crate::star) struct ProportionRows<N: Number> {
    foot: N::Row,
    height: N::Row,
}

impl<N: Number> Default for ProportionRows<N> {
    fn default() -> Self {
        Self { foot: N::Row::default(), height: N::Row::default() }
    }
}

impl<N: Number> Proportions<N> {
    /// From memory.
    #[inline(always)]
    pub fn load(token: N::Token, rows: &ProportionRows<N>) -> Self {
        Self { foot: N::load(token, &rows.foot), height: N::load(token, &rows.height) }
    }

    /// Into memory.
    #[inline(always)]
    pub fn store(self, rows: &mut ProportionRows<N>) {
        self.foot.store(&mut rows.foot);
        self.height.store(&mut rows.height);
    }

    /// For the modelled values `ideal` ≥ 1.
    ///
    /// Up to √2 the form is isosceles with both sides of length |ab| / ideal. Beyond, the apex is the right-angled point
    /// of the semicircle over the edge whose short side has that length, on the side to which the present apex is nearer.
    /// Both meet at half the edge's length above its middle.
    #[inline(always)]
    pub fn of(token: N::Token, ideal: N) -> Self {
        let (one, half) = (N::splat(token, 1.0), N::splat(token, 0.5));
        let side = one / (ideal * ideal);
        let isosceles = half.at_most(side);
        let foot = N::choose(isosceles, half, side);
        let height = N::choose(isosceles, side - N::splat(token, 0.25), side * (one - side)).root();
        Self { foot, height }
    }

    /// `yes` where `truth` holds, else `no`.
    #[inline(always)]
    pub fn choose(truth: N::Truth, yes: Self, no: Self) -> Self {
        Self { foot: N::choose(truth, yes.foot, no.foot), height: N::choose(truth, yes.height, no.height) }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;

    const A: DVec2 = DVec2::new(1.0, -1.0);
    const B: DVec2 = DVec2::new(2.0, 1.0);

    fn flat(a: DVec2, b: DVec2) -> (Flat<f64>, f64) {
        let mut flat = Flat::default();
        let edge_ratio = flat.take((), [a.into(), b.into()], [a.length_squared(), b.length_squared()]);
        (flat, edge_ratio)
    }

    fn edge_ratio(a: DVec2, b: DVec2) -> f64 {
        flat(a, b).1
    }

    fn center(a: DVec2, b: DVec2, ideal: f64) -> DVec2 {
        let Points { x, y } = flat(a, b).0.center((), Proportions::of((), ideal));
        DVec2::new(x, y)
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
