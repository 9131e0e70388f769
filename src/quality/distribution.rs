//! Statistics of one parameter over many triangles.

/// Levels, in percent, of [`Distribution::percentiles`].
pub const PERCENTILE_LEVELS: [f64; 7] = [1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0];

/// Distribution of one quality parameter. Infinite values (a triangle with an edge of length 0 has no finite edge_ratio)
/// are counted and left out of everything else.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Distribution {
    /// Finite samples.
    pub count: usize,
    /// Samples that are not finite.
    pub infinite: usize,
    /// Mean, the paper's M (formula (1)).
    pub mean: f64,
    /// Variance over the count, the paper's D (formula (1)).
    pub variance: f64,
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// Values at [`PERCENTILE_LEVELS`], interpolated linearly between neighbouring ranks.
    pub percentiles: [f64; 7],
}

impl Distribution {
    /// Statistics of `values`, which are reordered. Without a finite value everything but the counts is 0.
    pub(crate) fn of(values: &mut Vec<f64>) -> Self {
        let all = values.len();
        values.retain(|x| x.is_finite());
        let count = values.len();
        if count == 0 {
            return Self { infinite: all, ..Self::default() };
        }
        let mean = values.iter().sum::<f64>() / count as f64;
        let variance = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count as f64;
        Self {
            count,
            infinite: all - count,
            mean,
            variance,
            min: values.iter().copied().fold(f64::INFINITY, f64::min),
            max: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            percentiles: percentiles(values),
        }
    }
}

/// Values at [`PERCENTILE_LEVELS`], by selection: what lies below one level need not be looked at for the next.
fn percentiles(values: &mut [f64]) -> [f64; 7] {
    let mut from = 0;
    PERCENTILE_LEVELS.map(|level| {
        let rank = level / 100.0 * (values.len() - 1) as f64;
        let low = rank.floor() as usize;
        let (_, &mut below, above) = values[from..].select_nth_unstable_by(low - from, f64::total_cmp);
        from = low;
        let next = above.iter().copied().fold(f64::INFINITY, f64::min);
        if next.is_finite() { below + (rank - low as f64) * (next - below) } else { below }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_those_of_the_sorted_values() {
        for count in [1, 2, 3, 99, 100, 101, 1000] {
            let mut sorted: Vec<f64> = (0..count).map(|i| f64::from(i * 7919 % 1009).sqrt()).collect();
            let found = Distribution::of(&mut sorted.clone());
            sorted.sort_unstable_by(f64::total_cmp);
            for (level, value) in PERCENTILE_LEVELS.into_iter().zip(found.percentiles) {
                let rank = level / 100.0 * f64::from(count - 1);
                let (low, high) = (sorted[rank.floor() as usize], sorted[rank.ceil() as usize]);
                assert!((value - (low + rank.fract() * (high - low))).abs() < 1e-12, "{count} {level}");
            }
            assert_eq!((found.min, found.max), (sorted[0], sorted[sorted.len() - 1]));
        }
    }
}
