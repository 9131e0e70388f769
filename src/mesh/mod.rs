//! Buffers in, validated mesh out: the lowest layer.

mod coordinate;
mod validated;

pub use coordinate::Coordinate;
pub(crate) use validated::Mesh;
