//! The tail: triangles that stay bad because the connectivity forces it, cured worst first.

mod accept;
mod cavity;
mod collapse;
mod commit;
mod compact;
mod debt;
mod delaunay;
mod detect;
mod flip;
mod leftovers;
mod limits;
mod live;
mod options;
mod patch;
mod queue;
mod rank;
mod relax;
mod remove;
mod report;
mod retriangulate;
mod sources;
mod stage;
mod topology;
mod treat;

pub use options::TailOptions;
pub use report::{Defect, Leftover, Reason, TailReport};
pub use sources::Sources;
pub(crate) use stage::{Outcome, run};
