//! The C interface. This file is the only one of the library with unsafe code; the header is generated from this
//! folder.
//!
//! Every call takes the same way: addresses and counts are checked, then the caller's memory is read into private
//! copies, then the safe library works on these, and only after it succeeded anything is written.

mod block;
mod boundary;
mod options;
mod report;
mod status;
mod struct_size;

use std::ffi::CStr;
use std::slice;

use libc::{c_char, size_t};

use crate::error::Error;
use crate::memory;
use crate::mesh::Coordinate;
use crate::options::Constraints;
use crate::progress::Flow;
use block::{Blame, Block};
use boundary::contained;
use options::{QSM_CONTINUE, qsm_options, qsm_parameter};
use report::{qsm_measurement, qsm_report};
use status::{Failure, QSM_NULL_POINTER, QSM_OK, qsm_status};
use struct_size::Versioned;

/// The version as a C string.
const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
    Ok(version) => version,
    Err(_) => panic!("a version holds no zero byte"),
};

/// Sets struct_size and every default. Does nothing with NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_options_init(options: *mut qsm_options) {
    // SAFETY: the caller passes NULL or room for a struct of the first version, which is all that is written.
    unsafe { initialise(options) }
}

/// Sets struct_size and everything else to 0. Does nothing with NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_report_init(report: *mut qsm_report) {
    // SAFETY: as in qsm_options_init.
    unsafe { initialise(report) }
}

/// Sets struct_size and everything else to 0. Does nothing with NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qsm_measurement_init(out: *mut qsm_measurement) {
    // SAFETY: as in qsm_options_init.
    unsafe { initialise(out) }
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

/// Where a histogram starts, and where it goes.
struct Bins {
    parameter: qsm_parameter,
    lower: f64,
    interval: f64,
    counts: *mut size_t,
    bin_count: size_t,
}

/// Body of `qsm_smooth_*`; always fills the report unless that is itself at fault.
///
/// # Safety
/// Pointers that pass the checks point to as much memory as their counts and sizes say, and nobody changes it
/// meanwhile.
unsafe fn smooth<T: Coordinate>(
    positions: *mut T,
    vertex_count: usize,
    stride: usize,
    indices: *const u32,
    index_count: usize,
    options: *const qsm_options,
    report: *mut qsm_report,
) -> qsm_status {
    let outcome = contained(|| {
        // SAFETY: the caller's promise, handed on.
        let report_block = unsafe { block_of(report) }?;
        let mesh = MeshMemory::check(positions, vertex_count, stride, indices, index_count)?;
        // SAFETY: the caller's promise, handed on.
        unsafe { smooth_checked(positions, &mesh, options, report_block) }
    });
    let (report_value, at_fault) = match &outcome {
        Ok(filled) => (qsm_report::from(filled), false),
        Err(failure) => (qsm_report::from(failure), failure.name == Some(qsm_report::NAME)),
    };
    if !at_fault {
        // SAFETY: a report that is at fault in its size or place is named in the failure and does not come here.
        unsafe { write_struct(report, report_value) };
    }
    outcome.map_or_else(|failure| failure.status, |_| QSM_OK)
}

