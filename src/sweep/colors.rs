//! Colours for the vertices between the blocks: no two neighbours have the same.

use super::schedule::{BORDER, INNER};
use super::surroundings::Surroundings;
use crate::threads::Threads;

/// Colours at most. Vertices for which none is left are visited one by one.
pub(super) const COLORS: usize = 63;

/// Vertices of consecutive numbers that make a share of the mesh, which a thread sweeps without waiting for others.
pub(super) const SHARE: usize = 1 << 18;

/// What is added to the colour of a vertex that has neighbours in another share.
pub(super) const SEAM: usize = 64;

/// How many vertices of a share there are of each kind.
pub(super) struct Counts {
    /// Inside the blocks.
    pub inner: usize,
    /// By mark: colours, none left, colours of the seams, none left there.
    pub marked: [usize; 2 * SEAM],
}

impl Counts {
    /// Vertices that a share visits by itself.
    pub fn own(&self) -> usize {
        self.inner + self.marked[..COLORS].iter().sum::<usize>()
    }

    /// Vertices for which no colour was left.
    pub fn rest(&self) -> usize {
        self.marked[COLORS] + self.marked[SEAM + COLORS]
    }

    /// All that may move.
    pub fn total(&self) -> usize {
        self.inner + self.marked.iter().sum::<usize>()
    }
}

/// Gives each vertex that is marked as border, by index, the first colour that none of its neighbours has that have one by then:
/// first those whose neighbours all lie in their own share, then the others. Returns how many there are in each share.
pub(super) fn give(around: &Surroundings<'_>, marks: &mut [u8], threads: &Threads<'_>) -> Vec<Counts> {
    let shares: Vec<_> = marks.chunks_mut(SHARE).enumerate().collect();
    let is_whole = shares.len() <= 1;
    let mut counts = threads.map_each(shares, |(share, marks)| match is_whole {
        true => give_to_all(around, marks),
        false => give_inside(around, share * SHARE, marks),
    });
    for v in if is_whole { 0..0 } else { 0..marks.len() } {
        if marks[v] == BORDER {
            let color = first_left(around.stars.rim_of_disc(v as u32).iter().map(|&r| marks[r as usize]));
            marks[v] = SEAM as u8 + color;
            counts[v / SHARE].marked[usize::from(marks[v])] += 1;
        }
    }
    counts
}

/// The same for a mesh that is one share.
fn give_to_all(around: &Surroundings<'_>, marks: &mut [u8]) -> Counts {
    let mut counts = Counts { inner: 0, marked: [0; 2 * SEAM] };
    for v in 0..marks.len() {
        if marks[v] == BORDER {
            let color = first_left(around.stars.rim_of_disc(v as u32).iter().map(|&r| marks[r as usize]));
            marks[v] = color;
            counts.marked[usize::from(color)] += 1;
        }
    }
    counts.inner = marks.iter().filter(|&&mark| mark == INNER).count();
    counts
}

/// The same for a share that begins with vertex `first`, without those vertices that have neighbours in another one.
fn give_inside(around: &Surroundings<'_>, first: usize, marks: &mut [u8]) -> Counts {
    let mut counts = Counts { inner: 0, marked: [0; 2 * SEAM] };
    for i in 0..marks.len() {
        if marks[i] != BORDER {
            continue;
        }
        let rim = around.stars.rim_of_disc((first + i) as u32);
        let own = |r: u32| (r as usize).wrapping_sub(first);
        if rim.iter().all(|&r| own(r) < marks.len() || !around.features.role(r).moves()) {
            marks[i] = first_left(rim.iter().map(|&r| marks.get(own(r)).copied().unwrap_or(BORDER)));
            counts.marked[usize::from(marks[i])] += 1;
        }
    }
    counts.inner = marks.iter().filter(|&&mark| mark == INNER).count();
    counts
}

/// The first colour that is not among these marks; what they are beside colours does not matter.
fn first_left(taken: impl Iterator<Item = u8>) -> u8 {
    // The last bit is no colour's, and may be set or not.
    let taken = taken.fold(0_u64, |taken, mark| taken | 1 << (mark % 64));
    (taken.trailing_ones() as usize).min(COLORS) as u8
}

/// Writes the vertices of a share that begins with vertex `first` into lists, each by index: the colours one behind the other, of
/// which there are as many as `sizes` says; those of the seams apart; and those for which no colour was left.
pub(super) fn sort(
    first: u32,
    marks: &[u8],
    mut colored: &mut [u32],
    sizes: impl Fn(usize) -> usize,
    (seams, rest): (Vec<&mut [u32]>, &mut [u32]),
) {
    let mut lists = Vec::with_capacity(2 * SEAM);
    for size in (0..COLORS).map(sizes) {
        let (own, others) = colored.split_at_mut(size);
        lists.push(own.iter_mut());
        colored = others;
    }
    lists.push(rest.iter_mut());
    lists.extend(seams.into_iter().map(<[u32]>::iter_mut));
    for (v, &mark) in (first..).zip(marks) {
        let list = if mark == BORDER { COLORS } else { usize::from(mark) };
        if let Some(place) = lists.get_mut(list).and_then(Iterator::next) {
            *place = v;
        }
    }
}
