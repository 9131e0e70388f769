//! Turns: stars that a thread visits at once, since none of them is a neighbour of another. Which they are, and in which order
//! they stand so that they can go side by side, is the same in every sweep.

use std::ops::Range;

use super::surroundings::Surroundings;
use crate::error::Error;
use crate::memory;
use crate::star::{Companions, TOGETHER};

/// Vertices that follow one another in a list, at most [`TOGETHER`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Turn {
    /// How many.
    pub size: u8,
    /// How many of them, at the front, have stars that can go side by side; those stand with their like.
    pub companions: u8,
}

/// Arranges a list that consists of `parts`, none of which has a neighbour in another one: first the first vertices of all
/// parts, then the second ones, and so on.
pub(super) fn side_by_side(
    around: &Surroundings<'_>,
    vertices: &mut [u32],
    parts: &[Range<usize>],
) -> Result<Vec<Turn>, Error> {
    let (apart, mut turns, mut left) = (memory::copied(vertices)?, Vec::new(), vertices);
    let start = parts.first().map_or(0, |part| part.start);
    for nth in 0.. {
        let members = parts.iter().filter(|part| nth < part.len()).map(|part| apart[part.start - start + nth]);
        let size = left.iter_mut().zip(members).map(|(place, v)| *place = v).count();
        if size == 0 {
            break;
        }
        let (turn, others) = left.split_at_mut(size);
        turns.push(arrange(around, turn));
        left = others;
    }
    Ok(turns)
}

/// Takes up a list of vertices no two of which are neighbours, and arranges it.
pub(super) fn take(around: &Surroundings<'_>, vertices: &mut [u32], turns: &mut Vec<Turn>) -> Result<(), Error> {
    vertices.chunks_mut(TOGETHER).try_for_each(|turn| memory::push(turns, arrange(around, turn)))
}

fn arrange(around: &Surroundings<'_>, turn: &mut [u32]) -> Turn {
    // What moves has a disc around it.
    let valence = |v: u32| around.features.role(v).moves_in_plane().then(|| around.stars.valence_of_disc(v));
    let companions = Companions::new(turn.iter().copied(), valence);
    turn.copy_from_slice(companions.all());
    Turn { size: turn.len() as u8, companions: companions.len() as u8 }
}
