//! One visit: the operation on a star, and as much of its move as the guard admits.

use fearless_simd::{Level, Simd, dispatch, f64x8};
use glam::DVec3;

use super::end::{End, Tally, members};
use super::outcome::Outcomes;
use super::places::Places;
use super::surroundings::Surroundings;
use crate::features::Role;
use crate::guard::{Guard, Known};
use crate::star::{Cones, Draft, LANES, LocalStars, Number, Vectors, companies, vector};

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

    /// Visits vertices no two of which are neighbours, all of which have a role that lets them move, and the first of which
    /// are `companions`; notes the outcomes. The result is that of visiting them one by one in any order.
    #[inline(always)]
    pub fn visit(&mut self, vertices: &[u32], companions: usize, places: &Places, outcomes: &Outcomes) {
        let (companions, others) = vertices.split_at(companions);
        others.iter().for_each(|&v| self.alone.visit(v, places, outcomes));
        for (company, count) in companies(companions) {
            if count < COMPANY {
                company[..count].iter().for_each(|&v| self.alone.visit(v, places, outcomes));
            } else {
                self.visit_together(&company, count, places, outcomes);
            }
        }
    }

    /// Visits the first `count` of these vertices side by side.
    #[inline(always)]
    fn visit_together(&mut self, vertices: &[u32; LANES], count: usize, places: &Places, outcomes: &Outcomes) {
        let Self { around, token, together, alone, tally } = self;
        let Some(cones) = around.cones else {
            together.stars.take(*token, around.stars, around.site(places), vertices);
            *tally += together.visit(*token, around, (vertices, count), places, outcomes);
            return;
        };
        let (step, open) = together.hurry(*token, around, cones, (vertices, count), places, outcomes);
        if open.count_ones() as usize >= COMPANY {
            *tally += together.finish(*token, around, vertices, (step, open), places, outcomes);
        } else {
            let steps = step.rows();
            let finish = |star: usize| alone.finish(vertices[star], vector(&steps, star), places, outcomes);
            members::<f64x8<S>>(open).for_each(finish);
        }
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

    /// The end of a visit in a tangent plane whose step is known.
    #[inline(never)]
    fn finish(&mut self, v: u32, step: DVec3, places: &Places, outcomes: &Outcomes) {
        let Self { around, level, visit, tally } = self;
        dispatch!(*level, _simd => {
            *tally += visit.finish((), around, &[v], (step.into(), 1), places, outcomes);
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
        let scene = &around.scene(token, &self.stars, vertices);
        let (step, exist) = around.wish(token, scene, &mut self.draft);
        let mut end = End { around, scene, places, outcomes, tally: Tally::default() };
        let open = end.begin(count, exist);
        self.guard.look(token, scene, |v| around.leash(v));
        end.carry_out(token, &mut self.guard, step, open);
        end.tally
    }

    /// Visits the first `count` of these vertices as far as that goes without a look at their original triangles. Returns the
    /// steps, and which stars need that look.
    #[inline(always)]
    fn hurry(
        &mut self,
        token: N::Token,
        around: &Surroundings<'_>,
        cones: &Cones,
        (vertices, count): (&N::Vertices, usize),
        places: &Places,
        outcomes: &Outcomes,
    ) -> (Vectors<N>, u64) {
        let known = Known::of(cones, |v| around.leash(v), vertices.as_ref());
        places.gather(around.stars, &mut self.stars, vertices);
        self.stars.relate(token, |v| around.mesh.position(v), vertices);
        let scene = &around.scene(token, &self.stars, vertices);
        let (step, exist) = around.wish(token, scene, &mut self.draft);
        let end = End { around, scene, places, outcomes, tally: Tally::default() };
        let open = end.begin(count, exist);
        (step, end.carry_out_plainly(token, (cones, &known), step, open))
    }

    /// The end of the visits of the stars `open`, whose steps are known.
    #[inline(always)]
    fn finish(
        &mut self,
        token: N::Token,
        around: &Surroundings<'_>,
        vertices: &N::Vertices,
        (step, open): (Vectors<N>, u64),
        places: &Places,
        outcomes: &Outcomes,
    ) -> Tally {
        self.stars.take(token, around.stars, around.site(places), vertices);
        let scene = &around.scene(token, &self.stars, vertices);
        let mut end = End { around, scene, places, outcomes, tally: Tally::default() };
        self.guard.look(token, scene, |v| around.leash(v));
        end.carry_out(token, &mut self.guard, step, open);
        end.tally
    }
}
