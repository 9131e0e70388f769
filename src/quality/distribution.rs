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
        values.sort_unstable_by(f64::total_cmp);
        Self {
            count,
            infinite: all - count,
            mean,
            variance,
            min: values[0],
            max: values[count - 1],
            percentiles: PERCENTILE_LEVELS.map(|level| percentile(values, level)),
        }
    }
}

/// Value at `level` percent of sorted samples.
fn percentile(sorted: &[f64], level: f64) -> f64 {
    let rank = level / 100.0 * (sorted.len() - 1) as f64;
    let low = rank.floor() as usize;
    let high = (low + 1).min(sorted.len() - 1);
    sorted[low] + (rank - low as f64) * (sorted[high] - sorted[low])
}
