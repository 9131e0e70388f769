//! One visit: the operation on a star, and as much of its move as the guard admits.

use std::iter::Sum;

use fearless_simd::prelude::*;
use glam::DVec3;

use super::outcome::{Outcome, Outcomes};
use super::places::Places;
use super::slide;
use crate::deviation::Surface;
use crate::error::Error;
use crate::features::{Features, Role};
use crate::guard::{Guard, Leash, Scene};
use crate::memory;
use crate::mesh::{Mesh, Stars};
use crate::star::{Draft, LocalStar, Operation};

/// How often a step is halved before the vertex stays.
const HALVINGS: u32 = 3;

/// Bounds where the shape of the surface is to be kept.
const ON_SURFACE: Leash = Leash { planes: 0.12, place: f64::INFINITY };

/// Bounds for a vertex that slides along a crease.
const ON_CREASE: Leash = Leash { planes: 0.08, place: f64::INFINITY };

/// Bounds for a vertex that may be a corner after all.
const NEAR_CORNER: Leash = Leash { planes: 0.1, place: 0.2 };

/// Visits whose step was shortened or refused.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Tally {
    pub halved: usize,
    pub refused: usize,
}

impl Sum for Tally {
    fn sum<I: Iterator<Item = Self>>(tallies: I) -> Self {
        tallies.fold(Self::default(), |mut sum, tally| {
            sum += tally;
            sum
        })
    }
}

impl std::ops::AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.halved += other.halved;
        self.refused += other.refused;
    }
}

/// All that a visit reads and never changes.
pub(crate) struct Surroundings<'a> {
    pub mesh: &'a Mesh<'a>,
    pub stars: &'a Stars,
    pub features: &'a Features,
    pub operation: &'a Operation,
    /// Mean-ratio shape below which no star's worst triangle may fall.
    pub floor: f64,
    /// Whether the shape of the surface is to be kept beyond what marked edges say.
    pub keeps_shape: bool,
    pub relaxation: f64,
    /// Greatest distance from the original surface.
    pub max_deviation: Option<f64>,
}

impl Surroundings<'_> {
    /// The vertices whose role lets them move, by index.
    pub fn movable(&self) -> Result<Vec<u32>, Error> {
        let moves = |&v: &u32| self.features.role(v).moves();
        let all = 0..self.stars.len() as u32;
        let mut movable = memory::reserved(all.clone().filter(moves).count())?;
        movable.extend(all.filter(moves));
        Ok(movable)
    }

    /// How far a sweep may take a vertex from where it was in the original mesh.
    fn leash(&self, v: u32) -> Leash {
        if self.keeps_shape { self.close_leash(v) } else { Leash::NONE }
    }

    /// The same where the shape of the surface is to be kept in any case.
    pub fn close_leash(&self, v: u32) -> Leash {
        match self.features.role(v) {
            Role::Crease => ON_CREASE,
            Role::Doubtful => NEAR_CORNER,
            _ => ON_SURFACE,
        }
    }
}

/// Stars that are visited together: enough to hide how long each one waits, few enough for the nearest cache.
pub(super) const TOGETHER: usize = 16;

/// Visits stars, with working memory that is reused from one to the next.
pub(crate) struct Visitor<'a> {
    around: &'a Surroundings<'a>,
    visits: Vec<Visit>,
    pub tally: Tally,
}

/// A visit under way.
struct Visit {
    vertex: u32,
    star: LocalStar,
    draft: Draft,
    guard: Guard,
    has_plane: bool,
    /// What the star wants; `None` if it has no plane, or no direction to go.
    step: Option<DVec3>,
}

impl<'a> Visitor<'a> {
    pub fn new(around: &'a Surroundings<'a>) -> Self {
        let visits = (0..TOGETHER).map(|_| Visit::new(around.floor)).collect();
        Self { around, visits, tally: Tally::default() }
    }

