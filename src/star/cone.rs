//! Cones around the normals of the original triangles of each star: enough to know, most of the time, that none of them is
//! sharply bent against another one, or that a new triangle faces as all of them do.

use fearless_simd::{Level, Simd, dispatch, f64x8};
use glam::DVec3;

use super::company::{Companions, LANES, TOGETHER};
use super::local::LocalStars;
use super::number::Number;
use super::vectors::{Vectors, set_vector};
use super::witness::{Arm, MEANINGLESS, THIN, Witness};
use crate::error::Error;
use crate::memory;
use crate::mesh::{Mesh, Stars};
use crate::threads::{PART, Threads};

/// By how much cones are wider than computed: more than what rounding to `f32` does.
const MARGIN: f64 = 1e-6;

/// Squares below this have lost too many digits to be compared.
const TINY: f64 = 1e-140;

/// Squared cosine of the widest cone that is of use: 74°.
const WIDEST: f64 = 0.076;

/// The largest mesh that is worth cones: they take 28 bytes a vertex, which is too much where memory is short.
const LARGEST: usize = 1 << 24;

/// A cone for each vertex; for stars with many triangles or none of use that nothing agrees with.
pub(crate) struct Cones(Vec<Cone>);

/// In `f32`, rounded so that nothing is promised that does not hold.
#[derive(Clone, Copy)]
struct Cone {
    /// Of length 1.
    axis: [f32; 3],
    /// Squared cosine of the angle between the axis and a normal that has turned by less than allowed from all normals in the
    /// cone; infinite where there is no such angle.
    turn: f32,
    /// Squared sine of the half angle of the cone around the normals of those triangles that are not thin.
    spread: f32,
    /// The same around all normals; infinite if a triangle is thin.
    bend: f32,
    /// Mean squared distance of the ring from the centre.
    size: f32,
}

/// Cones of several stars.
pub(crate) struct ConesOf<N> {
    axis: Vectors<N>,
    turn: N,
    spread: N,
    /// Mean squared distances of the rings from their centres.
    pub size: N,
}

impl Cones {
    /// The cones of all stars; `None` for a mesh that is too large. Normals are allowed to turn by `largest_turn` degrees.
    pub fn new(
        mesh: &Mesh<'_>,
        stars: &Stars,
        largest_turn: f64,
        threads: &Threads<'_>,
    ) -> Result<Option<Self>, Error> {
        if stars.len() > LARGEST {
            return Ok(None);
        }
        let mut cones = memory::filled(Cone::UNKNOWN, stars.len())?;
        let look = Look { mesh, stars, turn: [libm::cos, libm::sin].map(|of| of(largest_turn.to_radians())) };
        threads.each(cones.chunks_mut(PART).enumerate().collect(), |(part, cones)| {
            dispatch!(Level::new(), simd => look.fill(simd, (part * PART) as u32, cones));
        });
        Ok(Some(Self(cones)))
    }

    /// Whether no triangle around `v` is thin, and no two meet at an angle of which this is the cosine, or more.
    pub fn is_flat(&self, v: u32, cosine: f64) -> bool {
        f64::from(self.0[v as usize].bend) < 0.5 * (1.0 - cosine)
    }

    /// The cones of `vertices`.
    #[inline(always)]
    pub fn of<N: Number>(&self, token: N::Token, vertices: &N::Vertices) -> ConesOf<N> {
        let mut axis = [N::Row::default(); 3];
        let [mut turn, mut spread, mut size] = [N::Row::default(); 3];
        for (star, &v) in vertices.as_ref().iter().enumerate() {
            let cone = &self.0[v as usize];
            set_vector(&mut axis, star, DVec3::from_array(cone.axis.map(f64::from)));
            turn.as_mut()[star] = f64::from(cone.turn);
            spread.as_mut()[star] = f64::from(cone.spread);
            size.as_mut()[star] = f64::from(cone.size);
        }
        ConesOf {
            axis: Vectors::load(token, &axis),
            turn: N::load(token, &turn),
            spread: N::load(token, &spread),
            size: N::load(token, &size),
        }
    }
}

impl Cone {
    const UNKNOWN: Self =
        Self { axis: [0.0; 3], turn: f32::INFINITY, spread: f32::INFINITY, bend: f32::INFINITY, size: 0.0 };
}

impl<N: Number> ConesOf<N> {
    /// Where centres that have gone from their original places by `now` are at most `reach` from the planes of all original
    /// triangles that are not thin.
    #[inline(always)]
    pub fn is_near(&self, token: N::Token, now: Vectors<N>, reach: N) -> N::Truth {
        let (zero, along) = (N::splat(token, 0.0), now.dot(self.axis));
        let aside = now.square() - along * along;
        // For a unit normal n in the cone |n · now| is at most |along| + sine · |aside|.
        let slack = reach - N::choose(along.below(zero), zero - along, along);
        zero.at_most(slack) & (self.spread * aside).at_most(slack * slack)
    }

    /// Where no triangle that [`agree`](Self::agree)s opposes the direction `outward`: the angles of both to the axis are less than
    /// 90° together.
    #[inline(always)]
    pub fn lead(&self, token: N::Token, outward: Vectors<N>) -> N::Truth {
        let along = outward.dot(self.axis);
        let bound = (N::splat(token, 1.0 + MARGIN) - self.turn) * outward.square();
        N::splat(token, 0.0).below(along) & bound.below(along * along)
    }

