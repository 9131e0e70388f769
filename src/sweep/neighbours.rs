//! Which vertices share triangles, around vertices of every kind. Stars know this for rings alone.

use crate::error::Error;
use crate::memory;
use crate::mesh::{Mesh, repeats_a_vertex};

/// The component of a vertex without a triangle.
pub(super) const NONE: u32 = u32::MAX;

/// The triangles at each vertex, at vertices of every kind. Triangles that name a vertex twice are left out.
pub(super) struct Neighbours<'a> {
    pub mesh: &'a Mesh<'a>,
    /// Start of each vertex's triangles in `incident`; one entry more than vertices.
    offsets: Vec<u32>,
    incident: Vec<u32>,
}

impl<'a> Neighbours<'a> {
    /// Collects the triangles by counting.
    pub fn new(mesh: &'a Mesh<'a>) -> Result<Self, Error> {
        let mut offsets = memory::filled(0_u32, mesh.positions.len() + 1)?;
        let usable = || (0_u32..).zip(mesh.triangles).filter(|(_, t)| !repeats_a_vertex(t));
        usable().flat_map(|(_, t)| t).for_each(|&v| offsets[v as usize + 1] += 1);
        for v in 0..mesh.positions.len() {
            offsets[v + 1] += offsets[v];
        }
        let mut next = memory::copied(&offsets)?;
        let mut incident = memory::filled(0, offsets[mesh.positions.len()] as usize)?;
        for (number, triangle) in usable() {
            for &v in triangle {
                incident[next[v as usize] as usize] = number;
                next[v as usize] += 1;
            }
        }
        Ok(Self { mesh, offsets, incident })
    }

    /// The vertices that share a triangle with `v`, itself among them, most more than once.
    pub fn of(&self, v: u32) -> impl Iterator<Item = u32> {
        let [start, end] = [v as usize, v as usize + 1].map(|i| self.offsets[i] as usize);
        self.incident[start..end].iter().flat_map(|&t| self.mesh.triangles[t as usize])
    }

    fn has_triangle(&self, v: u32) -> bool {
        self.offsets[v as usize] < self.offsets[v as usize + 1]
    }
}

/// For each vertex the least number of a vertex that can be reached from it over triangles; `NONE` without a triangle.
pub(super) fn components(neighbours: &Neighbours<'_>) -> Result<Vec<u32>, Error> {
    let count = neighbours.mesh.positions.len();
    let mut components = memory::filled(NONE, count)?;
    let mut waiting = memory::reserved(count)?;
    for first in 0..count as u32 {
        if components[first as usize] != NONE || !neighbours.has_triangle(first) {
            continue;
        }
        components[first as usize] = first;
        waiting.push(first);
        while let Some(v) = waiting.pop() {
            for r in neighbours.of(v).filter(|&r| std::mem::replace(&mut components[r as usize], first) == NONE) {
                waiting.push(r);
            }
        }
    }
    Ok(components)
}
