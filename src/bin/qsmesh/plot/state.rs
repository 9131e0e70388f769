//! What is drawn of: a mesh before or after.

use qsmesh::Measurement;

use crate::files::Positions;

/// A mesh as it was or is.
pub struct State<'a> {
    /// What it is called in the legend.
    pub name: &'static str,
    pub positions: &'a Positions,
    pub triangles: &'a [[u32; 3]],
    pub measurement: &'a Measurement,
}
