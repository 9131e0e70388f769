//! One star taken out of the mesh: its ring, relative to its centre.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::DVec3;

use super::lanes::{self, LANES, Truths, Vectors};
use crate::mesh::Stars;

/// A star relative to its centre, so that nothing depends on where in space it lies. Triangle i is
/// (centre, rim vertex i, rim vertex i + 1). Reused from star to star.
#[derive(Default)]
pub(crate) struct LocalStar {
    /// Position of the centre.
    pub centre: DVec3,
    /// Rim vertex at which the second sector begins; the star of a crease vertex has two, any other star one.
    pub split: usize,
    valence: usize,
    /// As many as the largest star so far has had.
    stretches: Vec<Stretch>,
}

/// The rim of eight triangles. Behind the last triangle of the star its end is repeated: edges without length.
#[derive(Clone, Copy, Default)]
struct Stretch {
    /// Numbers of the rim vertices; of a closed star the first one comes again at the end.
    vertices: [u32; LANES + 1],
    /// Starts of the rim edges relative to the centre.
    a: [[f64; LANES]; 3],
    /// Their ends.
    b: [[f64; LANES]; 3],
}

/// Up to eight triangles of a star: triangle i is (centre, a\[i\], b\[i\]). Lanes that are left over hold a triangle
/// without area.
#[derive(Clone, Copy)]
pub(crate) struct Chunk<S: Simd> {
    pub a: Vectors<S>,
    pub b: Vectors<S>,
    /// Lanes with a triangle.
    pub present: Truths<S>,
    /// Lanes of the second sector.
    pub second: Truths<S>,
}

impl LocalStar {
    /// Takes up the whole star of `v`; `at` tells the position of a vertex.
    #[inline(always)]
    pub fn take<S: Simd>(&mut self, simd: S, stars: &Stars, at: impl Fn(u32) -> DVec3, v: u32) {
        self.take_rim(simd, stars.rim(v), at(v), at);
    }

    /// Takes up the closed star of a crease vertex: two sectors, between the ring vertices number `first` and `second`.
    #[inline(always)]
    pub fn take_crease<S: Simd>(
        &mut self,
        simd: S,
        stars: &Stars,
        at: impl Fn(u32) -> DVec3,
        v: u32,
        [first, second]: [usize; 2],
    ) {
        let ring = stars.ring(v);
        let rim = [&ring[first..], &ring[..=first]].concat();
        self.take_rim(simd, &rim, at(v), at);
        self.split = second - first;
    }

    /// Takes up a closed star from its ring: vertex numbers and positions, the first ones not repeated. The second sector
    /// starts at the ring vertex number `split`; `None`: there is none.
    pub fn take_ring(&mut self, centre: DVec3, ring: &[(u32, DVec3)], split: Option<usize>) {
        let rim: Vec<u32> = (0..ring.len() as u32).chain([0]).collect();
        dispatch!(Level::baseline(), simd => self.take_rim(simd, &rim, centre, |i| ring[i as usize].1));
        let chunks = self.chunks();
        for stretch in &mut self.stretches[..chunks] {
            stretch.vertices = stretch.vertices.map(|i| ring[i as usize].0);
        }
        self.split = split.unwrap_or(ring.len());
    }

    /// Takes up the star with this rim, one sector.
    #[inline(always)]
    fn take_rim<S: Simd>(&mut self, simd: S, rim: &[u32], centre: DVec3, at: impl Fn(u32) -> DVec3) {
        self.centre = centre;
        self.valence = rim.len() - 1;
        self.split = self.valence;
        if self.stretches.len() < self.chunks() {
            self.stretches.resize(self.chunks(), Stretch::default());
        }
        for chunk in 0..self.chunks() {
            let stretch = &mut self.stretches[chunk];
            stretch.vertices = nine(&rim[chunk * LANES..]);
            let [a, b] = edges(simd, &stretch.vertices, centre, &at);
            a.store(&mut stretch.a);
            b.store(&mut stretch.b);
        }
    }

    /// Starts and ends of the rim edges of a chunk relative to `centre` in another mesh, where `at` tells the position of
    /// a vertex.
    #[inline(always)]
    pub fn edges_in<S: Simd>(
        &self,
        simd: S,
        chunk: usize,
        centre: DVec3,
        at: impl Fn(u32) -> DVec3,
    ) -> [Vectors<S>; 2] {
        edges(simd, &self.stretches[chunk].vertices, centre, &at)
    }

