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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::threads::Threads;

    #[test]
    fn a_vertex_without_an_edge_in_the_set_is_told_from_one_with_some() {
        // A grid of triangles, and a fan that is longer than a word.
        const COLUMNS: u32 = 12;
        let halves = |a: u32| [[a, a + 1, a + COLUMNS + 1], [a, a + COLUMNS + 1, a + COLUMNS]];
        let squares = (0..COLUMNS * (COLUMNS - 1)).filter(|a| a % COLUMNS < COLUMNS - 1);
        let (hub, count) = (COLUMNS * COLUMNS, 100);
        let fan = (0..count).map(|i| [hub, hub + 1 + i, hub + 1 + (i + 1) % count]);
        let triangles: Vec<_> = squares.flat_map(halves).chain(fan).collect();
        let positions = vec![[0.0_f64; 3]; (hub + 1 + count) as usize];
        let mesh = Mesh::new(positions.as_slice(), &triangles, &Threads::ONE).expect("a mesh");
        let stars = Stars::new(&mesh, &Threads::ONE).expect("stars");
        let mut set = SlotSet::new(&stars).expect("memory");
        assert!((0..stars.len() as u32).all(|v| set.has_none_of(&stars, v)));
        for v in (0..hub).step_by(5) {
            set.insert_edge(&stars, v, v + COLUMNS + 1);
        }
        set.insert_edge(&stars, hub, hub + count);
        let has_none = |v: u32| set.of(&stars, v).next().is_none();
        assert!((0..stars.len() as u32).all(|v| set.has_none_of(&stars, v) == has_none(v)));
        assert!(has_none(1) && !has_none(hub) && !has_none(2 * COLUMNS + 6));
    }
}
