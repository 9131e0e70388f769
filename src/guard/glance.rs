//! Steps that the guard admits without a look at the original triangles, which are most of all.

use super::{Leash, Scene};
use crate::star::{Arithmetic, Arm, CLEAR, ConeRows, Cones, Countdown, LocalStars, Number, Single, Vectors, Witness};

/// By how much more than needed a squared shape has to be, for what single precision does to shapes above [`CLEAR`].
const MARGIN: f64 = 3e-3;

/// What has to be known of stars beforehand.
pub(crate) struct Known<S: Single> {
    cones: ConeRows<S::Row>,
    /// How far the centres may go from their original planes and places, squared, in units of their stars' sizes.
    leashes: [S::Row; 2],
}

impl<S: Single> Known<S> {
    /// Looks it up.
    #[inline(always)]
    pub fn of(cones: &Cones, leash: impl Fn(u32) -> Leash, vertices: &[u32]) -> Self {
        let mut leashes = [S::Row::default(); 2];
        for (star, &v) in vertices.iter().enumerate() {
            let Leash { planes, place } = leash(v);
            leashes[0].as_mut()[star] = (planes * planes) as f32;
            leashes[1].as_mut()[star] = (place * place) as f32;
        }
        Self { cones: cones.of::<S>(vertices), leashes }
    }
}

/// Which of the centres may plainly move by `step`, as bits: [`Guard::admits`](super::Guard::admits) would say the same of them,
/// at greater cost. Of the others it must be asked. Only those in `open` matter.
#[inline(always)]
pub(crate) fn glance<N: Number>(
    token: N::Token,
    scene: &Scene<'_, N>,
    (cones, known): (&Cones, &Known<N::Single>),
    floor: f64,
    (step, open): (Vectors<N>, u64),
) -> u64 {
    let (stars, cone) = (scene.stars, known.cones.load::<N::Single>(token));
    let [planes, place] = known.leashes.each_ref().map(|row| N::Single::load(token, row) * cone.size);
    let goal = cones.lengths(token, stars.drift(token).plus(step));
    let mut kept = cone.is_near(token, goal, planes.root()) & goal.square().at_most(place);
    kept = kept & cone.lead(token, cones.areas(token, scene.areas[0]));
    let bar = N::Single::splat(token, bar(floor * floor));
    let (mut good, mut countdown) = (kept, countdown(token, stars));
    let mut a = arm(token, cones, stars.spokes()[0].place(token).minus(step));
    for spoke in &stars.spokes()[1..] {
        let b = arm(token, cones, spoke.place(token).minus(step));
        let (after, absent) = (Witness::new(a, b), !countdown.next());
        kept = kept & (cone.agree(token, &after) | absent);
        good = good & (after.surpasses(token, bar) | absent);
        a = b;
    }
    if open & N::Single::bits(kept & !good) == 0 {
        return N::Single::bits(kept & good);
    }
    let least = least_shape(token, stars, cones, N::Single::splat(token, floor * floor));
    N::Single::bits(kept & (good | reach(token, stars, cones, step, least)))
}

/// What squared shapes have to be above in single precision, so that they are above `square`, and tell where a triangle faces.
fn bar(square: f64) -> f64 {
    f64::max(square, CLEAR * CLEAR) * (1.0 + MARGIN)
}

/// A rim vertex in single precision.
#[inline(always)]
fn arm<N: Number>(token: N::Token, cones: &Cones, end: Vectors<N>) -> Arm<N::Single> {
    Arm::new(cones.lengths(token, end))
}

#[inline(always)]
fn countdown<N: Number>(token: N::Token, stars: &LocalStars<N>) -> Countdown<N::Single> {
    Countdown::new(token, stars.valences(token).single())
}

/// The least squared shapes in stars, or `most` if that is less. Triangles that single precision can't tell don't count.
#[inline(always)]
fn least_shape<N: Number>(token: N::Token, stars: &LocalStars<N>, cones: &Cones, most: N::Single) -> N::Single {
    let (mut least, mut countdown) = (most, countdown(token, stars));
    let mut a = arm(token, cones, stars.spokes()[0].place(token));
    for spoke in &stars.spokes()[1..] {
        let b = arm(token, cones, spoke.place(token));
        let now = Witness::new(a, b);
        let counts = countdown.next() & now.is_measurable(token);
        least = N::Single::choose(counts, now.squared_shape(token).lesser(least), least);
        a = b;
    }
    least
}

