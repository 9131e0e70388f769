//! The whole way: buffers in, validated mesh, stars, features, sweeps, report, buffers out.

use std::time::Instant;

use glam::DVec3;

use crate::deviation::Surface;
use crate::error::Error;
use crate::features::{Features, Role};
use crate::memory;
use crate::mesh::{Coordinate, Mesh, Stars, repeats_a_vertex};
use crate::options::{Constraints, Options};
use crate::progress::{self, Progress};
use crate::quality::Measurement;
use crate::report::{Kept, Report, Seconds};
use crate::star::Modelling;
use crate::sweep::{self, Outcome, Surroundings, Tally};

/// Improves the triangles of a mesh by moving its vertices.
///
/// `positions` are changed in place; `triangles` (corner indices, counter-clockwise or clockwise, but consistent) never.
/// The enclosed volume of a closed mesh stays as it is, and no triangle below the quality floor gets worse.
/// On an error nothing has changed.
///
/// # Errors
/// [`Error::BadOption`], [`Error::TooLarge`], [`Error::IndexOutOfRange`], [`Error::NonFinite`], [`Error::LockLength`],
/// [`Error::FeatureEdgeOutOfRange`], [`Error::OutOfMemory`], and [`Error::Cancelled`] if `progress` says so.
///
/// Method: Egorova, Savchenko, Hagiwara, Savchenko, "Modeling of Quality Parameter Values for Improving Meshes" (2007).
pub fn smooth<T: Coordinate>(
    positions: &mut [[T; 3]],
    triangles: &[[u32; 3]],
    options: &Options,
    constraints: &Constraints<'_>,
    progress: &mut Progress<'_>,
) -> Result<Report, Error> {
    options.validate()?;
    check_constraints(constraints, positions.len())?;
    progress::tell(progress, 0.0)?;
    let clock = Instant::now();
    let mesh = Mesh::new(positions, triangles)?;
    let stars = Stars::new(&mesh)?;
    let adjacency = clock.elapsed().as_secs_f64();
    let features = Features::new(&mesh, &stars, options, constraints)?;
    let features_done = clock.elapsed().as_secs_f64();

    let modelling = Modelling::new(options);
    let surroundings = Surroundings {
        mesh: &mesh,
        stars: &stars,
        features: &features,
        modelling: &modelling,
        floor: options.quality_floor,
        keeps_shape: options.feature_angle.is_some(),
        relaxation: options.relaxation,
        max_deviation: options.max_deviation.map(|bound| bound / mesh.unit),
    };
    let mut new = memory::copied(&mesh.positions)?;
    let mut outcomes = memory::filled(Outcome::Unvisited, new.len())?;
    let tally = sweep::run(&surroundings, &mut new, &mut outcomes, options.iterations, progress)?;
    let total = clock.elapsed().as_secs_f64();

    let mut report = count(&surroundings, &new, &outcomes, tally);
    report.seconds =
        Seconds { total, adjacency, features: features_done - adjacency, sweeps: total - features_done, tail: 0.0 };
    if options.measure {
        measure_into(&mut report, &surroundings, &new)?;
    }
    progress::tell(progress, 1.0)?;
    for ((old, &new), stored) in mesh.positions.iter().zip(&new).zip(positions) {
        if *old != new {
            *stored = mesh.stored(new);
        }
    }
    Ok(report)
}

fn check_constraints(constraints: &Constraints<'_>, vertex_count: usize) -> Result<(), Error> {
    let found = constraints.locked.len();
    if found != 0 && found != vertex_count {
        return Err(Error::LockLength { found, vertex_count });
    }
    for (edge, ends) in constraints.feature_edges.iter().enumerate() {
        if let Some(&index) = ends.iter().find(|&&v| v as usize >= vertex_count) {
            return Err(Error::FeatureEdgeOutOfRange { edge, index, vertex_count });
        }
    }
    Ok(())
}

/// Counts what became of each vertex.
fn count(around: &Surroundings<'_>, new: &[DVec3], outcomes: &[Outcome], tally: Tally) -> Report {
    let mut kept = Kept::default();
    let mut moved = 0;
    for (v, &outcome) in outcomes.iter().enumerate() {
        let reason = match (around.features.role(v as u32), outcome) {
            _ if new[v] != around.mesh.positions[v] => &mut moved,
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
    Report {
        moved,
        kept,
        skipped_triangles: around.mesh.triangles.iter().filter(|t| repeats_a_vertex(t)).count(),
        feature_edges: around.features.edge_count,
        moves_halved: tally.halved,
        moves_refused: tally.refused,
        ..Report::default()
    }
}

fn measure_into(report: &mut Report, around: &Surroundings<'_>, new: &[DVec3]) -> Result<(), Error> {
    let mesh = around.mesh;
    report.before = Measurement::of(&mesh.positions, mesh.triangles, mesh.unit)?;
    report.after = Measurement::of(new, mesh.triangles, mesh.unit)?;
    report.volume_relative_change = report.after.volume_change_from(&report.before);
    let surface = Surface::new(mesh, around.stars);
    let deviation = |(v, &p): (usize, &DVec3)| if p == mesh.positions[v] { 0.0 } else { surface.distance(v as u32, p) };
    report.max_deviation = new.iter().enumerate().map(deviation).fold(0.0, f64::max) * mesh.unit;
    Ok(())
}
