//! The paper's GEA: stars by vertex index, in place, so that each sees its neighbours' new positions.

use glam::DVec3;

use super::visit::{Outcome, Surroundings, Tally, Visitor};
use crate::error::Error;
use crate::progress::{self, Progress};

/// Sweeps `iterations` times over all vertices. `tell` hears the share of the sweeps that is done.
pub(crate) fn run(
    surroundings: &Surroundings<'_>,
    positions: &mut [DVec3],
    outcomes: &mut [Outcome],
    iterations: u32,
    tell: &mut Progress<'_>,
) -> Result<Tally, Error> {
    let mut visitor = Visitor::new(surroundings);
    let total = f64::from(iterations) * positions.len() as f64;
    let mut visited = 0_usize;
    for _ in 0..iterations {
        for v in 0..positions.len() as u32 {
            if visited.is_multiple_of(progress::INTERVAL) {
                progress::tell(tell, visited as f64 / total)?;
            }
            visited += 1;
            visitor.visit(positions, outcomes, v);
        }
    }
    Ok(visitor.tally)
}
