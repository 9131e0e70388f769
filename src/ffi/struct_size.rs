//! How the structs of the interface grow without breaking programs built against an older header.
//!
//! Fields are only ever appended. A caller states the size of the struct that it knows in `struct_size`; the library
//! reads or writes that many bytes and takes the defaults for the rest. A struct longer than the library's own comes
//! from a newer header and is refused, because its last fields would be ignored in silence.
//!
//! The `_init` functions cannot know how much room the caller has. They write the first version's fields for ever; a
//! struct that grows gets a second init function, to which the new header maps the old name.
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
    /// Whether the library only writes it. Then 0 means the first version: a zeroed struct is as good as an initialised
    /// one, while zeroed options would be options that nobody chose.
    const IS_OUTPUT: bool = false;

    /// Size of the part of a caller's struct that can be used.
    fn check_size(size: usize) -> Result<usize, Failure> {
        if size == 0 && Self::IS_OUTPUT {
            return Ok(Self::FIRST_SIZE);
        }
        if (Self::FIRST_SIZE..=size_of::<Self>()).contains(&size) {
            return Ok(size);
        }
        let fault = format!("has struct_size {size}, not {} to {}", Self::FIRST_SIZE, size_of::<Self>());
        Err(Failure::of(QSM_BAD_STRUCT_SIZE, Self::NAME, &fault))
    }
}
