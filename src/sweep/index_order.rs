//! The paper's GEA: stars by vertex index, in place, so that each sees its neighbours' new positions.

use super::outcome::Outcomes;
use super::places::Places;
use super::task::Task;
use super::visit::{Surroundings, Tally};
use crate::error::Error;
use crate::progress::{self, Progress};

/// Sweeps `iterations` times over all vertices. `tell` hears the share of the sweeps that is done.
pub(super) fn run(
    surroundings: &Surroundings<'_>,
    places: &Places,
    outcomes: &Outcomes,
    iterations: u32,
    tell: &mut Progress<'_>,
) -> Result<Tally, Error> {
    let movable = surroundings.movable()?;
    let total = f64::from(iterations) * movable.len() as f64;
    let (mut tally, mut visited) = (Tally::default(), 0_usize);
    for _ in 0..iterations {
        for vertices in movable.chunks(progress::INTERVAL) {
            progress::tell(tell, visited as f64 / total)?;
            visited += vertices.len();
            tally += Task::InOrder(vertices).carry_out(surroundings, places, outcomes);
        }
    }
    Ok(tally)
}
