//! Sliding: how a vertex of a crease or of the boundary moves along it.

use glam::DVec3;

use crate::star::{LocalStar, double_vector_area};

/// The part of `target` that leads along the feature line through the centre of the star.
///
/// The line is taken as the parabola through the centre and its two neighbours on the feature, and its tangent is brought
/// into the plane orthogonal to the ring's vector area, so that the slide owes no volume.
pub(super) fn along(star: &LocalStar, target: DVec3) -> Option<DVec3> {
    let crease = star.split + 1 < star.rim.len();
    let (next, previous) = (star.rim[0], star.rim[if crease { star.split } else { star.rim.len() - 1 }]);
    let mut tangent = next * previous.length_squared() - previous * next.length_squared();
    if crease {
        let area = double_vector_area(&star.rim);
        let square = area.length_squared();
        if square > 0.0 {
            tangent -= area * (area.dot(tangent) / square);
        }
    }
    let tangent = tangent.try_normalize()?;
    let reach = 0.5 * if target.dot(tangent) > 0.0 { next.length() } else { previous.length() };
    Some(tangent * target.dot(tangent).clamp(-reach, reach))
}
