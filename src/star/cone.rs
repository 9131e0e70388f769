//! Cones around the normals of the original triangles of each star: enough to know, most of the time, that none of them is
//! sharply bent against another one, or that a new triangle faces as all of them do.

use std::borrow::Cow;
use std::ops::Range;

use fearless_simd::{Level, Simd, dispatch, f64x8};
use glam::DVec3;

use super::company::{Companions, TOGETHER};
use super::local::{Countdown, LocalStars};
use super::number::{Arithmetic, Number, Single};
use super::vectors::Vectors;
use super::witness::{Arm, CLEAR, LARGEST_TURN, MEANINGLESS, THIN, TINY, Witness};
use crate::error::Error;
use crate::memory;
use crate::mesh::{Mesh, Positions, Stars, widened};
use crate::threads::{PART, Threads};

/// By how much cones are wider than computed, in cosines and sines: more than what single precision does to the angles of
/// triangles that are [`CLEAR`]. The corners of a triangle are off by 2⁻²⁴ of its sides a and b, its normal therefore by at most
/// 8 · 2⁻²⁴ |a| |b|, and |normal| is at least 0.57 |a| |b| times its shape: an angle of 1.7e-4, for each of two triangles.
const MARGIN: f64 = 5e-4;

/// What single precision does to a squared cosine of about 1.
const BLUR: f64 = 4e-6;

/// Squared cosine of the widest cone that is of use: 74°.
const WIDEST: f64 = 0.076;

/// The largest mesh in double precision whose cones are kept beside a copy of its positions: each takes 24 bytes a vertex, and both
/// are too much where memory is short.
const LARGEST: usize = 1 << 24;

/// A cone for each of consecutive vertices; for stars with many triangles or none of use that nothing agrees with.
pub(crate) struct Cones {
    /// The first of these vertices.
    first: u32,
    cones: Vec<Cone>,
    /// One over the mesh's typical edge, as a power of two.
    scale: f64,
}

/// In `f32`, rounded so that nothing is promised that does not hold.
#[derive(Clone, Copy)]
struct Cone {
    /// Of length 1.
    axis: [f32; 3],
    /// Squared cosine of the angle between the axis and a normal that has turned by less than allowed from all normals in the
    /// cone; infinite where there is no such angle.
    turn: f32,
    /// Squared sine of the half angle of the cone around the normals of those triangles that are not thin; its negative if there
    /// is a thin one.
    spread: f32,
    /// Mean squared distance of the ring from the centre, in units of the mesh's typical edge.
    size: f32,
}

/// Cones of several stars.
pub(crate) struct ConesOf<N> {
    axis: Vectors<N>,
    turn: N,
    spread: N,
    /// Mean squared distances of the rings from their centres, in units of the mesh's typical edge.
    pub size: N,
}

/// The same in memory: axis, turn, spread and size.
pub(crate) struct ConeRows<R>([R; 6]);

impl Cones {
    /// Whether the cones of a mesh may be kept.
    pub fn may_be_kept(mesh: &Mesh<'_>) -> bool {
        match &mesh.positions {
            Positions::Single(_) | Positions::Double(Cow::Borrowed(_)) => true,
            Positions::Double(Cow::Owned(all)) => all.len() <= LARGEST,
        }
    }

    /// Whether no triangle around `v` is thin, and no two meet at an angle of which this is the cosine, or more.
    pub fn is_flat(&self, v: u32, cosine: f64) -> bool {
        (0.0..0.5 * (1.0 - cosine)).contains(&f64::from(self.cones[(v - self.first) as usize].spread))
    }

    /// Lengths in units of the mesh's typical edge.
    #[inline(always)]
    pub fn lengths<N: Number>(&self, token: N::Token, vectors: Vectors<N>) -> Vectors<N::Single> {
        vectors.single().times(N::Single::splat(token, self.scale))
    }

    /// Areas in units of that edge's square.
    #[inline(always)]
    pub fn areas<N: Number>(&self, token: N::Token, vectors: Vectors<N>) -> Vectors<N::Single> {
        vectors.single().times(N::Single::splat(token, self.scale * self.scale))
    }

    /// The cones of `vertices`. They are looked up long before they are needed, since they lie far apart.
    #[inline(always)]
    pub fn of<S: Single>(&self, vertices: &[u32]) -> ConeRows<S::Row> {
        let mut rows = [S::Row::default(); 6];
        for (star, &v) in vertices.iter().enumerate() {
            let Cone { axis: [x, y, z], turn, spread, size, .. } = self.cones[(v - self.first) as usize];
            for (row, value) in rows.iter_mut().zip([x, y, z, turn, spread.abs(), size]) {
                row.as_mut()[star] = value;
            }
        }
        ConeRows(rows)
    }
}

