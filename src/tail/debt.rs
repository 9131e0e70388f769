//! The volume debt of an operation, paid at once.

use glam::DVec3;

use super::patch::{Freedom, Patch, Shape};
use super::relax::Relaxer;
use crate::star::double_vector_area;

/// Six times the volume of the cone from `origin` over a shape.
fn sextuple_volume(shape: &Shape, origin: DVec3) -> f64 {
    let cone = |[a, b, c]: [DVec3; 3]| (a - origin).cross(b - origin).dot(c - origin);
    shape.pieces.iter().map(|p| cone(shape.corners(p))).sum()
}

/// Shifts one free vertex along the vector area of its ring so that the volume is what it is in the patch as it lies in
/// the mesh. Of the `payers` that may go so far, the one whose star suffers least pays, and of equals the one whose shift
/// is shortest. False if none can.
pub(super) fn pay(relaxer: &mut Relaxer<'_>, patch: &Patch, shape: &mut Shape, payers: &[usize]) -> bool {
    let origin = patch.shape.positions[0];
    let debt = sextuple_volume(shape, origin) - sextuple_volume(&patch.shape, origin);
    if debt == 0.0 {
        return true;
    }
    let mut best: Option<(f64, f64, usize, DVec3)> = None;
    for &v in payers.iter().filter(|&&v| matches!(patch.freedom[v], Freedom::Full | Freedom::Move)) {
        if !relaxer.take(patch, shape, v) {
            continue;
        }
        let area = double_vector_area(&relaxer.star().rim);
        let step = area * (-debt / area.length_squared());
        let (worst, length) = (relaxer.worst(step, f64::INFINITY).max(1.0), step.length());
        let is_better = best.is_none_or(|(w, l, ..)| (worst, length) < (w, l));
        if step.is_finite() && is_better && relaxer.admits(patch.vertices[v], step) {
            best = Some((worst, length, v, shape.positions[v] + step));
        }
    }
    if let Some((_, _, v, new)) = best {
        shape.positions[v] = relaxer.storable(new);
    }
    best.is_some()
}
