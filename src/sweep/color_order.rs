//! Stars on all threads: first what is inside blocks or shares of the mesh, then by colour what lies between them.
//!
//! Stars that are visited at the same time don't read each other's centres, so the result is that of one thread.

use super::end::Tally;
use super::outcome::Outcomes;
use super::places::Places;
use super::schedule::Schedule;
use super::surroundings::Surroundings;
use super::task::Task;
use super::visit::LoneVisitor;
use crate::error::Error;
use crate::progress::{self, Progress};
use crate::star::Cones;
use crate::threads::Threads;

/// Vertices that are given to several threads before the host is told of progress, and all threads wait for the last one. Where
/// there are no more, the colours follow each other without a word to the host.
const BATCH: usize = 1 << 20;

/// The same for each thread in tasks inside blocks or shares.
const BATCH_INSIDE: usize = 16;

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
    let total = (iterations as usize * schedule.len()).max(1);
    let mut sweeps =
        Sweeps { around, places, outcomes, threads, schedule: &schedule, visited: 0, total, tally: Tally::default() };
    for _ in 0..iterations {
        sweeps.inside(tell)?;
        if threads.is_one() || schedule.len() > BATCH {
            sweeps.between(tell)?;
        } else {
            progress::tell(tell, sweeps.done())?;
            threads.stay(|| sweeps.between(&mut progress::silent))?;
        }
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
    /// The share of all visits that is done.
    fn done(&self) -> f64 {
        self.visited as f64 / self.total as f64
    }

    /// Visits what is between blocks or shares.
    fn between(&mut self, tell: &mut Progress<'_>) -> Result<(), Error> {
        for round in self.schedule.between() {
            self.at_once(tell, &round)?;
        }
        self.one_by_one();
        Ok(())
    }

    /// Visits what is in no task.
    fn one_by_one(&mut self) {
        let (mut visitor, rest) = (LoneVisitor::new(self.around), self.schedule.rest());
        rest.iter().for_each(|&v| visitor.visit(v, self.places, self.outcomes));
        self.tally += visitor.tally;
        self.visited += rest.len();
    }

    /// Visits what is inside blocks or shares, several of which at once.
    fn inside(&mut self, tell: &mut Progress<'_>) -> Result<(), Error> {
        let Self { around, places, outcomes, threads, .. } = *self;
        let mut tasks = self.schedule.inside();
        while tasks.len() > 0 {
            progress::tell(tell, self.done())?;
            let batch = tasks.by_ref().take(if threads.is_one() { 1 } else { BATCH_INSIDE * threads.count() });
            let done = threads.map_each(batch.collect(), |tasks| {
                let carry_out = |task: Task<'_>| {
                    let cones = around.cones_of(task)?;
                    let around = Surroundings { cones: cones.as_ref().or(around.cones), ..*around };
                    Ok((task.carry_out(&around, places, outcomes), task.vertices.len()))
                };
                tasks.map(carry_out).collect::<Result<Vec<_>, Error>>()
            });
            for (tally, visited) in done.into_iter().collect::<Result<Vec<_>, Error>>()?.into_iter().flatten() {
                self.tally += tally;
                self.visited += visited;
            }
        }
        Ok(())
    }

    /// Carries out tasks that don't wait for each other.
    fn at_once(&mut self, tell: &mut Progress<'_>, tasks: &[Task<'_>]) -> Result<(), Error> {
        let Self { around, places, outcomes, .. } = *self;
        let mut left = tasks;
        while !left.is_empty() {
            progress::tell(tell, self.done())?;
            let (batch, others) = left.split_at(if self.threads.is_one() { 1 } else { batch(left) });
            self.tally += self.threads.sum(0..batch.len(), |i| batch[i].carry_out(around, places, outcomes));
            self.visited += batch.iter().map(|task| task.vertices.len()).sum::<usize>();
            left = others;
        }
        Ok(())
    }
}

impl Surroundings<'_> {
    /// The cones of a task, if they are to be looked for.
    fn cones_of(&self, task: Task<'_>) -> Result<Option<Cones>, Error> {
        let Some(finder) = self.cone_finder else { return Ok(None) };
        let (first, last) = (task.vertices.iter().min(), task.vertices.iter().max());
        let vertices = first.map_or(0, |&v| v as usize)..last.map_or(0, |&v| v as usize + 1);
        finder.some(self.mesh, self.stars, vertices).map(Some)
    }
}

/// How many tasks make a batch.
fn batch(tasks: &[Task<'_>]) -> usize {
    let mut vertices = 0;
    let is_full = |task: &Task<'_>| {
        vertices += task.vertices.len();
        vertices >= BATCH
    };
    tasks.iter().position(is_full).map_or(tasks.len(), |last| last + 1)
}

#[cfg(test)]
mod tests {
    use super::super::schedule::LARGE;
    use super::*;
    use crate::mesh::Positions;
    use crate::options::{Constraints, Options};
    use crate::preparation::Preparation;
    use crate::star::ConeFinder;

    /// A bumpy grid that is large.
    fn grid() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        const COLUMNS: u32 = 700;
        let bump = |v: u32| f64::from(v.wrapping_mul(0x9e37_79b9) >> 16) / 65536.0;
        let at = |v: u32| {
            [f64::from(v % COLUMNS) + 0.7 * bump(v), f64::from(v / COLUMNS) + 0.7 * bump(v + 7), 0.4 * bump(v + 9)]
        };
        let positions: Vec<_> = (0..LARGE as u32 + 100 * COLUMNS).map(at).collect();
        let corners = (0..positions.len() as u32 - COLUMNS - 1).filter(|v| v % COLUMNS < COLUMNS - 1);
        let halves = |a: u32| [[a, a + 1, a + COLUMNS + 1], [a, a + COLUMNS + 1, a + COLUMNS]];
        let triangles = corners.flat_map(halves).collect();
        (positions, triangles)
    }

    fn swept(around: &Surroundings<'_>, threads: u32) -> Positions<'static> {
        Threads::with(threads, around.stars.len(), |threads| {
            let places = Places::new(&around.mesh.positions, threads).expect("memory");
            let outcomes = Outcomes::new(around.stars.len(), threads).expect("memory");
            run(around, &places, &outcomes, 1, threads, &mut progress::silent).expect("sweeps");
            places.into_positions()
        })
    }

    #[test]
    fn cones_and_threads_change_no_bit() {
        let ((positions, triangles), options) = (grid(), Options::default());
        let free = Constraints::default();
        let prepared =
            Preparation::new(positions.as_slice(), &triangles, &options, &free, &Threads::ONE).expect("a mesh");
        let around = prepared.surroundings(&options);
        let expected = swept(&around, 1);
        let finder = ConeFinder::new(around.mesh);
        assert!(around.cones.is_some() && expected != around.mesh.positions);
        for (cone_finder, threads) in [(Some(finder), 1), (Some(finder), 3), (None, 1), (None, 3)] {
            let around = Surroundings { cones: None, cone_finder, ..around };
            assert!(swept(&around, threads) == expected, "{cone_finder:?}, {threads} threads");
        }
        assert!(swept(&around, 3) == expected, "three threads");
    }
}
