//! Anything may come in.

use proptest::prelude::*;
use qsmesh::{Constraints, Defect, Options, Reason, TailOptions};

use crate::meshes::{self, Soup};
use crate::{collapse_tails, improve};

fn assert_a_result(before: &Soup) {
    for feature_angle in [None, Some(30.0)] {
        for flips in [false, true] {
            let options = Options { feature_angle, ..Options::default() };
            let tail = TailOptions { flips, ..TailOptions::default() };
            let result = improve(before, &options, &tail, &Constraints::default());
            assert!(result.after.positions.iter().flatten().all(|x| x.is_finite()));
            assert!(result.after.triangles.iter().flatten().all(|&v| (v as usize) < result.after.positions.len()));
            assert_eq!(result.sources.corner.len(), 3 * result.after.triangles.len());
            assert_eq!(result.report.tail.tails_after, result.report.tail.leftovers.len());
        }
    }
}

#[test]
fn an_empty_mesh() {
    assert_a_result(&Soup { positions: vec![], triangles: vec![] });
    assert_a_result(&Soup { positions: vec![[1.0, 2.0, 3.0]; 4], triangles: vec![] });
}

#[test]
fn triangles_that_name_a_vertex_twice_stay_and_are_listed() {
    let mut before = meshes::lattice(5);
    before.triangles.extend([[3, 3, 8], [4, 4, 4]]);
    let result = collapse_tails(&before, &Options::default(), &TailOptions::default(), &Constraints::default());
    assert_eq!(result.after, before);
    let found: Vec<_> = result.report.leftovers.iter().map(|l| (l.triangle, l.defect, l.reason)).collect();
    assert_eq!(found, [(32, Defect::Degenerate, Reason::Topology), (33, Defect::Degenerate, Reason::Topology)]);
}

#[test]
fn all_vertices_in_one_point() {
    let mut before = meshes::torus(12, 6);
    before.positions.fill([1.0, 1.0, 1.0]);
    assert_a_result(&before);
}

#[test]
fn duplicated_triangles_and_fins() {
    let mut before = meshes::torus(12, 6).jittered(3, 0.3);
    let first = before.triangles[10];
    before.positions.push([9.0, 9.0, 9.0]);
    before.triangles.extend([first, [first[0], first[1], 72], before.triangles[20]]);
    assert_a_result(&before);
}

#[test]
fn inconsistent_winding() {
    let mut before = meshes::torus(12, 6).jittered(3, 0.3);
    before.triangles.iter_mut().step_by(7).for_each(|t| t.swap(0, 1));
    assert_a_result(&before);
}

#[test]
fn zero_area_triangles_are_cured() {
    let mut before = meshes::torus(24, 12);
    before.positions[30] = before.positions[31];
    before.positions[100] = before.positions[101];
    let options = Options { feature_angle: None, ..Options::default() };
    let result = improve(&before, &options, &TailOptions::default(), &Constraints::default());
    assert_eq!(result.report.tail.after.zero_area, 0);
    assert_eq!(result.report.tail.tails_after, 0);
}

#[test]
fn a_fan_of_many_needles_ends() {
    let n = 20_000_u32;
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(n);
    let mut positions: Vec<_> = (0..n).map(|i| [angle(i).cos(), angle(i).sin(), 0.0]).collect();
    positions.extend([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]);
    let sides = |i: u32| [[i, (i + 1) % n, n], [(i + 1) % n, i, n + 1]];
    let before = Soup { positions, triangles: (0..n).flat_map(sides).collect() };
    let result = collapse_tails(&before, &Options::default(), &TailOptions::default(), &Constraints::default());
    assert_eq!(result.report.tails_before, 40_000);
}

#[test]
fn extreme_coordinates() {
    for scale in [1e-300, 1e-30, 1e30, 1e300] {
        let mut before = meshes::torus(24, 12).jittered(9, 0.3);
        before.positions.iter_mut().flatten().for_each(|x| *x *= scale);
        assert_a_result(&before);
        let result = improve(&before, &Options::default(), &TailOptions::default(), &Constraints::default());
        assert!(result.report.tail.tails_after < result.report.tail.tails_before);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn random_soups(
        positions in prop::collection::vec(prop::array::uniform3(-2..=2_i8), 3..12),
        triangles in prop::collection::vec(prop::array::uniform3(0..12_u32), 0..40),
    ) {
        let count = positions.len() as u32;
        let positions = positions.into_iter().map(|p| p.map(f64::from)).collect();
        let triangles = triangles.into_iter().map(|t| t.map(|v| v % count)).collect();
        assert_a_result(&Soup { positions, triangles });
    }
}
