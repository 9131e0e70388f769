//! Modelling of better values from the star's own statistics: formulas (1) to (4) of the paper.

use super::local::Countdown;
use super::number::Number;
use super::sample::Sample;
use crate::options::Options;

/// Largest star whose logarithms are tabulated, and whose ranks are counted one by one.
const TABLE: usize = ROW - 1;

/// Intervals for which it is faster to rank intervals than samples, at most.
pub(super) const FEW: usize = 8;

/// Entries of a row of the table, and rows: a power of two, so that a number cut down to its last bits is in range.
const ROW: usize = 32;

/// What a whole number is counted from, so that its last bits are the number itself.
const WHOLE: f64 = (1_u64 << (f64::MANTISSA_DIGITS - 1)) as f64;

/// Formulas (1) to (4) with their settings.
pub(crate) struct Model {
    /// 1 / w.
    per_interval: f64,
    sample_limit: f64,
    /// Number of the interval that holds the largest sample.
    intervals: f64,
    /// Entry n · [`ROW`] + c is √(−2 ln(1 − c / (n + 1))): F takes no other values. Only the first n + 1 of a row have a meaning.
    roots: Box<[f64; ROW * ROW]>,
}

impl Model {
    pub fn new(options: &Options) -> Self {
        let root = |[n, c]: [usize; 2]| if c <= n { root_term(c, n) } else { 0.0 };
        let mut model = Self {
            per_interval: 1.0 / options.interval_width,
            sample_limit: options.sample_limit,
            intervals: 0.0,
            roots: Box::new(std::array::from_fn(|entry| root([entry / ROW, entry % ROW]))),
        };
        model.intervals = model.interval((), model.sample_limit, true);
        model
    }

    /// Whether intervals can be ranked instead of the samples in them, for stars with as many samples at most.
    #[inline(always)]
    pub fn suits(&self, samples: usize) -> bool {
        samples <= TABLE && self.intervals <= FEW as f64
    }

    /// A sample that is too large counts as the limit.
    #[inline(always)]
    pub fn bounded<N: Number>(&self, token: N::Token, sample: N) -> N {
        let limit = N::splat(token, self.sample_limit);
        N::choose(sample.below(limit), sample, limit)
    }

    /// Number of the interval (1 + (j − 1)·w, 1 + j·w] that holds a sample; 1 itself lies in the first. No comparison holds
    /// for a star where the triangle is not `present`.
    #[inline(always)]
    pub fn interval<N: Number>(&self, token: N::Token, value: N, present: N::Truth) -> N {
        let one = N::splat(token, 1.0);
        let number = ((value - one) * N::splat(token, self.per_interval)).ceil();
        N::choose(present, N::choose(number.below(one), one, number), N::splat(token, f64::NAN))
    }

    /// √D of formula (1), for stars with `valences` triangles whose samples have the sum `total`.
    #[inline(always)]
    pub fn deviation<N: Number>(&self, token: N::Token, samples: &[Sample<N>], total: N, valences: N) -> N {
        let (mean, mut squares) = (total / valences, N::splat(token, 0.0));
        let mut countdown = Countdown::new(token, valences);
        for sample in samples {
            let off = N::load(token, &sample.value) - mean;
            squares = squares + (off * off).only(token, countdown.next());
        }
        (squares / valences).root()
    }

    /// Ranks the samples: √(−2 ln(1 − F)), F by formula (3).
    #[inline(always)]
    pub fn rank<N: Number>(&self, token: N::Token, samples: &mut [Sample<N>], valences: N) {
        if samples.len() > TABLE {
            return rank_by_sorting(samples, &valences.row());
        }
        let (one, none) = (N::splat(token, 1.0), none(token, valences));
        for own in 0..samples.len() {
            let (interval, mut count) = (N::load(token, &samples[own].interval), none);
            for other in samples.iter() {
                count = count + one.only(token, N::load(token, &other.interval).at_most(interval));
            }
            count.store(&mut samples[own].rank);
        }
        for sample in samples {
            self.look_up(&mut sample.rank);
        }
    }

    /// Ranks interval number `number`. Returns also whether none of the samples is in a later one.
    #[inline(always)]
    pub fn rank_interval<N: Number>(
        &self,
        token: N::Token,
        samples: &[Sample<N>],
        valences: N,
        number: usize,
    ) -> (N::Row, bool) {
        let (one, none, number) = (N::splat(token, 1.0), none(token, valences), N::splat(token, number as f64));
        let mut count = none;
        for sample in samples {
            count = count + one.only(token, N::load(token, &sample.interval).at_most(number));
        }
        let (mut rank, is_last) = (count.row(), !N::any(count.below(none + valences)));
        self.look_up(&mut rank);
        (rank, is_last)
    }

