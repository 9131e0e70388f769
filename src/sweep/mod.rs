//! Sweeps: which stars are visited in which order, and what a visit does.

mod index_order;
mod slide;
mod visit;

pub(crate) use index_order::run;
pub(crate) use slide::direction;
pub(crate) use visit::{Outcome, Surroundings, Tally, volume_neutral};
