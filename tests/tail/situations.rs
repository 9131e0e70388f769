//! Tiny meshes, each with one thing to be done or refused.

use qsmesh::{Constraints, Defect, Options, Reason, TailOptions};

use crate::check::{assert_sound, boundary, directed_edges};
use crate::meshes::{self, Soup};
use crate::{collapse_tails, improve};

/// Thresholds that nothing but nearly equilateral triangles pass, so that moves alone cannot cure.
fn strict() -> TailOptions<'static> {
    TailOptions { edge_ratio: 1.3, min_angle: 48.0, max_angle: 75.0, ..TailOptions::default() }
}

/// All vertices locked but these.
fn locked_but(soup: &Soup, free: &[u32]) -> Vec<bool> {
    (0..soup.positions.len() as u32).map(|v| !free.contains(&v)).collect()
}

/// A lattice in which vertex 24 was split: the edge from 24 to 49 is far too short.
fn with_needles() -> Soup {
    meshes::lattice(7).with_split_vertex(24, 31, 17, 0.05)
}

#[test]
fn a_needle_collapses() {
    let before = with_needles();
    let locked = locked_but(&before, &[24, 49]);
    let fixed = Constraints { locked: &locked, ..Constraints::default() };
    let result = collapse_tails(&before, &Options::default(), &strict(), &fixed);
    assert_sound(&before, &result.after, &result.sources);
    assert_eq!((result.report.tails_before, result.report.tails_after), (2, 0));
    assert_eq!((result.report.collapsed, result.report.vertices_removed, result.report.triangles_removed), (1, 1, 2));
    assert_eq!(directed_edges(&result.after.triangles), directed_edges(&meshes::lattice(7).triangles));
    let [here, there] = [result.after.positions[24], meshes::lattice(7).positions[24]];
    assert!((0..3).all(|k| (here[k] - there[k]).abs() < 1e-3), "{here:?} {there:?}");
}

#[test]
fn a_cap_loses_the_vertex_at_its_obtuse_corner() {
    let before = meshes::lattice(7).with_vertex_inside(30, [0.49, 0.49, 0.02]);
    let locked = locked_but(&before, &[49]);
    let fixed = Constraints { locked: &locked, ..Constraints::default() };
    let result = collapse_tails(&before, &Options::default(), &strict(), &fixed);
    assert_sound(&before, &result.after, &result.sources);
    assert_eq!((result.report.removed, result.report.tails_after), (1, 0));
    assert_eq!(result.after.positions, meshes::lattice(7).positions);
    assert_eq!(directed_edges(&result.after.triangles), directed_edges(&meshes::lattice(7).triangles));
}

#[test]
fn a_cap_with_locked_vertices_is_flipped() {
    let mut before = meshes::lattice(7);
    // The lower corner of this triangle is drawn down nearly to its far edge: the two above have a cap each.
    before.positions[24][1] -= 0.8;
    let locked = vec![true; 49];
    let fixed = Constraints { locked: &locked, ..Constraints::default() };
    let all_locked = collapse_tails(&before, &Options::default(), &TailOptions::default(), &fixed);
    assert_eq!(all_locked.after, before, "triangles of locked vertices stay");
    assert!(
        all_locked.report.leftovers.iter().all(|l| l.reason == Reason::Locked),
        "{:?}",
        all_locked.report.leftovers
    );
    assert!(all_locked.report.tails_after > 0);

    let free = Constraints::default();
    let options = Options { max_deviation: Some(0.0), ..Options::default() };
    let result = collapse_tails(&before, &options, &TailOptions::default(), &free);
    assert_sound(&before, &result.after, &result.sources);
    assert_eq!(result.report.tails_after, 0);
}

/// A roof: the lattice bent by 60° along its middle row, vertices 21 to 27. Vertex 31, above it, lies close to the ridge.
fn roof() -> Soup {
    let mut soup = meshes::lattice(7);
    let ridge = soup.positions[21][1];
    soup.positions[31][1] = ridge + 0.1;
    for p in &mut soup.positions {
        let beyond = (p[1] - ridge).max(0.0);
        *p = [p[0], p[1] - 0.5 * beyond, -0.75_f64.sqrt() * beyond];
    }
    soup
}

#[test]
fn a_cap_at_a_feature_leaves_the_feature_alone() {
    let before = roof();
    let ridge: Vec<_> = (21..27).map(|v| (v, v + 1)).collect();
    let locked = locked_but(&before, &[]);
    for constraints in [Constraints::default(), Constraints { locked: &locked, ..Constraints::default() }] {
        let result = collapse_tails(&before, &Options::default(), &TailOptions::default(), &constraints);
        assert!(result.report.tails_before > 0);
        assert_sound(&before, &result.after, &result.sources);
        let edges = directed_edges(&result.after.triangles);
        let number = |v: u32| result.sources.vertex.binary_search(&v).expect("ridge vertices survive") as u32;
        for &(a, b) in &ridge {
            assert!(edges.contains_key(&(number(a), number(b))), "the ridge has lost an edge");
        }
        for v in 21..=27 {
            let [old, new] = [before.positions[v], result.after.positions[number(v as u32) as usize]];
            assert_eq!([old[1], old[2]], [new[1], new[2]], "a ridge vertex has left the ridge");
        }
    }
}

