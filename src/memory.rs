//! Allocation that fails with a status instead of an abort.

use crate::error::Error;
use crate::pages;

/// An empty vector with room for exactly `capacity` elements.
pub(crate) fn reserved<T>(capacity: usize) -> Result<Vec<T>, Error> {
    let mut vector = Vec::new();
    vector
        .try_reserve_exact(capacity)
        .map_err(|_| Error::OutOfMemory { bytes: capacity.saturating_mul(size_of::<T>()) })?;
    pages::ask_for_large(vector.spare_capacity_mut());
    Ok(vector)
}

/// A vector of all that comes, however much that is.
pub(crate) fn gathered<T>(source: impl Iterator<Item = T>) -> Result<Vec<T>, Error> {
    let mut vector = Vec::new();
    for item in source {
        push(&mut vector, item)?;
    }
    Ok(vector)
}

/// Appends one element.
pub(crate) fn push<T>(vector: &mut Vec<T>, item: T) -> Result<(), Error> {
    let bytes = (vector.len() + 1).saturating_mul(size_of::<T>());
    vector.try_reserve(1).map_err(|_| Error::OutOfMemory { bytes })?;
    vector.push(item);
    Ok(())
}

/// A vector of `length` copies of `value`.
pub(crate) fn filled<T: Clone>(value: T, length: usize) -> Result<Vec<T>, Error> {
    let mut vector = reserved(length)?;
    vector.resize(length, value);
    Ok(vector)
}

/// A copy of `source`.
pub(crate) fn copied<T: Clone>(source: &[T]) -> Result<Vec<T>, Error> {
    let mut vector = reserved(source.len())?;
    vector.extend_from_slice(source);
    Ok(vector)
}
