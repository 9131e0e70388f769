//! Stars: the triangles around each vertex, as ordered rings in one flat array.

use std::collections::BTreeMap;
use std::ops::Range;

use fearless_simd::{Level, Simd, dispatch};
use glam::DVec3;

use super::rim_edges::RimEdges;
use super::rings;
use super::validated::Mesh;
use crate::error::Error;
use crate::memory;
use crate::threads::{PART, Threads};

/// What the triangles around a vertex look like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StarKind {
    /// No triangle.
    Empty,
    /// The ring closes: the vertex is inside the surface.
    Closed,
    /// One fan from boundary edge to boundary edge.
    Open,
    /// More than one fan, an edge with more than two triangles, or winding that disagrees.
    NonManifold,
}

/// All stars of a mesh.
///
/// A ring lists the neighbours counter-clockwise (seen from where the triangles do). A closed star of n triangles
/// has n ring vertices, triangle i being (v, ring\[i\], ring\[i + 1 mod n\]); an open one has n + 1.
pub(crate) struct Stars {
    /// Start of each vertex's slots in `slots`; one entry more than vertices.
    offsets: Vec<u32>,
    /// Per vertex one slot more than it has triangles; that of a closed ring repeats its first vertex.
    slots: Vec<u32>,
    kinds: Vec<StarKind>,
    hubs: BTreeMap<u32, Hub>,
}

/// Valence above which a star is a hub. What is asked of a star once for each of its neighbours must not take time in
/// proportion to its valence, or a fan of a million triangles would never end.
const HUB: usize = 64;
const _: () = assert!(HUB.is_power_of_two());

/// Slots that are copied at once.
const FEW: usize = 8;

/// What is known of a star with many triangles.
struct Hub {
    /// Ring vertices with their ring positions, sorted.
    positions: Vec<(u32, u32)>,
    double_area: DVec3,
}

impl Stars {
    /// Builds the stars in linear time (and n log n in the valence of a vertex).
    pub fn new(mesh: &Mesh<'_>, threads: &Threads<'_>) -> Result<Self, Error> {
        // The rings come to stand in the place of the starts.
        let RimEdges { offsets, starts: mut slots, ends } = RimEdges::new(mesh, threads)?;
        let mut kinds = memory::filled(StarKind::Empty, mesh.positions.len())?;
        let (mut parts, mut rest) = (Vec::new(), &mut slots[..]);
        for (part, kinds) in kinds.chunks_mut(PART).enumerate() {
            let offsets = &offsets[part * PART..=part * PART + kinds.len()];
            let [start, end] = [offsets[0], offsets[kinds.len()]].map(|slot| slot as usize);
            let (slots, others) = rest.split_at_mut(end - start);
            parts.push(Part { offsets, slots, ends: &ends[start..end], kinds });
            rest = others;
        }
        threads.each(parts, |part| dispatch!(Level::new(), simd => part.link(simd)));
        let mut stars = Self { offsets, slots, kinds, hubs: BTreeMap::new() };
        stars.find_hubs(mesh);
        Ok(stars)
    }

    fn find_hubs(&mut self, mesh: &Mesh<'_>) {
        // Nearly always there are none: the bits of all counts together are less than a power of two if each count is.
        let all_counts = self.offsets.windows(2).fold(0, |all, ends| all | (ends[1] - ends[0]));
        if all_counts < HUB as u32 {
            return;
        }
        let has_many_slots = |v: &u32| self.offsets[*v as usize + 1] - self.offsets[*v as usize] > HUB as u32;
        for v in (0..self.len() as u32).filter(has_many_slots).filter(|&v| self.is_hub(v)).collect::<Vec<_>>() {
            let mut positions: Vec<(u32, u32)> = self.ring(v).iter().copied().zip(0..).collect();
            positions.sort_unstable();
            let double_area = self.sum_double_area(mesh, v);
            self.hubs.insert(v, Hub { positions, double_area });
        }
    }

    /// Whether so many triangles meet in `v` that nobody should look at all of them without need.
    pub fn is_hub(&self, v: u32) -> bool {
        self.ring(v).len() > HUB
    }

