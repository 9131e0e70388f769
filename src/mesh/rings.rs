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

/// Turns rim edges, `count` of which belong to a vertex, into a ring that begins where the first one starts and closes behind its
/// last vertex. `slots` say where they start, `ends` where they end, and both go on with anything. Returns whether that went:
/// not where the ring does not close, nor for more edges than there are lanes; then nothing has changed.
#[inline(always)]
pub(super) fn close<S: Simd>(simd: S, slots: &mut [u32], ends: &[u32], count: usize) -> bool {
    let (Some(behind), Some([lanes @ .., last]), Some(ends)) =
        (BEHIND.get(count.wrapping_sub(2)), slots.first_chunk_mut::<{ LANES + 1 }>(), ends.first_chunk())
    else {
        return false;
    };
    let (own, ends) = (u32x8::load_array_ref(simd, lanes), u32x8::load_array_ref(simd, ends));
    let starts = own | u32x8::load_array_ref(simd, &behind[0]);
    let (order, next) = walk(simd, followers(simd, starts, ends));
    // The first edge comes again after all others, and not before: then each has been passed once.
    if next.simd_eq(0).to_bitmask().trailing_zeros() as usize != count - 1 {
        return false;
    }
    let others = u32x8::load_array_ref(simd, &behind[1]);
    let ring = pick(simd, starts, order) & !others | own & others;
    ring.store_array(lanes);
    if count == LANES {
        *last = lanes[0];
    }
    true
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

    /// What becomes of the slots of edges with others behind them: the same with whatever instructions.
    fn closed(edges: &[[u32; 2]]) -> Option<Vec<u32>> {
        let behind = [[0, 7], [3, 1], [7, 7], [1, 2], [2, 3], [9, 1], [4, 4], [1, 0], [2, 1]];
        let all: Vec<_> = edges.iter().chain(&behind).collect();
        let (ends, before): (Vec<_>, Vec<_>) = (all.iter().map(|e| e[1]).collect(), all.iter().map(|e| e[0]).collect());
        let (count, mut slots, mut again) = (edges.len(), before.clone(), before.clone());
        let went = dispatch!(Level::new(), simd => close(simd, &mut slots, &ends, count));
        assert_eq!(went, dispatch!(Level::baseline(), simd => close(simd, &mut again, &ends, count)));
        assert_eq!(slots, again);
        assert_eq!(slots[count + 1..], before[count + 1..], "slots of others");
        assert!(went || slots == before);
        went.then(|| slots[..=count].to_vec())
    }

    /// Edges around a rim, in an order that leaps.
    fn rim(valence: u32) -> Vec<[u32; 2]> {
        let leap = [0, 0, 1, 2, 3, 2, 5, 3, 5, 4][valence as usize];
        (0..valence).map(|i| i * leap % valence).map(|i| [i + 1, (i + 1) % valence + 1]).collect()
    }

    #[test]
    fn a_ring_of_few_triangles_closes_behind_its_last_vertex() {
        for valence in 2..=8 {
            let ring: Vec<_> = (1..=valence).chain([1]).collect();
            assert_eq!(closed(&rim(valence)), Some(ring), "{valence}");
        }
        assert_eq!(closed(&rim(9)), None, "more than there are lanes");
    }

    #[test]
    fn what_does_not_close_is_left() {
        for valence in 2..=8 {
            let is_left = |change: &dyn Fn(&mut Vec<[u32; 2]>)| {
                let mut edges = rim(valence);
                change(&mut edges);
                closed(&edges).is_none()
            };
            assert!(is_left(&|e| _ = e.remove(1)), "an open fan");
            assert!(is_left(&|e| e[1] = e[0]), "a triangle twice");
            assert!(is_left(&|e| e.insert(0, [1, 9])), "a fin first");
            assert!(is_left(&|e| e.insert(2, [9, 1])), "a fin");
            assert!(is_left(&|e| e[0].swap(0, 1)), "wrong winding");
        }
        assert_eq!(closed(&[[1, 2], [3, 4], [2, 1], [4, 5], [5, 3]]), None, "two rings");
        // Vertices 1 and 2 each start two edges and end two.
        assert_eq!(closed(&[[1, 2], [2, 1], [1, 2], [2, 1]]), None);
    }
}
