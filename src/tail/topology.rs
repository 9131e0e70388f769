//! Whether an operation leaves the surface what it was beside the cavity.

use super::cavity::sides;
use super::live::Live;
use super::patch::{Patch, Piece, Shape};

/// Whether new triangles make an edge that is already elsewhere, or a triangle that is there already.
pub(super) fn is_broken(live: &Live<'_>, patch: &Patch, shape: &Shape) -> bool {
    let removed = slots_taken_out(patch, shape);
    let is_there = |corners: &[u32]| {
        let mut remaining = live.around_all(corners).iter().filter(|s| removed.binary_search(s).is_err());
        remaining.any(|&s| corners.iter().all(|v| live.triangles[s as usize].contains(v)))
    };
    let old_sides: Vec<_> = patch.shape.pieces.iter().filter(|p| is_in(&removed, p)).flat_map(sides).collect();
    let new_sides: Vec<_> = fresh(shape).flat_map(sides).collect();
    let is_rim = |&(a, b): &(usize, usize)| old_sides.contains(&(a, b)) && !old_sides.contains(&(b, a));
    let is_crowded = |&(a, b): &(usize, usize)| {
        let both_new = new_sides.iter().filter(|&&s| s == (a, b) || s == (b, a)).count() == 2;
        !both_new || is_there(&[patch.vertices[a], patch.vertices[b]])
    };
    let is_doubled = |p: &Piece| is_there(&p.corners.map(|v| patch.vertices[v]));
    new_sides.iter().filter(|s| !is_rim(s)).any(is_crowded) || fresh(shape).any(is_doubled)
}

/// The pieces that an operation has made.
pub(super) fn fresh(shape: &Shape) -> impl Iterator<Item = &Piece> {
    shape.pieces.iter().filter(|p| p.slot.is_none())
}

/// Slots of the patch that are no longer in `shape`, rising.
pub(super) fn slots_taken_out(patch: &Patch, shape: &Shape) -> Vec<u32> {
    let mut kept: Vec<_> = shape.pieces.iter().filter_map(|p| p.slot).collect();
    kept.sort_unstable();
    let all = patch.shape.pieces.iter().filter_map(|p| p.slot);
    let mut gone: Vec<_> = all.filter(|s| kept.binary_search(s).is_err()).collect();
    gone.sort_unstable();
    gone
}

fn is_in(slots: &[u32], piece: &Piece) -> bool {
    piece.slot.is_some_and(|s| slots.binary_search(&s).is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::options::{Constraints, Options};
    use crate::preparation::Preparation;
    use crate::tail::cavity::Cavity;
    use crate::threads::Threads;

    const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    const CORNERS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// Whether filling the hole that these pieces leave with these triangles breaks the surface.
    fn breaks(triangles: &[[u32; 3]], pieces: Vec<usize>, filling: &[[usize; 3]]) -> bool {
        let options = Options::default();
        let prepared =
            Preparation::new(CORNERS.as_slice(), triangles, &options, &Constraints::default(), &Threads::ONE)
                .expect("valid");
        let mesh: &Mesh<'_> = &prepared.mesh;
        let live = Live::new(mesh, mesh.positions.doubled().expect("enough memory")).expect("enough memory");
        let patch = Patch::of_stars(&live, &prepared.surroundings(&options), &[0, 1, 2, 3]);
        let shape = Cavity { pieces, rim: Vec::new() }.filled(&patch.shape, filling);
        is_broken(&live, &patch, &shape)
    }

    #[test]
    fn an_edge_that_is_elsewhere_cannot_be_made_again() {
        // The patch takes the triangles up in their own order. Edge 0-1 would become 2-3, which the other two have.
        assert!(breaks(&TETRAHEDRON, vec![0, 1], &[[0, 2, 3], [2, 1, 3]]));
    }

    #[test]
    fn a_triangle_that_is_there_cannot_be_made_again() {
        // Without vertex 3 two triangles would lie back to back.
        assert!(breaks(&TETRAHEDRON, vec![1, 2, 3], &[[0, 1, 2]]));
        assert!(!breaks(&TETRAHEDRON[1..], vec![0, 1, 2], &[[0, 1, 2]]), "alone it may be made");
    }

    #[test]
    fn the_other_diagonal_of_a_square_may_be_taken() {
        assert!(!breaks(&[[0, 1, 2], [1, 3, 2]], vec![0, 1], &[[0, 1, 3], [0, 3, 2]]));
    }
}
