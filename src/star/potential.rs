//! The potential form: where the apex of a triangle goes if its rim edge stays and its shape is to have a given value.

use glam::DVec2;

/// Edge ratio of the triangle (0, a, b). A shortest side of length 0 gives infinity.
pub(crate) fn edge_ratio(a: DVec2, b: DVec2) -> f64 {
    let (x, y, z) = (a.length_squared(), b.length_squared(), (b - a).length_squared());
    let shortest = x.min(y).min(z);
    if shortest > 0.0 { (x.max(y).max(z) / shortest).sqrt() } else { f64::INFINITY }
}

/// Potential center over the rim edge a → b for the modelled value `ideal` ≥ 1; the apex now lies at the origin, and the
/// inner side is to the left of the edge.
///
/// Up to √2 the form is isosceles with both sides of length |ab| / ideal. Beyond, the apex is the right-angled point of
/// the semicircle over the edge whose short side has that length, on the side to which the present apex is nearer. Both
/// meet at half the edge's length above its middle.
pub(crate) fn center(a: DVec2, b: DVec2, ideal: f64) -> DVec2 {
    let edge = b - a;
    let inward = edge.perp();
    let side = 1.0 / (ideal * ideal);
    if side >= 0.5 {
        (a + b) * 0.5 + inward * (side - 0.25).sqrt()
    } else {
        let foot = if a.length_squared() < b.length_squared() { a + edge * side } else { b - edge * side };
        foot + inward * (side * (1.0 - side)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: DVec2 = DVec2::new(1.0, -1.0);
    const B: DVec2 = DVec2::new(2.0, 1.0);

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
    }
}
