//! Independent stars that one thread visits.

use fearless_simd::{Level, dispatch};

use super::end::Tally;
use super::outcome::Outcomes;
use super::places::Places;
use super::surroundings::Surroundings;
use super::turns::Turn;
use super::visit::Visitor;

/// Stars that one thread visits, turn by turn.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Task<'a> {
    pub vertices: &'a [u32],
    /// What `vertices` consist of.
    pub turns: &'a [Turn],
}

impl Task<'_> {
    /// Visits all.
    pub fn carry_out(self, around: &Surroundings<'_>, places: &Places, outcomes: &Outcomes) -> Tally {
        dispatch!(Level::new(), simd => {
            let (mut visitor, mut left) = (Visitor::new(simd, around), self.vertices);
            for turn in self.turns {
                let (vertices, others) = left.split_at(usize::from(turn.size));
                visitor.visit(vertices, usize::from(turn.companions), places, outcomes);
                left = others;
            }
            visitor.tally()
        })
    }
}
