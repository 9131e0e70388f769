//! Which stars can be visited at once: blocks of vertices, and colours for what lies between the blocks.

use std::ops::Range;

use super::colors::{self, COLORS, Counts};
use super::surroundings::Surroundings;
use super::task::Task;
use super::turns::{self, Turn};
use crate::error::Error;
use crate::memory;
use crate::star::{LANES, TOGETHER};
use crate::threads::{PART, Threads};

/// Vertices of consecutive numbers that make a block: a power of two.
pub(super) const BLOCK: usize = 512;

/// Vertices of a task on the border, at most: few enough for all threads to end at about the same time.
const TASK: usize = 128 * TOGETHER;

/// The vertices that may move, in the order of their visits. It depends on the mesh alone.
pub(super) struct Schedule {
    /// First the inner vertices of the blocks: their neighbours lie in their own block, or don't move. Then the others, by
    /// colour: no two of one colour are neighbours. Then those that no colour was left for.
    vertices: Vec<u32>,
    /// Tasks that don't wait for each other, round by round.
    rounds: Vec<Vec<Lot>>,
}

/// What a task consists of.
struct Lot {
    /// Where its vertices lie.
    vertices: Range<usize>,
    turns: Vec<Turn>,
}

/// What a vertex is, in a byte: one of these, or its colour. Divided by 64, each of these leaves what no colour does, so that
/// a set of colours in 64 bits has a place for them.
pub(super) const STAYS: u8 = 255;
pub(super) const INNER: u8 = 191;
pub(super) const BORDER: u8 = 127;
const _: () = assert!(STAYS % 64 == 63 && INNER % 64 == 63 && BORDER % 64 == 63 && COLORS == 63);

impl Schedule {
    pub fn new(around: &Surroundings<'_>, threads: &Threads<'_>) -> Result<Self, Error> {
        let mut marks = threads.filled(STAYS, around.stars.len())?;
        threads.each(marks.chunks_mut(PART).enumerate().collect(), |(part, marks)| {
            for (v, mark) in ((part * PART) as u32..).zip(marks) {
                *mark = around.mark(v);
            }
        });
        let count = marks.iter().filter(|&&mark| mark != STAYS).count();
        let mut schedule = Self { vertices: threads.filled(0, count)?, rounds: Vec::new() };
        let inner = schedule.add_blocks(around, &marks, threads)?;
        let counts = colors::give(around, &mut marks, threads);
        schedule.add_border(around, inner, (&marks, &counts), threads);
        Ok(schedule)
    }

    /// How many vertices there are.
    pub fn len(&self) -> usize {
        self.vertices.len()
    }

    /// Tasks that don't wait for each other, round by round.
    pub fn rounds(&self) -> impl Iterator<Item = Vec<Task<'_>>> {
        self.rounds.iter().map(|round| round.iter().map(|lot| self.task(lot)).collect())
    }

    fn task<'a>(&'a self, lot: &'a Lot) -> Task<'a> {
        Task { vertices: &self.vertices[lot.vertices.clone()], turns: &lot.turns }
    }

    /// The vertices that are in no task, to be visited one by one.
    pub fn rest(&self) -> &[u32] {
        &self.vertices[self.end()..]
    }

    /// End of the last task.
    fn end(&self) -> usize {
        self.rounds.last().and_then(|round| round.last()).map_or(0, |lot| lot.vertices.end)
    }

    /// Adds the inside of all blocks, several blocks side by side. Returns how many vertices that are.
    fn add_blocks(&mut self, around: &Surroundings<'_>, marks: &[u8], threads: &Threads<'_>) -> Result<usize, Error> {
        let parts: Vec<_> = marks.chunks(BLOCK * blocks_at_once(marks.len(), threads)).collect();
        let inner = |marks: &[u8]| marks.iter().filter(|&&mark| mark == INNER).count();
        let counts = threads.map(0..parts.len(), |part| inner(parts[part]));
        let (mut work, mut left, mut first) = (Vec::new(), &mut self.vertices[..], 0);
        for (marks, &count) in parts.into_iter().zip(&counts) {
            let (own, others) = left.split_at_mut(count);
            work.push((first, marks, own));
            (first, left) = (first + marks.len() as u32, others);
        }
        let turns = threads.map_each(work, |(first, marks, own)| {
            let blocks = fill(own, first, marks)?;
            turns::side_by_side(around, own, &blocks)
        });
        self.rounds.push(lots(0, turns.into_iter().collect::<Result<_, _>>()?));
        Ok(counts.into_iter().sum())
    }

    /// Adds the border from place `first` on, colour by colour; how many there are of each comes with the marks.
    fn add_border(
        &mut self,
        around: &Surroundings<'_>,
        first: usize,
        (marks, counts): (&[u8], &[Counts]),
        threads: &Threads<'_>,
    ) {
        let border = &mut self.vertices[first..];
        colors::sort(marks, counts, border, threads);
        let (mut start, mut left) = (first, border);
        for color in 0..COLORS {
            let (own, others) = left.split_at_mut(counts.iter().map(|counts| counts[color]).sum());
            let count = own.len();
            if count > 0 {
                let own = own.chunks_mut(TASK).collect();
                self.rounds.push(lots(start, threads.map_each(own, |own| turns::apart(around, own))));
            }
            (start, left) = (start + count, others);
        }
    }
}

