//! Steps that the guard admits without a look at the original triangles, which are most of all.

use super::{Leash, Scene};
use crate::star::{Arm, Cones, Number, Vectors, Witness};

/// Which of the centres may plainly move by `step`, as bits: [`Guard::admits`](super::Guard::admits) would say the same of them,
/// at greater cost. Of the others it must be asked.
#[inline(always)]
pub(crate) fn glance<N: Number>(
    token: N::Token,
    scene: &Scene<'_, N>,
    cones: &Cones,
    leash: impl Fn(u32) -> Leash,
    floor: f64,
    step: Vectors<N>,
) -> u64 {
    let (stars, cones) = (scene.stars, cones.of::<N>(token, &scene.vertices));
    let reach = (squared_leashes::<N>(token, &scene.vertices, leash) * cones.size).root();
    let (floor, mut countdown) = (N::splat(token, floor * floor), stars.countdown(token));
    let mut kept = cones.is_near(token, stars.drift(token).plus(step), reach);
    let mut a = Arm::new(stars.spokes()[0].place(token).minus(step));
    for spoke in &stars.spokes()[1..] {
        let b = Arm::new(spoke.place(token).minus(step));
        let after = Witness::new(a, b);
        let keeps = after.reaches(token, floor) & cones.agree(token, &after);
        kept = kept & ((keeps & !after.opposes(token, scene.areas[0])) | !countdown.next());
        a = b;
    }
    N::bits(kept)
}

/// How far vertices may go from their original planes, squared, in units of their stars' sizes; not a number where more than
/// the planes binds one.
#[inline(always)]
fn squared_leashes<N: Number>(token: N::Token, vertices: &N::Vertices, leash: impl Fn(u32) -> Leash) -> N {
    let mut squares = N::Row::default();
    for (square, &v) in squares.as_mut().iter_mut().zip(vertices.as_ref()) {
        let Leash { planes, place } = leash(v);
        *square = if place < f64::INFINITY { f64::NAN } else { planes * planes };
    }
    N::load(token, &squares)
}
