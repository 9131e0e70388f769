//! Creases, told from noise.

use std::ops::Range;

use glam::DVec3;

use super::flat::Flat;
use super::slots::SlotSet;
use crate::error::Error;
use crate::memory;
use crate::mesh::{Mesh, Stars};
use crate::quality::triangle::Sides;
use crate::star::THIN;
use crate::threads::Threads;

/// A connected set of fewer sharp edges is noise, unless all its edges are clear.
const SHORT: u32 = 5;

/// A comparison of squares that holds with this factor holds whatever the rounding.
const CLEARLY: f64 = 1.000_001;

/// Cosine of 10°: an edge is clear if each edge beside it is either flatter than that or sharp.
const FLAT: f64 = 0.984_807_753_012_208;

/// Marks the edges whose two sides meet at more than the angle of which `sharp` is the cosine, short patches of noise left out.
pub(super) fn mark(
    (mesh, stars): (&Mesh<'_>, &Stars),
    (sharp, flat): (f64, &Flat),
    threads: &Threads<'_>,
    slots: &mut SlotSet,
) -> Result<(), Error> {
    let dihedral = Dihedral { mesh, stars, flat, sharp };
    let parts = threads.parts(stars.len(), |part| dihedral.sharp_edges(part));
    let mut edges = memory::reserved(parts.iter().map(Vec::len).sum())?;
    parts.into_iter().for_each(|part| edges.extend(part));
    let mut patches = Patches::new(&edges)?;
    edges.iter().for_each(|&(ends, _)| patches.join(ends));
    edges.iter().for_each(|&(ends, clear)| patches.count(ends, clear));
    for &([a, b], _) in edges.iter().filter(|&&(ends, _)| patches.is_credible(ends)) {
        slots.insert_edge(stars, a, b);
    }
    Ok(())
}

/// Angles between the two sides of an edge.
struct Dihedral<'a> {
    mesh: &'a Mesh<'a>,
    stars: &'a Stars,
    flat: &'a Flat,
    /// Cosine of the angle above which an edge is sharp.
    sharp: f64,
}

impl Dihedral<'_> {
    /// The sharp edges that are seen first from a part of the vertices, and whether they are clear.
    fn sharp_edges(&self, part: Range<usize>) -> Vec<([u32; 2], bool)> {
        let mut edges = Vec::new();
        for v in self.flat.others(part) {
            for (i, &r) in self.stars.ring(v).iter().enumerate() {
                let seen_once = v < r && !self.flat.is_around(r) || self.stars.ring(r).is_empty();
                if seen_once
                    && let Some(flanks) = self.stars.flanks(v, i)
                    && self.is_sharp(v, r, flanks)
                {
                    edges.push(([v, r], self.is_clear(v, r, flanks)));
                }
            }
        }
        edges
    }

    /// Whether the edge v–r, with the third corners `before` and `after` of its triangles, is sharp. Beside a triangle that
    /// is folded over none is.
    fn is_sharp(&self, v: u32, r: u32, [before, after]: [u32; 2]) -> bool {
        let sides = [[r, v, before], [v, r, after]];
        !self.is_plainly_flat([v, r, before, after])
            && is_cosine_below(self.sharp, self.side(sides[0]), self.side(sides[1]))
            && !sides.into_iter().any(|triangle| self.stars.is_folded(self.mesh, triangle))
    }

    /// Whether both triangles of an edge are to be believed and their normals clearly agree: most edges, without a root or
    /// a division.
    fn is_plainly_flat(&self, corners: [u32; 4]) -> bool {
        let [v, r, before, after] = corners.map(|corner| self.mesh.position(corner));
        let (edge, b, a) = (r - v, before - v, after - v);
        let (left, right) = (b.cross(edge), edge.cross(a));
        let squares = [left.length_squared(), right.length_squared()];
        let is_believed = |square: f64, x: DVec3| {
            let sum = edge.length_squared() + x.length_squared() + (x - edge).length_squared();
            is_clearly_thin(square, sum) == Some(false)
        };
        let along = left.dot(right);
        is_believed(squares[0], b)
            && is_believed(squares[1], a)
            && along > 0.0
            && along * along > CLEARLY * self.sharp * self.sharp * squares[0] * squares[1]
    }

    /// Whether the surface is flat or sharp at each of the four edges beside it, and nothing between.
    fn is_clear(&self, v: u32, r: u32, [before, after]: [u32; 2]) -> bool {
        [[r, v, before], [v, r, after]].into_iter().all(|triangle| {
            let own = self.normal(triangle);
            let cosines = self.beyond(triangle).map(|other| other.map_or(1.0, |t| cosine(own, self.normal(t))));
            cosines.into_iter().all(|c| c >= FLAT || c < self.sharp)
        })
    }

    /// Normal of the side of an edge p → q on which the triangle (p, q, x) lies. The normal of a thin triangle is mostly
    /// noise, so there the triangles beyond its other two edges have their say, each by its area.
    fn side(&self, triangle: [u32; 3]) -> DVec3 {
        let corners = self.mesh.corners(&triangle);
        let own = normal(corners);
        if !is_thin(corners, own) {
            return own;
        }
        let others = self.beyond(triangle).into_iter().flatten();
        own + others.map(|t| self.normal(t)).sum::<DVec3>()
    }

    /// The triangles beyond the edges q → x and x → p of the triangle (p, q, x).
    fn beyond(&self, [p, q, x]: [u32; 3]) -> [Option<[u32; 3]>; 2] {
        [self.stars.across(q, x).map(|y| [x, q, y]), self.stars.across(x, p).map(|y| [p, x, y])]
    }

    fn normal(&self, triangle: [u32; 3]) -> DVec3 {
        normal(self.mesh.corners(&triangle))
    }
}

