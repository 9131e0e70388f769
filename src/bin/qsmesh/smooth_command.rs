//! `qsmesh smooth`.

use qsmesh::{Constraints, Error, Options, Report};

use crate::arguments::SmoothArguments;
use crate::console;
use crate::failure::{Failure, Result};
use crate::files::{MeshFile, Positions, Target};
use crate::{json, table};

/// Reads, improves, writes, reports.
pub fn run(arguments: &SmoothArguments) -> Result<()> {
    arguments.method.require_valid();
    let target = Target::prepare(&arguments.output)?;
    let file = MeshFile::read(&arguments.input)?;
    let mut positions = file.positions_for(target.format());
    let options = arguments.method.options(&positions);
    let report = improve(&file, &mut positions, &options, arguments.quiet)
        .map_err(|failure| failure.in_file(&arguments.input))?;
    let notes = file.save(&target, &positions)?;
    if !arguments.quiet {
        notes.iter().for_each(console::note);
    }
    if arguments.json {
        console::result(&json::of_report(&report)?)
    } else if arguments.quiet {
        Ok(())
    } else {
        console::result(&table::of_report(&report))
    }
}

/// Moves the vertices of `positions`, which belong to `file`.
pub fn improve(file: &MeshFile, positions: &mut Positions, options: &Options, quiet: bool) -> Result<Report> {
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
