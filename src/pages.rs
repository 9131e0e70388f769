//! Large pages for large arrays.
//!
//! A page of 4 KiB costs a fault when it is first touched, and a miss of the translation cache for almost every vertex that is
//! looked up at random. Where the system has pages of 2 MiB for those who ask, arrays ask.

use std::mem::MaybeUninit;

/// Bytes from which on memory is a mapping of its own, so that nothing that belongs to others is asked for: the greatest
/// threshold of glibc's allocator.
const LARGE: usize = 32 << 20;

/// Bytes from which on an array that is not large is worth a mapping of its own. Smaller ones come sooner by pages that the call has
/// given back before.
const WORTH_IT: usize = 8 << 20;

/// The capacity with which an array that is worth it gets a mapping of its own.
pub(crate) fn own_capacity<T>(capacity: usize) -> Option<usize> {
    let bytes = capacity.saturating_mul(size_of::<T>());
    let is_worth_it = cfg!(all(target_os = "linux", target_pointer_width = "64")) && (WORTH_IT..LARGE).contains(&bytes);
    is_worth_it.then(|| LARGE.div_ceil(size_of::<T>()))
}

/// Asks for large pages in an array that nothing has been written to. Whether they come changes nothing but the time.
#[cfg(target_os = "linux")]
pub(crate) fn ask_for_large<T>(room: &mut [MaybeUninit<T>]) {
    const PAGE: usize = 2 << 20;
    let (start, bytes) = (room.as_mut_ptr().cast::<libc::c_void>(), size_of_val(room));
    if bytes < LARGE {
        return;
    }
    let skipped = start.align_offset(PAGE);
    let whole = bytes.saturating_sub(skipped) / PAGE * PAGE;
    // SAFETY: the pages lie within `room`, which nobody else reads or writes, and the advice changes no byte of it. If it is
    // refused, all stays as it was.
    unsafe { libc::madvise(start.wrapping_byte_add(skipped), whole, libc::MADV_HUGEPAGE) };
}

/// Other systems have no such wish.
#[cfg(not(target_os = "linux"))]
pub(crate) fn ask_for_large<T>(_: &mut [MaybeUninit<T>]) {}

#[cfg(test)]
mod tests {
    use crate::memory;

    #[test]
    fn arrays_hold_what_is_written_whatever_their_size() {
        for length in [0, 1, 1000, 1 << 20, 5 << 20] {
            let array = memory::filled(7_u64, length).expect("memory");
            assert!(array.len() == length && array.iter().all(|&x| x == 7));
        }
    }
}
