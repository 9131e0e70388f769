//! The two precisions of the caller's buffers.

/// A coordinate type: `f32` or `f64`. All arithmetic is in `f64`; this says what a position can be stored as.
pub trait Coordinate: Copy + Send + Sync + sealed::Sealed {
    /// Exact widening.
    fn to_f64(self) -> f64;
    /// Nearest storable value.
    fn from_f64(value: f64) -> Self;
}

impl Coordinate for f32 {
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    fn from_f64(value: f64) -> Self {
        value as Self
    }
}

impl Coordinate for f64 {
    fn to_f64(self) -> f64 {
        self
    }
    fn from_f64(value: f64) -> Self {
        value
    }
}

mod sealed {
    use std::borrow::Cow;

    use crate::mesh::Positions;

    pub trait Sealed: Copy + 'static {
        /// Positions as they are.
        fn positions(all: Cow<'_, [[Self; 3]]>) -> Positions<'_>;
    }

    impl Sealed for f32 {
        fn positions(all: Cow<'_, [[Self; 3]]>) -> Positions<'_> {
            Positions::Single(all)
        }
    }

    impl Sealed for f64 {
        fn positions(all: Cow<'_, [[Self; 3]]>) -> Positions<'_> {
            Positions::Double(all)
        }
    }
}
