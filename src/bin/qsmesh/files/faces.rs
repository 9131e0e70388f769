//! Faces of a file: triangles for the library, polygons remembered.

use std::ops::Range;

use crate::failure::{Failure, Result};

/// A face that is no triangle.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    /// Number of the first triangle of its fan, or of the next face where it has too few corners for one.
    pub first_triangle: usize,
    /// Vertices around it.
    pub corners: Vec<u32>,
}

/// The faces in their order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Faces {
    /// All triangles; a polygon of n corners gives a fan of n − 2 around its first corner.
    pub triangles: Vec<[u32; 3]>,
    /// The faces that are no triangles, in their order.
    pub polygons: Vec<Polygon>,
    count: usize,
}

impl Faces {
    /// Appends a face after checking its indices; `name` says which face is to blame.
    pub fn push(&mut self, corners: &[i64], vertex_count: usize, name: impl FnOnce(usize) -> String) -> Result<()> {
        let good = |&x: &i64| u32::try_from(x).ok().filter(|&x| (x as usize) < vertex_count);
        let Some(corners) = corners.iter().map(good).collect::<Option<Vec<u32>>>() else {
            let index = corners.iter().find(|x| good(x).is_none()).copied().unwrap_or_default();
            let face = name(self.count);
            return Err(Failure::new(format!("{face} names vertex {index}, but there are {vertex_count} vertices")));
        };
        self.count += 1;
        match *corners.as_slice() {
            [a, b, c] => self.triangles.push([a, b, c]),
            _ => self.push_polygon(corners),
        }
        Ok(())
    }

    fn push_polygon(&mut self, corners: Vec<u32>) {
        let first_triangle = self.triangles.len();
        if let Some((&hub, rim)) = corners.split_first() {
            self.triangles.extend(rim.windows(2).map(|edge| [hub, edge[0], edge[1]]));
        }
        self.polygons.push(Polygon { first_triangle, corners });
    }

    /// From triangles alone.
    pub fn of_triangles(triangles: Vec<[u32; 3]>) -> Self {
        Self { count: triangles.len(), triangles, polygons: Vec::new() }
    }

    /// How many faces, of whatever number of corners.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Number of the first face that is no triangle, and of its corners.
    pub fn first_polygon(&self) -> Option<(usize, usize)> {
        self.polygons.first().map(|polygon| (polygon.first_triangle, polygon.corners.len()))
    }

    /// The triangles of each face, in the order of the file; none for a face with too few corners.
    pub fn fans(&self) -> Vec<Range<usize>> {
        let mut fans = Vec::with_capacity(self.count);
        let mut next = 0;
        for polygon in &self.polygons {
            fans.extend((next..polygon.first_triangle).map(|triangle| triangle..triangle + 1));
            next = polygon.first_triangle + polygon.corners.len().saturating_sub(2);
            fans.push(polygon.first_triangle..next);
        }
        fans.extend((next..self.triangles.len()).map(|triangle| triangle..triangle + 1));
        fans
    }

    /// Calls `visit` with the corners of each face in the order of the file.
    pub fn each(&self, mut visit: impl FnMut(&[u32]) -> Result<()>) -> Result<()> {
        let mut next = 0;
        for polygon in &self.polygons {
            for triangle in &self.triangles[next..polygon.first_triangle] {
                visit(triangle)?;
            }
            visit(&polygon.corners)?;
            next = polygon.first_triangle + polygon.corners.len().saturating_sub(2);
        }
        self.triangles[next..].iter().try_for_each(|triangle| visit(triangle))
    }
}

#[cfg(test)]
mod tests {
    use super::Faces;

    fn faces(list: &[&[i64]]) -> Faces {
        let mut faces = Faces::default();
        for corners in list {
            faces.push(corners, 9, |n| format!("face {n}")).unwrap();
        }
        faces
    }

    #[test]
    fn polygons_become_fans_and_come_back_in_order() {
        let list: [&[i64]; 6] = [&[0, 1], &[0, 1, 2], &[3, 4, 5, 6, 7], &[], &[1, 2, 3], &[4, 5, 6, 7]];
        let faces = faces(&list);
        let fan = [[0, 1, 2], [3, 4, 5], [3, 5, 6], [3, 6, 7], [1, 2, 3], [4, 5, 6], [4, 6, 7]];
        assert_eq!(faces.triangles, fan);
        assert_eq!(faces.first_polygon(), Some((0, 2)));
        assert_eq!(faces.fans(), [0..0, 0..1, 1..4, 4..4, 4..5, 5..7]);
        let mut seen: Vec<Vec<i64>> = Vec::new();
        let remember = |corners: &[u32]| {
            seen.push(corners.iter().map(|&x| i64::from(x)).collect());
            Ok(())
        };
        faces.each(remember).unwrap();
        assert_eq!(seen, list);
    }

    #[test]
    fn a_bad_index_names_the_face() {
        let mut faces = faces(&[&[0, 1, 2]]);
        for bad in [9, -1, i64::MAX] {
            let failure = faces.push(&[0, bad, 2], 9, |n| format!("face {n}")).unwrap_err().to_string();
            assert_eq!(failure, format!("face 1 names vertex {bad}, but there are 9 vertices"));
        }
        assert_eq!(faces.len(), 1);
    }
}
