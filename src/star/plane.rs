//! Tangent planes: where a star is flattened.

use glam::{DMat3, DVec2, DVec3};

use super::number::Number;
use super::vectors::{Points, Vectors};

/// A plane through the centre of each star, as two orthonormal directions; seen against the normal, the first turns
/// counter-clockwise into the second.
#[derive(Clone, Copy)]
pub(crate) struct TangentPlanes<N> {
    u: Vectors<N>,
    w: Vectors<N>,
}

/// The plane of a star alone.
pub(crate) type TangentPlane = TangentPlanes<f64>;

impl<N: Number> TangentPlanes<N> {
    /// Orthogonal to `normals`, which need not be of unit length, and where those have a direction at all.
    #[inline(always)]
    pub fn new(token: N::Token, normals: Vectors<N>) -> (Self, N::Truth) {
        let (zero, one) = (N::splat(token, 0.0), N::splat(token, 1.0));
        let inverse = one / normals.square().root();
        let n = normals.times(inverse);
        // Needs no root and no choice of an axis: T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6 (2017).
        let sign = N::choose(n.z.below(zero), zero - one, one);
        let a = (zero - one) / (sign + n.z);
        let b = n.x * n.y * a;
        let u = Vectors { x: one + sign * n.x * n.x * a, y: sign * b, z: zero - sign * n.x };
        let w = Vectors { x: b, y: sign + n.y * n.y * a, z: zero - n.y };
        let exist = zero.below(inverse) & inverse.below(N::splat(token, f64::INFINITY));
        (Self { u, w }, exist)
    }

    /// Coordinates of points in their planes.
    #[inline(always)]
    pub fn flatten(&self, points: Vectors<N>) -> Points<N> {
        Points { x: points.dot(self.u), y: points.dot(self.w) }
    }

    /// The points of the planes with these coordinates.
    #[inline(always)]
    pub fn raise(&self, points: Points<N>) -> Vectors<N> {
        self.u.times(points.x).plus(self.w.times(points.y))
    }
}

impl TangentPlane {
    /// Orthogonal to `normal`, which need not be of unit length; `None` if it has no direction.
    pub fn orthogonal_to(normal: DVec3) -> Option<Self> {
        let (plane, exists) = Self::new((), normal.into());
        exists.then_some(plane)
    }

    /// Coordinates of a point in the plane.
    pub fn project(&self, p: DVec3) -> DVec2 {
        let Points { x, y } = self.flatten(p.into());
        DVec2::new(x, y)
    }

    /// The point of the plane with these coordinates.
    pub fn lift(&self, p: DVec2) -> DVec3 {
        self.raise(p.into()).into()
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
