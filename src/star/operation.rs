//! The operation on a star: where its statistics want the centre.

use glam::{DVec2, DVec3};

use super::local::{LocalStar, double_vector_area};
use super::model::Model;
use super::plane::TangentPlane;
use super::potential;
use crate::options::{Ideal, Options, Plane};

/// The settings of the operation.
pub(crate) struct Modelling {
    model: Model,
    ideal: Ideal,
    plane: Plane,
}

impl Modelling {
    pub fn new(options: &Options) -> Self {
        Self { model: Model::new(options), ideal: options.ideal, plane: options.plane }
    }
}

/// The operation with its working memory, reused from star to star.
pub(crate) struct Operation<'a> {
    modelling: &'a Modelling,
    planes: Vec<TangentPlane>,
    flat: Vec<DVec2>,
    values: Vec<f64>,
    intervals: Vec<u32>,
}

impl<'a> Operation<'a> {
    pub fn new(modelling: &'a Modelling) -> Self {
        Self { modelling, planes: Vec::new(), flat: Vec::new(), values: Vec::new(), intervals: Vec::new() }
    }

    /// From the centre to the mean of the potential centers, each in its sector's own plane; `None` for a star that has
    /// no plane.
    pub fn target(&mut self, star: &LocalStar) -> Option<DVec3> {
        self.flatten(star)?;
        self.sample(star);
        match self.modelling.ideal {
            Ideal::Modelled => self.modelling.model.apply(&mut self.values, &mut self.intervals),
            Ideal::Equilateral => self.values.fill(1.0),
        }
        Some(self.mean_center(star))
    }

    /// Projects each sector into its plane. Sectors lie one behind the other in `flat`.
    fn flatten(&mut self, star: &LocalStar) -> Option<()> {
        self.planes.clear();
        self.flat.clear();
        for sector in star.sectors() {
            let area = double_vector_area(sector);
            let plane = match self.modelling.plane {
                Plane::VectorArea => TangentPlane::orthogonal_to(area)?,
                Plane::LeastSquares => TangentPlane::least_squares(sector, area)?,
            };
            self.flat.extend(sector.iter().map(|&p| plane.project(p)));
            self.planes.push(plane);
        }
        Some(())
    }

    /// Formula (1)'s sample: the edge ratios of the projected triangles.
    fn sample(&mut self, star: &LocalStar) {
        self.values.clear();
        let mut rest = &self.flat[..];
        for sector in star.sectors() {
            let (own, others) = rest.split_at(sector.len());
            self.values.extend(own.windows(2).map(|e| potential::edge_ratio(e[0], e[1])));
            rest = others;
        }
    }

    fn mean_center(&self, star: &LocalStar) -> DVec3 {
        let mut sum = DVec3::ZERO;
        let (mut flat, mut values) = (&self.flat[..], &self.values[..]);
        for (sector, plane) in star.sectors().zip(&self.planes) {
            let (own, others) = flat.split_at(sector.len());
            let (ideal, remaining) = values.split_at(sector.len() - 1);
            let centers = own.windows(2).zip(ideal).map(|(e, &ideal)| potential::center(e[0], e[1], ideal));
            sum += plane.lift(centers.sum());
            (flat, values) = (others, remaining);
        }
        sum / star.valence() as f64
    }
}
