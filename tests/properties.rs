//! The promises, over random meshes and random options.

mod meshes;

use meshes::{Mesh, cube, scattered, sheet, torus};
use proptest::prelude::*;
use qsmesh::progress::silent;
use qsmesh::{Boundary, Constraints, Error, Flow, Ideal, Options, Order, Plane, Report, smooth};

fn any_mesh() -> impl Strategy<Value = Mesh> {
    prop_oneof![
        (6..20_u32, 6..16_u32, 0.0..0.45_f64, any::<u64>()).prop_map(|(r, c, j, s)| torus(r, c, j, s)),
        (2..12_u32, 0.0..0.3_f64, 0.0..0.45_f64, any::<u64>()).prop_map(|(n, h, j, s)| sheet(n, h, j, s)),
        (2..8_u32, 0.0..0.45_f64, any::<u64>()).prop_map(|(n, j, s)| cube(n, j, s)),
        (3..200_usize, any::<u64>()).prop_map(|(n, s)| scattered(n, s)),
    ]
}

fn any_options() -> impl Strategy<Value = Options> {
    const ORDERS: [Order; 4] = [Order::Colors, Order::Index, Order::Wave, Order::Tail];
    let choices = (any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>(), prop::sample::select(&ORDERS[..]));
    let numbers = (0..5_u32, 0.05..2.0_f64, 0.01..4.0_f64, 1.0..10.0_f64, 0.0..1.0_f64, 5.0..90.0_f64);
    (choices, numbers).prop_map(
        |((plane, ideal, slide, features, order), (iterations, relaxation, width, limit, floor, angle))| Options {
            iterations,
            relaxation,
            plane: if plane { Plane::VectorArea } else { Plane::LeastSquares },
            ideal: if ideal { Ideal::Modelled } else { Ideal::Equilateral },
            interval_width: width,
            sample_limit: limit,
            quality_floor: floor,
            feature_angle: features.then_some(angle),
            boundary: if slide { Boundary::Slide } else { Boundary::Fixed },
            order,
            ..Options::default()
        },
    )
}

fn run(mesh: &Mesh, options: &Options, constraints: &Constraints<'_>) -> (Vec<[f64; 3]>, Report) {
    let mut positions = mesh.0.clone();
    let report = smooth(&mut positions, &mesh.1, options, constraints, &mut silent).expect("a result");
    (positions, report)
}

