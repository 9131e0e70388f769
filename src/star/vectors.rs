//! Vectors and points of a plane, one for each of several stars.

use glam::{DVec2, DVec3};

use super::number::{Arithmetic, Number};

/// A vector for each star.
#[derive(Clone, Copy)]
pub(crate) struct Vectors<N> {
    pub x: N,
    pub y: N,
    pub z: N,
}

impl<N: Number> Vectors<N> {
    #[inline(always)]
    pub fn load(token: N::Token, [x, y, z]: &[N::Row; 3]) -> Self {
        Self { x: N::load(token, x), y: N::load(token, y), z: N::load(token, z) }
    }

    #[inline(always)]
    pub fn store(self, [x, y, z]: &mut [N::Row; 3]) {
        self.x.store(x);
        self.y.store(y);
        self.z.store(z);
    }

    /// The vectors of the stars.
    #[inline(always)]
    pub fn rows(self) -> [N::Row; 3] {
        [self.x.row(), self.y.row(), self.z.row()]
    }

    /// Rounded to single precision.
    #[inline(always)]
    pub fn single(self) -> Vectors<N::Single> {
        Vectors { x: self.x.single(), y: self.y.single(), z: self.z.single() }
    }
}

impl<N: Arithmetic> Vectors<N> {
    #[inline(always)]
    pub fn zero(token: N::Token) -> Self {
        let zero = N::splat(token, 0.0);
        Self { x: zero, y: zero, z: zero }
    }

    #[inline(always)]
    pub fn plus(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }

    #[inline(always)]
    pub fn minus(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }

    #[inline(always)]
    pub fn times(self, factor: N) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }

    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> N {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub fn square(self) -> N {
        self.dot(self)
    }

    /// Where all coordinates are 0.
    #[inline(always)]
    pub fn is_zero(self, token: N::Token) -> N::Truth {
        let zero = N::splat(token, 0.0);
        self.x.equals(zero) & self.y.equals(zero) & self.z.equals(zero)
    }

    /// `yes` where `truth` holds, else `no`.
    #[inline(always)]
    pub fn choose(truth: N::Truth, yes: Self, no: Self) -> Self {
        Self { x: N::choose(truth, yes.x, no.x), y: N::choose(truth, yes.y, no.y), z: N::choose(truth, yes.z, no.z) }
    }
}

/// The vector of star number `star` in rows.
#[inline(always)]
pub(crate) fn vector<R: AsRef<[f64]>>([x, y, z]: &[R; 3], star: usize) -> DVec3 {
    DVec3::new(x.as_ref()[star], y.as_ref()[star], z.as_ref()[star])
}

/// Writes the vector of star number `star` into rows.
#[inline(always)]
pub(crate) fn set_vector<R: AsMut<[f64]>>([x, y, z]: &mut [R; 3], star: usize, vector: DVec3) {
    x.as_mut()[star] = vector.x;
    y.as_mut()[star] = vector.y;
    z.as_mut()[star] = vector.z;
}

impl From<DVec3> for Vectors<f64> {
    #[inline(always)]
    fn from(v: DVec3) -> Self {
        Self { x: v.x, y: v.y, z: v.z }
    }
}

impl From<Vectors<f64>> for DVec3 {
    #[inline(always)]
    fn from(v: Vectors<f64>) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

/// A point of a plane for each star.
#[derive(Clone, Copy)]
pub(crate) struct Points<N> {
    pub x: N,
    pub y: N,
}

impl<N: Number> Points<N> {
    #[inline(always)]
    pub fn zero(token: N::Token) -> Self {
        let zero = N::splat(token, 0.0);
        Self { x: zero, y: zero }
    }

    #[inline(always)]
    pub fn load(token: N::Token, [x, y]: &[N::Row; 2]) -> Self {
        Self { x: N::load(token, x), y: N::load(token, y) }
    }

    #[inline(always)]
    pub fn store(self, [x, y]: &mut [N::Row; 2]) {
        self.x.store(x);
        self.y.store(y);
    }

    #[inline(always)]
    pub fn square(self) -> N {
        self.x * self.x + self.y * self.y
    }

    #[inline(always)]
    pub fn plus(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }

    #[inline(always)]
    pub fn minus(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }

    /// Zero where `truth` does not hold.
    #[inline(always)]
    pub fn only(self, token: N::Token, truth: N::Truth) -> Self {
        Self { x: self.x.only(token, truth), y: self.y.only(token, truth) }
    }
}

impl From<DVec2> for Points<f64> {
    fn from(p: DVec2) -> Self {
        Self { x: p.x, y: p.y }
    }
}
