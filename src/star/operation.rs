//! The operation on a star, step by step: where its statistics want the centre.
//!
//! A step waits long for its divisions and roots. So the steps can be called apart, each for many stars that don't depend on
//! each other, before the next one is: while one star waits, the machine works on the others.

use fearless_simd::prelude::*;
use glam::DVec3;

use super::fan::Fan;
use super::form::{Flat, Form, Points};
use super::lanes::{LANES, Numbers, Vectors};
use super::local::{Chunk, LocalStar};
use super::model::Model;
use super::plane::{self, TangentPlane};
use super::ring;
use super::sizes::{self, Sizes};
use crate::options::{Ideal, Method, Metric, Options, Plane};

/// The operation with its settings.
pub(crate) struct Operation {
    model: Model,
    ideal: Ideal,
    plane: Plane,
    kind: Kind,
    keeps_volume: bool,
    /// Original sizes, if they are to be kept.
    sizes: Option<Sizes>,
}

/// How a star is looked at.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Edge ratios, eight triangles at once.
    EdgeRatio,
    /// Another quality parameter, triangle by triangle.
    Form(Form),
    /// Just its ring.
    Ring,
}

impl Kind {
    fn of(options: &Options) -> Self {
        match (options.method, options.metric) {
            (Method::Laplacian | Method::TangentialLaplacian, _) => Self::Ring,
            (Method::QuasiStatistical, Metric::EdgeRatio) => Self::EdgeRatio,
            (Method::QuasiStatistical, Metric::MinAngle) => Self::Form(Form::MinAngle),
            (Method::QuasiStatistical, Metric::MaxAngle) => Self::Form(Form::MaxAngle),
            (Method::QuasiStatistical, Metric::Area) => Self::Form(Form::Area),
            (Method::QuasiStatistical, Metric::Shape) => Self::Form(Form::Shape),
        }
    }
}

/// What the steps leave to each other. Reused from star to star.
#[derive(Default)]
pub(crate) struct Draft {
    /// Twice the vector areas of the two sectors; the second one is zero where there is none.
    pub areas: [DVec3; 2],
    /// The planes of the two sectors.
    planes: [TangentPlane; 2],
    /// The projected triangles, eight to an entry, as many entries as the largest star so far has had.
    flats: Vec<Flat>,
    /// Their sampled values a, then their modelled values a*.
    values: Vec<[f64; LANES]>,
    /// The projected triangles where they are taken one by one.
    fan: Fan,
    /// √D of formula (1).
    deviation: f64,
}

impl Operation {
    /// The operation for these options; `sizes` are to be kept.
    pub fn new(options: &Options, sizes: Option<Sizes>) -> Self {
        Self {
            model: Model::new(options),
            ideal: options.ideal,
            plane: options.plane,
            kind: Kind::of(options),
            keeps_volume: options.method != Method::Laplacian,
            sizes,
        }
    }

    /// Whether what a free star wants is to be brought into its volume-neutral plane.
    #[inline(always)]
    pub fn keeps_volume(&self) -> bool {
        self.keeps_volume
    }

    /// All steps: from the centre to the mean of the potential centers, each in its sector's own plane; `None` for a star
    /// that has no plane.
    #[inline(always)]
    pub fn target<S: Simd>(&self, simd: S, star: &LocalStar, draft: &mut Draft) -> Option<DVec3> {
        if !self.find_planes(simd, star, draft) {
            return None;
        }
        self.sample(simd, star, draft);
        self.model(simd, star, draft);
        Some(self.shape_wish(simd, star, draft))
    }

    /// First step: the tangent planes. False if the star has none.
    #[inline(always)]
    pub fn find_planes<S: Simd>(&self, simd: S, star: &LocalStar, draft: &mut Draft) -> bool {
        draft.areas = areas(simd, star);
        let Draft { planes: [first, second], areas, .. } = draft;
        self.find_plane(star, 0, star.split, areas[0], first)
            && (!star.is_crease() || self.find_plane(star, star.split, star.valence(), areas[1], second))
    }

    /// Plane of the sector between two rim vertices.
    #[inline(always)]
    fn find_plane(&self, star: &LocalStar, first: usize, last: usize, area: DVec3, plane: &mut TangentPlane) -> bool {
        match self.plane {
            Plane::VectorArea => plane.turn(area),
            Plane::LeastSquares => plane.turn(plane::least_squares((first..=last).map(|i| star.point(i)), area)),
        }
    }

