//! The two calls after which a mesh may be smaller: the tail alone, and smoothing with the tail behind it.
#![forbid(unsafe_code)]

use super::report::qsm_report;
use crate::error::Error;
use crate::mesh::Coordinate;
use crate::options::{Constraints, Options};
use crate::progress::Progress;
use crate::tail::{Leftover, Sources, TailOptions};

/// Which of the two.
#[derive(Debug, Clone, Copy)]
pub(super) enum Stage {
    CollapseTails,
    Improve,
}

/// Private copy of a mesh before a stage, and what is to be handed out after it.
pub(super) struct Work<T> {
    pub positions: Vec<[T; 3]>,
    pub triangles: Vec<[u32; 3]>,
    pub sources: Sources,
    pub leftovers: Vec<Leftover>,
}

impl<T> Work<T> {
    pub fn new(positions: Vec<[T; 3]>, triangles: Vec<[u32; 3]>) -> Self {
        Self { positions, triangles, sources: Sources::default(), leftovers: Vec::new() }
    }

    /// Whether everything has room in memory for a mesh of this size. Writing relies on it, so it is not left to trust.
    pub fn fits(&self, vertex_count: usize, triangle_count: usize) -> bool {
        let Self { positions, triangles, sources, .. } = self;
        let vertices = [positions.len(), sources.vertex.len()];
        let triangles = [triangles.len(), sources.triangle.len(), sources.corner.len().div_ceil(3)];
        vertices.iter().all(|&count| count <= vertex_count) && triangles.iter().all(|&count| count <= triangle_count)
    }
}

impl Stage {
    /// Carries the stage out on `work`, and reports.
    pub fn run<T: Coordinate>(
        self,
        work: &mut Work<T>,
        options: &Options,
        tail: &TailOptions<'_>,
        constraints: &Constraints<'_>,
        progress: &mut Progress<'_>,
    ) -> Result<qsm_report, Error> {
        let Work { positions, triangles, sources, leftovers } = work;
        let (report, left) = match self {
            Self::CollapseTails => {
                let done = crate::collapse_tails(positions, triangles, options, tail, constraints, sources, progress)?;
                (qsm_report::from(&done), done.leftovers)
            }
            Self::Improve => {
                let done = crate::improve(positions, triangles, options, tail, constraints, sources, progress)?;
                (qsm_report::from(&done), done.tail.leftovers)
            }
        };
        *leftovers = left;
        Ok(report)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_grown_does_not_fit() {
        let work = || Work::new(vec![[0.0; 3]; 3], vec![[0, 1, 2]]);
        assert!(work().fits(3, 1));
        assert!(!work().fits(2, 1) && !work().fits(3, 0));
        let sources = Sources { vertex: vec![0], triangle: vec![0], corner: vec![0, 1, 2, 0] };
        assert!(!Work { sources, ..work() }.fits(3, 1));
    }
}
