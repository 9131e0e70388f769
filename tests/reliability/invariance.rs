//! What the result depends on, and what it does not.
//!
//! To the bit: a uniform scale by a power of two; new numbers that keep the order of the vertices, as unused vertices in
//! between give; the number of threads. To rounding: translation and any other scale; for sweeps also rotation, mirroring,
//! the winding of the whole mesh, the order of the triangles and where each begins. The tail searches in eight
//! directions that turn with the coordinate axes, and breaks ties by number, so there these lead to another result within
//! the promises, as do numbers that change the order of the vertices.

use qsmesh::progress::silent;
use qsmesh::{Constraints, Options, Order, Sources, TailOptions, improve, measure, smooth};

use crate::meshes::{Mesh, Random, scattered, torus};

type Point = [f64; 3];

/// Smoothing, and smoothing with the tail behind it, in both orders.
fn settings() -> Vec<(Options, bool)> {
    let tail = |order, feature_angle| (Options { order, feature_angle, ..Options::default() }, true);
    sweeps().into_iter().chain([tail(Order::Colors, Some(30.0)), tail(Order::Index, None)]).collect()
}

/// Smoothing in both orders, with and without features.
fn sweeps() -> Vec<(Options, bool)> {
    let mut all = Vec::new();
    for order in [Order::Colors, Order::Index] {
        for feature_angle in [None, Some(30.0)] {
            all.push((Options { order, feature_angle, ..Options::default() }, false));
        }
    }
    all
}

/// Coordinates are multiples of 2⁻²⁰, so that they can be moved by whole numbers without rounding.
fn meshes() -> [Mesh; 2] {
    let coarse = |x: f64| (x * f64::from(1 << 20)).round() / f64::from(1 << 20);
    [torus(24, 12, 0.35, 21), scattered(150, 22)].map(|(p, t)| (p.into_iter().map(|p| p.map(coarse)).collect(), t))
}

fn result((positions, triangles): &Mesh, (options, tail): &(Options, bool)) -> Mesh {
    let (mut positions, mut triangles, fixed) = (positions.clone(), triangles.clone(), Constraints::default());
    if *tail {
        let (tail, mut sources) = (TailOptions::default(), Sources::default());
        improve(&mut positions, &mut triangles, options, &tail, &fixed, &mut sources, &mut silent).expect("a result");
    } else {
        smooth(&mut positions, &triangles, options, &fixed, &mut silent).expect("a result");
    }
    (positions, triangles)
}

fn bits(positions: &[Point]) -> Vec<[u64; 3]> {
    positions.iter().map(|p| p.map(f64::to_bits)).collect()
}