    /// Whether a crease divides the star into two sectors.
    #[inline(always)]
    pub fn is_crease(&self) -> bool {
        self.split < self.valence()
    }

    /// Number of triangles.
    #[inline(always)]
    pub fn valence(&self) -> usize {
        self.valence
    }

    /// Number of chunks.
    #[inline(always)]
    pub fn chunks(&self) -> usize {
        self.valence.div_ceil(LANES)
    }

    /// The lanes of a chunk with a triangle.
    #[inline(always)]
    pub fn present<S: Simd>(&self, simd: S, chunk: usize) -> Truths<S> {
        lanes::below(simd, chunk, self.valence())
    }

    /// Chunk number `chunk`.
    #[inline(always)]
    pub fn chunk<S: Simd>(&self, simd: S, chunk: usize) -> Chunk<S> {
        let Stretch { a, b, .. } = &self.stretches[chunk];
        Chunk {
            a: Vectors::from_arrays(simd, a),
            b: Vectors::from_arrays(simd, b),
            present: self.present(simd, chunk),
            second: !lanes::below(simd, chunk, self.split),
        }
    }

    /// Rim vertex number `i` relative to the centre.
    pub fn point(&self, i: usize) -> DVec3 {
        match i.checked_sub(1) {
            None => DVec3::from_array(self.stretches[0].a.map(|axis| axis[0])),
            Some(edge) => DVec3::from_array(self.stretches[edge / LANES].b.map(|axis| axis[edge % LANES])),
        }
    }

    /// The numbers of rim vertices `i` and `i + 1`.
    pub fn rim_edge(&self, i: usize) -> [u32; 2] {
        let vertices = &self.stretches[i / LANES].vertices;
        [vertices[i % LANES], vertices[i % LANES + 1]]
    }

    /// The rim relative to the centre.
    pub fn rim(&self) -> impl Iterator<Item = DVec3> + Clone {
        (0..=self.valence()).map(|i| self.point(i))
    }

    /// Twice the vector areas of the two sectors; the second one is zero where there is none.
    pub fn double_areas(&self) -> [DVec3; 2] {
        let mut areas = self.sectors().map(double_vector_area);
        [areas.next().unwrap_or_default(), areas.next().unwrap_or_default()]
    }

    /// Twice the vector area of the whole star.
    pub fn double_area(&self) -> DVec3 {
        double_vector_area(self.rim())
    }

    /// The sectors: stretches of the rim with the triangles between features.
    pub fn sectors(&self) -> impl Iterator<Item = impl Iterator<Item = DVec3> + Clone> {
        let second = self.is_crease().then_some(self.split..=self.valence());
        std::iter::once(0..=self.split).chain(second).map(|sector| sector.map(|i| self.point(i)))
    }
}

/// The first nine vertices of a rim that has one at least, its last one repeated where it has fewer.
#[inline(always)]
fn nine(rim: &[u32]) -> [u32; LANES + 1] {
    let last = rim.len() - 1;
    let at = |i: usize| rim[i.min(last)];
    [at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), at(8)]
}

/// Starts and ends of eight rim edges.
#[inline(always)]
fn edges<S: Simd>(simd: S, vertices: &[u32; LANES + 1], centre: DVec3, at: &impl Fn(u32) -> DVec3) -> [Vectors<S>; 2] {
    let [v0, v1, v2, v3, v4, v5, v6, v7, v8] = *vertices;
    let a = Vectors::of(simd, [at(v0), at(v1), at(v2), at(v3), at(v4), at(v5), at(v6), at(v7)]);
    let a = a.minus(Vectors::splat(simd, centre));
    [a, a.next(simd, at(v8) - centre)]
}

/// Twice the vector area of a fan about the origin: Σ A × B. For a closed star it is the vector area of the ring and does
/// not depend on where the centre is; moving the centre by d changes the enclosed volume by a sixth of its product with d.
pub(crate) fn double_vector_area(rim: impl Iterator<Item = DVec3> + Clone) -> DVec3 {
    rim.clone().zip(rim.skip(1)).fold(DVec3::ZERO, |sum, (a, b)| sum + a.cross(b))
}
