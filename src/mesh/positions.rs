//! Positions in the caller's own precision: single precision takes half the memory, and memory is what a large mesh waits for.

use std::borrow::Cow;

use glam::DVec3;

use crate::error::Error;
use crate::memory;
use crate::threads::Threads;

/// Where vertices are, exactly: in the caller's buffer, or in one of our own. Public for the sealed trait that names it; nobody
/// outside can.
#[derive(Debug, Clone, PartialEq)]
pub enum Positions<'a> {
    Single(Cow<'a, [[f32; 3]]>),
    Double(Cow<'a, [[f64; 3]]>),
}

impl<'a> Positions<'a> {
    /// What `position` says of each of `count` vertices.
    pub(crate) fn doubles(
        count: usize,
        position: impl Fn(usize) -> DVec3 + Sync,
        threads: &Threads<'_>,
    ) -> Result<Self, Error> {
        Ok(Self::Double(Cow::Owned(threads.collect(count, |v| position(v).to_array())?)))
    }

    /// Those of a list, in the same memory.
    pub fn from_doubles(all: Vec<DVec3>) -> Self {
        Self::Double(Cow::Owned(all.into_iter().map(|position| position.to_array()).collect()))
    }

    /// How many vertices there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Single(all) => all.len(),
            Self::Double(all) => all.len(),
        }
    }

    /// Position of vertex `v`.
    #[inline(always)]
    pub fn at(&self, v: usize) -> DVec3 {
        match self {
            Self::Single(all) => widened(all[v]),
            Self::Double(all) => DVec3::from_array(all[v]),
        }
    }

    /// A copy of all, in double precision.
    pub fn doubled(&self) -> Result<Vec<DVec3>, Error> {
        let mut all = memory::reserved(self.len())?;
        all.extend((0..self.len()).map(|v| self.at(v)));
        Ok(all)
    }

    /// All in double precision; a copy only where they have not been.
    pub fn into_doubles(self) -> Result<Vec<DVec3>, Error> {
        match self {
            Self::Double(Cow::Owned(all)) => Ok(all.into_iter().map(DVec3::from_array).collect()),
            others => others.doubled(),
        }
    }
}

/// A position of single precision in double precision.
#[inline(always)]
pub(crate) fn widened(position: [f32; 3]) -> DVec3 {
    DVec3::from_array(position.map(f64::from))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    /// The positions of a mesh of one triangle in single precision.
    fn positions(corners: &[[f32; 3]; 3]) -> Positions<'_> {
        Mesh::new(corners.as_slice(), &[[0, 1, 2]], &Threads::ONE).expect("a mesh").positions
    }

    #[test]
    fn single_precision_stays_what_it_is() {
        let corners = [[0.1, 0.0, -0.0], [1.0e-40, 3.0, 1.0], [-7.7, 1.0, 0.3]];
        let (found, doubled) = (positions(&corners), corners.map(|p| DVec3::from_array(p.map(f64::from))));
        assert!(matches!(found, Positions::Single(Cow::Borrowed(_))), "read where they lie");
        assert_eq!([0, 1, 2].map(|v| found.at(v)), doubled);
        assert_eq!(found.into_doubles().expect("memory"), doubled);
    }

    #[test]
    fn what_has_to_be_scaled_needs_double_precision() {
        // Divided by the unit, the least coordinate is too small for all its digits in single precision.
        let corners: [[f32; 3]; 3] = [[1.0e30, 0.0, 0.0], [0.0, 1.0e-10, 0.0], [0.0, 0.0, 1.0]];
        let mesh = Mesh::new(corners.as_slice(), &[[0, 1, 2]], &Threads::ONE).expect("a mesh");
        assert!(matches!(mesh.positions, Positions::Double(Cow::Owned(_))));
        let (least, stored) = (mesh.position(1).y, f64::from(corners[1][1]));
        assert!(least * mesh.unit == stored && f64::from(least as f32) * mesh.unit != stored);
    }

    #[test]
    fn double_precision_is_kept() {
        let corners = [[0.1_f64; 3]; 3];
        let mesh = Mesh::new(corners.as_slice(), &[[0, 1, 2]], &Threads::ONE).expect("a mesh");
        assert!(matches!(&mesh.positions, Positions::Double(Cow::Borrowed(all)) if *all == corners));
    }
}
