//! Buffers in, validated mesh and its stars out: the lowest layer.

mod coordinate;
mod positions;
mod rim_edges;
mod rings;
mod stars;
mod validated;
mod vertices;

pub use coordinate::Coordinate;
pub(crate) use positions::{Positions, widened};
pub(crate) use stars::{StarKind, Stars};
pub(crate) use validated::{Mesh, in_units, repeats_a_vertex, stored};
pub(crate) use vertices::Vertices;
