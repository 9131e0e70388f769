use crate::error::Error;
use crate::mesh::Coordinate;
use crate::options::{Constraints, Options};
use crate::progress::Progress;
use crate::report::Report;
/// stub
pub fn smooth<T: Coordinate>(
    positions: &mut [[T; 3]],
    triangles: &[[u32; 3]],
    options: &Options,
    constraints: &Constraints<'_>,
    progress: &mut Progress<'_>,
) -> Result<Report, Error> {
    todo!()
}
