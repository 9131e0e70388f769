//! New numbers for a large mesh whose vertices are numbered without regard to where they lie: along a curve through space
//! (Morton's), so that what a star reads lies together in memory. The caller's numbers come back with the result.

use std::ops::Range;

use crate::error::Error;
use crate::memory;
use crate::mesh::{Coordinate, Vertices};
use crate::options::Constraints;
use crate::threads::Threads;

/// Vertices from which on it pays: the positions of fewer stay in a processor's caches.
const LARGE: usize = 1 << 18;

/// Triangles that are asked how far apart their numbers lie.
const SAMPLES: usize = 4096;

/// Numbers this share of all vertices apart are scattered: in a mesh that was numbered row by row, or by a front, it is less.
const SCATTERED: usize = 16;

/// Bits of a cell's number along each axis, and those of the number of a vertex, which share a word.
const BITS: u32 = 11;
const VERTEX_BITS: u32 = u64::BITS - 3 * BITS;

/// New numbers, and the triangles that go with them.
pub(crate) struct Renumbering {
    /// Caller's number of each vertex.
    order: Vec<u32>,
    /// New number of each of the caller's vertices.
    ranks: Vec<u32>,
    /// In the order of their least vertices.
    pub triangles: Vec<[u32; 3]>,
}

/// What goes into a mesh that is numbered anew.
pub(crate) struct Renumbered<'a, V: ?Sized> {
    vertices: &'a mut V,
    numbers: &'a Renumbering,
}

/// The caller's constraints in new numbers.
pub(crate) struct RenumberedConstraints {
    locked: Vec<bool>,
    feature_edges: Vec<[u32; 2]>,
}

impl Renumbering {
    /// New numbers if they are worth it. What is wrong with a mesh is left for others to say.
    pub fn if_worthwhile<T: Coordinate>(
        positions: &(impl Vertices<T> + ?Sized),
        triangles: &[[u32; 3]],
        threads: &Threads<'_>,
    ) -> Result<Option<Self>, Error> {
        let count = positions.count();
        let is_large = count >= LARGE && count.max(triangles.len()) >> VERTEX_BITS == 0;
        if !is_large || !is_scattered(count, triangles) || !are_in_range(count, triangles, threads) {
            return Ok(None);
        }
        Self::new(positions, triangles, threads)
    }

    /// New numbers; `None` where a coordinate is not finite. Every index is in range.
    fn new<T: Coordinate>(
        positions: &(impl Vertices<T> + ?Sized),
        triangles: &[[u32; 3]],
        threads: &Threads<'_>,
    ) -> Result<Option<Self>, Error> {
        let Some(bounds) = Bounds::of(positions, threads) else { return Ok(None) };
        let mut sorted = threads
            .collect(positions.count(), |v| bounds.cell(positions.get(v).map(T::to_f64)) << VERTEX_BITS | v as u64)?;
        threads.sort(&mut sorted);
        let order = threads.collect(sorted.len(), |new| (sorted[new] & ((1 << VERTEX_BITS) - 1)) as u32)?;
        drop(sorted);
        let mut ranks = memory::filled(0, order.len())?;
        for (new, &old) in (0..).zip(&order) {
            ranks[old as usize] = new;
        }
        let triangles = sorted_triangles(&ranks, triangles, threads)?;
        Ok(Some(Self { order, ranks, triangles }))
    }

    /// The caller's vertices under their new numbers.
    pub fn vertices<'a, V: ?Sized>(&'a self, vertices: &'a mut V) -> Renumbered<'a, V> {
        Renumbered { vertices, numbers: self }
    }

    /// The constraints that the sweeps by colour look at.
    pub fn constraints(&self, given: &Constraints<'_>) -> Result<RenumberedConstraints, Error> {
        let mut locked = memory::reserved(given.locked.len())?;
        if !given.locked.is_empty() {
            locked.extend(self.order.iter().map(|&old| given.locked[old as usize]));
        }
        let mut feature_edges = memory::reserved(given.feature_edges.len())?;
        feature_edges.extend(given.feature_edges.iter().map(|ends| ends.map(|v| self.ranks[v as usize])));
        Ok(RenumberedConstraints { locked, feature_edges })
    }
}