impl<R> ConeRows<R> {
    /// From memory.
    #[inline(always)]
    pub fn load<N: Single<Row = R>>(&self, token: N::Token) -> ConesOf<N> {
        let [x, y, z, turn, spread, size] = self.0.each_ref().map(|row| N::load(token, row));
        ConesOf { axis: Vectors { x, y, z }, turn, spread, size }
    }
}

impl Cone {
    const UNKNOWN: Self = Self { axis: [0.0; 3], turn: f32::INFINITY, spread: f32::INFINITY, size: 0.0 };
}

impl<N: Arithmetic> ConesOf<N> {
    /// Where centres that have gone from their original places by `now` are at most `reach` from the planes of all original
    /// triangles that are not thin.
    #[inline(always)]
    pub fn is_near(&self, token: N::Token, now: Vectors<N>, reach: N) -> N::Truth {
        let (zero, along, square) = (N::splat(token, 0.0), now.dot(self.axis), now.square());
        let aside = square * N::splat(token, 1.0 + BLUR) - along * along;
        // For a unit normal n in the cone |n · now| is at most |along| + sine · |aside|.
        let slack = reach - N::choose(along.below(zero), zero - along, along);
        zero.at_most(slack) & (self.spread * aside).at_most(slack * slack)
    }

    /// Where no triangle that [`agree`](Self::agree)s opposes the direction `outward`: the angles of both to the axis are less than
    /// 90° together.
    #[inline(always)]
    pub fn lead(&self, token: N::Token, outward: Vectors<N>) -> N::Truth {
        let along = outward.dot(self.axis);
        let bound = (N::splat(token, 1.0 + MARGIN) - self.turn) * outward.square() + N::splat(token, TINY);
        N::splat(token, 0.0).below(along) & bound.below(along * along)
    }

    /// Where triangles that are [`CLEAR`] have turned by less than allowed from every original one.
    #[inline(always)]
    pub fn agree(&self, token: N::Token, now: &Witness<N>) -> N::Truth {
        let along = now.normal.dot(self.axis);
        let bound = self.turn * now.square + N::splat(token, TINY);
        N::splat(token, 0.0).below(along) & bound.below(along * along)
    }
}

/// One over the typical edge of a mesh, as a power of two: 1 if there is none.
fn scale(mesh: &Mesh<'_>) -> f64 {
    const SAMPLES: usize = 1024;
    let some = mesh.triangles.iter().step_by(mesh.triangles.len() / SAMPLES + 1);
    let (sum, count) = some.fold((0.0, 0.0), |(sum, count), triangle| {
        let [a, b, _] = mesh.corners(triangle);
        (sum + a.distance_squared(b), count + 1.0)
    });
    let edge = (sum / count).sqrt();
    if edge > 0.0 && edge < f64::INFINITY { libm::ldexp(1.0, -libm::ilogb(edge)) } else { 1.0 }
}

/// Finds cones.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ConeFinder {
    /// Cosine and sine of the largest turn.
    turn: [f64; 2],
    /// One over the typical edge.
    scale: f64,
}

impl ConeFinder {
    pub fn new(mesh: &Mesh<'_>) -> Self {
        let turn = [libm::cos, libm::sin].map(|of| of(LARGEST_TURN.to_radians()));
        Self { turn, scale: scale(mesh) }
    }

    /// The cones of all stars.
    pub fn all(&self, mesh: &Mesh<'_>, stars: &Stars, threads: &Threads<'_>) -> Result<Cones, Error> {
        let mut cones = threads.filled(Cone::UNKNOWN, stars.len())?;
        threads.each(cones.chunks_mut(PART).enumerate().collect(), |(part, cones)| {
            dispatch!(Level::new(), simd => self.fill(simd, (mesh, stars), (part * PART) as u32, cones));
        });
        Ok(Cones { first: 0, cones, scale: self.scale })
    }

    /// Those of some consecutive stars.
    pub fn some(&self, mesh: &Mesh<'_>, stars: &Stars, vertices: Range<usize>) -> Result<Cones, Error> {
        let (mut cones, first) = (memory::filled(Cone::UNKNOWN, vertices.len())?, vertices.start as u32);
        dispatch!(Level::new(), simd => self.fill(simd, (mesh, stars), first, &mut cones));
        Ok(Cones { first, cones, scale: self.scale })
    }

