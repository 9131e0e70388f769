//! Which stars can be visited at once: blocks of vertices, and colours for what lies between the blocks.

use std::ops::Range;

use super::colors::{self, COLORS, Counts, SEAM, SHARE};
use super::surroundings::Surroundings;
use super::task::Task;
use super::turns::{self, Turn};
use crate::error::Error;
use crate::memory;
use crate::star::{LANES, TOGETHER};
use crate::threads::{PART, Threads};

/// Vertices of consecutive numbers that make a block: a power of two.
pub(super) const BLOCK: usize = 512;

/// Vertices of a task between the blocks, at most: few enough for all threads to end at about the same time.
const TASK: usize = 128 * TOGETHER;

/// The vertices that may move, in the order of their visits. It depends on the mesh alone.
pub(super) struct Schedule {
    /// Share by share of the mesh, first the inner vertices of the blocks: their neighbours lie in their own block, or don't move.
    /// Then by colour those that have neighbours in other blocks, but not in other shares: no two of one colour are neighbours.
    /// Then those of the seams between all shares, by colour. Then those that no colour was left for.
    vertices: Vec<u32>,
    /// For each share its rounds, which wait for each other, but not for those of other shares.
    shares: Vec<Vec<Round>>,
    /// Those of the seams.
    seams: Vec<Round>,
}

/// Tasks that don't wait for each other.
type Round = Vec<Lot>;

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
        let counts = colors::give(around, &mut marks, threads);
        let mut vertices = threads.filled(0, counts.iter().map(Counts::total).sum())?;
        let places = places(&marks, &counts, &mut vertices);
        let shares = threads.map_each(places, |share| share.arrange(around, threads));
        let shares = shares.into_iter().collect::<Result<Vec<_>, Error>>()?;
        let first = counts.iter().map(Counts::own).sum();
        let sizes = |color: usize| counts.iter().map(|counts| counts.marked[SEAM + color]).sum();
        let seams = by_color(around, first, &mut vertices[first..], sizes, threads);
        Ok(Self { vertices, shares, seams })
    }

    /// How many vertices there are.
    pub fn len(&self) -> usize {
        self.vertices.len()
    }

    /// For each share its rounds, which wait for each other, but not for those of other shares.
    pub fn shares(&self) -> impl ExactSizeIterator<Item = impl Iterator<Item = Vec<Task<'_>>>> {
        self.shares.iter().map(|rounds| rounds.iter().map(|round| self.tasks(round).collect()))
    }

    /// The same, the first rounds of all shares at once, then the second ones, and so on.
    pub fn rounds(&self) -> impl Iterator<Item = Vec<Task<'_>>> {
        let most = self.shares.iter().map(Vec::len).max().unwrap_or(0);
        (0..most)
            .map(|nth| self.shares.iter().filter_map(|rounds| rounds.get(nth)).flat_map(|r| self.tasks(r)).collect())
    }

    /// What comes after all shares, round by round.
    pub fn seams(&self) -> impl Iterator<Item = Vec<Task<'_>>> {
        self.seams.iter().map(|round| self.tasks(round).collect())
    }

    fn tasks<'a>(&'a self, round: &'a Round) -> impl Iterator<Item = Task<'a>> {
        round.iter().map(|lot| Task { vertices: &self.vertices[lot.vertices.clone()], turns: &lot.turns })
    }

    /// The vertices that are in no task, to be visited one by one.
    pub fn rest(&self) -> &[u32] {
        let last = |rounds: &Vec<Round>| rounds.last().and_then(|round| round.last()).map(|lot| lot.vertices.end);
        let end = last(&self.seams).or_else(|| self.shares.iter().rev().find_map(last));
        &self.vertices[end.unwrap_or(0)..]
    }
}

/// A share of the mesh, and the places for its vertices in the schedule.
struct Share<'a> {
    /// Number of its first vertex.
    first: usize,
    marks: &'a [u8],
    counts: &'a Counts,
    /// For the inner vertices of its blocks and behind them for those with a colour, and where that begins in the schedule.
    own: (usize, &'a mut [u32]),
    /// For each colour of the seams.
    seams: Vec<&'a mut [u32]>,
    /// For those that no colour was left for.
    rest: &'a mut [u32],
}

