//! The operation on a star for the quality parameters whose forms are made one by one.

use glam::{DVec2, DVec3};

use super::form::{Apex, Form};
use super::lanes::LANES;
use super::local::LocalStar;
use super::plane::TangentPlane;

/// The projected triangles of a star. Reused from star to star.
#[derive(Default)]
pub(super) struct Fan(Vec<Triangle>);

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
    /// Takes up a star and writes its samples into `values`.
    pub fn sample(&mut self, form: Form, star: &LocalStar, planes: &[TangentPlane; 2], values: &mut [[f64; LANES]]) {
        self.0.clear();
        for i in 0..star.valence() {
            let plane = &planes[usize::from(i >= star.split)];
            self.0.push(Triangle::new(plane.project(star.point(i)), plane.project(star.point(i + 1))));
        }
        let total: f64 = self.0.iter().map(|t| t.start.perp_dot(t.edge)).sum();
        let mean = total / star.valence() as f64;
        for (triangle, value) in self.0.iter_mut().zip(values.as_flattened_mut()) {
            triangle.fair = mean / triangle.edge.length_squared();
            triangle.sample = form.sample(triangle.apex, triangle.fair);
            *value = triangle.sample;
        }
    }

    /// From the centre to the weighted mean of the potential centers of those triangles that are worse than modelled. The
    /// others have what they are asked for, so they have no say.
    pub fn mean_center(&self, form: Form, split: usize, planes: &[TangentPlane; 2], ideals: &[[f64; LANES]]) -> DVec3 {
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        for (i, (triangle, &ideal)) in self.0.iter().zip(ideals.as_flattened()).enumerate() {
            let length = triangle.edge.length();
            if length > 0.0 && triangle.sample > ideal {
                let center = triangle.place(form.center(triangle.apex, triangle.fair, ideal));
                let weight = form.weight(triangle.apex, length);
                sum += planes[usize::from(i >= split)].lift(center) * weight;
                weights += weight;
            }
        }
        if weights > 0.0 { sum * (form.reach() / weights) } else { DVec3::ZERO }
    }
}
