//! Checks on the caller's memory by address alone, before anything of it is read.
#![forbid(unsafe_code)]

use std::ffi::CStr;

use super::status::{
    Failure, QSM_BAD_STRIDE, QSM_COUNT_OVERFLOW, QSM_INDEX_COUNT, QSM_MISALIGNED, QSM_NULL_POINTER, QSM_OVERLAP,
};

/// A piece of the caller's memory.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block {
    /// The argument or option that points to it.
    pub name: &'static CStr,
    start: usize,
    bytes: usize,
}

impl Block {
    /// A struct of this size in bytes, 0 for none.
    pub fn object<T>(name: &'static CStr, pointer: *const T, bytes: usize) -> Self {
        Self { name, start: pointer.addr(), bytes }
    }

    /// `count` elements without gaps. The pointer may be NULL if there are none.
    pub fn array<T>(
        name: &'static CStr,
        pointer: *const T,
        count_name: &'static CStr,
        count: usize,
    ) -> Result<Self, Failure> {
        Self::sized::<T>(name, pointer, count_name, count.checked_mul(size_of::<T>()))
    }

    /// `count` vertices of three `T` each, `stride` bytes apart. Behind the last one nothing needs to follow.
    pub fn vertices<T>(pointer: *const T, count: usize, stride: usize) -> Result<Self, Failure> {
        let vertex = 3 * size_of::<T>();
        if stride < vertex || !stride.is_multiple_of(align_of::<T>()) {
            let fault = format!("is {stride}, not a multiple of {} from {vertex} on", align_of::<T>());
            return Err(Failure::of(QSM_BAD_STRIDE, c"stride_bytes", &fault));
        }
        let bytes = count.checked_mul(stride).map(|all| if count == 0 { 0 } else { all - stride + vertex });
        Self::sized::<T>(c"positions", pointer, c"vertex_count", bytes)
    }

    /// Three vertex indices a triangle.
    pub fn indices(pointer: *const u32, count: usize) -> Result<Self, Failure> {
        if !count.is_multiple_of(3) {
            return Err(Failure::of(QSM_INDEX_COUNT, c"index_count", &format!("is {count}, not a multiple of 3")));
        }
        Self::array(c"indices", pointer, c"index_count", count)
    }

    fn sized<T>(
        name: &'static CStr,
        pointer: *const T,
        count_name: &'static CStr,
        bytes: Option<usize>,
    ) -> Result<Self, Failure> {
        // The language allows no object larger than isize::MAX, and none that runs past the end of the address space.
        let addressable = bytes.filter(|&b| isize::try_from(b).is_ok() && pointer.addr().checked_add(b).is_some());
        let Some(bytes) = addressable else {
            return Err(Failure::of(QSM_COUNT_OVERFLOW, count_name, "is more than can be addressed"));
        };
        if bytes > 0 && pointer.is_null() {
            return Err(Failure::of(QSM_NULL_POINTER, name, "is NULL"));
        }
        if bytes > 0 && !pointer.is_aligned() {
            return Err(Failure::of(QSM_MISALIGNED, name, &format!("is not aligned to {} bytes", align_of::<T>())));
        }
        Ok(Self { name, start: pointer.addr(), bytes })
    }

    /// How many `T` it holds.
    pub fn elements<T>(&self) -> usize {
        self.bytes / size_of::<T>()
    }

    /// Whether there is no such memory.
    pub fn is_empty(&self) -> bool {
        self.bytes == 0
    }

    /// Refuses memory that is written through this block and read or written through another one. The fault is laid on
    /// `self` or on the other one as `blame` says.
    pub fn apart_from(&self, others: &[Self], blame: Blame) -> Result<(), Failure> {
        let Some(other) = others.iter().find(|other| self.overlaps(other)) else {
            return Ok(());
        };
        let (at_fault, with) = match blame {
            Blame::This => (self, other),
            Blame::Other => (other, self),
        };
        let fault = format!("overlaps {}", with.name.to_string_lossy());
        Err(Failure::of(QSM_OVERLAP, at_fault.name, &fault))
    }

    /// Refuses written memory that overlaps anything else, written or read. The later one of the two is named, where
    /// what is read counts as later than all that is written.
    pub fn all_apart(written: &[Self], read: &[Self]) -> Result<(), Failure> {
        for (at, block) in written.iter().enumerate() {
            block.apart_from(&written[at + 1..], Blame::Other)?;
            block.apart_from(read, Blame::Other)?;
        }
        Ok(())
    }

