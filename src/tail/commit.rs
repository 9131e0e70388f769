//! Putting a changed patch back into the mesh.

use glam::DVec3;

use super::live::Live;
use super::patch::{Patch, Piece, Shape};
use super::topology::{fresh, slots_taken_out};

/// A triangle that is taken out, and where its parts came from.
struct Former {
    slot: u32,
    corners: [u32; 3],
    middle: DVec3,
    triangle_source: u32,
    corner_source: [u32; 3],
}

/// Replaces the patch by `shape`. Returns the slots of its triangles that are new, have a moved corner, or have a corner in
/// common with such a triangle or with one that is gone.
pub(super) fn commit(live: &mut Live, patch: &Patch, shape: &Shape) -> Vec<u32> {
    let touched = touched(patch, shape);
    let is_near = |p: &&Piece| p.corners.iter().any(|v| touched.binary_search(v).is_ok());
    let mut near: Vec<_> = shape.pieces.iter().filter(is_near).filter_map(|p| p.slot).collect();
    let former: Vec<_> = slots_taken_out(patch, shape).into_iter().map(|slot| Former::of(live, slot)).collect();
    former.iter().for_each(|f| live.take_out(f.slot));
    let mut free: Vec<_> = former.iter().map(|f| f.slot).collect();
    for piece in fresh(shape) {
        let corners = piece.corners.map(|v| patch.vertices[v]);
        let middle = shape.corners(piece).iter().sum::<DVec3>() / 3.0;
        let Some(source) = source(&former, corners, middle) else { continue };
        let own = free.iter().position(|&s| s == source.slot).unwrap_or(0);
        let slot = free.remove(own);
        live.triangle_source[slot as usize] = source.triangle_source;
        live.corner_source[slot as usize] = corners.map(|v| corner_source(&former, source, v));
        live.put_in(slot, corners);
        near.push(slot);
    }
    for (&v, &position) in patch.vertices.iter().zip(&shape.positions) {
        live.positions[v as usize] = position;
    }
    let vertices = touched.iter().map(|&v| patch.vertices[v]);
    let lost: Vec<_> = vertices.filter(|&v| live.around(v).is_empty()).collect();
    live.removed.extend(lost);
    near
}

impl Former {
    fn of(live: &Live, slot: u32) -> Self {
        Self {
            slot,
            corners: live.triangles[slot as usize],
            middle: live.corners(slot).iter().sum::<DVec3>() / 3.0,
            triangle_source: live.triangle_source[slot as usize],
            corner_source: live.corner_source[slot as usize],
        }
    }

    /// Source of the corner at `v`, if the triangle has it.
    fn corner_at(&self, v: u32) -> Option<u32> {
        self.corners.iter().position(|&c| c == v).map(|k| self.corner_source[k])
    }
}

/// The former triangle that a new one takes after: the one with most corners in common, among them the nearest.
fn source(former: &[Former], corners: [u32; 3], middle: DVec3) -> Option<&Former> {
    let foreign = |f: &Former| corners.iter().filter(|v| !f.corners.contains(v)).count();
    let distance = |f: &Former| f.middle.distance_squared(middle);
    former.iter().min_by(|f, g| foreign(f).cmp(&foreign(g)).then(distance(f).total_cmp(&distance(g))))
}

/// Source of a new corner at `v`: in the source triangle, else in the first former triangle that has the vertex. All
/// corners of a vertex in a cavity lie on the same side of features.
fn corner_source(former: &[Former], source: &Former, v: u32) -> u32 {
    let any = || former.iter().find_map(|f| f.corner_at(v));
    source.corner_at(v).or_else(any).unwrap_or(source.corner_source[0])
}

/// Corners of the triangles that are new or gone or have a moved corner, as numbers within the patch, rising.
fn touched(patch: &Patch, shape: &Shape) -> Vec<usize> {
    let moved = |v: usize| shape.positions[v] != patch.shape.positions[v];
    let gone = patch.shape.pieces.iter().filter(|p| !shape.pieces.contains(p));
    let changed = shape.pieces.iter().filter(|p| p.slot.is_none() || p.corners.iter().any(|&v| moved(v)));
    let mut vertices: Vec<_> = gone.chain(changed).flat_map(|p| p.corners).collect();
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}
