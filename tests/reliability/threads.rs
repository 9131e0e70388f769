//! Many callers at once.

use std::sync::Barrier;
use std::thread;

use qsmesh::progress::silent;
use qsmesh::{Constraints, Options, Parameter, Sources, TailOptions, histogram, improve, measure, smooth};

use crate::meshes::{Mesh, torus};

fn improved((positions, triangles): &Mesh, threads: u32) -> Mesh {
    let (mut positions, mut triangles) = (positions.clone(), triangles.clone());
    let (options, fixed) = (Options { threads, ..Options::default() }, Constraints::default());
    let (tail, mut sources) = (TailOptions::default(), Sources::default());
    improve(&mut positions, &mut triangles, &options, &tail, &fixed, &mut sources, &mut silent).expect("a result");
    (positions, triangles)
}

#[test]
fn calls_on_different_meshes_do_not_disturb_each_other() {
    let meshes: Vec<Mesh> = (0..12).map(|k| torus(20 + k, 10, 0.4, u64::from(k))).collect();
    let alone: Vec<Mesh> = meshes.iter().map(|mesh| improved(mesh, 1)).collect();
    let start = Barrier::new(meshes.len());
    let together: Vec<Mesh> = thread::scope(|scope| {
        let call = |mesh| {
            start.wait();
            (0..5).map(|_| improved(mesh, 0)).next_back()
        };
        let running: Vec<_> = meshes.iter().map(|mesh| scope.spawn(move || call(mesh))).collect();
        running.into_iter().filter_map(|thread| thread.join().expect("no panic")).collect()
    });
    assert!(alone == together);
}

#[test]
fn calls_that_start_threads_of_their_own_do_not_either() {
    let meshes: Vec<Mesh> = (0..3).map(|k| torus(400, 120, 0.4, k)).collect();
    let alone: Vec<_> = meshes.iter().map(|mesh| smoothed(mesh, 1)).collect();
    let together: Vec<_> = thread::scope(|scope| {
        let running: Vec<_> = meshes.iter().map(|mesh| scope.spawn(move || smoothed(mesh, 4))).collect();
        running.into_iter().map(|thread| thread.join().expect("no panic")).collect()
    });
    assert!(alone == together);
}

fn smoothed((positions, triangles): &Mesh, threads: u32) -> Vec<[f64; 3]> {
    let mut positions = positions.clone();
    let options = Options { threads, measure: false, ..Options::default() };
    smooth(&mut positions, triangles, &options, &Constraints::default(), &mut silent).expect("a result");
    positions
}

#[test]
fn one_mesh_is_measured_by_many_at_once() {
    let (positions, triangles) = torus(60, 30, 0.4, 1);
    let figures = || {
        let counts = histogram(&positions, &triangles, Parameter::EdgeRatio, 1.0, 0.25, 20).expect("a histogram");
        (measure(&positions, &triangles).expect("a measurement"), counts)
    };
    let alone = figures();
    thread::scope(|scope| {
        let running: Vec<_> = (0..8).map(|_| scope.spawn(figures)).collect();
        running.into_iter().for_each(|thread| assert!(thread.join().expect("no panic") == alone));
    });
}
