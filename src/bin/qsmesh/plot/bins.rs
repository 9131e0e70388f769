//! Shares of the triangles by the value of a quality parameter.

use qsmesh::{Distribution, Measurement, Parameter};

use super::state::State;
use crate::failure::{Failure, Result};
use crate::files::Positions;

/// Level p99 of [`Distribution::percentiles`].
const P99: usize = 6;

/// The intervals of one axis, the same for all states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    pub parameter: Parameter,
    /// Where the first interval begins.
    pub lower: f64,
    /// Width of an interval.
    pub width: f64,
    /// How many there are.
    pub count: usize,
    /// Whether values may lie past the last one.
    pub is_open: bool,
}

/// Shares of all triangles, in percent.
#[derive(Debug, PartialEq)]
pub struct Bins {
    /// In each interval.
    pub shares: Vec<f64>,
    /// Past the last interval; infinite values are among them.
    pub beyond: f64,
    /// Without a value: a triangle with two corners in one place has no largest angle.
    pub without: f64,
}

impl Scale {
    /// For edge ratios: far enough for 99 % of the triangles of each state, but to 10 at most.
    pub fn of_edge_ratio<'a>(states: impl Iterator<Item = &'a Measurement>) -> Self {
        let top = states.map(|state| state.edge_ratio.percentiles[P99]).fold(1.0, f64::max);
        let (width, count) = match top {
            ..=2.0 => (0.025, 40),
            ..=3.0 => (0.05, 40),
            ..=4.0 => (0.05, 60),
            ..=5.0 => (0.05, 80),
            ..=7.0 => (0.1, 60),
            _ => (0.1, 90),
        };
        Self { parameter: Parameter::EdgeRatio, lower: 1.0, width, count, is_open: true }
    }

    /// For smallest angles: all that there are.
    pub fn of_min_angle() -> Self {
        Self { parameter: Parameter::MinAngle, lower: 0.0, width: 1.0, count: 60, is_open: false }
    }

    /// For largest angles: all that there are.
    pub fn of_max_angle() -> Self {
        Self { parameter: Parameter::MaxAngle, lower: 60.0, width: 2.0, count: 60, is_open: false }
    }

    /// Where the last interval ends.
    pub fn upper(&self) -> f64 {
        self.lower + self.width * self.count as f64
    }

    /// From its beginning to its end.
    pub fn length(&self) -> f64 {
        self.upper() - self.lower
    }

    /// The figures of this axis.
    pub fn distribution<'a>(&self, of: &'a Measurement) -> &'a Distribution {
        match self.parameter {
            Parameter::EdgeRatio => &of.edge_ratio,
            Parameter::MinAngle => &of.min_angle,
            Parameter::MaxAngle => &of.max_angle,
            Parameter::Shape => &of.shape,
            Parameter::RadiusRatio => &of.radius_ratio,
        }
    }

    /// Counts a state's triangles.
    pub fn bins(&self, state: &State<'_>) -> Result<Bins> {
        // From 0 or 1 on, so that values below the axis have intervals of their own.
        let (start, skipped) = match self.parameter {
            Parameter::MaxAngle => (0.0, (self.lower / self.width).round() as usize),
            _ => (self.lower, 0),
        };
        let counts = match state.positions {
            Positions::F32(points) => self.histogram(points, state.triangles, start, skipped),
            Positions::F64(points) => self.histogram(points, state.triangles, start, skipped),
        };
        let counts = counts.map_err(|error| Failure::new(error.to_string()))?;
        Ok(self.shares(&counts, skipped))
    }

    fn histogram<T: qsmesh::Coordinate>(
        &self,
        points: &[[T; 3]],
        triangles: &[[u32; 3]],
        start: f64,
        skipped: usize,
    ) -> std::result::Result<Vec<usize>, qsmesh::Error> {
        let count = skipped + self.count + usize::from(self.is_open);
        qsmesh::histogram(points, triangles, self.parameter, start, self.width, count)
    }

    fn shares(&self, counts: &[usize], skipped: usize) -> Bins {
        let all = counts.iter().sum::<usize>().max(1) as f64;
        let share = |count: usize| 100.0 * count as f64 / all;
        let (below, inside) = counts.split_at(skipped);
        let mut shares: Vec<f64> = inside[..self.count].iter().map(|&count| share(count)).collect();
        let mut without = share(below.iter().sum());
        // The largest angle of an equilateral triangle may be rounded to a little less than 60°.
        if let Some(&rounded) = below.last() {
            shares[0] += share(rounded);
            without -= share(rounded);
        }
        Bins { shares, beyond: share(inside[self.count..].iter().sum()), without: without.max(0.0) }
    }
}

#[cfg(test)]
mod tests {
    use qsmesh::Measurement;

    use super::{Bins, P99, Scale};
    use crate::files::Positions;
    use crate::plot::State;

    fn bins(scale: &Scale, points: &[[f64; 3]], triangles: &[[u32; 3]]) -> Bins {
        let positions = Positions::F64(points.to_vec());
        let measurement = qsmesh::measure(points, triangles).unwrap();
        scale.bins(&State { name: "", positions: &positions, triangles, measurement: &measurement }).unwrap()
    }

    /// An equilateral triangle, 3-4-5, a needle, and one with two corners in one place.
    const POINTS: [[f64; 3]; 6] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.5, 0.866_025_403_784_438_6, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 3.0, 0.0],
        [4.0, 0.01, 0.0],
    ];
    const TRIANGLES: [[u32; 3]; 4] = [[0, 1, 2], [0, 3, 4], [0, 3, 5], [1, 1, 0]];

    #[test]
    fn edge_ratios_past_the_axis_are_counted_apart() {
        let scale = Scale::of_edge_ratio([Measurement::default()].iter());
        let found = bins(&scale, &POINTS, &TRIANGLES);
        assert_eq!((found.beyond, found.without), (50.0, 0.0));
        assert_eq!((found.shares[0], found.shares[26]), (25.0, 25.0));
        assert_eq!(found.shares.iter().sum::<f64>(), 50.0);
    }

    #[test]
    fn angles_that_there_are_have_a_place() {
        let small = bins(&Scale::of_min_angle(), &POINTS, &TRIANGLES);
        assert_eq!((small.shares[59], small.shares[36], small.shares[0]), (25.0, 25.0, 50.0));
        let large = bins(&Scale::of_max_angle(), &POINTS, &TRIANGLES);
        assert_eq!((large.shares[0], large.without, large.beyond), (25.0, 25.0, 0.0));
        assert_eq!(large.shares.iter().sum::<f64>(), 75.0);
    }

    #[test]
    fn a_triangle_in_one_point_has_no_largest_angle() {
        let found = bins(&Scale::of_max_angle(), &POINTS, &[[0, 3, 4], [2, 2, 2]]);
        assert_eq!((found.without, found.shares[15]), (50.0, 50.0));
        let none = bins(&Scale::of_max_angle(), &POINTS, &[]);
        assert_eq!(none.shares.iter().sum::<f64>() + none.without, 0.0);
    }

    #[test]
    fn the_axis_holds_what_most_triangles_have() {
        let scale = |p99| {
            let mut one = Measurement::default();
            one.edge_ratio.percentiles[P99] = p99;
            Scale::of_edge_ratio([Measurement::default(), one].iter()).upper()
        };
        assert_eq!([1.0, 2.5, 3.1, 4.4, 6.9, 500.0].map(scale), [2.0, 3.0, 4.0, 5.0, 7.0, 10.0]);
    }
}
