//! Small meshes, each showing one situation.

mod meshes;

use meshes::{Mesh, cube, flipped, sheet, torus};
use qsmesh::progress::silent;
use qsmesh::{Boundary, Constraints, Error, Flow, Ideal, Options, Order, Plane, Report, smooth};

fn run(mesh: &mut Mesh, options: &Options) -> Report {
    smooth(&mut mesh.0, &mesh.1, options, &Constraints::default(), &mut silent).expect("a result")
}

/// Vertices whose bits have changed.
fn moved(before: &Mesh, after: &Mesh) -> Vec<usize> {
    (0..before.0.len()).filter(|&v| before.0[v].map(f64::to_bits) != after.0[v].map(f64::to_bits)).collect()
}

/// A hexagonal star around an apex that lies off its middle.
fn hexagon() -> Mesh {
    let ring = (0..6).map(|i| {
        let angle = f64::from(i) * std::f64::consts::FRAC_PI_3;
        [angle.cos(), angle.sin(), 0.0]
    });
    let positions = std::iter::once([0.4, 0.2, 0.0]).chain(ring).collect();
    (positions, (0..6).map(|i| [0, i + 1, (i + 1) % 6 + 1]).collect())
}

#[test]
fn the_centre_of_a_hexagon_comes_to_its_middle() {
    let mut mesh = hexagon();
    let options = Options { iterations: 30, relaxation: 1.0, ..Options::default() };
    let report = run(&mut mesh, &options);
    assert!(mesh.0[0].iter().all(|x| x.abs() < 1e-9), "{:?}", mesh.0[0]);
    assert!((report.after.edge_ratio.mean - 1.0).abs() < 1e-9);
    assert_eq!((report.moved, report.kept.boundary), (1, 6));
}

#[test]
fn one_equilateral_sweep_takes_the_centroid_of_the_potential_centers() {
    let mut mesh = hexagon();
    let options = Options { iterations: 1, relaxation: 1.0, ideal: Ideal::Equilateral, ..Options::default() };
    run(&mut mesh, &options);
    assert!(mesh.0[0].iter().all(|x| x.abs() < 1e-12), "over a regular ring all centers coincide: {:?}", mesh.0[0]);
}

#[test]
fn modelled_and_equilateral_ideals_differ() {
    let mut modelled = hexagon();
    run(&mut modelled, &Options { iterations: 1, relaxation: 1.0, ..Options::default() });
    assert!(modelled.0[0][0].abs() > 1e-3, "the model moves vertices less: {:?}", modelled.0[0]);
    assert!(modelled.0[0][0] < 0.4);
}

#[test]
fn zero_iterations_change_nothing() {
    let before = torus(12, 9, 0.3, 1);
    let mut after = before.clone();
    let report = run(&mut after, &Options { iterations: 0, ..Options::default() });
    assert_eq!(moved(&before, &after), Vec::<usize>::new());
    assert_eq!(report.moved, 0);
    assert!(report.kept.settled > 0);
}

#[test]
fn both_planes_keep_the_volume() {
    for plane in [Plane::VectorArea, Plane::LeastSquares] {
        let mut mesh = torus(24, 16, 0.35, 2);
        let report = run(&mut mesh, &Options { plane, ..Options::default() });
        assert!(report.volume_relative_change.abs() <= 1e-13, "{plane:?}: {}", report.volume_relative_change);
        assert!(report.after.edge_ratio.mean < report.before.edge_ratio.mean);
    }
}

#[test]
fn the_planes_differ() {
    let (mut area, mut squares) = (torus(24, 16, 0.35, 2), torus(24, 16, 0.35, 2));
    run(&mut area, &Options::default());
    run(&mut squares, &Options { plane: Plane::LeastSquares, ..Options::default() });
    assert!(!moved(&area, &squares).is_empty());
}

