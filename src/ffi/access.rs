//! Raw reads and writes of the caller's memory, and nothing else. No reference to memory that is also written outlives the time in
//! which nobody writes it.

use std::ffi::CStr;
use std::slice;

use libc::size_t;

use super::block::Block;
use super::status::Failure;
use super::struct_size::Versioned;
use crate::error::Error;
use crate::memory;
use crate::mesh::{Coordinate, Vertices};
use crate::threads::Threads;

/// The caller's mesh, checked by address but not yet read.
pub(super) struct MeshMemory<T> {
    start: *const T,
    first_index: *const u32,
    pub vertex_count: usize,
    pub stride: usize,
    pub positions: Block,
    pub indices: Block,
}

impl<T: Coordinate> MeshMemory<T> {
    pub fn check(
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
    pub unsafe fn triangles(&self) -> &[[u32; 3]] {
        // SAFETY: the indices are addressable and aligned, which `check` has found, and the rest is the promise above.
        unsafe { array(self.first_index.cast(), self.indices.elements::<[u32; 3]>()) }
    }

    /// The vertices, to be read and written through `start`, which `check` has looked at.
    ///
    /// # Safety
    /// The caller's positions are there, may be written, and nobody else writes them as long as the result is used.
    pub unsafe fn vertices(&self, start: *mut T) -> CallersVertices<T> {
        CallersVertices { start, stride: self.stride, count: self.vertex_count }
    }

    /// A copy without gaps. Each vertex is read by itself: a slice over the caller's buffer would claim the bytes
    /// between the vertices, which may belong to another thread.
    ///
    /// # Safety
    /// The caller's positions are there and do not change meanwhile.
    pub unsafe fn read_positions(&self) -> Result<Vec<[T; 3]>, Error> {
        let mut copy = memory::reserved(self.vertex_count)?;
        // SAFETY: `check` has found that every vertex is within the address space and aligned, as the first one is and
        // the stride is a multiple of the alignment.
        let vertex = |v| unsafe { self.start.byte_add(v * self.stride).cast::<[T; 3]>().read() };
        copy.extend((0..self.vertex_count).map(vertex));
        Ok(copy)
    }
}

/// The caller's positions. Each vertex is read and written by itself where there are bytes between the vertices: a slice over the
/// buffer would claim those too, which may belong to another thread.
pub(super) struct CallersVertices<T> {
    start: *mut T,
    stride: usize,
    count: usize,
}

// SAFETY: who makes one promises that nobody else writes, and of the threads that share it each writes vertices of its own.
unsafe impl<T: Send + Sync> Sync for CallersVertices<T> {}

impl<T: Coordinate> CallersVertices<T> {
    /// Where vertex `v` is.
    fn place(&self, v: usize) -> *mut [T; 3] {
        assert!(v < self.count, "vertex {v} of {}", self.count);
        // SAFETY: the vertex is within the caller's buffer, by the promise of who made this.
        unsafe { self.start.byte_add(v * self.stride).cast() }
    }
}

impl<T: Coordinate> Vertices<T> for CallersVertices<T> {
    fn count(&self) -> usize {
        self.count
    }

    fn get(&self, v: usize) -> [T; 3] {
        // SAFETY: the place is readable and aligned, by the promise of who made this.
        unsafe { self.place(v).read() }
    }

    fn as_slice(&self) -> Option<&[[T; 3]]> {
        // SAFETY: without bytes between the vertices, which might be another's, they are an array of the caller's, who does not
        // write it, by the promise of who made this; and we do in `set` alone, which no borrow of this outlives.
        (self.stride == size_of::<[T; 3]>()).then(|| unsafe { array(self.start.cast(), self.count) })
    }

