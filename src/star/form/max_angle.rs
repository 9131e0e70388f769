//! The largest angle φ. Variable: 2·sin(φ/2), the base of an isosceles triangle with legs of length 1 and φ between them:
//! 1 at 60°, √2 at 90°, never above 2.

use super::{Apex, within};

/// Greatest value that a triangle is asked for.
const MOST: f64 = 1.9;

pub(super) fn sample(apex: Apex) -> f64 {
    let [start, end, top] = apex.cotangents();
    let cot = start.min(end).min(top);
    (2.0 - 2.0 * cot / (1.0 + cot * cot).sqrt()).sqrt()
}

/// How fast the largest angle changes where the apex goes straight for it, with the edge's length as the unit.
pub(super) fn steepness(apex: Apex) -> f64 {
    let (start, end) = (apex.distance_from_start(), apex.mirrored().distance_from_start());
    match largest(apex) {
        Corner::Start => 1.0 / start,
        Corner::End => 1.0 / end,
        Corner::Top => 1.0 / (start * end),
    }
}

/// The corner with the largest angle gets the modelled one: one at the rim by a turn of the apex about it, the apex
/// itself by going up. Both go no farther than where a second angle would be as large.
pub(super) fn center(apex: Apex, ideal: f64) -> Apex {
    let ideal = ideal.min(MOST);
    let cosine = 1.0 - 0.5 * ideal * ideal;
    let sine = ideal * (1.0 - 0.25 * ideal * ideal).sqrt();
    if apex.height <= 0.0 {
        return Apex { foot: 0.5, height: 0.5 * (1.0 + cosine) / sine };
    }
    match largest(apex) {
        Corner::Start => turned(apex, cosine, sine),
        Corner::End => turned(apex.mirrored(), cosine, sine).mirrored(),
        Corner::Top => raised(apex, cosine, sine),
    }
}

#[derive(Clone, Copy)]
enum Corner {
    Start,
    End,
    Top,
}

fn largest(apex: Apex) -> Corner {
    let [start, end, top] = apex.cotangents();
    if top <= start.min(end) {
        Corner::Top
    } else if start <= end {
        Corner::Start
    } else {
        Corner::End
    }
}

/// Turned about the start of the edge until the angle there is the given one.
fn turned(apex: Apex, cosine: f64, sine: f64) -> Apex {
    let radius = apex.distance_from_start();
    // Nearer, the angle at the apex would be larger; farther off, that at the end. Beside an obtuse one neither can.
    let radius = if cosine > 0.0 { within(radius, 2.0 * cosine, 0.5 / cosine) } else { radius };
    Apex { foot: radius * cosine, height: radius * sine }
}

/// Brought up to the circle from which the edge is seen under the given angle.
fn raised(apex: Apex, cosine: f64, sine: f64) -> Apex {
    let nearest = if cosine > 0.0 { 2.0 * cosine * cosine } else { 0.0 };
    let foot = within(apex.foot, nearest, 1.0 - nearest);
    let (half, beside) = (0.5 * cosine / sine, foot * (1.0 - foot));
    // The larger root of height² − 2·half·height − beside, in whichever way nothing cancels.
    let root = (half * half + beside).sqrt();
    Apex { foot, height: if half > 0.0 { root + half } else { beside / (root - half) } }
}
