//! What each vertex may do, from its star, the features, and the caller's wishes.

use super::slots::SlotSet;
use super::{corner, crease};
use crate::error::Error;
use crate::memory;
use crate::mesh::{Mesh, StarKind, Stars};
use crate::options::{Boundary, Constraints, Options};

/// What a vertex may do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    /// Moves in its tangent plane.
    Free,
    /// Moves in its tangent plane, but not far from the planes of its original triangles: it looks like a corner, and what
    /// makes it look so are bad triangles.
    Doubtful,
    /// Slides along a crease.
    Crease,
    /// Slides along the boundary.
    Rim,
    /// Stays: in no triangle.
    Unreferenced,
    /// Stays: locked by the caller.
    Locked,
    /// Stays: its star is not a disc.
    NonManifold,
    /// Stays: boundary.
    Boundary,
    /// Stays: an end, a fork or a sharp turn of features.
    Corner,
}

/// The features of a mesh, and what they make of its vertices.
pub(crate) struct Features {
    roles: Vec<Role>,
    slots: SlotSet,
    /// Feature edges inside the surface.
    pub edge_count: usize,
}

impl Features {
    pub fn new(
        mesh: &Mesh<'_>,
        stars: &Stars,
        options: &Options,
        constraints: &Constraints<'_>,
    ) -> Result<Self, Error> {
        let mut slots = SlotSet::new(stars)?;
        if let Some(angle) = options.feature_angle {
            crease::mark(mesh, stars, angle, &mut slots)?;
        }
        for &[a, b] in constraints.feature_edges {
            slots.insert_edge(stars, a, b);
        }
        let mut features = Self { roles: memory::filled(Role::Free, stars.len())?, slots, edge_count: 0 };
        let straight = libm::cos(options.feature_angle.unwrap_or(30.0).to_radians());
        for v in 0..stars.len() as u32 {
            let locked = constraints.locked.get(v as usize).copied().unwrap_or(false);
            features.roles[v as usize] = features.role_of(mesh, stars, options, v, locked, straight);
        }
        features.edge_count = features.slots.edge_count(stars);
        Ok(features)
    }

    pub fn role(&self, v: u32) -> Role {
        self.roles[v as usize]
    }

    /// Whether the edge a–b of the original mesh is a feature inside the surface.
    pub fn is_feature(&self, stars: &Stars, a: u32, b: u32) -> bool {
        self.slots.contains_edge(stars, a, b)
    }

    /// The two feature slots in the ring of a crease vertex.
    pub fn crease_ends(&self, stars: &Stars, v: u32) -> [usize; 2] {
        let mut ends = self.slots.of(stars, v);
        [ends.next().unwrap_or(0), ends.next().unwrap_or(0)]
    }

    fn corner(&self, mesh: &Mesh<'_>, stars: &Stars, v: u32) -> Role {
        let ends: Vec<usize> = self.slots.of(stars, v).collect();
        if corner::is_credible(mesh, stars, v, &ends) { Role::Corner } else { Role::Doubtful }
    }

    fn role_of(&self, mesh: &Mesh<'_>, stars: &Stars, options: &Options, v: u32, locked: bool, straight: f64) -> Role {
        let ring = stars.ring(v);
        let marked = self.slots.of(stars, v).count();
        let line = |first: usize, second: usize| {
            let p = |i: usize| (mesh.positions[ring[i] as usize] - mesh.positions[v as usize]).normalize_or_zero();
            -p(first).dot(p(second)) >= straight
        };
        match stars.kind(v) {
            StarKind::Empty => Role::Unreferenced,
            _ if locked => Role::Locked,
            StarKind::NonManifold => Role::NonManifold,
            StarKind::Open if options.boundary == Boundary::Fixed => Role::Boundary,
            StarKind::Open if marked == 0 && ring.len() > 2 && line(0, ring.len() - 1) => Role::Rim,
            StarKind::Closed if marked == 0 => Role::Free,
            StarKind::Closed if marked == 2 => {
                let [first, second] = self.crease_ends(stars, v);
                if line(first, second) { Role::Crease } else { self.corner(mesh, stars, v) }
            }
            StarKind::Closed => self.corner(mesh, stars, v),
            StarKind::Open => Role::Corner,
        }
    }
}