    /// Visits `vertices`, no two of which are neighbours and all of which have a role that lets them move, and notes the
    /// outcomes.
    #[inline(always)]
    pub fn visit<S: Simd>(&mut self, simd: S, vertices: &[u32], places: &Places, outcomes: &Outcomes) {
        let Self { around, visits, tally } = self;
        for together in vertices.chunks(TOGETHER) {
            let visits = &mut visits[..together.len()];
            for (visit, &v) in visits.iter_mut().zip(together) {
                visit.take(simd, around, places, v);
            }
            for visit in visits.iter_mut() {
                visit.has_plane = around.operation.find_planes(simd, &visit.star, &mut visit.draft);
            }
            for visit in visits.iter_mut().filter(|visit| visit.has_plane) {
                around.operation.sample(simd, &visit.star, &mut visit.draft);
            }
            for visit in visits.iter_mut().filter(|visit| visit.has_plane) {
                around.operation.model(simd, &visit.star, &mut visit.draft);
            }
            for visit in visits.iter_mut() {
                visit.step = if visit.has_plane { visit.wish(simd, around) } else { None };
            }
            for visit in visits.iter_mut() {
                visit.inspect(simd, around);
            }
            for visit in visits {
                outcomes.set(visit.vertex, visit.end(simd, around, tally, places));
            }
        }
    }
}

impl Visit {
    fn new(floor: f64) -> Self {
        let (star, draft) = (LocalStar::default(), Draft::default());
        Self { vertex: 0, star, draft, guard: Guard::new(floor), has_plane: false, step: None }
    }

    /// Takes up the star of `v`.
    #[inline(always)]
    fn take<S: Simd>(&mut self, simd: S, around: &Surroundings<'_>, places: &Places, v: u32) {
        let Surroundings { stars, features, .. } = *around;
        let at = |r: u32| places.get(r);
        self.vertex = v;
        match features.role(v) {
            Role::Crease => self.star.take_crease(simd, stars, at, v, features.crease_ends(stars, v)),
            _ => self.star.take(simd, stars, at, v),
        }
    }

    /// The step that the star wants.
    #[inline(always)]
    fn wish<S: Simd>(&self, simd: S, around: &Surroundings<'_>) -> Option<DVec3> {
        let step = around.operation.wish(simd, self.vertex, &self.star, &self.draft) * around.relaxation;
        match around.features.role(self.vertex) {
            Role::Free | Role::Doubtful if !around.operation.keeps_volume() => Some(step),
            Role::Free | Role::Doubtful => volume_neutral(step, self.draft.areas[0]),
            _ => slide::along(&self.star, step),
        }
    }

    /// Looks at the star as it was in the original mesh.
    #[inline(always)]
    fn inspect<S: Simd>(&mut self, simd: S, around: &Surroundings<'_>) {
        let Self { vertex, star, draft, guard, .. } = self;
        let Surroundings { mesh, stars, .. } = *around;
        let scene = &Scene { mesh, stars, star, vertex: *vertex, areas: draft.areas };
        guard.inspect(simd, scene, around.leash(*vertex));
    }

    /// Carries out as much of the step as guard and deviation bound admit: all, half of it, a quarter, an eighth.
    #[inline(always)]
    fn end<S: Simd>(&mut self, simd: S, around: &Surroundings<'_>, tally: &mut Tally, places: &Places) -> Outcome {
        let Some(mut step) = self.step else {
            return Outcome::Degenerate;
        };
        let Self { vertex, ref star, ref draft, ref mut guard, .. } = *self;
        let Surroundings { mesh, stars, max_deviation, .. } = *around;
        let scene = &Scene { mesh, stars, star, vertex, areas: draft.areas };
        let mut refusal = Outcome::Guard;
        for halving in 0..=HALVINGS {
            let new = mesh.storable(star.centre + step);
            if new == star.centre {
                return Outcome::Settled;
            }
            if !guard.admits(simd, scene, new - star.centre) {
                refusal = Outcome::Guard;
            } else if max_deviation.is_some_and(|bound| Surface::new(mesh, stars).distance(vertex, new) > bound) {
                refusal = Outcome::Deviation;
            } else {
                places.set(vertex, new);
                tally.halved += usize::from(halving > 0);
                return Outcome::Moved;
            }
            step *= 0.5;
        }
        tally.refused += 1;
        refusal
    }
}

/// The part of `step` orthogonal to the ring's vector area, which leaves the volume as it is.
#[inline(always)]
pub(crate) fn volume_neutral(step: DVec3, area: DVec3) -> Option<DVec3> {
    let square = area.length_squared();
    (square > 0.0).then(|| step - area * (area.dot(step) / square))
}
