//! The operation on a star for the quality parameters whose forms are made one by one.

use glam::{DVec2, DVec3};

use super::form::{Apex, Form};
use super::local::LocalStar;
use super::model::Model;
use super::plane::TangentPlane;
use super::sample::Sample;

/// The projected triangles of a star, and what the model makes of them. Reused from star to star.
#[derive(Default)]
pub(super) struct Fan {
    triangles: Vec<Triangle>,
    samples: Vec<Sample<f64>>,
}

/// A triangle in the plane of its sector, with the apex at the origin.
struct Triangle {
    /// Start of the rim edge.
    start: DVec2,
    /// From the start to the end.
    edge: DVec2,
    apex: Apex,
    /// Height in units of the edge at which the triangle would have the mean area of the star.
    fair: f64,
    sample: f64,
}

impl Triangle {
    fn new(start: DVec2, end: DVec2) -> Self {
        let edge = end - start;
        let scale = 1.0 / edge.length_squared();
        let apex = Apex { foot: -start.dot(edge) * scale, height: start.perp_dot(edge) * scale };
        Self { start, edge, apex, fair: 0.0, sample: 0.0 }
    }

    /// Where `apex` lies in the plane.
    fn place(&self, apex: Apex) -> DVec2 {
        self.start + self.edge * apex.foot + self.edge.perp() * apex.height
    }
}

impl Fan {
    /// From the centre to the weighted mean of the potential centers of those triangles that are worse than modelled; without
    /// a `model` those that are not ideal. The others have what they are asked for, so they have no say.
    pub fn target(&mut self, form: Form, model: Option<&Model>, star: &LocalStar, planes: &[TangentPlane; 2]) -> DVec3 {
        self.project(form, star, planes);
        let deviation = model.map_or(0.0, |model| self.model(model));
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        for (i, (triangle, sample)) in self.triangles.iter().zip(&self.samples).enumerate() {
            let (length, ideal) = (triangle.edge.length(), 1.0 + sample.rank[0] * deviation);
            if length > 0.0 && triangle.sample > ideal {
                let center = triangle.place(form.center(triangle.apex, triangle.fair, ideal));
                let weight = form.weight(triangle.apex, length);
                sum += planes[star.sector(i)].lift(center) * weight;
                weights += weight;
            }
        }
        if weights > 0.0 { sum * (form.reach() / weights) } else { DVec3::ZERO }
    }

    /// Takes up a star and samples its triangles.
    fn project(&mut self, form: Form, star: &LocalStar, planes: &[TangentPlane; 2]) {
        let triangle = |i: usize| {
            let plane = &planes[star.sector(i)];
            Triangle::new(plane.project(star.point(i)), plane.project(star.point(i + 1)))
        };
        self.triangles.clear();
        self.triangles.extend((0..star.valence()).map(triangle));
        let total: f64 = self.triangles.iter().map(|t| t.start.perp_dot(t.edge)).sum();
        let mean = total / star.valence() as f64;
        for triangle in &mut self.triangles {
            triangle.fair = mean / triangle.edge.length_squared();
            triangle.sample = form.sample(triangle.apex, triangle.fair);
        }
        self.samples.resize_with(star.valence(), Sample::default);
    }

    /// Ranks the samples, formulas (2) and (3). Returns √D of formula (1).
    fn model(&mut self, model: &Model) -> f64 {
        let (valence, mut total) = (self.samples.len() as f64, 0.0);
        for (triangle, sample) in self.triangles.iter().zip(&mut self.samples) {
            let value = model.bounded((), triangle.sample);
            (sample.value, sample.interval) = ([value], [model.interval((), value, true)]);
            total += value;
        }
        model.rank((), &mut self.samples, valence);
        model.deviation((), &self.samples, total, valence)
    }
}
