//! How a host follows the work and stops it.

use crate::error::Error;

/// What the host answers when it is told of progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// Go on.
    Continue,
    /// Stop; the call returns [`Error::Cancelled`] and the buffers stay as they were.
    Cancel,
}

/// Called with the share of the work that is done, 0 to 1, never falling: at the start, after each stage, and within sweeps at least
/// once every [`INTERVAL`] vertices where stars are visited one by one, every few tens of thousands where eight are at once, and
/// with several threads at least twice a sweep, and at least once every ten million vertices of each thread.
pub type Progress<'a> = dyn FnMut(f64) -> Flow + 'a;

/// Vertices visited between two calls of the progress callback.
pub const INTERVAL: usize = 4096;

/// For callers who don't want to know.
pub fn silent(_: f64) -> Flow {
    Flow::Continue
}

/// Tells the host, and turns its wish to stop into the error.
pub(crate) fn tell(progress: &mut Progress<'_>, done: f64) -> Result<(), Error> {
    match progress(done) {
        Flow::Continue => Ok(()),
        Flow::Cancel => Err(Error::Cancelled),
    }
}
