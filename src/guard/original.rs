//! What the original mesh says of a star: normals not to turn from, planes not to leave.

use fearless_simd::prelude::*;
use glam::DVec3;

use super::Scene;
use super::witness::Witness;
use crate::star::{LANES, Numbers, Truths, Vectors};

/// Original shape below which a triangle's normal says nothing: comparing with it would freeze exactly those triangles
/// that need to move.
const MEANINGLESS: f64 = 1e-3;

/// Original shape below which a triangle's plane is not worth keeping.
const THIN: f64 = 0.3;

/// The original triangles of a star.
#[derive(Default)]
pub(super) struct Original {
    /// As many as the largest star so far has had.
    chunks: Vec<Stored>,
}

/// Eight original triangles.
#[derive(Clone, Copy, Default)]
struct Stored {
    /// Normals, twice as long as the areas; zero where they say nothing.
    normals: [[f64; LANES]; 3],
    /// Squared lengths of the normals of planes worth keeping, else 0.
    planes: [f64; LANES],
}

impl Original {
    /// Looks at the original star. Returns the squared distances from the centre to the ring, to be summed.
    #[inline(always)]
    pub fn look<S: Simd>(&mut self, simd: S, scene: &Scene<'_>) -> Numbers<S> {
        let &Scene { mesh, star, vertex, .. } = scene;
        let none = Numbers::splat(simd, 0.0);
        let centre = mesh.positions[vertex as usize];
        let mut square = none;
        if self.chunks.len() < star.chunks() {
            self.chunks.resize(star.chunks(), Stored::default());
        }
        for chunk in 0..star.chunks() {
            let [a, b] = star.edges_in(simd, chunk, centre, |r| mesh.positions[r as usize]);
            let witness = Witness::new(a, b);
            square += star.present(simd, chunk).select(b.square(), none);
            let normal = witness.normal.or(witness.exceeds(MEANINGLESS), Vectors::splat(simd, DVec3::ZERO));
            let plane = witness.exceeds(THIN).select(witness.normal.square(), none);
            normal.store(&mut self.chunks[chunk].normals);
            plane.store_array(&mut self.chunks[chunk].planes);
        }
        square
    }

    /// Strikes out triangles that came folded over.
    #[cold]
    pub fn forget_folded(&mut self, &Scene { mesh, stars, star, vertex, .. }: &Scene<'_>) {
        let area: DVec3 = (0..star.valence()).map(|i| self.chunks[i / LANES].normal(i % LANES)).sum();
        for i in 0..star.valence() {
            let (chunk, lane) = (&mut self.chunks[i / LANES], i % LANES);
            let opposes = chunk.normal(lane).dot(area) < 0.0;
            let [r, s] = star.rim_edge(i);
            if opposes && stars.is_folded(mesh, [vertex, r, s]) {
                chunk.normals.iter_mut().for_each(|axis| axis[lane] = 0.0);
                chunk.planes[lane] = 0.0;
            }
        }
    }

    /// Chunk number `chunk`.
    #[inline(always)]
    pub fn chunk<S: Simd>(&self, simd: S, chunk: usize) -> Normals<S> {
        let Stored { normals, planes } = &self.chunks[chunk];
        Normals { normals: Vectors::from_arrays(simd, normals), planes: Numbers::load_array_ref(simd, planes) }
    }
}

impl Stored {
    fn normal(&self, lane: usize) -> DVec3 {
        DVec3::from_array(self.normals.map(|axis| axis[lane]))
    }
}

/// The original normals of a chunk.
pub(super) struct Normals<S: Simd> {
    normals: Vectors<S>,
    planes: Numbers<S>,
}

impl<S: Simd> Normals<S> {
    /// Where triangles with these normals (of any length) have turned from their originals by less than an angle below 90°,
    /// given by its squared cosine.
    #[inline(always)]
    pub fn agree_with(&self, normals: Vectors<S>, squared_cosine: f64) -> Truths<S> {
        let along = self.normals.dot(normals);
        let bound = self.normals.square() * squared_cosine * normals.square();
        along.simd_ge(0.0) & (along * along).simd_ge(bound)
    }

    /// Where a vertex that has gone from its original place by `now` is at most `reach` (squared) from the original
    /// plane, or at least no farther than it was at `before`.
    #[inline(always)]
    pub fn are_near(&self, simd: S, before: DVec3, now: DVec3, squared_reach: f64) -> Truths<S> {
        let before = self.normals.dot(Vectors::splat(simd, before));
        let now = self.normals.dot(Vectors::splat(simd, now));
        let now = now * now;
        self.planes.simd_eq(0.0) | now.simd_le(self.planes * squared_reach) | now.simd_le(before * before)
    }
}
