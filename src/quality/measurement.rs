//! Quality of a whole mesh.

use super::Parameter;
use super::distribution::Distribution;
use super::triangle::Sides;
use crate::error::Error;
use crate::mesh::{Coordinate, Mesh};

/// What [`measure`] finds.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Measurement {
    /// Vertices, used or not.
    pub vertices: usize,
    /// Triangles, degenerate ones included.
    pub triangles: usize,
    /// Longest over shortest edge; mean and variance are the paper's M and D.
    pub edge_ratio: Distribution,
    /// Smallest angle of a triangle, degrees.
    pub min_angle: Distribution,
    /// Largest angle of a triangle, degrees.
    pub max_angle: Distribution,
    /// Mean ratio 4√3·area / Σ edge².
    pub shape: Distribution,
    /// Circumradius over twice the inradius.
    pub radius_ratio: Distribution,
    /// Triangles whose smallest angle is below 10°.
    pub below_10: usize,
    /// Triangles whose smallest angle is below 20°.
    pub below_20: usize,
    /// Triangles whose smallest angle is below 30°.
    pub below_30: usize,
    /// Triangles without area.
    pub zero_area: usize,
    /// Edges with one triangle.
    pub boundary_edges: usize,
    /// Edges with more than two triangles, or with two that disagree in winding.
    pub non_manifold_edges: usize,
    /// Signed volume: positive where the triangles turn counter-clockwise seen from outside. For a mesh that is not
    /// closed it is the volume of the cone from the centre of its bounding box.
    pub volume: f64,
    /// Sum of the areas.
    pub area: f64,
}

/// Measures a mesh. Nothing is changed.
///
/// # Errors
/// [`Error::IndexOutOfRange`], [`Error::NonFinite`] or [`Error::TooLarge`], as for [`smooth`](crate::smooth).
pub fn measure<T: Coordinate>(positions: &[[T; 3]], triangles: &[[u32; 3]]) -> Result<Measurement, Error> {
    todo!()
}

/// Counts how many triangles have a value of `parameter` in each interval of width `interval` from `lower` on; values
/// below `lower` go into the first bin, values past the last bin into the last.
///
/// # Errors
/// As for [`measure`]; [`Error::BadOption`] if `interval` is not above 0, `lower` not finite, or `bins` 0.
pub fn histogram<T: Coordinate>(
    positions: &[[T; 3]],
    triangles: &[[u32; 3]],
    parameter: Parameter,
    lower: f64,
    interval: f64,
    bins: usize,
) -> Result<Vec<usize>, Error> {
    todo!()
}
