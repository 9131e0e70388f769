//! The quality parameters by name.

use super::triangle::Sides;

/// A quality parameter of a triangle, in the words of the Verdict library.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// Longest edge over shortest edge, 1 to infinity; the paper's AR.
    EdgeRatio,
    /// Smallest angle in degrees, 0 to 60.
    MinAngle,
    /// Largest angle in degrees, 60 to 180.
    MaxAngle,
    /// Mean ratio 4√3·area / Σ edge², 0 to 1.
    Shape,
    /// Circumradius over twice the inradius, 1 to infinity.
    RadiusRatio,
}

impl Parameter {
    /// All of them, in the order of the C enumeration.
    pub const ALL: [Self; 5] = [Self::EdgeRatio, Self::MinAngle, Self::MaxAngle, Self::Shape, Self::RadiusRatio];

    /// Its value for one triangle.
    pub(crate) fn of(self, sides: &Sides) -> f64 {
        match self {
            Self::EdgeRatio => sides.edge_ratio(),
            Self::MinAngle => sides.min_angle(),
            Self::MaxAngle => sides.max_angle(),
            Self::Shape => sides.shape(),
            Self::RadiusRatio => sides.radius_ratio(),
        }
    }
}
