//! `qsmesh measure`.

use crate::arguments::MeasureArguments;
use crate::console;
use crate::failure::Result;
use crate::files::{MeshFile, Positions};
use crate::smooth_command::explain;
use crate::{json, table};

/// Reads, measures, reports.
pub fn run(arguments: &MeasureArguments) -> Result<()> {
    let file = MeshFile::read(&arguments.input)?;
    let measured = match &file.positions {
        Positions::F32(points) => qsmesh::measure(points, &file.faces.triangles),
        Positions::F64(points) => qsmesh::measure(points, &file.faces.triangles),
    };
    let measured = measured.map_err(|error| explain(&file, &error).in_file(&arguments.input))?;
    if arguments.json {
        console::result(&json::of_measurement(&measured)?)
    } else {
        console::result(&table::of_measurement(&measured))
    }
}
