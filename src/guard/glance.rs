//! Steps that the guard admits without a look at the original triangles, which are most of all.

use super::{Leash, Scene, least_shape};
use crate::star::{Arm, Cones, LocalStars, Number, Vectors, Witness};

/// Which of the centres may plainly move by `step`, as bits: [`Guard::admits`](super::Guard::admits) would say the same of them,
/// at greater cost. Of the others it must be asked. Only those in `open` matter.
#[inline(always)]
pub(crate) fn glance<N: Number>(
    token: N::Token,
    scene: &Scene<'_, N>,
    cones: &Cones,
    leash: impl Fn(u32) -> Leash,
    floor: f64,
    (step, open): (Vectors<N>, u64),
) -> u64 {
    let (stars, cones) = (scene.stars, cones.of::<N>(token, &scene.vertices));
    let [planes, place] = squared_leashes::<N>(token, &scene.vertices, leash).map(|square| square * cones.size);
    let (goal, floor) = (stars.drift(token).plus(step), N::splat(token, floor * floor));
    let mut kept = cones.is_near(token, goal, planes.root()) & goal.square().at_most(place);
    kept = kept & cones.lead(token, scene.areas[0]);
    let (mut good, mut countdown) = (kept, stars.countdown(token));
    let mut a = Arm::new(stars.spokes()[0].place(token).minus(step));
    for spoke in &stars.spokes()[1..] {
        let b = Arm::new(spoke.place(token).minus(step));
        let (after, absent) = (Witness::new(a, b), !countdown.next());
        kept = kept & (cones.agree(token, &after) | absent);
        good = good & (after.reaches(token, floor) | absent);
        a = b;
    }
    if open & N::bits(kept & !good) == 0 {
        return N::bits(kept & good);
    }
    N::bits(kept & (good | reach(token, stars, step, least_shape(token, stars, floor))))
}

/// Where no squared shape is below `bar` after a step.
#[inline(always)]
fn reach<N: Number>(token: N::Token, stars: &LocalStars<N>, step: Vectors<N>, bar: N) -> N::Truth {
    let (mut good, mut countdown) = (bar.equals(bar), stars.countdown(token));
    let mut a = Arm::new(stars.spokes()[0].place(token).minus(step));
    for spoke in &stars.spokes()[1..] {
        let b = Arm::new(spoke.place(token).minus(step));
        good = good & (Witness::new(a, b).reaches(token, bar) | !countdown.next());
        a = b;
    }
    good
}

