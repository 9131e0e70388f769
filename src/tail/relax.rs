//! Vertex moves that help the worst triangle of a star: volume-neutral, guarded, and no larger than needed.

use glam::{DVec2, DVec3};

use super::limits::Limits;
use super::patch::{Patch, Shape};
use crate::deviation::Surface;
use crate::guard::Guard;
use crate::star::{LocalStar, Operation, TangentPlane, double_vector_area};
use crate::sweep::{Surroundings, volume_neutral};

/// Excess at which a star is good enough: just below the thresholds, so that rounding cannot bring it back.
const GOAL: f64 = 0.99;

/// First step of the search in units of the star's mean radius.
const REACH: f64 = 0.25;

/// Halvings of the step before the search ends.
const HALVINGS: u32 = 5;

/// Steps of a search at most.
const STEPS: u32 = 12;

/// The eight directions of the search.
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
    operation: Operation<'a>,
    star: LocalStar,
    guard: Guard,
}

impl<'a> Relaxer<'a> {
    pub fn new(around: &'a Surroundings<'a>, limits: &'a Limits) -> Self {
        Self {
            around,
            limits,
            operation: Operation::new(around.modelling),
            star: LocalStar::default(),
            guard: Guard::new(around.floor),
        }
    }

    /// Visits the free ones of `vertices` whose stars are not good enough, round after round, until nothing moves.
    pub fn relax_all(&mut self, patch: &Patch, shape: &mut Shape, vertices: &[usize], rounds: usize) {
        for _ in 0..rounds {
            let mut moved = false;
            for &v in vertices.iter().filter(|&&v| patch.fixed[v].is_none()) {
                moved |= self.relax(patch, shape, v);
            }
            if !moved {
                return;
            }
        }
    }

    /// Moves `v` so that the worst triangle of its star gets better. Says whether it has moved.
    fn relax(&mut self, patch: &Patch, shape: &mut Shape, v: usize) -> bool {
        if !self.take(patch, shape, v) || self.worst(DVec3::ZERO) <= GOAL {
            return false;
        }
        let area = double_vector_area(&self.star.rim);
        let Some(plane) = TangentPlane::orthogonal_to(area) else {
            return false;
        };
        self.inspect(patch, v);
        let mut search = Search { step: DVec3::ZERO, worst: self.worst(DVec3::ZERO) };
        let target = self.operation.target(&self.star).and_then(|t| volume_neutral(t, area));
        if let Some(target) = target {
            self.try_step(&mut search, patch.vertices[v], target);
        }
        self.descend(&mut search, &plane, patch.vertices[v]);
        shape.positions[v] = self.around.mesh.storable(self.star.centre + search.step);
        shape.positions[v] != self.star.centre
    }

    /// Pattern search: the best of eight steps, halved where none helps.
    fn descend(&mut self, search: &mut Search, plane: &TangentPlane, vertex: u32) {
        let lengths: f64 = self.star.rim.iter().skip(1).map(|p| p.length()).sum();
        let mut reach = REACH * lengths / self.star.valence() as f64;
        let mut halvings = 0;
        for _ in 0..STEPS {
            if search.worst <= GOAL || halvings > HALVINGS {
                return;
            }
            let from = search.step;
            let steps = DIRECTIONS.map(|d| from + plane.lift(d * reach));
            let ranked = steps.map(|step| (self.worst(step), step));
            let best = ranked.iter().min_by(|a, b| a.0.total_cmp(&b.0)).map_or(from, |r| r.1);
            if !self.try_step(search, vertex, best) {
                reach *= 0.5;
                halvings += 1;
            }
        }
    }

    /// Takes a step if it helps and may be taken.
    fn try_step(&self, search: &mut Search, vertex: u32, step: DVec3) -> bool {
        let new = self.around.mesh.storable(self.star.centre + step);
        let step = new - self.star.centre;
        let worst = self.worst(step);
        let helps = worst < search.worst && self.admits(vertex, step);
        if helps {
            *search = Search { step, worst };
        }
        helps
    }

    /// Takes up the star of `v`; false if it is no closed disc.
    pub fn take(&mut self, patch: &Patch, shape: &Shape, v: usize) -> bool {
        let ring = shape.ring(v);
        let numbered = |r: &usize| (patch.vertices[*r], shape.positions[*r]);
        if let Some(ring) = &ring {
            self.star.take_ring(shape.positions[v], ring.iter().map(numbered));
        }
        ring.is_some()
    }

    /// Prepares the guard for steps of the star that was taken up.
    pub fn inspect(&mut self, patch: &Patch, v: usize) {
        let vertex = patch.vertices[v];
        let leash = self.around.leash(vertex);
        self.guard.inspect(self.around.mesh, self.around.stars, vertex, &self.star, leash);
    }

    /// Whether guard and deviation bound let the centre of the inspected star go by `step`.
    pub fn admits(&self, vertex: u32, step: DVec3) -> bool {
        let surface = Surface::new(self.around.mesh, self.around.stars);
        let bound = self.around.max_deviation;
        self.guard.admits(&self.star, step)
            && bound.is_none_or(|bound| surface.distance(vertex, self.star.centre + step) <= bound)
    }

    /// The nearest position that the caller's buffers can hold.
    pub fn storable(&self, position: DVec3) -> DVec3 {
        self.around.mesh.storable(position)
    }

    /// The star that was taken up last.
    pub fn star(&self) -> &LocalStar {
        &self.star
    }

    /// Excess of the worst triangle of the star if the centre goes by `step`.
    pub fn worst(&self, step: DVec3) -> f64 {
        let excess = |e: &[DVec3]| self.limits.excess([step, e[0], e[1]]);
        self.star.rim.windows(2).map(excess).fold(0.0, f64::max)
    }
}

/// Where a search stands.
struct Search {
    step: DVec3,
    worst: f64,
}
