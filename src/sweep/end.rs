//! The end of a visit: as much of the steps as guard and deviation bound admit.

use std::iter::Sum;

use super::outcome::{Outcome, Outcomes};
use super::places::Places;
use super::surroundings::Surroundings;
use crate::deviation::Surface;
use crate::guard::{Guard, Known, Scene, glance};
use crate::star::{Cones, Number, Vectors, set_vector, vector};

/// How often a step is halved before the vertex stays.
const HALVINGS: u32 = 3;

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

/// What has to be known for it. Sets of stars are bits of a number.
pub(super) struct End<'a, N: Number> {
    pub around: &'a Surroundings<'a>,
    pub scene: &'a Scene<'a, N>,
    pub places: &'a Places,
    pub outcomes: &'a Outcomes,
    pub tally: Tally,
}

impl<N: Number> End<'_, N> {
    /// Notes which of the first `count` stars have no plane. Returns the others.
    #[inline(always)]
    pub fn begin(&self, count: usize, exist: u64) -> u64 {
        let all = (1 << count) - 1;
        self.note(all & !exist, Outcome::Degenerate);
        all & exist
    }

    /// Carries out those steps of the stars `open` that may plainly be. Returns the stars that are left.
    #[inline(always)]
    pub fn carry_out_plainly(
        &self,
        token: N::Token,
        known: (&Cones, &Known<N::Single>),
        step: Vectors<N>,
        open: u64,
    ) -> u64 {
        let centres = self.scene.stars.centres(token);
        let places = self.storable(centres.plus(step));
        let exact = Vectors::<N>::load(token, &places).minus(centres);
        let settled = open & N::bits(exact.is_zero(token));
        self.note(settled, Outcome::Settled);
        let open = open & !settled;
        let admitted = open & glance(token, self.scene, known, self.around.floor, (exact, open));
        let moved = admitted & !self.too_far(admitted, &places);
        self.go(moved, &places);
        open & !moved
    }

    /// Carries out as much of each step of the stars `open` as guard and deviation bound admit: all, half of it, a quarter,
    /// an eighth.
    #[inline(always)]
    pub fn carry_out(&mut self, token: N::Token, guard: &mut Guard<N>, mut step: Vectors<N>, mut open: u64) {
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
            let v = self.scene.vertices.as_ref()[star];
            self.places.set(v, vector(places, star));
            self.outcomes.set(v, Outcome::Moved);
        }
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
pub(super) fn members<N: Number>(set: u64) -> impl Iterator<Item = usize> {
    (0..N::STARS).filter(move |star| set >> star & 1 == 1)
}
