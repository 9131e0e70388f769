//! Collapse of an edge: its two ends become one, and the hole is filled anew around it.

use glam::DVec3;

use super::cavity::Cavity;
use super::patch::{Patch, Shape};
use super::report::Reason;
use super::retriangulate::retriangulate;
use crate::star::{TangentPlane, double_vector_area};
use crate::sweep::Surroundings;

/// Collapses the edge between `a` and `b` into its middle; the end with the lower number in the mesh survives.
pub(super) fn collapse(patch: &Patch, around: &Surroundings<'_>, a: usize, b: usize) -> Result<Shape, Reason> {
    let (kept, lost) = if patch.vertices[a] < patch.vertices[b] { (a, b) } else { (b, a) };
    let stays = patch.reason_to_exist(kept).or(patch.reason_to_exist(lost));
    if let Some(reason) = stays {
        return Err(reason);
    }
    let cavity = Cavity::of_stars(&patch.shape, &[kept, lost])?;
    let middle = around.mesh.storable((patch.shape.positions[kept] + patch.shape.positions[lost]) * 0.5);
    let triangles = fill(&patch.shape, &cavity.rim, Some((kept, middle))).ok_or(Reason::Fold)?;
    let mut shape = cavity.filled(&patch.shape, &triangles);
    shape.positions[kept] = middle;
    Ok(shape)
}

/// Triangles that fill a rim, around an inner vertex if there is one, in the plane orthogonal to the rim's vector area.
pub(super) fn fill(shape: &Shape, rim: &[usize], inner: Option<(usize, DVec3)>) -> Option<Vec<[usize; 3]>> {
    let origin = shape.positions[rim[0]];
    let places = rim.iter().map(|&v| shape.positions[v]).chain(inner.map(|(_, place)| place));
    let relative: Vec<_> = places.map(|p| p - origin).collect();
    let plane = TangentPlane::orthogonal_to(double_vector_area(&relative[..rim.len()]))?;
    let points: Vec<_> = relative.iter().map(|&p| plane.project(p)).collect();
    let triangles = retriangulate(&points, rim.len())?;
    let vertex = |i: usize| rim.get(i).copied().or(inner.map(|(v, _)| v)).unwrap_or(rim[0]);
    Some(triangles.into_iter().map(|t| t.map(vertex)).collect())
}
