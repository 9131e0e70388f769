//! The C interface: what a host can call. The header is generated from this folder.
//!
//! Three files have unsafe code, the only ones of the library: this one, where C comes in; `calls`, with the course of
//! each call; and `access`, with the raw reads and writes.

mod access;
mod block;
mod boundary;
mod calls;
mod maps;
mod options;
mod report;
mod stage;
mod status;
mod struct_size;

use std::ffi::CStr;

use libc::{c_char, size_t};

use access::initialise;
use calls::{Bins, Shrinking, histogram, measure, shrink, smooth, triangle_quality};
use maps::qsm_maps;
use options::{qsm_options, qsm_parameter};
use report::{qsm_measurement, qsm_report};
use stage::Stage;
use status::qsm_status;
use struct_size::Versioned;

/// The version as a C string.
const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
    Ok(version) => version,
    Err(_) => panic!("a version holds no zero byte"),
};

/// Sets struct_size to size, and every default as far as size reaches. Does nothing with NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_options_init_sized(options: *mut qsm_options, size: size_t) {
    // SAFETY: the caller passes NULL or room for as much as it says, which is all that is written.
    unsafe { initialise(options, size) }
}

/// The same for the struct as it was in version 0.1, which a newer library does not exceed. C and C++ call
/// qsm_options_init_sized by this name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_options_init(options: *mut qsm_options) {
    // SAFETY: the caller passes NULL or room for a struct of version 0.1, which is all that is written.
    unsafe { initialise(options, qsm_options::INIT_SIZE) }
}

/// Sets struct_size to size, and everything else to 0 as far as size reaches. Does nothing with NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_report_init_sized(report: *mut qsm_report, size: size_t) {
    // SAFETY: as in qsm_options_init_sized.
    unsafe { initialise(report, size) }
}

/// qsm_report_init_sized for the struct as it was in version 0.1; as with qsm_options_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_report_init(report: *mut qsm_report) {
    // SAFETY: as in qsm_options_init.
    unsafe { initialise(report, qsm_report::INIT_SIZE) }
}

/// Sets struct_size to size, and everything else to 0 as far as size reaches. Does nothing with NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_measurement_init_sized(out: *mut qsm_measurement, size: size_t) {
    // SAFETY: as in qsm_options_init_sized.
    unsafe { initialise(out, size) }
}

/// qsm_measurement_init_sized for the struct as it was in version 0.1; as with qsm_options_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_measurement_init(out: *mut qsm_measurement) {
    // SAFETY: as in qsm_options_init.
    unsafe { initialise(out, qsm_measurement::INIT_SIZE) }
}

/// Sets struct_size to size, and everything else to 0 and NULL as far as size reaches. Does nothing with NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_maps_init_sized(maps: *mut qsm_maps, size: size_t) {
    // SAFETY: as in qsm_options_init_sized.
    unsafe { initialise(maps, size) }
}

/// qsm_maps_init_sized for the struct as it was in version 0.1; as with qsm_options_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_maps_init(maps: *mut qsm_maps) {
    // SAFETY: as in qsm_options_init.
    unsafe { initialise(maps, qsm_maps::INIT_SIZE) }
}

/// Improves the triangles of a mesh by moving its vertices.
///
/// positions: three coordinates x, y, z at the start of each vertex, vertices stride_bytes apart (12 for an array of
/// coordinates alone). The coordinates of moved vertices are changed in place, but only after everything has
/// succeeded; bytes between the coordinates of one vertex and the next are neither read nor written. May be NULL if
/// vertex_count is 0.
/// indices: three vertex numbers a triangle, consistently wound; index_count counts the numbers, not the triangles.
/// Never changed. May be NULL if index_count is 0.
/// options: NULL for the defaults. report: NULL if not wanted; measuring is then left out too.
///
/// Returns QSM_OK, or another status; then no position has changed, and the report says what is at fault. Bad elements
/// (triangles without area, non-manifold edges, unused vertices) are no error: they are left alone and counted.
///
/// All arithmetic is in double precision; a result is rounded once to the precision of the buffer. The enclosed volume
/// of a closed mesh stays as it is but for that rounding. The same input gives the same result.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_smooth_f32(
    positions: *mut f32,
    vertex_count: size_t,
    stride_bytes: size_t,
    indices: *const u32,
    index_count: size_t,
    options: *const qsm_options,
    report: *mut qsm_report,
) -> qsm_status {
    // SAFETY: the header asks of the caller what `smooth` asks.
    unsafe { smooth(positions, vertex_count, stride_bytes, indices, index_count, options, report) }
}

