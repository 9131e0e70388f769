//! Sweeps: which stars are visited in which order, and what a visit does.

mod color_order;
mod index_order;
mod outcome;
mod places;
mod schedule;
mod slide;
mod visit;

use glam::DVec3;

use crate::error::Error;
use crate::options::Order;
use crate::progress::Progress;
use crate::threads::Threads;

pub(crate) use outcome::{Outcome, Outcomes};
use places::Places;
pub(crate) use slide::direction;
pub(crate) use visit::{Surroundings, Tally, volume_neutral};

/// Positions after `iterations` sweeps, and what the visits came to.
pub(crate) fn run(
    around: &Surroundings<'_>,
    outcomes: &Outcomes,
    (order, iterations): (Order, u32),
    threads: &Threads<'_>,
    progress: &mut Progress<'_>,
) -> Result<(Vec<DVec3>, Tally), Error> {
    let places = Places::new(&around.mesh.positions)?;
    let tally = match order {
        Order::Colors => color_order::run(around, &places, outcomes, iterations, threads, progress)?,
        Order::Index => index_order::run(around, &places, outcomes, iterations, progress)?,
        Order::Wave | Order::Tail | Order::Given => index_order::run(around, &places, outcomes, iterations, progress)?,
    };
    Ok((places.into_positions()?, tally))
}