    /// Replaces counts by what they mean.
    #[inline(always)]
    fn look_up<R: AsMut<[f64]>>(&self, counts: &mut R) {
        for count in counts.as_mut() {
            *count = self.roots[count.to_bits() as usize % self.roots.len()];
        }
    }
}

/// What samples are counted from, so that the last bits of a count say where in the table the stars' rows have what it means.
#[inline(always)]
fn none<N: Number>(token: N::Token, valences: N) -> N {
    N::splat(token, WHOLE) + valences * N::splat(token, ROW as f64)
}

/// The same for stars of any size.
#[cold]
fn rank_by_sorting<N: Number>(samples: &mut [Sample<N>], valences: &N::Row) {
    for star in 0..N::STARS {
        let n = valences.as_ref()[star] as usize;
        let own = |sample: &Sample<N>| sample.interval.as_ref()[star];
        let mut intervals: Vec<f64> = samples[..n].iter().map(own).collect();
        intervals.sort_unstable_by(f64::total_cmp);
        for sample in &mut samples[..n] {
            let count = intervals.partition_point(|&interval| interval <= own(sample));
            sample.rank.as_mut()[star] = root_term(count, n);
        }
    }
}

/// √(−2 ln(1 − F)) for F = c / (n + 1), formula (3). The logarithm is libm's, the same on every machine.
fn root_term(count: usize, n: usize) -> f64 {
    let all = n as f64 + 1.0;
    (-2.0 * libm::log((all - count as f64) / all)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn modelled(samples: &[f64], width: f64, limit: f64) -> Vec<f64> {
        let options = Options { interval_width: width, sample_limit: limit, ..Options::default() };
        let (model, n) = (Model::new(&options), samples.len() as f64);
        let mut all: Vec<Sample<f64>> = samples.iter().map(|_| Sample::default()).collect();
        let mut total = 0.0;
        for (sample, &value) in all.iter_mut().zip(samples) {
            let value = model.bounded((), value);
            (sample.value, sample.interval) = ([value], [model.interval((), value, true)]);
            total += value;
        }
        model.rank((), &mut all, n);
        let deviation = model.deviation((), &all, total, n);
        all.iter().map(|sample| 1.0 + sample.rank[0] * deviation).collect()
    }

    #[test]
    fn equal_samples_are_asked_to_be_equilateral() {
        assert_eq!(modelled(&[1.7; 6], 0.5, 3.0), vec![1.0; 6]);
    }

    #[test]
    fn formulas_one_to_four_by_hand() {
        // Intervals (1, 1.5], (1.5, 2]: one sample in the first, three in the second. M = 1.6, D = 0.06.
        let found = modelled(&[1.2, 1.6, 1.8, 1.8], 0.5, 3.0);
        let expected = |f: f64| 1.0 + (-2.0 * 0.06 * (1.0 - f).ln()).sqrt();
        for (value, f) in found.iter().zip([1.0 / 5.0, 4.0 / 5.0, 4.0 / 5.0, 4.0 / 5.0]) {
            assert!((value - expected(f)).abs() < 1e-12, "{value} {}", expected(f));
        }
    }

    #[test]
    fn the_end_of_an_interval_belongs_to_it() {
        let found = modelled(&[1.0, 1.5, 1.500001, 2.0], 0.5, 3.0);
        assert_eq!(found[0], found[1]);
        assert!(found[1] < found[2]);
        assert_eq!(found[2], found[3]);
    }

    #[test]
    fn a_sliver_counts_as_the_limit() {
        assert_eq!(modelled(&[1.2, 1.4, 1e9], 0.5, 3.0), modelled(&[1.2, 1.4, 3.0], 0.5, 3.0));
        assert_eq!(modelled(&[1.2, 1.4, f64::INFINITY], 0.5, 3.0), modelled(&[1.2, 1.4, 3.0], 0.5, 3.0));
    }

    #[test]
    fn tabulated_and_general_stars_agree() {
        for n in [TABLE, TABLE + 1, 200] {
            let samples: Vec<f64> = (0..n).map(|i| 1.0 + (i * 37 % n) as f64 / n as f64).collect();
            let found = modelled(&samples, 0.25, 3.0);
            let mean = samples.iter().sum::<f64>() / n as f64;
            let d = samples.iter().map(|a| (a - mean).powi(2)).sum::<f64>() / n as f64;
            for (a, value) in samples.iter().zip(found) {
                let upper = (((a - 1.0) / 0.25).ceil().max(1.0)) * 0.25 + 1.0;
                let f = samples.iter().filter(|&&q| q <= upper).count() as f64 / (n as f64 + 1.0);
                assert!((value - 1.0 - (-2.0 * d * (1.0 - f).ln()).sqrt()).abs() < 1e-12);
            }
        }
    }
}
