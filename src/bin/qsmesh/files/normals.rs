//! Normals from positions.

use super::positions::Positions;

/// Sum of the area vectors of the triangles around each vertex, of unit length; `None` where they add up to nothing.
pub fn of_vertices(positions: &Positions, triangles: &[[u32; 3]]) -> Vec<Option<[f64; 3]>> {
    let mut sums = vec![[0.0; 3]; positions.len()];
    for triangle in triangles {
        let area = area_vector(triangle.map(|v| positions.at(v as usize)));
        for &vertex in triangle {
            for axis in 0..3 {
                sums[vertex as usize][axis] += area[axis];
            }
        }
    }
    sums.into_iter().map(unit).collect()
}

/// Unit normal of a triangle; zero for one without area.
pub fn of_triangle(corners: [[f64; 3]; 3]) -> [f64; 3] {
    unit(area_vector(corners)).unwrap_or([0.0; 3])
}

fn area_vector([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let u = [0, 1, 2].map(|i| b[i] - a[i]);
    let v = [0, 1, 2].map(|i| c[i] - a[i]);
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = vector[0].hypot(vector[1]).hypot(vector[2]);
    (length > 0.0 && length.is_finite()).then(|| vector.map(|x| x / length))
}

#[cfg(test)]
mod tests {
    use super::{of_triangle, of_vertices};
    use crate::files::positions::Positions;

    #[test]
    fn larger_triangles_weigh_more() {
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 3.0], [9.0; 3]];
        let normals = of_vertices(&Positions::F64(points), &[[0, 1, 2], [0, 2, 3]]);
        let root = 10.0_f64.sqrt();
        assert_eq!(normals[0], Some([3.0 / root, 0.0, 1.0 / root]));
        assert_eq!(normals[1], Some([0.0, 0.0, 1.0]));
        assert_eq!(normals[4], None);
    }

    #[test]
    fn no_area_no_normal() {
        assert_eq!(of_triangle([[0.0; 3], [1.0; 3], [2.0; 3]]), [0.0; 3]);
    }
}
