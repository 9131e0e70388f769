//! Surfaces that a mesh library would rather not meet.

use std::f64::consts::{PI, TAU};

use crate::meshes::{Mesh, Random, torus};

/// `valence` triangles around vertex 0, which lies off the middle; the rim is closed.
pub fn fan(valence: u32, height: f64) -> Mesh {
    let angle = |i: u32| TAU * f64::from(i) / f64::from(valence);
    let rim = (0..valence).map(|i| [angle(i).cos(), angle(i).sin(), 0.0]);
    let positions = std::iter::once([0.3, 0.2, height]).chain(rim).collect();
    (positions, (0..valence).map(|i| [0, 1 + i, 1 + (i + 1) % valence]).collect())
}

/// Two fans over one rim: closed, with two vertices of that valence.
pub fn spindle(valence: u32) -> Mesh {
    let (mut positions, mut triangles) = fan(valence, 0.5);
    positions.push([0.1, -0.2, -0.5]);
    let last = valence + 1;
    triangles.extend((0..valence).map(|i| [last, 1 + (i + 1) % valence, 1 + i]));
    (positions, triangles)
}

/// A band of `length` × `width` cells, closed after half a turn of its normal.
pub fn moebius(length: u32, width: u32) -> Mesh {
    let place = |i: u32, j: u32| {
        let (u, v) = (TAU * f64::from(i) / f64::from(length), f64::from(j) / f64::from(width) - 0.5);
        let radius = 2.0 + v * (0.5 * u).cos();
        [radius * u.cos(), radius * u.sin(), v * (0.5 * u).sin()]
    };
    let index = |i: u32, j: u32| if i < length { i * (width + 1) + j } else { width - j };
    let cell = |i, j| quad([index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)]);
    let positions = (0..length).flat_map(|i| (0..=width).map(move |j| place(i, j))).collect();
    (positions, (0..length).flat_map(|i| (0..width).flat_map(move |j| cell(i, j))).collect())
}

/// A figure of eight turned half round on its way: a Klein bottle that passes through itself, without boundary.
pub fn klein(length: u32, width: u32) -> Mesh {
    let place = |i: u32, j: u32| {
        let (u, v) = (TAU * f64::from(i) / f64::from(length), TAU * f64::from(j) / f64::from(width));
        let (c, s) = ((0.5 * u).cos(), (0.5 * u).sin());
        let radius = 3.0 + c * v.sin() - s * (2.0 * v).sin();
        [radius * u.cos(), radius * u.sin(), s * v.sin() + c * (2.0 * v).sin()]
    };
    let index = |i: u32, j: u32| {
        let j = j % width;
        if i < length { i * width + j } else { (width - j) % width }
    };
    let cell = |i, j| quad([index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)]);
    let positions = (0..length).flat_map(|i| (0..width).map(move |j| place(i, j))).collect();
    (positions, (0..length).flat_map(|i| (0..width).flat_map(move |j| cell(i, j))).collect())
}

