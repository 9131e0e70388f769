//! One visit: the operation on a star, and as much of its move as the guard admits.

use std::iter::Sum;

use fearless_simd::{Level, Simd, dispatch, f64x8};
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
use crate::star::{Draft, LocalStar, LocalStars, Number, Operation, Site, Vectors, set_vector, vector};

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

/// Stars that are visited together at most: no two of them are neighbours.
pub(super) const TOGETHER: usize = 16;

/// Stars side by side.
const LANES: usize = 8;

/// Largest star that is visited beside others.
const COMPANIONABLE: usize = 16;

/// Stars with at most so many triangles keep company with each other.
const ORDINARY: usize = 6;

/// Fewest stars that are visited faster side by side than one after the other.
const COMPANY: usize = 3;

/// Visits stars, eight side by side where they let it, with working memory that is reused from one to the next.
pub(crate) struct Visitor<'a, S: Simd> {
    around: &'a Surroundings<'a>,
    token: S,
    together: Visit<f64x8<S>>,
    alone: LoneVisitor<'a>,
    tally: Tally,
}

/// Visits stars one by one.
pub(crate) struct LoneVisitor<'a> {
    around: &'a Surroundings<'a>,
    level: Level,
    visit: Visit<f64>,
    pub tally: Tally,
}

impl<'a, S: Simd> Visitor<'a, S> {
    pub fn new(token: S, around: &'a Surroundings<'a>) -> Self {
        let (together, alone) = (Visit::new(around.floor), LoneVisitor::new(around));
        Self { around, token, together, alone, tally: Tally::default() }
    }

    /// What has come of all visits.
    pub fn tally(&self) -> Tally {
        [self.tally, self.alone.tally].into_iter().sum()
    }

    /// Visits `vertices`, at most [`TOGETHER`], no two of which are neighbours and all of which have a role that lets them
    /// move, and notes the outcomes. The result is that of visiting them one by one in any order.
    #[inline(always)]
    pub fn visit(&mut self, vertices: &[u32], places: &Places, outcomes: &Outcomes) {
        let mut companions = [0; TOGETHER];
        let count = self.companions(vertices, &mut companions, places, outcomes);
        for company in companions[..count].chunks(LANES) {
            if company.len() < COMPANY {
                company.iter().for_each(|&v| self.alone.visit(v, places, outcomes));
            } else {
                let mut vertices = [company[0]; LANES];
                vertices[..company.len()].copy_from_slice(company);
                self.together.stars.take(self.token, self.around.stars, self.around.site(places), &vertices);
                let visit = (&vertices, company.len());
                self.tally += self.together.visit(self.token, self.around, visit, places, outcomes);
            }
        }
    }

    /// Sorts out those of `vertices` that are visited side by side, those with few triangles first, since a lane waits for
    /// the largest star of its company. Visits the others. Returns how many there are.
    #[inline(always)]
    fn companions(
        &mut self,
        vertices: &[u32],
        companions: &mut [u32; TOGETHER],
        places: &Places,
        outcomes: &Outcomes,
    ) -> usize {
        let (mut large, mut larges, mut count) = ([0; TOGETHER], 0, 0);
        for &v in vertices {
            let valence = self.around.stars.rim(v).len() - 1;
            if valence > COMPANIONABLE || !self.around.features.role(v).moves_in_plane() {
                self.alone.visit(v, places, outcomes);
                continue;
            }
            // Written to both and counted for one: which one it is cannot be foreseen.
            (companions[count], large[larges]) = (v, v);
            count += usize::from(valence <= ORDINARY);
            larges += usize::from(valence > ORDINARY);
        }
        companions[count..][..larges].copy_from_slice(&large[..larges]);
        count + larges
    }
}

impl<'a> LoneVisitor<'a> {
    pub fn new(around: &'a Surroundings<'a>) -> Self {
        Self { around, level: Level::new(), visit: Visit::new(around.floor), tally: Tally::default() }
    }

    /// Visits a vertex whose role lets it move, and notes the outcome. The machine code stands here once, for whoever calls
    /// it.
    #[inline(never)]
    pub fn visit(&mut self, v: u32, places: &Places, outcomes: &Outcomes) {
        let Self { around, level, visit, tally } = self;
        let Surroundings { stars, features, .. } = around;
        dispatch!(*level, _simd => {
            let site = around.site(places);
            match features.role(v) {
                Role::Crease => visit.stars.take_crease(stars, site, v, features.crease_ends(stars, v)),
                _ => visit.stars.take((), stars, site, &[v]),
            }
            *tally += visit.visit((), around, (&[v], 1), places, outcomes);
        });
    }
}

/// Working memory of a visit of one star or of several side by side.
struct Visit<N: Number> {
    stars: LocalStars<N>,
    draft: Draft<N>,
    guard: Guard<N>,
}

impl<N: Number> Visit<N> {
    fn new(floor: f64) -> Self {
        Self { stars: LocalStars::default(), draft: Draft::default(), guard: Guard::new(floor) }
    }

    /// Visits the first `count` of the stars that were taken up.
    #[inline(always)]
    fn visit(
        &mut self,
        token: N::Token,
        around: &Surroundings<'_>,
        (vertices, count): (&N::Vertices, usize),
        places: &Places,
        outcomes: &Outcomes,
    ) -> Tally {
        let Self { stars, draft, guard } = self;
        let Surroundings { mesh, stars: rings, .. } = *around;
        let scene = &Scene { mesh, rings, stars, vertices: *vertices, areas: stars.areas(token) };
        let (step, exist) = around.wish(token, scene, draft);
        guard.look(token, scene, |v| around.leash(v));
        let mut end = End { around, scene, places, outcomes, tally: Tally::default() };
        let all = (1 << count) - 1;
        end.note(all & !exist, Outcome::Degenerate);
        end.carry_out(token, guard, step, all & exist);
        end.tally
    }
}

