//! Flip of an edge: the other diagonal of the quadrilateral of its two triangles.

use super::cavity::{Cavity, is_locked};
use super::patch::{Freedom, Patch, Shape};
use super::report::Reason;
use crate::sweep::Surroundings;

/// Flips the edge between `a` and `b`. Both ways to cut a quadrilateral are known, so nothing needs to be triangulated.
pub(super) fn flip(patch: &Patch, around: &Surroundings<'_>, a: usize, b: usize) -> Result<Shape, Reason> {
    let shape = &patch.shape;
    if patch.is_feature(around, a, b) {
        return Err(Reason::Feature);
    }
    let (Some((left, c)), Some((right, d))) = (shape.beside(a, b), shape.beside(b, a)) else {
        // Where nothing lies beyond an edge of the patch, that is either the boundary or not known.
        let at_boundary = [a, b].iter().all(|&v| patch.freedom[v] == Freedom::None(Reason::Boundary));
        return Err(if at_boundary { Reason::Boundary } else { Reason::Topology });
    };
    let pieces = vec![left.min(right), left.max(right)];
    if pieces.iter().any(|&i| is_locked(patch, &shape.pieces[i])) {
        return Err(Reason::Locked);
    }
    if c == d {
        return Err(Reason::Topology);
    }
    let triangles = [[a, d, c], [d, b, c]];
    if !is_convex(shape, &[a, d, b, c], triangles) {
        return Err(Reason::Fold);
    }
    let cavity = Cavity { pieces, rim: vec![a, d, b, c] };
    Ok(cavity.filled(shape, &triangles))
}

/// Whether both new triangles turn the way the quadrilateral does.
fn is_convex(shape: &Shape, rim: &[usize; 4], triangles: [[usize; 3]; 2]) -> bool {
    let [p, q, r, s] = rim.map(|v| shape.positions[v]);
    let outward = (r - p).cross(s - q);
    triangles.into_iter().all(|t| {
        let [a, b, c] = t.map(|v| shape.positions[v]);
        (b - a).cross(c - a).dot(outward) > 0.0
    })
}
