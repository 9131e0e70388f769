//! Closed rings of few triangles, found without asking edge by edge: each rim edge lies in a lane of its own.

use fearless_simd::prelude::*;
use fearless_simd::{u8x16, u8x32, u32x4, u32x8};

/// Rim edges that lie side by side.
const LANES: usize = 8;

/// No vertex has this number.
const NOBODY: u32 = u32::MAX;

/// For each number of edges from two on: nobody in the lanes behind the edges, and behind one more.
const BEHIND: [[[u32; LANES]; 2]; LANES - 1] = {
    let mut behind = [[[0; LANES]; 2]; LANES - 1];
    let mut i = 0;
    while i < 2 * LANES * (LANES - 1) {
        let (count, more, lane) = (i / LANES / 2 + 2, i / LANES % 2, i % LANES);
        if lane >= count + more {
            behind[count - 2][more][lane] = NOBODY;
        }
        i += 1;
    }
    behind
};

/// Four times the number of a lane is where it lies among bytes.
const FIRST_BYTES: [u8; 16] = [0, 4, 8, 12, 16, 20, 24, 28, 0, 4, 8, 12, 16, 20, 24, 28];

/// The first byte of each lane of four.
const ONE_BYTE_EACH: [u8; 16] = [0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12];

/// Eight bytes, four times each.
const FOUR_TIMES: [u8; 32] =
    [0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 6, 6, 6, 6, 7, 7, 7, 7];

/// Bytes of a lane.
const BYTES: [u8; 32] =
    [0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3];

/// Turns the numbers of the triangles around `v`, of which there are `count`, into a ring that begins with the first one's
/// edge and closes behind its last vertex. Returns whether that went: not where the ring does not close, nor for a star of
/// more triangles than there are lanes; then nothing has changed. `slots` are those of `v` and all that follow, in
/// which any triangles may be named.
#[inline(always)]
pub(super) fn close<S: Simd>(simd: S, triangles: &[[u32; 3]], slots: &mut [u32], v: u32, count: usize) -> bool {
    let (Some(behind), Some([lanes @ .., last])) =
        (BEHIND.get(count.wrapping_sub(2)), slots.first_chunk_mut::<{ LANES + 1 }>())
    else {
        return false;
    };
    let Some([starts, ends]) = rim(simd, triangles, lanes, v) else {
        return false;
    };
    let starts = starts | u32x8::load_array_ref(simd, &behind[0]);
    let (order, next) = walk(simd, followers(simd, starts, ends));
    // The first edge comes again after all others, and not before: then each has been passed once.
    if next.simd_eq(0).to_bitmask().trailing_zeros() as usize != count - 1 {
        return false;
    }
    let others = u32x8::load_array_ref(simd, &behind[1]);
    let ring = pick(simd, starts, order) & !others | u32x8::load_array_ref(simd, lanes) & others;
    ring.store_array(lanes);
    if count == LANES {
        *last = lanes[0];
    }
    true
}

/// Where the edges opposite to `centre` start and end, in the triangles that are named; `None` where the last triangle of the
/// mesh is among those, since each is read together with what comes behind it.
#[inline(always)]
fn rim<S: Simd>(simd: S, triangles: &[[u32; 3]], named: &[u32; LANES], centre: u32) -> Option<[u32x8<S>; 2]> {
    let corner_numbers = triangles.as_flattened();
    let (windows, last) = (corner_numbers.len().checked_sub(4)?, triangles.len() as u32 - 1);
    if u32x8::load_array_ref(simd, named).simd_eq(last).any_true() {
        return None;
    }
    let mut rows = [u32x4::splat(simd, 0); LANES];
    for (row, &t) in rows.iter_mut().zip(named) {
        // The lesser is always the first, but that is not known where it is read.
        let first = (3 * t as usize).min(windows);
        *row = u32x4::load_array_ref(simd, corner_numbers[first..first + 4].first_chunk()?);
    }
    let [p, q, r, s, t, u, v, w] = rows;
    let ([a, b, c], [d, e, f]) = (corners([p, q, r, s]), corners([t, u, v, w]));
    let (a, b, c) = (a.combine(d), b.combine(e), c.combine(f));
    let (is_a, is_b) = (a.simd_eq(centre), b.simd_eq(centre));
    Some([is_a.select(b, is_b.select(c, a)), is_a.select(c, is_b.select(a, b))])
}

/// The first, second and third corners of triangles, each of which comes with a number more.
#[inline(always)]
fn corners<S: Simd>([p, q, r, s]: [u32x4<S>; 4]) -> [u32x4<S>; 3] {
    let (even, odd) = (p.zip_low(r), q.zip_low(s));
    [even.zip_low(odd), even.zip_high(odd), p.zip_high(r).zip_low(q.zip_high(s))]
}