impl Surroundings<'_> {
    /// Where a vertex is.
    #[inline(always)]
    fn site(&self, places: &Places) -> impl Fn(u32) -> Site {
        |vertex| Site { vertex, place: places.get(vertex), origin: self.mesh.positions[vertex as usize] }
    }

    /// The steps that the stars want, and which of them want any.
    #[inline(always)]
    fn wish<N: Number>(&self, token: N::Token, scene: &Scene<'_, N>, draft: &mut Draft<N>) -> (Vectors<N>, u64) {
        let (target, exist) = self.operation.targets(token, scene.stars, &scene.areas, draft);
        let step = target.times(N::splat(token, self.relaxation));
        if !self.features.role(scene.vertices.as_ref()[0]).moves_in_plane() {
            let (step, slide) = slides(token, scene.stars, step);
            return (step, N::bits(exist) & slide);
        }
        if !self.operation.keeps_volume() {
            return (step, N::bits(exist));
        }
        let (step, neutral) = volume_neutral_steps(token, step, scene.areas[0]);
        (step, N::bits(exist & neutral))
    }
}

/// Steps along features, star by star, and which stars have them.
#[inline(always)]
fn slides<N: Number>(token: N::Token, stars: &LocalStars<N>, step: Vectors<N>) -> (Vectors<N>, u64) {
    let (mut steps, mut exist) = (step.rows(), 0);
    let mut alone = LocalStar::default();
    for star in 0..N::STARS {
        stars.copy_into(star, &mut alone);
        if let Some(along) = slide::along(&alone, vector(&steps, star)) {
            set_vector(&mut steps, star, along);
            exist |= 1 << star;
        }
    }
    (Vectors::load(token, &steps), exist)
}

/// The end of a visit: as much of the steps as may be. Sets of stars are bits of a number.
struct End<'a, N: Number> {
    around: &'a Surroundings<'a>,
    scene: &'a Scene<'a, N>,
    places: &'a Places,
    outcomes: &'a Outcomes,
    tally: Tally,
}

impl<N: Number> End<'_, N> {
    /// Carries out as much of each step of the stars `open` as guard and deviation bound admit: all, half of it, a quarter,
    /// an eighth.
    #[inline(always)]
    fn carry_out(&mut self, token: N::Token, guard: &mut Guard<N>, mut step: Vectors<N>, mut open: u64) {
        let centres = self.scene.stars.centres(token);
        let mut too_far = 0;
        for halving in 0..=HALVINGS {
            let places = self.storable(centres.plus(step));
            let exact = Vectors::<N>::load(token, &places).minus(centres);
            let settled = open & N::bits(exact.is_zero(token));
            self.note(settled, Outcome::Settled);
            open &= !settled;
            let admitted = if open == 0 { 0 } else { open & guard.admits(token, self.scene, exact, open) };
            too_far = self.too_far(admitted, &places);
            let moved = admitted & !too_far;
            self.go(moved, &places);
            self.tally.halved += if halving > 0 { moved.count_ones() as usize } else { 0 };
            open &= !moved;
            if open == 0 {
                return;
            }
            step = step.times(N::splat(token, 0.5));
        }
        self.tally.refused += open.count_ones() as usize;
        self.note(open & too_far, Outcome::Deviation);
        self.note(open & !too_far, Outcome::Guard);
    }

    /// The nearest positions that the caller's buffers can hold.
    #[inline(always)]
    fn storable(&self, places: Vectors<N>) -> [N::Row; 3] {
        let mut rows = places.rows();
        if !self.around.mesh.holds_everything() {
            for star in 0..N::STARS {
                let place = self.around.mesh.storable(vector(&rows, star));
                set_vector(&mut rows, star, place);
            }
        }
        rows
    }

    /// Which of the stars `admitted` would leave the original surface too far behind.
    #[inline(always)]
    fn too_far(&self, admitted: u64, places: &[N::Row; 3]) -> u64 {
        let Some(bound) = self.around.max_deviation else {
            return 0;
        };
        let surface = Surface::new(self.scene.mesh, self.scene.rings);
        let distance = |star: usize| surface.distance(self.scene.vertices.as_ref()[star], vector(places, star));
        members::<N>(admitted).filter(|&star| distance(star) > bound).fold(0, |found, star| found | 1 << star)
    }

    #[inline(always)]
    fn go(&self, moved: u64, places: &[N::Row; 3]) {
        for star in members::<N>(moved) {
            self.places.set(self.scene.vertices.as_ref()[star], vector(places, star));
        }
        self.note(moved, Outcome::Moved);
    }

    #[inline(always)]
    fn note(&self, stars: u64, outcome: Outcome) {
        for star in members::<N>(stars) {
            self.outcomes.set(self.scene.vertices.as_ref()[star], outcome);
        }
    }
}

/// The stars of a set.
#[inline(always)]
fn members<N: Number>(set: u64) -> impl Iterator<Item = usize> {
    (0..N::STARS).filter(move |star| set >> star & 1 == 1)
}

/// The part of `step` orthogonal to the rings' vector areas, which leaves the volume as it is, and which stars have one.
#[inline(always)]
fn volume_neutral_steps<N: Number>(token: N::Token, step: Vectors<N>, area: Vectors<N>) -> (Vectors<N>, N::Truth) {
    let square = area.square();
    (step.minus(area.times(area.dot(step) / square)), N::splat(token, 0.0).below(square))
}

/// The same for one star.
pub(crate) fn volume_neutral(step: DVec3, area: DVec3) -> Option<DVec3> {
    let (step, exists) = volume_neutral_steps((), Vectors::from(step), area.into());
    exists.then(|| step.into())
}
