//! What the original mesh says of a star: normals not to turn from, planes not to leave.

use glam::DVec3;

use super::witness::{Witness, signed_squared_shape};
use crate::mesh::{Mesh, Stars};
use crate::star::LocalStar;

/// Original shape below which a triangle's normal says nothing: comparing with it would freeze exactly those triangles
/// that need to move.
const MEANINGLESS: f64 = 1e-3;

/// Original shape below which a triangle's plane is not worth keeping.
const THIN: f64 = 0.3;

/// Fills in the original normals and planes. Returns the squared size of the original star: the mean square of the distances
/// from the centre to the ring.
pub(super) fn look(mesh: &Mesh<'_>, stars: &Stars, v: u32, star: &LocalStar, witnesses: &mut [Witness]) -> f64 {
    let centre = mesh.positions[v as usize];
    let at = |r: u32| mesh.positions[r as usize] - centre;
    let mut area = DVec3::ZERO;
    let mut square = 0.0;
    for (edge, witness) in star.vertices.windows(2).zip(witnesses.iter_mut()) {
        let (a, b) = (at(edge[0]), at(edge[1]));
        let normal = a.cross(b);
        area += normal;
        square += b.length_squared();
        let shape = signed_squared_shape(a, b, normal, normal);
        if shape > MEANINGLESS * MEANINGLESS {
            witness.normal = normal;
        }
        if shape > THIN * THIN {
            witness.plane = normal;
        }
    }
    for (edge, witness) in star.vertices.windows(2).zip(witnesses.iter_mut()) {
        if witness.normal.dot(area) < 0.0 && stars.is_folded(mesh, [v, edge[0], edge[1]]) {
            (witness.normal, witness.plane) = (DVec3::ZERO, DVec3::ZERO);
        }
    }
    square / witnesses.len() as f64
}
