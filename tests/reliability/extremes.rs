//! Every option at both ends of its range.

use qsmesh::{Boundary, Ideal, Method, Metric, Options, Order, Plane, TailOptions};

/// Sweeps: enough that a mistake in the first one is met by the second.
const SWEEPS: u32 = 3;

fn usual() -> Options {
    Options { iterations: SWEEPS, ..Options::default() }
}

/// Each option alone at each end, and all together.
pub fn options() -> Vec<Options> {
    let least = Options {
        iterations: SWEEPS,
        method: Method::QuasiStatistical,
        metric: Metric::Area,
        keep_sizes: true,
        relaxation: f64::MIN_POSITIVE,
        plane: Plane::LeastSquares,
        ideal: Ideal::Equilateral,
        interval_width: 0.001,
        sample_limit: 1.0,
        quality_floor: 0.0,
        feature_angle: Some(f64::MIN_POSITIVE),
        boundary: Boundary::Slide,
        order: Order::Index,
        threads: 1,
        max_deviation: Some(0.0),
        measure: true,
    };
    let most = Options {
        relaxation: 2.0,
        interval_width: 1000.0,
        sample_limit: f64::MAX,
        quality_floor: 1.0,
        feature_angle: Some(180.0_f64.next_down()),
        threads: 1024,
        max_deviation: Some(f64::MAX),
        ..usual()
    };
    vec![
        Options { iterations: 0, ..usual() },
        Options { relaxation: least.relaxation, ..usual() },
        Options { relaxation: most.relaxation, ..usual() },
        Options { plane: least.plane, ..usual() },
        Options { ideal: least.ideal, relaxation: 2.0, ..usual() },
        Options { interval_width: least.interval_width, ..usual() },
        Options { interval_width: most.interval_width, ..usual() },
        Options { sample_limit: least.sample_limit, ..usual() },
        Options { sample_limit: most.sample_limit, ..usual() },
        Options { quality_floor: least.quality_floor, feature_angle: None, ..usual() },
        Options { quality_floor: most.quality_floor, ..usual() },
        Options { feature_angle: None, ..usual() },
        Options { feature_angle: least.feature_angle, ..usual() },
        Options { feature_angle: most.feature_angle, ..usual() },
        Options { boundary: least.boundary, ..usual() },
        Options { order: Order::Index, ..usual() },
        Options { order: Order::Wave, ..usual() },
        Options { order: Order::Tail, ..usual() },
        Options { method: Method::Laplacian, relaxation: 2.0, ..usual() },
        Options { method: Method::TangentialLaplacian, relaxation: 2.0, ..usual() },
        Options { metric: Metric::MinAngle, ..usual() },
        Options { metric: Metric::MaxAngle, ..usual() },
        Options { metric: Metric::Area, ..usual() },
        Options { metric: Metric::Shape, ..usual() },
        Options { keep_sizes: true, ..usual() },
        Options { max_deviation: least.max_deviation, ..usual() },
        Options { max_deviation: most.max_deviation, ..usual() },
        least,
        most,
    ]
}

/// The same for the tail: nothing is in it, everything is, and what lies between.
pub fn tails() -> Vec<TailOptions<'static>> {
    let nothing = TailOptions {
        edge_ratio: f64::MAX,
        min_angle: f64::MIN_POSITIVE,
        max_angle: 180.0_f64.next_down(),
        ..TailOptions::default()
    };
    let everything = TailOptions {
        edge_ratio: 1.0_f64.next_up(),
        min_angle: 60.0_f64.next_down(),
        max_angle: 60.0_f64.next_up(),
        flips: true,
        attempts: 1,
        // A call with all of a mesh in the tail takes seconds.
        operations: Some(20),
        ..TailOptions::default()
    };
    vec![
        TailOptions { operations: Some(1), ..everything.clone() },
        nothing,
        everything,
        TailOptions { attempts: 1000, ..TailOptions::default() },
        TailOptions { flips: true, ..TailOptions::default() },
    ]
}
