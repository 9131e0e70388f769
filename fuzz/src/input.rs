//! From bytes to meshes and options.

use qsmesh::{Boundary, Ideal, Method, Metric, Options, Order, Plane, TailOptions};

/// Bytes that are read once from front to back; zeros follow the last one.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    pub fn below(&mut self, bound: usize) -> usize {
        usize::from(self.byte()) % bound.max(1)
    }

    pub fn flag(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    pub fn word(&mut self) -> u64 {
        u64::from_le_bytes(std::array::from_fn(|_| self.byte()))
    }

    pub fn choice<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    /// Any bits at all in a quarter of the cases, else one of `usual`.
    pub fn number(&mut self, usual: &[f64]) -> f64 {
        if self.below(4) == 0 { f64::from_bits(self.word()) } else { self.choice(usual) }
    }
}

/// Positions and triangles.
pub struct Soup {
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

/// Sizes that arithmetic gets wrong.
const SIZES: [f64; 16] = [
    1.0, 1.0, 1.0, 1.0, 1e-3, 1e3, 1e-12, 1e12, 1e150, 1e-150, 1e300, 1e-300, 5e-324, 2.2e-308, f64::MAX, 1e8,
];

/// A soup of at most 64 vertices and 128 triangles: a grid that may be closed to a torus, with vertices moved and
/// triangles exchanged, or triangles between any vertices. Every coordinate is finite and every index in range.
pub fn soup(bytes: &mut Bytes<'_>) -> Soup {
    let (columns, rows) = (1 + bytes.below(8) as u32, 1 + bytes.below(8) as u32);
    let mut soup = match bytes.below(4) {
        0 => Soup { positions: vec![[0.0; 3]; (columns * rows) as usize], triangles: vec![] },
        kind => grid(columns, rows, kind > 1),
    };
    let edits = bytes.below(64);
    for _ in 0..edits {
        edit(&mut soup, bytes);
    }
    let (size, offset) = (bytes.choice(&SIZES), if bytes.below(8) == 0 { bytes.choice(&SIZES) } else { 0.0 });
    let placed = |x: &mut f64| *x = (*x * size + offset).clamp(-f64::MAX, f64::MAX);
    soup.positions.iter_mut().flatten().for_each(placed);
    soup
}

fn grid(columns: u32, rows: u32, closed: bool) -> Soup {
    let turn = |i: u32, n: u32| std::f64::consts::TAU * f64::from(i) / f64::from(n);
    let place = |i: u32, j: u32| {
        if !closed {
            return [f64::from(i), f64::from(j), 0.0];
        }
        let (u, v) = (turn(i, columns), turn(j, rows));
        [(3.0 + v.cos()) * u.cos(), (3.0 + v.cos()) * u.sin(), v.sin()]
    };
    let index = |i: u32, j: u32| (j % rows) * columns + i % columns;
    let cell = |i: u32, j: u32| {
        let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
        [[a, b, d], [b, c, d]]
    };
    let last = u32::from(!closed);
    let cells = (0..rows - last).flat_map(|j| (0..columns - last).map(move |i| (i, j)));
    Soup {
        positions: (0..rows).flat_map(|j| (0..columns).map(move |i| place(i, j))).collect(),
        triangles: cells.flat_map(|(i, j)| cell(i, j)).collect(),
    }
}

/// Moves one vertex, or adds, changes or repeats one triangle.
fn edit(soup: &mut Soup, bytes: &mut Bytes<'_>) {
    let (vertices, count) = (soup.positions.len(), soup.triangles.len());
    let v = bytes.below(vertices);
    match bytes.below(10) {
        0 => soup.positions[v] = soup.positions[bytes.below(vertices)],
        1 => soup.positions[v] = between(soup.positions[bytes.below(vertices)], soup.positions[v], bytes),
        2 => soup.positions[v][bytes.below(3)] = coordinate(bytes),
        3 => soup.positions[v] = std::array::from_fn(|_| coordinate(bytes)),
        4 | 5 => (0..3).for_each(|k| soup.positions[v][k] += (f64::from(bytes.byte()) - 128.0) / 256.0),
        6 if count > 0 => soup.triangles[bytes.below(count)][bytes.below(3)] = v as u32,
        7 if count > 0 => soup.triangles[bytes.below(count)].swap(0, 1),
        8 if count > 0 => drop(soup.triangles.swap_remove(bytes.below(count))),
        _ => soup.triangles.push([v, bytes.below(vertices), bytes.below(vertices)].map(|v| v as u32)),
    }
}

/// On the line through two points.
fn between(a: [f64; 3], b: [f64; 3], bytes: &mut Bytes<'_>) -> [f64; 3] {
    let t = bytes.choice(&[0.5, 0.25, 2.0, 1e-9, 1e-15]);
    std::array::from_fn(|k| (a[k] + t * (b[k] - a[k])).clamp(-f64::MAX, f64::MAX))
}

/// Finite.
pub fn coordinate(bytes: &mut Bytes<'_>) -> f64 {
    let x = bytes.number(&[0.0, -0.0, 1.0, -1.0, 0.5, 1e-300, -1e300, 5e-324, 1e-8, f64::MAX]);
    if x.is_finite() { x } else { f64::from(bytes.byte()) }
}

const METHODS: [Method; 5] = [
    Method::QuasiStatistical,
    Method::QuasiStatistical,
    Method::QuasiStatistical,
    Method::Laplacian,
    Method::TangentialLaplacian,
];
const METRICS: [Metric; 6] =
    [Metric::EdgeRatio, Metric::EdgeRatio, Metric::MinAngle, Metric::MaxAngle, Metric::Area, Metric::Shape];
const ORDERS: [Order; 5] = [Order::Colors, Order::Index, Order::Wave, Order::Tail, Order::Given];

/// Options of which any may lie outside its range.
pub fn options(bytes: &mut Bytes<'_>) -> Options {
    Options {
        iterations: bytes.choice(&[2, 0, 1, 3, 20, 10_001]),
        method: bytes.choice(&METHODS),
        metric: bytes.choice(&METRICS),
        keep_sizes: bytes.below(4) == 0,
        relaxation: bytes.number(&[1.2, 1e-9, 1.0, 1.6, 2.0, 2.0]),
        plane: bytes.choice(&[Plane::VectorArea, Plane::LeastSquares]),
        ideal: bytes.choice(&[Ideal::Modelled, Ideal::Equilateral]),
        interval_width: bytes.number(&[0.5, 0.001, 1000.0]),
        sample_limit: bytes.number(&[3.0, 1.0, 1e300]),
        quality_floor: bytes.number(&[0.5, 0.0, 1.0]),
        feature_angle: bytes.flag().then(|| bytes.number(&[30.0, 1e-9, 179.999])),
        boundary: bytes.choice(&[Boundary::Fixed, Boundary::Slide]),
        order: bytes.choice(&ORDERS),
        threads: bytes.choice(&[0, 1, 2, 1024, 1025]),
        max_deviation: bytes.flag().then(|| bytes.number(&[0.0, 0.01, 1.0, 5e-324, 1e300])),
        measure: bytes.below(4) > 0,
    }
}

/// The same for the tail.
pub fn tail_options(bytes: &mut Bytes<'_>) -> TailOptions<'static> {
    let attempts = bytes.choice(&[3, 1, 6, 0, 1001]);
    // A thousand attempts at each of a hundred triangles would take minutes.
    let is_bounded = bytes.flag() || attempts > 6;
    TailOptions {
        edge_ratio: bytes.number(&[3.0, 1.0 + 1e-15, 1e300, 1.5]),
        min_angle: bytes.number(&[20.0, 1e-300, 59.999, 30.0]),
        max_angle: bytes.number(&[130.0, 60.001, 179.999, 100.0]),
        flips: bytes.flag(),
        attempts,
        operations: is_bounded.then(|| bytes.below(8)),
        mask: &[],
    }
}

/// Marks some of `count` elements.
pub fn marks(bytes: &mut Bytes<'_>, count: usize) -> Vec<bool> {
    if bytes.flag() { (0..count).map(|_| bytes.below(4) == 0).collect() } else { vec![] }
}

/// Some vertices, in any order and more than once.
pub fn visits(bytes: &mut Bytes<'_>, vertices: usize) -> Vec<u32> {
    let count = if bytes.flag() { bytes.below(80) } else { 0 };
    (0..count).map(|_| bytes.below(vertices) as u32).collect()
}

/// Some pairs of vertices; rarely one out of range.
pub fn edges(bytes: &mut Bytes<'_>, vertices: usize) -> Vec<[u32; 2]> {
    let count = if bytes.flag() { bytes.below(12) } else { 0 };
    (0..count).map(|_| [bytes.below(vertices), bytes.below(vertices)].map(|v| v as u32)).collect()
}
