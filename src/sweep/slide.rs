//! Sliding: how a vertex of a crease or of the boundary moves along it.

use glam::DVec3;

use crate::star::{LocalStar, double_vector_area};

/// The part of `target` that leads along the feature line through the centre of the star, at most half-way to the next
/// vertex of the line.
pub(super) fn along(star: &LocalStar, target: DVec3) -> Option<DVec3> {
    let tangent = tangent(star)?;
    let [next, previous] = neighbours(star);
    let reach = 0.5 * if target.dot(tangent) > 0.0 { next.length() } else { previous.length() };
    Some(tangent * target.dot(tangent).clamp(-reach, reach))
}

/// Unit direction of the feature line through the centre of the star.
///
/// The line is taken as the parabola through the centre and its two neighbours on the feature, and its tangent is brought
/// into the plane orthogonal to the ring's vector area, so that a slide owes no volume.
pub(crate) fn tangent(star: &LocalStar) -> Option<DVec3> {
    let [next, previous] = neighbours(star);
    let mut tangent = next * previous.length_squared() - previous * next.length_squared();
    if is_crease(star) {
        let area = double_vector_area(&star.rim);
        let square = area.length_squared();
        if square > 0.0 {
            tangent -= area * (area.dot(tangent) / square);
        }
    }
    tangent.try_normalize()
}

/// The two neighbours of the centre on the feature.
fn neighbours(star: &LocalStar) -> [DVec3; 2] {
    [star.rim[0], star.rim[if is_crease(star) { star.split } else { star.rim.len() - 1 }]]
}

fn is_crease(star: &LocalStar) -> bool {
    star.split + 1 < star.rim.len()
}
