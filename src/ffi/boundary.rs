//! The wall between unwinding and a host that knows nothing of it.
#![forbid(unsafe_code)]

use std::panic::{AssertUnwindSafe, catch_unwind};

use super::status::Failure;

/// Runs the body of an exported function and turns a panic in it into a failure. Unwind safety can be asserted because
/// a body works on private copies, which are gone after a panic, and writes to the caller's memory as its last act.
pub(super) fn contained<R>(body: impl FnOnce() -> Result<R, Failure>) -> Result<R, Failure> {
    catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|payload| Err(Failure::panic(&*payload)))
}

#[cfg(test)]
mod tests {
    use super::super::status::QSM_PANIC;
    use super::*;

    fn failure_of(body: impl FnOnce() -> Result<(), Failure>) -> (i32, String) {
        let failure = contained(body).expect_err("the body must fail");
        (failure.status, failure.message)
    }

    #[test]
    fn a_panic_becomes_a_status_with_its_message() {
        assert_eq!(failure_of(|| panic!("plain")), (QSM_PANIC, "internal error: plain".into()));
        let n = 3;
        assert_eq!(failure_of(|| panic!("number {n}")), (QSM_PANIC, "internal error: number 3".into()));
        assert_eq!(failure_of(|| std::panic::panic_any(n)), (QSM_PANIC, "internal error: no message".into()));
    }

    #[test]
    fn everything_else_passes_through() {
        assert_eq!(contained(|| Ok(5)).unwrap(), 5);
        let failure = contained(|| Err::<(), _>(Failure::of(11, c"indices", "overlap"))).unwrap_err();
        assert_eq!((failure.status, failure.message.as_str()), (11, "indices overlap"));
    }
}
