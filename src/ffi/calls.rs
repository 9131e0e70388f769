//! The course of each call.
//!
//! All take the same way: addresses and counts are checked, then the caller's memory is read into private copies, then
//! the safe library works on these, and only after it succeeded anything is written.

use std::mem::offset_of;

use libc::size_t;

use super::access::{MeshMemory, array, block_of, read_count, read_struct, write_array, write_positions, write_struct};
use super::block::{Blame, Block};
use super::boundary::contained;
use super::maps::{qsm_leftover, qsm_maps};
use super::options::{self, QSM_CONTINUE, qsm_options, qsm_parameter};
use super::report::{qsm_measurement, qsm_report};
use super::stage::{Stage, Work};
use super::status::{Failure, QSM_NULL_POINTER, QSM_OK, qsm_status};
use super::struct_size::Versioned;
use crate::error::Error;
use crate::memory;
use crate::mesh::Coordinate;
use crate::options::Constraints;
use crate::progress::Flow;
use crate::smooth::smooth_vertices;
use crate::tail::Sources;

/// Where a histogram starts, and where it goes.
pub(super) struct Bins {
    pub parameter: qsm_parameter,
    pub lower: f64,
    pub interval: f64,
    pub counts: *mut size_t,
    pub bin_count: size_t,
}

/// A mesh that may shrink, and where to say what became of it.
pub(super) struct Shrinking<T> {
    pub positions: *mut T,
    pub vertex_count: *mut size_t,
    pub stride_bytes: size_t,
    pub indices: *mut u32,
    pub index_count: *mut size_t,
    pub options: *const qsm_options,
    pub maps: *mut qsm_maps,
}

/// All memory of a call on a mesh that may shrink, checked, and its structs read.
struct Checked<T> {
    mesh: MeshMemory<T>,
    options: qsm_options,
    wishes: [Block; 4],
    mask: Block,
    maps: qsm_maps,
}

impl<T: Coordinate> Checked<T> {
    /// # Safety
    /// As for [`smooth`].
    unsafe fn new(call: &Shrinking<T>, report: Block) -> Result<Self, Failure> {
        // SAFETY: the caller's promise, handed on.
        let ((vertices, vertex_count), (corners, index_count)) =
            unsafe { (read_count(c"vertex_count", call.vertex_count)?, read_count(c"index_count", call.index_count)?) };
        let mesh = MeshMemory::check(call.positions, vertex_count, call.stride_bytes, call.indices, index_count)?;
        // SAFETY: the caller's promise, handed on.
        let (options_block, options) = unsafe { (block_of(call.options)?, read_struct(call.options)?) };
        let wishes = options.blocks(vertex_count)?;
        let mask = options.mask_block(index_count / 3)?;
        // SAFETY: the caller's promise, handed on.
        let (maps_block, maps) = unsafe { (block_of(call.maps)?, read_struct(call.maps)?) };
        let [a, b, c, d] = maps.blocks(vertex_count, index_count)?;
        let written = [mesh.positions, mesh.indices, vertices, corners, maps_block, a, b, c, d];
        let [locks, edges, seeds, visits] = wishes;
        let read = [options_block, locks, edges, mask, seeds, visits];
        report.apart_from(&written, Blame::This)?;
        report.apart_from(&read, Blame::This)?;
        Block::all_apart(&written, &read)?;
        Ok(Self { mesh, options, wishes, mask, maps })
    }
}

/// Body of `qsm_smooth_*`; always fills the report unless that is itself at fault.
///
/// # Safety
/// Pointers that pass the checks point to as much memory as their counts and sizes say, and nobody changes it
/// meanwhile.
pub(super) unsafe fn smooth<T: Coordinate>(
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
    // SAFETY: the caller's promise, handed on.
    unsafe { finish(outcome, report) }
}