fn quad([a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

/// All of them in one mesh, without common vertices.
pub fn together(parts: &[Mesh]) -> Mesh {
    let mut all: Mesh = (vec![], vec![]);
    for (positions, triangles) in parts {
        let first = all.0.len() as u32;
        all.0.extend(positions);
        all.1.extend(triangles.iter().map(|t| t.map(|v| v + first)));
    }
    all
}

/// Three tori, each inside the other; the innermost turned inside out.
pub fn nested() -> Mesh {
    let sized = |size: f64| scaled(torus(8, 6, 0.2, 5), size);
    let mut inner = sized(0.5);
    inner.1.iter_mut().for_each(|t| t.swap(0, 1));
    together(&[sized(1.0), sized(0.75), inner])
}

/// Two tori in one place, two that share a vertex, and two that share an edge.
pub fn touching() -> Mesh {
    let one = torus(8, 6, 0.2, 7);
    let (positions, mut triangles) = together(&[one.clone(), one.clone(), one.clone(), one]);
    let count = (positions.len() / 4) as u32;
    let [a, b, _] = triangles[0];
    for v in triangles.iter_mut().flatten() {
        *v = match *v {
            v if v == a + 2 * count => a + count,
            v if v == a + 3 * count => a,
            v if v == b + 3 * count => b,
            v => v,
        };
    }
    (positions, triangles)
}

/// A torus with every seventh vertex pulled far out, or through the surface to the other side.
pub fn spiky(length: f64) -> Mesh {
    let (mut positions, triangles) = torus(10, 7, 0.2, 3);
    positions.iter_mut().step_by(7).for_each(|p| *p = p.map(|x| x * length));
    (positions, triangles)
}

/// A closed surface squeezed so that every triangle is a needle of that ratio.
pub fn needles(ratio: f64) -> Mesh {
    let (mut positions, triangles) = torus(10, 7, 0.2, 11);
    positions.iter_mut().for_each(|p| p[0] *= ratio);
    (positions, triangles)
}

/// Edges of about `size` around a point that far from the origin.
pub fn far_away(distance: f64, size: f64) -> Mesh {
    let (mut positions, triangles) = scaled(torus(10, 7, 0.2, 13), size);
    positions.iter_mut().flatten().for_each(|x| *x += distance);
    (positions, triangles)
}

pub fn scaled((positions, triangles): Mesh, size: f64) -> Mesh {
    (positions.into_iter().map(|p| p.map(|x| x * size)).collect(), triangles)
}

/// A closed star-shaped saw blade of two layers: every vertex lies on sharp edges.
pub fn all_features() -> Mesh {
    let n = 24;
    let place = |i: u32, z: f64| {
        let (angle, radius) = (PI * f64::from(i) / f64::from(n / 2), if i.is_multiple_of(2) { 1.0 } else { 0.4 });
        [radius * angle.cos(), radius * angle.sin(), z]
    };
    let mut positions: Vec<_> = (0..n).map(|i| place(i, 0.0)).chain((0..n).map(|i| place(i, 0.3))).collect();
    positions.extend([[0.0, 0.0, -0.6], [0.0, 0.0, 0.9]]);
    let side = |i: u32| {
        let j = (i + 1) % n;
        let [wall, rest] = quad([i, j, j + n, i + n]);
        [wall, rest, [2 * n, j, i], [2 * n + 1, i + n, j + n]]
    };
    (positions, (0..n).flat_map(side).collect())
}

/// Triangles of two.
pub fn two_triangles() -> Mesh {
    (vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1e-3, 0.0], [0.0, 1.0, 0.5]], vec![[0, 1, 2], [0, 2, 3]])
}

/// The smallest closed surfaces: two triangles back to back, and a tetrahedron.
pub fn smallest_closed() -> [Mesh; 2] {
    let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.1, 0.1, 1.0]];
    let tetrahedron = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    [(corners[..3].to_vec(), vec![[0, 1, 2], [2, 1, 0]]), (corners, tetrahedron)]
}

/// Any triangles between any of these points.
pub fn soup(points: Vec<[f64; 3]>, triangles: usize, seed: u64) -> Mesh {
    let mut random = Random(seed);
    let count = points.len() as f64;
    let mut any = || ((random.signed() + 1.0) * 0.5 * count) as u32 % points.len() as u32;
    let triangles = (0..triangles).map(|_| [any(), any(), any()]).collect();
    (points, triangles)
}

/// All that has a name.
pub fn all() -> Vec<(String, Mesh)> {
    let mut all: Vec<(String, Mesh)> = Vec::new();
    let mut add = |name: &str, mesh: Mesh| all.push((name.to_string(), mesh));
    for valence in [3, 4, 5, 17, 40] {
        add(&format!("fan of {valence}"), fan(valence, 0.1));
        add(&format!("spindle of {valence}"), spindle(valence));
    }
    add("Moebius strip", moebius(12, 3));
    add("Klein bottle", klein(12, 8));
    add("nested", nested());
    add("touching", touching());
    for length in [1.5, -1.5, 1e3, 1e9] {
        add(&format!("spikes of {length}"), spiky(length));
    }
    for ratio in [1e-2, 1e-5, 1e-9, 1e-15, 0.0, 1e6] {
        add(&format!("needles of {ratio}"), needles(ratio));
    }
    for size in [1e-300, 1e-150, 1e-12, 1e-6, 1e6, 1e12, 1e150, 1e300] {
        add(&format!("size {size}"), scaled(torus(9, 6, 0.3, 17), size));
    }
    add("far from the origin", far_away(1e8, 1e-3));
    add("farther than its digits reach", far_away(1e16, 1e-3));
    add("all features", all_features());
    add("two triangles", two_triangles());
    let [flat, tetrahedron] = smallest_closed();
    add("back to back", flat);
    add("tetrahedron", tetrahedron);
    add("one triangle", (vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]));
    add("vertices without triangles", (vec![[1.0; 3]; 5], vec![]));
    add("nothing", (vec![], vec![]));
    add("one point", soup(vec![[1.0; 3]; 30], 80, 1));
    add("one line", soup((0..30).map(|i| [f64::from(i), 2.0 * f64::from(i), 0.0]).collect(), 80, 2));
    add("one plane", soup((0..30).map(|i| [f64::from(i % 6), f64::from(i / 6), 0.0]).collect(), 80, 3));
    add("largest numbers", soup(vec![[f64::MAX; 3], [-f64::MAX; 3], [0.0; 3], [5e-324; 3]], 20, 4));
    all
}
