//! Tangent planes: where a star is flattened.

use fearless_simd::prelude::*;
use glam::{DMat3, DVec2, DVec3};

use super::lanes::Vectors;

/// A plane through the centre of a star, as two orthonormal directions; seen against the normal, the first turns
/// counter-clockwise into the second.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct TangentPlane {
    u: DVec3,
    w: DVec3,
}

impl TangentPlane {
    /// Orthogonal to `normal`, which need not be of unit length; `None` if it has no direction.
    pub fn orthogonal_to(normal: DVec3) -> Option<Self> {
        let mut plane = Self::default();
        plane.turn(normal).then_some(plane)
    }

    /// Turns it orthogonal to `normal`; false if that has no direction.
    #[inline(always)]
    pub fn turn(&mut self, normal: DVec3) -> bool {
        let inverse = 1.0 / normal.length();
        let n = normal * inverse;
        // Needs no root and no choice of an axis: T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6 (2017).
        let sign = 1.0_f64.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        self.u = DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
        self.w = DVec3::new(b, sign + n.y * n.y * a, -n.y);
        inverse > 0.0 && inverse < f64::INFINITY
    }

    /// Its two directions in every lane.
    #[inline(always)]
    pub fn lanes<S: Simd>(&self, simd: S) -> [Vectors<S>; 2] {
        [Vectors::splat(simd, self.u), Vectors::splat(simd, self.w)]
    }

    /// Coordinates of a point in the plane.
    pub fn project(&self, p: DVec3) -> DVec2 {
        DVec2::new(p.dot(self.u), p.dot(self.w))
    }

    /// The point of the plane with these coordinates.
    #[inline(always)]
    pub fn lift(&self, p: DVec2) -> DVec3 {
        self.u * p.x + self.w * p.y
    }
}

/// Normal of the least-squares plane of the centre and the rim (Hoppe et al., SIGGRAPH 1992), turned to the side of
/// `outward`.
pub(super) fn least_squares(rim: impl Iterator<Item = DVec3> + Clone, outward: DVec3) -> DVec3 {
    let count = rim.clone().count() as f64 + 1.0;
    let mean = rim.clone().sum::<DVec3>() / count;
    let mut covariance = outer(mean);
    for p in rim {
        covariance += outer(p - mean);
    }
    let normal = least_eigenvector(covariance);
    if normal.dot(outward) < 0.0 { -normal } else { normal }
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
