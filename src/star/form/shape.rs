//! The mean-ratio shape q. Variable: 1 + √(2/q − 2), that is 1 + d where 1/q = 1 + d²/2.
//!
//! In the half plane over the rim edge, with lengths measured in units of the height at which they lie, d is the distance
//! of the apex from the equilateral triangle's but for terms of third order (1/q is the hyperbolic cosine of that
//! distance). So the variable grows with the first power of an error, as edge ratios and angles do, while 1/q grows with
//! its square.

use super::Apex;

/// Height of the equilateral triangle over an edge of length 1.
const PEAK: f64 = 0.866_025_403_784_438_6;

pub(super) fn sample(apex: Apex) -> f64 {
    let (along, up) = (apex.foot - 0.5, apex.height - PEAK);
    1.0 + ((along * along + up * up) / (PEAK * apex.height)).sqrt()
}

/// The nearest apex with the modelled shape: all of them lie on a circle about a point of the edge's bisector.
pub(super) fn center(apex: Apex, ideal: f64) -> Apex {
    let d = ideal - 1.0;
    // 1/q − 1
    let excess = 0.5 * d * d;
    let middle = PEAK * (1.0 + excess);
    let radius = PEAK * (excess * (2.0 + excess)).sqrt();
    let (along, up) = (apex.foot - 0.5, apex.height - middle);
    let distance = (along * along + up * up).sqrt();
    let share = if distance > 0.0 { radius / distance } else { 0.0 };
    Apex { foot: 0.5 + along * share, height: middle + up * share }
}
