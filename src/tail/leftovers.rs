//! What could not be cured, and why.

use super::limits::Limits;
use super::live::Live;
use super::queue::Queue;
use super::report::{Defect, Leftover, Reason};
use crate::error::Error;
use crate::memory;
use crate::mesh::repeats_a_vertex;

/// Lists the triangles still in the tail; `number` gives the output number of each slot.
pub(super) fn list(
    live: &Live<'_>,
    limits: &Limits,
    queue: &Queue<'_>,
    number: impl Fn(u32) -> u32,
) -> Result<Vec<Leftover>, Error> {
    let defect = |slot: u32| {
        let degenerate = repeats_a_vertex(&live.triangles[slot as usize]);
        if degenerate { Defect::Degenerate } else { limits.defect(live.corners(slot)) }
    };
    let leftover = |slot: u32| Leftover {
        triangle: number(slot),
        defect: defect(slot),
        reason: queue.reasons.get(&slot).copied().unwrap_or(Reason::NoGain),
    };
    memory::gathered(queue.left(live).map(leftover))
}