/// The same as qsm_smooth_f32 for coordinates in double precision (stride_bytes is 24 for an array of coordinates
/// alone).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_smooth_f64(
    positions: *mut f64,
    vertex_count: size_t,
    stride_bytes: size_t,
    indices: *const u32,
    index_count: size_t,
    options: *const qsm_options,
    report: *mut qsm_report,
) -> qsm_status {
    // SAFETY: the header asks of the caller what `smooth` asks.
    unsafe { smooth(positions, vertex_count, stride_bytes, indices, index_count, options, report) }
}

/// Cures the triangles that no smoothing can help, because the edges between the vertices force their shape: moves
/// vertices, flips edges, collapses them and removes vertices, worst triangle first. The mesh may come out with
/// fewer vertices and triangles than went in.
///
/// positions: as for qsm_smooth_f32. *vertex_count is the number of vertices that go in, and after success the
/// number of those that came out. The coordinates of these are moved up, in their old order, to the first places;
/// the bytes between the coordinates of one vertex and the next are neither read nor written, so other attributes of
/// a vertex stay in their old places until the caller brings them along through vertex_source of maps.
/// indices: as for qsm_smooth_f32, but changed in place. *index_count is the number of indices that go in, and after
/// success of those that came out. Triangles that were not touched keep their vertices, order and winding.
/// In both buffers, what lies behind the new count keeps its bits. Neither count may be NULL.
/// options: NULL for the defaults. maps: NULL if not wanted. report: NULL if not wanted; measuring is then left out
/// too.
///
/// Returns QSM_OK, or another status; then buffers, counts and maps are as they were, and the report says what is at
/// fault. A triangle that could not be cured is no error, but listed in maps with the reason.
///
/// Features and the boundary stay, and locked vertices keep their bits. The enclosed volume of a closed mesh stays as
/// it is but for rounding to the precision of the buffer. The same input gives the same result.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_collapse_tails_f32(
    positions: *mut f32,
    vertex_count: *mut size_t,
    stride_bytes: size_t,
    indices: *mut u32,
    index_count: *mut size_t,
    options: *const qsm_options,
    maps: *mut qsm_maps,
    report: *mut qsm_report,
) -> qsm_status {
    let call = Shrinking { positions, vertex_count, stride_bytes, indices, index_count, options, maps };
    // SAFETY: the header asks of the caller what `shrink` asks.
    unsafe { shrink(Stage::CollapseTails, &call, report) }
}

/// The same as qsm_collapse_tails_f32 for coordinates in double precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_collapse_tails_f64(
    positions: *mut f64,
    vertex_count: *mut size_t,
    stride_bytes: size_t,
    indices: *mut u32,
    index_count: *mut size_t,
    options: *const qsm_options,
    maps: *mut qsm_maps,
    report: *mut qsm_report,
) -> qsm_status {
    let call = Shrinking { positions, vertex_count, stride_bytes, indices, index_count, options, maps };
    // SAFETY: the header asks of the caller what `shrink` asks.
    unsafe { shrink(Stage::CollapseTails, &call, report) }
}

/// qsm_smooth_f32, and then qsm_collapse_tails_f32 for what is left, in one call with the parameters of the latter.
/// Features, deviations and the original surface are those of the mesh that went in; before, after, max_deviation and
/// volume_relative_change in the report are those of the whole call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_improve_f32(
    positions: *mut f32,
    vertex_count: *mut size_t,
    stride_bytes: size_t,
    indices: *mut u32,
    index_count: *mut size_t,
    options: *const qsm_options,
    maps: *mut qsm_maps,
    report: *mut qsm_report,
) -> qsm_status {
    let call = Shrinking { positions, vertex_count, stride_bytes, indices, index_count, options, maps };
    // SAFETY: the header asks of the caller what `shrink` asks.
    unsafe { shrink(Stage::Improve, &call, report) }
}

/// The same as qsm_improve_f32 for coordinates in double precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_improve_f64(
    positions: *mut f64,
    vertex_count: *mut size_t,
    stride_bytes: size_t,
    indices: *mut u32,
    index_count: *mut size_t,
    options: *const qsm_options,
    maps: *mut qsm_maps,
    report: *mut qsm_report,
) -> qsm_status {
    let call = Shrinking { positions, vertex_count, stride_bytes, indices, index_count, options, maps };
    // SAFETY: the header asks of the caller what `shrink` asks.
    unsafe { shrink(Stage::Improve, &call, report) }
}

