//! The guard: which moves are allowed. No star's worst triangle gets worse below the floor, none folds over, and none
//! leaves the original surface where that has a shape to keep.

mod original;
mod witness;

use glam::DVec3;

use crate::mesh::{Mesh, Stars};
use crate::star::LocalStar;
use witness::{Witness, signed_squared_shape};

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

/// The guard with its working memory, reused from star to star.
pub(crate) struct Guard {
    /// Squared shape that the worst triangle of a star may not fall below.
    floor: f64,
    /// Squared cosine of the largest turn.
    least_cosine: f64,
    witnesses: Vec<Witness>,
    /// The least squared shape that a triangle must have after the move.
    bar: f64,
    /// Squared distances in the units of the coordinates.
    leash: Leash,
    /// How far the centre is already from where it was in the original mesh.
    drift: DVec3,
}

impl Guard {
    /// A guard with this quality floor (mean-ratio shape, 0 to 1).
    pub fn new(floor: f64) -> Self {
        let cosine = libm::cos(LARGEST_TURN.to_radians());
        Self {
            floor: floor * floor,
            least_cosine: cosine * cosine,
            witnesses: Vec::new(),
            bar: 0.0,
            leash: Leash::NONE,
            drift: DVec3::ZERO,
        }
    }

    /// Looks at the star of `v` as it is and as it was in the original mesh.
    pub fn inspect(&mut self, mesh: &Mesh<'_>, stars: &Stars, v: u32, star: &LocalStar, leash: Leash) {
        self.witnesses.clear();
        witness::of_shapes(star, &mut self.witnesses);
        let size = original::look(mesh, stars, v, star, &mut self.witnesses);
        self.bar = self.witnesses.iter().fold(self.floor, |least, w| least.min(w.shape.abs()));
        let squared = |length: f64| if length.is_finite() { length * length * size } else { length };
        self.leash = Leash { planes: squared(leash.planes), place: squared(leash.place) };
        self.drift = star.centre - mesh.positions[v as usize];
    }

    /// Whether the centre of the inspected star may move by `step`.
    pub fn admits(&self, star: &LocalStar, step: DVec3) -> bool {
        let now = self.drift + step;
        now.length_squared() <= self.leash.place
            && star.rim.windows(2).zip(&self.witnesses).all(|(edge, witness)| {
                let (a, b) = (edge[0] - step, edge[1] - step);
                let normal = a.cross(b);
                let shape = signed_squared_shape(a, b, normal, witness.outward);
                let unfolded = shape >= 0.0 || shape >= witness.shape;
                shape.abs() >= self.bar
                    && unfolded
                    && !witness.is_turned(normal, self.least_cosine)
                    && witness.is_near(self.drift, now, self.leash.planes)
            })
    }
}
