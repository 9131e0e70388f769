//! Blocks of a mesh that is not large: the inside of each is visited by index, and that of several blocks side by side.

use std::ops::Range;

use super::colors::Mark;
use super::schedule::Lot;
use super::surroundings::Surroundings;
use super::turns;
use crate::error::Error;
use crate::memory;
use crate::star::{LANES, TOGETHER};
use crate::threads::{PART, Threads};

/// Vertices of consecutive numbers that make a block: a power of two.
const BLOCK: usize = 512;

/// Which vertices lie inside their blocks: those whose neighbours all do, or don't move.
pub(super) fn marks(around: &Surroundings<'_>, threads: &Threads<'_>) -> Result<Vec<Mark>, Error> {
    let mut marks = threads.filled(Mark::STAYS, around.stars.len())?;
    threads.each(marks.chunks_mut(PART).enumerate().collect(), |(part, marks)| {
        for (v, mark) in ((part * PART) as u32..).zip(marks) {
            *mark = around.mark(v);
        }
    });
    Ok(marks)
}

/// What is inside the blocks: tasks of several blocks each, which don't wait for each other.
pub(super) fn lots(around: &Surroundings<'_>, marks: &[Mark], threads: &Threads<'_>) -> Result<Vec<Vec<Lot>>, Error> {
    let size = BLOCK * blocks_at_once(marks.len(), threads);
    let lots = threads.map_each(marks.chunks(size).enumerate().collect(), |(part, marks)| {
        let (mut vertices, blocks) = inside((part * size) as u32, marks)?;
        let turns = turns::side_by_side(around, &mut vertices, &blocks)?;
        Ok(vec![Lot { vertices, turns }])
    });
    lots.into_iter().collect()
}

/// Blocks that go side by side: as many as there can be, but so that all threads have about the same to do.
fn blocks_at_once(vertices: usize, threads: &Threads<'_>) -> usize {
    let blocks = vertices.div_ceil(BLOCK).max(1);
    let tasks = blocks.div_ceil(TOGETHER * threads.count()) * threads.count();
    blocks.div_ceil(tasks).next_multiple_of(LANES)
}

/// The vertices inside blocks, the first of which begins with vertex `first`, and where those of each block are.
fn inside(first: u32, marks: &[Mark]) -> Result<(Vec<u32>, Vec<Range<usize>>), Error> {
    let count = marks.iter().filter(|mark| mark.is_inside()).count();
    let (mut vertices, mut blocks) = (memory::filled(0, count)?, memory::reserved(marks.len().div_ceil(BLOCK))?);
    let mut end = 0;
    for (first, marks) in (first..).step_by(BLOCK).zip(marks.chunks(BLOCK)) {
        let start = end;
        for (v, mark) in (first..).zip(marks) {
            // The next one takes the place if this one is not inside: cheaper than to ask, since nobody foretells it.
            let Some(place) = vertices.get_mut(end) else { break };
            *place = v;
            end += usize::from(mark.is_inside());
        }
        blocks.push(start..end);
    }
    Ok((vertices, blocks))
}

impl Surroundings<'_> {
    /// Whether a vertex may move, and if so whether it is inside its block.
    fn mark(&self, v: u32) -> Mark {
        if !self.features.role(v).moves() {
            return Mark::STAYS;
        }
        let rim = self.stars.rim_of_disc(v);
        let is_inside = |&r: &u32| ((r ^ v) as usize) < BLOCK || !self.features.role(r).moves();
        if lies_in_block(rim, v) || rim.iter().all(is_inside) { Mark::INSIDE } else { Mark::BARE }
    }
}

/// Whether no vertex of a rim lies in another block than `v`. `false` says nothing about rims that are large, or tiny.
fn lies_in_block(rim: &[u32], v: u32) -> bool {
    let (Some(front), Some(back), ..=8) = (rim.first_chunk::<4>(), rim.last_chunk::<4>(), rim.len()) else {
        return false;
    };
    // These are all, some of them twice.
    let mut differing = [0; 4];
    for (i, differing) in differing.iter_mut().enumerate() {
        *differing = (front[i] ^ v) | (back[i] ^ v);
    }
    (differing.iter().fold(0, |all, bits| all | bits) as usize) < BLOCK
}
