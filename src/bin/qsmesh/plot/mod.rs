//! Histograms of the quality before and after, as a picture.

mod bins;
mod file;
mod format;
mod look;
mod panel;
mod picture;
mod state;

pub use self::file::{Plot, PlotFile};
pub use self::picture::Picture;
pub use self::state::State;