/// Normal of a triangle, twice its area long.
fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Whether the shape of a triangle with this normal is below [`THIN`].
fn is_thin(corners: [DVec3; 3], normal: DVec3) -> bool {
    let [a, b, c] = corners;
    let sum = (c - b).length_squared() + (a - c).length_squared() + (b - a).length_squared();
    is_clearly_thin(normal.length_squared(), sum).unwrap_or_else(|| Sides::new(corners).shape() < THIN)
}

/// The same without a root or a division, from the square of the normal and the sum of the squared sides; `None` where it is close.
#[inline(always)]
fn is_clearly_thin(square: f64, sum: f64) -> Option<bool> {
    let (own, bound) = (12.0 * square, THIN * THIN * sum * sum);
    if own > CLEARLY * bound { Some(false) } else { (CLEARLY * own < bound).then_some(true) }
}

/// Whether [`cosine`] is below a bound: mostly without a root or a division.
fn is_cosine_below(bound: f64, a: DVec3, b: DVec3) -> bool {
    let along = a.dot(b);
    let (own, other) = (along * along, bound * bound * (a.length_squared() * b.length_squared()));
    let are_positive = along > 0.0 && bound > 0.0;
    if are_positive && own > CLEARLY * other {
        false
    } else if are_positive && CLEARLY * own < other {
        true
    } else {
        cosine(a, b) < bound
    }
}

/// Cosine of the angle between two directions; 1 where one is none.
fn cosine(a: DVec3, b: DVec3) -> f64 {
    let square = a.length_squared() * b.length_squared();
    if square > 0.0 { a.dot(b) / square.sqrt() } else { 1.0 }
}

/// Connected sets of sharp edges (union-find over their ends).
struct Patches {
    /// Ends of sharp edges, rising.
    vertices: Vec<u32>,
    /// Per entry of `vertices` another one of the same set, or itself.
    parents: Vec<usize>,
    edges: Vec<u32>,
    unclear: Vec<bool>,
}

impl Patches {
    fn new(edges: &[([u32; 2], bool)]) -> Result<Self, Error> {
        let mut vertices = memory::reserved(2 * edges.len())?;
        vertices.extend(edges.iter().flat_map(|(ends, _)| ends));
        vertices.sort_unstable();
        vertices.dedup();
        let count = vertices.len();
        let mut parents = memory::reserved(count)?;
        parents.extend(0..count);
        Ok(Self { vertices, parents, edges: memory::filled(0, count)?, unclear: memory::filled(false, count)? })
    }

    /// The entry that stands for the set of vertex `v`.
    fn root(&mut self, v: u32) -> usize {
        let mut entry = self.vertices.partition_point(|&w| w < v);
        while self.parents[entry] != entry {
            let grandparent = self.parents[self.parents[entry]];
            self.parents[entry] = grandparent;
            entry = grandparent;
        }
        entry
    }

    fn join(&mut self, [a, b]: [u32; 2]) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b)] = a.min(b);
    }

    fn count(&mut self, [a, _]: [u32; 2], clear: bool) {
        let root = self.root(a);
        self.edges[root] += 1;
        self.unclear[root] |= !clear;
    }

    fn is_credible(&mut self, [a, _]: [u32; 2]) -> bool {
        let root = self.root(a);
        self.edges[root] >= SHORT || !self.unclear[root]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between -1 and 1, all over the place.
    fn numbers() -> impl FnMut() -> f64 {
        let mut state = 1_u64;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / f64::from(1 << 26) / f64::from(1 << 26) - 1.0
        }
    }

    #[test]
    fn without_a_root_the_same_triangles_are_thin() {
        let (mut number, mut found) = (numbers(), [0; 2]);
        for i in 0..100_000 {
            // Isosceles, of any height or of about that from which on it is not thin; the base differs in its last bits.
            let limit = 3.0_f64.sqrt() * (1.0 - (1.0 - THIN * THIN).sqrt()) / (2.0 * THIN);
            let height = if i % 2 == 0 { number() } else { limit * (1.0 + 1e-6 * number()) };
            let corners =
                [[-0.5 + 1e-16 * number(), 0.0, 0.0], [0.5, 0.0, 0.0], [0.0, height, 0.0]].map(DVec3::from_array);
            let is_thin = is_thin(corners, normal(corners));
            assert_eq!(is_thin, Sides::new(corners).shape() < THIN, "{corners:?}");
            found[usize::from(is_thin)] += 1;
        }
        assert!(found.iter().all(|&count| count > 10_000), "{found:?}");
    }

    #[test]
    fn without_a_root_the_same_angles_are_sharp() {
        let mut number = numbers();
        for degrees in [0.0, 1e-3, 30.0, 90.0, 120.0, 179.0] {
            let bound = libm::cos(f64::to_radians(degrees));
            let mut found = [0; 2];
            for i in 0..10_000 {
                let angle = if i % 2 == 0 { 180.0 * number() } else { degrees + 1e-7 * number() };
                let (size, (sine, cosine_of)) = (1.0 + number(), libm::sincos(f64::to_radians(angle)));
                let (a, b) = (DVec3::X, DVec3::new(size * cosine_of, size * sine, 0.0));
                let is_below = is_cosine_below(bound, a, b);
                assert_eq!(is_below, cosine(a, b) < bound, "{degrees}: {angle}");
                found[usize::from(is_below)] += 1;
            }
            assert!(found.iter().all(|&count| count > 10), "{degrees}: {found:?}");
        }
        assert!(!is_cosine_below(0.5, DVec3::ZERO, DVec3::X));
    }
}
