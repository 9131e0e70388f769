//! Numbers of one star or of several stars side by side, with one set of operations.
//!
//! The method is written once, for any such number: [`f64`] works on one star, eight lanes work on eight. A lane is only ever
//! added, multiplied, divided, rooted, rounded up and compared with the same lane of other numbers, so a star gets the same
//! bits alone, in company, and on every instruction set. Nothing is fused, approximated, or left to how a machine takes
//! the minimum of a NaN.
//!
//! Whatever handles numbers is `inline(always)` and calls nothing that is not, no closure of its own included: only what
//! ends up inside `dispatch!` is compiled for the instruction set that was chosen.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f64x8, mask32x8, mask64x8};

/// What can be done with numbers of any precision, one for each of several stars.
pub(crate) trait Arithmetic:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// What vouches for the instruction set.
    type Token: Copy;
    /// A truth for each star.
    type Truth: Copy + BitAnd<Output = Self::Truth> + BitOr<Output = Self::Truth> + Not<Output = Self::Truth>;

    /// `value` for every star.
    fn splat(token: Self::Token, value: f64) -> Self;
    /// Square root.
    fn root(self) -> Self;
    /// Where `self < other`.
    fn below(self, other: Self) -> Self::Truth;
    /// Where `self <= other`.
    fn at_most(self, other: Self) -> Self::Truth;
    /// Where `self == other`.
    fn equals(self, other: Self) -> Self::Truth;
    /// `yes` where `truth` holds, else `no`.
    fn choose(truth: Self::Truth, yes: Self, no: Self) -> Self;
    /// The truth for each star, in the bits of a number.
    fn bits(truth: Self::Truth) -> u64;
    /// Whether it holds for any star.
    fn any(truth: Self::Truth) -> bool;

    /// `self` where `truth` holds, else 0.
    #[inline(always)]
    fn only(self, token: Self::Token, truth: Self::Truth) -> Self {
        Self::choose(truth, self, Self::splat(token, 0.0))
    }

    /// The lesser of two numbers, neither of which is NaN.
    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        Self::choose(self.below(other), self, other)
    }
}

/// A number for each of [`STARS`](Number::STARS) stars, as exact as all results are.
pub(crate) trait Number: Arithmetic {
    /// How many stars.
    const STARS: usize;
    /// The number in memory, one entry a star.
    type Row: Copy + Default + AsRef<[f64]> + AsMut<[f64]>;
    /// A vertex for each star.
    type Vertices: Copy + Default + AsRef<[u32]> + AsMut<[u32]>;
    /// The same in single precision.
    type Single: Single<Token = Self::Token>;

    /// From memory.
    fn load(token: Self::Token, row: &Self::Row) -> Self;
    /// Into memory.
    fn store(self, row: &mut Self::Row);
    /// Rounded up.
    fn ceil(self) -> Self;
    /// Rounded to single precision.
    fn single(self) -> Self::Single;

    /// The values for the stars.
    #[inline(always)]
    fn row(self) -> Self::Row {
        let mut row = Self::Row::default();
        self.store(&mut row);
        row
    }
}

/// A number in single precision for each star: good enough to see that something holds by far, and half the work.
pub(crate) trait Single: Arithmetic {
    /// The number in memory, one entry a star.
    type Row: Copy + Default + AsRef<[f32]> + AsMut<[f32]>;

    /// From memory.
    fn load(token: Self::Token, row: &Self::Row) -> Self;
    /// The values for the stars.
    fn row(self) -> Self::Row;
}