    /// Ring position of `r` around `v`.
    fn position(&self, v: u32, r: u32) -> Option<usize> {
        match self.hubs.get(&v) {
            Some(hub) => {
                let found = hub.positions.binary_search_by_key(&r, |p| p.0).ok()?;
                Some(hub.positions[found].1 as usize)
            }
            None => self.ring(v).iter().position(|&x| x == r),
        }
    }

    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.kinds.len()
    }

    /// What kind of star vertex `v` has.
    pub fn kind(&self, v: u32) -> StarKind {
        self.kinds[v as usize]
    }

    /// The ring of `v`; empty for a star that is neither closed nor open.
    pub fn ring(&self, v: u32) -> &[u32] {
        &self.slots[self.ring_slots(v)]
    }

    /// The rim of the star of `v`, whose triangles are (v, rim\[i\], rim\[i + 1\]): the ring, and if that closes its first
    /// vertex again.
    #[inline(always)]
    pub fn rim(&self, v: u32) -> &[u32] {
        match self.kind(v) {
            StarKind::Open | StarKind::Closed => self.rim_of_disc(v),
            StarKind::Empty | StarKind::NonManifold => &[],
        }
    }

    /// The same for a star that is known to be closed or open, which need not be asked.
    #[inline(always)]
    pub fn rim_of_disc(&self, v: u32) -> &[u32] {
        &self.slots[self.own_slots(v)]
    }

    /// Where all slots of `v` lie.
    #[inline(always)]
    fn own_slots(&self, v: u32) -> Range<usize> {
        // Where there is an end there is a start: that is checked once.
        let end = self.offsets[v as usize + 1] as usize;
        self.offsets[v as usize] as usize..end
    }

    /// Copies the rim of a star that is known to be closed or open to the front of a row, which has room for it. Returns how long
    /// it is. What stands behind it in the row means nothing.
    #[inline(always)]
    pub fn copy_rim_of_disc<const ROW: usize>(&self, v: u32, row: &mut [u32; ROW]) -> usize {
        let own = self.own_slots(v);
        let (slots, count) = (&self.slots[own.start..], own.len());
        match (slots.first_chunk(), row.first_chunk_mut()) {
            // Eight numbers are one copy, and most rims are no longer.
            (Some(slots), Some(row)) if count <= FEW => *row = *slots as [u32; FEW],
            _ => row.iter_mut().zip(&slots[..count]).for_each(|(own, &r)| *own = r),
        }
        count
    }

    /// How many triangles meet in `v`, if they make a disc.
    #[inline(always)]
    pub fn valence(&self, v: u32) -> Option<usize> {
        matches!(self.kind(v), StarKind::Open | StarKind::Closed).then(|| self.valence_of_disc(v))
    }

    /// The same for a star that is known to be closed or open.
    #[inline(always)]
    pub fn valence_of_disc(&self, v: u32) -> usize {
        self.own_slots(v).len() - 1
    }

    /// Where the ring of `v` lies in the array of all slots.
    pub fn ring_slots(&self, v: u32) -> Range<usize> {
        let Range { start, end } = self.own_slots(v);
        match self.kind(v) {
            StarKind::Open => start..end,
            StarKind::Closed => start..end - 1,
            StarKind::Empty | StarKind::NonManifold => start..start,
        }
    }

    /// Ring position of `r` around `v`, if the edge v–r has a triangle on either side.
    pub fn inner_neighbour(&self, v: u32, r: u32) -> Option<usize> {
        let i = self.position(v, r)?;
        self.flanks(v, i).map(|_| i)
    }

    /// The ring vertices before and after position `i`, if the edge to it has a triangle on either side.
    pub fn flanks(&self, v: u32, i: usize) -> Option<[u32; 2]> {
        let ring = self.ring(v);
        let wraps = self.kind(v) == StarKind::Closed;
        let before = if wraps && i == 0 { ring.last() } else { ring.get(i.wrapping_sub(1)) };
        let after = if wraps && i + 1 == ring.len() { ring.first() } else { ring.get(i + 1) };
        Some([*before?, *after?])
    }

    /// The third corner of the triangle that has the directed edge q → p, if it is in the star of `p`.
    pub fn across(&self, p: u32, q: u32) -> Option<u32> {
        let ring = self.ring(p);
        let i = self.position(p, q)?;
        match i.checked_sub(1) {
            Some(before) => Some(ring[before]),
            None if self.kind(p) == StarKind::Closed => ring.last().copied(),
            None => None,
        }
    }

    /// Twice the vector area of the star of `v`; zero where there is no ring.
    pub fn double_area(&self, mesh: &Mesh<'_>, v: u32) -> DVec3 {
        self.hubs.get(&v).map_or_else(|| self.sum_double_area(mesh, v), |hub| hub.double_area)
    }

    fn sum_double_area(&self, mesh: &Mesh<'_>, v: u32) -> DVec3 {
        let ring = self.ring(v);
        let closing = if self.kind(v) == StarKind::Closed { ring.first() } else { None };
        let at = |&r: &u32| mesh.position(r) - mesh.position(v);
        let next = ring.iter().skip(1).chain(closing);
        ring.iter().zip(next).map(|(a, b)| at(a).cross(at(b))).sum()
    }

    /// Whether a triangle opposes the stars of all its corners, as one does that is folded over. Its normal says nothing.
    pub fn is_folded(&self, mesh: &Mesh<'_>, triangle: [u32; 3]) -> bool {
        let [a, b, c] = mesh.corners(&triangle);
        let normal = (b - a).cross(c - a);
        triangle.iter().all(|&v| self.double_area(mesh, v).dot(normal) < 0.0)
    }

    /// How many triangles are in stars: all that name three vertices.
    pub fn triangle_count(&self) -> usize {
        (self.slots.len() - self.len()) / 3
    }

    /// Number of slots, for arrays that run beside them.
    pub fn slot_count(&self) -> usize {
        self.slots.len()
    }
}