#[test]
fn a_cube_keeps_its_corners_edges_and_sides() {
    let before = cube(6, 0.35, 3);
    let mut after = before.clone();
    let report = run(&mut after, &Options { iterations: 5, ..Options::default() });
    assert_eq!(report.kept.corner, 8);
    assert_eq!(report.feature_edges, 12 * 6);
    for (old, new) in before.0.iter().zip(&after.0) {
        for axis in 0..3 {
            if old[axis].abs() == 1.0 {
                assert_eq!(old[axis], new[axis], "{old:?} has left its side: {new:?}");
            }
        }
    }
    let on_edge = |p: &[f64; 3]| p.iter().filter(|x| x.abs() == 1.0).count() == 2;
    let slid = moved(&before, &after).iter().filter(|&&v| on_edge(&before.0[v])).count();
    assert!(slid > 40, "edge vertices slide: {slid}");
    assert!(report.after.edge_ratio.mean < report.before.edge_ratio.mean);
    assert!(report.volume_relative_change.abs() < 1e-14);
}

#[test]
fn without_features_a_cube_loses_its_edges() {
    let mut mesh = cube(6, 0.35, 3);
    let report = run(&mut mesh, &Options { feature_angle: None, ..Options::default() });
    assert_eq!((report.feature_edges, report.kept.corner), (0, 0));
    assert!(report.volume_relative_change.abs() < 1e-13, "but not its volume");
    assert!(report.max_deviation > 0.01);
}

#[test]
fn marked_edges_are_features_even_in_a_plane() {
    let (positions, triangles) = sheet(8, 0.0, 0.3, 4);
    let diagonal_row: Vec<[u32; 2]> = (0..8).map(|c| [4 * 9 + c, 4 * 9 + c + 1]).collect();
    let mut straight = positions.clone();
    for p in &mut straight[4 * 9..5 * 9] {
        p[1] = 0.5;
    }
    let mut after = straight.clone();
    let constraints = Constraints { feature_edges: &diagonal_row, ..Constraints::default() };
    let report = smooth(&mut after, &triangles, &Options::default(), &constraints, &mut silent).unwrap();
    assert_eq!(report.feature_edges, 8);
    let row = 4 * 9 + 1..5 * 9 - 1;
    assert!(row.clone().all(|v| (after[v][1] - 0.5).abs() < 1e-15), "vertices on the line stay on it");
    assert!(row.clone().any(|v| after[v][0] != straight[v][0]), "and slide along it");
}

#[test]
fn a_marked_corner_stays_whatever_its_triangles_look_like() {
    let mut mesh = sheet(8, 0.3, 0.45, 4);
    let corner = 4 * 9 + 4;
    mesh.0[corner][0] -= 0.09; // slivers on one side
    let before = mesh.clone();
    let ell = [[corner as u32, corner as u32 + 1], [corner as u32, corner as u32 + 9]];
    let constraints = Constraints { feature_edges: &ell, ..Constraints::default() };
    let report = smooth(&mut mesh.0, &mesh.1, &Options::default(), &constraints, &mut silent).unwrap();
    assert_eq!(report.feature_edges, 2);
    assert!(!moved(&before, &mesh).contains(&corner));
    run(&mut mesh, &Options::default());
    assert!(moved(&before, &mesh).contains(&corner), "unmarked it is free");
}

#[test]
fn locked_vertices_keep_their_bits() {
    let before = torus(16, 10, 0.3, 5);
    let mut after = before.clone();
    let locked: Vec<bool> = (0..before.0.len()).map(|v| v % 3 == 0).collect();
    let constraints = Constraints { locked: &locked, ..Constraints::default() };
    let report = smooth(&mut after.0, &after.1, &Options::default(), &constraints, &mut silent).unwrap();
    let moved = moved(&before, &after);
    assert!(moved.iter().all(|&v| v % 3 != 0) && !moved.is_empty());
    assert_eq!(report.kept.locked, locked.iter().filter(|&&l| l).count());
}

