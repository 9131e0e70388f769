//! The guard: which moves are allowed. No star's worst triangle gets worse below the floor, none folds over, and none
//! leaves the original surface where that has a shape to keep.

mod original;
mod witness;

use fearless_simd::prelude::*;
use glam::DVec3;

use crate::mesh::{Mesh, Stars};
use crate::star::{Chunk, LocalStar, Vectors, sum};
use original::Original;
use witness::Witness;

/// Largest angle in degrees by which a triangle's normal may turn against its original one.
const LARGEST_TURN: f64 = 75.0;

/// How far a vertex may go from where it was in the original mesh, in units of its star's original size.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Leash {
    /// From the planes of its original triangles.
    pub planes: f64,
    /// From its original place.
    pub place: f64,
}

impl Leash {
    /// No bound at all.
    pub const NONE: Self = Self { planes: f64::INFINITY, place: f64::INFINITY };
}

/// What is to be looked at: a star as it is, and the mesh as it was.
pub(crate) struct Scene<'a> {
    pub mesh: &'a Mesh<'a>,
    pub stars: &'a Stars,
    pub star: &'a LocalStar,
    /// Number of the vertex in the centre.
    pub vertex: u32,
    /// Twice the vector areas of the star's sectors.
    pub areas: [DVec3; 2],
}

/// The guard and what it has found out about one star.
pub(crate) struct Guard {
    /// Squared shape that the worst triangle of a star may not fall below.
    floor: f64,
    /// Squared cosine of the largest turn.
    least_cosine: f64,
    original: Original,
    /// Squared distances in the units of the coordinates.
    leash: Leash,
    /// How far the centre is already from where it was in the original mesh.
    drift: DVec3,
    /// The least squared shape that a triangle must have after the move, if somebody had to ask.
    bar: Option<f64>,
}

impl Guard {
    /// A guard with this quality floor (mean-ratio shape, 0 to 1).
    pub fn new(floor: f64) -> Self {
        let cosine = libm::cos(LARGEST_TURN.to_radians());
        Self {
            floor: floor * floor,
            least_cosine: cosine * cosine,
            original: Original::default(),
            leash: Leash::NONE,
            drift: DVec3::ZERO,
            bar: None,
        }
    }

    /// Looks at a star as it was in the original mesh.
    #[inline(always)]
    pub fn inspect<S: Simd>(&mut self, simd: S, scene: &Scene<'_>, leash: Leash) {
        let square = self.original.look(simd, scene);
        self.leash = leash;
        if leash.planes < f64::INFINITY {
            let size = sum(square) / scene.star.valence() as f64;
            self.leash = Leash { planes: leash.planes * leash.planes * size, place: leash.place * leash.place * size };
        }
        self.drift = scene.star.centre - scene.mesh.positions[scene.vertex as usize];
        self.bar = None;
    }

    /// Whether the centre of the inspected star may move by `step`.
    ///
    /// Most steps leave no triangle below the floor and meet no triangle that came folded over; only for the others does it
    /// matter how good the star is now, and which of its triangles were folded.
    #[inline(always)]
    pub fn admits<S: Simd>(&mut self, simd: S, scene: &Scene<'_>, step: DVec3) -> bool {
        if (self.drift + step).length_squared() > self.leash.place {
            return false;
        }
        self.keeps_all(simd, scene, step, self.floor) || self.admits_after_all(simd, scene, step)
    }

    #[inline(always)]
    fn admits_after_all<S: Simd>(&mut self, simd: S, scene: &Scene<'_>, step: DVec3) -> bool {
        let bar = match self.bar {
            Some(bar) => bar,
            None => {
                self.original.forget_folded(scene);
                let bar = self.least_shape(simd, scene);
                self.bar = Some(bar);
                bar
            }
        };
        self.keeps_all(simd, scene, step, bar)
    }

    /// The least squared shape in the star, or the floor if that is less.
    #[inline(always)]
    fn least_shape<S: Simd>(&self, simd: S, scene: &Scene<'_>) -> f64 {
        let mut bar = self.floor;
        for chunk in 0..scene.star.chunks() {
            let Chunk { a, b, present, .. } = scene.star.chunk(simd, chunk);
            let least = Witness::new(a, b).least(simd, present);
            bar = if least < bar { least } else { bar };
        }
        bar
    }

    /// Whether the step keeps the promises if no squared shape may be below `bar`.
    #[inline(always)]
    fn keeps_all<S: Simd>(&self, simd: S, scene: &Scene<'_>, step: DVec3, bar: f64) -> bool {
        for chunk in 0..scene.star.chunks() {
            if !self.keeps(simd, scene, step, bar, chunk) {
                return false;
            }
        }
        true
    }

    /// The same for eight triangles.
    #[inline(always)]
    fn keeps<S: Simd>(&self, simd: S, scene: &Scene<'_>, step: DVec3, bar: f64, chunk: usize) -> bool {
        let Chunk { a, b, present, second } = scene.star.chunk(simd, chunk);
        let moved = Vectors::splat(simd, step);
        let after = Witness::new(a.minus(moved), b.minus(moved));
        let original = self.original.chunk(simd, chunk);
        let mut kept = after.reaches(bar) & original.agree_with(after.normal, self.least_cosine);
        if self.leash.planes < f64::INFINITY {
            kept &= original.are_near(simd, self.drift, self.drift + step, self.leash.planes);
        }
        let mut outward = Vectors::splat(simd, scene.areas[0]);
        if scene.star.is_crease() {
            outward = Vectors::splat(simd, scene.areas[1]).or(second, outward);
        }
        (kept | !present).all_true()
            && (!(after.oppose(outward) & present).any_true()
                || (after.unfolds(simd, &Witness::new(a, b), outward) | !present).all_true())
    }
}