/// # Safety
/// As for [`smooth`]; `mesh` has checked `positions`.
unsafe fn smooth_checked<T: Coordinate>(
    positions: *mut T,
    mesh: &MeshMemory<T>,
    options: *const qsm_options,
    report: Block,
) -> Result<crate::report::Report, Failure> {
    // SAFETY: the caller's promise, handed on.
    let (options_block, given) = unsafe { (block_of(options)?, read_struct(options)?) };
    let [locks, edges] = given.blocks(mesh.vertex_count)?;
    report.apart_from(&[mesh.positions, mesh.indices, options_block, locks, edges], Blame::This)?;
    mesh.positions.apart_from(&[mesh.indices, options_block, locks, edges], Blame::Other)?;
    let settings = given.settings(!report.is_empty())?;
    // SAFETY: `blocks` and `check` have found both arrays to be addressable and aligned; the caller vouches for what
    // is there.
    let (locked, feature_edges, triangles) = unsafe {
        let locks = array(given.vertex_lock, locks.elements::<u8>());
        let edges = array(given.feature_edges.cast(), edges.elements::<[u32; 2]>());
        (locks, edges, mesh.triangles())
    };
    let mut flags = memory::reserved(locked.len())?;
    flags.extend(locked.iter().map(|&byte| byte != 0));
    // SAFETY: `check` has found the positions to be addressable and aligned.
    let mut smoothed = unsafe { mesh.read_positions() }?;
    let constraints = Constraints { locked: &flags, feature_edges };
    // SAFETY: the caller vouches for the callback.
    let mut progress = |done| unsafe { ask(&given, done) };
    let done = crate::smooth(&mut smoothed, triangles, &settings, &constraints, &mut progress)?;
    // SAFETY: as for reading; no reference into the caller's positions exists, and nothing else overlaps them.
    unsafe { write_positions(positions, mesh.stride, &smoothed) };
    Ok(done)
}

/// Body of `qsm_measure_*`.
///
/// # Safety
/// As for [`smooth`].
unsafe fn measure<T: Coordinate>(
    positions: *const T,
    vertex_count: usize,
    stride: usize,
    indices: *const u32,
    index_count: usize,
    out: *mut qsm_measurement,
) -> qsm_status {
    let outcome = contained(|| {
        if out.is_null() {
            return Err(Failure::of(QSM_NULL_POINTER, qsm_measurement::NAME, "is NULL"));
        }
        // SAFETY: the caller's promise, handed on.
        let out_block = unsafe { block_of(out) }?;
        let mesh = MeshMemory::check(positions, vertex_count, stride, indices, index_count)?;
        out_block.apart_from(&[mesh.positions, mesh.indices], Blame::This)?;
        // SAFETY: `check` has found both buffers to be addressable and aligned.
        let (copy, triangles) = unsafe { (mesh.read_positions()?, mesh.triangles()) };
        Ok(crate::measure(&copy, triangles)?)
    });
    match outcome {
        Ok(measured) => {
            // SAFETY: its size has been checked, and it overlaps nothing.
            unsafe { write_struct(out, qsm_measurement::from(&measured)) };
            QSM_OK
        }
        Err(failure) => failure.status,
    }
}

/// Body of `qsm_histogram_*`.
///
/// # Safety
/// As for [`smooth`].
unsafe fn histogram<T: Coordinate>(
    positions: *const T,
    vertex_count: usize,
    stride: usize,
    indices: *const u32,
    index_count: usize,
    bins: &Bins,
) -> qsm_status {
    let outcome = contained(|| {
        let parameter = options::parameter(bins.parameter)?;
        let counts = Block::array(c"counts", bins.counts, c"bin_count", bins.bin_count)?;
        let mesh = MeshMemory::check(positions, vertex_count, stride, indices, index_count)?;
        counts.apart_from(&[mesh.positions, mesh.indices], Blame::This)?;
        // SAFETY: `check` has found both buffers to be addressable and aligned.
        let (copy, triangles) = unsafe { (mesh.read_positions()?, mesh.triangles()) };
        Ok(crate::histogram(&copy, triangles, parameter, bins.lower, bins.interval, bins.bin_count)?)
    });
    match outcome {
        Ok(counted) => {
            // SAFETY: the caller's room for `bin_count` numbers is addressable, aligned and apart from our own vector.
            unsafe { bins.counts.copy_from_nonoverlapping(counted.as_ptr(), counted.len()) };
            QSM_OK
        }
        Err(failure) => failure.status,
    }
}

/// The caller's mesh, checked by address but not yet read.
struct MeshMemory<T> {
    start: *const T,
    first_index: *const u32,
    vertex_count: usize,
    stride: usize,
    positions: Block,
    indices: Block,
}

