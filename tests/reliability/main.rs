//! Nothing brings the host down: the worst meshes, options at their extremes, faults of the machine.

mod allocation;
mod callback;
mod extremes;
#[cfg(all(feature = "cli", unix))]
mod files;
mod geometry;
mod invariance;
#[path = "../meshes/mod.rs"]
mod meshes;
mod promises;
mod regressions;
mod shapes;
mod threads;
