//! The area a relative to the mean m of its star. Variable: the square of a/m or of m/a, whichever is above 1.

use super::Apex;

pub(super) fn sample(apex: Apex, fair: f64) -> f64 {
    if fair <= 0.0 {
        return f64::INFINITY;
    }
    let ratio = apex.height / fair;
    let ratio = if ratio < 1.0 { 1.0 / ratio } else { ratio };
    ratio * ratio
}

/// As much too large or too small as modelled, on the side on which it is. The apex keeps its foot, so only the height
/// changes.
pub(super) fn center(apex: Apex, fair: f64, ideal: f64) -> Apex {
    if fair <= 0.0 {
        return apex;
    }
    let ratio = ideal.sqrt();
    Apex { foot: apex.foot, height: if apex.height > fair { fair * ratio } else { fair / ratio } }
}