/// # Safety
/// As for [`smooth`]; `mesh` has checked `positions`.
unsafe fn smooth_checked<T: Coordinate>(
    positions: *mut T,
    mesh: &MeshMemory<T>,
    options: *const qsm_options,
    report: Block,
) -> Result<qsm_report, Failure> {
    // SAFETY: the caller's promise, handed on.
    let (options_block, given) = unsafe { (block_of(options)?, read_struct(options)?) };
    let blocks = given.blocks(mesh.vertex_count)?;
    let [locks, edges, seeds, visits] = blocks;
    let read = [mesh.indices, options_block, locks, edges, seeds, visits];
    report.apart_from(&[mesh.positions], Blame::This)?;
    report.apart_from(&read, Blame::This)?;
    Block::all_apart(&[mesh.positions], &read)?;
    let settings = given.settings(!report.is_empty())?;
    // SAFETY: `blocks` and `check` have found all arrays to be addressable and aligned; the caller vouches for what is
    // there.
    let (wishes, triangles, mut vertices) =
        unsafe { (Wishes::read(&given, blocks)?, mesh.triangles(), mesh.vertices(positions)) };
    // SAFETY: the caller vouches for the callback.
    let mut progress = |done| unsafe { ask(&given, done) };
    let done = smooth_vertices(&mut vertices, triangles, &settings, &wishes.constraints(), &mut progress)?;
    Ok(qsm_report::from(&done))
}

/// Body of `qsm_collapse_tails_*` and `qsm_improve_*`; always fills the report unless that is itself at fault.
///
/// # Safety
/// As for [`smooth`].
pub(super) unsafe fn shrink<T: Coordinate>(stage: Stage, call: &Shrinking<T>, report: *mut qsm_report) -> qsm_status {
    let outcome = contained(|| {
        // SAFETY: the caller's promise, handed on.
        let (checked, report_block) = unsafe {
            let report_block = block_of(report)?;
            (Checked::new(call, report_block)?, report_block)
        };
        // SAFETY: the caller's promise, handed on.
        unsafe { shrink_checked(stage, call, &checked, !report_block.is_empty()) }
    });
    // SAFETY: the caller's promise, handed on.
    unsafe { finish(outcome, report) }
}

/// # Safety
/// As for [`smooth`]; `checked` has checked `call`.
unsafe fn shrink_checked<T: Coordinate>(
    stage: Stage,
    call: &Shrinking<T>,
    checked: &Checked<T>,
    measure: bool,
) -> Result<qsm_report, Failure> {
    let Checked { mesh, options, wishes, mask, .. } = checked;
    let settings = options.settings(measure)?;
    // SAFETY: all arrays have been found to be addressable and aligned; the caller vouches for what is there.
    let (wishes, mask, mut work) = unsafe {
        let wishes = Wishes::read(options, *wishes)?;
        let mask = truths(array(options.triangle_mask, mask.elements::<u8>()))?;
        let (positions, triangles) = (mesh.read_positions()?, memory::copied(mesh.triangles())?);
        (wishes, mask, Work::new(positions, triangles))
    };
    // SAFETY: the caller vouches for the callback.
    let mut progress = |done| unsafe { ask(options, done) };
    let report = stage.run(&mut work, &settings, &options.tail(&mask)?, &wishes.constraints(), &mut progress)?;
    let mut leftovers = memory::reserved(work.leftovers.len())?;
    leftovers.extend(work.leftovers.iter().map(qsm_leftover::from));
    assert!(work.fits(mesh.vertex_count, mesh.indices.elements::<[u32; 3]>()), "more came out than went in");
    // SAFETY: as for reading; no reference to memory that is written exists, it overlaps nothing, and what came out has
    // room where the input was.
    unsafe {
        write_positions(call.positions, mesh.stride, &work.positions);
        write_array(call.indices, work.triangles.as_flattened());
        call.vertex_count.write(work.positions.len());
        call.index_count.write(3 * work.triangles.len());
        write_maps(call.maps, &checked.maps, &work.sources, &leftovers);
    }
    Ok(report)
}