    /// Where triangles have turned by less than allowed from every original one.
    #[inline(always)]
    pub fn agree(&self, token: N::Token, now: &Witness<N>) -> N::Truth {
        let along = now.normal.dot(self.axis);
        let bound = self.turn * now.square + N::splat(token, TINY * TINY);
        N::splat(token, 0.0).below(along) & bound.below(along * along)
    }
}

/// Looks at the original stars.
struct Look<'a> {
    mesh: &'a Mesh<'a>,
    stars: &'a Stars,
    /// Cosine and sine of the largest turn.
    turn: [f64; 2],
}

impl Look<'_> {
    /// Fills in the cones of consecutive vertices.
    #[inline(always)]
    fn fill<S: Simd>(&self, simd: S, first: u32, cones: &mut [Cone]) {
        let (mut local, all) = (LocalStars::<f64x8<S>>::default(), &self.mesh.positions[..]);
        let end = first + cones.len() as u32;
        for start in (first..end).step_by(TOGETHER) {
            let vertices = start..end.min(start + TOGETHER as u32);
            for (vertices, count) in Companions::new(vertices, |v| self.stars.valence(v)).companies() {
                let place = |v: u32| all[v as usize];
                local.take_places(simd, self.stars, place, place, &vertices);
                let found = self.cones(simd, &local);
                for (star, &v) in vertices[..count].iter().enumerate() {
                    cones[(v - first) as usize] = found[star];
                }
            }
        }
    }

    /// The cones of stars that lie as in the original mesh.
    #[inline(always)]
    fn cones<N: Number>(&self, token: N::Token, stars: &LocalStars<N>) -> [Cone; LANES] {
        let [one, zero] = [1.0, 0.0].map(|value| N::splat(token, value));
        let axis = axis(token, stars);
        let (mut all, mut kept) = (Least::new(one), Least::new(one));
        let (mut known, mut thin, mut size) = (zero.below(axis.square()), one.below(zero), zero);
        let mut countdown = stars.countdown(token);
        let mut a = Arm::new(stars.spokes()[0].place(token));
        for spoke in &stars.spokes()[1..] {
            let (b, present) = (Arm::new(spoke.place(token)), countdown.next());
            let witness = Witness::new(a, b);
            let (says, along) = (witness.exceeds(token, MEANINGLESS), witness.normal.dot(axis));
            known = known & (!says | (N::splat(token, TINY).below(witness.square) & zero.below(along)));
            all.take(along * along, witness.square, says);
            kept.take(along * along, witness.square, witness.exceeds(token, THIN));
            thin = thin | (present & !witness.exceeds(token, THIN * (1.0 + MARGIN)));
            size = size + b.square.only(token, present);
            a = b;
        }
        let (all, kept) = (all.ratio(one), kept.ratio(one));
        known = known & N::splat(token, WIDEST).below(all);
        let unknown = N::splat(token, f64::INFINITY);
        let bend = N::choose(thin, unknown, wider(token, (one - all).root()));
        rows(
            axis,
            N::choose(known, self.turn(token, all), unknown),
            N::choose(known, wider(token, (one - kept).root()), unknown),
            N::choose(known, bend, unknown),
            size / stars.valences(token) * N::splat(token, 1.0 - MARGIN),
        )
    }

    /// Squared cosines of the largest turn less the angles of which these are the squared cosines.
    #[inline(always)]
    fn turn<N: Number>(&self, token: N::Token, squared_cosine: N) -> N {
        let [cosine, sine] = self.turn.map(|value| N::splat(token, value));
        let own_sine = (N::splat(token, 1.0) - squared_cosine).root();
        wider(token, cosine * squared_cosine.root() + sine * own_sine)
    }
}

/// Unit vectors in the middle of the normals; not a number where there is none.
#[inline(always)]
fn axis<N: Number>(token: N::Token, stars: &LocalStars<N>) -> Vectors<N> {
    let [sum, _] = stars.areas(token);
    sum.times(N::splat(token, 1.0) / sum.square().root())
}

/// The square of a number a little greater.
#[inline(always)]
fn wider<N: Number>(token: N::Token, number: N) -> N {
    let number = number + N::splat(token, MARGIN);
    number * number
}

/// Cones, star by star.
#[inline(always)]
fn rows<N: Number>(axis: Vectors<N>, turn: N, spread: N, bend: N, size: N) -> [Cone; LANES] {
    let ([x, y, z], turn, spread, bend, size) = (axis.rows(), turn.row(), spread.row(), bend.row(), size.row());
    let mut cones = [Cone::UNKNOWN; LANES];
    for (star, cone) in cones.iter_mut().enumerate().take(N::STARS) {
        let [x, y, z, turn, spread, bend, size] =
            [&x, &y, &z, &turn, &spread, &bend, &size].map(|row| row.as_ref()[star] as f32);
        // What is subnormal has too few digits.
        let size = if size < f32::MIN_POSITIVE { 0.0 } else { size };
        *cone = Cone { axis: [x, y, z], turn, spread, bend, size };
    }
    cones
}

/// The least of several quotients, found without dividing.
struct Least<N> {
    above: N,
    below: N,
}

impl<N: Number> Least<N> {
    #[inline(always)]
    fn new(one: N) -> Self {
        Self { above: one, below: one }
    }

    /// Takes a quotient into account where it `counts`.
    #[inline(always)]
    fn take(&mut self, above: N, below: N, counts: N::Truth) {
        let is_less = counts & (above * self.below).below(self.above * below);
        self.above = N::choose(is_less, above, self.above);
        self.below = N::choose(is_less, below, self.below);
    }

    #[inline(always)]
    fn ratio(self, one: N) -> N {
        (self.above / self.below).lesser(one)
    }
}
