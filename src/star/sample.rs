//! What the operation notes of a triangle from one step to the next.

use super::form::Flat;
use super::number::Number;

/// A triangle of each star while the operation is at work.
pub(super) struct Sample<N: Number> {
    /// The projected triangle.
    pub flat: Flat<N>,
    /// Its sampled value a.
    pub value: N::Row,
    /// The number of the interval that holds it.
    pub interval: N::Row,
    /// How many samples formula (3) counts for it, then what formula (4) multiplies with √D.
    pub rank: N::Row,
}

impl<N: Number> Default for Sample<N> {
    fn default() -> Self {
        let row = N::Row::default();
        Self { flat: Flat::default(), value: row, interval: row, rank: row }
    }
}
