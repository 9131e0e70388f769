//! The modelled values of the triangles of several stars, formula (4), and the potential forms that have them.

use super::form::{ProportionRows, Proportions};
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

/// Forms that all samples in an interval share: the same bits, with fewer roots and divisions. Reused from stars to stars.
pub(super) struct ByInterval<N: Number> {
    forms: [ProportionRows<N>; FEW],
    /// Up to the last interval that holds a sample.
    count: usize,
}

impl<N: Number> Default for ByInterval<N> {
    fn default() -> Self {
        Self { forms: [ProportionRows::default(); FEW], count: 0 }
    }
}

impl<N: Number> ByInterval<N> {
    /// Finds the forms for samples that `model` [`suits`](Model::suits).
    #[inline(always)]
    pub fn find(&mut self, token: N::Token, model: &Model, samples: &[Sample<N>], valences: N, deviation: N) {
        self.count = 0;
        for form in &mut self.forms {
            self.count += 1;
            let (rank, is_last) = model.rank_interval(token, samples, valences, self.count);
            proportions(token, &rank, deviation).store(form);
            if is_last {
                break;
            }
        }
    }
}

impl<N: Number> Forms<N> for ByInterval<N> {
    #[inline(always)]
    fn of(&self, token: N::Token, sample: &Sample<N>) -> Proportions<N> {
        let (interval, mut form) = (N::load(token, &sample.interval), Proportions::load(token, &self.forms[0]));
        let (one, mut number) = (N::splat(token, 1.0), N::splat(token, 1.0));
        for other in &self.forms[1..self.count] {
            form = Proportions::choose(number.below(interval), Proportions::load(token, other), form);
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
