//! The worst meshes under options at their extremes.

use qsmesh::{Error, Options, TailOptions};

use crate::promises::{assert_improves, assert_refused, assert_smooths};
use crate::{extremes, meshes, shapes};

/// What single precision may add to the volume: it is lost in the cancellation of coordinates far from the origin.
const SINGLE: f64 = 1e-6;
const DOUBLE: f64 = 1e-12;

/// Whether the mesh can be had in single precision at all.
fn fits_single(positions: &[[f64; 3]]) -> bool {
    let sizes = || positions.iter().flatten().map(|x| x.abs()).filter(|&x| x > 0.0);
    sizes().all(|x| x < 1e30) && sizes().fold(0.0, f64::max) > 1e-30
}

/// How much of the volume is rounding: the farther away, the more.
fn rounding(name: &str) -> f64 {
    if name.starts_with("far") { 1.0 } else { DOUBLE }
}

#[test]
fn smoothing_holds_its_promises_on_the_worst_meshes() {
    for (name, (positions, triangles)) in shapes::all() {
        for (k, options) in extremes::options().iter().enumerate() {
            let name = format!("{name}, options {k}");
            assert_smooths(&name, &positions, &triangles, options, rounding(&name));
            if fits_single(&positions) && !name.starts_with("far") {
                assert_smooths(&name, &meshes::to_f32(&positions), &triangles, options, SINGLE);
            }
        }
    }
}

#[test]
fn the_tail_holds_its_promises_on_the_worst_meshes() {
    for (name, (positions, triangles)) in shapes::all() {
        for (k, tail) in extremes::tails().iter().enumerate() {
            let name = format!("{name}, tail {k}");
            let free = Options { feature_angle: None, ..Options::default() };
            assert_improves(&name, (&positions, &triangles), &free, tail, rounding(&name));
            if fits_single(&positions) && !name.starts_with("far") {
                let single = meshes::to_f32(&positions);
                assert_improves(&name, (&single, &triangles), &Options::default(), tail, SINGLE);
            }
        }
    }
}

#[test]
fn the_tail_holds_its_promises_under_extreme_options() {
    for (name, (positions, triangles)) in shapes::all() {
        for (k, options) in extremes::options().iter().enumerate() {
            let name = format!("{name}, options {k}");
            let tail = TailOptions { operations: Some(10), ..TailOptions::default() };
            assert_improves(&name, (&positions, &triangles), options, &tail, rounding(&name));
        }
    }
}

#[test]
fn vertices_of_any_valence() {
    for valence in [3, 10, 100, 1000, 10_000] {
        let (positions, triangles) = shapes::spindle(valence);
        let name = format!("valence {valence}");
        assert_smooths(&name, &positions, &triangles, &Options::default(), DOUBLE);
        let tail = TailOptions::default();
        assert_improves(&name, (&positions, &triangles), &Options::default(), &tail, DOUBLE);
    }
}

#[test]
fn as_many_sweeps_as_can_be_asked_for() {
    for (name, (positions, triangles)) in [
        ("fan", shapes::fan(7, 0.2)),
        ("tetrahedron", shapes::smallest_closed()[1].clone()),
        ("blade", shapes::all_features()),
    ] {
        let options = Options { iterations: 10_000, relaxation: 2.0, ..Options::default() };
        assert_smooths(name, &positions, &triangles, &options, 1e-11);
    }
}

#[test]
fn what_cannot_be_read_is_refused_and_stays() {
    for (name, mesh) in shapes::all().into_iter().filter(|(_, mesh)| !mesh.1.is_empty()) {
        let vertex_count = mesh.0.len();
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut broken = mesh.clone();
            broken.0[vertex_count - 1][1] = bad;
            assert_refused(&name, &broken, &Options::default(), &Error::NonFinite { vertex: vertex_count - 1 });
        }
        for index in [vertex_count as u32, u32::MAX] {
            let mut broken = mesh.clone();
            let triangle = broken.1.len() - 1;
            broken.1[triangle][2] = index;
            let expected = Error::IndexOutOfRange { triangle, index, vertex_count };
            assert_refused(&name, &broken, &Options::default(), &expected);
        }
        let options = Options { relaxation: 2.1, ..Options::default() };
        assert_refused(&name, &mesh, &options, &Error::BadOption { name: "relaxation", value: 2.1 });
    }
}
