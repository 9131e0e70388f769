//! What each vertex may do, from its star, the features, and the caller's wishes.

use super::flat::Flat;
use super::slots::SlotSet;
use super::{corner, crease};
use crate::error::Error;
use crate::mesh::{Mesh, StarKind, Stars};
use crate::options::{Boundary, Constraints, Options};
use crate::star::Cones;
use crate::threads::{PART, Threads};

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

impl Role {
    /// How many roles there are.
    pub const COUNT: usize = Self::Corner as usize + 1;

    /// Whether a vertex of this role moves in its tangent plane.
    pub fn moves_in_plane(self) -> bool {
        matches!(self, Self::Free | Self::Doubtful)
    }

    /// Whether a vertex of this role may move at all.
    pub fn moves(self) -> bool {
        matches!(self, Self::Free | Self::Doubtful | Self::Crease | Self::Rim)
    }
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
        (mesh, stars, cones): (&Mesh<'_>, &Stars, Option<&Cones>),
        options: &Options,
        constraints: &Constraints<'_>,
        threads: &Threads<'_>,
    ) -> Result<Self, Error> {
        let mut slots = SlotSet::new(stars)?;
        let mut marked = SlotSet::new(stars)?;
        if let Some(angle) = options.feature_angle {
            let sharp = libm::cos(angle.to_radians());
            let flat = Flat::new((mesh, stars, cones), sharp, threads)?;
            crease::mark((mesh, stars), (sharp, &flat), threads, &mut slots)?;
        }
        for &[a, b] in constraints.feature_edges {
            slots.insert_edge(stars, a, b);
            marked.insert_edge(stars, a, b);
        }
        let straight = libm::cos(options.feature_angle.unwrap_or(STRAIGHT).to_radians());
        let judge = Judge { mesh, stars, slots: &slots, marked: &marked, boundary: options.boundary, straight };
        let mut roles = threads.filled(Role::Free, stars.len())?;
        threads.each(roles.chunks_mut(PART).enumerate().collect(), |(part, roles)| {
            for (v, role) in (part * PART..).zip(roles) {
                let locked = constraints.locked.get(v).copied().unwrap_or(false);
                *role = judge.role(v as u32, locked);
            }
        });
        let edge_count = slots.edge_count();
        Ok(Self { roles, slots, edge_count })
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
}

/// Turn in degrees past which a feature line has a corner, if the caller gives no feature angle.
const STRAIGHT: f64 = 30.0;

/// Decides what each vertex may do.
struct Judge<'a> {
    mesh: &'a Mesh<'a>,
    stars: &'a Stars,
    /// All feature edges.
    slots: &'a SlotSet,
    /// Those that the caller has marked.
    marked: &'a SlotSet,
    boundary: Boundary,
    /// Cosine of the turn past which a line has a corner.
    straight: f64,
}

impl Judge<'_> {
    fn role(&self, v: u32, locked: bool) -> Role {
        match self.stars.kind(v) {
            StarKind::Empty => Role::Unreferenced,
            _ if locked => Role::Locked,
            StarKind::NonManifold => Role::NonManifold,
            StarKind::Open => self.on_boundary(v),
            StarKind::Closed => self.inside(v),
        }
    }

    fn on_boundary(&self, v: u32) -> Role {
        let last = self.stars.ring(v).len() - 1;
        let is_end_of_feature = self.slots.of(self.stars, v).next().is_some();
        match self.boundary {
            Boundary::Fixed => Role::Boundary,
            Boundary::Slide if !is_end_of_feature && last > 1 && self.is_straight(v, [0, last]) => Role::Rim,
            Boundary::Slide => Role::Corner,
        }
    }

    fn inside(&self, v: u32) -> Role {
        if self.slots.has_none_of(self.stars, v) {
            return Role::Free;
        }
        let ends: Vec<usize> = self.slots.of(self.stars, v).collect();
        match ends[..] {
            [first, second] if self.is_straight(v, [first, second]) => Role::Crease,
            _ if self.marked.of(self.stars, v).next().is_some() => Role::Corner,
            _ if corner::is_credible(self.mesh, self.stars, v, &ends) => Role::Corner,
            _ => Role::Doubtful,
        }
    }

    /// Whether the line from one ring position over `v` to the other is straight enough to slide along.
    fn is_straight(&self, v: u32, ends: [usize; 2]) -> bool {
        let at = |r: u32| self.mesh.position(r);
        let [one, other] = ends.map(|i| (at(self.stars.ring(v)[i]) - at(v)).normalize_or_zero());
        -one.dot(other) >= self.straight
    }
}
