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
}

impl Limits {
    pub fn new(options: &TailOptions<'_>) -> Self {
        let tangent = |degrees: f64| libm::tan(0.5 * degrees.to_radians());
        Self {
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

    /// What is wrong with a triangle of the tail.
    pub fn defect(&self, corners: [DVec3; 3]) -> Defect {
        let [ratio, _, large] = self.parts(corners);
        if large == f64::INFINITY {
            Defect::Degenerate
        } else if large > 1.0 {
            Defect::Cap
        } else if ratio > 1.0 {
            Defect::Needle
        } else {
            Defect::SmallAngle
        }
    }

    fn parts(&self, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
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
