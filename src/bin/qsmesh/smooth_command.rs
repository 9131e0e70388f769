//! `qsmesh smooth`.

use qsmesh::{Constraints, Error, Options, Report};

use crate::arguments::{FileArguments, MethodArguments, SmoothArguments, SweepArguments};
use crate::console;
use crate::failure::{Failure, Result};
use crate::files::{MeshFile, Positions, Revision};
use crate::output::Output;
use crate::{json, table};

/// `qsmesh smooth`.
pub fn run(arguments: &SmoothArguments) -> Result<()> {
    arguments.files.require_valid("smooth");
    arguments.method.require_valid(arguments.sweeps.iterations, "smooth");
    smooth_file(&arguments.files, &arguments.sweeps, &arguments.method)
}

/// Reads, smooths, writes, reports.
pub fn smooth_file(files: &FileArguments, sweeps: &SweepArguments, method: &MethodArguments) -> Result<()> {
    let output = Output::prepare(files)?;
    let file = MeshFile::read(&files.input)?;
    let mut positions = file.positions_for(output.format());
    let options = method.options(sweeps.iterations, &positions);
    let report =
        smooth(&file, &mut positions, &options, files.quiet).map_err(|failure| failure.in_file(&files.input))?;
    let notes = output.write(&files.input, &file, &Revision::of_positions(positions), &report)?;
    tell(files, &notes, || json::of_report(&report), || table::of_report(&report))
}

/// Tells what the user wants to hear.
pub fn tell(
    files: &FileArguments,
    notes: &[String],
    json: impl FnOnce() -> Result<String>,
    table: impl FnOnce() -> String,
) -> Result<()> {
    if !files.quiet {
        notes.iter().for_each(console::note);
    }
    if files.json {
        console::result(&json()?)
    } else if files.quiet {
        Ok(())
    } else {
        console::result(&table())
    }
}

/// Moves the vertices of `positions`, which belong to `file`.
pub fn smooth(file: &MeshFile, positions: &mut Positions, options: &Options, quiet: bool) -> Result<Report> {
    let mut progress = console::Progress::new(quiet);
    let triangles = &file.faces.triangles;
    let mut tell = |done| progress.tell(done);
    let outcome = match positions {
        Positions::F32(points) => qsmesh::smooth(points, triangles, options, &Constraints::default(), &mut tell),
        Positions::F64(points) => qsmesh::smooth(points, triangles, options, &Constraints::default(), &mut tell),
    };
    progress.finish();
    outcome.map_err(|error| explain(file, &error))
}

/// The library's error in the words of the file.
pub fn explain(file: &MeshFile, error: &Error) -> Failure {
    match error {
        Error::NonFinite { vertex } => {
            // Only narrowing to the precision of the output can make a coordinate infinite on the way.
            let in_file = file.positions.at(*vertex).iter().all(|x| x.is_finite());
            let what = if in_file { "too large for 32 bits" } else { "not finite" };
            Failure::new(format!("{} has a coordinate that is {what}", file.name_of_vertex(*vertex)))
        }
        _ => Failure::new(error.to_string()),
    }
}
