#![doc = include_str!("../README.md")]
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod deviation;
mod error;
mod features;
#[allow(unsafe_code, non_camel_case_types)]
mod ffi;
mod guard;
mod memory;
mod mesh;
mod options;
pub mod progress;
pub mod quality;
mod report;
mod smooth;
mod star;
mod sweep;

pub use error::Error;
pub use mesh::Coordinate;
pub use options::{Boundary, Constraints, Ideal, Options, Plane};
pub use progress::{Flow, Progress};
pub use quality::{Distribution, Measurement, Parameter, histogram, measure};
pub use report::{Kept, Report, Seconds};
pub use smooth::smooth;