#[test]
fn a_fixed_boundary_keeps_its_bits_and_a_sliding_one_its_line() {
    let mut before = sheet(8, 0.0, 0.3, 6);
    for (v, p) in before.0.iter_mut().enumerate() {
        if p[1] == 0.0 && p[0] > 0.0 && p[0] < 1.0 {
            p[0] += if v % 2 == 0 { 0.04 } else { -0.04 };
        }
    }
    let edge = |p: &[f64; 3]| p[0] == 0.0 || p[0] == 1.0 || p[1] == 0.0 || p[1] == 1.0;
    let mut fixed = before.clone();
    run(&mut fixed, &Options::default());
    assert!(moved(&before, &fixed).iter().all(|&v| !edge(&before.0[v])));

    let mut slid = before.clone();
    let report = run(&mut slid, &Options { boundary: Boundary::Slide, ..Options::default() });
    assert_eq!(report.kept.corner, 4);
    assert!(slid.0.iter().filter(|p| edge(p)).count() == 32, "all boundary vertices are still on the boundary");
    assert!(moved(&before, &slid).iter().any(|&v| edge(&before.0[v])));
    assert!((report.after.area - 1.0).abs() < 1e-14);
}

#[test]
fn a_deviation_bound_is_kept() {
    let before = torus(20, 12, 0.35, 7);
    let mut free = before.clone();
    let unbounded = run(&mut free, &Options::default());
    let bound = unbounded.max_deviation / 10.0;
    let mut mesh = before.clone();
    let report = run(&mut mesh, &Options { max_deviation: Some(bound), ..Options::default() });
    assert!(report.max_deviation <= bound && report.max_deviation > 0.0);
    assert!(report.after.edge_ratio.mean < report.before.edge_ratio.mean);

    let mut still = before.clone();
    let report = run(&mut still, &Options { max_deviation: Some(0.0), ..Options::default() });
    assert_eq!(report.moved, 0);
    assert!(report.kept.deviation > 0);
}

#[test]
fn a_folded_triangle_is_unfolded() {
    // A flat disc whose centre lies outside one edge of the ring.
    let mut mesh = hexagon();
    mesh.0[0] = [0.95, 0.55, 0.0];
    let before = mesh.clone();
    let report = run(&mut mesh, &Options { iterations: 4, ..Options::default() });
    assert_eq!(flipped(&before.0, &mesh.0, &mesh.1), meshes::folded(&before));
    assert!(mesh.1.iter().all(|t| meshes::normal(&mesh.0, t)[2] > 0.0), "{:?}", mesh.0[0]);
    assert!(report.after.min_angle.min > 30.0);
}

#[test]
fn zero_area_triangles_get_better() {
    let mut mesh = torus(16, 12, 0.0, 8);
    let neighbour = mesh.0[1];
    mesh.0[0] = neighbour;
    let report = run(&mut mesh, &Options { feature_angle: None, ..Options::default() });
    assert!(report.before.zero_area >= 2);
    assert_eq!(report.after.zero_area, 0);
    assert!(report.after.min_angle.min > 20.0, "{}", report.after.min_angle.min);
}

#[test]
fn non_manifold_unused_and_broken_parts_stay_and_are_counted() {
    let mut mesh = torus(12, 9, 0.3, 9);
    let v = mesh.0.len() as u32;
    mesh.0.extend([[9.0, 9.0, 9.0], [3.0, 3.0, 3.0]]);
    let [a, b, _] = mesh.1[20];
    mesh.1.push([a, b, v]); // a fin: edge a–b has three triangles
    mesh.1.push([5, 5, 6]); // names a vertex twice
    let before = mesh.clone();
    let report = run(&mut mesh, &Options::default());
    assert_eq!(report.skipped_triangles, 1);
    assert_eq!(report.kept.unreferenced, 1);
    assert_eq!(report.kept.non_manifold, 2);
    let moved = moved(&before, &mesh);
    assert!(![a, b, v, v + 1].iter().any(|&k| moved.contains(&(k as usize))));
    assert_eq!(moved.len(), report.moved);
}

#[test]
fn inconsistent_winding_counts_as_non_manifold() {
    let mut mesh = torus(12, 9, 0.3, 10);
    mesh.1[40].swap(1, 2);
    let corners = mesh.1[40];
    let before = mesh.clone();
    let report = run(&mut mesh, &Options::default());
    assert_eq!(report.kept.non_manifold, 3);
    assert!(corners.iter().all(|&v| before.0[v as usize] == mesh.0[v as usize]));
}