fn bits(positions: &[[f64; 3]]) -> Vec<[u64; 3]> {
    positions.iter().map(|p| p.map(f64::to_bits)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// Promise 1.
    #[test]
    fn the_volume_stays(mesh in any_mesh(), options in any_options()) {
        let (_, report) = run(&mesh, &options, &Constraints::default());
        prop_assert!(report.volume_relative_change.abs() <= 1e-12, "{}", report.volume_relative_change);
        let mut single = meshes::to_f32(&mesh.0);
        let report = smooth(&mut single, &mesh.1, &options, &Constraints::default(), &mut silent).unwrap();
        prop_assert!(report.volume_relative_change.abs() <= 1e-6, "{}", report.volume_relative_change);
    }

    /// Promise 2. Only what was folded over may turn round.
    #[test]
    fn nothing_gets_worse_or_folds(mesh in any_mesh(), options in any_options()) {
        let (after, report) = run(&mesh, &options, &Constraints::default());
        prop_assert!(report.after.shape.min >= report.before.shape.min.min(options.quality_floor) * (1.0 - 1e-12));
        let folded = meshes::folded(&mesh);
        prop_assert!(meshes::flipped(&mesh.0, &after, &mesh.1).iter().all(|t| folded.contains(t)));
    }

    /// Promise 2 in single precision: it holds for the bits in the buffer.
    #[test]
    fn nothing_gets_worse_in_single_precision(mesh in any_mesh(), options in any_options()) {
        let mut single = meshes::to_f32(&mesh.0);
        let report = smooth(&mut single, &mesh.1, &options, &Constraints::default(), &mut silent).unwrap();
        prop_assert!(report.after.shape.min >= report.before.shape.min.min(options.quality_floor) * (1.0 - 1e-12));
    }

    /// Promise 3: each vertex is moved or counted, and what is counted as locked keeps its bits.
    #[test]
    fn only_what_was_asked(mesh in any_mesh(), options in any_options(), seed in any::<u64>()) {
        let mut random = meshes::Random(seed);
        let locked: Vec<bool> = mesh.0.iter().map(|_| random.signed() < 0.0).collect();
        let constraints = Constraints { locked: &locked, ..Constraints::default() };
        let (after, report) = run(&mesh, &options, &constraints);
        let moved: Vec<usize> = (0..after.len()).filter(|&v| bits(&mesh.0)[v] != bits(&after)[v]).collect();
        prop_assert!(moved.iter().all(|&v| !locked[v]));
        prop_assert_eq!(moved.len(), report.moved);
        let k = report.kept;
        let kept = k.unreferenced + k.locked + k.non_manifold + k.degenerate + k.boundary + k.corner + k.guard;
        prop_assert_eq!(kept + k.deviation + k.settled + moved.len(), after.len());
    }

    /// Promise 4, checked against every triangle of the original.
    #[test]
    fn the_deviation_bound_is_kept(mesh in any_mesh(), options in any_options(), share in 0.0..0.05_f64) {
        let options = Options { max_deviation: Some(share), ..options };
        let (after, report) = run(&mesh, &options, &Constraints::default());
        prop_assert!(report.max_deviation <= share);
        let true_deviation = after.iter().map(|&p| meshes::distance(p, &mesh)).fold(0.0, f64::max);
        prop_assert!(true_deviation <= report.max_deviation + 1e-12);
    }

    /// Promise 6.
    #[test]
    fn the_same_bits_again(mesh in any_mesh(), options in any_options()) {
        let first = run(&mesh, &options, &Constraints::default()).0;
        prop_assert_eq!(bits(&first), bits(&run(&mesh, &options, &Constraints::default()).0));
    }

    /// Promise 7: cancel at any moment, or anything out of range, and the buffer is as it was.
    #[test]
    fn all_or_nothing(mesh in any_mesh(), options in any_options(), stop in 0..3_usize, bad in any::<prop::sample::Index>()) {
        let mut positions = mesh.0.clone();
        let mut calls = 0;
        let mut listen = |_: f64| { calls += 1; if calls > stop { Flow::Cancel } else { Flow::Continue } };
        let result = smooth(&mut positions, &mesh.1, &options, &Constraints::default(), &mut listen);
        if result.is_err() {
            prop_assert_eq!(result.unwrap_err(), Error::Cancelled);
            prop_assert_eq!(bits(&positions), bits(&mesh.0));
        }
        let vertex = bad.index(mesh.0.len());
        positions = mesh.0.clone();
        positions[vertex][2] = f64::NAN;
        let before = bits(&positions);
        let error = smooth(&mut positions, &mesh.1, &options, &Constraints::default(), &mut silent).unwrap_err();
        prop_assert_eq!(error, Error::NonFinite { vertex });
        prop_assert_eq!(bits(&positions), before);
    }

    /// Any soup of triangles over any coordinates gives a result without a NaN.
    #[test]
    fn soup_gives_a_result(
        positions in prop::collection::vec(prop::array::uniform3(coordinate()), 1..12),
        corners in prop::collection::vec(prop::array::uniform3(any::<prop::sample::Index>()), 0..24),
        options in any_options(),
    ) {
        let triangles: Vec<[u32; 3]> =
            corners.iter().map(|t| t.map(|i| i.index(positions.len()) as u32)).collect();
        let mut after = positions.clone();
        let report = smooth(&mut after, &triangles, &options, &Constraints::default(), &mut silent).unwrap();
        prop_assert!(after.iter().flatten().all(|x| x.is_finite()), "{:?}", after);
        prop_assert!(!report.after.area.is_nan() && !report.max_deviation.is_nan());
        prop_assert_eq!(report.after.edge_ratio.count + report.after.edge_ratio.infinite, triangles.len());
    }
}

/// Ordinary, tiny, huge and special coordinates.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => -1.0..1.0_f64,
        2 => (-4..5_i32).prop_map(f64::from),
        1 => Just(0.0),
        1 => -1e300..1e300_f64,
        1 => -1e-300..1e-300_f64,
        1 => Just(f64::MAX),
        1 => Just(5e-324),
    ]
}
