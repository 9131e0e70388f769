//! Colours for the vertices between the blocks: no two neighbours have the same.

use super::schedule::BORDER;
use super::surroundings::Surroundings;
use crate::threads::Threads;

/// Colours at most. Vertices for which none is left are visited one by one.
pub(super) const COLORS: usize = 63;

/// How many vertices there are of each colour, and for how many none was left.
pub(super) type Counts = [usize; COLORS + 1];

/// Vertices of consecutive numbers that get their colours without a look at others.
const SHARE: usize = 1 << 18;

/// Gives each vertex that is marked as border, by index, the first colour that none of its neighbours there has: first those whose
/// neighbours all lie in their own share of the mesh, then the others. Returns how many there are in each share.
pub(super) fn give(around: &Surroundings<'_>, marks: &mut [u8], threads: &Threads<'_>) -> Vec<Counts> {
    let shares: Vec<_> = marks.chunks_mut(SHARE).enumerate().collect();
    let is_whole = shares.len() <= 1;
    let mut counts = threads.map_each(shares, |(share, marks)| match is_whole {
        true => give_to(around, marks),
        false => give_inside(around, share * SHARE, marks),
    });
    if !is_whole {
        for v in 0..marks.len() {
            if marks[v] == BORDER {
                let taken = around.stars.rim_of_disc(v as u32).iter().map(|&r| marks[r as usize]);
                marks[v] = first_left(taken);
                counts[v / SHARE][usize::from(marks[v])] += 1;
            }
        }
    }
    counts
}

/// The same for a whole mesh.
fn give_to(around: &Surroundings<'_>, marks: &mut [u8]) -> Counts {
    let mut counts = [0; COLORS + 1];
    for v in 0..marks.len() {
        if marks[v] == BORDER {
            let color = first_left(around.stars.rim_of_disc(v as u32).iter().map(|&r| marks[r as usize]));
            marks[v] = color;
            counts[usize::from(color)] += 1;
        }
    }
    counts
}

/// The same for a share that begins with vertex `first`, without those vertices that have neighbours in another one.
fn give_inside(around: &Surroundings<'_>, first: usize, marks: &mut [u8]) -> Counts {
    let mut counts = [0; COLORS + 1];
    for i in 0..marks.len() {
        if marks[i] != BORDER {
            continue;
        }
        let rim = around.stars.rim_of_disc((first + i) as u32);
        let own = |r: u32| (r as usize).wrapping_sub(first);
        if rim.iter().all(|&r| own(r) < marks.len() || !around.features.role(r).moves()) {
            marks[i] = first_left(rim.iter().map(|&r| marks.get(own(r)).copied().unwrap_or(BORDER)));
            counts[usize::from(marks[i])] += 1;
        }
    }
    counts
}

/// The first colour that is not among these marks; what they are beside colours does not matter.
fn first_left(taken: impl Iterator<Item = u8>) -> u8 {
    // The last bit is no colour's, and may be set or not.
    let taken = taken.fold(0_u64, |taken, mark| taken | 1 << (mark % 64));
    (taken.trailing_ones() as usize).min(COLORS) as u8
}

/// Writes the vertices of all colours, one colour behind the other, each by index, and at the end those for which none was left.
pub(super) fn sort(marks: &[u8], counts: &[Counts], mut border: &mut [u32], threads: &Threads<'_>) {
    let mut shares: Vec<_> = marks.chunks(SHARE).enumerate().map(|(share, marks)| (share, marks, Vec::new())).collect();
    for color in 0..=COLORS {
        for ((_, _, lists), counts) in shares.iter_mut().zip(counts) {
            let (own, others) = border.split_at_mut(counts[color]);
            lists.push(own.iter_mut());
            border = others;
        }
    }
    threads.each(shares, |(share, marks, mut lists)| {
        for (v, &mark) in ((share * SHARE) as u32..).zip(marks) {
            if let Some(place) = lists.get_mut(usize::from(mark)).and_then(Iterator::next) {
                *place = v;
            }
        }
    });
}