#[test]
fn duplicated_triangles_count_as_non_manifold() {
    let mut mesh = torus(12, 9, 0.3, 11);
    mesh.1.push(mesh.1[40]);
    let report = run(&mut mesh, &Options::default());
    assert_eq!(report.kept.non_manifold, 3);
}

#[test]
fn single_precision_gives_what_it_can_hold_and_keeps_the_volume() {
    let (positions, triangles) = torus(24, 16, 0.35, 12);
    let mut single = meshes::to_f32(&positions);
    let options = Options::default();
    let report = smooth(&mut single, &triangles, &options, &Constraints::default(), &mut silent).unwrap();
    assert!(report.volume_relative_change.abs() <= 1e-6);
    let measured = qsmesh::measure(&single, &triangles).unwrap();
    assert_eq!(measured, report.after, "the report describes the buffer's own bits");
}

#[test]
fn size_does_not_matter_to_the_bit() {
    let mut plain = torus(12, 9, 0.3, 13);
    let start = plain.0.clone();
    run(&mut plain, &Options::default());
    for exponent in [-900, -20, 20, 900] {
        let factor = 2.0_f64.powi(exponent);
        let mut scaled = (start.iter().map(|p| p.map(|x| x * factor)).collect::<Vec<_>>(), plain.1.clone());
        run(&mut scaled, &Options::default());
        let expected: Vec<_> = plain.0.iter().map(|p| p.map(|x| x * factor)).collect();
        assert_eq!(scaled.0, expected, "scaled by 2^{exponent}");
    }
}

#[test]
fn progress_is_a_share_even_where_nothing_can_move() {
    let mut mesh = sheet(8, 0.2, 0.3, 5);
    let locked = vec![true; mesh.0.len()];
    for order in [Order::Colors, Order::Index] {
        let mut calls = Vec::new();
        let mut listen = |done: f64| {
            calls.push(done);
            Flow::Continue
        };
        let constraints = Constraints { locked: &locked, ..Constraints::default() };
        let options = Options { order, ..Options::default() };
        smooth(&mut mesh.0, &mesh.1, &options, &constraints, &mut listen).unwrap();
        assert!(calls.iter().all(|done| (0.0..=1.0).contains(done)), "{calls:?}");
    }
}

#[test]
fn progress_rises_and_cancel_leaves_the_buffer() {
    let before = torus(120, 90, 0.3, 14);
    let mut calls = Vec::new();
    let mut after = before.clone();
    let mut listen = |done: f64| {
        calls.push(done);
        Flow::Continue
    };
    smooth(&mut after.0, &after.1, &Options::default(), &Constraints::default(), &mut listen).unwrap();
    assert!(calls.is_sorted() && calls[0] == 0.0 && calls[calls.len() - 1] == 1.0);
    assert!(calls.len() >= 2 * before.0.len() / qsmesh::progress::INTERVAL);

    for stop_at in 0..calls.len() {
        let mut mesh = before.clone();
        let mut heard = 0;
        let mut stop = |_: f64| {
            heard += 1;
            if heard > stop_at { Flow::Cancel } else { Flow::Continue }
        };
        let result = smooth(&mut mesh.0, &mesh.1, &Options::default(), &Constraints::default(), &mut stop);
        assert_eq!(result.unwrap_err(), Error::Cancelled);
        assert_eq!(heard, stop_at + 1, "not called again after it has cancelled");
        assert_eq!(mesh.0, before.0);
    }
}

