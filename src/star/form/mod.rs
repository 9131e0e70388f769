//! Potential forms: one file for each quality parameter.
//!
//! A file tells how a triangle becomes a sample of a random variable that is 1 for the ideal triangle and grows as the
//! triangle gets worse, and where the apex goes if the rim edge stays and the variable is to have the modelled value.
//! The paper's own parameter works on the triangles of eight stars at once; the others take them one by one.

mod area;
mod edge_ratio;
mod max_angle;
mod min_angle;
mod shape;

pub(super) use edge_ratio::{Flat, ProportionRows, Proportions};

/// Place of an apex over its rim edge, in units of the edge's length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Apex {
    /// From the start of the edge along it: 0 above the start, 1 above the end.
    pub foot: f64,
    /// To the inner side.
    pub height: f64,
}

impl Apex {
    /// The same triangle seen from the other end of its edge.
    fn mirrored(self) -> Self {
        Self { foot: 1.0 - self.foot, ..self }
    }

    fn distance_from_start(self) -> f64 {
        (self.foot * self.foot + self.height * self.height).sqrt()
    }

    /// Cotangents of the angles at the start, at the end and at the apex.
    fn cotangents(self) -> [f64; 3] {
        let Self { foot, height } = self;
        [foot / height, (1.0 - foot) / height, (height * height - foot * (1.0 - foot)) / height]
    }
}

/// The forms that are made one by one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    MinAngle,
    MaxAngle,
    Area,
    Shape,
}

impl Form {
    /// The random variable, at least 1; infinite for a triangle that has no area or is turned over. `fair` is the height
    /// over this edge at which the triangle would have the mean area of its star.
    pub fn sample(self, apex: Apex, fair: f64) -> f64 {
        if !(apex.height > 0.0 && apex.height < f64::INFINITY) {
            return f64::INFINITY;
        }
        match self {
            Self::MinAngle => min_angle::sample(apex),
            Self::MaxAngle => max_angle::sample(apex),
            Self::Area => area::sample(apex, fair),
            Self::Shape => shape::sample(apex),
        }
    }

    /// Say of a triangle in where its star's centre goes; `length` is that of its rim edge.
    ///
    /// For the largest angle and the area it is how steeply they change, so that a triangle counts by what it lacks, and
    /// not by the way its apex would have to go.
    pub fn weight(self, apex: Apex, length: f64) -> f64 {
        match self {
            Self::MinAngle | Self::Shape => 1.0,
            Self::MaxAngle if apex.height > 0.0 => max_angle::steepness(apex) / length,
            Self::MaxAngle => 1.0 / length,
            Self::Area => length,
        }
    }

    /// Factor on the mean of the ways to the potential centers. Forms close to the present apexes ask for short ways in
    /// many directions, whose mean is shorter still; the factors were found by measuring.
    pub fn reach(self) -> f64 {
        match self {
            Self::MinAngle => 1.0,
            Self::MaxAngle | Self::Area | Self::Shape => 4.0 / 3.0,
        }
    }

    /// The potential center for the modelled value `ideal` ≥ 1 of a triangle that is worse.
    pub fn center(self, apex: Apex, fair: f64, ideal: f64) -> Apex {
        match self {
            Self::MinAngle => min_angle::center(apex, ideal),
            Self::MaxAngle => max_angle::center(apex, ideal),
            Self::Area => area::center(apex, fair, ideal),
            Self::Shape => shape::center(apex, ideal),
        }
    }
}

/// `x`, or the nearer end of `low..=high`.
fn within(x: f64, low: f64, high: f64) -> f64 {
    x.max(low).min(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORMS: [Form; 4] = [Form::MinAngle, Form::MaxAngle, Form::Area, Form::Shape];

    /// Height at which the triangles below would have the mean area of their star.
    const FAIR: f64 = 0.7;

    /// Apexes over the whole edge and beyond both of its ends, flat ones and tall ones.
    fn apexes() -> impl Iterator<Item = Apex> {
        let feet = [-1.5, -0.2, 0.0, 0.3, 0.5, 0.6, 1.0, 1.1, 2.0];
        feet.into_iter().flat_map(|foot| [1e-3, 0.1, 0.6, 0.9, 3.0, 40.0].map(|height| Apex { foot, height }))
    }

    #[test]
    fn the_form_has_the_modelled_value() {
        for form in FORMS {
            for apex in apexes() {
                for ideal in [1.0 + 1e-9, 1.05, 1.3, 1.4, 1.6, 1.9, 2.5, 7.0] {
                    if form.sample(apex, FAIR) > ideal {
                        let found = form.sample(form.center(apex, FAIR, ideal), FAIR);
                        assert!((found / ideal - 1.0).abs() < 1e-6, "{form:?} {apex:?} {ideal}: {found}");
                    }
                }
            }
        }
    }

    #[test]
    fn an_apex_on_the_wrong_side_comes_to_the_inner_side_with_the_modelled_value() {
        for form in FORMS {
            for height in [0.0, -1.0] {
                for ideal in [1.1, 1.8] {
                    let center = form.center(Apex { foot: 0.2, height }, FAIR, ideal);
                    assert!((form.sample(center, FAIR) / ideal - 1.0).abs() < 1e-9, "{form:?} {height} {ideal}");
                    assert_eq!(form.sample(Apex { foot: 0.2, height }, FAIR), f64::INFINITY);
                }
            }
        }
    }

    #[test]
    fn the_value_one_is_the_equilateral_triangle_or_the_mean_area() {
        let peak = Apex { foot: 0.5, height: 0.75_f64.sqrt() };
        for apex in apexes() {
            for form in [Form::MinAngle, Form::MaxAngle, Form::Shape] {
                let center = form.center(apex, FAIR, 1.0);
                let off = (center.foot - peak.foot).abs() + (center.height - peak.height).abs();
                assert!(off < 1e-7, "{form:?} {apex:?}: {center:?}");
            }
            assert_eq!(Form::Area.center(apex, FAIR, 1.0), Apex { foot: apex.foot, height: FAIR });
        }
        for form in [Form::MinAngle, Form::MaxAngle, Form::Shape] {
            assert!((form.sample(peak, FAIR) - 1.0).abs() < 1e-7, "{form:?}");
        }
    }

    #[test]
    fn mirrored_triangles_have_mirrored_centers() {
        for form in FORMS {
            for apex in apexes() {
                let (center, other) =
                    (form.center(apex, FAIR, 1.2), form.center(apex.mirrored(), FAIR, 1.2).mirrored());
                let off = (center.foot - other.foot).abs() + (center.height - other.height).abs();
                // Where the angles at both ends are equal, either may be the one that gives way.
                assert!(off < 1e-9 || apex.foot == 0.5, "{form:?} {apex:?}: {center:?} {other:?}");
            }
        }
    }
}
