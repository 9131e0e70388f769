//! Every function of the C interface on any buffers, counts, strides, structs and options. Buffers are as long as the
//! call says, to the byte, so that the address sanitizer sees each step beside them; only a call that must be refused
//! by address alone may lie about them.
#![no_main]

use std::ptr::{null, null_mut};

use libfuzzer_sys::fuzz_target;
use qsmesh_fuzz::c;
use qsmesh_fuzz::input::{self, Bytes, Soup};

/// One precision of the interface.
struct Precision<T> {
    smooth: c::Smooth<T>,
    shrink: [c::Shrink<T>; 2],
    measure: c::Measure<T>,
    histogram: c::Histogram<T>,
    narrow: fn(f64) -> T,
}

const SINGLE: Precision<f32> = Precision {
    smooth: c::qsm_smooth_f32,
    shrink: [c::qsm_collapse_tails_f32, c::qsm_improve_f32],
    measure: c::qsm_measure_f32,
    histogram: c::qsm_histogram_f32,
    narrow: |x| x as f32,
};

const DOUBLE: Precision<f64> = Precision {
    smooth: c::qsm_smooth_f64,
    shrink: [c::qsm_collapse_tails_f64, c::qsm_improve_f64],
    measure: c::qsm_measure_f64,
    histogram: c::qsm_histogram_f64,
    narrow: |x| x,
};

/// The caller's memory.
struct Host {
    positions: Vec<u8>,
    /// Bytes in front of the first position.
    lead: usize,
    stride: usize,
    vertices: usize,
    indices: Vec<u32>,
    locks: Vec<u8>,
    mask: Vec<u8>,
    edges: Vec<u32>,
    sources: [Vec<u32>; 3],
    leftovers: Vec<c::Leftover>,
    report: c::Opaque,
}

fuzz_target!(|bytes: &[u8]| {
    let bytes = &mut Bytes(bytes);
    if bytes.flag() { call(&SINGLE, bytes) } else { call(&DOUBLE, bytes) }
});

fn call<T: Copy>(precision: &Precision<T>, bytes: &mut Bytes<'_>) {
    let mut host = Host::new(precision, bytes);
    let options = options(&host, bytes);
    let before = (host.positions.clone(), host.indices.clone());
    let kind = bytes.below(5);
    let status = match kind {
        0 => smooth(precision, &mut host, &options, bytes),
        1 => measure(precision, &mut host, bytes),
        2 => histogram(precision, &mut host, bytes),
        _ => shrink(precision.shrink[kind - 3], &mut host, &options, bytes),
    };
    assert!((c::OK..=c::LAST).contains(&status) && status != c::PANIC, "status {status}");
    // SAFETY: the text lives for ever.
    assert!(!unsafe { std::ffi::CStr::from_ptr(c::qsm_status_string(status)) }.is_empty());
    if status != c::OK {
        assert!(before == (host.positions, host.indices), "changed on an error");
    } else {
        host.assert_gaps::<T>(&before.0);
    }
}

impl Host {
    fn new<T: Copy>(precision: &Precision<T>, bytes: &mut Bytes<'_>) -> Self {
        let Soup { positions, triangles } = input::soup(bytes);
        let vertex = 3 * size_of::<T>();
        let stride = vertex + bytes.choice(&[0, 0, 4, 8, 20, 1]);
        let lead = bytes.choice(&[0, 0, 0, 8, 4, 1]);
        let vertices = positions.len();
        let mut memory = vec![0xA5; lead + (vertices * stride).saturating_sub(stride - vertex)];
        for (v, position) in positions.iter().enumerate() {
            for (k, &x) in position.iter().enumerate() {
                let value = (precision.narrow)(if bytes.0.len() == 77 { f64::NAN } else { x });
                let at = lead + v * stride + k * size_of::<T>();
                // SAFETY: the place lies within the memory; it may be unaligned.
                unsafe { memory.as_mut_ptr().add(at).cast::<T>().write_unaligned(value) };
            }
        }
        let mut indices = triangles.into_flattened();
        if bytes.below(16) == 0 {
            indices.push(bytes.below(256) as u32);
        }
        if bytes.below(16) == 0 && !indices.is_empty() {
            let at = bytes.below(indices.len());
            indices[at] = bytes.word() as u32;
        }
        let corners = indices.len();
        Self {
            locks: (0..vertices).map(|_| u8::from(bytes.below(4) == 3)).collect(),
            mask: (0..corners / 3).map(|_| bytes.byte() & 1).collect(),
            edges: (0..2 * bytes.below(6)).map(|_| bytes.below(vertices + 1) as u32).collect(),
            sources: [vec![7; vertices], vec![7; corners / 3], vec![7; corners]],
            leftovers: vec![c::Leftover { triangle: 7, defect: 7, reason: 7 }; bytes.below(5)],
            report: c::Opaque([0; 2048]),
            positions: memory,
            lead,
            stride,
            vertices,
            indices,
        }
    }

