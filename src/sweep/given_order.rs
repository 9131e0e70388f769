//! The caller's own order: a list of vertices, gone through in each sweep.

use super::end::Tally;
use super::in_turn;
use super::outcome::Outcomes;
use super::places::Places;
use super::surroundings::Surroundings;
use crate::error::Error;
use crate::memory;
use crate::progress::Progress;

/// Goes `iterations` times through `visits`, all of which name a vertex, and passes those over whose role does not let
/// them move. `tell` hears the share of the visits that is done.
pub(super) fn run(
    around: &Surroundings<'_>,
    places: &Places,
    outcomes: &Outcomes,
    (visits, iterations): (&[u32], u32),
    tell: &mut Progress<'_>,
) -> Result<Tally, Error> {
    let moves = |&&v: &&u32| around.features.role(v).moves();
    let mut movable = memory::reserved(visits.iter().filter(moves).count())?;
    movable.extend(visits.iter().filter(moves));
    in_turn::run(around, places, outcomes, (&movable, iterations), tell)
}
