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
