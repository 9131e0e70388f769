//! The smallest angle θ. Variable: √3·cot θ, which is 1 at 60° and 3 at 30°.
//!
//! The cotangent of an angle is what it costs in the stiffness matrix of the triangle, and needs neither a root nor an
//! arc to be measured.

use super::{Apex, within};

const SQRT_3: f64 = 1.732_050_807_568_877_2;

pub(super) fn sample(apex: Apex) -> f64 {
    let [start, end, top] = apex.cotangents();
    SQRT_3 * start.max(end).max(top)
}

/// The corner with the smallest angle gets the modelled one: one at the rim by a turn of the apex about it, the apex
/// itself by coming down. Both go no farther than where a second angle would be as small.
pub(super) fn center(apex: Apex, ideal: f64) -> Apex {
    let cot = ideal / SQRT_3;
    if apex.height <= 0.0 {
        return Apex { foot: 0.5, height: 0.5 / cot };
    }
    let [start, end, top] = apex.cotangents();
    if top >= start.max(end) {
        lowered(apex, cot)
    } else if start >= end {
        turned(apex, cot)
    } else {
        turned(apex.mirrored(), cot).mirrored()
    }
}

/// Turned about the start of the edge until the angle there has the cotangent `cot`.
fn turned(apex: Apex, cot: f64) -> Apex {
    let sine = 1.0 / (1.0 + cot * cot).sqrt();
    let cosine = cot * sine;
    // Nearer, the angle at the end would be smaller; farther off, that at the apex.
    let radius = within(apex.distance_from_start(), 0.5 / cosine, 2.0 * cosine);
    Apex { foot: radius * cosine, height: radius * sine }
}

/// Brought down to the circle from which the edge is seen under the angle with the cotangent `cot`.
fn lowered(apex: Apex, cot: f64) -> Apex {
    let square = 1.0 + cot * cot;
    let farthest = 2.0 * cot * cot / square;
    let foot = within(apex.foot, 1.0 - farthest, farthest);
    let off = foot - 0.5;
    Apex { foot, height: 0.5 * cot + (0.25 * square - off * off).max(0.0).sqrt() }
}
