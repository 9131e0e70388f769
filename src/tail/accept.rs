//! Which candidates may replace a patch: the promises of the library, checked one by one.

use glam::DVec3;

use super::cavity::sides;
use super::limits::Limits;
use super::live::Live;
use super::patch::{Freedom, LARGEST_STAR, Patch, Piece, Shape};
use super::report::Reason;
use super::topology::{self, fresh};
use crate::deviation::{Surface, nearest_on_triangle};
use crate::quality::triangle::Sides;
use crate::sweep::Surroundings;

/// Cosine of the largest angle, 75°, between a new triangle and the original surface at its corners.
const LEAST_AGREEMENT: f64 = 0.258_819_045_102_520_76;

/// Cosine of the angle, 45°, to which an edge beside a changed triangle may be bent, if it was not bent more before.
const LEAST_FLATNESS: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Mean-ratio shape below which a triangle's normal is not believed.
const THIN: f64 = 0.1;

/// Greatest distance of a removed vertex's original place, and of the middle of an edge that is gone, from the new
/// triangles, in units of the mean edge of the patch:
/// where the shape of the surface is to be kept, and elsewhere, where the sweeps may have gone as far.
const LOST: [f64; 2] = [0.12, 0.3];

/// Looks at candidates for one patch.
pub(super) struct Judge<'a> {
    pub around: &'a Surroundings<'a>,
    pub live: &'a Live<'a>,
    pub patch: &'a Patch,
    pub limits: &'a Limits,
}

