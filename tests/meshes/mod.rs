//! Meshes that the tests make for themselves.
#![allow(dead_code)]

use spade::{DelaunayTriangulation, Point2, Triangulation};

/// Positions and triangles.
pub type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// A small deterministic generator (SplitMix64), so that a failing mesh can be made again from its seed.
pub struct Random(pub u64);

impl Random {
    /// Next number in −1..1.
    pub fn signed(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A torus of `rows` × `columns` quads, each cut in two, its vertices shaken along the surface by `jitter` of a cell.
pub fn torus(rows: u32, columns: u32, jitter: f64, seed: u64) -> Mesh {
    let mut random = Random(seed);
    let turn = std::f64::consts::TAU;
    let mut positions = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let s = turn * (f64::from(row) + jitter * random.signed()) / f64::from(rows);
            let t = turn * (f64::from(column) + jitter * random.signed()) / f64::from(columns);
            let radius = 2.0 + 0.7 * t.cos();
            positions.push([radius * s.cos(), radius * s.sin(), 0.7 * t.sin()]);
        }
    }
    let at = |row: u32, column: u32| (row % rows) * columns + column % columns;
    let cells = (0..rows).flat_map(|r| (0..columns).map(move |c| (r, c)));
    let triangles = cells.flat_map(|(r, c)| {
        let [a, b, d, e] = [at(r, c), at(r + 1, c), at(r + 1, c + 1), at(r, c + 1)];
        [[a, b, d], [a, d, e]]
    });
    (positions, triangles.collect())
}

/// An open height field over the unit square, (n + 1)² vertices, shaken in the plane by `jitter` of a cell inside.
pub fn sheet(n: u32, height: f64, jitter: f64, seed: u64) -> Mesh {
    let mut random = Random(seed);
    let mut positions = Vec::new();
    for row in 0..=n {
        for column in 0..=n {
            let inside = row > 0 && row < n && column > 0 && column < n;
            let shake = if inside { jitter } else { 0.0 };
            let x = (f64::from(column) + shake * random.signed()) / f64::from(n);
            let y = (f64::from(row) + shake * random.signed()) / f64::from(n);
            positions.push([x, y, height * (3.0 * x).sin() * (2.0 * y).cos()]);
        }
    }
    let at = |row: u32, column: u32| row * (n + 1) + column;
    let cells = (0..n).flat_map(|r| (0..n).map(move |c| (r, c)));
    let triangles = cells.flat_map(|(r, c)| {
        let [a, b, d, e] = [at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r + 1, c)];
        if (r + c) % 2 == 0 { [[a, b, d], [a, d, e]] } else { [[a, b, e], [b, d, e]] }
    });
    (positions, triangles.collect())
}

/// The Delaunay triangulation of random points in the unit square, its corners among them.
pub fn scattered(points: usize, seed: u64) -> Mesh {
    let mut random = Random(seed);
    let mut triangulation = DelaunayTriangulation::<Point2<f64>>::new();
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let inner = (0..points).map(|_| (0.5 + 0.5 * random.signed(), 0.5 + 0.5 * random.signed()));
    for (x, y) in square.into_iter().chain(inner) {
        triangulation.insert(Point2::new(x, y)).expect("a finite point");
    }
    let positions = triangulation.vertices().map(|v| [v.position().x, v.position().y, 0.0]).collect();
    let corner = |v: spade::handles::VertexHandle<'_, Point2<f64>>| v.index() as u32;
    let triangles = triangulation.inner_faces().map(|f| f.vertices().map(corner)).collect();
    (positions, triangles)
}

