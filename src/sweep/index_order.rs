//! The paper's GEA: stars by vertex index.

use super::end::Tally;
use super::in_turn;
use super::outcome::Outcomes;
use super::places::Places;
use super::surroundings::Surroundings;
use crate::error::Error;
use crate::progress::Progress;

/// Sweeps `iterations` times over all vertices. `tell` hears the share of the sweeps that is done.
pub(super) fn run(
    around: &Surroundings<'_>,
    places: &Places,
    outcomes: &Outcomes,
    iterations: u32,
    tell: &mut Progress<'_>,
) -> Result<Tally, Error> {
    in_turn::run(around, places, outcomes, (&around.movable()?, iterations), tell)
}
