//! The paper's GEA: stars by vertex index, in place, so that each sees its neighbours' new positions.

use fearless_simd::{Level, dispatch};

use super::outcome::Outcomes;
use super::places::Places;
use super::visit::{Surroundings, Tally, Visitor};
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
    let mut visitor = Visitor::new(surroundings);
    let (level, movable) = (Level::new(), surroundings.movable()?);
    let total = f64::from(iterations) * movable.len() as f64;
    let mut visited = 0_usize;
    for _ in 0..iterations {
        for vertices in movable.chunks(progress::INTERVAL) {
            progress::tell(tell, visited as f64 / total)?;
            visited += vertices.len();
            dispatch!(level, simd => {
                for v in vertices {
                    visitor.visit(simd, std::slice::from_ref(v), places, outcomes);
                }
            });
        }
    }
    Ok(visitor.tally)
}