#[test]
fn several_threads_tell_of_progress_and_stop_too() {
    let before = torus(260, 160, 0.3, 14);
    let options = Options { threads: 2, ..Options::default() };
    let run = |stop_at: usize| {
        let (mut mesh, mut calls) = (before.clone(), Vec::new());
        let mut listen = |done: f64| {
            calls.push(done);
            if calls.len() > stop_at { Flow::Cancel } else { Flow::Continue }
        };
        let result = smooth(&mut mesh.0, &mesh.1, &options, &Constraints::default(), &mut listen);
        (result, mesh, calls)
    };
    let (result, after, calls) = run(usize::MAX);
    assert!(result.is_ok() && after.0 != before.0);
    assert!(calls.is_sorted() && calls[0] == 0.0 && calls[calls.len() - 1] == 1.0);
    assert!(calls.len() >= 2 + 2 * options.iterations as usize, "{calls:?}");
    for stop_at in 0..calls.len() {
        let (result, stopped, heard) = run(stop_at);
        assert_eq!((result.unwrap_err(), heard.len()), (Error::Cancelled, stop_at + 1));
        assert_eq!(stopped.0, before.0);
    }
}

#[test]
fn each_misuse_names_its_offender() {
    let good = torus(8, 6, 0.2, 15);
    let call = |positions: &[[f64; 3]], triangles: &[[u32; 3]], options: &Options, constraints: &Constraints<'_>| {
        let mut copy = positions.to_vec();
        let error = smooth(&mut copy, triangles, options, constraints, &mut silent).unwrap_err();
        let bits = |p: &[[f64; 3]]| p.iter().map(|p| p.map(f64::to_bits)).collect::<Vec<_>>();
        assert_eq!(bits(&copy), bits(positions));
        error
    };
    let (options, free) = (Options::default(), Constraints::default());

    let mut wild = good.1.clone();
    wild[7][2] = 48;
    let error = call(&good.0, &wild, &options, &free);
    assert_eq!(error, Error::IndexOutOfRange { triangle: 7, index: 48, vertex_count: 48 });

    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut positions = good.0.clone();
        positions[11][1] = bad;
        assert_eq!(call(&positions, &good.1, &options, &free), Error::NonFinite { vertex: 11 });
    }
    let error = call(&good.0, &good.1, &options, &Constraints { locked: &[true; 3], ..free });
    assert_eq!(error, Error::LockLength { found: 3, vertex_count: 48 });
    let error = call(&good.0, &good.1, &options, &Constraints { feature_edges: &[[0, 1], [3, 50]], ..free });
    assert_eq!(error, Error::FeatureEdgeOutOfRange { edge: 1, index: 50, vertex_count: 48 });
}

#[test]
fn each_option_out_of_range_is_named() {
    type Setter = fn(&mut Options, f64);
    let set: [(&str, Setter, &[f64]); 7] = [
        ("iterations", |o, x| o.iterations = x as u32, &[10_001.0]),
        ("relaxation", |o, x| o.relaxation = x, &[0.0, -1.0, 2.1, f64::NAN]),
        ("interval_width", |o, x| o.interval_width = x, &[0.0, 1e-4, 1e4, f64::NAN]),
        ("sample_limit", |o, x| o.sample_limit = x, &[0.9, f64::INFINITY, f64::NAN]),
        ("quality_floor", |o, x| o.quality_floor = x, &[-0.1, 1.1, f64::NAN]),
        ("feature_angle", |o, x| o.feature_angle = Some(x), &[0.0, 180.0, f64::NAN]),
        ("max_deviation", |o, x| o.max_deviation = Some(x), &[-1.0, f64::INFINITY, f64::NAN]),
    ];
    for (name, change, values) in set {
        for &value in values {
            let mut options = Options::default();
            change(&mut options, value);
            match options.validate() {
                Err(Error::BadOption { name: named, .. }) => assert_eq!(named, name),
                other => panic!("{name} = {value}: {other:?}"),
            }
        }
    }
}

#[test]
fn tiny_inputs_give_a_result() {
    let corner: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let cases: [(&str, &[[u32; 3]]); 6] = [
        ("nothing", &[]),
        ("one triangle", &[[0, 1, 2]]),
        ("two triangles", &[[0, 1, 2], [2, 1, 3]]),
        ("two triangles back to back", &[[0, 1, 2], [0, 2, 1]]),
        ("a tetrahedron", &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]),
        ("one vertex three times", &[[1, 1, 1]]),
    ];
    for (name, triangles) in cases {
        let mut positions = corner.to_vec();
        let options = Options { feature_angle: None, boundary: Boundary::Slide, ..Options::default() };
        let report = smooth(&mut positions, triangles, &options, &Constraints::default(), &mut silent).expect(name);
        assert!(positions.iter().flatten().all(|x| x.is_finite()), "{name}");
        assert!(report.volume_relative_change.abs() < 1e-14, "{name}");
    }
    let mut none: Vec<[f64; 3]> = Vec::new();
    let report = smooth(&mut none, &[], &Options::default(), &Constraints::default(), &mut silent).unwrap();
    assert_eq!(report.moved, 0);
}

