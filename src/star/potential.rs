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
