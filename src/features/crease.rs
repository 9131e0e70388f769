//! Creases, told from noise.

use super::role::{SlotSet, unit_normal};
use crate::mesh::{Mesh, Stars};

/// Marks the edges sharper than `angle` degrees.
pub(super) fn mark(mesh: &Mesh<'_>, stars: &Stars, angle: f64, slots: &mut SlotSet) {
    let cosine = libm::cos(angle.to_radians());
    for v in 0..stars.len() as u32 {
        for (i, &r) in stars.ring(v).iter().enumerate() {
            let Some([before, after]) = stars.flanks(v, i) else { continue };
            let p = |k: u32| mesh.positions[k as usize];
            let (left, right) = (unit_normal(p(v), p(before), p(r)), unit_normal(p(v), p(r), p(after)));
            if left.dot(right) < cosine {
                slots.insert_edge(stars, v, r);
            }
        }
    }
}
