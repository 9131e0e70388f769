//! Stars on all threads: first the inside of each block of vertices, by index, then what lies between the blocks, by
//! colour.
//!
//! Stars that are visited at the same time don't read each other's centres, so the result is that of one thread.

use std::ops::Range;

use super::end::Tally;
use super::outcome::Outcomes;
use super::places::Places;
use super::schedule::{BLOCK, Schedule};
use super::surroundings::Surroundings;
use super::task::Task;
use super::visit::LoneVisitor;
use crate::error::Error;
use crate::progress::{self, Progress};
use crate::star::TOGETHER;
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
    let schedule = Schedule::new(around, threads)?;
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
        let Schedule { vertices, blocks, .. } = self.schedule;
        let blocks: Vec<Range<usize>> = ranges(0, blocks).collect();
        let tasks: Vec<_> = blocks.chunks(TOGETHER).map(|parts| Task::SideBySide { vertices, parts }).collect();
        self.at_once(tell, &tasks)
    }

    /// Visits what lies between the blocks, colour by colour, and at last what has no colour, one by one.
    fn colors(&mut self, tell: &mut Progress<'_>) -> Result<(), Error> {
        let Schedule { vertices, blocks, colors } = self.schedule;
        let inner = blocks.last().copied().unwrap_or(0);
        for color in ranges(inner, colors) {
            let tasks: Vec<_> = vertices[color].chunks(TASK).map(Task::Apart).collect();
            self.at_once(tell, &tasks)?;
        }
        let mut visitor = LoneVisitor::new(self.around);
        let rest = &vertices[colors.last().copied().unwrap_or(inner)..];
        rest.iter().for_each(|&v| visitor.visit(v, self.places, self.outcomes));
        self.tally += visitor.tally;
        self.visited += rest.len();
        Ok(())
    }

    /// Carries out tasks that don't wait for each other.
    fn at_once(&mut self, tell: &mut Progress<'_>, tasks: &[Task<'_>]) -> Result<(), Error> {
        let Self { around, places, outcomes, .. } = *self;
        for batch in tasks.chunks(if self.threads.is_one() { 1 } else { BATCH }) {
            progress::tell(tell, self.visited as f64 / self.total as f64)?;
            self.tally += self.threads.sum(0..batch.len(), |i| batch[i].carry_out(around, places, outcomes));
            self.visited += batch.iter().map(Task::size).sum::<usize>();
        }
        Ok(())
    }
}

/// The ranges with these ends, one behind the other.
fn ranges(start: usize, ends: &[usize]) -> impl Iterator<Item = Range<usize>> {
    let starts = std::iter::once(start).chain(ends.iter().copied());
    starts.zip(ends).map(|(start, &end)| start..end)
}