/// A cone of thin triangles around one apex.
fn cone(valence: u32) -> Mesh {
    let ring = (0..valence).map(|i| {
        let angle = f64::from(i) / f64::from(valence) * std::f64::consts::TAU;
        let fold = if i % 2 == 0 { 0.0 } else { 1e-6 };
        [angle.cos(), angle.sin(), fold]
    });
    let positions = std::iter::once([0.3, 0.0, 0.5]).chain(ring).collect();
    (positions, (0..valence).map(|i| [0, i + 1, (i + 1) % valence + 1]).collect())
}

#[test]
fn the_apex_of_ten_thousand_triangles_moves() {
    let mut mesh = cone(10_000);
    let report = run(&mut mesh, &Options { feature_angle: None, ..Options::default() });
    assert_eq!(report.moved, 1);
    assert!(mesh.0[0][0].abs() < 0.3);
}

/// With anything done per neighbour in proportion to the valence this would take hours.
#[test]
fn a_fan_of_half_a_million_triangles_ends() {
    let mut mesh = cone(500_000);
    let options = Options { boundary: Boundary::Slide, max_deviation: Some(1.0), ..Options::default() };
    let spokes: Vec<[u32; 2]> = (1..=100_000).map(|r| [0, r]).collect();
    let constraints = Constraints { feature_edges: &spokes, ..Constraints::default() };
    let report = smooth(&mut mesh.0, &mesh.1, &options, &constraints, &mut silent).expect("a result");
    assert!(report.feature_edges >= spokes.len(), "{}", report.feature_edges);
    assert!(report.moved + report.kept.guard >= 400_000, "the rim was visited: {:?}", report.kept);
    assert!(report.max_deviation.is_finite());
}

/// Large enough to be worth other numbers, and numbered at random: inside it gets numbers along a curve, outside nobody
/// sees that.
#[test]
fn a_large_mesh_numbered_at_random_is_smoothed_like_any_other() {
    let (positions, triangles) = torus(620, 430, 0.3, 1);
    let count = positions.len() as u32;
    let number = |v: u32| (u64::from(v) * 7919 % u64::from(count)) as u32;
    let mut given = (vec![[0.0; 3]; positions.len()], triangles.iter().map(|t| t.map(number)).collect::<Vec<_>>());
    (0..count).for_each(|v| given.0[number(v) as usize] = positions[v as usize]);
    let locked: Vec<bool> = (0..count).map(|v| v % 3 == 1).collect();
    let smoothed = |mesh: &Mesh, locked: &[bool], threads| {
        let (mut after, options) = (mesh.0.clone(), Options { threads, ..Options::default() });
        let constraints = Constraints { locked, ..Constraints::default() };
        let report = smooth(&mut after, &mesh.1, &options, &constraints, &mut silent).expect("a result");
        (after, report)
    };
    let (after, report) = smoothed(&given, &locked, 1);
    assert!((0..given.0.len()).all(|v| !locked[v] || after[v] == given.0[v]), "locked vertices stay");
    assert_eq!(report.kept.locked, locked.iter().filter(|&&locked| locked).count());
    assert!(report.volume_relative_change.abs() < 1e-12);
    assert!(smoothed(&given, &locked, 3).0 == after, "the same bits on any number of threads");
    let [scattered, rows] =
        [&given, &(positions, triangles)].map(|mesh| smoothed(mesh, &[], 0).1.after.edge_ratio.mean);
    assert!((scattered / rows - 1.0).abs() < 0.01, "another order, and as good: {scattered} {rows}");
}
