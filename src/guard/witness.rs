//! What the guard knows of each triangle of a star before the move.

use glam::DVec3;

use crate::star::{LocalStar, double_vector_area};

/// 2√3: mean-ratio shape = 2√3·|cross product| / Σ edge².
const TWO_ROOT_THREE: f64 = 3.464_101_615_137_754_6;

/// One triangle of the star.
pub(super) struct Witness {
    /// Vector area of the sector that the triangle lies in.
    pub outward: DVec3,
    /// Mean-ratio shape, negative if the triangle is folded against its sector.
    pub shape: f64,
    /// Unit normal in the original mesh; zero where that says nothing.
    pub normal: DVec3,
    /// The same, zero also where the original triangle was too thin to define a plane worth keeping.
    pub plane: DVec3,
}

impl Witness {
    /// Whether a triangle with this normal (of any length) has turned too far from its original.
    pub fn is_turned(&self, normal: DVec3, least_cosine: f64) -> bool {
        self.normal != DVec3::ZERO && self.normal.dot(normal) < least_cosine * normal.length()
    }
}

/// One witness for each triangle, knowing nothing of the original yet.
pub(super) fn of_shapes(star: &LocalStar, witnesses: &mut Vec<Witness>) {
    for sector in star.sectors() {
        let outward = double_vector_area(sector);
        witnesses.extend(sector.windows(2).map(|edge| {
            let shape = signed_shape(edge[0], edge[1], edge[0].cross(edge[1]), outward);
            Witness { outward, shape, normal: DVec3::ZERO, plane: DVec3::ZERO }
        }));
    }
}

/// Mean-ratio shape of the triangle (0, a, b) with a × b = `normal`, negative if it turns against `outward`.
pub(super) fn signed_shape(a: DVec3, b: DVec3, normal: DVec3, outward: DVec3) -> f64 {
    let sum = a.length_squared() + b.length_squared() + (b - a).length_squared();
    if sum == 0.0 {
        return 0.0;
    }
    let shape = TWO_ROOT_THREE * normal.length() / sum;
    if normal.dot(outward) < 0.0 { -shape } else { shape }
}