/// The stars of consecutive vertices.
struct Part<'a> {
    /// One more than vertices.
    offsets: &'a [u32],
    /// Where rim edges start; then the rings.
    slots: &'a mut [u32],
    /// Where rim edges end.
    ends: &'a [u32],
    kinds: &'a mut [StarKind],
}

impl Part<'_> {
    /// Turns rim edges into rings.
    #[inline(always)]
    fn link<S: Simd>(self, simd: S) {
        let (mut rim, mut starts) = (Vec::new(), Starts::default());
        for (kind, offsets) in self.kinds.iter_mut().zip(self.offsets.windows(2)) {
            let [start, end] = [offsets[0], offsets[1]].map(|slot| (slot - self.offsets[0]) as usize);
            let (slots, ends, count) = (&mut self.slots[start..], &self.ends[start..], end - start - 1);
            *kind = if rings::close(simd, slots, ends, count) {
                StarKind::Closed
            } else {
                link_alone(&mut slots[..=count], &ends[..count], &mut rim, &mut starts)
            };
        }
    }
}

/// Turns the rim edges around a vertex, which start in `own` and end in `ends`, into its ring, edge by edge. What is in `rim` and
/// `starts` does not matter.
#[inline(never)]
fn link_alone(own: &mut [u32], ends: &[u32], rim: &mut Vec<(u32, u32)>, starts: &mut Starts) -> StarKind {
    rim.clear();
    rim.extend(own.iter().copied().zip(ends.iter().copied()));
    rim.iter().enumerate().for_each(|(i, edge)| starts.note(edge.0, i));
    link(rim, own, starts)
}

/// Rim edges beyond which a search is faster in a sorted list.
const MANY: usize = 24;

/// Where to look first for the rim edge that starts at a vertex: by the last byte of its number. What stands there may be of
/// another vertex, or left from another star.
struct Starts([u8; 256]);

impl Default for Starts {
    fn default() -> Self {
        Self([0; 256])
    }
}

impl Starts {
    /// Notes that edge number `i` starts at `a`.
    fn note(&mut self, a: u32, i: usize) {
        self.0[a as usize % 256] = i as u8;
    }

    /// Position of an edge that starts at `a`.
    fn find(&self, rim: &[(u32, u32)], a: u32) -> Option<usize> {
        let i = usize::from(self.0[a as usize % 256]);
        match rim.get(i) {
            Some(edge) if edge.0 == a => Some(i),
            _ => rim.iter().position(|edge| edge.0 == a),
        }
    }
}

/// Chains rim edges into a ring, written to `own`, which has one slot more than there are edges.
fn link(rim: &mut [(u32, u32)], own: &mut [u32], starts: &Starts) -> StarKind {
    match rim.len() {
        0 => StarKind::Empty,
        n if n <= MANY => {
            let is_open_end = |e: &(u32, u32)| rim.iter().all(|f| f.1 != e.0);
            chain(rim, own, || rim.iter().position(is_open_end), |a| starts.find(rim, a))
        }
        _ => link_many(rim, own),
    }
}

/// The same for a star with many triangles.
fn link_many(rim: &mut [(u32, u32)], own: &mut [u32]) -> StarKind {
    rim.sort_unstable();
    let mut ends: Vec<u32> = rim.iter().map(|e| e.1).collect();
    ends.sort_unstable();
    let open_end = || rim.iter().position(|e| ends.binary_search(&e.0).is_err());
    chain(rim, own, open_end, |a| rim.binary_search_by_key(&a, |e| e.0).ok())
}

