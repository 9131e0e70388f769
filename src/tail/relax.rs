//! Vertex moves that help the worst triangle of a star: volume-neutral, guarded, and no larger than needed.

use glam::{DVec2, DVec3};

use super::limits::Limits;
use super::patch::{Freedom, Patch, Shape};
use crate::deviation::Surface;
use crate::guard::{Guard, Scene};
use crate::star::{Draft, LocalStar, Site, TangentPlane};
use crate::sweep::{Surroundings, direction, volume_neutral};

/// Excess at which a star is good enough: just below the thresholds, so that rounding cannot bring it back.
const GOAL: f64 = 0.99;

/// First step of the search in units of the star's mean radius.
const REACH: f64 = 0.25;

/// Halvings of the step before the search ends.
const HALVINGS: u32 = 3;

/// Steps of a search at most.
const STEPS: u32 = 12;

/// What a step must leave at most of the excess to be worth taking.
const LEAST_GAIN: f64 = 0.998;

/// The eight directions of the search in a plane.
const DIRECTIONS: [DVec2; 8] = {
    const D: f64 = std::f64::consts::FRAC_1_SQRT_2;
    [
        DVec2::new(1.0, 0.0),
        DVec2::new(D, D),
        DVec2::new(0.0, 1.0),
        DVec2::new(-D, D),
        DVec2::new(-1.0, 0.0),
        DVec2::new(-D, -D),
        DVec2::new(0.0, -1.0),
        DVec2::new(D, -D),
    ]
};

/// Moves vertices of patches, with working memory that is reused.
pub(super) struct Relaxer<'a> {
    around: &'a Surroundings<'a>,
    limits: &'a Limits,
    star: LocalStar,
    draft: Draft<f64>,
    guard: Guard<f64>,
    /// Whether the guard has seen the star as it was taken up.
    inspected: bool,
    /// The triangle that last spoiled a step: likely to spoil the next one, so it is looked at first.
    culprit: usize,
}

impl<'a> Relaxer<'a> {
    pub fn new(around: &'a Surroundings<'a>, limits: &'a Limits) -> Self {
        Self {
            around,
            limits,
            star: LocalStar::default(),
            draft: Draft::default(),
            guard: Guard::new(around.floor),
            inspected: false,
            culprit: 0,
        }
    }

    /// Visits those of `vertices` that may move and whose stars are not good enough, round after round, until nothing
    /// moves. A vertex that has stayed is not visited again before something in its ring has moved.
    pub fn relax_all(&mut self, patch: &Patch, shape: &mut Shape, vertices: &[usize], rounds: usize) {
        let mut waiting: Vec<_> = patch.freedom.iter().map(|f| !matches!(f, Freedom::None(_))).collect();
        let mut ring = Vec::new();
        for _ in 0..rounds {
            let mut moved = false;
            for &v in vertices {
                if std::mem::take(&mut waiting[v]) && self.relax(patch, shape, v) {
                    moved = true;
                    shape.neighbours(v, &mut ring);
                    ring.iter().for_each(|&r| waiting[r] = !matches!(patch.freedom[r], Freedom::None(_)));
                    waiting[v] = true;
                }
            }
            if !moved {
                return;
            }
        }
    }

    /// Moves `v` so that the worst triangle of its star gets better. Says whether it has moved.
    fn relax(&mut self, patch: &Patch, shape: &mut Shape, v: usize) -> bool {
        if !self.take(patch, shape, v) {
            return false;
        }
        let worst = self.worst(DVec3::ZERO, f64::INFINITY);
        if worst <= GOAL {
            return false;
        }
        let Some(ways) = self.ways(patch.freedom[v]) else {
            return false;
        };
        let mut search = Search { step: DVec3::ZERO, worst };
        if let Some(target) = self.target(patch.freedom[v]) {
            self.try_step(&mut search, patch.vertices[v], target);
        }
        self.descend(&mut search, &ways, patch.vertices[v]);
        shape.positions[v] = self.around.mesh.storable(self.star.centre() + search.step);
        shape.positions[v] != self.star.centre()
    }

    /// Unit steps that leave the volume as it is: eight in the tangent plane, or two along the crease.
    fn ways(&self, freedom: Freedom) -> Option<Vec<DVec3>> {
        if freedom == Freedom::Slide {
            return direction(&self.star).map(|d| vec![d, -d]);
        }
        let plane = TangentPlane::orthogonal_to(self.star.double_area())?;
        Some(DIRECTIONS.iter().map(|&d| plane.lift(d)).collect())
    }

    /// Where the operation on the star would put a vertex that moves in its tangent plane.
    fn target(&mut self, freedom: Freedom) -> Option<DVec3> {
        if freedom == Freedom::Slide {
            return None;
        }
        let step = self.around.operation.target(&self.star, &mut self.draft)?;
        volume_neutral(step, self.star.double_area())
    }

