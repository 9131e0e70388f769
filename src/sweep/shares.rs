//! Shares of a large mesh: vertices of consecutive numbers, which one thread visits little by little.

use std::ops::Range;

use super::colors::{COLORS, Mark};
use super::schedule::Lot;
use super::surroundings::Surroundings;
use super::turns;
use crate::error::Error;
use crate::memory;
use crate::threads::Threads;

/// A mesh has about so many shares, so that all threads have about the same to do.
const SHARES: usize = 32;

/// Vertices of a share at most, so that what is looked up for one stays in a processor's caches.
const MOST: usize = 1 << 18;

/// Vertices that are visited before the next ones, by colour: few enough for all that is looked up for them to stay in the cache of
/// one core until the last colour, and enough to fill the lanes colour by colour.
const LITTLE: usize = 1024;

/// How the vertices are shared out, which depends on how many there are alone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shares {
    vertex_count: usize,
    /// Vertices of every share but the last.
    size: usize,
}

impl Shares {
    pub fn of(vertex_count: usize) -> Self {
        Self { vertex_count, size: vertex_count.div_ceil(SHARES).next_power_of_two().min(MOST) }
    }

    /// The vertices of a share.
    pub fn vertices(&self, share: usize) -> Range<usize> {
        share * self.size..((share + 1) * self.size).min(self.vertex_count)
    }

    /// Gives each vertex whose neighbours all lie in its own share, or don't move, the first colour that none of them has that have
    /// one by then, by index.
    pub fn marks(&self, around: &Surroundings<'_>, threads: &Threads<'_>) -> Result<Vec<Mark>, Error> {
        let mut marks = threads.filled(Mark::STAYS, self.vertex_count)?;
        threads.each(marks.chunks_mut(self.size).enumerate().collect(), |(share, marks)| {
            mark(around, self.vertices(share).start, marks);
        });
        Ok(marks)
    }

    /// For each share tasks that wait for each other, but not for those of other shares.
    pub fn lots(
        &self,
        around: &Surroundings<'_>,
        marks: &[Mark],
        threads: &Threads<'_>,
    ) -> Result<Vec<Vec<Lot>>, Error> {
        let lots = threads.map_each(marks.chunks(self.size).enumerate().collect(), |(share, marks)| {
            let firsts = (self.vertices(share).start as u32..).step_by(LITTLE);
            firsts.zip(marks.chunks(LITTLE)).map(|(first, marks)| lot(around, first, marks)).collect()
        });
        lots.into_iter().collect()
    }
}

/// Marks the vertices of a share, the first of which is number `first`.
fn mark(around: &Surroundings<'_>, first: usize, marks: &mut [Mark]) {
    let moves = |v: u32| around.features.role(v).moves();
    for i in 0..marks.len() {
        let v = (first + i) as u32;
        if !moves(v) {
            continue;
        }
        let (rim, own) = (around.stars.rim_of_disc(v), |r: u32| (r as usize).wrapping_sub(first));
        let is_inside = rim.iter().all(|&r| own(r) < marks.len() || !moves(r));
        let taken = rim.iter().map(|&r| marks.get(own(r)).copied().unwrap_or(Mark::STAYS));
        marks[i] = if is_inside { Mark::inside(taken) } else { Mark::BARE };
    }
}

/// The task for those of a few vertices that are inside their share; the first of all is number `first`.
fn lot(around: &Surroundings<'_>, first: u32, marks: &[Mark]) -> Result<Lot, Error> {
    let count = marks.iter().filter(|mark| mark.is_inside()).count();
    let (mut vertices, mut turns, mut start) = (memory::filled(0, count)?, Vec::new(), 0);
    for end in sort(first, marks, &mut vertices) {
        turns::take(around, &mut vertices[start..end], &mut turns)?;
        start = end;
    }
    Ok(Lot { vertices, turns })
}

/// Writes those vertices that are inside their share to the front of a list, by colour and then by index; the first of all is number
/// `first`. Returns where each colour ends.
fn sort(first: u32, marks: &[Mark], list: &mut [u32]) -> [usize; COLORS] {
    let mut ends = [0; COLORS];
    marks.iter().filter_map(|mark| mark.color_inside()).for_each(|color| ends[color] += 1);
    let mut start = 0;
    for end in &mut ends {
        (*end, start) = (start, start + *end);
    }
    for (v, mark) in (first..).zip(marks) {
        if let Some(color) = mark.color_inside() {
            list[ends[color]] = v;
            ends[color] += 1;
        }
    }
    ends
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_of_any_size_is_shared_out() {
        for count in [1, 4096, 4097, 48_485, 1 << 20, 50_000_000] {
            let shares = Shares::of(count);
            let all: Vec<_> = (0..count.div_ceil(shares.size)).map(|share| shares.vertices(share)).collect();
            assert!(all[0].start == 0 && all[all.len() - 1].end == count, "{count}");
            assert!(all.windows(2).all(|pair| pair[0].end == pair[1].start && pair[0].len() == shares.size), "{count}");
        }
    }

    #[test]
    fn colours_are_sorted() {
        let inside = |taken: &[Mark]| Mark::inside(taken.iter().copied());
        let (zero, one) = (inside(&[]), inside(&[Mark::INSIDE]));
        let mut list = [0; 5];
        let ends = sort(7, &[one, zero, Mark::STAYS, one, Mark::BARE, zero], &mut list);
        assert_eq!((list, &ends[..3]), ([8, 12, 7, 10, 0], &[2, 4, 4][..]));
    }
}
