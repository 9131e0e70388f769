//! Memory that cannot be had: each large allocation of a call fails once, and the call says so.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use qsmesh::progress::silent;
use qsmesh::{Constraints, Error, Options, Order, Parameter, Sources, TailOptions};
use qsmesh::{collapse_tails, histogram, improve, measure, smooth};

use crate::meshes::{Mesh, torus};

/// Bytes from which on an allocation is large. What a call takes for the vertices or the triangles of the mesh below is more,
/// be it a byte for each; what it takes whatever the mesh, less.
const LARGE: usize = 32 << 10;

thread_local! {
    /// Large allocations of this thread that still succeed.
    static LEFT: Cell<usize> = const { Cell::new(usize::MAX) };
    /// Bytes from which on this thread gets nothing.
    static LIMIT: Cell<usize> = const { Cell::new(usize::MAX) };
    /// How often it has asked for as many.
    static REFUSED: Cell<usize> = const { Cell::new(0) };
}

/// The system's allocator, which fails on this thread when its time has come.
struct Failing;

impl Failing {
    fn may_have(bytes: usize) -> bool {
        if LIMIT.try_with(|limit| bytes >= limit.get()).unwrap_or(false) {
            REFUSED.set(REFUSED.get() + 1);
            return false;
        }
        bytes < LARGE || LEFT.try_with(|left| left.replace(left.get().saturating_sub(1)) > 0).unwrap_or(true)
    }
}

// SAFETY: every call is handed on to the system's allocator, or answered with NULL, which an allocator may do.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for Failing {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as above.
        if Self::may_have(layout.size()) { unsafe { System.alloc(layout) } } else { std::ptr::null_mut() }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as above.
        if Self::may_have(layout.size()) { unsafe { System.alloc_zeroed(layout) } } else { std::ptr::null_mut() }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: as above.
        if Self::may_have(size) { unsafe { System.realloc(pointer, layout, size) } } else { std::ptr::null_mut() }
    }
}

#[global_allocator]
static ALLOCATOR: Failing = Failing;

/// Runs the call with the `k`-th large allocation and all that follow failing, for every `k` until it succeeds. The
/// caller's mesh is as it was after each failure.
fn assert_survives<R>(name: &str, mesh: &Mesh, call: impl Fn(&mut Mesh) -> Result<R, Error>) {
    for succeed in 0.. {
        let mut after = mesh.clone();
        LEFT.set(succeed);
        let result = call(&mut after);
        LEFT.set(usize::MAX);
        match result {
            Ok(_) => {
                assert!(succeed > 0, "{name}: no large allocation was made, so nothing is shown");
                return;
            }
            Err(error) => assert!(matches!(error, Error::OutOfMemory { .. }), "{name}: {error}"),
        }
        assert!(after == *mesh, "{name}: changed on an error");
    }
}

fn mesh() -> Mesh {
    torus(222, 150, 0.1, 3)
}

fn options() -> Vec<Options> {
    let by_index = Options { order: Order::Index, feature_angle: None, measure: false, ..Options::default() };
    let with = |order| Options { order, iterations: 1, measure: false, ..Options::default() };
    let sizes = Options { keep_sizes: true, ..with(Order::Given) };
    vec![
        Options { max_deviation: Some(0.1), ..Options::default() },
        by_index,
        with(Order::Wave),
        with(Order::Tail),
        sizes,
    ]
}

#[test]
fn measuring_without_memory() {
    assert_survives("measure", &mesh(), |mesh| measure(&mesh.0, &mesh.1));
    assert_survives("histogram", &mesh(), |mesh| histogram(&mesh.0, &mesh.1, Parameter::Shape, 0.0, 1e-4, 10_000));
}

#[test]
fn smoothing_without_memory() {
    let visits: Vec<u32> = (0..mesh().0.len() as u32).collect();
    for options in options() {
        let fixed = Constraints { visits: &visits, ..Constraints::default() };
        assert_survives("smooth", &mesh(), |mesh| smooth(&mut mesh.0, &mesh.1, &options, &fixed, &mut silent));
    }
}

/// Address space for large pages is taken where it can be had, and done without elsewhere.
#[test]
fn smoothing_with_little_address_space() {
    let before = torus(700, 520, 0.1, 3);
    let options = Options { threads: 1, iterations: 1, measure: false, ..Options::default() };
    let smoothed = |limit| {
        let mut mesh = before.clone();
        LIMIT.set(limit);
        let done = smooth(&mut mesh.0, &mesh.1, &options, &Constraints::default(), &mut silent);
        LIMIT.set(usize::MAX);
        done.map(|_| mesh.0)
    };
    let expected = smoothed(usize::MAX).expect("memory");
    assert!(REFUSED.get() == 0 && expected != before.0);
    // No array of this mesh needs as much.
    assert_eq!(smoothed(32 << 20).expect("memory enough"), expected);
    assert_eq!(REFUSED.get() > 0, cfg!(all(target_os = "linux", target_pointer_width = "64")));
}

#[test]
fn the_tail_without_memory() {
    let harsh = TailOptions {
        edge_ratio: 1.5,
        min_angle: 45.0,
        max_angle: 80.0,
        operations: Some(20),
        ..TailOptions::default()
    };
    let fixed = Constraints::default();
    let flips = TailOptions { flips: true, operations: Some(20), ..TailOptions::default() };
    for (options, tail) in options().iter().zip([flips, harsh]) {
        assert_survives("collapse_tails", &mesh(), |(points, all)| {
            collapse_tails(points, all, options, &tail, &fixed, &mut Sources::default(), &mut silent)
        });
        assert_survives("improve", &mesh(), |(points, all)| {
            improve(points, all, options, &tail, &fixed, &mut Sources::default(), &mut silent)
        });
    }
}
