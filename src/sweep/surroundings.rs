//! What visits read: the mesh, its features, and the settings; and what stars wish for themselves.

use glam::DVec3;

use super::places::Places;
use super::slide;
use crate::error::Error;
use crate::features::{Features, Role};
use crate::guard::{Leash, Scene};
use crate::memory;
use crate::mesh::{Mesh, Stars};
use crate::star::{
    ConeFinder, Cones, Draft, LocalStar, LocalStars, Number, Operation, Site, Vectors, set_vector, vector,
};

/// Bounds where the shape of the surface is to be kept.
const ON_SURFACE: Leash = Leash { planes: 0.12, place: f64::INFINITY };

/// Bounds for a vertex that slides along a crease.
const ON_CREASE: Leash = Leash { planes: 0.08, place: f64::INFINITY };

/// Bounds for a vertex that may be a corner after all.
const NEAR_CORNER: Leash = Leash { planes: 0.1, place: 0.2 };

/// Bounds for each role: a table, since visits in company ask for them side by side.
const LEASHES: [Leash; Role::COUNT] = {
    let mut leashes = [ON_SURFACE; Role::COUNT];
    leashes[Role::Crease as usize] = ON_CREASE;
    leashes[Role::Doubtful as usize] = NEAR_CORNER;
    leashes
};

/// All that a visit reads and never changes.
#[derive(Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub mesh: &'a Mesh<'a>,
    pub stars: &'a Stars,
    pub features: &'a Features,
    /// Cones around the original normals, where they are of use.
    pub cones: Option<&'a Cones>,
    /// How to look for cones where they would be of use, but are too many to be kept: then each task does when its turn comes.
    pub cone_finder: Option<ConeFinder>,
    pub operation: &'a Operation,
    /// Mean-ratio shape below which no star's worst triangle may fall.
    pub floor: f64,
    /// Whether the shape of the surface is to be kept beyond what marked edges say.
    pub keeps_shape: bool,
    pub relaxation: f64,
    /// Greatest distance from the original surface.
    pub max_deviation: Option<f64>,
}

impl Surroundings<'_> {
    /// The vertices whose role lets them move, by index.
    pub fn movable(&self) -> Result<Vec<u32>, Error> {
        let moves = |&v: &u32| self.features.role(v).moves();
        let all = 0..self.stars.len() as u32;
        let mut movable = memory::reserved(all.clone().filter(moves).count())?;
        movable.extend(all.filter(moves));
        Ok(movable)
    }

    /// How far a sweep may take a vertex from where it was in the original mesh.
    pub(super) fn leash(&self, v: u32) -> Leash {
        if !self.keeps_shape {
            return Leash::NONE;
        }
        LEASHES[self.features.role(v) as usize]
    }

    /// The same where the shape of the surface is to be kept in any case.
    pub fn close_leash(&self, v: u32) -> Leash {
        LEASHES[self.features.role(v) as usize]
    }

    /// Where a vertex is.
    #[inline(always)]
    pub(super) fn site(&self, places: &Places) -> impl Fn(u32) -> Site {
        |vertex| Site { vertex, place: places.get(vertex), origin: self.mesh.position(vertex) }
    }

    /// What the guard is to look at.
    #[inline(always)]
    pub(super) fn scene<'s, N: Number>(
        &'s self,
        token: N::Token,
        stars: &'s LocalStars<N>,
        vertices: &N::Vertices,
    ) -> Scene<'s, N> {
        Scene { mesh: self.mesh, rings: self.stars, stars, vertices: *vertices, areas: stars.areas(token) }
    }

    /// The steps that the stars want, and which of them want any.
    #[inline(always)]
    pub(super) fn wish<N: Number>(
        &self,
        token: N::Token,
        scene: &Scene<'_, N>,
        draft: &mut Draft<N>,
    ) -> (Vectors<N>, u64) {
        let (target, exist) = self.operation.targets(token, scene.stars, &scene.areas, draft);
        let step = target.times(N::splat(token, self.relaxation));
        if !self.features.role(scene.vertices.as_ref()[0]).moves_in_plane() {
            let (step, slide) = slides(token, scene.stars, step);
            return (step, N::bits(exist) & slide);
        }
        if !self.operation.keeps_volume() {
            return (step, N::bits(exist));
        }
        let (step, neutral) = volume_neutral_steps(token, step, scene.areas[0]);
        (step, N::bits(exist & neutral))
    }
}

/// Steps along features, star by star, and which stars have them.
#[inline(always)]
fn slides<N: Number>(token: N::Token, stars: &LocalStars<N>, step: Vectors<N>) -> (Vectors<N>, u64) {
    let (mut steps, mut exist) = (step.rows(), 0);
    let mut alone = LocalStar::default();
    for star in 0..N::STARS {
        stars.copy_into(star, &mut alone);
        if let Some(along) = slide::along(&alone, vector(&steps, star)) {
            set_vector(&mut steps, star, along);
            exist |= 1 << star;
        }
    }
    (Vectors::load(token, &steps), exist)
}

/// The part of `step` orthogonal to the rings' vector areas, which leaves the volume as it is, and which stars have one.
#[inline(always)]
fn volume_neutral_steps<N: Number>(token: N::Token, step: Vectors<N>, area: Vectors<N>) -> (Vectors<N>, N::Truth) {
    let square = area.square();
    (step.minus(area.times(area.dot(step) / square)), N::splat(token, 0.0).below(square))
}

/// The same for one star.
pub(crate) fn volume_neutral(step: DVec3, area: DVec3) -> Option<DVec3> {
    let (step, exists) = volume_neutral_steps((), Vectors::from(step), area.into());
    exists.then(|| step.into())
}
