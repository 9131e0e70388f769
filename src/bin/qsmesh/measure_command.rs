//! `qsmesh measure`.

use crate::arguments::MeasureArguments;
use crate::console;
use crate::failure::Result;
use crate::files::{MeshFile, Positions};
use crate::output::title;
use crate::plot::{Picture, Plot, State};
use crate::smooth_command::explain;
use crate::{json, table};

/// Reads, measures, draws, reports.
pub fn run(arguments: &MeasureArguments) -> Result<()> {
    let plot = arguments.plot.as_ref().map(Plot::prepare).transpose()?;
    let file = MeshFile::read(&arguments.input)?;
    let measured = match &file.positions {
        Positions::F32(points) => qsmesh::measure(points, &file.faces.triangles),
        Positions::F64(points) => qsmesh::measure(points, &file.faces.triangles),
    };
    let measured = measured.map_err(|error| explain(&file, &error).in_file(&arguments.input))?;
    if let Some(plot) = plot {
        let triangles = &file.faces.triangles;
        let state = State { name: "all", positions: &file.positions, triangles, measurement: &measured };
        plot.stage(&Picture::new(&title(&arguments.input, &[&measured]), &[state])?)?.put()?;
    }
    if arguments.json {
        console::result(&json::of_measurement(&measured)?)
    } else {
        console::result(&table::of_measurement(&measured))
    }
}
