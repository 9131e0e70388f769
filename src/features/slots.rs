//! Sets of edges, kept beside the rings.

use crate::error::Error;
use crate::memory;
use crate::mesh::Stars;

/// A set of edges inside the surface, as one bit for each ring slot.
pub(crate) struct SlotSet {
    bits: Vec<u64>,
    /// How many edges there are.
    edges: usize,
}

impl SlotSet {
    /// The empty set.
    pub fn new(stars: &Stars) -> Result<Self, Error> {
        // One word more, so that there always is a next one.
        Ok(Self { bits: memory::filled(0, stars.slot_count() / 64 + 2)?, edges: 0 })
    }

    fn contains(&self, slot: usize) -> bool {
        self.bits[slot / 64] >> (slot % 64) & 1 == 1
    }

    /// Whether no edge of `v` is in the set.
    #[inline]
    pub fn has_none_of(&self, stars: &Stars, v: u32) -> bool {
        let slots = stars.ring_slots(v);
        let (word, bit) = (slots.start / 64, slots.start % 64);
        if slots.len() >= 64 {
            return self.within(slots).next().is_none();
        }
        let next = (self.bits[word] >> bit) | (self.bits[word + 1] << 1 << (63 - bit));
        next & ((1 << slots.len()) - 1) == 0
    }

    /// Ring positions of `v` that are in the set.
    pub fn of<'s>(&'s self, stars: &'s Stars, v: u32) -> impl Iterator<Item = usize> + 's {
        let slots = stars.ring_slots(v);
        let start = slots.start;
        self.within(slots).map(move |slot| slot - start)
    }

    /// The slots of a range that are in the set: a word at a time, since most words are empty.
    fn within(&self, slots: std::ops::Range<usize>) -> impl Iterator<Item = usize> + '_ {
        let mut next = slots.start;
        std::iter::from_fn(move || {
            while next < slots.end {
                let rest = self.bits[next / 64] >> (next % 64);
                if rest != 0 {
                    let slot = next + rest.trailing_zeros() as usize;
                    next = slot + 1;
                    return Some(slot).filter(|&slot| slot < slots.end);
                }
                next = (next / 64 + 1) * 64;
            }
            None
        })
    }

    /// Puts the edge a–b into the set, as seen from both ends; boundary edges and pairs that are no edge are left out.
    pub fn insert_edge(&mut self, stars: &Stars, a: u32, b: u32) {
        let is_new = self.insert_half(stars, a, b) | self.insert_half(stars, b, a);
        self.edges += usize::from(is_new);
    }

    /// Returns whether the edge, as seen from `v`, was not in the set.
    fn insert_half(&mut self, stars: &Stars, v: u32, r: u32) -> bool {
        let Some(i) = stars.inner_neighbour(v, r) else {
            return false;
        };
        let slot = stars.ring_slots(v).start + i;
        let is_new = !self.contains(slot);
        self.bits[slot / 64] |= 1 << (slot % 64);
        is_new
    }

    /// Whether the edge a–b is in the set. Both ends know, unless one has no ring; the shorter ring is asked.
    pub fn contains_edge(&self, stars: &Stars, a: u32, b: u32) -> bool {
        let (m, n) = (stars.ring(a).len(), stars.ring(b).len());
        let (v, r) = if n == 0 || m != 0 && m <= n { (a, b) } else { (b, a) };
        let found = stars.ring(v).iter().position(|&x| x == r);
        found.is_some_and(|i| self.contains(stars.ring_slots(v).start + i))
    }

    /// Edges in the set.
    pub fn edge_count(&self) -> usize {
        self.edges
    }
}
