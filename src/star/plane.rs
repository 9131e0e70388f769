//! Tangent planes: where a star is flattened.

use glam::{DMat3, DVec2, DVec3};

/// A plane through the centre of a star, as two orthonormal directions; seen against the normal, the first turns
/// counter-clockwise into the second.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TangentPlane {
    u: DVec3,
    w: DVec3,
}

impl TangentPlane {
    /// Orthogonal to `normal`, which need not be of unit length; `None` if it has no direction.
    pub fn orthogonal_to(normal: DVec3) -> Option<Self> {
        let n = normal.try_normalize()?;
        // The axis that is farthest from the normal gives the best-conditioned direction.
        let size = n.abs();
        let axis = if size.x <= size.y && size.x <= size.z {
            DVec3::X
        } else if size.y <= size.z {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let u = axis.cross(n).try_normalize()?;
        Some(Self { u, w: n.cross(u) })
    }

    /// Least-squares plane of the centre and the rim (Hoppe et al., SIGGRAPH 1992), turned to the side of `outward`.
    pub fn least_squares(rim: &[DVec3], outward: DVec3) -> Option<Self> {
        let count = rim.len() as f64 + 1.0;
        let mean = rim.iter().sum::<DVec3>() / count;
        let mut covariance = outer(mean);
        for &p in rim {
            covariance += outer(p - mean);
        }
        let normal = least_eigenvector(covariance);
        Self::orthogonal_to(if normal.dot(outward) < 0.0 { -normal } else { normal })
    }

    /// Coordinates of a point in the plane.
    pub fn project(&self, p: DVec3) -> DVec2 {
        DVec2::new(p.dot(self.u), p.dot(self.w))
    }

    /// The point of the plane with these coordinates.
    pub fn lift(&self, p: DVec2) -> DVec3 {
        self.u * p.x + self.w * p.y
    }
}

fn outer(p: DVec3) -> DMat3 {
    DMat3::from_cols(p * p.x, p * p.y, p * p.z)
}

/// Eigenvector of the least eigenvalue of a symmetric matrix, by cyclic Jacobi rotations: basic operations and square
/// roots only, so that every machine finds the same bits.
fn least_eigenvector(matrix: DMat3) -> DVec3 {
    let mut a = matrix.to_cols_array_2d();
    let mut vectors = DMat3::IDENTITY.to_cols_array_2d();
    for _ in 0..12 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            rotate_away(&mut a, &mut vectors, p, q);
        }
    }
    let least = (0..3).min_by(|&i, &j| a[i][i].total_cmp(&a[j][j])).unwrap_or(0);
    DVec3::from_array(vectors[least])
}

/// One Jacobi rotation, which makes entry (p, q) vanish; row i of `vectors` is the i-th eigenvector so far.
fn rotate_away(a: &mut [[f64; 3]; 3], vectors: &mut [[f64; 3]; 3], p: usize, q: usize) {
    if a[p][q] == 0.0 {
        return;
    }
    let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    let c = 1.0 / (t * t + 1.0).sqrt();
    let s = t * c;
    for row in a.iter_mut() {
        (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
    }
    for k in 0..3 {
        (a[p][k], a[q][k]) = (c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]);
        (vectors[p][k], vectors[q][k]) = (c * vectors[p][k] - s * vectors[q][k], s * vectors[p][k] + c * vectors[q][k]);
    }
}