impl Judge<'_> {
    /// Why `shape` must not replace the patch; `None` if it may.
    pub fn objection(&self, shape: &Shape) -> Option<Reason> {
        let changed: Vec<_> = shape.pieces.iter().filter(|p| self.is_changed(shape, p)).collect();
        let replaced: Vec<_> = self.patch.shape.pieces.iter().filter(|p| !shape_has(shape, p, self.patch)).collect();
        if fresh(shape).next().is_some() && topology::is_broken(self.live, self.patch, shape) {
            Some(Reason::Topology)
        } else if self.worsens(shape, &changed, &replaced) || self.bends(shape, &changed, &replaced) {
            Some(Reason::Fold)
        } else {
            self.strays(shape).then_some(Reason::Deviation)
        }
    }

    fn is_changed(&self, shape: &Shape, piece: &Piece) -> bool {
        piece.slot.is_none() || piece.corners.iter().any(|&v| shape.positions[v] != self.patch.shape.positions[v])
    }

    /// Whether the worst of the changed triangles is worse than before: below the floor, or in one of the measures of the
    /// tail.
    fn worsens(&self, shape: &Shape, changed: &[&Piece], replaced: &[&Piece]) -> bool {
        let worst = |shape: &Shape, pieces: &[&Piece]| {
            pieces.iter().map(|p| Sides::new(shape.corners(p)).shape()).fold(f64::INFINITY, f64::min)
        };
        let after = worst(shape, changed);
        let greatest = |shape: &Shape, pieces: &[&Piece]| {
            let parts = pieces.iter().map(|p| self.limits.parts(shape.corners(p)));
            parts.fold([1.0; 3], |m: [f64; 3], p| std::array::from_fn(|k| m[k].max(p[k])))
        };
        let (old, new) = (greatest(&self.patch.shape, replaced), greatest(shape, changed));
        // Written so that NaN, too, is refused.
        old.iter().zip(new).any(|(&old, new)| new > old)
            || !(after >= self.around.floor || after >= worst(&self.patch.shape, replaced))
    }

    /// Whether a new triangle turns from the original surface, or an edge is bent more sharply than any was before.
    fn bends(&self, shape: &Shape, changed: &[&Piece], replaced: &[&Piece]) -> bool {
        let turned = |p: &Piece| {
            let normal = normal(shape.corners(p));
            let original = self.original_normal(p);
            normal.dot(original) < LEAST_AGREEMENT * normal.length() * original.length()
        };
        let believed = |p: &&&Piece| Sides::new(self.patch.shape.corners(p)).shape() >= THIN;
        let before = replaced.iter().filter(believed).map(|p| self.flatness(&self.patch.shape, p));
        let least = before.fold(LEAST_FLATNESS, f64::min);
        fresh(shape).any(turned) || changed.iter().any(|p| self.flatness(shape, p) < least)
    }

    /// Sum of the unit normals of the original stars of the corners, the largest stars left out.
    fn original_normal(&self, piece: &Piece) -> DVec3 {
        let Surroundings { mesh, stars, .. } = *self.around;
        let vertices = piece.corners.iter().map(|&v| self.patch.vertices[v]);
        let bounded = vertices.filter(|&v| stars.ring(v).len() <= LARGEST_STAR);
        bounded.map(|v| stars.double_area(mesh, v).normalize_or_zero()).sum()
    }

    /// Least cosine between a piece and its neighbours; neighbours beyond features and neighbours without area don't count.
    fn flatness(&self, shape: &Shape, piece: &Piece) -> f64 {
        let own = normal(shape.corners(piece));
        let inner = sides(piece).into_iter().filter(|&(a, b)| !self.patch.is_feature(self.around, a, b));
        let neighbours = inner.filter_map(|(a, b)| self.beyond(shape, a, b));
        neighbours.map(|corners| cosine(own, normal(corners))).fold(1.0, f64::min)
    }

    /// The triangle beyond the edge a → b, in the patch or outside.
    fn beyond(&self, shape: &Shape, a: usize, b: usize) -> Option<[DVec3; 3]> {
        if let Some((piece, _)) = shape.beside(b, a) {
            return Some(shape.corners(&shape.pieces[piece]));
        }
        if self.patch.shape.beside(b, a).is_some() {
            return None;
        }
        let (from, to) = (self.patch.vertices[b], self.patch.vertices[a]);
        let has_edge = |t: &[u32; 3]| (0..3).any(|k| t[k] == from && t[(k + 1) % 3] == to);
        let slots = self.live.around_all(&[from, to]).iter();
        slots.copied().find(|&s| has_edge(&self.live.triangles[s as usize])).map(|s| self.live.corners(s))
    }

    /// Whether a moved vertex or the middle of a new edge lies too far from the original surface, or a vertex that is no
    /// longer there too far from what took its place.
    fn strays(&self, shape: &Shape) -> bool {
        let Surroundings { mesh, stars, max_deviation, keeps_shape, .. } = *self.around;
        let surface = Surface::new(mesh, stars);
        let vertices = &self.patch.vertices;
        let far = |bound: f64| {
            let moved = (0..vertices.len()).filter(|&v| shape.positions[v] != self.patch.shape.positions[v]);
            let middle = |(a, b): (usize, usize)| (vertices[a], (shape.positions[a] + shape.positions[b]) * 0.5);
            let is_new = |&(a, b): &(usize, usize)| {
                self.patch.shape.beside(a, b).is_none() && self.patch.shape.beside(b, a).is_none()
            };
            let middles = fresh(shape).flat_map(sides).filter(is_new).map(middle);
            let places = moved.map(|v| (vertices[v], shape.positions[v]));
            places.chain(middles).any(|(v, p)| surface.distance(v, p) > bound)
        };
        let lost = self.lost_height(shape);
        max_deviation.is_some_and(|bound| lost > bound || far(bound))
            || lost.max(self.cut_height(shape)) > LOST[usize::from(!keeps_shape)] * mean_edge(&self.patch.shape)
    }

    /// Greatest distance of a removed vertex from the triangles of `shape`.
    pub fn lost_height(&self, shape: &Shape) -> f64 {
        let lost = self.lost(shape).map(|v| self.around.mesh.position(self.patch.vertices[v]));
        lost.map(|p| distance(p, shape)).fold(0.0, f64::max)
    }

    /// Greatest distance of the middle of an edge of the patch that is gone from the triangles of `shape`.
    fn cut_height(&self, shape: &Shape) -> f64 {
        if fresh(shape).next().is_none() {
            return 0.0;
        }
        let old = &self.patch.shape;
        let is_gone = |&(a, b): &(usize, usize)| shape.beside(a, b).is_none() && shape.beside(b, a).is_none();
        let gone = old.pieces.iter().flat_map(sides).filter(is_gone);
        let middle = |(a, b): (usize, usize)| (old.positions[a] + old.positions[b]) * 0.5;
        gone.map(|edge| distance(middle(edge), shape)).fold(0.0, f64::max)
    }

    /// Vertices that no triangle has any more.
    pub fn lost<'s>(&'s self, shape: &'s Shape) -> impl Iterator<Item = usize> + 's {
        let is_free = |v: &usize| self.patch.freedom[*v] == Freedom::Full;
        (0..self.patch.vertices.len()).filter(is_free).filter(|v| shape.pieces.iter().all(|p| !p.corners.contains(v)))
    }
}

/// Whether `shape` has this piece of the patch, unmoved.
fn shape_has(shape: &Shape, piece: &Piece, patch: &Patch) -> bool {
    shape.pieces.contains(piece) && piece.corners.iter().all(|&v| shape.positions[v] == patch.shape.positions[v])
}

/// Distance from a point to the triangles of a shape.
fn distance(point: DVec3, shape: &Shape) -> f64 {
    let nearest = shape.pieces.iter().map(|t| nearest_on_triangle(point, shape.corners(t)).distance(point));
    nearest.fold(f64::INFINITY, f64::min)
}

fn mean_edge(shape: &Shape) -> f64 {
    let lengths = shape.pieces.iter().flat_map(sides).map(|(a, b)| shape.positions[a].distance(shape.positions[b]));
    lengths.sum::<f64>() / (3 * shape.pieces.len()) as f64
}

fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Cosine of the angle between two directions; 1 where one is none.
fn cosine(a: DVec3, b: DVec3) -> f64 {
    let square = a.length_squared() * b.length_squared();
    if square > 0.0 { a.dot(b) / square.sqrt() } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::{Constraints, Options};
    use crate::preparation::Preparation;
    use crate::tail::options::TailOptions;
    use crate::threads::Threads;

    /// A hexagonal star of triangles in a plane; its centre is vertex 0.
    fn star() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let h = 0.75_f64.sqrt();
        let ring = [[1.0, 0.0], [0.5, h], [-0.5, h], [-1.0, 0.0], [-0.5, -h], [0.5, -h]];
        let positions = [[0.0; 2]].iter().chain(&ring).map(|p| [p[0], p[1], 0.0]).collect();
        (positions, (0..6).map(|i| [0, 1 + i, 1 + (i + 1) % 6]).collect())
    }

    /// What speaks against a change of the patch of the whole mesh.
    fn objection(floor: f64, tail: &TailOptions<'_>, change: impl Fn(&mut Shape)) -> Option<Reason> {
        let (positions, triangles) = star();
        let options = Options { quality_floor: floor, ..Options::default() };
        let prepared =
            Preparation::new(positions.as_slice(), &triangles, &options, &Constraints::default(), &Threads::ONE)
                .expect("valid");
        let around = prepared.surroundings(&options);
        let live = Live::new(&prepared.mesh, prepared.mesh.positions.doubled().expect("enough memory"))
            .expect("enough memory");
        let patch = Patch::of_stars(&live, &around, &[0]);
        let mut shape = patch.shape.clone();
        change(&mut shape);
        Judge { around: &around, live: &live, patch: &patch, limits: &Limits::new(tail) }.objection(&shape)
    }

    #[test]
    fn a_small_move_is_welcome() {
        let change = |shape: &mut Shape| shape.positions[0] += DVec3::new(0.05, 0.05, 0.0);
        assert_eq!(objection(0.5, &TailOptions::default(), change), None);
    }

    #[test]
    fn a_shape_below_the_floor_is_refused() {
        let change = |shape: &mut Shape| shape.positions[0] += DVec3::new(0.5, 0.0, 0.0);
        let open = TailOptions { edge_ratio: 100.0, min_angle: 1.0, max_angle: 179.0, ..TailOptions::default() };
        assert_eq!(objection(0.9, &open, change), Some(Reason::Fold));
        assert_eq!(objection(0.1, &open, change), None);
    }

    #[test]
    fn a_measure_of_the_tail_that_gets_worse_is_refused() {
        let change = |shape: &mut Shape| shape.positions[0] += DVec3::new(0.5, 0.0, 0.0);
        let strict = TailOptions { edge_ratio: 1.5, min_angle: 1.0, max_angle: 179.0, ..TailOptions::default() };
        assert_eq!(objection(0.1, &strict, change), Some(Reason::Fold));
    }

    #[test]
    fn a_sharp_bend_is_refused() {
        let change = |shape: &mut Shape| shape.positions[0].z += 2.0;
        assert_eq!(objection(0.0, &TailOptions::default(), change), Some(Reason::Fold));
    }

    #[test]
    fn the_edge_that_a_flip_takes_away_counts_as_lost_surface() {
        let (mut positions, triangles) = star();
        positions[0][2] = 0.1;
        positions[1][2] = 0.1;
        let prepared = Preparation::new(
            positions.as_slice(),
            &triangles,
            &Options::default(),
            &Constraints::default(),
            &Threads::ONE,
        )
        .expect("valid");
        let around = prepared.surroundings(&Options::default());
        let live = Live::new(&prepared.mesh, prepared.mesh.positions.doubled().expect("enough memory"))
            .expect("enough memory");
        let patch = Patch::of_stars(&live, &around, &[0]);
        let limits = Limits::new(&TailOptions::default());
        let judge = Judge { around: &around, live: &live, patch: &patch, limits: &limits };
        assert_eq!(judge.cut_height(&patch.shape), 0.0);
        // Without the triangles beside it the ridge 0–1 is gone; the next surface is the triangle 0–2–3 or 0–5–6.
        let mut shape = patch.shape.clone();
        shape.pieces.iter_mut().for_each(|piece| piece.slot = None);
        let ridge = [0, 1].map(|v| patch.vertices.iter().position(|&p| p == v).expect("in the patch"));
        shape.pieces.retain(|piece| !ridge.iter().all(|v| piece.corners.contains(v)));
        assert!(judge.cut_height(&shape) > 0.3, "{}", judge.cut_height(&shape));
    }

    #[test]
    fn triangles_that_turn_their_backs_are_refused() {
        let change = |shape: &mut Shape| {
            shape.pieces.iter_mut().for_each(|piece| piece.slot = None);
            shape.positions.iter_mut().for_each(|p| p.x = -p.x);
        };
        assert_eq!(objection(0.0, &TailOptions::default(), change), Some(Reason::Fold));
    }
}
