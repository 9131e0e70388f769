//! What has become of the mesh of a file.

use std::ops::Range;

use qsmesh::Sources;

use super::faces::Faces;
use super::positions::Positions;

/// New positions and, where the connectivity has changed too, new triangles and where they came from.
pub struct Revision {
    /// Of the vertices that are left.
    pub positions: Positions,
    remesh: Option<Remesh>,
}

/// New connectivity. Every face of the file is a triangle then.
struct Remesh {
    triangles: Vec<[u32; 3]>,
    sources: Sources,
    /// New number of each former vertex, if it is still there.
    numbers: Vec<Option<usize>>,
    /// Face f became the triangles `starts[f]..starts[f + 1]`.
    starts: Vec<usize>,
}

impl Revision {
    /// Vertices have moved, nothing else.
    pub fn of_positions(positions: Positions) -> Self {
        Self { positions, remesh: None }
    }

    /// Vertices and triangles have gone from a mesh of `vertices` vertices and `faces` triangles. The triangles take
    /// the places of their sources, so that they stay under the records that govern those; also returns the number
    /// that each of `triangles` gets by that.
    pub fn of_mesh(
        positions: Positions,
        triangles: &[[u32; 3]],
        sources: &Sources,
        vertices: usize,
        faces: usize,
    ) -> (Self, Vec<u32>) {
        let mut order: Vec<usize> = (0..triangles.len()).collect();
        order.sort_by_key(|&t| sources.triangle[t]);
        let mut places = vec![0; order.len()];
        order.iter().zip(0..).for_each(|(&t, place)| places[t] = place);
        let sorted = Sources {
            vertex: sources.vertex.clone(),
            triangle: order.iter().map(|&t| sources.triangle[t]).collect(),
            corner: order.iter().flat_map(|&t| [0, 1, 2].map(|k| sources.corner[3 * t + k])).collect(),
        };
        let mut numbers = vec![None; vertices];
        sorted.vertex.iter().enumerate().for_each(|(new, &old)| numbers[old as usize] = Some(new));
        let before = |face: usize| sorted.triangle.partition_point(|&source| (source as usize) < face);
        let starts = (0..=faces).map(before).collect();
        let triangles = order.iter().map(|&t| triangles[t]).collect();
        (Self { positions, remesh: Some(Remesh { triangles, sources: sorted, numbers, starts }) }, places)
    }

    /// Whether the connectivity may have changed.
    pub fn is_remeshed(&self) -> bool {
        self.remesh.is_some()
    }

    /// The new number of a former vertex; `None` if it is gone.
    pub fn vertex(&self, former: usize) -> Option<usize> {
        self.remesh.as_ref().map_or(Some(former), |remesh| remesh.numbers.get(former).copied().flatten())
    }

    /// The new number of a former vertex that has moved.
    pub fn moved(&self, before: &Positions, former: usize) -> Option<usize> {
        self.vertex(former).filter(|&vertex| self.positions.differ(vertex, before, former))
    }

    /// The triangles as they are now.
    pub fn triangles<'a>(&'a self, faces: &'a Faces) -> &'a [[u32; 3]] {
        self.remesh.as_ref().map_or(&faces.triangles, |remesh| &remesh.triangles)
    }

    /// The triangles that face `face`, a triangle, has become.
    pub fn successors(&self, face: usize) -> Range<usize> {
        self.remesh.as_ref().map_or(face..face + 1, |remesh| remesh.starts[face]..remesh.starts[face + 1])
    }

    /// How many faces there are now.
    pub fn face_count(&self, faces: &Faces) -> usize {
        self.remesh.as_ref().map_or(faces.len(), |remesh| remesh.triangles.len())
    }

    /// Former corners (3 × face + 0, 1 or 2) that the corners of `triangle` came from.
    pub fn corners(&self, triangle: usize) -> [usize; 3] {
        [0, 1, 2].map(|k| match &self.remesh {
            Some(remesh) => remesh.sources.corner[3 * triangle + k] as usize,
            None => 3 * triangle + k,
        })
    }

    /// Whether any vertex has moved or gone, or any triangle is another.
    pub fn changes(&self, before: &Positions, faces: &Faces) -> bool {
        let moved = |vertex| self.vertex(vertex).is_none_or(|new| self.positions.differ(new, before, vertex));
        (0..before.len()).any(moved) || self.changes_faces(faces)
    }

    fn changes_faces(&self, faces: &Faces) -> bool {
        let Some(remesh) = &self.remesh else { return false };
        let renumbered = |v: u32| self.vertex(v as usize);
        let differs = |(face, triangle): (usize, &[u32; 3])| match self.successors(face) {
            range if range.len() == 1 => {
                remesh.triangles[range.start].map(|v| Some(v as usize)) != triangle.map(renumbered)
            }
            _ => true,
        };
        faces.triangles.iter().enumerate().any(differs)
    }
}

#[cfg(test)]
mod tests {
    use qsmesh::Sources;

    use super::{Faces, Positions, Revision};

    /// Four triangles around vertex 4 become two, given in the wrong order.
    fn collapsed() -> (Revision, Vec<u32>) {
        let positions = Positions::F64(vec![[0.0; 3]; 4]);
        let triangles = [[2, 3, 0], [0, 1, 2]];
        let sources = Sources { vertex: vec![0, 1, 2, 4], triangle: vec![3, 1], corner: vec![7, 11, 10, 1, 3, 4] };
        Revision::of_mesh(positions, &triangles, &sources, 5, 4)
    }

    #[test]
    fn triangles_go_to_the_places_of_their_sources() {
        let (revision, places) = collapsed();
        assert_eq!(places, [1, 0]);
        let faces = Faces::default();
        assert_eq!(revision.triangles(&faces), [[0, 1, 2], [2, 3, 0]]);
        assert_eq!((0..4).map(|f| revision.successors(f)).collect::<Vec<_>>(), [0..0, 0..1, 1..1, 1..2]);
        assert_eq!((revision.corners(0), revision.corners(1)), ([1, 3, 4], [7, 11, 10]));
    }

    #[test]
    fn vertices_move_up() {
        let (revision, _) = collapsed();
        assert_eq!([0, 2, 3, 4, 5].map(|v| revision.vertex(v)), [Some(0), Some(2), None, Some(3), None]);
        let before = Positions::F64(vec![[0.0; 3], [0.0; 3], [1.0; 3], [0.0; 3], [0.0; 3]]);
        assert_eq!([0, 2, 3, 4].map(|v| revision.moved(&before, v)), [None, Some(2), None, None]);
    }

    #[test]
    fn a_flip_alone_is_a_change() {
        let before = Positions::F64(vec![[0.0; 3]; 4]);
        let faces = Faces::of_triangles(vec![[0, 1, 2], [0, 2, 3]]);
        let sources = Sources { vertex: vec![0, 1, 2, 3], triangle: vec![0, 1], corner: vec![0, 1, 2, 3, 4, 5] };
        let changes = |triangles: &[[u32; 3]]| {
            Revision::of_mesh(before.clone(), triangles, &sources, 4, 2).0.changes(&before, &faces)
        };
        assert!(!changes(&[[0, 1, 2], [0, 2, 3]]));
        assert!(changes(&[[0, 1, 3], [1, 2, 3]]));
    }
}
