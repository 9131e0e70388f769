//! Features: what must keep its place or its line.

mod crease;
mod role;

pub(crate) use role::{Features, Role};
