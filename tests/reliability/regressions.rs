//! What fuzzing has found, as small as it can be.

use qsmesh::progress::silent;
use qsmesh::{Constraints, Options, Sources, TailOptions, improve, smooth};

use crate::shapes;

/// The volume overflows, and the difference of two infinite ones is no number.
#[test]
fn a_volume_that_no_number_can_hold_has_no_change() {
    let (mut positions, triangles) = shapes::scaled(shapes::spindle(12), 1e300);
    let report = smooth(&mut positions, &triangles, &Options::default(), &Constraints::default(), &mut silent);
    let report = report.expect("a result");
    assert!(report.moved > 0 && report.before.volume.is_infinite());
    assert_eq!(report.volume_relative_change, 0.0);
}

/// Two triangles back to back collapse to nothing, and a triangle without any extent names the vertex that they lose.
#[test]
fn a_vertex_of_a_degenerate_triangle_is_not_removed() {
    let mut positions = vec![[0.1_f32, 0.0, 0.0], [-1.0, 0.0, 0.0], [4.25e37, 1.0, 0.0], [0.0; 3], [0.5, 0.0, 4e-5]];
    let mut triangles = vec![[0, 1, 2], [0, 3, 1], [0, 1, 3], [3, 3, 4]];
    let (options, tail, free) = (Options::default(), TailOptions::default(), Constraints::default());
    let mut sources = Sources::default();
    improve(&mut positions, &mut triangles, &options, &tail, &free, &mut sources, &mut silent).expect("a result");
    assert!(triangles.as_flattened().iter().all(|&v| (v as usize) < positions.len()), "{triangles:?}");
    assert!(triangles.iter().any(|t| t[0] == t[1]), "the degenerate triangle stays: {triangles:?}");
}
