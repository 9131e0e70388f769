//! Corners, told from noise.

use glam::DVec3;

use crate::mesh::{Mesh, Stars};
use crate::quality::triangle::Sides;

/// Mean-ratio shape from which on a star's triangles are believed.
const WELL_SHAPED: f64 = 0.6;

/// Cosine of 10°, the angle within which the normals of one face agree.
const AGREEING: f64 = 0.984_807_753_012_208;

/// Whether a closed star in which features meet otherwise than in a line, at the ring positions `ends`, has a corner to
/// keep. On a scan the dihedral angles beside slivers are noise, and to freeze their vertices is to freeze the slivers;
/// the slivers of a CAD tessellation lie in flat faces.
pub(super) fn is_credible(mesh: &Mesh<'_>, stars: &Stars, v: u32, ends: &[usize]) -> bool {
    let ring = stars.ring(v);
    let corners = |i: usize| mesh.corners(&[v, ring[i % ring.len()], ring[(i + 1) % ring.len()]]);
    let normal = |i: usize| {
        let [a, b, c] = corners(i);
        (b - a).cross(c - a)
    };
    let flat = |(first, last): (usize, usize)| {
        let face = (first..last).map(normal).sum::<DVec3>().normalize_or_zero();
        (first..last).map(normal).all(|n| n.dot(face) >= AGREEING * n.length())
    };
    let wrapped = ends.iter().skip(1).copied().chain(ends.first().map(|e| e + ring.len()));
    (0..ring.len()).all(|i| Sides::new(corners(i)).shape() >= WELL_SHAPED)
        || ends.iter().copied().zip(wrapped).all(flat)
}
