//! `qsmesh demo`.

use qsmesh::Options;

use crate::arguments::DemoArguments;
use crate::failure::Result;
use crate::files::{MeshFile, Positions, Revision, Target};
use crate::smooth_command::smooth;
use crate::{console, isosurface, table};

/// Cells along each side of the grid that the surface is taken from.
const CELLS: usize = 38;

/// Makes the mesh, smooths it, writes both and reports.
pub fn run(arguments: &DemoArguments) -> Result<()> {
    let before = Target::prepare(&arguments.output.join("demo_before.ply"))?;
    let after = Target::prepare(&arguments.output.join("demo_after.ply"))?;
    let (points, triangles) = isosurface::extract(isosurface::tangle, 3.0, CELLS);
    let mesh = MeshFile::new(Positions::F64(points), triangles);
    mesh.save(&before, &Revision::of_positions(mesh.positions.clone()), None)?;
    let mut positions = mesh.positions.clone();
    let report = smooth(&mesh, &mut positions, &Options::default(), false)?;
    mesh.save(&after, &Revision::of_positions(positions), None)?;
    console::note(format_args!("wrote {} and {}", before.path().display(), after.path().display()));
    console::result(&table::of_report(&report))
}
