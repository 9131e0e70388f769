//! One visit: the operation on a star, and as much of its move as the guard admits.

use glam::DVec3;

use super::slide;
use crate::deviation::Surface;
use crate::features::{Features, Role};
use crate::guard::{Guard, Leash};
use crate::mesh::{Mesh, Stars};
use crate::star::{LocalStar, Modelling, Operation, double_vector_area};

/// How often a step is halved before the vertex stays.
const HALVINGS: u32 = 3;

/// Bounds where the shape of the surface is to be kept.
const ON_SURFACE: Leash = Leash { planes: 0.12, place: f64::INFINITY };

/// Bounds for a vertex that slides along a crease.
const ON_CREASE: Leash = Leash { planes: 0.08, place: f64::INFINITY };

/// Bounds for a vertex that may be a corner after all.
const NEAR_CORNER: Leash = Leash { planes: 0.1, place: 0.2 };

/// What became of a vertex at its last visit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Never visited, or its role keeps it where it is.
    Unvisited,
    Moved,
    /// Already at its target.
    Settled,
    Degenerate,
    Guard,
    Deviation,
}

/// Visits whose step was shortened or refused.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Tally {
    pub halved: usize,
    pub refused: usize,
}

/// All that a visit reads and never changes.
pub(crate) struct Surroundings<'a> {
    pub mesh: &'a Mesh<'a>,
    pub stars: &'a Stars,
    pub features: &'a Features,
    pub modelling: &'a Modelling,
    /// Mean-ratio shape below which no star's worst triangle may fall.
    pub floor: f64,
    /// Whether the shape of the surface is to be kept beyond what marked edges say.
    pub keeps_shape: bool,
    pub relaxation: f64,
    /// Greatest distance from the original surface.
    pub max_deviation: Option<f64>,
}

impl Surroundings<'_> {
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

/// Visits stars, with working memory that is reused from one to the next.
pub(crate) struct Visitor<'a> {
    around: &'a Surroundings<'a>,
    operation: Operation<'a>,
    star: LocalStar,
    guard: Guard,
    pub tally: Tally,
}

impl<'a> Visitor<'a> {
    pub fn new(around: &'a Surroundings<'a>) -> Self {
        Self {
            around,
            operation: Operation::new(around.modelling),
            star: LocalStar::default(),
            guard: Guard::new(around.floor),
            tally: Tally::default(),
        }
    }

    /// Visits vertex `v` and notes the outcome.
    pub fn visit(&mut self, positions: &mut [DVec3], outcomes: &mut [Outcome], v: u32) {
        let Some(step) = self.wanted_step(positions, v) else {
            return;
        };
        outcomes[v as usize] = match step {
            Wanted::Nothing => Outcome::Degenerate,
            Wanted::Step(step) => self.try_step(positions, v, step),
        };
    }

    /// Where the star wants its centre to go; `None` for a vertex whose role keeps it.
    fn wanted_step(&mut self, positions: &[DVec3], v: u32) -> Option<Wanted> {
        let Surroundings { stars, features, relaxation, .. } = *self.around;
        let role = features.role(v);
        match role {
            Role::Free | Role::Doubtful | Role::Rim => self.star.take(stars, positions, v),
            Role::Crease => self.star.take_crease(stars, positions, v, features.crease_ends(stars, v)),
            _ => return None,
        }
        let step = self.operation.target(&self.star).and_then(|target| {
            let target = target * relaxation;
            match role {
                Role::Free | Role::Doubtful => volume_neutral(target, double_vector_area(&self.star.rim)),
                _ => slide::along(&self.star, target),
            }
        });
        Some(step.map_or(Wanted::Nothing, Wanted::Step))
    }

    /// Halves the step until guard and deviation bound agree.
    fn try_step(&mut self, positions: &mut [DVec3], v: u32, mut step: DVec3) -> Outcome {
        let Surroundings { mesh, stars, .. } = *self.around;
        self.guard.inspect(mesh, stars, v, &self.star, self.around.leash(v));
        let mut refusal = Outcome::Guard;
        for halving in 0..=HALVINGS {
            let new = mesh.storable(self.star.centre + step);
            if new == self.star.centre {
                return Outcome::Settled;
            }
            refusal = self.refusal(v, new);
            if refusal == Outcome::Moved {
                positions[v as usize] = new;
                self.tally.halved += usize::from(halving > 0);
                return Outcome::Moved;
            }
            step *= 0.5;
        }
        self.tally.refused += 1;
        refusal
    }

    /// `Moved` if the vertex may go to `new`, else what speaks against it.
    fn refusal(&self, v: u32, new: DVec3) -> Outcome {
        let Surroundings { mesh, stars, max_deviation, .. } = *self.around;
        if !self.guard.admits(&self.star, new - self.star.centre) {
            return Outcome::Guard;
        }
        match max_deviation {
            Some(bound) if Surface::new(mesh, stars).distance(v, new) > bound => Outcome::Deviation,
            _ => Outcome::Moved,
        }
    }
}

enum Wanted {
    Nothing,
    Step(DVec3),
}

/// The part of `step` orthogonal to the ring's vector area, which leaves the volume as it is.
pub(crate) fn volume_neutral(step: DVec3, area: DVec3) -> Option<DVec3> {
    let square = area.length_squared();
    (square > 0.0).then(|| step - area * (area.dot(step) / square))
}