impl RenumberedConstraints {
    pub fn as_constraints(&self) -> Constraints<'_> {
        Constraints { locked: &self.locked, feature_edges: &self.feature_edges, ..Constraints::default() }
    }
}

impl<T: Coordinate, V: Vertices<T> + ?Sized> Vertices<T> for Renumbered<'_, V> {
    fn count(&self) -> usize {
        self.vertices.count()
    }

    fn get(&self, v: usize) -> [T; 3] {
        self.vertices.get(self.numbers.order[v] as usize)
    }

    fn at(&self, place: usize) -> [T; 3] {
        self.vertices.at(place)
    }

    fn set(&mut self, changed: impl Fn(usize, [T; 3]) -> Option<[T; 3]> + Sync, threads: &Threads<'_>) {
        let ranks = &self.numbers.ranks;
        self.vertices.set(|v, before| changed(ranks[v] as usize, before), threads);
    }
}

/// Whether most triangles name vertices with numbers far apart.
fn is_scattered(count: usize, triangles: &[[u32; 3]]) -> bool {
    let sample = || triangles.iter().step_by((triangles.len() / SAMPLES).max(1));
    let is_far = |&&[a, b, c]: &&[u32; 3]| a.abs_diff(b).max(b.abs_diff(c)) as usize > count / SCATTERED;
    2 * sample().filter(is_far).count() > sample().count()
}

fn are_in_range(count: usize, triangles: &[[u32; 3]], threads: &Threads<'_>) -> bool {
    let part = |part: Range<usize>| triangles[part].as_flattened().iter().all(|&v| (v as usize) < count);
    threads.parts(triangles.len(), part).into_iter().all(|good| good)
}

/// Vertices of consecutive new numbers whose triangles are sorted at once, in a processor's caches.
const BUCKET: usize = 1 << 16;

/// The triangles under new numbers, in the order of their least vertices; those with the same least vertex keep theirs. First they
/// are thrown into buckets, so that each is looked at in memory only once, then each bucket is sorted by counting.
fn sorted_triangles(ranks: &[u32], triangles: &[[u32; 3]], threads: &Threads<'_>) -> Result<Vec<[u32; 3]>, Error> {
    let count = ranks.len().div_ceil(BUCKET);
    let parts = triangles.chunks(triangles.len().div_ceil(threads.count()).max(1)).collect();
    let parts = threads.map_each(parts, |part| Buckets::thrown(ranks, part, count));
    let parts = parts.into_iter().collect::<Result<Vec<_>, Error>>()?;
    let mut sorted = threads.filled([0; 3], triangles.len())?;
    let (mut work, mut rest) = (Vec::new(), &mut sorted[..]);
    for bucket in 0..count {
        let (own, others) = rest.split_at_mut(parts.iter().map(|part| part.of(bucket).count()).sum());
        work.push((bucket, own));
        rest = others;
    }
    let done = threads.map_each(work, |(bucket, own)| {
        let thrown = || parts.iter().flat_map(|part| part.of(bucket)).copied();
        sort_by_least(thrown, bucket * BUCKET, own)
    });
    done.into_iter().collect::<Result<(), Error>>()?;
    Ok(sorted)
}

fn least([a, b, c]: [u32; 3]) -> usize {
    a.min(b).min(c) as usize
}

/// Triangles in the buckets of their least vertices.
struct Buckets {
    /// How many triangles a bucket has room for.
    room: usize,
    /// One array for all buckets, which gets large pages where many small ones would not.
    places: Vec<[u32; 3]>,
    /// How many places of each bucket are taken.
    taken: Vec<usize>,
    /// For each bucket those that there was no room for.
    others: Vec<Vec<[u32; 3]>>,
}

impl Buckets {
    /// Triangles under new numbers, in so many buckets.
    fn thrown(ranks: &[u32], triangles: &[[u32; 3]], count: usize) -> Result<Self, Error> {
        /// Triangles that are looked up before the first of them is thrown, so that no look-up waits for another one.
        const AHEAD: usize = 256;
        // A little more than there will be in each bucket if vertices are numbered at random.
        let room = triangles.len() / count + triangles.len() / (8 * count) + 64;
        let (places, taken) = (memory::filled([0; 3], room * count)?, memory::filled(0, count)?);
        let mut buckets = Self { room, places, taken, others: vec![Vec::new(); count] };
        let mut renamed = [[0; 3]; AHEAD];
        for triangles in triangles.chunks(AHEAD) {
            for (renamed, &[a, b, c]) in renamed.iter_mut().zip(triangles) {
                *renamed = [ranks[a as usize], ranks[b as usize], ranks[c as usize]];
            }
            renamed[..triangles.len()].iter().try_for_each(|&triangle| buckets.throw(triangle))?;
        }
        Ok(buckets)
    }

