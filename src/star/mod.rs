//! The operation on a star: one file for each of its steps, in the paper's order.

mod fan;
mod form;
mod lanes;
mod local;
mod model;
mod operation;
mod plane;
mod ring;
mod sizes;

pub(crate) use lanes::{LANES, Numbers, Truths, Vectors, least, sum};
pub(crate) use local::{Chunk, LocalStar, double_vector_area};
pub(crate) use operation::{Draft, Operation};
pub(crate) use plane::TangentPlane;
pub(crate) use sizes::Sizes;
