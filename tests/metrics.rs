//! Driving quality parameters: each does its own work, and every promise holds for all of them.

mod meshes;

use meshes::{Mesh, cube, scattered, sheet, torus};
use qsmesh::progress::silent;
use qsmesh::{Boundary, Constraints, Ideal, Metric, Options, Report, smooth};

const METRICS: [Metric; 5] = [Metric::EdgeRatio, Metric::MinAngle, Metric::MaxAngle, Metric::Area, Metric::Shape];

fn run(mesh: &mut Mesh, options: &Options) -> Report {
    smooth(&mut mesh.0, &mesh.1, options, &Constraints::default(), &mut silent).expect("a result")
}

fn driven(metric: Metric) -> Options {
    Options { metric, ..Options::default() }
}

/// Mean and variance of max(a/m, m/a), a being the area of a triangle and m the mean area of one of its stars.
fn area_ratio((positions, triangles): &Mesh) -> (f64, f64) {
    let area = |t: &[u32; 3]| 0.5 * meshes::dot(meshes::normal(positions, t), meshes::normal(positions, t)).sqrt();
    let mut stars = vec![(0.0, 0.0); positions.len()];
    for t in triangles {
        for &v in t {
            stars[v as usize].0 += area(t);
            stars[v as usize].1 += 1.0;
        }
    }
    let ratio = |t: &[u32; 3], v: u32| area(t) / (stars[v as usize].0 / stars[v as usize].1);
    let samples: Vec<f64> =
        triangles.iter().flat_map(|t| t.map(|v| ratio(t, v))).map(|r| if r < 1.0 { 1.0 / r } else { r }).collect();
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    (mean, samples.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / samples.len() as f64)
}

/// What each metric claims to make least: the mean edge ratio; the variances of smallest angle, largest angle and shape;
/// mean and variance of the area ratio.
fn claims(mesh: &Mesh, report: &Report) -> [f64; 6] {
    let after = &report.after;
    let (mean, variance) = area_ratio(mesh);
    [after.edge_ratio.mean, after.min_angle.variance, after.max_angle.variance, mean, variance, after.shape.variance]
}

#[test]
fn each_metric_does_most_for_its_own_parameter() {
    let results = METRICS.map(|metric| {
        let mut mesh = scattered(3000, 7);
        let report = run(&mut mesh, &driven(metric));
        claims(&mesh, &report)
    });
    for (claim, owner) in [0, 1, 2, 3, 3, 4].into_iter().enumerate() {
        for other in (0..METRICS.len()).filter(|&other| other != owner) {
            let (own, its) = (results[owner][claim], results[other][claim]);
            assert!(own < its, "claim {claim} of {:?}: {own}, but {:?} has {its}", METRICS[owner], METRICS[other]);
        }
    }
}

#[test]
fn every_metric_brings_the_centre_of_a_hexagon_to_its_middle() {
    for metric in METRICS {
        let ring = (0..6).map(|i| {
            let angle = f64::from(i) * std::f64::consts::FRAC_PI_3;
            [angle.cos(), angle.sin(), 0.0]
        });
        let positions = std::iter::once([0.4, 0.2, 0.0]).chain(ring).collect();
        let mut mesh: Mesh = (positions, (0..6).map(|i| [0, i + 1, (i + 1) % 6 + 1]).collect());
        run(&mut mesh, &Options { iterations: 60, relaxation: 1.0, ..driven(metric) });
        assert!(mesh.0[0].iter().all(|x| x.abs() < 1e-3), "{metric:?}: {:?}", mesh.0[0]);
    }
}

#[test]
fn all_metrics_differ() {
    let results = METRICS.map(|metric| {
        let mut mesh = torus(12, 9, 0.3, 1);
        run(&mut mesh, &driven(metric));
        mesh.0
    });
    for (i, one) in results.iter().enumerate() {
        assert!(results[..i].iter().all(|other| other != one), "{:?}", METRICS[i]);
    }
}

#[test]
fn every_metric_heeds_width_limit_and_ideal() {
    for metric in METRICS {
        let [plain, wide, bounded, ideal] = [
            driven(metric),
            Options { interval_width: 0.05, ..driven(metric) },
            Options { sample_limit: 1.2, ..driven(metric) },
            Options { ideal: Ideal::Equilateral, ..driven(metric) },
        ]
        .map(|options| {
            let mut mesh = torus(12, 9, 0.3, 1);
            run(&mut mesh, &options);
            mesh.0
        });
        assert!(plain != wide && plain != bounded && plain != ideal, "{metric:?}");
    }
}

#[test]
fn the_promises_hold_for_every_metric() {
    let squashed = {
        let mut mesh = torus(20, 14, 0.4, 4);
        for v in 0..40 {
            mesh.0[7 * v] = mesh.0[7 * v + 1];
        }
        mesh
    };
    for mesh in [torus(20, 14, 0.45, 9), cube(6, 0.4, 3), sheet(9, 0.2, 0.45, 2), scattered(150, 5), squashed] {
        for metric in METRICS {
            for keep_sizes in [false, true] {
                let mut after = mesh.clone();
                let options = Options { keep_sizes, boundary: Boundary::Slide, iterations: 3, ..driven(metric) };
                let report = run(&mut after, &options);
                assert!(report.volume_relative_change.abs() <= 1e-12, "{options:?} {}", report.volume_relative_change);
                assert!(report.after.shape.min >= report.before.shape.min.min(0.5) * (1.0 - 1e-12), "{options:?}");
                assert!(after.0.iter().flatten().all(|x| x.is_finite()));
                let folded = meshes::folded(&mesh);
                assert!(meshes::flipped(&mesh.0, &after.0, &mesh.1).iter().all(|t| folded.contains(t)), "{options:?}");
            }
        }
    }
}

#[test]
fn the_same_bits_on_any_number_of_threads() {
    for metric in [Metric::MaxAngle, Metric::Shape] {
        let [one, three] = [1, 3].map(|threads| {
            let mut mesh = torus(200, 60, 0.35, 6);
            run(&mut mesh, &Options { threads, keep_sizes: true, iterations: 1, measure: false, ..driven(metric) });
            mesh.0
        });
        assert_eq!(one, three, "{metric:?}");
    }
}