    /// Second step: projects the triangles and takes the statistics of their samples, formula (1).
    #[inline(always)]
    pub fn sample<S: Simd>(&self, simd: S, star: &LocalStar, draft: &mut Draft) {
        let chunks = star.chunks();
        if draft.flats.len() < chunks {
            draft.flats.resize(chunks, Flat::default());
            draft.values.resize(chunks, [0.0; LANES]);
        }
        match self.kind {
            Kind::EdgeRatio => sample_edge_ratios(simd, star, draft),
            Kind::Form(form) => draft.fan.sample(form, star, &draft.planes, &mut draft.values[..chunks]),
            Kind::Ring => return,
        }
        draft.deviation = self.model.deviation(simd, &mut draft.values[..chunks], star.valence());
    }

    /// Third step: models better values, formulas (2) to (4).
    #[inline(always)]
    pub fn model<S: Simd>(&self, simd: S, star: &LocalStar, draft: &mut Draft) {
        if self.kind == Kind::Ring {
            return;
        }
        let values = &mut draft.values[..star.chunks()];
        match self.ideal {
            Ideal::Modelled => self.model.apply(simd, values, star.valence(), draft.deviation),
            Ideal::Equilateral => values.fill([1.0; LANES]),
        }
    }

    /// Last step: from the centre to where the star of `v` wants it.
    #[inline(always)]
    pub fn wish<S: Simd>(&self, simd: S, v: u32, star: &LocalStar, draft: &Draft) -> DVec3 {
        let step = self.shape_wish(simd, star, draft);
        match &self.sizes {
            None => step,
            Some(sizes) => step * (1.0 - sizes::SHARE) + sizes.pull(v, star) * sizes::SHARE,
        }
    }

    /// Where the shapes of the triangles want it.
    #[inline(always)]
    fn shape_wish<S: Simd>(&self, simd: S, star: &LocalStar, draft: &Draft) -> DVec3 {
        match self.kind {
            Kind::EdgeRatio => self.mean_center(simd, star, draft),
            Kind::Form(form) => draft.fan.mean_center(form, star.split, &draft.planes, &draft.values),
            Kind::Ring => ring::mean(star),
        }
    }

    /// The mean of the potential centers for edge ratios.
    #[inline(always)]
    fn mean_center<S: Simd>(&self, simd: S, star: &LocalStar, draft: &Draft) -> DVec3 {
        let (mut first, mut second) = (Points::zero(simd), Points::zero(simd));
        for chunk in 0..star.chunks() {
            let Chunk { present, second: is_second, .. } = star.chunk(simd, chunk);
            let ideal = Numbers::load_array_ref(simd, &draft.values[chunk]);
            let center = draft.flats[chunk].center(simd, ideal).only(simd, present);
            if star.is_crease() {
                first = first.plus(center.only(simd, !is_second));
                second = second.plus(center.only(simd, is_second));
            } else {
                first = first.plus(center);
            }
        }
        let sum = draft.planes[0].lift(first.sum());
        let sum = if star.is_crease() { sum + draft.planes[1].lift(second.sum()) } else { sum };
        sum * (1.0 / star.valence() as f64)
    }
}

/// Projects the triangles and samples their edge ratios.
#[inline(always)]
fn sample_edge_ratios<S: Simd>(simd: S, star: &LocalStar, draft: &mut Draft) {
    for chunk in 0..star.chunks() {
        let [a, b] = project(simd, star, &draft.planes, star.chunk(simd, chunk));
        draft.flats[chunk].take(simd, a, b).store_array(&mut draft.values[chunk]);
    }
}

/// Twice the vector areas of the two sectors.
#[inline(always)]
fn areas<S: Simd>(simd: S, star: &LocalStar) -> [DVec3; 2] {
    let none = Vectors::splat(simd, DVec3::ZERO);
    let (mut first, mut second) = (none, none);
    for chunk in 0..star.chunks() {
        let Chunk { a, b, second: is_second, .. } = star.chunk(simd, chunk);
        let cross = a.cross(b);
        if star.is_crease() {
            first = first.plus(none.or(is_second, cross));
            second = second.plus(cross.or(is_second, none));
        } else {
            first = first.plus(cross);
        }
    }
    [first.sum(), if star.is_crease() { second.sum() } else { DVec3::ZERO }]
}

/// Starts and ends of the rim edges of a chunk, each projected into the plane of its sector.
#[inline(always)]
fn project<S: Simd>(simd: S, star: &LocalStar, planes: &[TangentPlane; 2], chunk: Chunk<S>) -> [Points<S>; 2] {
    let [mut u, mut w] = planes[0].lanes(simd);
    if star.is_crease() {
        let [second_u, second_w] = planes[1].lanes(simd);
        (u, w) = (second_u.or(chunk.second, u), second_w.or(chunk.second, w));
    }
    [Points { x: chunk.a.dot(u), y: chunk.a.dot(w) }, Points { x: chunk.b.dot(u), y: chunk.b.dot(w) }]
}