/// Follows the rim round from the first edge, or if it does not close from the edge with which a fan begins. `starting_at`
/// finds an edge that starts at a vertex. Only a walk that takes every edge exactly once, and ends where it must, makes a
/// disc: a vertex that starts or ends two edges strands one of them.
fn chain(
    rim: &[(u32, u32)],
    own: &mut [u32],
    open_end: impl Fn() -> Option<usize>,
    starting_at: impl Fn(u32) -> Option<usize>,
) -> StarKind {
    let mut walk = |first| walk(rim, own, first, &starting_at);
    match walk(0) {
        Some(StarKind::Closed) => StarKind::Closed,
        _ => open_end().and_then(walk).unwrap_or(StarKind::NonManifold),
    }
}

/// A walk over all edges from the edge number `first`: what kind of star it makes, if it makes one.
fn walk(
    rim: &[(u32, u32)],
    own: &mut [u32],
    first: usize,
    starting_at: impl Fn(u32) -> Option<usize>,
) -> Option<StarKind> {
    let last_step = rim.len() - 1;
    let mut at = first;
    for slot in &mut own[..last_step] {
        *slot = rim[at].0;
        at = starting_at(rim[at].1).filter(|&next| next != first)?;
    }
    let (start, end) = rim[at];
    own[last_step..].copy_from_slice(&[start, end]);
    match starting_at(end) {
        Some(next) => (next == first).then_some(StarKind::Closed),
        None => Some(StarKind::Open),
    }
}

#[cfg(test)]
mod tests {
    use super::super::validated::repeats_a_vertex;
    use super::*;

    /// The stars of triangles over `count` vertices in places that don't matter.
    fn stars(count: usize, triangles: &[[u32; 3]]) -> Stars {
        Stars::new(
            &Mesh::new(vec![[0.0_f64; 3]; count].as_slice(), triangles, &Threads::ONE).expect("a mesh"),
            &Threads::ONE,
        )
        .expect("stars")
    }

    fn fan(valence: u32, closed: bool) -> Vec<[u32; 3]> {
        let last = if closed { valence } else { valence - 1 };
        (0..last).map(|i| [0, i + 1, (i + 1) % valence + 1]).collect()
    }

    #[test]
    fn a_closed_fan_is_a_ring_in_order() {
        for valence in [3, 6, 7, 8, 9, 24, 25, 1000] {
            let stars = stars(valence as usize + 1, &fan(valence, true));
            assert_eq!(stars.kind(0), StarKind::Closed);
            let ring = stars.ring(0);
            let successor = |i: u32| i % valence + 1;
            assert_eq!(ring.len(), valence as usize);
            assert!(ring.windows(2).all(|w| w[1] == successor(w[0])), "{ring:?}");
            assert_eq!(stars.kind(1), StarKind::Open);
            assert_eq!(stars.ring(1), &[2, 0, valence]);
        }
    }

    /// Few triangles over few vertices, drawn by lot.
    fn scraps(mut lot: u64) -> Vec<[u32; 3]> {
        let mut draw = |below: u64| {
            lot = lot.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (lot >> 33) % below
        };
        let mut triangles = fan(draw(9) as u32 + 2, true);
        for i in (0..triangles.len()).rev() {
            triangles.swap(i, draw(i as u64 + 1) as usize);
            triangles[i].rotate_left(draw(3) as usize);
        }
        for _ in 0..draw(4) {
            let i = draw(triangles.len() as u64) as usize;
            triangles[i][draw(3) as usize] = draw(12) as u32;
        }
        triangles.push([17, 18, 19]);
        triangles
    }

    /// The edges opposite to a vertex.
    fn rim_edges(triangles: &[[u32; 3]], v: u32) -> Vec<(u32, u32)> {
        let turns = |&[a, b, c]: &[u32; 3]| [[a, b, c], [b, c, a], [c, a, b]];
        let whole = triangles.iter().filter(|t| !repeats_a_vertex(t));
        whole.flat_map(turns).filter(|turn| turn[0] == v).map(|[_, start, end]| (start, end)).collect()
    }

