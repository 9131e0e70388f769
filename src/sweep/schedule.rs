//! Which stars can be visited at once: blocks of vertices, and colours for what lies between the blocks.

use std::ops::Range;

use super::surroundings::Surroundings;
use super::task::Task;
use super::turns::{self, Turn};
use crate::error::Error;
use crate::memory;
use crate::star::TOGETHER;
use crate::threads::{PART, Threads};

/// Vertices of consecutive numbers that make a block: a power of two.
pub(super) const BLOCK: usize = 512;

/// Colours at most. Vertices for which none is left are visited one by one.
const COLORS: usize = 63;

/// Vertices of a task, at most.
const TASK: usize = BLOCK * TOGETHER;

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
const STAYS: u8 = 255;
const INNER: u8 = 191;
const BORDER: u8 = 127;
const _: () = assert!(STAYS % 64 == 63 && INNER % 64 == 63 && BORDER % 64 == 63 && COLORS == 63);

impl Schedule {
    pub fn new(around: &Surroundings<'_>, threads: &Threads<'_>) -> Result<Self, Error> {
        let mut marks = memory::filled(STAYS, around.stars.len())?;
        threads.each(marks.chunks_mut(PART).enumerate().collect(), |(part, marks)| {
            for (v, mark) in ((part * PART) as u32..).zip(marks) {
                *mark = around.mark(v);
            }
        });
        let count = marks.iter().filter(|&&mark| mark != STAYS).count();
        let mut schedule = Self { vertices: memory::filled(0, count)?, rounds: Vec::new() };
        let inner = schedule.add_blocks(around, &marks, threads)?;
        let counts = greedy(around, &mut marks);
        schedule.add_border(around, inner, (&marks, counts), threads);
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
        let (mut end, mut blocks) = (0, memory::reserved(marks.len().div_ceil(BLOCK))?);
        for (block, marks) in marks.chunks(BLOCK).enumerate() {
            let (start, first) = (end, (block * BLOCK) as u32);
            for (v, &mark) in (first..).zip(marks) {
                // The next one takes the place if this is no inner vertex: cheaper than to ask, since nobody foretells it.
                let Some(place) = self.vertices.get_mut(end) else { break };
                *place = v;
                end += usize::from(mark == INNER);
            }
            blocks.push(start..end);
        }
        let (mut work, mut left) = (Vec::new(), &mut self.vertices[..end]);
        for parts in blocks.chunks(TOGETHER) {
            let (own, others) = left.split_at_mut(parts.iter().map(ExactSizeIterator::len).sum());
            work.push((parts, own));
            left = others;
        }
        let turns = threads.map_each(work, |(parts, own)| turns::side_by_side(around, own, parts));
        self.rounds.push(lots(0, turns.into_iter().collect::<Result<_, _>>()?));
        Ok(end)
    }

    /// Adds the border from place `first` on, colour by colour; how many there are of each comes with the marks.
    fn add_border(
        &mut self,
        around: &Surroundings<'_>,
        first: usize,
        (marks, counts): (&[u8], [usize; COLORS + 1]),
        threads: &Threads<'_>,
    ) {
        let mut next = [first; COLORS + 2];
        for color in 0..=COLORS {
            next[color + 1] = next[color] + counts[color];
        }
        let starts = next;
        for (v, &mark) in (0..).zip(marks) {
            if let Some(next) = next[..=COLORS].get_mut(usize::from(mark)) {
                self.vertices[*next] = v;
                *next += 1;
            }
        }
        for (color, &start) in starts[..COLORS].iter().enumerate().filter(|&(color, _)| counts[color] > 0) {
            let own = self.vertices[start..starts[color + 1]].chunks_mut(TASK).collect();
            self.rounds.push(lots(start, threads.map_each(own, |own| turns::apart(around, own))));
        }
    }
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

/// Gives each vertex of the border, by index, the first colour that none of its neighbours there has. Returns how many there
/// are of each colour, and for how many none was left.
fn greedy(around: &Surroundings<'_>, marks: &mut [u8]) -> [usize; COLORS + 1] {
    let mut counts = [0; COLORS + 1];
    for v in 0..marks.len() {
        if marks[v] != BORDER {
            continue;
        }
        // The last bit is no colour's, and may be set or not.
        let rim = around.stars.rim_of_disc(v as u32);
        let taken = rim.iter().fold(0_u64, |taken, &r| taken | 1 << (marks[r as usize] % 64));
        let color = (taken.trailing_ones() as usize).min(COLORS);
        marks[v] = color as u8;
        counts[color] += 1;
    }
    counts
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
    }
}
