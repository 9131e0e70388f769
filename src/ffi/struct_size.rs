//! How the structs of the interface grow without breaking programs built against an older header.
//!
//! Fields are only ever appended, and never into the padding at the end. A caller states the size of the struct that it
//! knows in `struct_size`; the library reads or writes that many bytes and takes the defaults for the rest. Only sizes
//! at which a version ends are taken: any other would cut a field in two, or come from a newer header, whose last
//! fields would be ignored in silence.
//!
//! The header hands the caller's own size to the `_init_sized` functions, which write no further. The `_init` functions
//! without a size are for languages that do not read the header; they write the structs of version 0.1 for ever.
//!
//! `qsm_measurement` is part of `qsm_report`: once released it stays as it is, and new figures are appended to the
//! report.
#![forbid(unsafe_code)]

use std::ffi::CStr;

use super::status::{Failure, QSM_BAD_STRUCT_SIZE};

/// A struct that starts with a `size_t struct_size`.
pub(super) trait Versioned: Sized {
    /// The argument that points to it.
    const NAME: &'static CStr;
    /// Its size in the first version, trailing padding left out.
    const FIRST_SIZE: usize;
    /// Its sizes in the versions that followed, rising, trailing padding left out.
    const LATER_SIZES: &'static [usize] = &[];
    /// What the init function without a size writes: the struct of version 0.1.
    const INIT_SIZE: usize = Self::FIRST_SIZE;
    /// Whether the library only writes it. Then 0 means the first version: a zeroed struct is as good as an initialised
    /// one, while zeroed options would be options that nobody chose.
    const IS_OUTPUT: bool = false;

    /// Size of the part of a caller's struct that can be used.
    fn check_size(size: usize) -> Result<usize, Failure> {
        if size == 0 && Self::IS_OUTPUT {
            return Ok(Self::FIRST_SIZE);
        }
        let is_end = |end: usize| size == end || size == end.next_multiple_of(align_of::<Self>());
        if is_end(Self::FIRST_SIZE) || Self::LATER_SIZES.iter().any(|&end| is_end(end)) {
            return Ok(size);
        }
        let sizes: Vec<String> = [Self::FIRST_SIZE].iter().chain(Self::LATER_SIZES).map(usize::to_string).collect();
        let fault = format!("has struct_size {size}, not {}", sizes.join(" or "));
        Err(Failure::of(QSM_BAD_STRUCT_SIZE, Self::NAME, &fault))
    }
}
