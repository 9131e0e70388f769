//! Meshes with the same bits on every machine: functions of the `libm` crate, not of the machine's C library.

use std::f64::consts::TAU;

/// Positions and triangles.
pub type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// A small deterministic generator (SplitMix64).
struct Random(u64);

impl Random {
    /// Next number in −1..1.
    fn signed(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A smooth closed surface: a torus of `rows` × `columns` cells, shaken along itself, its vertices numbered row by row.
pub fn torus(rows: u32, columns: u32) -> Mesh {
    let mut random = Random(1);
    let mut shaken = |i: u32, n: u32| TAU * (f64::from(i) + 0.5 * random.signed()) / f64::from(n);
    let mut positions = Vec::new();
    for cell in 0..rows * columns {
        let (s, t) = (shaken(cell / columns, rows), shaken(cell % columns, columns));
        let radius = 2.0 + 0.7 * libm::cos(t);
        positions.push([radius * libm::cos(s), radius * libm::sin(s), 0.7 * libm::sin(t)]);
    }
    let at = |row: u32, column: u32| (row % rows) * columns + column % columns;
    (positions, cells(rows, columns, at))
}

/// Creases, corners and a boundary: a strip folded sharply into `folds` roofs of `n` × `n` cells a side.
pub fn roofs(n: u32, folds: u32) -> Mesh {
    let (rows, columns) = (n, 2 * n * folds);
    let mut random = Random(2);
    let mut positions = Vec::new();
    for row in 0..=rows {
        for column in 0..=columns {
            let on_edge = [row, rows - row, column % n].contains(&0);
            let mut shaken = |i: u32| (f64::from(i) + if on_edge { 0.0 } else { 0.6 * random.signed() }) / f64::from(n);
            let (x, y) = (shaken(column), shaken(row));
            let height = x % 2.0;
            positions.push([x, y, height.min(2.0 - height)]);
        }
    }
    (positions, cells(rows, columns, |row, column| row * (columns + 1) + column))
}

/// The two triangles of each cell.
fn cells(rows: u32, columns: u32, at: impl Fn(u32, u32) -> u32) -> Vec<[u32; 3]> {
    let cell = |i: u32| {
        let (r, c) = (i / columns, i % columns);
        let [a, b, d, e] = [at(r, c), at(r + 1, c), at(r + 1, c + 1), at(r, c + 1)];
        [[a, d, b], [a, e, d]]
    };
    (0..rows * columns).flat_map(cell).collect()
}