/// Blocks that go side by side: as many as there can be, but so that all threads have about the same to do.
fn blocks_at_once(vertices: usize, threads: &Threads<'_>) -> usize {
    let blocks = vertices.div_ceil(BLOCK).max(1);
    let tasks = blocks.div_ceil(TOGETHER * threads.count()) * threads.count();
    blocks.div_ceil(tasks).next_multiple_of(LANES)
}

/// Fills in the inner vertices of blocks, the first of which begins with vertex `first`. Returns where those of each are.
fn fill(own: &mut [u32], first: u32, marks: &[u8]) -> Result<Vec<Range<usize>>, Error> {
    let (mut end, mut blocks) = (0, memory::reserved(marks.len().div_ceil(BLOCK))?);
    for (first, marks) in (first..).step_by(BLOCK).zip(marks.chunks(BLOCK)) {
        let start = end;
        for (v, &mark) in (first..).zip(marks) {
            // The next one takes the place if this is no inner vertex: cheaper than to ask, since nobody foretells it.
            let Some(place) = own.get_mut(end) else { break };
            *place = v;
            end += usize::from(mark == INNER);
        }
        blocks.push(start..end);
    }
    Ok(blocks)
}

/// Tasks one behind the other.
fn lots(start: usize, turns: Vec<Vec<Turn>>) -> Vec<Lot> {
    let mut end = start;
    let lot = |turns: Vec<Turn>| {
        let start = end;
        end += turns.iter().map(|turn| usize::from(turn.size)).sum::<usize>();
        Lot { vertices: start..end, turns }
    };
    turns.into_iter().map(lot).collect()
}

impl Surroundings<'_> {
    /// Whether a vertex may move, and if so whether it is inside its block.
    fn mark(&self, v: u32) -> u8 {
        if !self.features.role(v).moves() {
            return STAYS;
        }
        let rim = self.stars.rim_of_disc(v);
        let is_inside = |&r: &u32| ((r ^ v) as usize) < BLOCK || !self.features.role(r).moves();
        if lies_in_block(rim, v) || rim.iter().all(is_inside) { INNER } else { BORDER }
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

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::options::{Constraints, Options};
    use crate::preparation::Preparation;

    /// A flat grid of this many squares, its vertices numbered row by row, or all over the place.
    fn grid([columns, rows]: [u32; 2], shuffled: bool) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let count = (columns + 1) * (rows + 1);
        let number = |v: u32| if shuffled { (u64::from(v) * 7919 % u64::from(count)) as u32 } else { v };
        let mut positions = vec![[0.0; 3]; count as usize];
        for v in 0..count {
            positions[number(v) as usize] = [f64::from(v % (columns + 1)), f64::from(v / (columns + 1)), 0.0];
        }
        let squares = (0..rows).flat_map(|y| (0..columns).map(move |x| y * (columns + 1) + x));
        let halves = |a: u32| [[a, a + 1, a + columns + 2], [a, a + columns + 2, a + columns + 1]];
        let triangles = squares.flat_map(halves).map(|corners| corners.map(number)).collect();
        (positions, triangles)
    }

    /// Asserts that each inner vertex has its place, and no neighbours where they would meet. Returns how many tasks there
    /// are.
    fn check(squares: [u32; 2], shuffled: bool) -> usize {
        let (positions, triangles) = grid(squares, shuffled);
        let options = Options::default();
        let prepared =
            Preparation::new(positions.as_slice(), &triangles, &options, &Constraints::default(), &Threads::ONE)
                .unwrap();
        let around = prepared.surroundings(&options);
        let schedule = Schedule::new(&around, &Threads::ONE).unwrap();
        let several = Threads::with(3, 1_000_000, |threads| Schedule::new(&around, threads)).unwrap();
        assert!(several.rest() == schedule.rest() && several.rounds().skip(1).eq(schedule.rounds().skip(1)));
        let mut seen: Vec<u32> = schedule.rest().to_vec();
        for round in schedule.rounds() {
            let mut owners = HashMap::new();
            for (number, task) in round.iter().enumerate() {
                seen.extend(task.vertices);
                owners.extend(task.vertices.iter().map(|&v| (v, number)));
                assert_eq!(task.turns.iter().map(|turn| usize::from(turn.size)).sum::<usize>(), task.vertices.len());
                let mut left = task.vertices;
                for turn in task.turns {
                    let (own, others) = left.split_at(usize::from(turn.size));
                    let meets = |v: &u32| around.stars.rim(*v).iter().any(|r| own.contains(r));
                    assert!(!own.iter().any(meets), "neighbours in a turn");
                    left = others;
                }
            }
            let is_apart = |(v, own): (&u32, &usize)| {
                around.stars.rim(*v).iter().all(|r| owners.get(r).is_none_or(|other| other == own))
            };
            assert!(owners.iter().all(is_apart), "neighbours in two tasks of a round");
        }
        seen.sort_unstable();
        assert_eq!(seen, around.movable().unwrap());
        schedule.rounds().map(|round| round.len()).sum()
    }

    #[test]
    fn each_vertex_has_its_turn_and_no_neighbour_beside_it() {
        assert_eq!(check([3, 3], false), 1);
        check([40, 30], true);
        assert!(check([199, 399], false) > 4);
        assert!(check([199, 399], true) > 4);
        // More than one thread gives colours to, in rows that are longer than blocks.
        assert!(check([799, 399], false) > 4);
    }
}
