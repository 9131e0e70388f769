//! Modelling of better values from the star's own statistics: formulas (1) to (4) of the paper.

use fearless_simd::prelude::*;

use super::lanes::{self, LANES, Numbers};
use crate::options::Options;

/// Largest star whose logarithms are tabulated, and whose ranks are counted one by one.
const TABLE: usize = 32;

/// Formulas (1) to (4) with their settings.
pub(crate) struct Model {
    /// 1 / w.
    per_interval: f64,
    sample_limit: f64,
    /// Entry \[n\]\[c\] is √(−2 ln(1 − c / (n + 1))): F takes no other values.
    roots: Vec<[f64; TABLE + 1]>,
}

impl Model {
    pub fn new(options: &Options) -> Self {
        let row = |n: usize| std::array::from_fn(|c| if c <= n { root_term(c, n) } else { 0.0 });
        Self {
            per_interval: 1.0 / options.interval_width,
            sample_limit: options.sample_limit,
            roots: (0..=TABLE).map(row).collect(),
        }
    }

    /// Bounds the samples of a star of `n` triangles and returns √D of formula (1).
    #[inline(always)]
    pub fn deviation<S: Simd>(&self, simd: S, samples: &mut [[f64; LANES]], n: usize) -> f64 {
        let (limit, none) = (Numbers::splat(simd, self.sample_limit), Numbers::splat(simd, 0.0));
        let mut total = none;
        for (chunk, sample) in samples.iter_mut().enumerate() {
            let value = Numbers::load_array_ref(simd, sample);
            let value = value.simd_lt(limit).select(value, limit);
            value.store_array(sample);
            total += lanes::below(simd, chunk, n).select(value, none);
        }
        let mean = lanes::sum(total) / n as f64;
        let mut squares = none;
        for (chunk, sample) in samples.iter().enumerate() {
            let off = Numbers::load_array_ref(simd, sample) - mean;
            squares += lanes::below(simd, chunk, n).select(off * off, none);
        }
        (lanes::sum(squares) / n as f64).sqrt()
    }

    /// Replaces the samples by the modelled values a*, given √D.
    #[inline(always)]
    pub fn apply<S: Simd>(&self, simd: S, samples: &mut [[f64; LANES]], n: usize, deviation: f64) {
        for (chunk, sample) in samples.iter_mut().enumerate() {
            // No comparison holds for a lane without a triangle.
            let nothing = Numbers::splat(simd, f64::NAN);
            let interval = self.interval(simd, Numbers::load_array_ref(simd, sample));
            lanes::below(simd, chunk, n).select(interval, nothing).store_array(sample);
        }
        if samples.len() == 1 {
            let intervals = samples[0];
            samples[0] = self.roots(simd, &[intervals], &intervals, n);
        } else if n <= TABLE {
            let mut intervals = [[f64::NAN; LANES]; TABLE / LANES];
            intervals[..samples.len()].copy_from_slice(samples);
            for sample in samples.iter_mut() {
                *sample = self.roots(simd, &intervals, sample, n);
            }
        } else {
            roots_by_sorting(samples, n);
        }
        for sample in samples {
            // Formula (4).
            (Numbers::load_array_ref(simd, sample) * deviation + 1.0).store_array(sample);
        }
    }

    /// Number of the interval (1 + (j − 1)·w, 1 + j·w] that holds a sample; 1 itself lies in the first.
    #[inline(always)]
    fn interval<S: Simd>(&self, simd: S, value: Numbers<S>) -> Numbers<S> {
        let one = Numbers::splat(simd, 1.0);
        let number = ((value - one) * self.per_interval).ceil();
        number.simd_lt(one).select(one, number)
    }

    /// √(−2 ln(1 − F)), F by formula (3), for samples in the intervals `own` out of `all`.
    #[inline(always)]
    fn roots<S: Simd>(&self, simd: S, all: &[[f64; LANES]], own: &[f64; LANES], n: usize) -> [f64; LANES] {
        let (one, none) = (Numbers::splat(simd, 1.0), Numbers::splat(simd, 0.0));
        let (own, mut count, mut root) = (Numbers::load_array_ref(simd, own), none, none);
        for interval in all.as_flattened() {
            count += own.simd_ge(*interval).select(one, none);
        }
        for (c, &value) in self.roots[n][1..=LANES * all.len()].iter().enumerate() {
            root = count.simd_eq((c + 1) as f64).select(Numbers::splat(simd, value), root);
        }
        root.to_array()
    }
}

/// The same for stars of any size: replaces the numbers of intervals.
#[cold]
fn roots_by_sorting(samples: &mut [[f64; LANES]], n: usize) {
    let mut intervals = samples.as_flattened()[..n].to_vec();
    intervals.sort_unstable_by(f64::total_cmp);
    for sample in &mut samples.as_flattened_mut()[..n] {
        *sample = root_term(intervals.partition_point(|interval| interval <= sample), n);
    }
}

/// √(−2 ln(1 − F)) for F = c / (n + 1), formula (3). The logarithm is libm's, the same on every machine.
fn root_term(count: usize, n: usize) -> f64 {
    let all = n as f64 + 1.0;
    (-2.0 * libm::log((all - count as f64) / all)).sqrt()
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};

    use super::*;

    fn modelled(samples: &[f64], width: f64, limit: f64) -> Vec<f64> {
        let options = Options { interval_width: width, sample_limit: limit, ..Options::default() };
        let mut values = vec![[0.0; LANES]; samples.len().div_ceil(LANES)];
        values.as_flattened_mut()[..samples.len()].copy_from_slice(samples);
        let model = Model::new(&options);
        dispatch!(Level::new(), simd => {
            let deviation = model.deviation(simd, &mut values, samples.len());
            model.apply(simd, &mut values, samples.len(), deviation);
        });
        values.as_flattened()[..samples.len()].to_vec()
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
