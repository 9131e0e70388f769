//! How far a triangle exceeds the thresholds of the tail.

use glam::DVec3;

use super::options::TailOptions;
use super::report::Defect;

/// The three thresholds, in the form in which triangles are held against them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    edge_ratio: f64,
    /// tan(min_angle / 2).
    min_tangent: f64,
    /// cot(max_angle / 2).
    max_cotangent: f64,
    /// Square of a mean-ratio shape that no triangle of the tail has, over 12.
    fine: f64,
}

impl Limits {
    pub fn new(options: &TailOptions<'_>) -> Self {
        let tangent = |degrees: f64| libm::tan(0.5 * degrees.to_radians());
        // The best-shaped triangles at each threshold are isosceles.
        let shape = |base: f64| 12.0 * base * base * (4.0 - base * base) / (base * base + 2.0).powi(2) / 4.0;
        let base = |degrees: f64| 2.0 * libm::sin(0.5 * degrees.to_radians());
        let bases = [1.0 / options.edge_ratio, base(options.min_angle), base(options.max_angle)];
        Self {
            fine: 1.001 / 12.0 * bases.map(shape).into_iter().fold(0.0, f64::max),
            edge_ratio: options.edge_ratio,
            min_tangent: tangent(options.min_angle),
            max_cotangent: 1.0 / tangent(options.max_angle),
        }
    }

    /// Above 1 exactly for a triangle of the tail, and the greater the worse: the largest of edge_ratio over its limit
    /// and the half-angle tangents over theirs. Infinite without area.
    pub fn excess(&self, corners: [DVec3; 3]) -> f64 {
        let [ratio, small, large] = self.parts(corners);
        ratio.max(small).max(large)
    }

    /// Whether a triangle is so well-shaped that its excess cannot be above 1: cheaper to find out than the excess.
    pub fn is_clearly_fine(&self, [a, b, c]: [DVec3; 3]) -> bool {
        let (u, v) = (b - a, c - a);
        let sum = u.length_squared() + v.length_squared() + (c - b).length_squared();
        u.cross(v).length_squared() >= self.fine * sum * sum && sum > 0.0
    }

    /// What is wrong with a triangle of the tail.
    pub fn defect(&self, corners: [DVec3; 3]) -> Defect {
        let [ratio, small, large] = self.parts(corners);
        if large == f64::INFINITY {
            Defect::Degenerate
        } else if large > 1.0 && large >= ratio {
            Defect::Cap
        } else if ratio > 1.0 {
            Defect::Needle
        } else {
            debug_assert!(small > 1.0, "not in the tail");
            Defect::SmallAngle
        }
    }

    /// Whether a triangle is rather a needle than a cap.
    pub fn is_needle(&self, corners: [DVec3; 3]) -> bool {
        let [ratio, _, large] = self.parts(corners);
        ratio > large
    }

    /// The three quotients of which the excess is the largest: of the edge ratio, the smallest and the largest angle.
    pub fn parts(&self, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
        let (u, v) = (b - a, c - a);
        let double_area = u.cross(v).length();
        let [short, middle, long] = sorted([u.length_squared(), v.length_squared(), (c - b).length_squared()]);
        // Written so that NaN, too, counts as no area.
        if !(double_area > 0.0 && short > 0.0 && long < f64::INFINITY) {
            return [f64::INFINITY; 3];
        }
        // cot(θ/2) = (|p||q| + p·q) / |p × q|, and tan(θ/2) with the other sign.
        let small = (middle * long).sqrt() + 0.5 * (middle + long - short);
        let large = (short * middle).sqrt() - 0.5 * (short + middle - long);
        [
            (long / short).sqrt() / self.edge_ratio,
            small / double_area * self.min_tangent,
            large / double_area * self.max_cotangent,
        ]
    }
}

fn sorted([a, b, c]: [f64; 3]) -> [f64; 3] {
    let (low, high) = (a.min(b), a.max(b));
    [low.min(c), low.max(high.min(c)), high.max(c)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quality::triangle::Sides;
    use proptest::prelude::*;

    fn corners(apex: [f64; 2]) -> [DVec3; 3] {
        [DVec3::ZERO, DVec3::X, DVec3::new(apex[0], apex[1], 0.0)]
    }

    #[test]
    fn each_defect_is_told() {
        let limits = Limits::new(&TailOptions::default());
        for (apex, defect) in [
            ([0.5, 0.0], Defect::Degenerate),
            ([0.5, 0.1], Defect::Cap),
            ([0.1, 0.2], Defect::Needle),
            ([0.5, 2.86], Defect::SmallAngle),
        ] {
            assert!(limits.excess(corners(apex)) > 1.0);
            assert_eq!(limits.defect(corners(apex)), defect, "{apex:?}");
        }
        assert!(limits.excess([DVec3::ONE; 3]) == f64::INFINITY);
    }

    proptest! {
        #[test]
        fn the_excess_passes_1_where_a_measure_passes_its_threshold(x in -1.0..2.0, y in 0.01..3.0) {
            let limits = Limits::new(&TailOptions::default());
            let sides = Sides::new(corners([x, y]));
            let passed = [sides.edge_ratio() / 3.0, 20.0 / sides.min_angle(), sides.max_angle() / 130.0];
            let most = passed.into_iter().fold(0.0, f64::max);
            prop_assume!((most - 1.0_f64).abs() > 1e-9);
            prop_assert_eq!(limits.excess(corners([x, y])) > 1.0, most > 1.0);
            prop_assert!(most < 1.0 || !limits.is_clearly_fine(corners([x, y])));
        }
    }
}
