//! Finding the tail.

use super::limits::Limits;
use super::live::{GONE, Live};
use crate::mesh::repeats_a_vertex;

/// Slots of the tail triangles, with their excess. A triangle that names a vertex twice has infinite excess.
pub(super) fn tails<'a>(
    live: &'a Live<'a>,
    limits: &'a Limits,
    mask: &'a [bool],
) -> impl Iterator<Item = (u32, f64)> + 'a {
    let asked = |slot: u32| mask.get(live.origin(slot).triangle as usize).copied().unwrap_or(true);
    let suspect = |slot: &u32| {
        let corners = &live.triangles[*slot as usize];
        *corners != GONE && (repeats_a_vertex(corners) || !limits.is_clearly_fine(live.corners(*slot)))
    };
    (0..live.triangles.len() as u32)
        .filter(suspect)
        .filter_map(|slot| excess(live, limits, slot).map(|excess| (slot, excess)))
        .filter(move |&(slot, excess)| excess > 1.0 && asked(slot))
}

/// Excess of the triangle in a slot; `None` if the slot is given up.
pub(super) fn excess(live: &Live<'_>, limits: &Limits, slot: u32) -> Option<f64> {
    let corners = &live.triangles[slot as usize];
    if *corners == GONE {
        None
    } else if repeats_a_vertex(corners) {
        Some(f64::INFINITY)
    } else {
        Some(limits.excess(live.corners(slot)))
    }
}