/// The surface of the cube −1..1, each side n × n quads, the vertices inside sides and edges shaken along them.
pub fn cube(n: u32, jitter: f64, seed: u64) -> Mesh {
    let mut random = Random(seed);
    let mut numbers = std::collections::BTreeMap::new();
    let mut positions: Vec<[f64; 3]> = Vec::new();
    let mut triangles = Vec::new();
    for side in 0..6 {
        let (axis, top) = (side / 2, side % 2 == 1);
        let mut at = |row: u32, column: u32| {
            let mut key = [0; 3];
            key[axis] = if top { n } else { 0 };
            key[(axis + 1) % 3] = if top { column } else { row };
            key[(axis + 2) % 3] = if top { row } else { column };
            *numbers.entry(key).or_insert_with(|| {
                let mut shaken = |k: u32| if k == 0 || k == n { 0.0 } else { jitter * random.signed() };
                let place = key.map(|k| 2.0 * (f64::from(k) + shaken(k)) / f64::from(n) - 1.0);
                positions.push(place);
                positions.len() as u32 - 1
            })
        };
        for (row, column) in (0..n).flat_map(|r| (0..n).map(move |c| (r, c))) {
            let corners = [at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)];
            triangles.push([corners[0], corners[1], corners[2]]);
            triangles.push([corners[0], corners[2], corners[3]]);
        }
    }
    (positions, triangles)
}

/// Rounds to what an f32 buffer holds.
pub fn to_f32(positions: &[[f64; 3]]) -> Vec<[f32; 3]> {
    positions.iter().map(|p| p.map(|x| x as f32)).collect()
}

/// Cross product of two sides of a triangle.
pub fn normal(positions: &[[f64; 3]], &[a, b, c]: &[u32; 3]) -> [f64; 3] {
    let [a, b, c] = [a, b, c].map(|v| positions[v as usize]);
    let u = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    let w = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
    [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]]
}

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The triangles that have turned by more than a right angle.
pub fn flipped(before: &[[f64; 3]], after: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<usize> {
    let turned = |t: &[u32; 3]| dot(normal(before, t), normal(after, t)) < 0.0;
    (0..triangles.len()).filter(|&t| turned(&triangles[t])).collect()
}

/// The triangles that are folded over: each of their corners has an average normal to the other side.
pub fn folded((positions, triangles): &Mesh) -> Vec<usize> {
    let mut sums = vec![[0.0; 3]; positions.len()];
    for t in triangles {
        let n = normal(positions, t);
        for &v in t {
            (0..3).for_each(|k| sums[v as usize][k] += n[k]);
        }
    }
    let opposed = |t: &[u32; 3]| t.iter().all(|&v| dot(sums[v as usize], normal(positions, t)) < 0.0);
    (0..triangles.len()).filter(|&t| opposed(&triangles[t])).collect()
}

/// Distance from a point to a mesh, by trying every triangle.
pub fn distance(point: [f64; 3], mesh: &Mesh) -> f64 {
    let sub = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let to_segment = |a: [f64; 3], b: [f64; 3]| {
        let (along, to) = (sub(b, a), sub(point, a));
        let t = (dot(to, along) / dot(along, along)).clamp(0.0, 1.0);
        let foot = sub(to, along.map(|x| x * t));
        dot(foot, foot).sqrt()
    };
    let to_triangle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.0[v as usize]);
        let upright = normal(&mesh.0, t);
        let square = dot(upright, upright);
        let height = dot(sub(point, a), upright) / square;
        let foot = sub(point, upright.map(|x| x * height));
        let inside = [(a, b), (b, c), (c, a)].iter().all(|&(p, q)| {
            let corner = [p, q, foot];
            dot(normal(&corner, &[0, 1, 2]), upright) >= 0.0
        });
        if inside { height.abs() * square.sqrt() } else { to_segment(a, b).min(to_segment(b, c)).min(to_segment(c, a)) }
    };
    mesh.1.iter().map(to_triangle).fold(f64::INFINITY, f64::min)
}

/// Mean-ratio shape of a triangle, from positions alone.
pub fn shape(positions: &[[f64; 3]], triangle: &[u32; 3]) -> f64 {
    let upright = normal(positions, triangle);
    let [a, b, c] = triangle.map(|v| positions[v as usize]);
    let square = |p: [f64; 3], q: [f64; 3]| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>();
    let sum = square(a, b) + square(b, c) + square(c, a);
    if sum > 0.0 { 12.0_f64.sqrt() * dot(upright, upright).sqrt() / sum } else { 0.0 }
}

/// Enclosed volume of a closed mesh.
pub fn volume((positions, triangles): &Mesh) -> f64 {
    let six = |t: &[u32; 3]| dot(positions[t[0] as usize], normal(positions, t));
    triangles.iter().map(six).sum::<f64>() / 6.0
}