impl<T: Coordinate> MeshMemory<T> {
    fn check(
        start: *const T,
        vertex_count: usize,
        stride: usize,
        first_index: *const u32,
        index_count: usize,
    ) -> Result<Self, Failure> {
        let positions = Block::vertices(start, vertex_count, stride)?;
        let indices = Block::indices(first_index, index_count)?;
        Ok(Self { start, first_index, vertex_count, stride, positions, indices })
    }

    /// # Safety
    /// The caller's indices are there and do not change as long as the slice is used.
    unsafe fn triangles(&self) -> &[[u32; 3]] {
        // SAFETY: the indices are addressable and aligned, which `check` has found, and the rest is the promise above.
        unsafe { array(self.first_index.cast(), self.indices.elements::<[u32; 3]>()) }
    }

    /// A copy without gaps. Each vertex is read by itself: a slice over the caller's buffer would claim the bytes
    /// between the vertices, which may belong to another thread.
    ///
    /// # Safety
    /// The caller's positions are there and do not change meanwhile.
    unsafe fn read_positions(&self) -> Result<Vec<[T; 3]>, Error> {
        let mut copy = memory::reserved(self.vertex_count)?;
        // SAFETY: `check` has found that every vertex is within the address space and aligned, as the first one is and
        // the stride is a multiple of the alignment.
        let vertex = |v| unsafe { self.start.byte_add(v * self.stride).cast::<[T; 3]>().read() };
        copy.extend((0..self.vertex_count).map(vertex));
        Ok(copy)
    }
}

/// Writes the vertices of which a bit has changed, and no byte of any other.
///
/// # Safety
/// `start` points to as many vertices as there are, `stride` bytes apart, aligned, that may be written.
unsafe fn write_positions<T: Coordinate>(start: *mut T, stride: usize, smoothed: &[[T; 3]]) {
    let bits = |p: [T; 3]| p.map(|x| x.to_f64().to_bits());
    for (v, &new) in smoothed.iter().enumerate() {
        // SAFETY: the promise above.
        unsafe {
            let place = start.byte_add(v * stride).cast::<[T; 3]>();
            if bits(place.read()) != bits(new) {
                place.write(new);
            }
        }
    }
}

/// Asks the host whether to go on.
///
/// # Safety
/// `progress` is NULL or a function that can be called with `user`.
unsafe fn ask(options: &qsm_options, done: f64) -> Flow {
    let Some(progress) = options.progress else {
        return Flow::Continue;
    };
    // SAFETY: the promise above.
    match unsafe { progress(done, options.user) } {
        QSM_CONTINUE => Flow::Continue,
        _ => Flow::Cancel,
    }
}

/// A caller's array without gaps.
///
/// # Safety
/// Unless `count` is 0, the array is there, aligned, no larger than `isize::MAX` bytes, and does not change as long as
/// the slice is used.
unsafe fn array<'a, T>(pointer: *const T, count: usize) -> &'a [T] {
    // SAFETY: the promise above; for a count of 0 the pointer, which may be NULL then, is not used.
    if count == 0 { &[] } else { unsafe { slice::from_raw_parts(pointer, count) } }
}

/// # Safety
/// `pointer` is NULL or points to a `size_t struct_size`.
unsafe fn block_of<T: Versioned>(pointer: *const T) -> Result<Block, Failure> {
    if pointer.is_null() {
        return Ok(Block::object(T::NAME, pointer, 0));
    }
    // SAFETY: the promise above; the struct may be unaligned.
    let size = T::check_size(unsafe { pointer.cast::<usize>().read_unaligned() })?;
    Ok(Block::object(T::NAME, pointer, size))
}

/// The caller's struct with defaults for what its version lacks; all defaults for NULL.
///
/// # Safety
/// `pointer` is NULL or points to as many bytes as its `struct_size` says.
unsafe fn read_struct<T: Versioned + Default>(pointer: *const T) -> Result<T, Failure> {
    let mut value = T::default();
    // SAFETY: `elements` is at most the size of our own struct and at most what the caller has. Structs of the
    // interface consist of numbers and pointers that may be NULL, for which all bytes are valid.
    unsafe {
        let size = block_of(pointer)?.elements::<u8>();
        (&raw mut value).cast::<u8>().copy_from_nonoverlapping(pointer.cast(), size);
    }
    Ok(value)
}

