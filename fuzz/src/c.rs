//! The C interface as a host sees it, written down once more.

use std::ffi::{c_char, c_void};

// Links the exported functions in.
use qsmesh as _;

pub const OK: i32 = 0;
pub const PANIC: i32 = 14;
pub const LAST: i32 = 15;

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Options {
    pub struct_size: usize,
    pub iterations: u32,
    pub plane: i32,
    pub ideal: i32,
    pub boundary: i32,
    pub order: i32,
    pub threads: u32,
    pub relaxation: f64,
    pub interval_width: f64,
    pub sample_limit: f64,
    pub quality_floor: f64,
    pub feature_angle: f64,
    pub max_deviation: f64,
    pub vertex_lock: *const u8,
    pub feature_edges: *const u32,
    pub feature_edge_count: usize,
    pub progress: Option<unsafe extern "C" fn(f64, *mut c_void) -> i32>,
    pub user: *mut c_void,
    pub tail_edge_ratio: f64,
    pub tail_min_angle: f64,
    pub tail_max_angle: f64,
    pub tail_attempts: u32,
    pub flips: i32,
    pub tail_operations: usize,
    pub triangle_mask: *const u8,
    pub method: i32,
    pub metric: i32,
    pub keep_sizes: i32,
    pub unused: i32,
    pub seeds: *const u8,
    pub visits: *const u32,
    pub visit_count: usize,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Leftover {
    pub triangle: u32,
    pub defect: i32,
    pub reason: i32,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Maps {
    pub struct_size: usize,
    pub vertex_source: *mut u32,
    pub triangle_source: *mut u32,
    pub corner_source: *mut u32,
    pub leftovers: *mut Leftover,
    pub leftover_capacity: usize,
    pub leftover_count: usize,
}

/// Room for a `qsm_report` or a `qsm_measurement`, whose fields no target looks at.
#[repr(C, align(8))]
#[derive(Clone, Copy, PartialEq)]
pub struct Opaque(pub [u8; 2048]);

/// Buffers and what goes with them, in the order of every call that may make a mesh smaller.
pub type Shrink<T> = unsafe extern "C" fn(
    *mut T,
    *mut usize,
    usize,
    *mut u32,
    *mut usize,
    *const Options,
    *mut Maps,
    *mut Opaque,
) -> i32;
pub type Smooth<T> =
    unsafe extern "C" fn(*mut T, usize, usize, *const u32, usize, *const Options, *mut Opaque) -> i32;
pub type Measure<T> = unsafe extern "C" fn(*const T, usize, usize, *const u32, usize, *mut Opaque) -> i32;
pub type Histogram<T> = unsafe extern "C" fn(
    *const T,
    usize,
    usize,
    *const u32,
    usize,
    i32,
    f64,
    f64,
    *mut usize,
    usize,
) -> i32;

unsafe extern "C" {
    pub fn qsm_options_init(options: *mut Options);
    pub fn qsm_report_init(report: *mut Opaque);
    pub fn qsm_measurement_init(out: *mut Opaque);
    pub fn qsm_maps_init(maps: *mut Maps);
    pub fn qsm_status_string(status: i32) -> *const c_char;
    pub fn qsm_smooth_f32(
        p: *mut f32, n: usize, stride: usize, i: *const u32, m: usize, o: *const Options, r: *mut Opaque,
    ) -> i32;
    pub fn qsm_smooth_f64(
        p: *mut f64, n: usize, stride: usize, i: *const u32, m: usize, o: *const Options, r: *mut Opaque,
    ) -> i32;
    pub fn qsm_collapse_tails_f32(
        p: *mut f32, n: *mut usize, s: usize, i: *mut u32, m: *mut usize, o: *const Options, a: *mut Maps, r: *mut Opaque,
    ) -> i32;
    pub fn qsm_collapse_tails_f64(
        p: *mut f64, n: *mut usize, s: usize, i: *mut u32, m: *mut usize, o: *const Options, a: *mut Maps, r: *mut Opaque,
    ) -> i32;
    pub fn qsm_improve_f32(
        p: *mut f32, n: *mut usize, s: usize, i: *mut u32, m: *mut usize, o: *const Options, a: *mut Maps, r: *mut Opaque,
    ) -> i32;
    pub fn qsm_improve_f64(
        p: *mut f64, n: *mut usize, s: usize, i: *mut u32, m: *mut usize, o: *const Options, a: *mut Maps, r: *mut Opaque,
    ) -> i32;
    pub fn qsm_measure_f32(p: *const f32, n: usize, s: usize, i: *const u32, m: usize, out: *mut Opaque) -> i32;
    pub fn qsm_measure_f64(p: *const f64, n: usize, s: usize, i: *const u32, m: usize, out: *mut Opaque) -> i32;
    pub fn qsm_histogram_f32(
        p: *const f32, n: usize, s: usize, i: *const u32, m: usize, q: i32, l: f64, w: f64, c: *mut usize, b: usize,
    ) -> i32;
    pub fn qsm_histogram_f64(
        p: *const f64, n: usize, s: usize, i: *const u32, m: usize, q: i32, l: f64, w: f64, c: *mut usize, b: usize,
    ) -> i32;
}

/// Options with the defaults.
pub fn default_options() -> Options {
    let mut options = std::mem::MaybeUninit::<Options>::zeroed();
    // SAFETY: there is room for the struct, whose size is compared below; all zero bits are a value of it.
    let options = unsafe {
        qsm_options_init(options.as_mut_ptr());
        options.assume_init()
    };
    assert_eq!(options.struct_size, size_of::<Options>(), "this mirror of the header is out of date");
    options
}
