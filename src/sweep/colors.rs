//! Colours: no two neighbours have the same, so all vertices of one can be visited at once.

use super::surroundings::Surroundings;

/// Colours at most. Vertices for which none is left are visited one by one.
pub(super) const COLORS: usize = 63;

/// What becomes of a vertex. The parts of the mesh that it speaks of are blocks or shares.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Mark(u8);

impl Mark {
    /// What is added to a colour between the parts.
    const BETWEEN: u8 = 64;

    /// Divided by 64, what is no colour leaves what no colour does, so that a set of colours in 64 bits has a place for it.
    const NO_COLOR: u8 = COLORS as u8;

    /// It does not move.
    pub const STAYS: Self = Self(3 * Self::BETWEEN + Self::NO_COLOR);

    /// It has neighbours in another part, and no colour yet.
    pub const BARE: Self = Self(2 * Self::BETWEEN + Self::NO_COLOR);

    /// It is inside its part, where no colours are needed.
    pub const INSIDE: Self = Self(0);

    /// It is inside its part, and gets the first colour there that is not among those `taken`.
    pub fn inside(taken: impl Iterator<Item = Self>) -> Self {
        Self(Self::first_left(taken, |_| true))
    }

    /// The same for one that has neighbours in another part.
    fn between(taken: impl Iterator<Item = Self>) -> Self {
        let is_between = |mark: Self| mark.0 / Self::BETWEEN == 1;
        Self(Self::BETWEEN + Self::first_left(taken, is_between))
    }

    /// The first colour that none of those marks has that count.
    fn first_left(taken: impl Iterator<Item = Self>, counts: impl Fn(Self) -> bool) -> u8 {
        // The last bit is no colour's, and may be set or not. Which marks count is not foreseeable, so there is no branch.
        let bit = |mark: Self| u64::from(counts(mark)) << (mark.0 % Self::BETWEEN);
        let taken = taken.fold(0, |taken, mark| taken | bit(mark));
        (taken.trailing_ones() as u8).min(Self::NO_COLOR)
    }

    pub fn is_inside(self) -> bool {
        self.0 < Self::NO_COLOR
    }

    /// The colour inside a part.
    pub fn color_inside(self) -> Option<usize> {
        self.is_inside().then_some(usize::from(self.0))
    }

    /// The colour between the parts.
    pub fn color_between(self) -> Option<usize> {
        self.0.checked_sub(Self::BETWEEN).filter(|&color| color < Self::NO_COLOR).map(usize::from)
    }

    /// Whether no colour was left.
    pub fn is_left_over(self) -> bool {
        self.0 == Self::NO_COLOR || self.0 == Self::BETWEEN + Self::NO_COLOR
    }
}

/// Gives each vertex that has neighbours in another part, by index, the first colour that none of its neighbours has that have one
/// by then.
pub(super) fn give_between(around: &Surroundings<'_>, marks: &mut [Mark]) {
    for v in 0..marks.len() {
        if marks[v] == Mark::BARE {
            marks[v] = Mark::between(around.stars.rim_of_disc(v as u32).iter().map(|&r| marks[r as usize]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_colour_that_is_left_is_given() {
        let marks = |taken: &[u8]| taken.iter().map(|&mark| Mark(mark)).collect::<Vec<_>>().into_iter();
        let inside = |taken: &[u8]| Mark::inside(marks(taken)).color_inside();
        assert_eq!([inside(&[]), inside(&[1, 2]), inside(&[0, 1, 3])], [Some(0), Some(0), Some(2)]);
        assert_eq!(inside(&[Mark::STAYS.0, Mark::BARE.0]), Some(0));
        let between = |taken: &[u8]| Mark::between(marks(taken)).color_between();
        assert_eq!([between(&[0, 1]), between(&[64, 65, 2])], [Some(0), Some(2)]);
        let all: Vec<u8> = (0..Mark::NO_COLOR).collect();
        assert!(Mark::inside(marks(&all)).is_left_over() && inside(&all[..62]) == Some(62));
    }

    #[test]
    fn a_mark_is_one_thing_only() {
        for mark in (0..=255).map(Mark) {
            let found = [mark.color_inside().is_some(), mark.color_between().is_some(), mark.is_left_over()];
            let expected = usize::from(mark.0 < 2 * Mark::BETWEEN);
            assert_eq!(found.into_iter().filter(|&is| is).count(), expected, "{mark:?}");
        }
        assert_eq!([Mark(62).color_inside(), Mark(64).color_between()], [Some(62), Some(0)]);
    }
}
