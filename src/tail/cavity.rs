//! A cavity: the triangles that an operation takes away, and the rim of the hole.

use super::patch::{Freedom, Patch, Piece, Shape, cycle};
use super::report::Reason;

/// The triangles to be replaced and their rim.
pub(super) struct Cavity {
    /// Numbers of the pieces, rising.
    pub pieces: Vec<usize>,
    /// Rim vertices, counter-clockwise, each once.
    pub rim: Vec<usize>,
}

impl Cavity {
    /// The union of the stars of the `inner` vertices: a disc with these vertices inside, or a `Topology` reason. Where the
    /// inner vertices may be removed, no feature ends at them, so none crosses the cavity. That the rim passes each vertex
    /// once is the link condition.
    pub fn of_stars(shape: &Shape, inner: &[usize]) -> Result<Self, Reason> {
        let touches = |p: &Piece| p.corners.iter().any(|v| inner.contains(v));
        let pieces: Vec<_> = (0..shape.pieces.len()).filter(|&i| touches(&shape.pieces[i])).collect();
        let edges: Vec<_> = pieces.iter().flat_map(|&i| sides(&shape.pieces[i])).collect();
        let is_rim = |&(a, b): &(usize, usize)| !edges.contains(&(b, a));
        let rim_edges: Vec<_> = edges.iter().copied().filter(is_rim).collect();
        let rim = cycle(&rim_edges).ok_or(Reason::Topology)?;
        // Euler's formula for a disc.
        let is_disc = pieces.len() + 2 == rim.len() + 2 * inner.len() && rim.iter().all(|v| !inner.contains(v));
        if is_disc { Ok(Self { pieces, rim }) } else { Err(Reason::Topology) }
    }

    /// The patch with the cavity filled by these triangles. A triangle that was there before stays where it was.
    pub fn filled(&self, shape: &Shape, triangles: &[[usize; 3]]) -> Shape {
        let old = || self.pieces.iter().map(|&i| shape.pieces[i]);
        let kept = |t: &[usize; 3]| old().find(|p| is_same(p.corners, *t));
        let new = triangles.iter().map(|t| kept(t).unwrap_or(Piece { corners: *t, slot: None }));
        let outside = (0..shape.pieces.len()).filter(|i| self.pieces.binary_search(i).is_err());
        let pieces = outside.map(|i| shape.pieces[i]).chain(new).collect();
        Shape { positions: shape.positions.clone(), pieces }
    }
}

/// Directed edges of a piece.
pub(super) fn sides(piece: &Piece) -> [(usize, usize); 3] {
    let [a, b, c] = piece.corners;
    [(a, b), (b, c), (c, a)]
}

/// Whether the caller has locked all corners of a piece, so that it must stay.
pub(super) fn is_locked(patch: &Patch, piece: &Piece) -> bool {
    piece.corners.iter().all(|&v| patch.freedom[v] == Freedom::None(Reason::Locked))
}

/// Whether two triangles have the same corners and winding.
fn is_same([a, b, c]: [usize; 3], t: [usize; 3]) -> bool {
    t == [a, b, c] || t == [b, c, a] || t == [c, a, b]
}
