//! Keeping sizes.

mod meshes;

use std::collections::BTreeSet;

use meshes::{Mesh, Random, torus};
use qsmesh::progress::silent;
use qsmesh::{Constraints, Method, Metric, Options, Report, smooth};
use spade::{DelaunayTriangulation, Point2, Triangulation};

fn run(mesh: &mut Mesh, options: &Options) -> Report {
    smooth(&mut mesh.0, &mesh.1, options, &Constraints::default(), &mut silent).expect("a result")
}

/// How far apart points are to be at a place in the unit square: five times as near in the middle as at its corners.
fn spacing([x, y]: [f64; 2]) -> f64 {
    0.012 + 0.068 * ((x - 0.5).powi(2) + (y - 0.5).powi(2)).sqrt()
}

/// The Delaunay triangulation of random points, none of which is nearer to an earlier one than the spacing there asks for.
fn graded() -> Mesh {
    let mut random = Random(11);
    let side = |i: usize| f64::from(i as u32) / 20.0;
    let mut points: Vec<[f64; 2]> =
        (0..20).flat_map(|i| [[side(i), 0.0], [1.0, side(i)], [side(i + 1), 1.0], [0.0, side(i + 1)]]).collect();
    for _ in 0..30_000 {
        let point = [(); 2].map(|()| 0.5 + 0.49 * random.signed());
        let near = |q: &[f64; 2]| (q[0] - point[0]).hypot(q[1] - point[1]) < spacing(point);
        if !points.iter().any(near) {
            points.push(point);
        }
    }
    let mut triangulation = DelaunayTriangulation::<Point2<f64>>::new();
    for [x, y] in points {
        triangulation.insert(Point2::new(x, y)).expect("a finite point");
    }
    let positions = triangulation.vertices().map(|v| [v.position().x, v.position().y, 0.0]).collect();
    let triangles = triangulation.inner_faces().map(|f| f.vertices().map(|v| v.index() as u32)).collect();
    (positions, triangles)
}

/// For each vertex the logarithm of the mean triangle area of the stars at most two edges away.
fn log_sizes((positions, triangles): &Mesh) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); positions.len()];
    let mut near: Vec<BTreeSet<usize>> = (0..positions.len()).map(|v| BTreeSet::from([v])).collect();
    for t in triangles {
        let normal = meshes::normal(positions, t);
        for v in t.map(|v| v as usize) {
            sums[v].0 += 0.5 * meshes::dot(normal, normal).sqrt();
            sums[v].1 += 1.0;
            near[v].extend(t.map(|v| v as usize));
        }
    }
    let around = |v: usize| -> BTreeSet<usize> { near[v].iter().flat_map(|&w| near[w].iter().copied()).collect() };
    let mean = |of: BTreeSet<usize>| of.iter().map(|&w| sums[w].0 / sums[w].1).sum::<f64>() / of.len() as f64;
    (0..positions.len()).map(|v| mean(around(v)).ln()).collect()
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    let (ma, mb) = (mean(a), mean(b));
    let product =
        |x: &[f64], mx: f64, y: &[f64], my: f64| x.iter().zip(y).map(|(x, y)| (x - mx) * (y - my)).sum::<f64>();
    product(a, ma, b, mb) / (product(a, ma, a, ma) * product(b, mb, b, mb)).sqrt()
}

/// What is lost of the sizes' correlation with the original ones, and the mean edge ratio.
fn lost(options: &Options) -> (f64, f64) {
    let mut mesh = graded();
    let before = log_sizes(&mesh);
    let report = run(&mut mesh, options);
    (1.0 - correlation(&before, &log_sizes(&mesh)), report.after.edge_ratio.mean)
}

#[test]
fn a_graded_mesh_stays_more_graded() {
    for iterations in [2, 10] {
        let plain = Options { iterations, ..Options::default() };
        let (without, plain_mean) = lost(&plain);
        let (with, mean) = lost(&Options { keep_sizes: true, ..plain });
        assert!(with < 0.4 * without, "{iterations}: {with} of {without}");
        assert!(mean < plain_mean + 0.03, "shapes get better all the same: {mean} {plain_mean}");
    }
}

#[test]
fn it_works_for_every_metric_and_method() {
    let metrics = [Metric::MinAngle, Metric::MaxAngle, Metric::Area, Metric::Shape];
    let methods = [Method::Laplacian, Method::TangentialLaplacian];
    let plain = Options { iterations: 5, ..Options::default() };
    let of_metrics = metrics.map(|metric| Options { metric, ..plain.clone() });
    let of_methods = methods.map(|method| Options { method, ..plain.clone() });
    for options in of_metrics.into_iter().chain(of_methods) {
        let (without, with) = (lost(&options).0, lost(&Options { keep_sizes: true, ..options.clone() }).0);
        assert!(with < without, "{options:?}: {with} {without}");
    }
}

#[test]
fn it_is_off_by_default() {
    let [mut off, mut on, mut default] = [(); 3].map(|()| torus(12, 9, 0.3, 1));
    run(&mut off, &Options { keep_sizes: false, ..Options::default() });
    run(&mut on, &Options { keep_sizes: true, ..Options::default() });
    run(&mut default, &Options::default());
    assert_eq!(off, default);
    assert_ne!(on, default);
}