    fn start<T>(&mut self) -> *mut T {
        // SAFETY: the lead lies within the memory.
        unsafe { self.positions.as_mut_ptr().add(self.lead).cast() }
    }

    /// Bytes in front of and between the vertices are not the library's.
    fn assert_gaps<T>(&self, before: &[u8]) {
        let vertex = 3 * size_of::<T>();
        let is_gap = |at: usize| at < self.lead || (at - self.lead) % self.stride >= vertex;
        let changed = (0..before.len()).find(|&at| is_gap(at) && before[at] != self.positions[at]);
        assert_eq!(changed, None, "a byte between two vertices has changed");
    }
}

/// Counts that no buffer can have, in one of eight calls.
fn unlikely(bytes: &mut Bytes<'_>, count: usize) -> usize {
    if bytes.below(8) == 0 { bytes.choice(&[usize::MAX, usize::MAX / 2, usize::MAX / 3 * 3, 1 << 62]) } else { count }
}

fn options(host: &Host, bytes: &mut Bytes<'_>) -> c::Options {
    let (method, tail) = (input::options(bytes), input::tail_options(bytes));
    let mut options = c::Options {
        iterations: method.iterations,
        plane: bytes.choice(&[0, 1, 0, 1, 2, -1]),
        ideal: bytes.choice(&[0, 1, 0, 1, 2, i32::MIN]),
        boundary: bytes.choice(&[0, 1, 0, 1, 2, i32::MAX]),
        order: bytes.choice(&[0, 1, 2, 3, 4, 0, 5, -1]),
        method: bytes.choice(&[0, 0, 0, 1, 2, 3, -1]),
        metric: bytes.choice(&[0, 0, 1, 2, 3, 4, 5, -1]),
        keep_sizes: bytes.choice(&[0, 0, 1, 2]),
        threads: method.threads,
        relaxation: method.relaxation,
        interval_width: method.interval_width,
        sample_limit: method.sample_limit,
        quality_floor: method.quality_floor,
        feature_angle: method.feature_angle.unwrap_or(0.0),
        max_deviation: method.max_deviation.unwrap_or(f64::INFINITY),
        tail_edge_ratio: tail.edge_ratio,
        tail_min_angle: tail.min_angle,
        tail_max_angle: tail.max_angle,
        tail_attempts: tail.attempts,
        flips: bytes.choice(&[0, 1, 0, 1, 2]),
        tail_operations: tail.operations.unwrap_or(0),
        ..c::default_options()
    };
    if bytes.flag() {
        options.vertex_lock = host.locks.as_ptr();
    }
    if bytes.flag() {
        options.triangle_mask = host.mask.as_ptr();
    }
    if bytes.flag() {
        options.feature_edges = if bytes.below(8) == 0 { null() } else { host.edges.as_ptr() };
        options.feature_edge_count = host.edges.len() / 2;
    }
    if bytes.flag() {
        options.seeds = host.locks.as_ptr();
    }
    if bytes.flag() {
        options.visits = if bytes.below(8) == 0 { null() } else { host.edges.as_ptr() };
        options.visit_count = host.edges.len();
    }
    if bytes.below(8) == 0 {
        // Overlaps memory that is written.
        options.vertex_lock = host.positions.as_ptr();
    }
    if bytes.below(8) == 0 {
        options.struct_size = bytes.choice(&[0, 1, 96, 112, 120, 128, 184, 200, usize::MAX, 223]);
    }
    options
}

/// A report, none, or one whose size or place is wrong.
fn report(host: &mut Host, bytes: &mut Bytes<'_>) -> *mut c::Opaque {
    let place = match bytes.below(4) {
        0 => return null_mut(),
        1 if host.positions.len() > 4096 => return host.positions.as_mut_ptr().cast(),
        _ => &raw mut host.report,
    };
    // SAFETY: there is room for a report.
    unsafe {
        c::qsm_report_init(place);
        if bytes.below(8) == 0 {
            place.cast::<usize>().write(bytes.choice(&[0, 1, 9, 2047, usize::MAX]));
        }
    }
    place
}

fn smooth<T>(precision: &Precision<T>, host: &mut Host, options: &c::Options, bytes: &mut Bytes<'_>) -> i32 {
    let (vertices, corners) = (unlikely(bytes, host.vertices), unlikely(bytes, host.indices.len()));
    let given = if bytes.below(8) == 0 { null() } else { &raw const *options };
    let report = report(host, bytes);
    let start = if bytes.below(16) == 0 { null_mut() } else { host.start() };
    let indices = if bytes.below(16) == 0 { null() } else { host.indices.as_ptr() };
    // SAFETY: the buffers are as long as is said, or the counts more than can be addressed.
    unsafe { (precision.smooth)(start, vertices, host.stride, indices, corners, given, report) }
}

