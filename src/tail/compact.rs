//! Closing the gaps that removed vertices and triangles leave.

use glam::DVec3;

use super::live::{GONE, Live};
use super::sources::Sources;
use crate::error::Error;
use crate::memory;

/// The mesh without gaps: vertices and triangles in their old order.
pub(super) struct Compact {
    /// Positions of all input vertices, as they came last.
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    pub sources: Sources,
}

impl Compact {
    /// Without the triangles that are `gone`, rising.
    pub fn new(mut live: Live<'_>, gone: &[u32]) -> Result<Self, Error> {
        let vertex = vertex_sources(&live)?;
        let mut triangle = memory::reserved(live.triangles.len() - gone.len())?;
        triangle.extend((0..live.triangles.len() as u32).filter(|&slot| live.triangles[slot as usize] != GONE));
        let mut corner: Vec<u32> = memory::reserved(3 * triangle.len())?;
        corner.extend(triangle.iter().flat_map(|&t| [3 * t, 3 * t + 1, 3 * t + 2]));
        for (slot, origin) in live.renewed() {
            let number = number(gone, slot) as usize;
            triangle[number] = origin.triangle;
            corner[3 * number..3 * number + 3].copy_from_slice(&origin.corners);
        }
        live.triangles.retain(|&corners| corners != GONE);
        if !live.removed.is_empty() {
            renumber(&mut live.triangles, &vertex, live.positions.len())?;
        }
        let sources = Sources { vertex, triangle, corner };
        Ok(Self { positions: live.positions, triangles: live.triangles, sources })
    }
}

/// Output number of the triangle in a slot that is not among those that are `gone`, rising.
pub(super) fn number(gone: &[u32], slot: u32) -> u32 {
    slot - gone.partition_point(|&other| other < slot) as u32
}

/// The vertices that have not been removed.
fn vertex_sources(live: &Live<'_>) -> Result<Vec<u32>, Error> {
    let mut removed = memory::copied(&live.removed)?;
    removed.sort_unstable();
    let mut left = memory::reserved(live.positions.len() - removed.len())?;
    let mut next = 0;
    for &v in &removed {
        left.extend(next..v);
        next = v + 1;
    }
    left.extend(next..live.positions.len() as u32);
    Ok(left)
}

/// Names in `triangles` the vertices by their places in `left`.
fn renumber(triangles: &mut [[u32; 3]], left: &[u32], count: usize) -> Result<(), Error> {
    let mut numbers = memory::filled(0_u32, count)?;
    for (&v, number) in left.iter().zip(0..) {
        numbers[v as usize] = number;
    }
    triangles.as_flattened_mut().iter_mut().for_each(|v| *v = numbers[*v as usize]);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::tail::live::Origin;
    use crate::threads::Threads;

    #[test]
    fn gaps_close_and_all_that_is_left_knows_where_it_came_from() {
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [2.0, 0.0, 0.0]];
        let triangles = [[0, 1, 2], [2, 1, 3], [1, 4, 3]];
        let mesh = Mesh::new(positions.as_slice(), &triangles, &Threads::ONE).expect("a mesh");
        let mut live = Live::new(&mesh, mesh.positions.doubled().expect("enough memory")).expect("enough memory");
        // The edge 1–2 is collapsed into 2, which leaves 2–4–3 of the last triangle.
        [0, 1, 2].into_iter().for_each(|slot| live.take_out(slot));
        live.put_in(1, [2, 4, 3], Origin { triangle: 2, corners: [3, 7, 8] });
        live.put_in(2, [0, 4, 2], Origin::own(0));
        live.removed.push(1);
        let gone = live.gone().expect("enough memory");
        assert_eq!((gone.as_slice(), live.unchanged_count()), (&[0][..], 0));
        assert_eq!([1, 2].map(|slot| number(&gone, slot)), [0, 1]);
        let Compact { triangles, sources, .. } = Compact::new(live, &gone).expect("enough memory");
        assert_eq!(triangles, [[1, 3, 2], [0, 3, 1]]);
        assert_eq!(sources.vertex, [0, 2, 3, 4]);
        assert_eq!(sources.triangle, [2, 0]);
        assert_eq!(sources.corner, [3, 7, 8, 0, 1, 2]);
    }

    #[test]
    fn what_was_put_back_counts_as_unchanged() {
        let triangles = [[0, 1, 2], [2, 1, 3]];
        let mesh = Mesh::new([[0.0; 3]; 4].as_slice(), &triangles, &Threads::ONE).expect("a mesh");
        let mut live = Live::new(&mesh, mesh.positions.doubled().expect("enough memory")).expect("enough memory");
        assert_eq!(live.unchanged_count(), 2);
        [0, 1].into_iter().for_each(|slot| live.take_out(slot));
        assert_eq!(live.unchanged_count(), 0);
        live.put_in(0, [2, 1, 3], Origin::own(1));
        assert_eq!(live.unchanged_count(), 1);
    }
}
