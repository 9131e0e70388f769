//! Sweeps: which stars are visited in which order, and what a visit does.

mod blocks;
mod color_order;
mod colors;
mod end;
mod given_order;
mod in_turn;
mod index_order;
mod neighbours;
mod outcome;
mod places;
mod schedule;
mod shares;
mod slide;
mod surroundings;
mod tail_order;
mod task;
mod turns;
mod visit;
mod wave_order;

use crate::error::Error;
use crate::mesh::Positions;
use crate::options::{Constraints, Options, Order};
use crate::progress::Progress;
use crate::threads::Threads;

pub(crate) use end::Tally;
pub(crate) use outcome::{Outcome, Outcomes};
use places::Places;
pub(crate) use slide::direction;
pub(crate) use surroundings::{Surroundings, volume_neutral};

/// Positions after the sweeps that `options` ask for, and what the visits came to.
pub(crate) fn run(
    around: &Surroundings<'_>,
    outcomes: &Outcomes,
    options: &Options,
    constraints: &Constraints<'_>,
    threads: &Threads<'_>,
    progress: &mut Progress<'_>,
) -> Result<(Positions<'static>, Tally), Error> {
    let places = Places::new(&around.mesh.positions, threads)?;
    let iterations = options.iterations;
    let tally = match options.order {
        Order::Colors => color_order::run(around, &places, outcomes, iterations, threads, progress)?,
        Order::Index => index_order::run(around, &places, outcomes, iterations, progress)?,
        Order::Wave => wave_order::run(around, &places, outcomes, (constraints.seeds, iterations), progress)?,
        Order::Tail => tail_order::run(around, &places, outcomes, iterations, progress)?,
        Order::Given => given_order::run(around, &places, outcomes, (constraints.visits, iterations), progress)?,
    };
    Ok((places.into_positions(), tally))
}