/// Writes as much of `value` as the caller's struct has room for; nothing for NULL or for an unusable size. The
/// caller's `struct_size` stays.
///
/// # Safety
/// `pointer` is NULL or points to as many writable bytes as its `struct_size` says.
unsafe fn write_struct<T: Versioned>(pointer: *mut T, value: T) {
    const HEAD: usize = size_of::<size_t>();
    // SAFETY: `elements` is at most the size of our own struct and at most what the caller has room for.
    unsafe {
        let size = block_of(pointer).map_or(0, |block| block.elements::<u8>());
        if size > HEAD {
            let body = (&raw const value).cast::<u8>().add(HEAD);
            pointer.cast::<u8>().add(HEAD).copy_from_nonoverlapping(body, size - HEAD);
        }
    }
}

/// # Safety
/// `pointer` is NULL or points to room for the first version of the struct.
unsafe fn initialise<T: Versioned + Default>(pointer: *mut T) {
    if pointer.is_null() {
        return;
    }
    let value = T::default();
    // SAFETY: the first version is no longer than our own struct, and the caller has room for it.
    unsafe {
        pointer.cast::<u8>().copy_from_nonoverlapping((&raw const value).cast(), T::FIRST_SIZE);
        pointer.cast::<usize>().write_unaligned(T::FIRST_SIZE);
    }
}

#[cfg(test)]
mod tests {
    use std::mem::offset_of;
    use std::ptr::{null, null_mut};

    use super::status::QSM_BAD_STRUCT_SIZE;
    use super::*;

    /// A struct as it looks after it has grown: the first version ended with `first`.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Grown {
        struct_size: size_t,
        first: u64,
        added: u64,
    }

    impl Default for Grown {
        fn default() -> Self {
            Self { struct_size: size_of::<Self>(), first: 1, added: 2 }
        }
    }

    impl Versioned for Grown {
        const NAME: &'static CStr = c"grown";
        const FIRST_SIZE: usize = offset_of!(Self, first) + size_of::<u64>();
    }

    fn given(struct_size: usize) -> Grown {
        Grown { struct_size, first: 70, added: 80 }
    }

    #[test]
    fn old_struct_is_read_with_defaults_for_new_fields() {
        // SAFETY: each struct is longer than its size says, or is not there.
        let read = |g: *const Grown| unsafe { read_struct(g) }.map(|g| (g.first, g.added));
        assert_eq!(read(&given(Grown::FIRST_SIZE)).unwrap(), (70, 2));
        assert_eq!(read(&given(size_of::<Grown>())).unwrap(), (70, 80));
        assert_eq!(read(null()).unwrap(), (1, 2));
        for size in [0, Grown::FIRST_SIZE - 1, size_of::<Grown>() + 1] {
            assert_eq!(read(&given(size)).unwrap_err().status, QSM_BAD_STRUCT_SIZE);
        }
    }

    #[test]
    fn old_struct_is_written_no_further_than_it_reaches() {
        let written = |size| {
            let mut target = given(size);
            // SAFETY: the struct is longer than its size says, or nothing is written.
            unsafe { write_struct(&mut target, Grown::default()) };
            assert_eq!(target.struct_size, size);
            (target.first, target.added)
        };
        assert_eq!(written(Grown::FIRST_SIZE), (1, 80));
        assert_eq!(written(size_of::<Grown>()), (1, 2));
        assert_eq!(written(0), (70, 80));
        // SAFETY: nothing is written through NULL.
        unsafe { write_struct(null_mut(), Grown::default()) };
    }

    #[test]
    fn initialising_writes_the_first_version_for_ever() {
        let mut target = given(usize::MAX);
        // SAFETY: there is room for more than the first version.
        unsafe { initialise(&mut target) };
        assert_eq!(target, Grown { struct_size: Grown::FIRST_SIZE, first: 1, added: 80 });
    }
}
