//! Creases, told from noise.

use glam::DVec3;

use super::slots::SlotSet;
use crate::error::Error;
use crate::memory;
use crate::mesh::{Mesh, Stars};
use crate::quality::triangle::Sides;

/// Mean-ratio shape below which a triangle's own normal is not believed.
const THIN: f64 = 0.3;

/// A connected set of fewer sharp edges is noise, unless all its edges are clear.
const SHORT: u32 = 5;

/// Cosine of 10°: an edge is clear if each edge beside it is either flatter than that or sharp.
const FLAT: f64 = 0.984_807_753_012_208;

/// Marks the edges whose two sides meet at more than `angle` degrees, short patches of noise left out.
pub(super) fn mark(mesh: &Mesh<'_>, stars: &Stars, angle: f64, slots: &mut SlotSet) -> Result<(), Error> {
    let dihedral = Dihedral { mesh, stars, sharp: libm::cos(angle.to_radians()) };
    let mut edges = Vec::new();
    for v in 0..stars.len() as u32 {
        for (i, &r) in stars.ring(v).iter().enumerate() {
            let seen_once = v < r || stars.ring(r).is_empty();
            if let Some(flanks) = stars.flanks(v, i).filter(|_| seen_once)
                && dihedral.is_sharp(v, r, flanks)
            {
                edges.push(([v, r], dihedral.is_clear(v, r, flanks)));
            }
        }
    }
    let mut patches = Patches::new(stars.len())?;
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
    /// Cosine of the angle above which an edge is sharp.
    sharp: f64,
}

impl Dihedral<'_> {
    /// Whether the edge v–r, with the third corners `before` and `after` of its triangles, is sharp. Beside a triangle that
    /// is folded over none is.
    fn is_sharp(&self, v: u32, r: u32, [before, after]: [u32; 2]) -> bool {
        let sides = [[r, v, before], [v, r, after]];
        cosine(self.side(sides[0]), self.side(sides[1])) < self.sharp
            && !sides.into_iter().any(|triangle| self.stars.is_folded(self.mesh, triangle))
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
        let own = self.normal(triangle);
        if Sides::new(self.mesh.corners(&triangle)).shape() >= THIN {
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
        let [a, b, c] = self.mesh.corners(&triangle);
        (b - a).cross(c - a)
    }
}

/// Cosine of the angle between two directions; 1 where one is none.
fn cosine(a: DVec3, b: DVec3) -> f64 {
    let square = a.length_squared() * b.length_squared();
    if square > 0.0 { a.dot(b) / square.sqrt() } else { 1.0 }
}

/// Connected sets of sharp edges (union-find over the vertices).
struct Patches {
    parents: Vec<u32>,
    edges: Vec<u32>,
    unclear: Vec<bool>,
}

impl Patches {
    fn new(vertex_count: usize) -> Result<Self, Error> {
        let mut parents = memory::reserved(vertex_count)?;
        parents.extend(0..vertex_count as u32);
        Ok(Self { parents, edges: memory::filled(0, vertex_count)?, unclear: memory::filled(false, vertex_count)? })
    }

    fn root(&mut self, mut v: u32) -> u32 {
        while self.parents[v as usize] != v {
            let grandparent = self.parents[self.parents[v as usize] as usize];
            self.parents[v as usize] = grandparent;
            v = grandparent;
        }
        v
    }

    fn join(&mut self, [a, b]: [u32; 2]) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }

    fn count(&mut self, [a, _]: [u32; 2], clear: bool) {
        let root = self.root(a) as usize;
        self.edges[root] += 1;
        self.unclear[root] |= !clear;
    }

    fn is_credible(&mut self, [a, _]: [u32; 2]) -> bool {
        let root = self.root(a) as usize;
        self.edges[root] >= SHORT || !self.unclear[root]
    }
}
