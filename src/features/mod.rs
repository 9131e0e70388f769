//! Features: what must keep its place or its line.

mod corner;
mod crease;
mod flat;
mod role;
mod slots;

pub(crate) use role::{Features, Role};
