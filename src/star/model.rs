//! Modelling of better values from the star's own statistics: formulas (1) to (4) of the paper.

use crate::options::Options;

/// Largest star whose logarithms are tabulated.
const TABLE: usize = 32;

/// Formulas (1) to (4) with their settings.
pub(crate) struct Model {
    interval_width: f64,
    sample_limit: f64,
    /// Entry \[n\]\[c\] is −2 ln(1 − c / (n + 1)).
    log_table: Vec<[f64; TABLE + 1]>,
}

impl Model {
    pub fn new(options: &Options) -> Self {
        let row = |n: usize| std::array::from_fn(|c| if c <= n { log_term(c, n) } else { 0.0 });
        Self {
            interval_width: options.interval_width,
            sample_limit: options.sample_limit,
            log_table: (0..=TABLE).map(row).collect(),
        }
    }

    /// Replaces the samples of a star by the modelled values a*.
    pub fn apply(&self, samples: &mut [f64], intervals: &mut Vec<u32>) {
        let n = samples.len();
        for a in samples.iter_mut() {
            *a = a.min(self.sample_limit);
        }
        let deviation = variance(samples);
        intervals.clear();
        intervals.extend(samples.iter().map(|&a| self.interval(a)));
        let own = intervals.len();
        if own > TABLE {
            intervals.extend_from_within(..);
            intervals[own..].sort_unstable();
        }
        for (i, a) in samples.iter_mut().enumerate() {
            let count = count_up_to(intervals, own, intervals[i]);
            // Formula (4).
            *a = 1.0 + (deviation * self.log_term(count, n)).sqrt();
        }
    }

    /// Number of the interval (1 + (j − 1)·w, 1 + j·w] that holds `a`; 1 itself lies in the first.
    fn interval(&self, a: f64) -> u32 {
        (((a - 1.0) / self.interval_width).ceil() as u32).max(1)
    }

    fn log_term(&self, count: usize, n: usize) -> f64 {
        if n <= TABLE { self.log_table[n][count] } else { log_term(count, n) }
    }
}

/// −2 ln(1 − F) for F = c / (n + 1), formula (3). The logarithm is libm's, the same on every machine.
fn log_term(count: usize, n: usize) -> f64 {
    let all = n as f64 + 1.0;
    -2.0 * libm::log((all - count as f64) / all)
}

/// D of formula (1).
fn variance(samples: &[f64]) -> f64 {
    let n = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / n;
    samples.iter().map(|a| (a - mean) * (a - mean)).sum::<f64>() / n
}

/// How many of the first `own` intervals are at most `interval`; where a sorted copy follows them, by bisection in it.
fn count_up_to(intervals: &[u32], own: usize, interval: u32) -> usize {
    if intervals.len() > own {
        intervals[own..].partition_point(|&j| j <= interval)
    } else {
        intervals.iter().filter(|&&j| j <= interval).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn modelled(samples: &[f64], width: f64, limit: f64) -> Vec<f64> {
        let options = Options { interval_width: width, sample_limit: limit, ..Options::default() };
        let mut values = samples.to_vec();
        Model::new(&options).apply(&mut values, &mut Vec::new());
        values
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
