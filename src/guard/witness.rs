//! What the guard knows of each triangle of a star before the move.

use glam::DVec3;

use crate::star::{LocalStar, double_vector_area};

/// One triangle of the star. Shapes and angles are compared by their squares, which saves the square roots.
pub(super) struct Witness {
    /// Vector area of the sector that the triangle lies in.
    pub outward: DVec3,
    /// Squared mean-ratio shape, negative if the triangle is folded against its sector.
    pub shape: f64,
    /// Normal in the original mesh, twice as long as the area; zero where that says nothing.
    pub normal: DVec3,
    /// The same, zero also where the original triangle was too thin to define a plane worth keeping.
    pub plane: DVec3,
}

impl Witness {
    /// Whether a triangle with this normal (of any length) has turned from its original by more than an angle below 90°,
    /// given by its squared cosine.
    pub fn is_turned(&self, normal: DVec3, squared_cosine: f64) -> bool {
        let along = self.normal.dot(normal);
        along < 0.0 || along * along < squared_cosine * self.normal.length_squared() * normal.length_squared()
    }

    /// Whether a vertex that has gone from its original place by `now` is at most `reach` (squared) from the original
    /// plane, or at least no farther than it was at `before`.
    pub fn is_near(&self, before: DVec3, now: DVec3, squared_reach: f64) -> bool {
        let (before, now) = (self.plane.dot(before), self.plane.dot(now));
        now * now <= squared_reach * self.plane.length_squared() || now * now <= before * before
    }
}

/// One witness for each triangle, knowing nothing of the original yet.
pub(super) fn of_shapes(star: &LocalStar, witnesses: &mut Vec<Witness>) {
    for sector in star.sectors() {
        let outward = double_vector_area(sector);
        witnesses.extend(sector.windows(2).map(|edge| {
            let shape = signed_squared_shape(edge[0], edge[1], edge[0].cross(edge[1]), outward);
            Witness { outward, shape, normal: DVec3::ZERO, plane: DVec3::ZERO }
        }));
    }
}

/// Squared mean-ratio shape of the triangle (0, a, b) with a × b = `normal`, negative if it turns against `outward`.
pub(super) fn signed_squared_shape(a: DVec3, b: DVec3, normal: DVec3, outward: DVec3) -> f64 {
    let sum = a.length_squared() + b.length_squared() + (b - a).length_squared();
    if sum == 0.0 {
        return 0.0;
    }
    // (2√3·|a × b| / sum)²
    let square = 12.0 * normal.length_squared() / (sum * sum);
    if normal.dot(outward) < 0.0 { -square } else { square }
}