    /// Fills in the cones of consecutive vertices.
    #[inline(always)]
    fn fill<S: Simd>(&self, simd: S, (mesh, stars): (&Mesh<'_>, &Stars), first: u32, cones: &mut [Cone]) {
        let (mut local, mut arms) = (LocalStars::<f64x8<S>>::default(), Vec::new());
        let end = first + cones.len() as u32;
        for start in (first..end).step_by(TOGETHER) {
            let vertices = start..end.min(start + TOGETHER as u32);
            for (vertices, count) in Companions::new(vertices, |v| stars.valence(v)).companies() {
                gather(mesh, stars, &mut local, &vertices);
                if arms.len() <= local.longest() {
                    arms.resize(local.longest() + 1, Vectors::zero(simd));
                }
                let arms = &mut arms[..=local.longest()];
                let axis = self.take_arms(simd, &local, arms);
                let rows = self.cones(simd, &local, arms, axis);
                for (star, &v) in vertices[..count].iter().enumerate() {
                    cones[(v - first) as usize] = cone(&rows, star);
                }
            }
        }
    }

    /// Takes up the rims relative to the centres. Returns unit vectors in the middle of the triangles' normals; not a number
    /// where there is none.
    #[inline(always)]
    fn take_arms<N: Number>(
        &self,
        token: N::Token,
        stars: &LocalStars<N>,
        arms: &mut [Vectors<N::Single>],
    ) -> Vectors<N::Single> {
        let (centres, scale) = (stars.centres(token), N::Single::splat(token, self.scale));
        let mut sum = Vectors::zero(token);
        // The first arm is seen beside itself, which spans nothing.
        let mut last = stars.spokes()[0].place(token).minus(centres).single().times(scale);
        for (arm, spoke) in arms.iter_mut().zip(stars.spokes()) {
            *arm = spoke.place(token).minus(centres).single().times(scale);
            sum = sum.plus(last.cross(*arm));
            last = *arm;
        }
        sum.times(N::Single::splat(token, 1.0) / sum.square().root())
    }

    /// The cones of stars with these arms and axes.
    #[inline(always)]
    fn cones<N: Number>(
        &self,
        token: N::Token,
        stars: &LocalStars<N>,
        arms: &[Vectors<N::Single>],
        axis: Vectors<N::Single>,
    ) -> [<N::Single as Single>::Row; 6] {
        let [one, zero] = [1.0, 0.0].map(|value| N::Single::splat(token, value));
        let (mut all, mut kept) = (one, one);
        let (mut known, mut thin, mut size) = (zero.below(axis.square()), one.below(zero), zero);
        let mut countdown = Countdown::new(token, stars.valences(token).single());
        let mut a = Arm::new(arms[0]);
        for &arm in &arms[1..] {
            let (b, present) = (Arm::new(arm), countdown.next());
            let witness = Witness::new(a, b);
            let (says, along) = (witness.exceeds(token, 0.99 * MEANINGLESS), witness.normal.dot(axis));
            let faces = witness.exceeds(token, CLEAR) & zero.below(along);
            known = known & witness.is_measurable(token) & (!says | faces);
            let cosine = along * along / witness.square;
            all = N::Single::choose(says, cosine.lesser(all), all);
            kept = N::Single::choose(witness.exceeds(token, THIN * (1.0 - MARGIN)), cosine.lesser(kept), kept);
            thin = thin | (present & !witness.exceeds(token, THIN * (1.0 + MARGIN)));
            size = size + b.square.only(token, present);
            a = b;
        }
        known = known & N::Single::splat(token, WIDEST).below(all);
        let unknown = N::Single::splat(token, f64::INFINITY);
        let [widest, spread] = [all, kept].map(|squared_cosine| sine(token, squared_cosine));
        let size = size / stars.valences(token).single() * N::Single::splat(token, 1.0 - MARGIN);
        let [turn, spread] = [self.turn(token, all, widest), wider(token, spread)]
            .map(|number| N::Single::choose(known, number, unknown));
        let spread = N::Single::choose(thin, zero - spread, spread);
        [axis.x, axis.y, axis.z, turn, spread, size].map(Single::row)
    }

    /// Squared cosines of the largest turn less the angles of which these are the squared cosines and the sines.
    #[inline(always)]
    fn turn<N: Arithmetic>(&self, token: N::Token, squared_cosine: N, its_sine: N) -> N {
        let [cosine, sine] = self.turn.map(|value| N::splat(token, value));
        wider(token, cosine * squared_cosine.root() + sine * its_sine)
    }
}

/// Looks up where the vertices of stars are in the original mesh.
#[inline(always)]
fn gather<N: Number>(mesh: &Mesh<'_>, stars: &Stars, local: &mut LocalStars<N>, vertices: &N::Vertices) {
    match &mesh.positions {
        Positions::Single(all) => local.gather(stars, |v| widened(all[v as usize]), vertices),
        Positions::Double(all) => local.gather(stars, |v| DVec3::from_array(all[v as usize]), vertices),
    }
}

/// Sines, rounded up, of the angles of which these are the squared cosines.
#[inline(always)]
fn sine<N: Arithmetic>(token: N::Token, squared_cosine: N) -> N {
    let least = N::splat(token, BLUR);
    let square = N::splat(token, 1.0 + BLUR) - squared_cosine;
    N::choose(square.below(least), least, square).root()
}

/// The square of a number a little greater.
#[inline(always)]
fn wider<N: Arithmetic>(token: N::Token, number: N) -> N {
    let number = number + N::splat(token, MARGIN);
    number * number
}

/// The cone of one star, from axis, turn, spread and size of several.
#[inline(always)]
fn cone<R: AsRef<[f32]>>([x, y, z, turn, spread, size]: &[R; 6], star: usize) -> Cone {
    let axis = [x.as_ref()[star], y.as_ref()[star], z.as_ref()[star]];
    Cone { axis, turn: turn.as_ref()[star], spread: spread.as_ref()[star], size: size.as_ref()[star] }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use proptest::prelude::*;

    use super::*;
    use crate::quality::triangle::Sides;

    /// A closed fan around vertex 0.
    fn is_flat(positions: &[DVec3], cosine: f64) -> bool {
        let count = positions.len() as u32;
        let triangles: Vec<_> = (1..count).map(|i| [0, i, i % (count - 1) + 1]).collect();
        let positions: Vec<_> = positions.iter().map(DVec3::to_array).collect();
        let mesh = Mesh::new(positions.as_slice(), &triangles, &Threads::ONE).unwrap();
        let stars = Stars::new(&mesh, &Threads::ONE).unwrap();
        let cones = ConeFinder::new(&mesh).all(&mesh, &stars, &Threads::ONE).unwrap();
        let some = ConeFinder::new(&mesh).some(&mesh, &stars, 0..1).unwrap();
        assert_eq!(cones.is_flat(0, cosine), some.is_flat(0, cosine));
        cones.is_flat(0, cosine)
    }

    fn normals(positions: &[DVec3]) -> Vec<DVec3> {
        let rim = (1..positions.len()).map(|i| [positions[i], positions[i % (positions.len() - 1) + 1]]);
        rim.map(|[a, b]| (a - positions[0]).cross(b - positions[0])).collect()
    }

    fn fan(height: f64) -> Vec<DVec3> {
        let rim = (0..6).map(|i| f64::from(i).to_radians() * 60.0);
        std::iter::once(DVec3::Z * height).chain(rim.map(|a| DVec3::new(a.cos(), a.sin(), 0.0))).collect()
    }

    #[test]
    fn tents_are_flat_up_to_an_angle() {
        let right = 60_f64.to_radians();
        let height = |degrees: f64| right.sin() * degrees.to_radians().tan();
        for slope in [0.0, 5.0, 14.5] {
            assert!(is_flat(&fan(height(slope)), 30_f64.to_radians().cos()), "{slope}");
        }
        assert!(!is_flat(&fan(height(15.5)), 30_f64.to_radians().cos()));
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn what_is_flat_has_no_thin_triangle_and_no_sharp_edge(
            (height, scale, thinness, degrees) in (-0.3..0.3, -100..100, 0.0..1.0_f64, 1.0..60.0_f64),
            bumps in prop::collection::vec((-0.2..0.2, -0.2..0.2, -0.1..0.1), 7),
        ) {
            let thin = DVec3::new(1.0, 10_f64.powf(-thinness), 1.0);
            let positions: Vec<_> = fan(height).iter().zip(bumps).map(|(&p, b)| (p + DVec3::from(b)) * thin).collect();
            let (cosine, normals) = (f64::to_radians(degrees).cos(), normals(&positions));
            let scaled: Vec<_> = positions.iter().map(|&p| p * 10_f64.powi(scale)).collect();
            if is_flat(&scaled, cosine) {
                for (i, n) in normals.iter().enumerate() {
                    let corners = [positions[0], positions[i + 1], positions[(i + 1) % 6 + 1]];
                    prop_assert!(Sides::new(corners).shape() >= THIN);
                    let n = n.normalize();
                    prop_assert!(normals.iter().all(|m| m.normalize().dot(n) >= cosine));
                }
            }
        }
    }
}
