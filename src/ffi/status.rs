//! Status values, and what stands behind one that is not `QSM_OK`.
#![forbid(unsafe_code)]

use std::any::Any;
use std::ffi::CStr;

use crate::error::Error;

/// Result of a call: one of the constants QSM_OK to QSM_VISIT_OUT_OF_RANGE. Their values never change.
pub type qsm_status = i32;

/// Success.
pub const QSM_OK: qsm_status = 0;
/// A pointer that may not be NULL is NULL.
pub const QSM_NULL_POINTER: qsm_status = 1;
/// struct_size was not set by the init function, or the struct comes from a newer qsmesh than the library.
pub const QSM_BAD_STRUCT_SIZE: qsm_status = 2;
/// stride_bytes is less than three coordinates, or no multiple of the size of one.
pub const QSM_BAD_STRIDE: qsm_status = 3;
/// A pointer is not aligned for its type.
pub const QSM_MISALIGNED: qsm_status = 4;
/// A count is more than memory or the library can address.
pub const QSM_COUNT_OVERFLOW: qsm_status = 5;
/// index_count is no multiple of 3.
pub const QSM_INDEX_COUNT: qsm_status = 6;
/// A triangle names a vertex that does not exist.
pub const QSM_INDEX_OUT_OF_RANGE: qsm_status = 7;
/// A coordinate is NaN or infinite.
pub const QSM_NON_FINITE_VERTEX: qsm_status = 8;
/// An option or a parameter is unknown or out of its range.
pub const QSM_BAD_OPTION: qsm_status = 9;
/// A marked feature edge names a vertex that does not exist.
pub const QSM_FEATURE_EDGE_OUT_OF_RANGE: qsm_status = 10;
/// Memory that is written overlaps other memory of the same call.
pub const QSM_OVERLAP: qsm_status = 11;
/// The progress callback asked to stop.
pub const QSM_CANCELLED: qsm_status = 12;
/// Working memory could not be had.
pub const QSM_OUT_OF_MEMORY: qsm_status = 13;
/// Defect of the library. A message stands on the standard error stream.
pub const QSM_PANIC: qsm_status = 14;
/// An entry of visits names a vertex that does not exist.
pub const QSM_VISIT_OUT_OF_RANGE: qsm_status = 15;

/// The text of each status, at its value.
const STRINGS: [&CStr; 16] = [
    c"success",
    c"a required pointer is NULL",
    c"struct_size is not that of a known version",
    c"stride_bytes is too short or not a multiple of the coordinate size",
    c"a pointer is not aligned for its type",
    c"a count is more than can be addressed",
    c"index_count is not a multiple of 3",
    c"a triangle names a vertex that does not exist",
    c"a coordinate is not finite",
    c"an option is unknown or out of its range",
    c"a feature edge names a vertex that does not exist",
    c"written memory overlaps other memory of the call",
    c"cancelled by the progress callback",
    c"working memory could not be had",
    c"internal error",
    c"a visit names a vertex that does not exist",
];

/// Text for any number, known or not.
pub(super) fn text(status: qsm_status) -> &'static CStr {
    usize::try_from(status).ok().and_then(|at| STRINGS.get(at)).copied().unwrap_or(c"unknown status")
}

/// Why a call did not succeed, with all that a report says about it.
#[derive(Debug)]
pub(super) struct Failure {
    pub status: qsm_status,
    /// Number of the first vertex, triangle, edge or visit at fault.
    pub offender: Option<usize>,
    /// Argument or option at fault.
    pub name: Option<&'static CStr>,
    pub message: String,
}

impl Failure {
    /// A fault of an argument or option as a whole.
    pub fn of(status: qsm_status, name: &'static CStr, fault: &str) -> Self {
        let message = format!("{} {fault}", name.to_string_lossy());
        Self { status, offender: None, name: Some(name), message }
    }

    /// A caught panic.
    pub fn panic(payload: &(dyn Any + Send)) -> Self {
        let said = payload.downcast_ref::<&str>().copied();
        let said = said.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message");
        Self { status: QSM_PANIC, offender: None, name: None, message: format!("internal error: {said}") }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let (status, offender, name) = match error {
            Error::IndexOutOfRange { triangle, .. } => (QSM_INDEX_OUT_OF_RANGE, Some(triangle), Some(c"indices")),
            Error::NonFinite { vertex } => (QSM_NON_FINITE_VERTEX, Some(vertex), Some(c"positions")),
            Error::BadOption { name, .. } => (QSM_BAD_OPTION, None, c_name(name)),
            Error::LockLength { .. } => (QSM_BAD_OPTION, None, Some(c"vertex_lock")),
            Error::MaskLength { .. } => (QSM_BAD_OPTION, None, Some(c"triangle_mask")),
            Error::FeatureEdgeOutOfRange { edge, .. } => {
                (QSM_FEATURE_EDGE_OUT_OF_RANGE, Some(edge), Some(c"feature_edges"))
            }
            Error::SeedLength { .. } => (QSM_BAD_OPTION, None, Some(c"seeds")),
            Error::VisitOutOfRange { visit, .. } => (QSM_VISIT_OUT_OF_RANGE, Some(visit), Some(c"visits")),
            Error::TooLarge { .. } => (QSM_COUNT_OVERFLOW, None, None),
            Error::Cancelled => (QSM_CANCELLED, None, Some(c"progress")),
            Error::OutOfMemory { .. } => (QSM_OUT_OF_MEMORY, None, None),
        };
        Self { status, offender, name, message: error.to_string() }
    }
}

/// The name of an option as a C string that lives for ever.
fn c_name(name: &str) -> Option<&'static CStr> {
    const NAMES: [&CStr; 20] = [
        c"iterations",
        c"plane",
        c"ideal",
        c"boundary",
        c"order",
        c"threads",
        c"relaxation",
        c"interval_width",
        c"sample_limit",
        c"quality_floor",
        c"feature_angle",
        c"max_deviation",
        c"tail_edge_ratio",
        c"tail_min_angle",
        c"tail_max_angle",
        c"tail_attempts",
        c"flips",
        c"method",
        c"metric",
        c"keep_sizes",
    ];
    NAMES.into_iter().find(|known| known.to_bytes() == name.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_has_a_text() {
        assert_eq!(text(QSM_OK), c"success");
        assert_eq!(text(QSM_PANIC), c"internal error");
        assert_eq!(text(QSM_VISIT_OUT_OF_RANGE), c"a visit names a vertex that does not exist");
        for unknown in [-1, QSM_VISIT_OUT_OF_RANGE + 1, i32::MAX, i32::MIN] {
            assert_eq!(text(unknown), c"unknown status");
        }
    }

    #[test]
    fn errors_keep_their_element_and_message() {
        let failure = Failure::from(Error::IndexOutOfRange { triangle: 7, index: 9, vertex_count: 8 });
        assert_eq!((failure.status, failure.offender), (QSM_INDEX_OUT_OF_RANGE, Some(7)));
        assert_eq!(failure.message, "triangle 7 names vertex 9, but there are 8 vertices");
    }
}
