//! The modelled values of the triangles of several stars, formula (4), and the potential forms that have them.

use super::form::Proportions;
use super::model::{FEW, Model};
use super::number::Number;
use super::sample::Sample;

/// What form each triangle is to have.
pub(super) trait Forms<N: Number> {
    /// The forms for a triangle of each star.
    fn of(&self, token: N::Token, sample: &Sample<N>) -> Proportions<N>;
}

/// Forms of samples whose ranks stand with them.
pub(super) struct Apart<N> {
    /// √D of formula (1).
    pub deviation: N,
}

impl<N: Number> Forms<N> for Apart<N> {
    #[inline(always)]
    fn of(&self, token: N::Token, sample: &Sample<N>) -> Proportions<N> {
        proportions(token, &sample.rank, self.deviation)
    }
}

/// Forms that all samples in an interval share: the same bits, with fewer roots and divisions.
pub(super) struct ByInterval<N: Number> {
    forms: [Proportions<N>; FEW],
    /// Up to the last interval that holds a sample.
    count: usize,
}

impl<N: Number> ByInterval<N> {
    /// For samples that a model that [`suits`](Model::suits) them has ranked.
    #[inline(always)]
    pub fn new(token: N::Token, model: &Model, samples: &[Sample<N>], valences: N, deviation: N) -> Self {
        let mut ranks = [N::Row::default(); FEW];
        let count = model.rank_intervals(token, samples, valences, &mut ranks);
        let mut forms = Self { forms: [proportions(token, &ranks[0], deviation); FEW], count };
        for (form, rank) in forms.forms[1..count].iter_mut().zip(&ranks[1..count]) {
            *form = proportions(token, rank, deviation);
        }
        forms
    }
}

impl<N: Number> Forms<N> for ByInterval<N> {
    #[inline(always)]
    fn of(&self, token: N::Token, sample: &Sample<N>) -> Proportions<N> {
        let (interval, mut form) = (N::load(token, &sample.interval), self.forms[0]);
        let (one, mut number) = (N::splat(token, 1.0), N::splat(token, 1.0));
        for other in &self.forms[1..self.count] {
            form = Proportions::choose(number.below(interval), *other, form);
            number = number + one;
        }
        form
    }
}

/// The forms for values of which the ranks tell by how many √D they exceed 1.
#[inline(always)]
fn proportions<N: Number>(token: N::Token, rank: &N::Row, deviation: N) -> Proportions<N> {
    Proportions::of(token, N::load(token, rank) * deviation + N::splat(token, 1.0))
}
