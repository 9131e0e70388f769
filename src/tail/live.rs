//! The mesh while it is being changed: static arrays, and an overlay for what has changed.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::error::Error;
use crate::memory;
use crate::mesh::{Mesh, repeats_a_vertex};

/// In the place of a triangle that is no longer there.
pub(super) const GONE: [u32; 3] = [u32::MAX; 3];

/// Where a triangle comes from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Origin {
    /// Input triangle.
    pub triangle: u32,
    /// Input corners.
    pub corners: [u32; 3],
}

impl Origin {
    /// Of an input triangle itself.
    pub fn own(triangle: u32) -> Self {
        Self { triangle, corners: [0, 1, 2].map(|k| 3 * triangle + k) }
    }
}

/// The mesh as it is now. Triangles keep their slots; a slot that is given up holds [`GONE`].
pub(super) struct Live<'a> {
    /// The triangles as they came in.
    pub input: &'a [[u32; 3]],
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    /// Slots whose triangles have been taken out, each with the origin of the triangle that has been put in since.
    renewed: BTreeMap<u32, Option<Origin>>,
    /// Vertices that are no longer there, in the order of their removal.
    pub removed: Vec<u32>,
    /// Vertices that stay because triangles that name a vertex twice have them as corners, rising.
    bound: Vec<u32>,
    offsets: Vec<u32>,
    incident: Vec<u32>,
    /// Slots around the vertices whose triangles have changed.
    changed: BTreeMap<u32, Vec<u32>>,
}

impl<'a> Live<'a> {
    /// Takes up the triangles of `mesh` with these positions.
    pub fn new(mesh: &Mesh<'a>, positions: Vec<DVec3>) -> Result<Self, Error> {
        let (offsets, incident) = incidence(mesh.triangles, positions.len())?;
        Ok(Self {
            input: mesh.triangles,
            triangles: memory::copied(mesh.triangles)?,
            renewed: BTreeMap::new(),
            removed: memory::reserved(positions.len())?,
            bound: bound(mesh.triangles)?,
            offsets,
            incident,
            positions,
            changed: BTreeMap::new(),
        })
    }

    /// Positions of the corners of a slot that is not given up.
    pub fn corners(&self, slot: u32) -> [DVec3; 3] {
        self.triangles[slot as usize].map(|v| self.positions[v as usize])
    }

    /// Where the triangle in a slot that is not given up comes from.
    pub fn origin(&self, slot: u32) -> Origin {
        self.renewed.get(&slot).copied().flatten().unwrap_or_else(|| Origin::own(slot))
    }

    /// Slots that hold another triangle than at first, with its origin; rising.
    pub fn renewed(&self) -> impl Iterator<Item = (u32, Origin)> {
        self.renewed.iter().filter_map(|(&slot, &origin)| Some((slot, origin?)))
    }

    /// Slots that are given up, rising.
    pub fn gone(&self) -> Result<Vec<u32>, Error> {
        memory::gathered(self.renewed.iter().filter(|(_, origin)| origin.is_none()).map(|(&slot, _)| slot))
    }

    /// How many slots hold their input triangle, or another one just as it was in the input.
    pub fn unchanged_count(&self) -> usize {
        let is_unchanged =
            |(slot, origin): &(u32, Origin)| self.triangles[*slot as usize] == self.input[origin.triangle as usize];
        self.triangles.len() - self.renewed.len() + self.renewed().filter(is_unchanged).count()
    }

    /// Slots of the triangles at a vertex; those that name a vertex twice are left out.
    pub fn around(&self, v: u32) -> &[u32] {
        match self.changed.get(&v) {
            Some(slots) => slots,
            None => &self.incident[self.offsets[v as usize] as usize..self.offsets[v as usize + 1] as usize],
        }
    }

    /// Slots of the triangles at that one of `vertices` which has the fewest: enough to find a triangle that has them all,
    /// and never long, unless they are all centres of large stars.
    pub fn around_all(&self, vertices: &[u32]) -> &[u32] {
        let stars = vertices.iter().map(|&v| self.around(v));
        stars.min_by_key(|slots| slots.len()).unwrap_or_default()
    }

    /// Whether no triangle has the vertex any more, not even one that names a vertex twice.
    pub fn is_left_alone(&self, v: u32) -> bool {
        self.around(v).is_empty() && self.bound.binary_search(&v).is_err()
    }

    /// Takes a triangle out of its slot.
    pub fn take_out(&mut self, slot: u32) {
        self.renewed.insert(slot, None);
        for v in std::mem::replace(&mut self.triangles[slot as usize], GONE) {
            self.own_around(v).retain(|&s| s != slot);
        }
    }

    /// Puts a triangle into a free slot.
    pub fn put_in(&mut self, slot: u32, corners: [u32; 3], origin: Origin) {
        self.renewed.insert(slot, Some(origin));
        self.triangles[slot as usize] = corners;
        for v in corners {
            self.own_around(v).push(slot);
        }
    }

    fn own_around(&mut self, v: u32) -> &mut Vec<u32> {
        let range = self.offsets[v as usize] as usize..self.offsets[v as usize + 1] as usize;
        self.changed.entry(v).or_insert_with(|| self.incident[range].to_vec())
    }
}

/// The corners of triangles that name a vertex twice, rising. No star has these triangles, so nothing takes them out.
fn bound(triangles: &[[u32; 3]]) -> Result<Vec<u32>, Error> {
    let mut corners = memory::gathered(triangles.iter().filter(|t| repeats_a_vertex(t)).flatten().copied())?;
    corners.sort_unstable();
    corners.dedup();
    Ok(corners)
}

/// Slots around each vertex, in rising order, in one flat array behind offsets.
fn incidence(triangles: &[[u32; 3]], vertex_count: usize) -> Result<(Vec<u32>, Vec<u32>), Error> {
    let mut offsets = memory::filled(0_u32, vertex_count + 1)?;
    let sound = || triangles.iter().enumerate().filter(|(_, t)| !repeats_a_vertex(t));
    // Offsets are summed to where each vertex ends; filling from behind moves them to where it starts.
    sound().for_each(|(_, t)| t.iter().for_each(|&v| offsets[v as usize] += 1));
    let mut start = 0;
    for offset in &mut offsets {
        start += *offset;
        *offset = start;
    }
    let mut incident = memory::filled(0_u32, start as usize)?;
    for (slot, corners) in triangles.iter().enumerate().rev().filter(|(_, t)| !repeats_a_vertex(t)) {
        for &v in corners {
            offsets[v as usize] -= 1;
            incident[offsets[v as usize] as usize] = slot as u32;
        }
    }
    Ok((offsets, incident))
}
