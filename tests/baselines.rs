//! The Laplacian methods: what they want, and that everything else holds for them too.

mod meshes;

use meshes::{Mesh, cube, torus};
use qsmesh::progress::silent;
use qsmesh::{Constraints, Method, Metric, Options, Report, smooth};

fn run(mesh: &mut Mesh, options: &Options) -> Report {
    smooth(&mut mesh.0, &mesh.1, options, &Constraints::default(), &mut silent).expect("a result")
}

fn with(method: Method) -> Options {
    Options { method, relaxation: 1.0, iterations: 1, feature_angle: None, quality_floor: 0.0, ..Options::default() }
}

/// An apex above a flat ring of five vertices.
fn tent() -> Mesh {
    let ring = [[1.0, 0.0, 0.0], [0.3, 1.1, 0.0], [-0.9, 0.5, 0.0], [-0.7, -0.7, 0.0], [0.4, -0.9, 0.0]];
    let positions = std::iter::once([0.3, 0.2, 0.4]).chain(ring).collect();
    (positions, (0..5).map(|i| [0, i + 1, (i + 1) % 5 + 1]).collect())
}

fn near(found: [f64; 3], expected: [f64; 3]) {
    assert!((0..3).all(|k| (found[k] - expected[k]).abs() < 1e-15), "{found:?} is not {expected:?}");
}

#[test]
fn the_laplacian_goes_to_the_mean_of_the_ring() {
    let mut mesh = tent();
    run(&mut mesh, &with(Method::Laplacian));
    near(mesh.0[0], [0.02, 0.0, 0.0]);
}

#[test]
fn the_tangential_one_stays_at_its_height() {
    let mut mesh = tent();
    run(&mut mesh, &with(Method::TangentialLaplacian));
    near(mesh.0[0], [0.02, 0.0, 0.4]);
}

#[test]
fn only_the_tangential_one_keeps_the_volume() {
    let (mut plain, mut tangential) = (torus(24, 16, 0.3, 2), torus(24, 16, 0.3, 2));
    let lost = run(&mut plain, &with(Method::Laplacian)).volume_relative_change;
    assert!(lost < -1e-3, "it shrinks: {lost}");
    let kept = run(&mut tangential, &with(Method::TangentialLaplacian)).volume_relative_change;
    assert!(kept.abs() <= 1e-13, "{kept}");
}

#[test]
fn features_guard_and_deviation_bound_hold() {
    for method in [Method::Laplacian, Method::TangentialLaplacian] {
        let before = cube(6, 0.4, 3);
        let mut after = before.clone();
        let options = Options { method, iterations: 4, max_deviation: Some(0.05), ..Options::default() };
        let report = run(&mut after, &options);
        assert_eq!((report.kept.corner, report.feature_edges), (8, 72));
        assert!(report.max_deviation <= 0.05);
        assert!(report.after.shape.min >= report.before.shape.min.min(0.5) * (1.0 - 1e-12));
        assert!(report.after.edge_ratio.mean < report.before.edge_ratio.mean);
        for (old, new) in before.0.iter().zip(&after.0) {
            assert!((0..3).all(|k| old[k].abs() != 1.0 || new[k] == old[k]), "{old:?} has left its side: {new:?}");
        }
    }
}

#[test]
fn the_metric_means_nothing_to_them() {
    let (mut one, mut other) = (torus(12, 9, 0.3, 1), torus(12, 9, 0.3, 1));
    run(&mut one, &with(Method::Laplacian));
    run(&mut other, &Options { metric: Metric::Area, ..with(Method::Laplacian) });
    assert_eq!(one, other);
}
