//! Which stars can be visited at once: blocks of vertices, and colours for what lies between the blocks.

use super::surroundings::Surroundings;
use crate::error::Error;
use crate::memory;
use crate::threads::{PART, Threads};

/// Vertices of consecutive numbers that make a block: a power of two.
pub(super) const BLOCK: usize = 512;

/// Colours at most. Vertices for which none is left are visited one by one.
const COLORS: usize = 63;

/// The vertices that may move, in the order of their visits. It depends on the mesh alone.
pub(super) struct Schedule {
    /// First the inner vertices of each block, by index: their neighbours lie in their own block, or don't move. Then the
    /// others, by colour: no two of one colour are neighbours. Then those that no colour was left for.
    pub vertices: Vec<u32>,
    /// Ends of the blocks in `vertices`.
    pub blocks: Vec<usize>,
    /// Ends of the colours behind the blocks.
    pub colors: Vec<usize>,
}

/// What a vertex is, in a byte: one of these, or its colour.
const STAYS: u8 = u8::MAX;
const INNER: u8 = u8::MAX - 1;
const BORDER: u8 = u8::MAX - 2;

impl Schedule {
    pub fn new(around: &Surroundings<'_>, threads: &Threads<'_>) -> Result<Self, Error> {
        let mut marks = memory::filled(STAYS, around.stars.len())?;
        threads.each(marks.chunks_mut(PART).enumerate().collect(), |(part, marks)| {
            for (v, mark) in ((part * PART) as u32..).zip(marks) {
                *mark = around.mark(v);
            }
        });
        let mut vertices = memory::reserved(marks.iter().filter(|&&mark| mark != STAYS).count())?;
        let mut blocks = memory::reserved(marks.len().div_ceil(BLOCK))?;
        for (block, marks) in marks.chunks(BLOCK).enumerate() {
            let inner = ((block * BLOCK) as u32..).zip(marks).filter(|&(_, &mark)| mark == INNER);
            vertices.extend(inner.map(|(v, _)| v));
            blocks.push(vertices.len());
        }
        greedy(around, &mut marks);
        let mut schedule = Self { vertices, blocks, colors: Vec::new() };
        schedule.add_border(&marks);
        Ok(schedule)
    }

    /// Adds the border, colour by colour, by counting.
    fn add_border(&mut self, marks: &[u8]) {
        let colors = || marks.iter().map(|&mark| usize::from(mark)).enumerate().filter(|&(_, color)| color <= COLORS);
        let mut counts = [0; COLORS + 1];
        colors().for_each(|(_, color)| counts[color] += 1);
        let mut next = [self.vertices.len(); COLORS + 2];
        for color in 0..=COLORS {
            next[color + 1] = next[color] + counts[color];
        }
        self.colors.extend(next[1..=COLORS].iter().zip(counts).filter(|&(_, count)| count > 0).map(|(&end, _)| end));
        self.vertices.resize(next[COLORS + 1], 0);
        for (v, color) in colors() {
            self.vertices[next[color]] = v as u32;
            next[color] += 1;
        }
    }
}

impl Surroundings<'_> {
    /// Whether a vertex may move, and if so whether it is inside its block.
    fn mark(&self, v: u32) -> u8 {
        if !self.features.role(v).moves() {
            return STAYS;
        }
        let rim = self.stars.rim(v);
        let is_foreign = |r: u32| (r ^ v) as usize >= BLOCK;
        let strays = rim.iter().fold(0, |strays, &r| strays | (r ^ v));
        if (strays as usize) < BLOCK || !rim.iter().any(|&r| is_foreign(r) && self.features.role(r).moves()) {
            INNER
        } else {
            BORDER
        }
    }
}

/// Gives each vertex of the border, by index, the first colour that none of its neighbours there has.
fn greedy(around: &Surroundings<'_>, marks: &mut [u8]) {
    for v in 0..marks.len() {
        if marks[v] != BORDER {
            continue;
        }
        let taken = around.stars.rim(v as u32).iter().fold(0_u64, |taken, &r| {
            let mark = marks[r as usize];
            taken | u64::from(usize::from(mark) < COLORS) << (mark & 63)
        });
        marks[v] = (taken.trailing_ones() as u8).min(COLORS as u8);
    }
}