    #[inline(always)]
    fn throw(&mut self, triangle: [u32; 3]) -> Result<(), Error> {
        let bucket = least(triangle) / BUCKET;
        let taken = &mut self.taken[bucket];
        if *taken == self.room {
            return memory::push(&mut self.others[bucket], triangle);
        }
        self.places[bucket * self.room + *taken] = triangle;
        *taken += 1;
        Ok(())
    }

    /// The triangles of a bucket, in the order in which they were thrown.
    fn of(&self, bucket: usize) -> impl Iterator<Item = &[u32; 3]> {
        let start = bucket * self.room;
        self.places[start..start + self.taken[bucket]].iter().chain(&self.others[bucket])
    }
}

/// Writes the triangles of a bucket in the order of their least vertices, the first of which may be number `first`.
fn sort_by_least<I: Iterator<Item = [u32; 3]>>(
    thrown: impl Fn() -> I,
    first: usize,
    sorted: &mut [[u32; 3]],
) -> Result<(), Error> {
    let mut next = memory::filled(0_u32, BUCKET + 1)?;
    thrown().for_each(|triangle| next[least(triangle) - first + 1] += 1);
    for v in 1..next.len() {
        next[v] += next[v - 1];
    }
    thrown().for_each(|triangle| {
        let place = &mut next[least(triangle) - first];
        sorted[*place as usize] = triangle;
        *place += 1;
    });
    Ok(())
}

/// A box around all vertices.
struct Bounds {
    least: [f64; 3],
    /// Cells of the curve per unit of length.
    scale: f64,
}

impl Bounds {
    /// `None` where a coordinate is not finite, or the box has no finite size.
    fn of<T: Coordinate>(positions: &(impl Vertices<T> + ?Sized), threads: &Threads<'_>) -> Option<Self> {
        let of_part = |part: Range<usize>| {
            let (mut least, mut most) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
            let mut sum = 0.0;
            for p in part.map(|v| positions.get(v).map(T::to_f64)) {
                for k in 0..3 {
                    (least[k], most[k]) = (least[k].min(p[k]), most[k].max(p[k]));
                    sum += p[k] * 0.0;
                }
            }
            (least, most, sum == 0.0)
        };
        let (mut least, mut most) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (low, high, finite) in threads.parts(positions.count(), of_part) {
            if !finite {
                return None;
            }
            for k in 0..3 {
                (least[k], most[k]) = (least[k].min(low[k]), most[k].max(high[k]));
            }
        }
        let size = (0..3).map(|k| most[k] - least[k]).fold(f64::MIN_POSITIVE, f64::max);
        let scale = f64::from((1_u32 << BITS) - 1) / size;
        (size.is_finite() && scale.is_finite()).then_some(Self { least, scale })
    }

    /// Number on the curve of the cell in which a position lies.
    fn cell(&self, position: [f64; 3]) -> u64 {
        (0..3).fold(0, |cell, k| cell | spread(((position[k] - self.least[k]) * self.scale) as u64) << k)
    }
}

