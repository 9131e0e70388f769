//! Closing the gaps that removed vertices and triangles leave.

use super::live::{GONE, Live};
use super::sources::Sources;
use crate::error::Error;
use crate::memory;

/// The mesh without gaps: vertices and triangles in their old order.
pub(super) struct Compact {
    pub triangles: Vec<[u32; 3]>,
    pub sources: Sources,
    /// Slots that hold a triangle, rising: entry t is the slot of output triangle t.
    pub slots: Vec<u32>,
}

impl Compact {
    pub fn new(live: &Live<'_>) -> Result<Self, Error> {
        let mut numbers = memory::filled(0_u32, live.positions.len())?;
        live.removed.iter().for_each(|&v| numbers[v as usize] = u32::MAX);
        let mut vertex = memory::reserved(live.positions.len() - live.removed.len())?;
        for (v, number) in numbers.iter_mut().enumerate().filter(|(_, number)| **number == 0) {
            *number = vertex.len() as u32;
            vertex.push(v as u32);
        }
        let count = live.triangles.iter().filter(|&&t| t != GONE).count();
        let mut slots = memory::reserved(count)?;
        slots.extend((0..live.triangles.len() as u32).filter(|&s| live.triangles[s as usize] != GONE));
        let mut triangles = memory::reserved(count)?;
        triangles.extend(slots.iter().map(|&s| live.triangles[s as usize].map(|v| numbers[v as usize])));
        let mut triangle = memory::reserved(count)?;
        triangle.extend(slots.iter().map(|&s| live.triangle_source[s as usize]));
        let mut corner = memory::reserved(3 * count)?;
        corner.extend(slots.iter().flat_map(|&s| live.corner_source[s as usize]));
        Ok(Self { triangles, sources: Sources { vertex, triangle, corner }, slots })
    }
}
