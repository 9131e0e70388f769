//! All or nothing.

use qsmesh::{Constraints, Error, Flow, Options, Sources, TailOptions};

use crate::meshes::{self, Soup};

/// Improves a mesh, cancelled when it has told of its progress `calls` times, and checks that nothing happened.
fn refused(options: &Options, tail: &TailOptions<'_>, calls: usize) -> Error {
    let before = meshes::torus(24, 12).jittered(5, 0.3);
    let mut after = before.clone();
    let untouched = Sources { vertex: vec![7], triangle: vec![8], corner: vec![9] };
    let mut sources = untouched.clone();
    let mut told = 0;
    let mut progress = |_: f64| {
        told += 1;
        if told == calls { Flow::Cancel } else { Flow::Continue }
    };
    let (positions, triangles) = (&mut after.positions, &mut after.triangles);
    let constraints = Constraints::default();
    let result = qsmesh::improve(positions, triangles, options, tail, &constraints, &mut sources, &mut progress);
    let error = result.expect_err("must be refused");
    assert_eq!(after, before, "an error must leave the buffers alone");
    assert_eq!(sources, untouched);
    error
}

#[test]
fn options_out_of_range_are_named() {
    let cases = [
        ("edge_ratio", TailOptions { edge_ratio: 1.0, ..TailOptions::default() }),
        ("edge_ratio", TailOptions { edge_ratio: f64::NAN, ..TailOptions::default() }),
        ("min_angle", TailOptions { min_angle: 60.0, ..TailOptions::default() }),
        ("max_angle", TailOptions { max_angle: 180.0, ..TailOptions::default() }),
        ("attempts", TailOptions { attempts: 0, ..TailOptions::default() }),
    ];
    for (field, tail) in cases {
        match refused(&Options::default(), &tail, 0) {
            Error::BadOption { name, .. } => assert_eq!(name, field),
            other => panic!("{other:?}"),
        }
    }
    let options = Options { relaxation: 0.0, ..Options::default() };
    let error = refused(&options, &TailOptions::default(), 0);
    assert_eq!(error, Error::BadOption { name: "relaxation", value: 0.0 });
}

#[test]
fn a_mask_of_the_wrong_length_is_refused() {
    let tail = TailOptions { mask: &[true; 5], ..TailOptions::default() };
    let error = refused(&Options::default(), &tail, 0);
    assert_eq!(error, Error::MaskLength { found: 5, triangle_count: 576 });
}

#[test]
fn a_cancelled_call_changes_nothing() {
    let tail = TailOptions { flips: true, ..TailOptions::default() };
    let calls = progress_of(&tail).len();
    assert!(calls > 4);
    for call in 1..=calls {
        assert_eq!(refused(&Options::default(), &tail, call), Error::Cancelled);
    }
}

#[test]
fn progress_never_falls_and_ends_at_one() {
    let told = progress_of(&TailOptions { flips: true, ..TailOptions::default() });
    assert!(told.windows(2).all(|w| w[0] <= w[1]), "{told:?}");
    assert_eq!((told.first(), told.last()), (Some(&0.0), Some(&1.0)));
}

/// All that a host is told while the mesh of these tests is improved.
fn progress_of(tail: &TailOptions<'_>) -> Vec<f64> {
    let Soup { mut positions, mut triangles } = meshes::torus(24, 12).jittered(5, 0.3);
    let mut told = Vec::new();
    let mut progress = |done: f64| {
        told.push(done);
        Flow::Continue
    };
    let (options, constraints, sources) = (Options::default(), Constraints::default(), &mut Sources::default());
    qsmesh::improve(&mut positions, &mut triangles, &options, tail, &constraints, sources, &mut progress)
        .expect("valid input");
    told
}