#[test]
fn a_cap_between_a_feature_and_locked_vertices_is_listed() {
    let before = roof();
    // The cap alone may be treated; its obtuse corner is locked, and its longest edge is the ridge.
    let locked = locked_but(&before, &[23]);
    let fixed = Constraints { locked: &locked, ..Constraints::default() };
    let result = collapse_tails(&before, &Options::default(), &TailOptions::default(), &fixed);
    let caps: Vec<_> = result.report.leftovers.iter().filter(|l| l.defect == Defect::Cap).collect();
    assert!(!caps.is_empty());
    assert!(caps.iter().all(|l| matches!(l.reason, Reason::Feature | Reason::Locked)), "{caps:?}");
}

#[test]
fn the_link_condition_refuses() {
    let before = meshes::triangular_tube(6);
    let options = Options { feature_angle: None, ..Options::default() };
    let tail = TailOptions { edge_ratio: 1.5, min_angle: 30.0, ..TailOptions::default() };
    let result = collapse_tails(&before, &options, &tail, &Constraints::default());
    assert!(result.report.tails_before > 0 && result.report.tails_after > 0);
    assert_sound(&before, &result.after, &result.sources);
}

#[test]
fn a_tetrahedron_keeps_its_four_triangles() {
    let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, 0.3, 0.01]];
    let before = Soup { positions, triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] };
    let options = Options { feature_angle: None, ..Options::default() };
    let result = collapse_tails(&before, &options, &TailOptions::default(), &Constraints::default());
    assert_eq!(result.after.triangles.len(), 4);
    assert_sound(&before, &result.after, &result.sources);
}

#[test]
fn locked_vertices_keep_their_bits_and_survive() {
    let before = with_needles();
    let mut locked = vec![false; before.positions.len()];
    locked[24] = true;
    locked[49] = true;
    let fixed = Constraints { locked: &locked, ..Constraints::default() };
    let result = improve(&before, &Options::default(), &strict(), &fixed);
    for v in [24, 49] {
        let now = result.sources.vertex.binary_search(&v).expect("locked vertices survive");
        assert_eq!(result.after.positions[now], before.positions[v as usize]);
    }
    assert!(result.report.tail.leftovers.iter().any(|l| l.reason == Reason::Locked));
}

#[test]
fn needles_at_the_boundary_leave_it_alone() {
    let mut before = meshes::lattice(6);
    before.positions[2][0] = before.positions[3][0] - 0.05;
    let result = collapse_tails(&before, &Options::default(), &TailOptions::default(), &Constraints::default());
    assert!(result.report.tails_before > 0);
    assert_sound(&before, &result.after, &result.sources);
    assert_eq!(boundary(&result.after.triangles).len(), 20);
    assert!(!result.report.leftovers.is_empty());
    assert!(result.report.leftovers.iter().all(|l| l.reason == Reason::Boundary), "{:?}", result.report.leftovers);
}

#[test]
fn only_the_mask_is_treated() {
    let before = with_needles();
    let mask = vec![false; before.triangles.len()];
    let tail = TailOptions { mask: &mask, ..strict() };
    let result = collapse_tails(&before, &Options::default(), &tail, &Constraints::default());
    assert_eq!(result.report.tails_before, 0);
    assert_eq!(result.after, before);
}

#[test]
fn a_bound_on_operations_is_kept() {
    let before = meshes::torus(24, 12).jittered(5, 0.3);
    let options = Options::default();
    for bound in [0, 1, 5] {
        let tail = TailOptions { operations: Some(bound), ..TailOptions::default() };
        let report = collapse_tails(&before, &options, &tail, &Constraints::default()).report;
        assert!(report.tails_before > 20);
        assert_eq!(report.moved + report.flipped + report.collapsed + report.removed, bound);
        assert_eq!(report.tails_after, report.leftovers.len());
    }
}

#[test]
fn max_deviation_bounds_what_the_tail_may_do() {
    let before = meshes::torus(24, 12).jittered(5, 0.2);
    let free = Options { feature_angle: None, iterations: 0, ..Options::default() };
    let bound = 0.01;
    let bounded = Options { max_deviation: Some(bound), ..free.clone() };
    let constraints = Constraints::default();
    let without = improve(&before, &free, &TailOptions::default(), &constraints).report;
    let with = improve(&before, &bounded, &TailOptions::default(), &constraints).report;
    assert!(without.tail.max_deviation > bound, "{}", without.tail.max_deviation);
    assert!(with.tail.max_deviation <= bound, "{}", with.tail.max_deviation);
}

#[test]
fn general_flips_restore_a_lattice() {
    let mut before = meshes::lattice(7);
    let swap = |t: &[u32; 3], from: [u32; 3]| from.iter().all(|v| t.contains(v));
    // The two triangles at the edge 24–31 are cut along their long diagonal instead.
    let first = before.triangles.iter().position(|t| swap(t, [24, 31, 30])).expect("a lattice triangle");
    let second = before.triangles.iter().position(|t| swap(t, [24, 25, 31])).expect("a lattice triangle");
    before.triangles[first] = [30, 24, 25];
    before.triangles[second] = [30, 25, 31];
    let none = vec![false; before.triangles.len()];
    let tail = TailOptions { flips: true, mask: &none, ..TailOptions::default() };
    let result = collapse_tails(&before, &Options::default(), &tail, &Constraints::default());
    assert_eq!(result.report.general_flips, 1);
    assert_eq!(directed_edges(&result.after.triangles), directed_edges(&meshes::lattice(7).triangles));
}
