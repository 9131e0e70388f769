//! Random meshes: the promises after every single operation.

use proptest::prelude::*;
use qsmesh::{Constraints, Options, TailOptions};

use crate::check::{assert_sound, steepest, volume_change, worst_shape};
use crate::meshes::{self, Soup};
use crate::{collapse_tails, improve};

/// A jittered closed or open mesh.
fn random_mesh() -> impl Strategy<Value = Soup> {
    let torus = (any::<u64>(), 0.05..0.3).prop_map(|(seed, size)| meshes::torus(20, 10).jittered(seed, size));
    let sphere = (any::<u64>(), 0.02..0.12).prop_map(|(seed, size)| meshes::sphere(3).jittered(seed, size));
    let field = (any::<u64>(), 0.1..0.4).prop_map(|(seed, size)| meshes::height_field(12).jittered(seed, size));
    prop_oneof![torus, sphere, field]
}

fn random_options() -> impl Strategy<Value = (Options, TailOptions<'static>)> {
    let angle = prop_oneof![Just(None), Just(Some(30.0))];
    (angle, any::<bool>(), any::<bool>()).prop_map(|(feature_angle, strict, flips)| {
        let tail = TailOptions { flips, ..TailOptions::default() };
        let sharper = TailOptions { edge_ratio: 2.6, min_angle: 30.0, max_angle: 115.0, ..tail.clone() };
        (Options { feature_angle, ..Options::default() }, if strict { sharper } else { tail })
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn promises_hold_after_every_operation(before in random_mesh(), (options, tail) in random_options()) {
        let closed = crate::check::boundary(&before.triangles).is_empty();
        for bound in 0.. {
            let tail = TailOptions { operations: Some(bound), ..tail.clone() };
            let result = collapse_tails(&before, &options, &tail, &Constraints::default());
            let report = &result.report;
            assert_sound(&before, &result.after, &result.sources);
            if closed {
                prop_assert!(volume_change(&before, &result.after).abs() <= 1e-12);
            }
            let least = worst_shape(&before).min(options.quality_floor);
            prop_assert!(worst_shape(&result.after) >= least - 1e-9, "a triangle below the floor got worse");
            prop_assert_eq!(report.vertices_removed, before.positions.len() - result.after.positions.len());
            prop_assert_eq!(report.triangles_removed, before.triangles.len() - result.after.triangles.len());
            if report.moved + report.flipped + report.collapsed + report.removed < bound {
                break;
            }
        }
    }

    #[test]
    fn the_same_input_gives_the_same_bits(before in random_mesh(), (options, tail) in random_options()) {
        let first = improve(&before, &options, &tail, &Constraints::default());
        let second = improve(&before, &options, &tail, &Constraints::default());
        prop_assert_eq!(first.after, second.after);
        prop_assert_eq!(first.sources, second.sources);
        prop_assert_eq!(first.report.tail.leftovers, second.report.tail.leftovers);
    }

    #[test]
    fn single_precision_keeps_the_volume_too(seed in any::<u64>(), size in 0.05..0.2) {
        let before = meshes::torus(20, 10).jittered(seed, size);
        let mut positions: Vec<_> = before.positions.iter().map(|p| p.map(|x| x as f32)).collect();
        let mut triangles = before.triangles.clone();
        let (options, tail) = (Options { feature_angle: None, ..Options::default() }, TailOptions::default());
        let mut sources = qsmesh::Sources::default();
        let silent = &mut qsmesh::progress::silent;
        let constraints = Constraints::default();
        let report =
            qsmesh::improve(&mut positions, &mut triangles, &options, &tail, &constraints, &mut sources, silent)
                .expect("valid input");
        prop_assert!(report.tail.volume_relative_change.abs() <= 1e-6);
    }

    #[test]
    fn a_lopsided_tail_is_not_cured_at_the_cost_of_shape(before in random_mesh(), thin in any::<bool>()) {
        let open = TailOptions { edge_ratio: 1e9, min_angle: 1e-3, max_angle: 179.999, ..TailOptions::default() };
        let needles = TailOptions { edge_ratio: 1.5, ..open.clone() };
        let caps = TailOptions { max_angle: 85.0, ..open };
        let options = Options { feature_angle: None, quality_floor: 1.0, ..Options::default() };
        let tail = if thin { needles } else { caps };
        let result = collapse_tails(&before, &options, &tail, &Constraints::default());
        prop_assert!(worst_shape(&result.after) >= worst_shape(&before) - 1e-9);
    }

    #[test]
    fn no_measure_of_the_tail_gets_worse(before in random_mesh(), (options, tail) in random_options()) {
        let report = collapse_tails(&before, &options, &tail, &Constraints::default()).report;
        let limit = |value: f64, threshold: f64| value.max(threshold) + 1e-6;
        prop_assert!(report.after.edge_ratio.max <= limit(report.before.edge_ratio.max, tail.edge_ratio));
        prop_assert!(report.after.max_angle.max <= limit(report.before.max_angle.max, tail.max_angle));
        prop_assert!(report.after.min_angle.min >= report.before.min_angle.min.min(tail.min_angle) - 1e-6);
    }

    #[test]
    fn nothing_folds_on_a_sphere(seed in any::<u64>()) {
        let before = meshes::sphere(3).jittered(seed, 0.04);
        let options = Options { feature_angle: None, ..Options::default() };
        let tail = TailOptions { edge_ratio: 1.8, min_angle: 38.0, max_angle: 95.0, ..TailOptions::default() };
        let result = improve(&before, &options, &tail, &Constraints::default());
        let (then, now) = (steepest(&before, |p| p), steepest(&result.after, |p| p));
        prop_assert!(now < then.max(75.0), "{then} {now}");
    }
}
