//! Small meshes for tests.

use std::f64::consts::TAU;

pub type Point = [f64; 3];

/// Positions and triangles.
#[derive(Clone, PartialEq)]
pub struct Soup {
    pub positions: Vec<Point>,
    pub triangles: Vec<[u32; 3]>,
}

impl std::fmt::Debug for Soup {
    /// Long lists help nobody.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} vertices, {} triangles", self.positions.len(), self.triangles.len())?;
        if self.triangles.len() < 40 { write!(f, ": {:?} {:?}", self.positions, self.triangles) } else { Ok(()) }
    }
}

/// A lattice of equilateral triangles in the plane z = 0, `n` × `n` vertices with edges of length 1.
pub fn lattice(n: u32) -> Soup {
    let height = 0.75_f64.sqrt();
    let at = |i: u32, j: u32| [f64::from(i) + 0.5 * f64::from(j), height * f64::from(j), 0.0];
    let positions = (0..n).flat_map(|j| (0..n).map(move |i| at(i, j))).collect();
    Soup { positions, triangles: grid_triangles(n, n, false) }
}

/// Two triangles for each cell of a grid with `columns` × `rows` vertices, wrapped around both ways for a torus.
fn grid_triangles(columns: u32, rows: u32, wrapped: bool) -> Vec<[u32; 3]> {
    let last = u32::from(!wrapped);
    let index = |i: u32, j: u32| (j % rows) * columns + i % columns;
    let cell = |i: u32, j: u32| {
        let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
        [[a, b, d], [b, c, d]]
    };
    (0..rows - last).flat_map(|j| (0..columns - last).flat_map(move |i| cell(i, j))).collect()
}

/// A closed torus about the z axis, `around` vertices the long way and `across` the short.
pub fn torus(around: u32, across: u32) -> Soup {
    let point = |i: u32, j: u32| {
        let (u, v) = (TAU * f64::from(i) / f64::from(around), TAU * f64::from(j) / f64::from(across));
        let radius = 3.0 + v.cos();
        [radius * u.cos(), radius * u.sin(), v.sin()]
    };
    let positions = (0..across).flat_map(|j| (0..around).map(move |i| point(i, j))).collect();
    Soup { positions, triangles: grid_triangles(around, across, true) }
}

/// A sphere of radius 1: an octahedron whose triangles were divided `levels` times.
pub fn sphere(levels: u32) -> Soup {
    let mut positions =
        vec![[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let mut triangles = vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..levels {
        triangles = divided(&mut positions, &triangles);
    }
    Soup { positions, triangles }
}

fn divided(positions: &mut Vec<Point>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles = std::collections::BTreeMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let [p, q] = [positions[a as usize], positions[b as usize]];
            let sum: Point = std::array::from_fn(|k| p[k] + q[k]);
            let length = sum.iter().map(|x| x * x).sum::<f64>().sqrt();
            positions.push(sum.map(|x| x / length));
            positions.len() as u32 - 1
        })
    };
    let quarter = |&[a, b, c]: &[u32; 3]| {
        let (x, y, z) = (middle(a, b), middle(b, c), middle(c, a));
        [[a, x, z], [x, b, y], [z, y, c], [x, y, z]]
    };
    triangles.iter().flat_map(quarter).collect()
}

/// A height field over a square grid, with boundary.
pub fn height_field(n: u32) -> Soup {
    let point = |i: u32, j: u32| {
        let (x, y) = (f64::from(i), f64::from(j));
        [x, y, (0.5 * x).sin() + (0.4 * y).cos()]
    };
    let positions = (0..n).flat_map(|j| (0..n).map(move |i| point(i, j))).collect();
    Soup { positions, triangles: grid_triangles(n, n, false) }
}

/// A tube with triangular cross-section of side 0.3 along the x axis, closed by a triangle at either end: its
/// cross-sections are cycles of three edges without a face.
pub fn triangular_tube(length: u32) -> Soup {
    let corner = |i: u32, k: u32| {
        let angle = TAU * f64::from(k) / 3.0;
        [f64::from(i), 0.3 * angle.cos(), 0.3 * angle.sin()]
    };
    let positions = (0..=length).flat_map(|i| (0..3).map(move |k| corner(i, k))).collect();
    let index = |i: u32, k: u32| 3 * i + k % 3;
    let wall = |i: u32, k: u32| {
        let [a, b, c, d] = [index(i, k), index(i + 1, k), index(i + 1, k + 1), index(i, k + 1)];
        [[a, c, b], [a, d, c]]
    };
    let mut triangles: Vec<_> = (0..length).flat_map(|i| (0..3).flat_map(move |k| wall(i, k))).collect();
    triangles.push([0, 2, 1].map(|k| index(0, k)).map(|v| v));
    triangles.push([0, 1, 2].map(|k| index(length, k)));
    for t in &mut triangles {
        t.swap(1, 2);
    }
    Soup { positions, triangles }
}

impl Soup {
    /// Moves each vertex by a repeatable amount of at most `size` in each coordinate.
    pub fn jittered(mut self, seed: u64, size: f64) -> Self {
        let mut state = seed.wrapping_mul(2).wrapping_add(1);
        for x in self.positions.iter_mut().flatten() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            *x += size * ((state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0);
        }
        self
    }

    /// Splits vertex `v` into two, `gap` apart along x: the second one takes over the ring vertices after `from` up to `to`,
    /// and both get the two new triangles there.
    pub fn with_split_vertex(mut self, v: u32, from: u32, to: u32, gap: f64) -> Self {
        let twin = self.positions.len() as u32;
        let mut place = self.positions[v as usize];
        self.positions[v as usize][0] += 0.5 * gap;
        place[0] -= 0.5 * gap;
        self.positions.push(place);
        let mut at = from;
        while at != to {
            let next = |t: &&mut [u32; 3]| (0..3).any(|k| t[k] == v && t[(k + 1) % 3] == at);
            let triangle = self.triangles.iter_mut().find(next).expect("the ring leads from one to the other");
            at = *triangle.iter().find(|&&x| x != v && x != at).expect("three corners");
            triangle.iter_mut().filter(|x| **x == v).for_each(|x| *x = twin);
        }
        self.triangles.extend([[v, from, twin], [twin, to, v]]);
        self
    }

    /// Puts a new vertex into triangle `t`, with these weights of its corners.
    pub fn with_vertex_inside(mut self, t: usize, weights: Point) -> Self {
        let [a, b, c] = self.triangles[t];
        let corners = self.triangles[t].map(|v| self.positions[v as usize]);
        let place = std::array::from_fn(|k| (0..3).map(|i| weights[i] * corners[i][k]).sum());
        let v = self.positions.len() as u32;
        self.positions.push(place);
        self.triangles[t] = [a, b, v];
        self.triangles.extend([[b, c, v], [c, a, v]]);
        self
    }
}
