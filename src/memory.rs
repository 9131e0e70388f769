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

/// The same for working memory of a call: where it is worth it, more address space is taken, of which what is not written to never
/// becomes memory.
pub(crate) fn spacious<T>(capacity: usize) -> Result<Vec<T>, Error> {
    let mut vector = Vec::new();
    match pages::own_capacity::<T>(capacity) {
        Some(more) if vector.try_reserve_exact(more).is_ok() => {}
        _ => return reserved(capacity),
    }
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

/// A vector of `length` copies of `value`, as working memory.
pub(crate) fn filled<T: Clone>(value: T, length: usize) -> Result<Vec<T>, Error> {
    let mut vector = spacious(length)?;
    vector.resize(length, value);
    Ok(vector)
}

/// A copy of `source`.
pub(crate) fn copied<T: Clone>(source: &[T]) -> Result<Vec<T>, Error> {
    let mut vector = reserved(source.len())?;
    vector.extend_from_slice(source);
    Ok(vector)
}
