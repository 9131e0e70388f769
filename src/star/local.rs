//! One star taken out of the mesh: its ring, relative to its centre.

use glam::DVec3;

use crate::mesh::{StarKind, Stars};

/// The ring of a star relative to its centre, so that nothing depends on where in space the star lies.
/// Reused from star to star.
#[derive(Default)]
pub(crate) struct LocalStar {
    /// Position of the centre.
    pub centre: DVec3,
    /// Ring vertices minus the centre; of a closed star the first one again at the end. Triangle i of the star is
    /// (centre, rim\[i\], rim\[i + 1\]).
    pub rim: Vec<DVec3>,
    /// Vertex numbers of `rim`.
    pub vertices: Vec<u32>,
    /// Index into `rim` at which the second sector begins; the star of a crease vertex has two, any other star one.
    pub split: usize,
}

impl LocalStar {
    /// Takes up the whole star of `v`.
    pub fn take(&mut self, stars: &Stars, positions: &[DVec3], v: u32) {
        self.take_from(stars, positions, v, 0);
        self.split = self.rim.len() - 1;
    }

    /// Takes up the closed star of a crease vertex: two sectors, between the ring vertices number `first` and `second`.
    pub fn take_crease(&mut self, stars: &Stars, positions: &[DVec3], v: u32, [first, second]: [usize; 2]) {
        self.take_from(stars, positions, v, first);
        self.split = second - first;
    }

    /// Takes up a closed star from its ring: vertex numbers and positions, the first ones not repeated. The second sector
    /// starts at the ring vertex number `split`; `None`: there is none.
    pub fn take_ring(&mut self, centre: DVec3, ring: impl Iterator<Item = (u32, DVec3)>, split: Option<usize>) {
        self.centre = centre;
        self.vertices.clear();
        self.rim.clear();
        for (vertex, position) in ring {
            self.vertices.push(vertex);
            self.rim.push(position - centre);
        }
        self.vertices.extend_from_within(..1);
        self.rim.extend_from_within(..1);
        self.split = split.unwrap_or(self.rim.len() - 1);
    }

    fn take_from(&mut self, stars: &Stars, positions: &[DVec3], v: u32, first: usize) {
        let ring = stars.ring(v);
        self.vertices.clear();
        self.vertices.extend_from_slice(&ring[first..]);
        self.vertices.extend_from_slice(&ring[..first]);
        if stars.kind(v) == StarKind::Closed {
            self.vertices.push(ring[first]);
        }
        let centre = positions[v as usize];
        self.centre = centre;
        self.rim.clear();
        self.rim.extend(self.vertices.iter().map(|&r| positions[r as usize] - centre));
    }

    /// The sectors: stretches of the rim with the triangles between features.
    pub fn sectors(&self) -> impl Iterator<Item = &[DVec3]> {
        let (end, split) = (self.rim.len() - 1, self.split);
        let second = (split < end).then(|| &self.rim[split..]);
        std::iter::once(&self.rim[..=split]).chain(second)
    }

    /// Number of triangles.
    pub fn valence(&self) -> usize {
        self.rim.len() - 1
    }
}

/// Twice the vector area of a fan about the origin: Σ A × B. For a closed star it is the vector area of the ring and does
/// not depend on where the centre is; moving the centre by d changes the enclosed volume by a sixth of its product with d.
pub(crate) fn double_vector_area(rim: &[DVec3]) -> DVec3 {
    rim.windows(2).fold(DVec3::ZERO, |sum, e| sum + e[0].cross(e[1]))
}