/// The lowest eleven bits, three places apart.
fn spread(x: u64) -> u64 {
    let x = x & 0x7ff;
    let x = (x | x << 16) & 0x0700_00ff;
    let x = (x | x << 8) & 0x0700_f00f;
    let x = (x | x << 4) & 0x430c_30c3;
    (x | x << 2) & 0x4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_go_three_places_apart() {
        for x in [0, 1, 2, 0x2aa, 0x555, 0x400, 0x7ff] {
            let expected = (0..BITS).fold(0, |sum, bit| sum | (x >> bit & 1) << (3 * bit));
            assert_eq!(spread(x), expected);
        }
    }

    /// A strip of squares whose vertices are numbered at random, in some sense.
    fn strip(cells: u32) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
        let count = 2 * (cells + 1);
        let number = |i: u32| i * 7919 % count;
        let mut positions = vec![[0.0; 3]; count as usize];
        for i in 0..count {
            positions[number(i) as usize] = [(i / 2) as f32, (i % 2) as f32, 0.0];
        }
        let quad = |c: u32| [0, 1, 2, 3].map(|k| number(2 * c + k));
        let triangles = (0..cells).flat_map(|c| {
            let [a, b, d, e] = quad(c);
            [[a, d, b], [b, d, e]]
        });
        (positions, triangles.collect())
    }

    #[test]
    fn neighbours_get_numbers_near_each_other() {
        let (positions, triangles) = strip(499);
        assert!(is_scattered(positions.len(), &triangles));
        let new = Renumbering::new(positions.as_slice(), &triangles, &Threads::ONE).expect("memory").expect("finite");
        assert!(!is_scattered(positions.len(), &new.triangles));
        assert!(new.triangles.windows(2).all(|t| t[0].iter().min() <= t[1].iter().min()));
        let mut back: Vec<_> = new.triangles.iter().map(|t| t.map(|v| new.order[v as usize])).collect();
        let mut given = triangles.clone();
        back.sort_unstable();
        given.sort_unstable();
        assert_eq!(back, given, "the same triangles with the same first corners");
    }

    #[test]
    fn buckets_hold_more_than_there_is_room_for() {
        // Two buckets, and all triangles in the first.
        let ranks: Vec<u32> = (0..2 * BUCKET as u32).collect();
        let given: Vec<_> = (0..1000).map(|i| [ranks.len() as u32 - 1, i * 7919 % 100, 100 + i]).collect();
        let thrown = Buckets::thrown(&ranks, &given, 2).expect("memory");
        assert!(!thrown.others[0].is_empty() && thrown.of(0).eq(&given) && thrown.of(1).count() == 0);
        let mut expected = given.clone();
        expected.sort_by_key(|&triangle| least(triangle));
        assert_eq!(sorted_triangles(&ranks, &given, &Threads::ONE).expect("memory"), expected);
    }

    #[test]
    fn what_is_written_reaches_the_caller_under_its_own_number() {
        let (mut positions, triangles) = strip(99);
        let before = positions.clone();
        let new = Renumbering::new(positions.as_slice(), &triangles, &Threads::ONE).expect("memory").expect("finite");
        let mut vertices = new.vertices(positions.as_mut_slice());
        let moved: Vec<[f32; 3]> =
            (0..before.len()).map(|v| Vertices::<f32>::get(&vertices, v).map(|x| x + 1.0)).collect();
        vertices.set(|v, _| Some(moved[v]), &Threads::ONE);
        assert!(positions.iter().zip(&before).all(|(p, q)| *p == q.map(|x| x + 1.0)));
        let locked: Vec<bool> = (0..before.len()).map(|v| v == 17).collect();
        let given = Constraints { locked: &locked, feature_edges: &[[17, 3]], ..Constraints::default() };
        let constraints = new.constraints(&given).expect("memory");
        let [a, b] = constraints.feature_edges[0];
        assert_eq!([new.order[a as usize], new.order[b as usize]], [17, 3]);
        assert!((0..before.len()).all(|v| constraints.locked[v] == (v == a as usize)));
    }

    #[test]
    fn small_sane_and_wrong_meshes_keep_their_numbers() {
        let (positions, triangles) = strip(499);
        let worth = |p: &[[f32; 3]], t: &[[u32; 3]]| Renumbering::if_worthwhile(p, t, &Threads::ONE).expect("memory");
        assert!(worth(&positions, &triangles).is_none(), "small");
        let mut infinite = positions.clone();
        infinite[5][1] = f32::NAN;
        assert!(Renumbering::new(infinite.as_slice(), &triangles, &Threads::ONE).expect("memory").is_none());
        let many: Vec<_> = (0..LARGE).map(|v| [v as f32, 0.0, 0.0]).collect();
        let far = [[0, LARGE as u32 / 2, LARGE as u32 - 1]];
        assert!(worth(&many, &far).is_some());
        assert!(worth(&many, &[[0, LARGE as u32 / 2, LARGE as u32]]).is_none(), "out of range");
        assert!(worth(&many, &[[0, 1, 2]]).is_none(), "sane");
    }
}
