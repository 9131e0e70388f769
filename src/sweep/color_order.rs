//! Stars on all threads: first the inside of each block of vertices, by index, then what lies between the blocks, by
//! colour.
//!
//! Stars that are visited at the same time don't read each other's centres, so the result is that of one thread.

use std::ops::Range;

use fearless_simd::{Level, Simd, dispatch};

use super::outcome::Outcomes;
use super::places::Places;
use super::schedule::{BLOCK, Schedule};
use super::visit::{Surroundings, TOGETHER, Tally, Visitor};
use crate::error::Error;
use crate::progress::{self, Progress};
use crate::threads::Threads;

/// Vertices of a task.
const TASK: usize = BLOCK * TOGETHER;

/// Tasks that are given to several threads before the host is told of progress.
const BATCH: usize = 32;

/// Sweeps `iterations` times over all vertices. `tell` hears the share of the sweeps that is done.
pub(super) fn run(
    around: &Surroundings<'_>,
    places: &Places,
    outcomes: &Outcomes,
    iterations: u32,
    threads: &Threads<'_>,
    tell: &mut Progress<'_>,
) -> Result<Tally, Error> {
    let schedule = Schedule::new(around)?;
    // Where nothing can move there is still a share to tell.
    let total = (iterations as usize * schedule.vertices.len()).max(1);
    let mut sweeps =
        Sweeps { around, places, outcomes, threads, schedule: &schedule, visited: 0, total, tally: Tally::default() };
    for _ in 0..iterations {
        sweeps.blocks(tell)?;
        sweeps.colors(tell)?;
    }
    Ok(sweeps.tally)
}

/// Where the sweeps stand.
struct Sweeps<'a> {
    around: &'a Surroundings<'a>,
    places: &'a Places,
    outcomes: &'a Outcomes,
    threads: &'a Threads<'a>,
    schedule: &'a Schedule,
    visited: usize,
    total: usize,
    tally: Tally,
}

impl Sweeps<'_> {
    /// Visits the insides of all blocks, several blocks side by side.
    fn blocks(&mut self, tell: &mut Progress<'_>) -> Result<(), Error> {
        let blocks: Vec<Range<usize>> = ranges(0, &self.schedule.blocks).collect();
        let tasks: Vec<&[Range<usize>]> = blocks.chunks(TOGETHER).collect();
        self.at_once(
            tell,
            &tasks,
            |task| task.iter().map(ExactSizeIterator::len).sum(),
            |sweeps, task| {
                let mut visitor = Visitor::new(sweeps.around);
                dispatch!(Level::new(), simd => sweeps.side_by_side(simd, &mut visitor, task));
                visitor.tally
            },
        )
    }

    /// Visits what lies between the blocks, colour by colour, and at last what has no colour, one by one.
    fn colors(&mut self, tell: &mut Progress<'_>) -> Result<(), Error> {
        let Schedule { vertices, blocks, colors } = self.schedule;
        let inner = blocks.last().copied().unwrap_or(0);
        for color in ranges(inner, colors) {
            let tasks: Vec<&[u32]> = vertices[color].chunks(TASK).collect();
            self.at_once(tell, &tasks, |task| task.len(), |sweeps, task| sweeps.visit(task, TOGETHER))?;
        }
        let rest = &vertices[colors.last().copied().unwrap_or(inner)..];
        self.tally += self.visit(rest, 1);
        self.visited += rest.len();
        Ok(())
    }

    /// Carries out tasks that don't wait for each other.
    fn at_once<T: Copy + Sync>(
        &mut self,
        tell: &mut Progress<'_>,
        tasks: &[T],
        size: impl Fn(T) -> usize,
        work: impl Fn(&Self, T) -> Tally + Sync,
    ) -> Result<(), Error> {
        for batch in tasks.chunks(if self.threads.is_one() { 1 } else { BATCH }) {
            progress::tell(tell, self.visited as f64 / self.total as f64)?;
            let tally = self.threads.sum(0..batch.len(), |i| work(self, batch[i]));
            self.tally += tally;
            self.visited += batch.iter().map(|&task| size(task)).sum::<usize>();
        }
        Ok(())
    }

    /// Visits vertices, of which as many as `together` says in a row are no neighbours.
    fn visit(&self, vertices: &[u32], together: usize) -> Tally {
        let mut visitor = Visitor::new(self.around);
        dispatch!(Level::new(), simd => {
            for vertices in vertices.chunks(together) {
                visitor.visit(simd, vertices, self.places, self.outcomes);
            }
        });
        visitor.tally
    }

    /// Visits the first vertices of all blocks, then the second ones, and so on.
    #[inline(always)]
    fn side_by_side<S: Simd>(&self, simd: S, visitor: &mut Visitor<'_>, blocks: &[Range<usize>]) {
        for step in 0..BLOCK {
            let mut together = [0; TOGETHER];
            let mut count = 0;
            for block in blocks.iter().filter(|block| step < block.len()) {
                together[count] = self.schedule.vertices[block.start + step];
                count += 1;
            }
            visitor.visit(simd, &together[..count], self.places, self.outcomes);
        }
    }
}

/// The ranges with these ends, one behind the other.
fn ranges(start: usize, ends: &[usize]) -> impl Iterator<Item = Range<usize>> {
    let starts = std::iter::once(start).chain(ends.iter().copied());
    starts.zip(ends).map(|(start, &end)| start..end)
}
