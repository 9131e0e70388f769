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
use fearless_simd::{f64x8, mask64x8};

/// A number for each of [`STARS`](Number::STARS) stars.
pub(crate) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// How many stars.
    const STARS: usize;
    /// What vouches for the instruction set.
    type Token: Copy;
    /// A truth for each star.
    type Truth: Copy + BitAnd<Output = Self::Truth> + BitOr<Output = Self::Truth> + Not<Output = Self::Truth>;
    /// The number in memory, one entry a star.
    type Row: Copy + Default + AsRef<[f64]> + AsMut<[f64]>;
    /// A vertex for each star.
    type Vertices: Copy + Default + AsRef<[u32]> + AsMut<[u32]>;

    /// `value` for every star.
    fn splat(token: Self::Token, value: f64) -> Self;
    /// From memory.
    fn load(token: Self::Token, row: &Self::Row) -> Self;
    /// Into memory.
    fn store(self, row: &mut Self::Row);
    /// Square root.
    fn root(self) -> Self;
    /// Rounded up.
    fn ceil(self) -> Self;
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

    /// The values for the stars.
    #[inline(always)]
    fn row(self) -> Self::Row {
        let mut row = Self::Row::default();
        self.store(&mut row);
        row
    }
}

impl Number for f64 {
    const STARS: usize = 1;
    type Token = ();
    type Truth = bool;
    type Row = [f64; 1];
    type Vertices = [u32; 1];

    #[inline(always)]
    fn splat((): (), value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn load((): (), &[value]: &[f64; 1]) -> Self {
        value
    }
    #[inline(always)]
    fn store(self, row: &mut [f64; 1]) {
        *row = [self];
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn ceil(self) -> Self {
        self.ceil()
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

/// Eight numbers in one line of the cache: what straddles two costs twice.
#[derive(Clone, Copy, Default)]
#[repr(align(64))]
pub(crate) struct Line([f64; 8]);

impl AsRef<[f64]> for Line {
    #[inline(always)]
    fn as_ref(&self) -> &[f64] {
        &self.0
    }
}

impl AsMut<[f64]> for Line {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [f64] {
        &mut self.0
    }
}

impl<S: Simd> Number for f64x8<S> {
    const STARS: usize = 8;
    type Token = S;
    type Truth = mask64x8<S>;
    type Row = Line;
    type Vertices = [u32; 8];

    #[inline(always)]
    fn splat(simd: S, value: f64) -> Self {
        SimdBase::splat(simd, value)
    }
    #[inline(always)]
    fn load(simd: S, row: &Line) -> Self {
        Self::load_array_ref(simd, &row.0)
    }
    #[inline(always)]
    fn store(self, row: &mut Line) {
        self.store_array(&mut row.0);
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn ceil(self) -> Self {
        SimdFloat::ceil(self)
    }
    #[inline(always)]
    fn below(self, other: Self) -> mask64x8<S> {
        self.simd_lt(other)
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> mask64x8<S> {
        self.simd_le(other)
    }
    #[inline(always)]
    fn equals(self, other: Self) -> mask64x8<S> {
        self.simd_eq(other)
    }
    #[inline(always)]
    fn choose(truth: mask64x8<S>, yes: Self, no: Self) -> Self {
        truth.select(yes, no)
    }
    #[inline(always)]
    fn bits(truth: mask64x8<S>) -> u64 {
        truth.to_bitmask()
    }
    #[inline(always)]
    fn any(truth: mask64x8<S>) -> bool {
        truth.any_true()
    }
}
