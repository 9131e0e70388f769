//! The whole stage: tail in, compact mesh and report out.

use std::time::Instant;

use glam::DVec3;

use super::compact::{Compact, number};
use super::delaunay::Flipper;
use super::detect;
use super::leftovers;
use super::limits::Limits;
use super::live::Live;
use super::options::TailOptions;
use super::queue::Queue;
use super::report::TailReport;
use super::sources::Sources;
use super::treat::Surgeon;
use crate::error::Error;
use crate::mesh::Positions;
use crate::progress::Progress;
use crate::sweep::Surroundings;

/// Share of the work that general flips are taken for.
const FLIPS: f64 = 0.5;

/// What the stage leaves.
pub(crate) struct Outcome {
    /// Positions of all input vertices, in the mesh's units.
    pub positions: Positions<'static>,
    /// Output triangles, by output vertices.
    pub triangles: Vec<[u32; 3]>,
    pub sources: Sources,
    /// Counts, leftovers and time; nothing measured yet.
    pub report: TailReport,
    /// Greatest distance of a removed vertex from the triangles that took its place, in the mesh's units.
    pub lost_height: f64,
}

/// Treats the tail of the mesh with these positions.
pub(crate) fn run(
    around: &Surroundings<'_>,
    positions: Vec<DVec3>,
    options: &TailOptions<'_>,
    progress: &mut Progress<'_>,
) -> Result<Outcome, Error> {
    let clock = Instant::now();
    let limits = Limits::new(options);
    let mut live = Live::new(around.mesh, positions)?;
    let mut report = TailReport::default();
    if options.flips {
        report.tails_before = detect::tails(&live, &limits, options.mask).count();
        let mut flipper = Flipper::new(around, &limits, &live)?;
        flipper.run(&mut live, &mut |done| progress(FLIPS * done))?;
        report.general_flips = flipper.count;
    }
    let rest = &mut |done: f64| progress(if options.flips { FLIPS + (1.0 - FLIPS) * done } else { done });
    let mut surgeon = Surgeon::new(around, &limits);
    let mut queue = Queue::new(&live, &limits, options)?;
    if !options.flips {
        report.tails_before = queue.len();
    }
    queue.run(&mut live, &mut surgeon, &mut report, rest)?;

    let gone = live.gone()?;
    report.leftovers = leftovers::list(&live, &limits, &queue, |slot| number(&gone, slot))?;
    report.tails_after = report.leftovers.len();
    report.vertices_removed = live.removed.len();
    report.triangles_removed = gone.len();
    let (count, unchanged) = (live.triangles.len(), live.unchanged_count());
    report.triangles_unchanged = if count == 0 { 1.0 } else { unchanged as f64 / count as f64 };
    let lost_height = queue.lost_height;
    let Compact { positions, triangles, sources } = Compact::new(live, &gone)?;
    report.seconds = clock.elapsed().as_secs_f64();
    Ok(Outcome { positions: Positions::from_doubles(positions), triangles, sources, report, lost_height })
}
