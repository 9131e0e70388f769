//! The operation on stars, step by step: where their statistics want the centres.

use glam::DVec3;

use super::fan::Fan;
use super::form::Form;
use super::forms::{Apart, ByInterval, Forms};
use super::local::{LocalStar, LocalStars};
use super::model::Model;
use super::number::Number;
use super::plane::{self, TangentPlanes};
use super::ring;
use super::sample::Sample;
use super::sizes::{self, Sizes};
use super::vectors::{Points, Vectors, set_vector, vector};
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
#[derive(Clone, Copy)]
enum Kind {
    /// Edge ratios, in all stars at once.
    EdgeRatio,
    /// Another quality parameter, star by star.
    Form(Form),
    /// Just its ring, star by star.
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

/// Working memory of the operation.
pub(crate) struct Draft<N: Number> {
    /// As many triangles as the largest star so far has had.
    samples: Vec<Sample<N>>,
    forms: ByInterval<N>,
    /// For what is done star by star.
    alone: LocalStar,
    fan: Fan,
}

impl<N: Number> Default for Draft<N> {
    fn default() -> Self {
        Self { samples: Vec::new(), forms: ByInterval::default(), alone: LocalStar::default(), fan: Fan::default() }
    }
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

    /// Whether it looks at nothing but places and numbers of triangles.
    #[inline(always)]
    pub fn sees_places_only(&self) -> bool {
        matches!(self.kind, Kind::EdgeRatio) && self.sizes.is_none()
    }

    /// From the centre of a star to where its shapes want it; `None` for a star that has no plane.
    pub fn target(&self, star: &LocalStar, draft: &mut Draft<f64>) -> Option<DVec3> {
        let (target, exists) = self.shape_targets((), star, &star.areas(()), draft);
        exists.then(|| target.into())
    }

    /// From the centres to where the stars want them, and which stars have a plane, and so a wish, at all. `areas` are those of
    /// [`LocalStars::areas`].
    #[inline(always)]
    pub fn targets<N: Number>(
        &self,
        token: N::Token,
        stars: &LocalStars<N>,
        areas: &[Vectors<N>; 2],
        draft: &mut Draft<N>,
    ) -> (Vectors<N>, N::Truth) {
        let (targets, exist) = self.shape_targets(token, stars, areas, draft);
        let Some(sizes) = &self.sizes else {
            return (targets, exist);
        };
        let mut rows = targets.rows();
        for star in 0..N::STARS {
            stars.copy_into(star, &mut draft.alone);
            let target = vector(&rows, star) * (1.0 - sizes::SHARE) + sizes.pull(&draft.alone) * sizes::SHARE;
            set_vector(&mut rows, star, target);
        }
        (Vectors::load(token, &rows), exist)
    }

    /// Where the shapes of their triangles want the stars.
    #[inline(always)]
    fn shape_targets<N: Number>(
        &self,
        token: N::Token,
        stars: &LocalStars<N>,
        areas: &[Vectors<N>; 2],
        draft: &mut Draft<N>,
    ) -> (Vectors<N>, N::Truth) {
        let (planes, exist) = self.planes(token, stars, areas);
        if matches!(self.kind, Kind::EdgeRatio) {
            return (self.mean_centers(token, stars, &planes, draft), exist);
        }
        let mut rows = [N::Row::default(); 3];
        for star in 0..N::STARS {
            stars.copy_into(star, &mut draft.alone);
            set_vector(&mut rows, star, self.target_alone(&draft.alone, &mut draft.fan));
        }
        (Vectors::load(token, &rows), exist)
    }

    /// Where the shapes want one star, or its ring.
    fn target_alone(&self, star: &LocalStar, fan: &mut Fan) -> DVec3 {
        let Kind::Form(form) = self.kind else {
            return ring::mean(star);
        };
        let model = (self.ideal == Ideal::Modelled).then_some(&self.model);
        match self.planes((), star, &star.areas(())) {
            (planes, true) => fan.target(form, model, star, &planes),
            _ => DVec3::ZERO,
        }
    }