/// Gives each share of the mesh its places.
fn places<'a>(marks: &'a [u8], counts: &'a [Counts], vertices: &'a mut [u32]) -> Vec<Share<'a>> {
    let (mut left, mut begin) = (vertices, 0);
    let mut take = |count: usize| {
        let (own, others) = std::mem::take(&mut left).split_at_mut(count);
        (left, begin) = (others, begin + count);
        (begin - count, own)
    };
    let share = |(share, (marks, counts)): (usize, (&'a [u8], &'a Counts))| {
        let own = take(counts.own());
        Share { first: share * SHARE, marks, counts, own, seams: Vec::new(), rest: &mut [] }
    };
    let mut shares: Vec<_> = marks.chunks(SHARE).zip(counts).enumerate().map(share).collect();
    for color in 0..COLORS {
        shares.iter_mut().for_each(|share| share.seams.push(take(share.counts.marked[SEAM + color]).1));
    }
    shares.iter_mut().for_each(|share| share.rest = take(share.counts.rest()).1);
    shares
}

impl Share<'_> {
    /// Fills in the vertices and arranges them.
    fn arrange(self, around: &Surroundings<'_>, threads: &Threads<'_>) -> Result<Vec<Round>, Error> {
        let (begin, own) = self.own;
        let (inner, colored) = own.split_at_mut(self.counts.inner);
        let sizes = |color: usize| self.counts.marked[color];
        colors::sort(self.first as u32, self.marks, colored, sizes, (self.seams, self.rest));
        let mut rounds = vec![blocks(around, (begin, inner), (self.first as u32, self.marks), threads)?];
        rounds.extend(by_color(around, begin + inner.len(), colored, sizes, threads));
        Ok(rounds)
    }
}

/// The inside of all blocks, several blocks side by side.
fn blocks(
    around: &Surroundings<'_>,
    (begin, mut inner): (usize, &mut [u32]),
    (mut first, marks): (u32, &[u8]),
    threads: &Threads<'_>,
) -> Result<Round, Error> {
    let mut work = Vec::new();
    for marks in marks.chunks(BLOCK * blocks_at_once(marks.len(), threads)) {
        let (own, others) = inner.split_at_mut(marks.iter().filter(|&&mark| mark == INNER).count());
        work.push((first, marks, own));
        (first, inner) = (first + marks.len() as u32, others);
    }
    let turns = threads.map_each(work, |(first, marks, own)| {
        let blocks = fill(own, first, marks)?;
        turns::side_by_side(around, own, &blocks)
    });
    Ok(lots(begin, turns.into_iter().collect::<Result<_, _>>()?))
}

/// What lies between the blocks, colour by colour: so many of each colour from the beginning of a list on, which begins at a
/// place of the schedule.
fn by_color(
    around: &Surroundings<'_>,
    mut begin: usize,
    mut list: &mut [u32],
    sizes: impl Fn(usize) -> usize,
    threads: &Threads<'_>,
) -> Vec<Round> {
    let mut rounds = Vec::new();
    for size in (0..COLORS).map(sizes).filter(|&size| size > 0) {
        let (own, others) = list.split_at_mut(size);
        rounds.push(lots(begin, threads.map_each(own.chunks_mut(TASK).collect(), |own| turns::apart(around, own))));
        (begin, list) = (begin + size, others);
    }
    rounds
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
        assert!(several.rest() == schedule.rest() && several.seams().eq(schedule.seams()));
        assert!(several.rounds().skip(1).eq(schedule.rounds().skip(1)));
        let mut seen: Vec<u32> = schedule.rest().to_vec();
        for round in schedule.rounds().chain(schedule.seams()) {
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
        schedule.rounds().chain(schedule.seams()).map(|round| round.len()).sum()
    }

    #[test]
    fn each_vertex_has_its_turn_and_no_neighbour_beside_it() {
        assert_eq!(check([3, 3], false), 1);
        check([40, 30], true);
        assert!(check([199, 399], false) > 4);
        assert!(check([199, 399], true) > 4);
        // Several shares, in rows that are longer than blocks.
        assert!(check([799, 399], false) > 4);
        assert!(check([799, 399], true) > 4);
    }
}
