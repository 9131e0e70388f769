//! The operation on a star: one file for each of its steps, in the paper's order.

mod local;
mod model;
mod operation;
mod plane;
mod potential;

pub(crate) use local::{LocalStar, double_vector_area};
pub(crate) use operation::{Modelling, Operation};
pub(crate) use plane::TangentPlane;
