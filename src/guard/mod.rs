//! The guard: which moves are allowed. No star's worst triangle gets worse below the floor, none folds over, and none
//! leaves the original surface where that has a shape to keep.

mod glance;
mod original;

use crate::mesh::{Mesh, Stars};
use crate::star::{Arm, LARGEST_TURN, LocalStars, Number, Vectors, Witness};
pub(crate) use glance::{Known, glance};
use original::Original;

/// How far a vertex may go from where it was in the original mesh, in units of its star's original size.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Leash {
    /// From the planes of its original triangles.
    pub planes: f64,
    /// From its original place.
    pub place: f64,
}

impl Leash {
    /// No bound at all.
    pub const NONE: Self = Self { planes: f64::INFINITY, place: f64::INFINITY };
}

/// What is to be looked at: stars as they are, and the mesh as it was.
pub(crate) struct Scene<'a, N: Number> {
    pub mesh: &'a Mesh<'a>,
    pub rings: &'a Stars,
    pub stars: &'a LocalStars<N>,
    /// Numbers of the vertices in the centres.
    pub vertices: N::Vertices,
    /// Twice the vector areas of the sectors.
    pub areas: [Vectors<N>; 2],
}

/// The guard and what it has found out about stars. Reused from stars to stars.
pub(crate) struct Guard<N: Number> {
    /// Squared shape that the worst triangle of a star may not fall below.
    floor: f64,
    /// Squared cosine of the largest turn.
    least_cosine: f64,
    original: Original<N>,
    /// Squared distances in the units of the coordinates.
    planes: N::Row,
    place: N::Row,
    /// Whether any star is bound to its original planes.
    is_leashed: bool,
    /// The least squared shapes that a triangle must have after the move, if somebody had to ask.
    bar: Option<N::Row>,
}

impl<N: Number> Guard<N> {
    /// A guard with this quality floor (mean-ratio shape, 0 to 1).
    pub fn new(floor: f64) -> Self {
        let cosine = libm::cos(LARGEST_TURN.to_radians());
        let row = N::Row::default();
        Self {
            floor: floor * floor,
            least_cosine: cosine * cosine,
            original: Original::default(),
            planes: row,
            place: row,
            is_leashed: false,
            bar: None,
        }
    }

    /// Looks at stars as they were in the original mesh; `leash` tells how far a vertex may go.
    #[inline(always)]
    pub fn look(&mut self, token: N::Token, scene: &Scene<'_, N>, leash: impl Fn(u32) -> Leash) {
        self.bar = None;
        self.is_leashed = false;
        for star in 0..N::STARS {
            let leash = leash(scene.vertices.as_ref()[star]);
            self.planes.as_mut()[star] = leash.planes * leash.planes;
            self.place.as_mut()[star] = leash.place * leash.place;
            self.is_leashed |= leash.planes < f64::INFINITY;
        }
        let squares = self.original.look(token, scene.stars);
        let size = squares / scene.stars.valences(token);
        (N::load(token, &self.planes) * size).store(&mut self.planes);
        (N::load(token, &self.place) * size).store(&mut self.place);
    }

    /// Which of the centres may move by `step`, as bits; only those in `open` matter.
    ///
    /// Most steps leave no triangle below the floor and meet no triangle that came folded over; only for the others does it
    /// matter how good the star is now, and which of its triangles were folded.
    #[inline(always)]
    pub fn admits(&mut self, token: N::Token, scene: &Scene<'_, N>, step: Vectors<N>, open: u64) -> u64 {
        let goal = scene.stars.drift(token).plus(step);
        let near = !N::load(token, &self.place).below(goal.square());
        let kept = N::bits(near & self.keeps_all(token, scene, step, N::splat(token, self.floor)));
        let asking = open & N::bits(near) & !kept;
        if asking == 0 {
            return kept;
        }
        let mut changed = 0;
        for star in (0..N::STARS).filter(|star| asking >> star & 1 == 1) {
            changed |= u64::from(self.original.forget_folded(scene, star)) << star;
        }
        let bar = self.bar(token, scene);
        changed |= N::bits(bar.below(N::splat(token, self.floor)));
        if asking & changed == 0 {
            return kept;
        }
        N::bits(near & self.keeps_all(token, scene, step, bar))
    }

    /// The least squared shapes in the stars, or the floor if that is less.
    #[inline(always)]
    fn bar(&mut self, token: N::Token, scene: &Scene<'_, N>) -> N {
        if let Some(bar) = &self.bar {
            return N::load(token, bar);
        }
        let bar = least_shape(token, scene.stars, N::splat(token, self.floor));
        self.bar = Some(bar.row());
        bar
    }

    /// Where the step keeps the promises if no squared shape may be below `bar`.
    #[inline(always)]
    fn keeps_all(&self, token: N::Token, scene: &Scene<'_, N>, step: Vectors<N>, bar: N) -> N::Truth {
        let (stars, mut countdown) = (scene.stars, scene.stars.countdown(token));
        let before = stars.drift(token);
        let (now, reach) = (before.plus(step), N::load(token, &self.planes));
        let mut kept = bar.equals(bar);
        let mut a = Arm::new(stars.spokes()[0].place(token).minus(step));
        for (i, (triangle, spokes)) in self.original.triangles().iter().zip(stars.spokes().windows(2)).enumerate() {
            let b = Arm::new(spokes[1].place(token).minus(step));
            let (original, after) = (triangle.facing(token), Witness::new(a, b));
            let mut keeps = after.reaches(token, bar) & original.agrees(token, &after, self.least_cosine);
            if self.is_leashed {
                keeps = keeps & original.is_near(token, before, now, reach);
            }
            let outward = scene.areas[stars.sector(i)];
            let opposes = after.opposes(token, outward);
            if N::any(opposes & keeps) {
                let [a, b] = [spokes[0].place(token), spokes[1].place(token)];
                keeps = keeps & after.unfolds(token, &Witness::new(Arm::new(a), Arm::new(b)), outward);
            }
            kept = kept & (keeps | !countdown.next());
            // Of a star alone one triangle says enough.
            if N::STARS == 1 && !N::any(kept) {
                break;
            }
            a = b;
        }
        kept
    }
}

/// The least squared shapes in stars, or `most` if that is less.
#[inline(always)]
fn least_shape<N: Number>(token: N::Token, stars: &LocalStars<N>, most: N) -> N {
    let (mut least, mut countdown) = (most, stars.countdown(token));
    let mut a = Arm::new(stars.spokes()[0].place(token));
    for spoke in &stars.spokes()[1..] {
        let b = Arm::new(spoke.place(token));
        let shape = Witness::new(a, b).squared_shape(token);
        least = N::choose(countdown.next(), shape.lesser(least), least);
        a = b;
    }
    least
}