    #[test]
    fn all_edges_at_a_time_make_the_ring_that_edge_by_edge_makes() {
        for triangles in (0..3000).map(scraps) {
            let stars = stars(20, &triangles);
            for v in 0..20 {
                let (mut own, ends): (Vec<u32>, Vec<u32>) = rim_edges(&triangles, v).into_iter().unzip();
                own.push(0);
                let kind = link_alone(&mut own, &ends, &mut Vec::new(), &mut Starts::default());
                assert_eq!(stars.kind(v), kind, "{v} in {triangles:?}");
                if matches!(kind, StarKind::Open | StarKind::Closed) {
                    assert_eq!(stars.rim(v), own, "{v} in {triangles:?}");
                }
            }
        }
    }

    #[test]
    fn any_number_of_threads_makes_the_same_stars() {
        for repeats in [false, true] {
            let mut triangles: Vec<_> =
                (0..60).flat_map(|i| fan(6, true).into_iter().map(move |t| t.map(|v| v + 7 * i))).collect();
            if repeats {
                triangles[100][1] = triangles[100][0];
            }
            let positions = vec![[0.0_f64; 3]; 420];
            let mesh = Mesh::new(positions.as_slice(), &triangles, &Threads::ONE).expect("a mesh");
            let [one, three] = [1, 3]
                .map(|count| Threads::with(count, 1_000_000, |threads| Stars::new(&mesh, threads).expect("stars")));
            assert_eq!((one.offsets, one.slots, one.kinds), (three.offsets, three.slots, three.kinds));
        }
    }

    #[test]
    fn rim_vertices_whose_numbers_end_alike_are_told_apart() {
        for closed in [true, false] {
            let triangles: Vec<_> = fan(6, closed).into_iter().map(|corners| corners.map(|v| v * 256)).collect();
            let stars = stars(6 * 256 + 1, &triangles);
            assert_eq!(stars.kind(0), if closed { StarKind::Closed } else { StarKind::Open });
            assert_eq!(stars.ring(0), [1, 2, 3, 4, 5, 6].map(|v| v * 256));
        }
    }

    #[test]
    fn an_open_fan_starts_and_ends_on_the_boundary() {
        for valence in [3, 6, 7, 8, 9, 10, 25, 26, 1000] {
            let mut triangles = fan(valence, false);
            triangles.reverse();
            let stars = stars(valence as usize + 1, &triangles);
            assert_eq!(stars.kind(0), StarKind::Open);
            assert_eq!(stars.ring(0), (1..=valence).collect::<Vec<_>>());
        }
    }

    #[test]
    fn two_fans_at_a_vertex_are_non_manifold() {
        for valence in [3, 40] {
            let mut triangles = fan(valence, false);
            triangles.extend(fan(valence, false).iter().map(|t| t.map(|v| if v == 0 { 0 } else { v + valence })));
            let stars = stars(2 * valence as usize + 1, &triangles);
            assert_eq!(stars.kind(0), StarKind::NonManifold);
            assert!(stars.ring(0).is_empty());
            assert_eq!(stars.kind(2), StarKind::Open);
        }
    }

    #[test]
    fn fins_duplicates_and_wrong_winding_are_non_manifold() {
        for valence in [6, 30] {
            let count = valence as usize + 2;
            let with = |change: &dyn Fn(&mut Vec<[u32; 3]>)| {
                let mut triangles = fan(valence, true);
                change(&mut triangles);
                stars(count, &triangles).kind(0)
            };
            assert_eq!(with(&|t| t.push([0, 2, valence + 1])), StarKind::NonManifold);
            assert_eq!(with(&|t| t.push([1, valence + 1, 0])), StarKind::NonManifold);
            assert_eq!(with(&|t| t.push(t[2])), StarKind::NonManifold);
            assert_eq!(with(&|t| t[1].swap(0, 1)), StarKind::NonManifold);
        }
    }

    #[test]
    fn unused_vertices_and_repeated_corners_are_empty() {
        let stars = stars(4, &[[1, 1, 2], [3, 2, 3]]);
        assert!((0..4).all(|v| stars.kind(v) == StarKind::Empty && stars.ring(v).is_empty()));
    }

    #[test]
    fn across_finds_the_other_triangle() {
        let triangles = [[0, 1, 2], [2, 1, 3]];
        let stars = stars(4, &triangles);
        assert_eq!(stars.across(1, 2), Some(3), "the triangle with the edge 2 → 1");
        assert_eq!(stars.across(2, 1), Some(0));
        assert_eq!(stars.across(0, 1), None);
        assert_eq!(stars.inner_neighbour(1, 2), stars.ring(1).iter().position(|&r| r == 2));
        assert_eq!(stars.inner_neighbour(1, 0), None, "a boundary edge");
    }
}