    /// The means of the potential centers for edge ratios, each in its sector's own plane.
    #[inline(always)]
    fn mean_centers<N: Number>(
        &self,
        token: N::Token,
        stars: &LocalStars<N>,
        planes: &[TangentPlanes<N>; 2],
        Draft { samples, forms, .. }: &mut Draft<N>,
    ) -> Vectors<N> {
        let valences = stars.valences(token);
        if samples.len() < stars.longest() {
            samples.resize_with(stars.longest(), Sample::default);
        }
        let samples = &mut samples[..stars.longest()];
        let total = self.sample(token, stars, planes, samples);
        let deviation = match self.ideal {
            Ideal::Modelled => self.model.deviation(token, samples, total, valences),
            Ideal::Equilateral => N::splat(token, 0.0),
        };
        if self.model.suits(samples.len()) {
            forms.find(token, &self.model, samples, valences, deviation);
            return mean_center(token, stars, planes, samples, forms);
        }
        self.model.rank(token, samples, valences);
        mean_center(token, stars, planes, samples, &Apart { deviation })
    }

    /// The planes of the sectors, and which stars have them.
    #[inline(always)]
    fn planes<N: Number>(
        &self,
        token: N::Token,
        stars: &LocalStars<N>,
        areas: &[Vectors<N>; 2],
    ) -> ([TangentPlanes<N>; 2], N::Truth) {
        let normals = match self.plane {
            Plane::VectorArea => *areas,
            Plane::LeastSquares => least_squares(token, stars, areas),
        };
        let (first, exists) = TangentPlanes::new(token, normals[0]);
        if !stars.is_crease() {
            return ([first; 2], exists);
        }
        let (second, exists_too) = TangentPlanes::new(token, normals[1]);
        ([first, second], exists & exists_too)
    }

    /// Projects the triangles and samples their edge ratios. Returns the sums of the samples.
    #[inline(always)]
    fn sample<N: Number>(
        &self,
        token: N::Token,
        stars: &LocalStars<N>,
        planes: &[TangentPlanes<N>; 2],
        samples: &mut [Sample<N>],
    ) -> N {
        let (mut countdown, mut total) = (stars.countdown(token), N::splat(token, 0.0));
        let mut a = planes[0].flatten(stars.spokes()[0].place(token));
        let mut x = a.square();
        for (i, (sample, spokes)) in samples.iter_mut().zip(stars.spokes().windows(2)).enumerate() {
            let plane = &planes[stars.sector(i)];
            if stars.is_crease() && i == stars.split() {
                a = plane.flatten(spokes[0].place(token));
                x = a.square();
            }
            let b = plane.flatten(spokes[1].place(token));
            let y = b.square();
            let present = countdown.next();
            let value = self.model.bounded(token, sample.flat.take(token, [a, b], [x, y]));
            value.store(&mut sample.value);
            self.model.interval(token, value, present).store(&mut sample.interval);
            total = total + value.only(token, present);
            (a, x) = (b, y);
        }
        total
    }
}

/// From the centres to the means of the potential centers for the modelled values, formula (4).
#[inline(always)]
fn mean_center<N: Number>(
    token: N::Token,
    stars: &LocalStars<N>,
    planes: &[TangentPlanes<N>; 2],
    samples: &[Sample<N>],
    forms: &impl Forms<N>,
) -> Vectors<N> {
    let (mut countdown, one) = (stars.countdown(token), N::splat(token, 1.0));
    let mut sums = [Points::<N>::zero(token); 2];
    for (i, sample) in samples.iter().enumerate() {
        let center = sample.flat.center(token, forms.of(token, sample)).only(token, countdown.next());
        let sum = &mut sums[stars.sector(i)];
        *sum = sum.plus(center);
    }
    let sum = planes[0].raise(sums[0]);
    let sum = if stars.is_crease() { sum.plus(planes[1].raise(sums[1])) } else { sum };
    sum.times(one / stars.valences(token))
}

/// Normals of the least-squares planes of the sectors, star by star.
#[inline(always)]
fn least_squares<N: Number>(token: N::Token, stars: &LocalStars<N>, areas: &[Vectors<N>; 2]) -> [Vectors<N>; 2] {
    let mut alone = LocalStar::default();
    let mut normals = [areas[0].rows(), areas[1].rows()];
    for star in 0..N::STARS {
        stars.copy_into(star, &mut alone);
        for (sector, normal) in alone.sectors().zip(&mut normals) {
            set_vector(normal, star, plane::least_squares(sector, vector(normal, star)));
        }
    }
    [Vectors::load(token, &normals[0]), Vectors::load(token, &normals[1])]
}