fn shrink<T>(function: c::Shrink<T>, host: &mut Host, options: &c::Options, bytes: &mut Bytes<'_>) -> i32 {
    let (mut vertices, mut corners) = (unlikely(bytes, host.vertices), unlikely(bytes, host.indices.len()));
    let given = if bytes.below(8) == 0 { null() } else { &raw const *options };
    let mut maps = maps(host, bytes);
    let report = report(host, bytes);
    let maps = if bytes.flag() { &raw mut maps } else { null_mut() };
    let count = if bytes.below(16) == 0 { null_mut() } else { &raw mut vertices };
    let (start, stride) = (host.start(), host.stride);
    let indices = if bytes.below(16) == 0 { null_mut() } else { host.indices.as_mut_ptr() };
    let before = corners;
    // SAFETY: as in `smooth`.
    let status = unsafe { function(start, count, stride, indices, &raw mut corners, given, maps, report) };
    if status == c::OK {
        assert!(vertices <= host.vertices && corners <= host.indices.len(), "more came out than went in");
        assert!(host.indices[..corners].iter().all(|&v| (v as usize) < vertices), "an index is out of range");
    } else {
        assert_eq!(corners, before, "a count has changed on an error");
        assert!(host.sources.iter().flatten().all(|&x| x == 7), "a map has changed on an error");
    }
    status
}

fn maps(host: &mut Host, bytes: &mut Bytes<'_>) -> c::Maps {
    let mut maps = c::Maps {
        struct_size: size_of::<c::Maps>(),
        vertex_source: null_mut(),
        triangle_source: null_mut(),
        corner_source: null_mut(),
        leftovers: null_mut(),
        leftover_capacity: 0,
        leftover_count: 0,
    };
    // SAFETY: there is room for the struct.
    unsafe { c::qsm_maps_init(&raw mut maps) };
    assert_eq!(maps.struct_size, size_of::<c::Maps>(), "this mirror of the header is out of date");
    let mut array = |k: usize| if bytes.flag() { host.sources[k].as_mut_ptr() } else { null_mut() };
    (maps.vertex_source, maps.triangle_source, maps.corner_source) = (array(0), array(1), array(2));
    if bytes.flag() {
        (maps.leftovers, maps.leftover_capacity) = (host.leftovers.as_mut_ptr(), host.leftovers.len());
    }
    if bytes.below(8) == 0 && !host.indices.is_empty() {
        // Overlaps memory that is written.
        maps.vertex_source = host.indices.as_mut_ptr();
    }
    if bytes.below(16) == 0 {
        maps.struct_size = bytes.choice(&[0, 1, 55, 57, usize::MAX]);
    }
    maps
}

fn measure<T>(precision: &Precision<T>, host: &mut Host, bytes: &mut Bytes<'_>) -> i32 {
    let (vertices, corners) = (unlikely(bytes, host.vertices), unlikely(bytes, host.indices.len()));
    let mut out = c::Opaque([0; 2048]);
    // SAFETY: there is room for a measurement; the rest as in `smooth`.
    unsafe {
        c::qsm_measurement_init(&raw mut out);
        let out = if bytes.below(16) == 0 { null_mut() } else { &raw mut out };
        (precision.measure)(host.start(), vertices, host.stride, host.indices.as_ptr(), corners, out)
    }
}

fn histogram<T>(precision: &Precision<T>, host: &mut Host, bytes: &mut Bytes<'_>) -> i32 {
    let (parameter, bins) = (bytes.choice(&[0, 1, 2, 3, 4, 5, -1]), bytes.below(20));
    let (lower, interval) = (bytes.number(&[0.0, 1.0, -1e300]), bytes.number(&[1.0, 0.1, 5e-324, 1e300]));
    let mut counts = vec![0_usize; bins];
    let (start, stride) = (host.start(), host.stride);
    let (indices, corners) = (host.indices.as_ptr(), host.indices.len());
    let counts_start = counts.as_mut_ptr();
    // SAFETY: as in `smooth`.
    let status = unsafe {
        let vertices = host.vertices;
        (precision.histogram)(start, vertices, stride, indices, corners, parameter, lower, interval, counts_start, bins)
    };
    let expected = if status == c::OK { corners / 3 } else { 0 };
    assert_eq!(counts.iter().sum::<usize>(), expected, "each triangle is counted once");
    status
}
