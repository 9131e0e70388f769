//! Measuring, apart from improving.

mod distribution;
mod measurement;
mod parameter;
pub mod triangle;

pub use distribution::{Distribution, PERCENTILE_LEVELS};
pub use measurement::{Measurement, histogram, measure};
pub use parameter::Parameter;
