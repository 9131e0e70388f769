//! What the fuzz targets share: how bytes become meshes and options, and what must hold of every result.

pub mod c;
#[allow(dead_code, reason = "the command uses what the targets do not")]
#[path = "../../src/bin/qsmesh/failure.rs"]
pub mod failure;
pub mod files;
pub mod input;
pub mod promises;
pub mod round_trip;
