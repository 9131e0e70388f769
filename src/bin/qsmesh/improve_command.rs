//! `qsmesh improve` and `qsmesh collapse-tails`.

use qsmesh::{Constraints, Improvement, Options, Report, Sources, TailOptions};

use crate::arguments::{CollapseTailsArguments, FileArguments, ImproveArguments, MethodArguments, TailArguments};
use crate::failure::{Failure, Result};
use crate::files::{MeshFile, Positions, Revision};
use crate::output::Output;
use crate::smooth_command::{explain, smooth_file, tell};
use crate::{console, json, table};

/// `qsmesh improve`.
pub fn run(arguments: &ImproveArguments) -> Result<()> {
    let ImproveArguments { files, keep_tails, tail, sweeps, method } = arguments;
    files.require_valid("improve");
    method.require_valid(sweeps.iterations, "improve");
    tail.require_valid("improve");
    if *keep_tails { smooth_file(files, sweeps, method) } else { improve_file(files, sweeps.iterations, method, tail) }
}

/// `qsmesh collapse-tails`.
pub fn run_without_sweeps(arguments: &CollapseTailsArguments) -> Result<()> {
    arguments.files.require_valid("collapse-tails");
    arguments.method.require_valid(0, "collapse-tails");
    arguments.tail.require_valid("collapse-tails");
    improve_file(&arguments.files, 0, &arguments.method, &arguments.tail)
}

/// Reads, improves, writes, reports.
fn improve_file(files: &FileArguments, sweeps: u32, method: &MethodArguments, tail: &TailArguments) -> Result<()> {
    let output = Output::prepare(files)?;
    let file = MeshFile::read(&files.input)?;
    require_triangles(&file).map_err(|failure| failure.in_file(&files.input))?;
    let positions = file.positions_for(output.format());
    let options = method.options(sweeps, &positions);
    let (revision, improvement) = improve(&file, positions, &options, &tail.options(), files.quiet)
        .map_err(|failure| failure.in_file(&files.input))?;
    let (whole, tail) = (whole(&improvement), &improvement.tail);
    let notes = output.write(&files.input, &file, &revision, &whole)?;
    tell(files, &notes, || json::of_improvement(&whole, tail), || table::of_improvement(&whole, tail))
}

/// The report of the sweeps, but with what the whole call has made of the mesh.
fn whole(improvement: &Improvement) -> Report {
    let tail = &improvement.tail;
    Report {
        after: tail.after,
        volume_relative_change: tail.volume_relative_change,
        max_deviation: tail.max_deviation,
        ..improvement.smoothing.clone()
    }
}

/// A new triangle takes the place of one in the file, so a polygon would have to become several rows that were one.
fn require_triangles(file: &MeshFile) -> Result<()> {
    let Some((face, corners)) = file.faces.first_polygon() else { return Ok(()) };
    Err(Failure::new(format!(
        "face {face} (counted from 0) has {corners} corners, but tails can be collapsed only where every face is a \
         triangle; triangulate the mesh first, or smooth it alone with `qsmesh improve --keep-tails`"
    )))
}

/// Smooths a file's mesh at `positions` and treats its tail. Leftovers are named by their numbers in the new file.
fn improve(
    file: &MeshFile,
    mut positions: Positions,
    options: &Options,
    tail: &TailOptions<'_>,
    quiet: bool,
) -> Result<(Revision, Improvement)> {
    let seams = file.seams()?;
    let fixed = Constraints { feature_edges: &seams, ..Constraints::default() };
    let mut triangles = file.faces.triangles.clone();
    let mut sources = Sources::default();
    let mut progress = console::Progress::new(quiet);
    let (all, from, tell) = (&mut triangles, &mut sources, &mut |done| progress.tell(done));
    let outcome = match &mut positions {
        Positions::F32(points) => qsmesh::improve(points, all, options, tail, &fixed, from, tell),
        Positions::F64(points) => qsmesh::improve(points, all, options, tail, &fixed, from, tell),
    };
    progress.finish();
    let mut improvement = outcome.map_err(|error| explain(file, &error))?;
    let (vertices, faces) = (file.positions.len(), file.faces.len());
    let (revision, places) = Revision::of_mesh(positions, &triangles, &sources, vertices, faces);
    let leftovers = &mut improvement.tail.leftovers;
    leftovers.iter_mut().for_each(|leftover| leftover.triangle = places[leftover.triangle as usize]);
    leftovers.sort_by_key(|leftover| leftover.triangle);
    Ok((revision, improvement))
}
