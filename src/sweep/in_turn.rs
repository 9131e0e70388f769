//! Stars one after the other, in place, so that each sees what its neighbours visited before have become.

use super::end::Tally;
use super::outcome::Outcomes;
use super::places::Places;
use super::surroundings::Surroundings;
use super::visit::LoneVisitor;
use crate::error::Error;
use crate::progress::{self, Progress};

/// Visits `vertices`, all of which have a role that lets them move, `iterations` times from the first to the last. `tell`
/// hears the share of the visits that is done.
pub(super) fn run(
    around: &Surroundings<'_>,
    places: &Places,
    outcomes: &Outcomes,
    (vertices, iterations): (&[u32], u32),
    tell: &mut Progress<'_>,
) -> Result<Tally, Error> {
    let mut visitor = LoneVisitor::new(around);
    let total = f64::from(iterations) * vertices.len() as f64;
    let mut visited = 0_usize;
    for _ in 0..iterations {
        for vertices in vertices.chunks(progress::INTERVAL) {
            progress::tell(tell, visited as f64 / total)?;
            visited += vertices.len();
            vertices.iter().for_each(|&v| visitor.visit(v, places, outcomes));
        }
    }
    Ok(visitor.tally)
}
