#![doc = include_str!("../README.md")]
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod deviation;
mod error;
mod features;
#[allow(unsafe_code, non_camel_case_types)]
mod ffi;
mod guard;
mod improve;
mod memory;
mod mesh;
mod options;
#[allow(unsafe_code)]
mod pages;
mod preparation;
pub mod progress;
pub mod quality;
mod renumbering;
mod report;
mod smooth;
mod star;
mod sweep;
mod tail;
mod threads;

pub use error::Error;
pub use improve::{Improvement, collapse_tails, improve};
pub use mesh::Coordinate;
pub use options::{Boundary, Constraints, Ideal, Method, Metric, Options, Order, Plane};
pub use progress::{Flow, Progress};
pub use quality::{Distribution, Measurement, Parameter, histogram, measure, triangle_quality};
pub use report::{Kept, Report, Seconds};
pub use smooth::smooth;
pub use tail::{Defect, Leftover, Reason, Sources, TailOptions, TailReport};
