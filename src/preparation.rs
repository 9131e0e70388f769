//! From the caller's buffers to everything that the stages read: checked, once, and never changed.

use std::time::Instant;

use crate::error::Error;
use crate::features::Features;
use crate::mesh::{Coordinate, Mesh, Stars};
use crate::options::{Constraints, Options};
use crate::star::Operation;
use crate::sweep::Surroundings;
use crate::threads::Threads;

/// The original mesh and what is known of it.
pub(crate) struct Preparation<'a> {
    pub mesh: Mesh<'a>,
    pub stars: Stars,
    pub features: Features,
    operation: Operation,
    /// Seconds that validation and stars took.
    pub adjacency: f64,
    /// Seconds that finding features took.
    pub finding: f64,
}

impl<'a> Preparation<'a> {
    /// Checks options, constraints and buffers.
    pub fn new<T: Coordinate>(
        positions: &[[T; 3]],
        triangles: &'a [[u32; 3]],
        options: &Options,
        constraints: &Constraints<'_>,
        threads: &Threads<'_>,
    ) -> Result<Self, Error> {
        check_constraints(constraints, positions.len())?;
        let clock = Instant::now();
        let mesh = Mesh::new(positions, triangles)?;
        let stars = Stars::new(&mesh, threads)?;
        let adjacency = clock.elapsed().as_secs_f64();
        let features = Features::new(&mesh, &stars, options, constraints, threads)?;
        let finding = clock.elapsed().as_secs_f64() - adjacency;
        Ok(Self { mesh, stars, features, operation: Operation::new(options), adjacency, finding })
    }

    /// The same, in the form in which visits read it.
    pub fn surroundings(&self, options: &Options) -> Surroundings<'_> {
        Surroundings {
            mesh: &self.mesh,
            stars: &self.stars,
            features: &self.features,
            operation: &self.operation,
            floor: options.quality_floor,
            keeps_shape: options.feature_angle.is_some(),
            relaxation: options.relaxation,
            max_deviation: options.max_deviation.map(|bound| bound / self.mesh.unit),
        }
    }
}

fn check_constraints(constraints: &Constraints<'_>, vertex_count: usize) -> Result<(), Error> {
    let found = constraints.locked.len();
    if found != 0 && found != vertex_count {
        return Err(Error::LockLength { found, vertex_count });
    }
    for (edge, ends) in constraints.feature_edges.iter().enumerate() {
        if let Some(&index) = ends.iter().find(|&&v| v as usize >= vertex_count) {
            return Err(Error::FeatureEdgeOutOfRange { edge, index, vertex_count });
        }
    }
    Ok(())
}
