//! Independent stars that one thread visits.

use std::ops::Range;

use fearless_simd::{Level, dispatch};

use super::end::Tally;
use super::outcome::Outcomes;
use super::places::Places;
use super::surroundings::Surroundings;
use super::visit::Visitor;
use crate::star::TOGETHER;

/// Stars that one thread visits.
#[derive(Clone, Copy)]
pub(super) enum Task<'a> {
    /// Parts of a list, none of which has a neighbour in another one: first the first vertices of all parts, then the second
    /// ones, and so on.
    SideBySide { vertices: &'a [u32], parts: &'a [Range<usize>] },
    /// Vertices no two of which are neighbours.
    Apart(&'a [u32]),
}

impl Task<'_> {
    /// How many visits it takes.
    pub fn size(&self) -> usize {
        match self {
            Self::SideBySide { parts, .. } => parts.iter().map(ExactSizeIterator::len).sum(),
            Self::Apart(vertices) => vertices.len(),
        }
    }

    /// Visits all.
    pub fn carry_out(self, around: &Surroundings<'_>, places: &Places, outcomes: &Outcomes) -> Tally {
        dispatch!(Level::new(), simd => {
            let mut visitor = Visitor::new(simd, around);
            let mut together = [0; TOGETHER];
            for turn in 0.. {
                let count = self.turn(turn, &mut together);
                if count == 0 {
                    break;
                }
                visitor.visit(&together[..count], places, outcomes);
            }
            visitor.tally()
        })
    }

    /// The vertices that are visited together in a turn; returns how many.
    #[inline(always)]
    fn turn(&self, turn: usize, together: &mut [u32; TOGETHER]) -> usize {
        let next = match self {
            Self::SideBySide { vertices, parts } => {
                let mut count = 0;
                for part in parts.iter().filter(|part| turn < part.len()) {
                    together[count] = vertices[part.start + turn];
                    count += 1;
                }
                return count;
            }
            Self::Apart(vertices) => &vertices[(turn * TOGETHER).min(vertices.len())..],
        };
        let count = next.len().min(TOGETHER);
        together[..count].copy_from_slice(&next[..count]);
        count
    }
}
