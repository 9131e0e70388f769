//! A progress callback that does more than listen.

use std::panic::{AssertUnwindSafe, catch_unwind};

use qsmesh::progress::silent;
use qsmesh::{Constraints, Flow, Options, Sources, TailOptions, improve, measure, smooth};

use crate::meshes::{Mesh, torus};

fn call(mesh: &mut Mesh, progress: &mut dyn FnMut(f64) -> Flow) {
    let (tail, mut sources, fixed) = (TailOptions::default(), Sources::default(), Constraints::default());
    let options = Options { threads: 2, ..Options::default() };
    improve(&mut mesh.0, &mut mesh.1, &options, &tail, &fixed, &mut sources, progress).expect("a result");
}

#[test]
fn it_may_call_the_library_again() {
    // Large enough for threads of the call's own.
    for mesh in [torus(20, 12, 0.4, 1), torus(400, 120, 0.4, 2)] {
        let (mut quiet, mut busy) = (mesh.clone(), mesh);
        call(&mut quiet, &mut silent);
        let mut calls = 0;
        call(&mut busy, &mut |_| {
            calls += 1;
            let mut other = torus(8, 6, 0.3, calls);
            let before = measure(&other.0, &other.1).expect("a mesh");
            let fixed = Constraints::default();
            let report = smooth(&mut other.0, &other.1, &Options::default(), &fixed, &mut silent).expect("a result");
            assert_eq!(report.before, before);
            Flow::Continue
        });
        assert!(calls > 3, "the callback was hardly called");
        assert!(quiet == busy);
    }
}

#[test]
fn what_it_throws_passes_through_and_changes_nothing() {
    for mesh in [torus(20, 12, 0.4, 1), torus(400, 120, 0.4, 2)] {
        for patience in [0, 1, 4] {
            let (mut after, mut calls) = (mesh.clone(), 0);
            let thrown = catch_unwind(AssertUnwindSafe(|| {
                call(&mut after, &mut |_| {
                    calls += 1;
                    if calls > patience { std::panic::resume_unwind(Box::new(77)) } else { Flow::Continue }
                });
            }));
            assert_eq!(thrown.expect_err("it throws").downcast_ref(), Some(&77));
            assert!(after == mesh, "changed on an error");
        }
    }
}
