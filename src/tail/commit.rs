//! Putting a changed patch back into the mesh.

use glam::DVec3;

use super::live::{Live, Origin};
use super::patch::{Patch, Piece, Shape};
use super::topology::{fresh, slots_taken_out};

/// A triangle that is taken out, and where its parts came from.
struct Former {
    slot: u32,
    corners: [u32; 3],
    middle: DVec3,
    origin: Origin,
}

/// Replaces the patch by `shape`. Returns the slots of its triangles that are new, have a moved corner, or have a corner in
/// common with such a triangle or with one that is gone.
pub(super) fn commit(live: &mut Live<'_>, patch: &Patch, shape: &Shape) -> Vec<u32> {
    let touched = touched(patch, shape);
    let is_near = |p: &&Piece| p.corners.iter().any(|v| touched.binary_search(v).is_ok());
    let mut near: Vec<_> = shape.pieces.iter().filter(is_near).filter_map(|p| p.slot).collect();
    let former: Vec<_> = slots_taken_out(patch, shape).into_iter().map(|slot| Former::of(live, slot)).collect();
    former.iter().for_each(|f| live.take_out(f.slot));
    let mut free: Vec<_> = former.iter().map(|f| f.slot).collect();
    for piece in fresh(shape) {
        let corners = piece.corners.map(|v| patch.vertices[v]);
        let middle = shape.corners(piece).iter().sum::<DVec3>() / 3.0;
        let Some(heir) = Heir::of(live.input, &former, corners, middle) else { continue };
        let own = free.iter().position(|&s| s == heir.slot).unwrap_or(0);
        let slot = free.remove(own);
        live.put_in(slot, heir.corners, heir.origin);
        near.push(slot);
    }
    for (&v, &position) in patch.vertices.iter().zip(&shape.positions) {
        live.positions[v as usize] = position;
    }
    let vertices = touched.iter().map(|&v| patch.vertices[v]);
    let lost: Vec<_> = vertices.filter(|&v| live.is_left_alone(v)).collect();
    live.removed.extend(lost);
    near
}

impl Former {
    fn of(live: &Live<'_>, slot: u32) -> Self {
        Self {
            slot,
            corners: live.triangles[slot as usize],
            middle: live.corners(slot).iter().sum::<DVec3>() / 3.0,
            origin: live.origin(slot),
        }
    }

    /// Source of the corner at `v`, if the triangle has it.
    fn corner_at(&self, v: u32) -> Option<u32> {
        self.corners.iter().position(|&c| c == v).map(|k| self.origin.corners[k])
    }
}

/// A new triangle with all that it inherits.
struct Heir {
    /// Slot of the triangle that it takes after.
    slot: u32,
    corners: [u32; 3],
    origin: Origin,
}

impl Heir {
    /// What was there in the input comes back as it was; any other triangle takes after the former one with which it has
    /// most corners in common, among them the nearest.
    fn of(input: &[[u32; 3]], former: &[Former], corners: [u32; 3], middle: DVec3) -> Option<Self> {
        let [a, b, c] = corners;
        let is_back = |f: &&Former| [[a, b, c], [b, c, a], [c, a, b]].contains(&input[f.origin.triangle as usize]);
        if let Some(&Former { slot, origin: Origin { triangle, .. }, .. }) = former.iter().find(is_back) {
            return Some(Self { slot, corners: input[triangle as usize], origin: Origin::own(triangle) });
        }
        let foreign = |f: &Former| corners.iter().filter(|v| !f.corners.contains(v)).count();
        let distance = |f: &Former| f.middle.distance_squared(middle);
        let nearer = |f: &&Former, g: &&Former| distance(f).total_cmp(&distance(g));
        let source = former.iter().min_by(|f, g| foreign(f).cmp(&foreign(g)).then(nearer(f, g)))?;
        let origin = Origin { corners: corners.map(|v| corner_source(former, source, v)), ..source.origin };
        Some(Self { slot: source.slot, corners, origin })
    }
}

/// Source of a new corner at `v`: one in the source's input triangle, else the one that the source has, else any. All
/// corners of a vertex in a cavity lie on the same side of features.
fn corner_source(former: &[Former], source: &Former, v: u32) -> u32 {
    let all = || former.iter().filter_map(|f| f.corner_at(v));
    let native = all().find(|corner| corner / 3 == source.origin.triangle);
    native.or_else(|| source.corner_at(v)).or_else(|| all().next()).unwrap_or(source.origin.corners[0])
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
