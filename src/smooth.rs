//! The whole way: buffers in, validated mesh, stars, features, sweeps, report, buffers out.

use std::ops::Range;
use std::time::Instant;

use crate::deviation::Surface;
use crate::error::Error;
use crate::features::Role;
use crate::mesh::{Coordinate, Positions, Vertices, in_units, stored};
use crate::options::{Constraints, Options, Order};
use crate::preparation::{Preparation, check_constraints};
use crate::progress::{self, Progress};
use crate::quality::Measurement;
use crate::renumbering::Renumbering;
use crate::report::{Kept, Report, Seconds};
use crate::sweep::{self, Outcome, Outcomes, Surroundings, Tally};
use crate::threads::Threads;

/// Improves the triangles of a mesh by moving its vertices.
///
/// `positions` are changed in place; `triangles` (corner indices, counter-clockwise or clockwise, but consistent) never.
/// The enclosed volume of a closed mesh stays as it is, and no triangle below the quality floor gets worse.
/// On an error nothing has changed.
///
/// # Errors
/// [`Error::BadOption`], [`Error::TooLarge`], [`Error::IndexOutOfRange`], [`Error::NonFinite`], [`Error::LockLength`],
/// [`Error::FeatureEdgeOutOfRange`], [`Error::SeedLength`], [`Error::VisitOutOfRange`], [`Error::OutOfMemory`], and [`Error::Cancelled`] if `progress` says so.
///
/// Method: Egorova, Savchenko, Hagiwara, Savchenko, "Modeling of Quality Parameter Values for Improving Meshes" (2007).
pub fn smooth<T: Coordinate>(
    positions: &mut [[T; 3]],
    triangles: &[[u32; 3]],
    options: &Options,
    constraints: &Constraints<'_>,
    progress: &mut Progress<'_>,
) -> Result<Report, Error> {
    smooth_vertices(positions, triangles, options, constraints, progress)
}

/// [`smooth`] for positions wherever they lie.
pub(crate) fn smooth_vertices<T: Coordinate>(
    positions: &mut (impl Vertices<T> + ?Sized),
    triangles: &[[u32; 3]],
    options: &Options,
    constraints: &Constraints<'_>,
    progress: &mut Progress<'_>,
) -> Result<Report, Error> {
    options.validate()?;
    check_constraints(constraints, positions.count())?;
    Threads::with(options.threads, positions.count(), |threads| {
        let clock = Instant::now();
        // Every other order is one of the caller's numbers.
        let numbers = match options.order {
            Order::Colors => Renumbering::if_worthwhile(positions, triangles, threads)?,
            _ => None,
        };
        let Some(numbers) = numbers else {
            return smooth_on(threads, positions, triangles, options, constraints, progress);
        };
        let constraints = numbers.constraints(constraints)?;
        let renumbering = clock.elapsed().as_secs_f64();
        let (vertices, constraints) = (&mut numbers.vertices(positions), constraints.as_constraints());
        let mut report = smooth_on(threads, vertices, &numbers.triangles, options, &constraints, progress)?;
        report.seconds.adjacency += renumbering;
        report.seconds.total += renumbering;
        Ok(report)
    })
}

fn smooth_on<T: Coordinate>(
    threads: &Threads<'_>,
    positions: &mut (impl Vertices<T> + ?Sized),
    triangles: &[[u32; 3]],
    options: &Options,
    constraints: &Constraints<'_>,
    progress: &mut Progress<'_>,
) -> Result<Report, Error> {
    let prepared = threads.stay(|| Preparation::new(&*positions, triangles, options, constraints, threads))?;
    progress::tell(progress, 0.0)?;
    let (new, report) = sweeps(&prepared, options, constraints, threads, progress)?;
    progress::tell(progress, 1.0)?;
    let unit = prepared.mesh.unit;
    drop(prepared);
    let changed = |v: usize, before| (in_units(before, unit) != new.at(v)).then(|| stored(new.at(v), unit));
    positions.set(changed, threads);
    Ok(report)
}

/// The sweeps over a prepared mesh: new positions, and the report.
pub(crate) fn sweeps(
    prepared: &Preparation<'_>,
    options: &Options,
    constraints: &Constraints<'_>,
    threads: &Threads<'_>,
    progress: &mut Progress<'_>,
) -> Result<(Positions<'static>, Report), Error> {
    let clock = Instant::now();
    let around = prepared.surroundings(options);
    let outcomes = Outcomes::new(prepared.mesh.positions.len(), threads)?;
    let (new, tally) = sweep::run(&around, &outcomes, options, constraints, threads, progress)?;
    let sweeps = clock.elapsed().as_secs_f64();

    let mut report = count(&around, &new, &outcomes, tally, threads);
    let (adjacency, features) = (prepared.adjacency, prepared.finding);
    report.seconds = Seconds { total: adjacency + features + sweeps, adjacency, features, sweeps, tail: 0.0 };
    if options.measure {
        measure_into(&mut report, &around, &new, threads)?;
    }
    Ok((new, report))
}

fn count(
    around: &Surroundings<'_>,
    new: &Positions<'_>,
    outcomes: &Outcomes,
    tally: Tally,
    threads: &Threads<'_>,
) -> Report {
    let parts = threads.parts(new.len(), |part| count_part(around, new, outcomes, part));
    let (moved, kept) =
        parts.into_iter().fold((0, Kept::default()), |(moved, kept), part| (moved + part.0, kept + part.1));
    Report {
        moved,
        kept,
        skipped_triangles: around.mesh.triangles.len() - around.stars.triangle_count(),
        feature_edges: around.features.edge_count,
        moves_halved: tally.halved,
        moves_refused: tally.refused,
        ..Report::default()
    }
}

/// Counts what became of each vertex of a part: how many have moved, and why the others have not.
fn count_part(
    around: &Surroundings<'_>,
    new: &Positions<'_>,
    outcomes: &Outcomes,
    part: Range<usize>,
) -> (usize, Kept) {
    let (mut moved, mut kept) = (0, Kept::default());
    for v in part {
        let reason = match (around.features.role(v as u32), outcomes.get(v as u32)) {
            _ if new.at(v) != around.mesh.positions.at(v) => &mut moved,
            (Role::Unreferenced, _) => &mut kept.unreferenced,
            (Role::Locked, _) => &mut kept.locked,
            (Role::NonManifold, _) => &mut kept.non_manifold,
            (Role::Boundary, _) => &mut kept.boundary,
            (Role::Corner, _) => &mut kept.corner,
            (_, Outcome::Degenerate) => &mut kept.degenerate,
            (_, Outcome::Guard) => &mut kept.guard,
            (_, Outcome::Deviation) => &mut kept.deviation,
            (_, Outcome::Settled | Outcome::Moved | Outcome::Unvisited) => &mut kept.settled,
        };
        *reason += 1;
    }
    (moved, kept)
}

fn measure_into(
    report: &mut Report,
    around: &Surroundings<'_>,
    new: &Positions<'_>,
    threads: &Threads<'_>,
) -> Result<(), Error> {
    let mesh = around.mesh;
    report.before = Measurement::of(&mesh.positions, mesh.triangles, mesh.unit, threads)?;
    report.after = Measurement::of(new, mesh.triangles, mesh.unit, threads)?;
    report.volume_relative_change = report.after.volume_change_from(&report.before);
    report.max_deviation = Surface::new(mesh, around.stars).farthest(new, |_| true, threads) * mesh.unit;
    Ok(())
}
