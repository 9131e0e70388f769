//! Measuring, apart from improving.

mod distribution;
mod measurement;
mod parameter;
pub mod triangle;

pub use distribution::{Distribution, PERCENTILE_LEVELS};
pub use measurement::{Measurement, histogram, measure, triangle_quality};
pub use parameter::Parameter;
