//! Quality of one triangle from its sides and area. Names follow Verdict (Stimpson et al., SAND2007-1751).

use glam::DVec3;

/// Squared sides and twice the area of a triangle: all that its quality depends on.
#[derive(Debug, Clone, Copy)]
pub struct Sides {
    /// Squared lengths; entry i lies opposite corner i.
    squared: [f64; 3],
    /// Twice the area.
    double_area: f64,
}

impl Sides {
    /// Of the triangle with these corners.
    pub fn new([a, b, c]: [DVec3; 3]) -> Self {
        Self {
            squared: [(c - b).length_squared(), (a - c).length_squared(), (b - a).length_squared()],
            double_area: (b - a).cross(c - a).length(),
        }
    }

    /// Longest over shortest edge; infinite where the shortest has length 0. The paper's AR.
    pub fn edge_ratio(&self) -> f64 {
        let [a, b, c] = self.squared;
        let shortest = a.min(b).min(c);
        if shortest > 0.0 { (a.max(b).max(c) / shortest).sqrt() } else { f64::INFINITY }
    }

    /// Mean ratio, 4√3·area / Σ edge²; 1 for the equilateral triangle, 0 without area.
    pub fn shape(&self) -> f64 {
        let sum: f64 = self.squared.iter().sum();
        if sum > 0.0 { 2.0 * 3.0_f64.sqrt() * self.double_area / sum } else { 0.0 }
    }

    /// Circumradius over twice the inradius; infinite without area.
    pub fn radius_ratio(&self) -> f64 {
        let [a, b, c] = self.squared.map(f64::sqrt);
        if self.double_area > 0.0 {
            // R = abc / (2·double_area), r = double_area / (a + b + c)
            a * b * c * (a + b + c) / (4.0 * self.double_area * self.double_area)
        } else {
            f64::INFINITY
        }
    }

    /// Smallest angle in degrees; 0 without area.
    pub fn min_angle(&self) -> f64 {
        let [a, b, c] = self.squared;
        if self.double_area > 0.0 { self.angle_opposite(a.min(b).min(c)) } else { 0.0 }
    }

    /// Largest angle in degrees; 180 for three points on a line, 0 for three points in one.
    pub fn max_angle(&self) -> f64 {
        let [a, b, c] = self.squared;
        self.angle_opposite(a.max(b).max(c))
    }

    /// Twice the area.
    pub fn double_area(&self) -> f64 {
        self.double_area
    }

    /// Angle in degrees that faces a side of this squared length: its tangent is 4·area / (sum − 2·side²) by the law of
    /// cosines.
    fn angle_opposite(&self, side: f64) -> f64 {
        let sum: f64 = self.squared.iter().sum();
        libm::atan2(2.0 * self.double_area, sum - 2.0 * side).to_degrees()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sides(b: [f64; 2], c: [f64; 2]) -> Sides {
        Sides::new([DVec3::ZERO, DVec3::new(b[0], b[1], 0.0), DVec3::new(c[0], c[1], 0.0)])
    }

    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
    }

    #[test]
    fn the_equilateral_triangle_is_perfect() {
        let s = sides([1.0, 0.0], [0.5, 0.75_f64.sqrt()]);
        near(s.edge_ratio(), 1.0);
        near(s.shape(), 1.0);
        near(s.radius_ratio(), 1.0);
        near(s.min_angle(), 60.0);
        near(s.max_angle(), 60.0);
    }

    #[test]
    fn three_four_five() {
        let s = sides([4.0, 0.0], [0.0, 3.0]);
        near(s.edge_ratio(), 5.0 / 3.0);
        near(s.max_angle(), 90.0);
        near(s.min_angle(), 0.6_f64.asin().to_degrees());
        near(s.radius_ratio(), 2.5 / 2.0);
        near(s.shape(), 4.0 * 3.0_f64.sqrt() * 6.0 / 50.0);
        near(s.double_area(), 12.0);
    }

    #[test]
    fn three_points_on_a_line() {
        let s = sides([2.0, 0.0], [1.0, 0.0]);
        near(s.edge_ratio(), 2.0);
        assert_eq!((s.shape(), s.min_angle(), s.max_angle()), (0.0, 0.0, 180.0));
        assert_eq!(s.radius_ratio(), f64::INFINITY);
    }

    #[test]
    fn two_and_three_points_in_one() {
        assert_eq!(sides([1.0, 0.0], [1.0, 0.0]).edge_ratio(), f64::INFINITY);
        let point = sides([0.0, 0.0], [0.0, 0.0]);
        assert_eq!((point.shape(), point.min_angle()), (0.0, 0.0));
    }
}
