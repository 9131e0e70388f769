//! The edges opposite to each vertex in its triangles, in flat arrays: what stars are put in order from, without another look at
//! the triangles, which may be anywhere.

use super::validated::{Mesh, repeats_a_vertex};
use crate::error::Error;
use crate::memory;
use crate::threads::Threads;

/// Parts into which the vertices are divided, each of which takes another look at the triangles: at all of them if the mesh is
/// numbered at random, else at few more than its own.
const LOOKS: usize = 8;

/// The edges around each vertex, in the order of its triangles.
pub(super) struct RimEdges {
    /// Start of each vertex's slots; one entry more than vertices.
    pub offsets: Vec<u32>,
    /// Where edges start: per vertex one slot more than it has triangles, the last of which is 0.
    pub starts: Vec<u32>,
    /// Where they end, in the same slots.
    pub ends: Vec<u32>,
}

impl RimEdges {
    pub fn new(mesh: &Mesh<'_>, threads: &Threads<'_>) -> Result<Self, Error> {
        let mut offsets = slot_ends(mesh, threads)?;
        let count = offsets[offsets.len() - 1] as usize;
        let (mut starts, mut ends) = (threads.filled(0, count)?, threads.filled(0, count)?);
        // What was counted says whether a triangle was left out, so none needs a second look.
        let takes_all = count == 3 * mesh.triangles.len() + mesh.positions.len();
        let parts = Slots::parts(&mut offsets, (&mut starts, &mut ends), look(mesh.positions.len(), threads));
        threads.each(parts, |part| match (part.first_vertex, takes_all) {
            (0, true) => Slots { first_vertex: 0, first_slot: 0, ..part }.fill(mesh, |_| true),
            _ => part.fill(mesh, |corners| takes_all || !repeats_a_vertex(corners)),
        });
        Ok(Self { offsets, starts, ends })
    }
}

/// Vertices of a part.
fn look(vertex_count: usize, threads: &Threads<'_>) -> usize {
    (vertex_count + 1).div_ceil(threads.count().min(LOOKS))
}

/// The last slot of each vertex, and at the end the number of slots.
fn slot_ends(mesh: &Mesh<'_>, threads: &Threads<'_>) -> Result<Vec<u32>, Error> {
    let mut ends = memory::filled(0_u32, mesh.positions.len() + 1)?;
    let look = look(mesh.positions.len(), threads);
    threads.each(ends.chunks_mut(look).enumerate().collect(), |(part, ends)| match part {
        0 => count(mesh, 0, ends),
        _ => count(mesh, part * look, ends),
    });
    let mut next = 0;
    for end in &mut ends {
        *end += next;
        next = *end + 1;
    }
    Ok(ends)
}

/// Counts the triangles around the vertices from `first` on. For 0, which takes no subtraction, it is compiled apart.
#[inline(always)]
fn count(mesh: &Mesh<'_>, first: usize, counts: &mut [u32]) {
    for (_, triangles) in mesh.parts_with(first..first + counts.len()) {
        for corners in triangles.iter().filter(|t| !repeats_a_vertex(t)) {
            for &v in corners {
                if let Some(count) = counts.get_mut((v as usize).wrapping_sub(first)) {
                    *count += 1;
                }
            }
        }
    }
}

/// The slots of consecutive vertices.
struct Slots<'a> {
    first_vertex: usize,
    first_slot: usize,
    /// Per vertex the first slot that something has been put into: to begin with the last one, which stays 0.
    last: &'a mut [u32],
    starts: &'a mut [u32],
    ends: &'a mut [u32],
}

impl<'a> Slots<'a> {
    /// Divides slots by vertices, `look` of which make a part. `last` has one entry more than there are vertices.
    fn parts(last: &'a mut [u32], (mut starts, mut ends): (&'a mut [u32], &'a mut [u32]), look: usize) -> Vec<Self> {
        let (mut parts, mut first_slot) = (Vec::new(), 0);
        for (part, last) in last.chunks_mut(look).enumerate() {
            // Where the next part begins; behind the last vertex the number of slots stands as a last one.
            let end = (last[last.len() - 1] as usize + 1).min(first_slot + starts.len());
            let (own_starts, other_starts) = starts.split_at_mut(end - first_slot);
            let (own_ends, other_ends) = ends.split_at_mut(end - first_slot);
            parts.push(Self { first_vertex: part * look, first_slot, last, starts: own_starts, ends: own_ends });
            (starts, ends, first_slot) = (other_starts, other_ends, end);
        }
        parts
    }

    /// Puts the edges of those triangles that are `taken` up into the slots of their opposite vertices, from behind, so that in
    /// the end what was the last slot of each vertex is its first one. Where vertices and slots begin with 0, which takes no
    /// subtraction, it is compiled apart.
    #[inline(always)]
    fn fill(self, mesh: &Mesh<'_>, taken: impl Fn(&[u32; 3]) -> bool) {
        let Self { first_vertex, first_slot, last, starts, ends } = self;
        let ends = &mut ends[..starts.len()];
        for (_, triangles) in mesh.parts_with(first_vertex..first_vertex + last.len()).rev() {
            for &[a, b, c] in triangles.iter().rev().filter(|corners| taken(corners)) {
                for [v, start, end] in [[a, b, c], [b, c, a], [c, a, b]] {
                    if let Some(last) = last.get_mut((v as usize).wrapping_sub(first_vertex)) {
                        *last -= 1;
                        let slot = *last as usize - first_slot;
                        (starts[slot], ends[slot]) = (start, end);
                    }
                }
            }
        }
    }
}