/// For each edge the number of one that starts where it ends, in a byte; its own where there is none.
#[inline(always)]
fn followers<S: Simd>(simd: S, starts: u32x8<S>, ends: u32x8<S>) -> u8x16<S> {
    // Numbers stand in all bytes of a lane, so it does not matter which one is the lowest.
    const EVERY_BYTE: u32 = 0x0101_0101;
    let mut found = u32x8::load_array(simd, [0, 1, 2, 3, 4, 5, 6, 7]) * EVERY_BYTE;
    for (edge, &start) in starts.as_array().iter().enumerate() {
        found = ends.simd_eq(start).select(u32x8::splat(simd, edge as u32 * EVERY_BYTE), found);
    }
    let (low, high) = found.split();
    let one_each = u8x16::load_array_ref(simd, &ONE_BYTE_EACH);
    let [low, high] = [low.to_bytes().swizzle_dyn(one_each), high.to_bytes().swizzle_dyn(one_each)];
    low.bitcast::<u32x4<S>>().zip_low(high.bitcast::<u32x4<S>>()).to_bytes()
}

/// The first eight edges that come one after the other from edge 0 on, and the followers of those.
#[inline(always)]
fn walk<S: Simd>(simd: S, one_on: u8x16<S>) -> (u8x16<S>, u8x16<S>) {
    let two_on = one_on.swizzle_dyn(one_on);
    let four_on = two_on.swizzle_dyn(two_on);
    // Each step puts between any two edges the one that lies halfway.
    let fourth = u8x16::splat(simd, 0);
    let second = fourth.zip_low(four_on.swizzle_dyn(fourth));
    let first = second.zip_low(two_on.swizzle_dyn(second));
    let order = first.zip_low(one_on.swizzle_dyn(first));
    (order, one_on.swizzle_dyn(order))
}

/// Those of eight numbers that `order` names.
#[inline(always)]
fn pick<S: Simd>(simd: S, numbers: u32x8<S>, order: u8x16<S>) -> u32x8<S> {
    let first_bytes = u8x16::load_array_ref(simd, &FIRST_BYTES).swizzle_dyn(order);
    let four_times = u8x32::load_array_ref(simd, &FOUR_TIMES);
    let bytes = first_bytes.combine(first_bytes).swizzle_dyn_within_blocks(four_times);
    numbers.to_bytes().swizzle_dyn(bytes | u8x32::load_array_ref(simd, &BYTES)).bitcast()
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};

    use super::*;

    /// What becomes of the slots of vertex 0, around which all triangles but the last lie, and of others behind them: the same
    /// with whatever instructions.
    fn closed(triangles: &[[u32; 3]]) -> Option<Vec<u32>> {
        let count = triangles.len() - 1;
        let mut slots: Vec<u32> = (0..count as u32).chain([0, 1, 0, 0, 1, 0, 1, 0, 1]).collect();
        let before = slots.clone();
        let went = dispatch!(Level::new(), simd => close(simd, triangles, &mut slots, 0, count));
        let mut again = before.clone();
        assert_eq!(went, dispatch!(Level::baseline(), simd => close(simd, triangles, &mut again, 0, count)));
        assert_eq!(slots, again);
        assert_eq!(slots[count + 1..], before[count + 1..], "slots of others");
        assert!(went || slots == before);
        went.then(|| slots[..=count].to_vec())
    }

    /// The triangles around vertex 0, their corners turned, in an order that leaps; and one more.
    fn fan(valence: u32) -> Vec<[u32; 3]> {
        let leap = [0, 0, 1, 2, 3, 2, 5, 3, 5, 4][valence as usize];
        let corners = |i: u32| [[0, i + 1, (i + 1) % valence + 1], [(i + 1) % valence + 1, 0, i + 1]][i as usize % 2];
        (0..valence).map(|i| corners(i * leap % valence)).chain([[20, 21, 22]]).collect()
    }

    #[test]
    fn a_ring_of_few_triangles_closes_behind_its_last_vertex() {
        for valence in 2..=8 {
            let ring: Vec<_> = (1..=valence).chain([1]).collect();
            assert_eq!(closed(&fan(valence)), Some(ring), "{valence}");
        }
        assert_eq!(closed(&fan(9)), None, "more than there are lanes");
    }

    #[test]
    fn what_does_not_close_is_left() {
        for valence in 2..=8 {
            let is_left = |change: &dyn Fn(&mut Vec<[u32; 3]>)| {
                let mut triangles = fan(valence);
                change(&mut triangles);
                closed(&triangles).is_none()
            };
            assert!(is_left(&|t| _ = t.remove(1)), "an open fan");
            assert!(is_left(&|t| t[1] = t[0]), "a triangle twice");
            assert!(is_left(&|t| t.insert(0, [0, 1, 9])), "a fin first");
            assert!(is_left(&|t| t.insert(2, [0, 9, 1])), "a fin");
            assert!(is_left(&|t| t[0].swap(0, 1)), "wrong winding");
            assert!(is_left(&|t| _ = t.pop()), "the last triangle of the mesh");
        }
        let two_rings = [[0, 1, 2], [0, 3, 4], [0, 2, 1], [0, 4, 5], [0, 5, 3], [9, 8, 7]];
        assert_eq!(closed(&two_rings), None);
        // Vertices 1 and 2 each start two edges and end two.
        let twice_round = [[0, 1, 2], [0, 2, 1], [0, 1, 2], [0, 2, 1], [9, 8, 7]];
        assert_eq!(closed(&twice_round), None);
    }
}
