//! From the caller's buffers to everything that the stages read: checked, once, and never changed.

use std::time::Instant;

use crate::error::Error;
use crate::features::Features;
use crate::mesh::{Coordinate, Mesh, Stars, Vertices};
use crate::options::{Constraints, Options, Order};
use crate::star::{ConeFinder, Cones, Operation, Sizes};
use crate::sweep::Surroundings;
use crate::threads::Threads;

/// The original mesh and what is known of it.
pub(crate) struct Preparation<'a> {
    pub mesh: Mesh<'a>,
    pub stars: Stars,
    pub features: Features,
    /// Cones around the original normals, where they are of use and not too many.
    cones: Option<Cones>,
    /// How sweeps are to look for cones themselves, if they are.
    cone_finder: Option<ConeFinder>,
    operation: Operation,
    /// Seconds that validation and stars took.
    pub adjacency: f64,
    /// Seconds that finding features took.
    pub finding: f64,
}

impl<'a> Preparation<'a> {
    /// Checks options, constraints and buffers.
    pub fn new<T: Coordinate>(
        positions: &'a (impl Vertices<T> + ?Sized),
        triangles: &'a [[u32; 3]],
        options: &Options,
        constraints: &Constraints<'_>,
        threads: &Threads<'_>,
    ) -> Result<Self, Error> {
        check_constraints(constraints, positions.count())?;
        check_order(options.order, constraints, positions.count())?;
        let clock = Instant::now();
        let mesh = Mesh::new(positions, triangles, threads)?;
        let stars = Stars::new(&mesh, threads)?;
        let adjacency = clock.elapsed().as_secs_f64();
        let sizes = options.keep_sizes.then(|| Sizes::new(&mesh, &stars, threads)).transpose()?;
        let operation = Operation::new(options, sizes);
        let worthwhile = are_cones_worthwhile(options, &operation);
        let kept = worthwhile && Cones::may_be_kept(&mesh);
        let cones = kept.then(|| ConeFinder::new(&mesh).all(&mesh, &stars, threads)).transpose()?;
        let features = Features::new((&mesh, &stars, cones.as_ref()), options, constraints, threads)?;
        let finding = clock.elapsed().as_secs_f64() - adjacency;
        let cone_finder = (worthwhile && !kept).then(|| ConeFinder::new(&mesh));
        Ok(Self { mesh, stars, features, cones, cone_finder, operation, adjacency, finding })
    }

    /// The same, in the form in which visits read it.
    pub fn surroundings(&self, options: &Options) -> Surroundings<'_> {
        Surroundings {
            mesh: &self.mesh,
            stars: &self.stars,
            features: &self.features,
            cones: self.cones.as_ref(),
            cone_finder: self.cone_finder,
            operation: &self.operation,
            floor: options.quality_floor,
            keeps_shape: options.feature_angle.is_some(),
            relaxation: options.relaxation,
            max_deviation: options.max_deviation.map(|bound| bound / self.mesh.unit),
        }
    }
}

/// Whether cones save more time than they take: in stars that go side by side, and there from the second look at the original
/// triangles on.
fn are_cones_worthwhile(options: &Options, operation: &Operation) -> bool {
    let is_seen_again = options.feature_angle.is_some() || options.iterations > 1;
    options.order == Order::Colors && operation.sees_places_only() && is_seen_again
}

pub(crate) fn check_constraints(constraints: &Constraints<'_>, vertex_count: usize) -> Result<(), Error> {
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

/// Checks what the order asks for. No other order looks at it, so it may be anything there.
fn check_order(order: Order, constraints: &Constraints<'_>, vertex_count: usize) -> Result<(), Error> {
    let found = constraints.seeds.len();
    if order == Order::Wave && found != 0 && found != vertex_count {
        return Err(Error::SeedLength { found, vertex_count });
    }
    let is_missing = |&(_, &v): &(usize, &u32)| v as usize >= vertex_count;
    match constraints.visits.iter().enumerate().find(is_missing) {
        Some((visit, &index)) if order == Order::Given => Err(Error::VisitOutOfRange { visit, index, vertex_count }),
        _ => Ok(()),
    }
}