/// Measures the quality of a mesh. Buffers are as for qsm_smooth_f32 and are not changed; out must have been set up
/// with qsm_measurement_init and is written only if the call returns QSM_OK.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_measure_f32(
    positions: *const f32,
    vertex_count: size_t,
    stride_bytes: size_t,
    indices: *const u32,
    index_count: size_t,
    out: *mut qsm_measurement,
) -> qsm_status {
    // SAFETY: the header asks of the caller what `measure` asks.
    unsafe { measure(positions, vertex_count, stride_bytes, indices, index_count, out) }
}

/// The same as qsm_measure_f32 for coordinates in double precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_measure_f64(
    positions: *const f64,
    vertex_count: size_t,
    stride_bytes: size_t,
    indices: *const u32,
    index_count: size_t,
    out: *mut qsm_measurement,
) -> qsm_status {
    // SAFETY: the header asks of the caller what `measure` asks.
    unsafe { measure(positions, vertex_count, stride_bytes, indices, index_count, out) }
}

/// Counts how many triangles have a value of parameter in each interval of width interval from lower on. Values below
/// lower go into the first bin; values past the last bin, infinite ones too, into the last. Buffers are as for
/// qsm_smooth_f32 and are not changed.
///
/// interval must be above 0, lower finite and bin_count at least 1, else the status is QSM_BAD_OPTION. counts has room
/// for bin_count numbers, which are overwritten, and only if the call returns QSM_OK.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_histogram_f32(
    positions: *const f32,
    vertex_count: size_t,
    stride_bytes: size_t,
    indices: *const u32,
    index_count: size_t,
    parameter: qsm_parameter,
    lower: f64,
    interval: f64,
    counts: *mut size_t,
    bin_count: size_t,
) -> qsm_status {
    let bins = Bins { parameter, lower, interval, counts, bin_count };
    // SAFETY: the header asks of the caller what `histogram` asks.
    unsafe { histogram(positions, vertex_count, stride_bytes, indices, index_count, &bins) }
}

/// The same as qsm_histogram_f32 for coordinates in double precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_histogram_f64(
    positions: *const f64,
    vertex_count: size_t,
    stride_bytes: size_t,
    indices: *const u32,
    index_count: size_t,
    parameter: qsm_parameter,
    lower: f64,
    interval: f64,
    counts: *mut size_t,
    bin_count: size_t,
) -> qsm_status {
    let bins = Bins { parameter, lower, interval, counts, bin_count };
    // SAFETY: the header asks of the caller what `histogram` asks.
    unsafe { histogram(positions, vertex_count, stride_bytes, indices, index_count, &bins) }
}

/// Writes the value of parameter for each triangle to values, which has room for index_count / 3 numbers: infinite where
/// a triangle without area has none that is finite. Buffers are as for qsm_smooth_f32 and are not changed; values is
/// overwritten only if the call returns QSM_OK.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_triangle_quality_f32(
    positions: *const f32,
    vertex_count: size_t,
    stride_bytes: size_t,
    indices: *const u32,
    index_count: size_t,
    parameter: qsm_parameter,
    values: *mut f64,
) -> qsm_status {
    // SAFETY: the header asks of the caller what `triangle_quality` asks.
    unsafe { triangle_quality(positions, vertex_count, stride_bytes, indices, index_count, parameter, values) }
}

/// The same as qsm_triangle_quality_f32 for coordinates in double precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_triangle_quality_f64(
    positions: *const f64,
    vertex_count: size_t,
    stride_bytes: size_t,
    indices: *const u32,
    index_count: size_t,
    parameter: qsm_parameter,
    values: *mut f64,
) -> qsm_status {
    // SAFETY: the header asks of the caller what `triangle_quality` asks.
    unsafe { triangle_quality(positions, vertex_count, stride_bytes, indices, index_count, parameter, values) }
}

/// English text for a status; "unknown status" for any other number. Never NULL, lives for ever, not to be freed.
#[unsafe(no_mangle)]
pub extern "C" fn qsm_status_string(status: qsm_status) -> *const c_char {
    status::text(status).as_ptr()
}

/// Version of the library at run time, such as "1.2.3". Never NULL, lives for ever, not to be freed.
#[unsafe(no_mangle)]
pub extern "C" fn qsm_version() -> *const c_char {
    VERSION.as_ptr()
}
