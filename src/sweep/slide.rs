//! Sliding: how a vertex of a crease or of the boundary moves along it.

use glam::DVec3;

use crate::star::{LocalStar, double_vector_area};

/// Sine of the angle within which the triangles of a sector are in one plane.
const FLAT: f64 = 1e-3;

/// Sine of the angle between two sectors from which on their planes define a line.
const MEETING: f64 = 0.1;

/// The part of `target` that leads along the feature line through the centre of the star, at most half way to the next
/// vertex on it.
///
/// On a crease the direction is orthogonal to the ring's vector area, so that the slide owes no volume: nothing
/// beside the crease has to be moved to pay for it.
pub(super) fn along(star: &LocalStar, target: DVec3) -> Option<DVec3> {
    let direction = direction(star)?;
    let [next, previous] = neighbours(star);
    let forward = target.dot(direction);
    let reach = 0.5 * if forward * next.dot(direction) > 0.0 { next.length() } else { previous.length() };
    Some(direction * forward.clamp(-reach, reach))
}

/// Unit direction, one of two, in which the centre of the star may slide.
pub(crate) fn direction(star: &LocalStar) -> Option<DVec3> {
    let [next, previous] = neighbours(star);
    let tangent = parabola_tangent(next, previous);
    if star.is_crease() { neutral_direction(star, tangent) } else { tangent }.try_normalize()
}

/// The next and the previous vertex of the feature line.
fn neighbours(star: &LocalStar) -> [DVec3; 2] {
    // Without a crease the only sector ends with the rim.
    [star.point(0), star.point(star.split())]
}

/// Tangent at the origin of the parabola through `previous`, the origin, and `next`.
fn parabola_tangent(next: DVec3, previous: DVec3) -> DVec3 {
    next * previous.length_squared() - previous * next.length_squared()
}

/// A direction along the crease in which the volume does not change. Where one side is flat it is the line in which the
/// planes of the two sides meet, so that what is flat stays flat; else the tangent, brought into the neutral plane.
fn neutral_direction(star: &LocalStar, tangent: DVec3) -> DVec3 {
    let mut areas = star.sectors().map(double_vector_area);
    let (left, right) = (areas.next().unwrap_or_default(), areas.next().unwrap_or_default());
    let line = left.cross(right);
    let meets = line.length() >= MEETING * left.length() * right.length();
    if meets && star.sectors().any(is_flat) {
        return line;
    }
    let area = left + right;
    let square = area.length_squared();
    if square > 0.0 { tangent - area * (area.dot(tangent) / square) } else { tangent }
}

fn is_flat(sector: impl Iterator<Item = DVec3> + Clone) -> bool {
    let normal = double_vector_area(sector.clone()).normalize_or_zero();
    let leans = |n: DVec3| n.cross(normal).length() > FLAT * n.length();
    !sector.clone().zip(sector.skip(1)).any(|(a, b)| leans(a.cross(b)))
}