    fn overlaps(&self, other: &Self) -> bool {
        let shared_start = self.start.max(other.start);
        let shared_end = (self.start + self.bytes).min(other.start + other.bytes);
        shared_start < shared_end
    }
}

/// Which of two overlapping blocks is named as the offender.
#[derive(Debug, Clone, Copy)]
pub(super) enum Blame {
    This,
    Other,
}

#[cfg(test)]
mod tests {
    use std::ptr::{null, without_provenance};

    use super::super::status::qsm_status;
    use super::*;

    fn fault<T: std::fmt::Debug>(result: Result<T, Failure>) -> (qsm_status, &'static CStr) {
        let failure = result.expect_err("must be refused");
        (failure.status, failure.name.expect("names the offender"))
    }

    fn at<T>(address: usize) -> *const T {
        without_provenance(address)
    }

    #[test]
    fn null_is_allowed_for_nothing_only() {
        assert!(Block::vertices::<f32>(null(), 0, 12).is_ok());
        assert!(Block::indices(null(), 0).is_ok());
        assert_eq!(fault(Block::vertices::<f32>(null(), 1, 12)), (QSM_NULL_POINTER, c"positions"));
        assert_eq!(fault(Block::indices(null(), 3)), (QSM_NULL_POINTER, c"indices"));
    }

    #[test]
    fn stride_holds_three_aligned_coordinates() {
        for bad in [0, 8, 11, 14] {
            assert_eq!(fault(Block::vertices::<f32>(at(64), 1, bad)), (QSM_BAD_STRIDE, c"stride_bytes"));
        }
        assert_eq!(fault(Block::vertices::<f64>(at(64), 1, 28)), (QSM_BAD_STRIDE, c"stride_bytes"));
        assert!(Block::vertices::<f64>(at(64), 1, 32).is_ok());
    }

    #[test]
    fn counts_stay_within_the_address_space() {
        let over = (QSM_COUNT_OVERFLOW, c"vertex_count");
        for count in [usize::MAX, usize::MAX / 12, isize::MAX as usize / 12 + 2] {
            assert_eq!(fault(Block::vertices::<f32>(at(64), count, 12)), over);
        }
        assert_eq!(fault(Block::vertices::<f32>(at(usize::MAX - 15), 2, 12)), over);
        let indices = isize::MAX as usize / 12 * 3 + 3;
        assert_eq!(fault(Block::indices(at(64), indices)), (QSM_COUNT_OVERFLOW, c"index_count"));
    }

    #[test]
    fn misaligned_and_partial_triangles_are_refused() {
        assert_eq!(fault(Block::vertices::<f64>(at(68), 1, 24)), (QSM_MISALIGNED, c"positions"));
        assert_eq!(fault(Block::indices(at(66), 3)), (QSM_MISALIGNED, c"indices"));
        assert_eq!(fault(Block::indices(at(64), 4)), (QSM_INDEX_COUNT, c"index_count"));
    }

    #[test]
    fn only_shared_bytes_overlap() {
        // Two vertices 32 bytes apart: the block ends with the last coordinate, at 64 + 32 + 12.
        let positions = Block::vertices::<f32>(at(64), 2, 32).unwrap();
        let indices = |address| Block::indices(at(address), 3).unwrap();
        assert!(positions.apart_from(&[indices(108), indices(52)], Blame::Other).is_ok());
        for inside in [104, 56, 80] {
            assert_eq!(fault(positions.apart_from(&[indices(inside)], Blame::Other)), (QSM_OVERLAP, c"indices"));
        }
        assert_eq!(fault(positions.apart_from(&[indices(80)], Blame::This)), (QSM_OVERLAP, c"positions"));
        let empty = Block::indices(at(80), 0).unwrap();
        assert!(positions.apart_from(&[empty, Block::object::<u8>(c"options", null(), 0)], Blame::Other).is_ok());
    }
    #[test]
    fn only_what_is_read_may_be_shared() {
        let [a, b, c] = [64, 128, 132].map(|address| Block::indices(at(address), 3).unwrap());
        assert!(Block::all_apart(&[a], &[b, c]).is_ok());
        let named = |name, block: Block| Block { name, ..block };
        let [first, second] = [named(c"first", b), named(c"second", c)];
        assert_eq!(fault(Block::all_apart(&[a, first, second], &[])), (QSM_OVERLAP, c"second"));
        assert_eq!(fault(Block::all_apart(&[a, second], &[first])), (QSM_OVERLAP, c"first"));
    }
}
