//! Measuring, apart from improving.

mod meshes;

use meshes::{cube, scattered, torus};
use qsmesh::{Error, Parameter, histogram, measure};

#[test]
fn a_cube_measures_as_a_cube() {
    let (positions, triangles) = cube(4, 0.0, 1);
    let m = measure(&positions, &triangles).unwrap();
    assert!((m.volume - 8.0).abs() < 1e-14);
    assert!((m.area - 24.0).abs() < 1e-13);
    assert_eq!((m.vertices, m.triangles), (98, 192));
    assert_eq!((m.boundary_edges, m.non_manifold_edges, m.zero_area), (0, 0, 0));
    assert!((m.edge_ratio.mean - 2.0_f64.sqrt()).abs() < 1e-14 && m.edge_ratio.variance < 1e-28);
    assert!((m.min_angle.min - 45.0).abs() < 1e-10 && (m.max_angle.max - 90.0).abs() < 1e-10);
}

#[test]
fn inside_out_has_a_negative_volume() {
    let (positions, mut triangles) = cube(2, 0.0, 1);
    triangles.iter_mut().for_each(|t| t.swap(1, 2));
    assert!((measure(&positions, &triangles).unwrap().volume + 8.0).abs() < 1e-14);
}

#[test]
fn an_open_mesh_has_boundary_edges() {
    let (positions, triangles) = scattered(50, 2);
    let m = measure(&positions, &triangles).unwrap();
    assert!(m.boundary_edges >= 4 && !m.is_closed());
    assert!((m.area - 1.0).abs() < 1e-13);
}

#[test]
fn percentiles_rise_and_lie_between_the_extremes() {
    let (positions, triangles) = torus(20, 14, 0.4, 3);
    let m = measure(&positions, &triangles).unwrap();
    for d in [m.edge_ratio, m.min_angle, m.max_angle, m.shape, m.radius_ratio] {
        assert!(d.percentiles.is_sorted());
        assert!(d.min <= d.percentiles[0] && d.percentiles[6] <= d.max && d.min < d.max);
        assert!(d.min < d.mean && d.mean < d.max && d.variance > 0.0);
    }
}

#[test]
fn counts_below_angles_match_the_histogram() {
    let (positions, triangles) = scattered(300, 4);
    let m = measure(&positions, &triangles).unwrap();
    let bins = histogram(&positions, &triangles, Parameter::MinAngle, 0.0, 10.0, 6).unwrap();
    assert_eq!(bins.iter().sum::<usize>(), triangles.len());
    assert_eq!([bins[0], bins[0] + bins[1], bins[0] + bins[1] + bins[2]], [m.below_10, m.below_20, m.below_30]);
    assert!(m.below_10 > 0 && m.below_30 > m.below_20);
}

#[test]
fn a_histogram_takes_everything_in() {
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]];
    let triangles = [[0, 1, 2], [0, 1, 3]];
    let bins = histogram(&positions, &triangles, Parameter::EdgeRatio, 1.0, 0.25, 4).unwrap();
    assert_eq!(bins, [0, 1, 0, 1], "√2, and infinity in the last");
    let bins = histogram(&positions, &triangles, Parameter::EdgeRatio, 5.0, 0.25, 4).unwrap();
    assert_eq!(bins, [1, 0, 0, 1], "what is below goes into the first");
}

#[test]
fn histogram_names_its_bad_arguments() {
    let (positions, triangles) = cube(2, 0.0, 1);
    let call = |lower, interval, bins| histogram(&positions, &triangles, Parameter::Shape, lower, interval, bins);
    for (result, expected) in [
        (call(0.0, 0.0, 3), "interval"),
        (call(0.0, f64::NAN, 3), "interval"),
        (call(f64::INFINITY, 1.0, 3), "lower"),
        (call(0.0, 1.0, 0), "bins"),
    ] {
        assert!(matches!(result, Err(Error::BadOption { name, .. }) if name == expected), "{result:?}");
    }
}

#[test]
fn measuring_refuses_what_it_cannot_read() {
    let error = measure(&[[0.0_f32; 3]; 2], &[[0, 1, 2]]).unwrap_err();
    assert_eq!(error, Error::IndexOutOfRange { triangle: 0, index: 2, vertex_count: 2 });
    let error = measure(&[[f64::NAN, 0.0, 0.0]], &[]).unwrap_err();
    assert_eq!(error, Error::NonFinite { vertex: 0 });
}