/// Greatest difference of a coordinate.
fn difference(a: &[Point], b: &[Point]) -> f64 {
    assert_eq!(a.len(), b.len(), "another number of vertices");
    a.iter().flatten().zip(b.iter().flatten()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// The result of the changed mesh is the changed result, to `most`.
fn assert_follows(what: &str, change: impl Fn(Point) -> Point, back: impl Fn(Point) -> Point, most: f64) {
    assert_all_follow(&settings(), what, change, back, most);
}

fn assert_all_follow(
    settings: &[(Options, bool)],
    what: &str,
    change: impl Fn(Point) -> Point,
    back: impl Fn(Point) -> Point,
    most: f64,
) {
    for (m, mesh) in meshes().into_iter().enumerate() {
        for (s, setting) in settings.iter().enumerate() {
            let expected = result(&mesh, setting);
            let changed: Mesh = (mesh.0.iter().map(|&p| change(p)).collect(), mesh.1.clone());
            let found = result(&changed, setting);
            let found: Vec<Point> = found.0.into_iter().map(&back).collect();
            let off = difference(&found, &expected.0);
            assert!(off <= most, "{what}: mesh {m}, setting {s}: off by {off:e}");
            assert!(difference(&expected.0, &mesh.0[..expected.0.len()]) > 1e-3, "nothing moves, so nothing is shown");
        }
    }
}

#[test]
fn a_scale_by_a_power_of_two_changes_no_bit() {
    for exponent in [-900, -40, -1, 30, 900] {
        let (up, down) = (2.0_f64.powi(exponent), 2.0_f64.powi(-exponent));
        let scale = |by: f64| move |p: Point| p.map(|x| x * by);
        assert_follows(&format!("2^{exponent}"), scale(up), scale(down), 0.0);
    }
}

#[test]
fn any_scale_changes_only_rounding() {
    for size in [1e-12, 0.3, 1e12] {
        let scale = |by: f64| move |p: Point| p.map(|x| x * by);
        assert_follows(&format!("size {size}"), scale(size), scale(1.0 / size), 1e-11);
    }
}

#[test]
fn a_translation_changes_only_rounding() {
    for offset in [[-1000.0, 4000.0, 0.0], [1_000_000.0; 3]] {
        let add = |sign: f64| move |p: Point| std::array::from_fn(|k| p[k] + sign * offset[k]);
        let most = 1e-13 * offset.iter().fold(1000.0_f64, |m, x| m.max(x.abs()));
        assert_follows(&format!("offset {offset:?}"), add(1.0), add(-1.0), most);
    }
}

#[test]
fn a_rotation_changes_only_rounding_for_sweeps() {
    let quarter = |p: Point| [p[1], -p[0], p[2]];
    assert_all_follow(&sweeps(), "quarter turn", quarter, |p| [-p[1], p[0], p[2]], 1e-11);
    assert_all_follow(&sweeps(), "other axes", |p| [p[2], p[0], p[1]], |p| [p[1], p[2], p[0]], 1e-11);
    let turn = |angle: f64| {
        let (s, c) = angle.sin_cos();
        move |p: Point| [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]]
    };
    assert_all_follow(&sweeps(), "1 radian", turn(1.0), turn(-1.0), 1e-11);
}

#[test]
fn a_mirror_changes_nothing_for_sweeps() {
    let mirror = |p: Point| [-p[0], p[1], p[2]];
    assert_all_follow(&sweeps(), "mirror", mirror, mirror, 1e-11);
}

/// Runs each setting on the mesh and on one with the same vertices and other triangles.
fn assert_same_shape(what: &str, change: impl Fn(&[[u32; 3]]) -> Vec<[u32; 3]>, most: f64) {
    for (m, mesh) in meshes().into_iter().enumerate() {
        for (s, setting) in sweeps().iter().enumerate() {
            let changed = (mesh.0.clone(), change(&mesh.1));
            let off = difference(&result(&changed, setting).0, &result(&mesh, setting).0);
            assert!(off <= most, "{what}: mesh {m}, setting {s}: off by {off:e}");
        }
    }
}

#[test]
fn the_winding_of_the_whole_mesh_changes_nothing_in_the_shape() {
    assert_same_shape("reversed", |all| all.iter().map(|&[a, b, c]| [a, c, b]).collect(), 1e-11);
}

#[test]
fn the_order_of_triangles_and_corners_changes_only_rounding() {
    let turned = |all: &[[u32; 3]]| all.iter().map(|&[a, b, c]| [b, c, a]).collect();
    assert_same_shape("corners turned", turned, 1e-11);
    let reversed = |all: &[[u32; 3]]| all.iter().rev().copied().collect();
    assert_same_shape("triangles reversed", reversed, 1e-11);
}

#[test]
fn unused_vertices_in_between_change_no_bit() {
    for (positions, triangles) in meshes() {
        for setting in settings().iter().filter(|setting| setting.0.order == Order::Index) {
            let expected = result(&(positions.clone(), triangles.clone()), setting);
            let spread = positions.iter().flat_map(|&p| [[0.5; 3], p, [0.25; 3]]).collect();
            let renamed = triangles.iter().map(|t| t.map(|v| 3 * v + 1)).collect();
            let found = result(&(spread, renamed), setting).0;
            let used: Vec<Point> = found.into_iter().filter(|p| ![[0.5; 3], [0.25; 3]].contains(p)).collect();
            assert_eq!(bits(&used), bits(&expected.0));
        }
    }
}

#[test]
fn any_numbers_keep_the_promises() {
    for (positions, triangles) in meshes() {
        let count = positions.len();
        let mut random = Random(31);
        let mut order: Vec<usize> = (0..count).collect();
        for k in (1..count).rev() {
            order.swap(k, ((random.signed() + 1.0) * 0.5 * (k + 1) as f64) as usize % (k + 1));
        }
        let mut name = vec![0_u32; count];
        order.iter().zip(0..).for_each(|(&old, new)| name[old] = new);
        let renamed: Mesh = (
            order.iter().map(|&old| positions[old]).collect(),
            triangles.iter().map(|t| t.map(|v| name[v as usize])).collect(),
        );
        for setting in settings() {
            let quality = |mesh: &Mesh| measure(&mesh.0, &mesh.1).expect("a mesh");
            let (before, after) = (quality(&renamed), quality(&result(&renamed, &setting)));
            assert!(after.edge_ratio.mean < 0.9 * before.edge_ratio.mean);
            assert!(after.shape.min >= before.shape.min.min(0.5) * (1.0 - 1e-12));
            assert!((after.volume - before.volume).abs() <= 1e-12 * before.volume.abs());
        }
    }
}
