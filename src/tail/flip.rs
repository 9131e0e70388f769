//! Flip of an edge: the other diagonal of the quadrilateral of its two triangles.

use super::cavity::{Cavity, is_locked};
use super::patch::{Patch, Shape};
use super::report::Reason;
use crate::sweep::Surroundings;

/// Flips the edge between `a` and `b`. Both ways to cut a quadrilateral are known, so nothing needs to be triangulated.
pub(super) fn flip(patch: &Patch, around: &Surroundings<'_>, a: usize, b: usize) -> Result<Shape, Reason> {
    let shape = &patch.shape;
    if patch.is_feature(around, a, b) {
        return Err(Reason::Feature);
    }
    let (Some((left, c)), Some((right, d))) = (shape.beside(a, b), shape.beside(b, a)) else {
        return Err(Reason::Boundary);
    };
    let pieces = vec![left.min(right), left.max(right)];
    if pieces.iter().any(|&i| is_locked(patch, &shape.pieces[i])) {
        return Err(Reason::Locked);
    }
    if c == d {
        return Err(Reason::Topology);
    }
    let cavity = Cavity { pieces, rim: vec![a, d, b, c] };
    Ok(cavity.filled(shape, &[[a, d, c], [d, b, c]]))
}