/// # Safety
/// The arrays of `maps` are NULL or have the room that the header asks for, and `place`, of which `maps` is a copy, is
/// NULL or writable.
unsafe fn write_maps(place: *mut qsm_maps, maps: &qsm_maps, sources: &Sources, leftovers: &[qsm_leftover]) {
    let listed = &leftovers[..leftovers.len().min(maps.leftover_capacity)];
    // SAFETY: the promise above; the struct may be unaligned.
    unsafe {
        write_array(maps.vertex_source, &sources.vertex);
        write_array(maps.triangle_source, &sources.triangle);
        write_array(maps.corner_source, &sources.corner);
        write_array(maps.leftovers, listed);
        if !place.is_null() {
            let count = place.byte_add(offset_of!(qsm_maps, leftover_count)).cast::<size_t>();
            count.write_unaligned(leftovers.len());
        }
    }
}

/// Writes the report, unless that is itself at fault, and gives the status.
///
/// # Safety
/// As for [`smooth`].
unsafe fn finish(outcome: Result<qsm_report, Failure>, report: *mut qsm_report) -> qsm_status {
    let (value, at_fault) = match outcome {
        Ok(filled) => (filled, false),
        Err(failure) => (qsm_report::from(&failure), failure.name == Some(qsm_report::NAME)),
    };
    let status = value.status;
    if !at_fault {
        // SAFETY: a report that is at fault in its size or place is named in the failure and does not come here.
        unsafe { write_struct(report, value) };
    }
    status
}

/// Body of `qsm_measure_*`.
///
/// # Safety
/// As for [`smooth`].
pub(super) unsafe fn measure<T: Coordinate>(
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
pub(super) unsafe fn histogram<T: Coordinate>(
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

/// Body of `qsm_triangle_quality_*`.
///
/// # Safety
/// As for [`smooth`].
pub(super) unsafe fn triangle_quality<T: Coordinate>(
    positions: *const T,
    vertex_count: usize,
    stride: usize,
    indices: *const u32,
    index_count: usize,
    parameter: qsm_parameter,
    values: *mut f64,
) -> qsm_status {
    let outcome = contained(|| {
        let parameter = options::parameter(parameter)?;
        let mesh = MeshMemory::check(positions, vertex_count, stride, indices, index_count)?;
        let room = Block::array(c"values", values, c"index_count", index_count / 3)?;
        room.apart_from(&[mesh.positions, mesh.indices], Blame::This)?;
        // SAFETY: `check` has found both buffers to be addressable and aligned.
        let (copy, triangles) = unsafe { (mesh.read_positions()?, mesh.triangles()) };
        Ok(crate::triangle_quality(&copy, triangles, parameter)?)
    });
    match outcome {
        Ok(found) => {
            // SAFETY: the caller's room for a number for each triangle is addressable, aligned and apart from our own
            // vector; without triangles nothing is written.
            unsafe { write_array(values, &found) };
            QSM_OK
        }
        Err(failure) => failure.status,
    }
}

/// What the arrays of the options say: bytes copied, as they become truth values, the rest where it is.
struct Wishes<'a> {
    locked: Vec<bool>,
    feature_edges: &'a [[u32; 2]],
    seeds: Vec<bool>,
    visits: &'a [u32],
}

impl Wishes<'_> {
    /// # Safety
    /// The blocks are those of `options`, and what is there does not change as long as the wishes are used.
    unsafe fn read(options: &qsm_options, [locks, edges, seeds, visits]: [Block; 4]) -> Result<Self, Error> {
        // SAFETY: the blocks have been found to be addressable and aligned, and the rest is the promise above.
        unsafe {
            Ok(Self {
                locked: truths(array(options.vertex_lock, locks.elements::<u8>()))?,
                feature_edges: array(options.feature_edges.cast(), edges.elements::<[u32; 2]>()),
                seeds: truths(array(options.seeds, seeds.elements::<u8>()))?,
                visits: array(options.visits, visits.elements::<u32>()),
            })
        }
    }

    fn constraints(&self) -> Constraints<'_> {
        let Self { locked, feature_edges, seeds, visits } = self;
        Constraints { locked, feature_edges, seeds, visits }
    }
}

/// Bytes as truth values: any but 0 is true.
fn truths(bytes: &[u8]) -> Result<Vec<bool>, Error> {
    let mut truths = memory::reserved(bytes.len())?;
    truths.extend(bytes.iter().map(|&byte| byte != 0));
    Ok(truths)
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