/// How far vertices may go from their original planes and places, squared, in units of their stars' sizes.
#[inline(always)]
fn squared_leashes<N: Number>(token: N::Token, vertices: &N::Vertices, leash: impl Fn(u32) -> Leash) -> [N; 2] {
    let mut squares = [N::Row::default(); 2];
    for (star, &v) in vertices.as_ref().iter().enumerate() {
        let Leash { planes, place } = leash(v);
        squares[0].as_mut()[star] = planes * planes;
        squares[1].as_mut()[star] = place * place;
    }
    squares.map(|row| N::load(token, &row))
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, DVec3};
    use proptest::prelude::*;

    use super::*;
    use crate::guard::{Guard, LARGEST_TURN};
    use crate::mesh::{Mesh, Stars};
    use crate::star::{LocalStar, Site};
    use crate::threads::Threads;

    const FLOOR: f64 = 0.5;

    /// What is said of a step of the centre of a star from where its mesh has brought it.
    #[derive(Debug, PartialEq)]
    struct Said {
        glance: bool,
        guard: bool,
    }

    /// A fan around vertex 0 whose places have gone by `drift` since `origins`, and a step of its centre.
    fn said(origins: &[DVec3], drift: &[DVec3], step: DVec3, leash: Leash) -> Said {
        let count = origins.len() as u32 - 1;
        let triangles: Vec<_> = (0..count).map(|i| [0, 1 + i, 1 + (i + 1) % count]).collect();
        let positions: Vec<_> = origins.iter().map(DVec3::to_array).collect();
        let mesh = Mesh::new(positions.as_slice(), &triangles, &Threads::ONE).unwrap();
        let rings = Stars::new(&mesh, &Threads::ONE).unwrap();
        let cones = Cones::new(&mesh, &rings, LARGEST_TURN, &Threads::ONE).unwrap().unwrap();
        let mut stars = LocalStar::default();
        let site = |vertex: u32| {
            let origin = mesh.positions[vertex as usize];
            Site { vertex, place: origin + drift[vertex as usize] / mesh.unit, origin }
        };
        stars.take((), &rings, site, &[0]);
        let scene = Scene { mesh: &mesh, rings: &rings, stars: &stars, vertices: [0], areas: stars.areas(()) };
        let (step, mut guard) = ((step / mesh.unit).into(), Guard::<f64>::new(FLOOR));
        guard.look((), &scene, |_| leash);
        Said {
            glance: glance((), &scene, &cones, |_| leash, FLOOR, (step, 1)) == 1,
            guard: guard.admits((), &scene, step, 1) == 1,
        }
    }

    const PLANES: Leash = Leash { planes: 0.12, place: f64::INFINITY };

    /// A regular fan of six triangles, pulled out by `height` at its centre.
    fn tent(height: f64) -> Vec<DVec3> {
        let rim =
            (0..6).map(|i| f64::from(i).to_radians() * 60.0).map(|angle| DVec3::new(angle.cos(), angle.sin(), 0.0));
        std::iter::once(DVec3::new(0.0, 0.0, height)).chain(rim).collect()
    }

    #[test]
    fn a_small_step_in_the_plane_is_plainly_admitted() {
        for (height, leash) in [(0.0, PLANES), (0.1, PLANES), (0.4, Leash::NONE)] {
            let found = said(&tent(height), &[DVec3::ZERO; 7], DVec3::new(0.05, 0.02, 0.0), leash);
            assert_eq!(found, Said { glance: true, guard: true }, "{height}");
        }
    }

    #[test]
    fn steps_out_of_bounds_are_not() {
        let refused = Said { glance: false, guard: false };
        let (fan, still) = (tent(0.0), [DVec3::ZERO; 7]);
        assert_eq!(said(&fan, &still, DVec3::Z * 0.2, PLANES), refused, "off the plane");
        assert_eq!(said(&fan, &still, DVec3::X * 0.8, PLANES), refused, "thin");
        assert_eq!(said(&fan, &still, DVec3::X * 1.2, PLANES), refused, "folded");
        assert_eq!(said(&fan, &still, DVec3::Z * 6.0, Leash::NONE), refused, "turned");
    }

    #[test]
    fn the_place_binds() {
        let leash = Leash { place: 0.2, ..PLANES };
        let found = |step: f64| said(&tent(0.0), &[DVec3::ZERO; 7], DVec3::X * step, leash);
        assert_eq!(found(0.19), Said { glance: true, guard: true });
        assert_eq!(found(0.21), Said { glance: false, guard: false });
    }

    #[test]
    fn a_bad_star_may_get_better_and_not_worse() {
        let mut drift = [DVec3::ZERO; 7];
        drift[0] = DVec3::X * 0.7;
        let found = |step: f64| said(&tent(0.0), &drift, DVec3::X * step, PLANES);
        assert_eq!(found(-0.1), Said { glance: true, guard: true });
        assert_eq!(found(0.02), Said { glance: false, guard: false });
    }

    #[test]
    fn where_a_triangle_came_folded_over_the_guard_is_asked() {
        let (mut fan, mut drift) = (tent(0.0), [DVec3::ZERO; 7]);
        let folded = DVec3::new(100_f64.to_radians().cos(), 100_f64.to_radians().sin(), 0.0);
        drift[4] = fan[4] - folded;
        fan[4] = folded;
        assert!(!said(&fan, &drift, DVec3::X * 0.01, PLANES).glance);
    }

    #[test]
    fn of_a_ring_that_has_turned_the_guard_is_asked() {
        let fan = tent(0.0);
        let found = |degrees: f64| {
            let turn = DMat3::from_rotation_x(degrees.to_radians());
            let drift: Vec<_> = fan.iter().map(|&p| turn * p - p).collect();
            said(&fan, &drift, turn * DVec3::X * 0.05, Leash::NONE)
        };
        assert_eq!(found(10.0), Said { glance: true, guard: true });
        assert_eq!(found(50.0), Said { glance: false, guard: true });
    }

    fn vectors(size: f64, count: usize) -> impl Strategy<Value = Vec<DVec3>> {
        prop::collection::vec((-size..size, -size..size, -size..size), count)
            .prop_map(|all| all.into_iter().map(DVec3::from).collect())
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn what_is_plainly_admitted_is_what_the_guard_admits(
            (bumps, drift, height) in (vectors(0.4, 7), vectors(0.2, 7), -0.6..0.6),
            (step, scale, is_leashed) in (vectors(0.3, 1), -100..100, prop::bool::ANY),
        ) {
            let scale = 10_f64.powi(scale);
            let scaled = |all: &[DVec3]| -> Vec<DVec3> { all.iter().map(|&v| v * scale).collect() };
            let origins: Vec<_> = tent(height).iter().zip(&bumps).map(|(&p, &bump)| p + bump).collect();
            let leash = if is_leashed { PLANES } else { Leash::NONE };
            let found = said(&scaled(&origins), &scaled(&drift), step[0] * scale, leash);
            prop_assert!(found.guard || !found.glance);
        }
    }
}
