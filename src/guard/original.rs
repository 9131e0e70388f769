//! What the original mesh says of stars: normals not to turn from, planes not to leave.

use glam::DVec3;

use super::Scene;
use crate::star::{Arm, LocalStars, MEANINGLESS, Number, THIN, Vectors, Witness, set_vector, vector};

/// The original triangles of stars, as many as the largest star so far has had.
pub(super) struct Original<N: Number>(Vec<Triangle<N>>);

/// One original triangle of each star.
pub(super) struct Triangle<N: Number> {
    /// Normal, twice as long as the area; zero where it says nothing.
    normal: [N::Row; 3],
    /// Its squared length.
    square: N::Row,
    /// The same where the plane is worth keeping, else 0.
    plane: N::Row,
}

impl<N: Number> Default for Triangle<N> {
    fn default() -> Self {
        let row = N::Row::default();
        Self { normal: [row; 3], square: row, plane: row }
    }
}

impl<N: Number> Default for Original<N> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<N: Number> Original<N> {
    /// Looks at stars as they were. Returns the sums of the squared distances from the centre to the ring.
    #[inline(always)]
    pub fn look(&mut self, token: N::Token, stars: &LocalStars<N>) -> N {
        if self.0.len() < stars.longest() {
            self.0.resize_with(stars.longest(), Triangle::default);
        }
        let (centres, mut countdown) = (stars.origins(token), stars.countdown(token));
        let mut sum = N::splat(token, 0.0);
        let mut a = Arm::new(stars.spokes()[0].origin(token).minus(centres));
        for (triangle, spoke) in self.0.iter_mut().zip(&stars.spokes()[1..]) {
            let b = Arm::new(spoke.origin(token).minus(centres));
            let witness = Witness::new(a, b);
            sum = sum + b.square.only(token, countdown.next());
            let says = witness.exceeds(token, MEANINGLESS);
            Vectors::choose(says, witness.normal, Vectors::zero(token)).store(&mut triangle.normal);
            witness.square.only(token, says).store(&mut triangle.square);
            witness.square.only(token, witness.exceeds(token, THIN)).store(&mut triangle.plane);
            a = b;
        }
        sum
    }

    /// Strikes out the triangles of star number `star` that came folded over. Returns whether there are any.
    #[cold]
    pub fn forget_folded(&mut self, scene: &Scene<'_, N>, star: usize) -> bool {
        let triangles = &mut self.0[..scene.stars.valence_of(star)];
        let mut any = false;
        let area: DVec3 = triangles.iter().map(|triangle| vector(&triangle.normal, star)).sum();
        for (i, triangle) in triangles.iter_mut().enumerate() {
            let opposes = vector(&triangle.normal, star).dot(area) < 0.0;
            let corners =
                [scene.vertices.as_ref()[star], scene.stars.vertices(i)[star], scene.stars.vertices(i + 1)[star]];
            if opposes && scene.rings.is_folded(scene.mesh, corners) {
                set_vector(&mut triangle.normal, star, DVec3::ZERO);
                triangle.square.as_mut()[star] = 0.0;
                triangle.plane.as_mut()[star] = 0.0;
                any = true;
            }
        }
        any
    }

    /// How the triangles faced.
    #[inline(always)]
    pub fn triangles(&self) -> &[Triangle<N>] {
        &self.0
    }
}

impl<N: Number> Triangle<N> {
    #[inline(always)]
    pub fn facing(&self, token: N::Token) -> Facing<N> {
        Facing {
            normal: Vectors::load(token, &self.normal),
            square: N::load(token, &self.square),
            plane: N::load(token, &self.plane),
        }
    }
}

/// How an original triangle of each star faced.
pub(super) struct Facing<N> {
    normal: Vectors<N>,
    square: N,
    plane: N,
}

impl<N: Number> Facing<N> {
    /// Where triangles have turned from their originals by less than an angle below 90°, given by its squared cosine.
    #[inline(always)]
    pub fn agrees(&self, token: N::Token, now: &Witness<N>, squared_cosine: f64) -> N::Truth {
        let along = self.normal.dot(now.normal);
        let bound = self.square * N::splat(token, squared_cosine) * now.square;
        N::splat(token, 0.0).at_most(along) & bound.at_most(along * along)
    }

    /// Where a vertex that has gone from its original place by `now` is at most `reach` (squared) from the original
    /// plane, or at least no farther than it was at `before`.
    #[inline(always)]
    pub fn is_near(&self, token: N::Token, before: Vectors<N>, now: Vectors<N>, squared_reach: N) -> N::Truth {
        let before = self.normal.dot(before);
        let now = self.normal.dot(now);
        let now = now * now;
        self.plane.equals(N::splat(token, 0.0)) | now.at_most(self.plane * squared_reach) | now.at_most(before * before)
    }
}
