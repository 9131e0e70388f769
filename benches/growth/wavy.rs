//! The mesh that grows: a closed torus with waves on it, its vertices shaken, in single precision.

use std::f32::consts::TAU;

/// How far vertices are shaken, in cells, and how high the waves are and how many, over the small circle's radius.
const SHAKE: f32 = 0.35;
const WAVE: f32 = 0.05;
const WAVES: f32 = 7.0;

/// Positions and triangles; nothing else is held while they are made, so that they are all the memory that they took.
pub struct Wavy {
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

/// About `triangles` triangles. `permuted`: vertices and triangles in random order; else row by row.
pub fn wavy(triangles: u32, permuted: bool) -> Wavy {
    let columns = (f64::from(triangles) / 6.0).sqrt() as u32;
    let rows = triangles / 2 / columns;
    let numbers = Shuffle { count: rows * columns, seed: permuted.then_some(1) };
    let order = Shuffle { count: 2 * rows * columns, seed: permuted.then_some(2) };
    let mut positions = vec![[0.0; 3]; (rows * columns) as usize];
    for cell in 0..rows * columns {
        let shaken = |i: u32, n: u32, salt: u32| TAU * (i as f32 + SHAKE * signed(2 * cell + salt)) / n as f32;
        let (s, t) = (shaken(cell / columns, rows, 0), shaken(cell % columns, columns, 1));
        let small = 0.7 * (1.0 + WAVE * (WAVES * s).sin() * (WAVES * t).cos());
        let radius = 2.0 + small * t.cos();
        positions[numbers.of(cell) as usize] = [radius * s.cos(), radius * s.sin(), small * t.sin()];
    }
    let at = |row: u32, column: u32| numbers.of((row % rows) * columns + column % columns);
    let mut triangles = vec![[0; 3]; 2 * (rows * columns) as usize];
    for cell in 0..rows * columns {
        let (r, c) = (cell / columns, cell % columns);
        let [a, b, d, e] = [at(r, c), at(r + 1, c), at(r + 1, c + 1), at(r, c + 1)];
        triangles[order.of(2 * cell) as usize] = [a, b, d];
        triangles[order.of(2 * cell + 1) as usize] = [a, d, e];
    }
    Wavy { positions, triangles }
}

/// A number in −1..1 for each `i`.
fn signed(i: u32) -> f32 {
    (mixed(u64::from(i)) >> 40) as f32 / (1 << 23) as f32 - 1.0
}

/// The last step of SplitMix64.
fn mixed(i: u64) -> u64 {
    let z = i.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A random permutation of 0..count that is computed, not stored; the identity without a seed.
struct Shuffle {
    count: u32,
    seed: Option<u64>,
}

impl Shuffle {
    /// Four rounds of a Feistel network over the next even number of bits, until it lands inside the range.
    fn of(&self, i: u32) -> u32 {
        let Some(seed) = self.seed else { return i };
        let half = (u32::BITS - self.count.leading_zeros()).div_ceil(2);
        let mask = (1_u64 << half) - 1;
        let mut number = u64::from(i);
        loop {
            for round in 0..4 {
                let (high, low) = (number >> half, number & mask);
                number = (low << half) | ((high ^ mixed(low ^ (seed << 40) ^ (round << 36))) & mask);
            }
            if number < u64::from(self.count) {
                return number as u32;
            }
        }
    }
}