    /// Pattern search: the best of the ways, with a step that is halved where none helps.
    fn descend(&mut self, search: &mut Search, ways: &[DVec3], vertex: u32) {
        let lengths: f64 = self.star.rim().skip(1).map(DVec3::length).sum();
        let mut reach = REACH * lengths / self.star.valence() as f64;
        let mut halvings = 0;
        for _ in 0..STEPS {
            if search.worst <= GOAL || halvings > HALVINGS {
                return;
            }
            let mut best = (search.worst * LEAST_GAIN, search.step);
            for way in ways {
                let step = search.step + *way * reach;
                let worst = self.worst(step, best.0);
                if worst < best.0 {
                    best = (worst, step);
                }
            }
            if best.1 == search.step || !self.try_step(search, vertex, best.1) {
                reach *= 0.5;
                halvings += 1;
            }
        }
    }

    /// Takes a step if it helps and may be taken.
    fn try_step(&mut self, search: &mut Search, vertex: u32, step: DVec3) -> bool {
        let new = self.around.mesh.storable(self.star.centre() + step);
        let step = new - self.star.centre();
        let bar = search.worst * LEAST_GAIN;
        let worst = self.worst(step, bar);
        let helps = worst < bar && self.admits(vertex, step);
        if helps {
            *search = Search { step, worst };
        }
        helps
    }

    /// The operation on the star of a vertex that moves in its tangent plane, as a sweep would carry it out. Says whether
    /// the vertex has moved.
    pub fn operate(&mut self, patch: &Patch, shape: &mut Shape, v: usize) -> bool {
        let moves = matches!(patch.freedom[v], Freedom::Full | Freedom::Move);
        if !moves || !self.take(patch, shape, v) {
            return false;
        }
        let Some(mut step) = self.target(patch.freedom[v]).map(|target| target * self.around.relaxation) else {
            return false;
        };
        let bar = self.worst(DVec3::ZERO, f64::INFINITY).max(GOAL);
        for _ in 0..=HALVINGS {
            let new = self.around.mesh.storable(self.star.centre() + step);
            let exact = new - self.star.centre();
            if self.worst(exact, f64::INFINITY) <= bar && self.admits(patch.vertices[v], exact) {
                shape.positions[v] = new;
                return exact != DVec3::ZERO;
            }
            step *= 0.5;
        }
        false
    }

    /// Takes up the star of `v`; false if it is no closed disc.
    pub fn take(&mut self, patch: &Patch, shape: &Shape, v: usize) -> bool {
        let Some(mut ring) = shape.ring(v) else {
            return false;
        };
        let mut split = None;
        if patch.freedom[v] == Freedom::Slide {
            let marked: Vec<_> = (0..ring.len()).filter(|&i| patch.is_feature(self.around, v, ring[i])).collect();
            let [first, second] = marked[..] else {
                return false;
            };
            ring.rotate_left(first);
            split = Some(second - first);
        }
        let mesh = self.around.mesh;
        let site = |&r: &usize| {
            let vertex = patch.vertices[r];
            Site { vertex, place: shape.positions[r], origin: mesh.position(vertex) }
        };
        let sites: Vec<_> = ring.iter().map(site).collect();
        self.star.take_ring(site(&v), &sites, split);
        (self.inspected, self.culprit) = (false, 0);
        true
    }

    /// Whether guard and deviation bound let the centre of the star that was taken up, `vertex` in the mesh, go by `step`.
    pub fn admits(&mut self, vertex: u32, step: DVec3) -> bool {
        let Surroundings { mesh, stars: rings, max_deviation, .. } = *self.around;
        let scene = &Scene { mesh, rings, stars: &self.star, vertices: [vertex], areas: self.star.areas(()) };
        if !std::mem::replace(&mut self.inspected, true) {
            self.guard.look((), scene, |v| self.around.close_leash(v));
        }
        let is_near = |bound| Surface::new(mesh, rings).distance(vertex, self.star.centre() + step) <= bound;
        self.guard.admits((), scene, step.into(), 1) == 1 && max_deviation.is_none_or(is_near)
    }

    /// The nearest position that the caller's buffers can hold.
    pub fn storable(&self, position: DVec3) -> DVec3 {
        self.around.mesh.storable(position)
    }

    /// The star that was taken up last.
    pub fn star(&self) -> &LocalStar {
        &self.star
    }

    /// Excess of the worst triangle of the star if the centre goes by `step`, or of any that reaches `bound`.
    pub fn worst(&mut self, step: DVec3, bound: f64) -> f64 {
        let valence = self.star.valence();
        let mut worst = 0.0_f64;
        for i in 0..valence {
            let at = (self.culprit + i) % valence;
            worst = worst.max(self.limits.excess([step, self.star.point(at), self.star.point(at + 1)]));
            if worst >= bound {
                self.culprit = at;
                break;
            }
        }
        worst
    }
}

/// Where a search stands.
struct Search {
    step: DVec3,
    worst: f64,
}
