//! Treating the tail, alone or after smoothing: buffers in, shorter buffers out.

use crate::deviation::Surface;
use crate::error::Error;
use crate::memory;
use crate::mesh::{self, Coordinate, Mesh, Positions};
use crate::options::{Constraints, Options};
use crate::preparation::Preparation;
use crate::progress::{self, Progress};
use crate::quality::Measurement;
use crate::report::Report;
use crate::smooth;
use crate::sweep::Surroundings;
use crate::tail::{self, Outcome, Sources, TailOptions, TailReport};
use crate::threads::Threads;

/// Share of the work that the sweeps are taken for.
const SWEEPS: f64 = 0.7;

/// What [`improve`] did.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Improvement {
    /// The sweeps: `after` is the mesh between the two stages.
    pub smoothing: Report,
    /// The treatment of the tail. Its `before`, and all that it compares with, is the mesh as it came into the call.
    pub tail: TailReport,
}

/// Cures the triangles that no sweep can help, by moves, flips, collapses and removals, worst first.
///
/// Both buffers are changed in place and get shorter. Surviving vertices keep their order, vertices that need not move
/// their bits, untouched triangles their vertices, order and winding. The volume of a closed mesh stays as it is; features,
/// the boundary and locked vertices stay where they are. `sources` is overwritten. Of `options` the number of iterations
/// has no meaning here. On an error nothing has changed.
///
/// # Errors
/// As for [`smooth`](crate::smooth), and [`Error::MaskLength`].
pub fn collapse_tails<T: Coordinate>(
    positions: &mut Vec<[T; 3]>,
    triangles: &mut Vec<[u32; 3]>,
    options: &Options,
    tail: &TailOptions<'_>,
    constraints: &Constraints<'_>,
    sources: &mut Sources,
    progress: &mut Progress<'_>,
) -> Result<TailReport, Error> {
    check(options, tail, triangles)?;
    let output = Threads::with(options.threads, positions.len(), |threads| {
        let prepared = Preparation::new(positions.as_slice(), triangles, options, constraints, threads)?;
        progress::tell(progress, 0.0)?;
        let around = prepared.surroundings(options);
        let start = prepared.mesh.positions.doubled()?;
        let mut outcome = tail::run(&around, start, tail, progress)?;
        if options.measure {
            let Mesh { positions, triangles, unit, .. } = around.mesh;
            outcome.report.before = Measurement::of(positions, triangles, *unit, threads)?;
            measure(&around, &mut outcome, threads)?;
        }
        Output::new(&prepared.mesh, positions, outcome)
    })?;
    progress::tell(progress, 1.0)?;
    Ok(output.deliver(positions, triangles, sources))
}

/// [`smooth`](crate::smooth), then [`collapse_tails`], in one call: features, deviations and the original surface are
/// those of the mesh as it came in.
///
/// # Errors
/// As for [`smooth`](crate::smooth), and [`Error::MaskLength`].
pub fn improve<T: Coordinate>(
    positions: &mut Vec<[T; 3]>,
    triangles: &mut Vec<[u32; 3]>,
    options: &Options,
    tail: &TailOptions<'_>,
    constraints: &Constraints<'_>,
    sources: &mut Sources,
    progress: &mut Progress<'_>,
) -> Result<Improvement, Error> {
    check(options, tail, triangles)?;
    let (smoothing, output) = Threads::with(options.threads, positions.len(), |threads| {
        let prepared = Preparation::new(positions.as_slice(), triangles, options, constraints, threads)?;
        progress::tell(progress, 0.0)?;
        let around = prepared.surroundings(options);
        let sweeps = &mut |done: f64| progress(SWEEPS * done);
        let (new, mut smoothing) = smooth::sweeps(&prepared, options, constraints, threads, sweeps)?;
        let rest = &mut |done: f64| progress(SWEEPS + (1.0 - SWEEPS) * done);
        let mut outcome = tail::run(&around, new.into_doubles()?, tail, rest)?;
        smoothing.seconds.tail = outcome.report.seconds;
        smoothing.seconds.total += outcome.report.seconds;
        if options.measure {
            outcome.report.before = smoothing.before;
            measure(&around, &mut outcome, threads)?;
        }
        Ok((smoothing, Output::new(&prepared.mesh, positions, outcome)?))
    })?;
    progress::tell(progress, 1.0)?;
    Ok(Improvement { smoothing, tail: output.deliver(positions, triangles, sources) })
}

fn check(options: &Options, tail: &TailOptions<'_>, triangles: &[[u32; 3]]) -> Result<(), Error> {
    options.validate()?;
    tail.validate()?;
    tail.check_mask(triangles.len())
}

fn measure(around: &Surroundings<'_>, outcome: &mut Outcome, threads: &Threads<'_>) -> Result<(), Error> {
    let Outcome { positions, triangles, sources, report, lost_height } = outcome;
    let mesh = around.mesh;
    let kept = Positions::doubles(sources.vertex.len(), |v| positions.at(sources.vertex[v] as usize), threads)?;
    report.after = Measurement::of(&kept, triangles, mesh.unit, threads)?;
    report.volume_relative_change = report.after.volume_change_from(&report.before);
    let farthest =
        Surface::new(mesh, around.stars).farthest(positions, |v| sources.vertex.binary_search(&v).is_ok(), threads);
    report.max_deviation = lost_height.max(farthest) * mesh.unit;
    Ok(())
}

/// Everything that goes out, ready, so that nothing can fail any more.
struct Output<T> {
    positions: Vec<[T; 3]>,
    triangles: Vec<[u32; 3]>,
    sources: Sources,
    report: TailReport,
}

impl<T: Coordinate> Output<T> {
    fn new(mesh: &Mesh<'_>, stored: &[[T; 3]], outcome: Outcome) -> Result<Self, Error> {
        let Outcome { positions: new, triangles, sources, report, .. } = outcome;
        let mut positions = memory::reserved(sources.vertex.len())?;
        positions.extend(sources.vertex.iter().map(|&v| {
            let v = v as usize;
            if new.at(v) == mesh.positions.at(v) { stored[v] } else { mesh::stored(new.at(v), mesh.unit) }
        }));
        Ok(Self { positions, triangles, sources, report })
    }

    fn deliver(self, positions: &mut Vec<[T; 3]>, triangles: &mut Vec<[u32; 3]>, sources: &mut Sources) -> TailReport {
        *positions = self.positions;
        *triangles = self.triangles;
        *sources = self.sources;
        self.report
    }
}