/// What is the same for one number whatever its precision.
macro_rules! alone {
    ($float:ty) => {
        impl Arithmetic for $float {
            type Token = ();
            type Truth = bool;

            #[inline(always)]
            fn splat((): (), value: f64) -> Self {
                value as Self
            }
            #[inline(always)]
            fn root(self) -> Self {
                self.sqrt()
            }
            #[inline(always)]
            fn below(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn at_most(self, other: Self) -> bool {
                self <= other
            }
            #[inline(always)]
            fn equals(self, other: Self) -> bool {
                self == other
            }
            #[inline(always)]
            fn choose(truth: bool, yes: Self, no: Self) -> Self {
                if truth { yes } else { no }
            }
            #[inline(always)]
            fn bits(truth: bool) -> u64 {
                u64::from(truth)
            }
            #[inline(always)]
            fn any(truth: bool) -> bool {
                truth
            }
        }
    };
}

alone!(f64);
alone!(f32);

impl Number for f64 {
    const STARS: usize = 1;
    type Row = [f64; 1];
    type Vertices = [u32; 1];
    type Single = f32;

    #[inline(always)]
    fn load((): (), &[value]: &[f64; 1]) -> Self {
        value
    }
    #[inline(always)]
    fn store(self, row: &mut [f64; 1]) {
        *row = [self];
    }
    #[inline(always)]
    fn ceil(self) -> Self {
        self.ceil()
    }
    #[inline(always)]
    fn single(self) -> f32 {
        self as f32
    }
}

impl Single for f32 {
    type Row = [f32; 1];

    #[inline(always)]
    fn load((): (), &[value]: &[f32; 1]) -> Self {
        value
    }
    #[inline(always)]
    fn row(self) -> [f32; 1] {
        [self]
    }
}

/// Eight numbers in one line of the cache: what straddles two costs twice.
#[derive(Clone, Copy, Default)]
#[repr(align(64))]
pub(crate) struct Line([f64; 8]);

/// Eight numbers in half of one.
#[derive(Clone, Copy, Default)]
#[repr(align(32))]
pub(crate) struct HalfLine([f32; 8]);

/// Entries of a row.
macro_rules! entries {
    ($row:ty, $float:ty) => {
        impl AsRef<[$float]> for $row {
            #[inline(always)]
            fn as_ref(&self) -> &[$float] {
                &self.0
            }
        }

        impl AsMut<[$float]> for $row {
            #[inline(always)]
            fn as_mut(&mut self) -> &mut [$float] {
                &mut self.0
            }
        }
    };
}

entries!(Line, f64);
entries!(HalfLine, f32);

/// What is the same for eight numbers whatever their precision.
macro_rules! company {
    ($lanes:ident, $mask:ident) => {
        impl<S: Simd> Arithmetic for $lanes<S> {
            type Token = S;
            type Truth = $mask<S>;

            #[inline(always)]
            fn splat(simd: S, value: f64) -> Self {
                SimdBase::splat(simd, value as _)
            }
            #[inline(always)]
            fn root(self) -> Self {
                self.sqrt()
            }
            #[inline(always)]
            fn below(self, other: Self) -> $mask<S> {
                self.simd_lt(other)
            }
            #[inline(always)]
            fn at_most(self, other: Self) -> $mask<S> {
                self.simd_le(other)
            }
            #[inline(always)]
            fn equals(self, other: Self) -> $mask<S> {
                self.simd_eq(other)
            }
            #[inline(always)]
            fn choose(truth: $mask<S>, yes: Self, no: Self) -> Self {
                truth.select(yes, no)
            }
            #[inline(always)]
            fn bits(truth: $mask<S>) -> u64 {
                truth.to_bitmask()
            }
            #[inline(always)]
            fn any(truth: $mask<S>) -> bool {
                truth.any_true()
            }
        }
    };
}

company!(f64x8, mask64x8);
company!(f32x8, mask32x8);

impl<S: Simd> Number for f64x8<S> {
    const STARS: usize = 8;
    type Row = Line;
    type Vertices = [u32; 8];
    type Single = f32x8<S>;

    #[inline(always)]
    fn load(simd: S, row: &Line) -> Self {
        Self::load_array_ref(simd, &row.0)
    }
    #[inline(always)]
    fn store(self, row: &mut Line) {
        self.store_array(&mut row.0);
    }
    #[inline(always)]
    fn ceil(self) -> Self {
        SimdFloat::ceil(self)
    }
    #[inline(always)]
    fn single(self) -> f32x8<S> {
        let (low, high) = self.split();
        low.narrow(high)
    }
}

impl<S: Simd> Single for f32x8<S> {
    type Row = HalfLine;

    #[inline(always)]
    fn load(simd: S, row: &HalfLine) -> Self {
        Self::load_array_ref(simd, &row.0)
    }
    #[inline(always)]
    fn row(self) -> HalfLine {
        let mut row = HalfLine::default();
        self.store_array(&mut row.0);
        row
    }
}