    /// Writes where a bit has changed, and no byte of any other vertex.
    fn set(&mut self, changed: impl Fn(usize, [T; 3]) -> Option<[T; 3]> + Sync, threads: &Threads<'_>) {
        let bits = |p: [T; 3]| p.map(|x| x.to_f64().to_bits());
        let vertices = &*self;
        threads.parts(vertices.count, |part| {
            for v in part {
                let before = vertices.get(v);
                if let Some(new) = changed(v, before).filter(|&new| bits(new) != bits(before)) {
                    // SAFETY: the place is writable and aligned, by the promise of who made this, and nobody else reads or writes
                    // it: the parts have no vertex in common, and this is borrowed mutably.
                    unsafe { vertices.place(v).write(new) };
                }
            }
        });
    }
}

/// Writes the vertices of which a bit has changed, and no byte of any other.
///
/// # Safety
/// `start` points to at least as many vertices, `stride` bytes apart, aligned, that may be written.
pub(super) unsafe fn write_positions<T: Coordinate>(start: *mut T, stride: usize, new: &[[T; 3]]) {
    CallersVertices { start, stride, count: new.len() }.set(|v, _| Some(new[v]), &Threads::ONE);
}

/// A caller's array without gaps.
///
/// # Safety
/// Unless `count` is 0, the array is there, aligned, no larger than `isize::MAX` bytes, and does not change as long as
/// the slice is used.
pub(super) unsafe fn array<'a, T>(pointer: *const T, count: usize) -> &'a [T] {
    // SAFETY: the promise above; for a count of 0 the pointer, which may be NULL then, is not used.
    if count == 0 { &[] } else { unsafe { slice::from_raw_parts(pointer, count) } }
}

/// Writes the values from the start of a caller's array without gaps on; nothing if that is NULL.
///
/// # Safety
/// Unless `start` is NULL, the array is there, aligned, apart from `values`, and has room for them.
pub(super) unsafe fn write_array<T: Copy>(start: *mut T, values: &[T]) {
    if !start.is_null() {
        // SAFETY: the promise above.
        unsafe { start.copy_from_nonoverlapping(values.as_ptr(), values.len()) };
    }
}

/// Where a count is that the call reads and writes, and what it is.
///
/// # Safety
/// `pointer` is NULL or, if it is aligned, points to a `size_t`.
pub(super) unsafe fn read_count(name: &'static CStr, pointer: *const size_t) -> Result<(Block, usize), Failure> {
    let block = Block::array(name, pointer, name, 1)?;
    // SAFETY: `array` has found it to be aligned and not NULL; the rest is the promise above.
    Ok((block, unsafe { pointer.read() }))
}

/// # Safety
/// `pointer` is NULL or points to a `size_t struct_size`.
pub(super) unsafe fn block_of<T: Versioned>(pointer: *const T) -> Result<Block, Failure> {
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
pub(super) unsafe fn read_struct<T: Versioned + Default>(pointer: *const T) -> Result<T, Failure> {
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
pub(super) unsafe fn write_struct<T: Versioned>(pointer: *mut T, value: T) {
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

/// Defaults for as much of the caller's struct as it has room for, and that room as its `struct_size`. Nothing for NULL
/// or where not even that has room. A struct longer than our own gets its size too, so that every call refuses it.
///
/// # Safety
/// `pointer` is NULL or points to room for `size` bytes.
pub(super) unsafe fn initialise<T: Versioned + Default>(pointer: *mut T, size: usize) {
    if pointer.is_null() || size < size_of::<size_t>() {
        return;
    }
    let value = T::default();
    // SAFETY: what is written is no longer than our own struct, and the caller has room for it; it may be unaligned.
    unsafe {
        pointer.cast::<u8>().copy_from_nonoverlapping((&raw const value).cast(), size.min(size_of::<T>()));
        pointer.cast::<usize>().write_unaligned(size);
    }
}

#[cfg(test)]
mod tests {
    use std::mem::offset_of;
    use std::ptr::{null, null_mut};

    use super::super::status::QSM_BAD_STRUCT_SIZE;
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
        const LATER_SIZES: &'static [usize] = &[size_of::<Self>()];
    }

    #[test]
    fn vertices_are_a_slice_only_without_bytes_between_them() {
        let mut numbers = [1.0_f32, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
        let mut slice = |stride: usize| {
            let start = numbers.as_mut_ptr();
            CallersVertices { start, stride, count: 2 }.as_slice().map(<[_]>::to_vec)
        };
        assert_eq!(slice(12), Some(vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]));
        assert_eq!(slice(16), None);
        let none = CallersVertices::<f64> { start: null_mut(), stride: 24, count: 0 };
        assert_eq!(none.as_slice(), Some(&[][..]));
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
    fn initialising_writes_no_further_than_the_caller_has_room() {
        let initialised = |size| {
            let mut target = given(usize::MAX);
            // SAFETY: there is room for the whole struct, and no more than that is written whatever the size.
            unsafe { initialise(&mut target, size) };
            (target.struct_size, target.first, target.added)
        };
        assert_eq!(initialised(Grown::FIRST_SIZE), (Grown::FIRST_SIZE, 1, 80));
        assert_eq!(initialised(size_of::<Grown>()), (size_of::<Grown>(), 1, 2));
        assert_eq!(initialised(size_of::<Grown>() + 8), (size_of::<Grown>() + 8, 1, 2));
        assert_eq!(initialised(size_of::<size_t>() - 1), (usize::MAX, 70, 80));
        // SAFETY: nothing is written through NULL.
        unsafe { initialise(null_mut::<Grown>(), 24) };
    }

    #[test]
    fn only_whole_versions_are_taken() {
        for inside in [Grown::FIRST_SIZE + 1, size_of::<Grown>() - 1] {
            assert_eq!(Grown::check_size(inside).unwrap_err().status, QSM_BAD_STRUCT_SIZE);
        }
    }
}