/// Where all shapes after a step are plainly better than these squared ones.
#[inline(always)]
fn reach<N: Number>(
    token: N::Token,
    stars: &LocalStars<N>,
    cones: &Cones,
    step: Vectors<N>,
    least: N::Single,
) -> <N::Single as Arithmetic>::Truth {
    let [clear, wide] = [CLEAR * CLEAR, 1.0 + MARGIN].map(|value| N::Single::splat(token, value));
    let bar = N::Single::choose(least.below(clear), clear, least) * wide;
    let (mut good, mut countdown) = (bar.equals(bar), countdown(token, stars));
    let mut a = arm(token, cones, stars.spokes()[0].place(token).minus(step));
    for spoke in &stars.spokes()[1..] {
        let b = arm(token, cones, spoke.place(token).minus(step));
        good = good & (Witness::new(a, b).surpasses(token, bar) | !countdown.next());
        a = b;
    }
    good
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, DVec3};
    use proptest::prelude::*;

    use super::*;
    use crate::guard::Guard;
    use crate::mesh::{Mesh, Stars};
    use crate::star::{ConeFinder, LocalStar, Site};
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
        said_in(origins.to_vec(), (0..count).map(|i| [0, 1 + i, 1 + (i + 1) % count]).collect(), drift, step, leash)
    }

    /// The same in a mesh where almost all other triangles have edges of this length, so that it is the typical one.
    fn said_among(others: f64, origins: &[DVec3], drift: &[DVec3], step: DVec3) -> Said {
        let count = origins.len() as u32;
        let fan = (1..count).map(|i| [0, i, i % (count - 1) + 1]);
        let other = [count, count + 1, count + 2];
        let triangles = std::iter::once(other).chain(fan).chain(std::iter::repeat_n(other, 9000)).collect();
        let corners = [DVec3::ZERO, DVec3::X, DVec3::new(0.5, 0.75_f64.sqrt(), 0.0)].map(|corner| corner * others);
        let drift: Vec<_> = drift.iter().copied().chain([DVec3::ZERO; 3]).collect();
        said_in(origins.iter().copied().chain(corners).collect(), triangles, &drift, step, PLANES)
    }

    fn said_in(origins: Vec<DVec3>, triangles: Vec<[u32; 3]>, drift: &[DVec3], step: DVec3, leash: Leash) -> Said {
        let positions: Vec<_> = origins.iter().map(DVec3::to_array).collect();
        let mesh = Mesh::new(positions.as_slice(), &triangles, &Threads::ONE).unwrap();
        let rings = Stars::new(&mesh, &Threads::ONE).unwrap();
        let cones = ConeFinder::new(&mesh).all(&mesh, &rings, &Threads::ONE).unwrap();
        let mut stars = LocalStar::default();
        let site = |vertex: u32| {
            let origin = mesh.position(vertex);
            Site { vertex, place: origin + drift[vertex as usize] / mesh.unit, origin }
        };
        stars.take((), &rings, site, &[0]);
        let scene = Scene { mesh: &mesh, rings: &rings, stars: &stars, vertices: [0], areas: stars.areas(()) };
        let (step, mut guard) = ((step / mesh.unit).into(), Guard::<f64>::new(FLOOR));
        guard.look((), &scene, |_| leash);
        Said {
            glance: glance((), &scene, (&cones, &Known::of(&cones, |_| leash, &[0])), FLOOR, (step, 1)) == 1,
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

    #[test]
    fn a_star_may_be_larger_or_smaller_than_most() {
        let (fan, still) = (tent(0.1), [DVec3::ZERO; 7]);
        for others in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
            let found = |step: f64| said_among(others, &fan, &still, DVec3::X * step);
            assert_eq!(found(0.05), Said { glance: true, guard: true }, "{others}");
            assert_eq!(found(0.8), Said { glance: false, guard: false }, "{others}");
        }
        for others in [1e-9, 1e9] {
            let found = said_among(others, &fan, &still, DVec3::X * 0.05);
            assert_eq!(found, Said { glance: false, guard: true }, "beyond single precision: {others}");
        }
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
            (step, scale, is_leashed, thinness) in (vectors(0.3, 1), -100..100, prop::bool::ANY, 0.0..4.0_f64),
        ) {
            let scale = 10_f64.powi(scale) * DVec3::new(1.0, 10_f64.powf(-thinness), 1.0);
            let scaled = |all: &[DVec3]| -> Vec<DVec3> { all.iter().map(|&v| v * scale).collect() };
            let origins: Vec<_> = tent(height).iter().zip(&bumps).map(|(&p, &bump)| p + bump).collect();
            let leash = if is_leashed { PLANES } else { Leash::NONE };
            let found = said(&scaled(&origins), &scaled(&drift), step[0] * scale, leash);
            prop_assert!(found.guard || !found.glance);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn that_holds_for_stars_of_any_size(
            (bumps, drift, height) in (vectors(0.4, 7), vectors(0.2, 7), -0.6..0.6),
            (step, others) in (vectors(0.3, 1), -25.0..25.0),
        ) {
            let origins: Vec<_> = tent(height).iter().zip(&bumps).map(|(&p, &bump)| p + bump).collect();
            let found = said_among(10_f64.powf(others), &origins, &drift, step[0]);
            prop_assert!(found.guard || !found.glance);
        }
    }
}
