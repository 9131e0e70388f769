//! What each vertex may do, from its star, the features, and the caller's wishes.

use glam::DVec3;

use super::crease;
use crate::error::Error;
use crate::memory;
use crate::mesh::{Mesh, StarKind, Stars};
use crate::options::{Boundary, Constraints, Options};

/// What a vertex may do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    /// Moves in its tangent plane.
    Free,
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
            crease::mark(mesh, stars, angle, &mut slots);
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

    /// The two feature slots in the ring of a crease vertex.
    pub fn crease_ends(&self, stars: &Stars, v: u32) -> [usize; 2] {
        let mut ends = self.slots.of(stars, v);
        [ends.next().unwrap_or(0), ends.next().unwrap_or(0)]
    }

    fn role_of(
        &self,
        mesh: &Mesh<'_>,
        stars: &Stars,
        options: &Options,
        v: u32,
        locked: bool,
        straight: f64,
    ) -> Role {
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
                if line(first, second) { Role::Crease } else { Role::Corner }
            }
            StarKind::Open | StarKind::Closed => Role::Corner,
        }
    }
}

/// A set of edges inside the surface, as one bit for each ring slot.
pub(crate) struct SlotSet {
    bits: Vec<u64>,
}

impl SlotSet {
    pub fn new(stars: &Stars) -> Result<Self, Error> {
        Ok(Self { bits: memory::filled(0, stars.slot_count() / 64 + 1)? })
    }

    pub fn contains(&self, slot: usize) -> bool {
        self.bits[slot / 64] >> (slot % 64) & 1 == 1
    }

    /// Ring positions of `v` that are in the set.
    pub fn of<'s>(&'s self, stars: &'s Stars, v: u32) -> impl Iterator<Item = usize> + 's {
        let slots = stars.ring_slots(v);
        let start = slots.start;
        slots.filter(|&slot| self.contains(slot)).map(move |slot| slot - start)
    }

    /// Puts the edge a–b into the set, as seen from both ends; boundary edges and pairs that are no edge are left out.
    pub fn insert_edge(&mut self, stars: &Stars, a: u32, b: u32) {
        self.insert_half(stars, a, b);
        self.insert_half(stars, b, a);
    }

    fn insert_half(&mut self, stars: &Stars, v: u32, r: u32) {
        if let Some(i) = stars.inner_neighbour(v, r) {
            let slot = stars.ring_slots(v).start + i;
            self.bits[slot / 64] |= 1 << (slot % 64);
        }
    }

    pub fn remove_edge(&mut self, stars: &Stars, a: u32, b: u32) {
        for (v, r) in [(a, b), (b, a)] {
            if let Some(i) = stars.inner_neighbour(v, r) {
                let slot = stars.ring_slots(v).start + i;
                self.bits[slot / 64] &= !(1 << (slot % 64));
            }
        }
    }

    /// Edges in the set.
    fn edge_count(&self, stars: &Stars) -> usize {
        let seen = |v: u32| self.of(stars, v).filter(move |&i| {
            let r = stars.ring(v)[i];
            v < r || stars.inner_neighbour(r, v).is_none()
        });
        (0..stars.len() as u32).map(|v| seen(v).count()).sum()
    }
}

/// Unit normal of the triangle (a, b, c), zero without area.
pub(super) fn unit_normal(a: DVec3, b: DVec3, c: DVec3) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}
