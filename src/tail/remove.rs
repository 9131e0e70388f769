//! Removal of a vertex: its star is filled anew without it.

use super::cavity::Cavity;
use super::collapse::fill;
use super::patch::{Patch, Shape};
use super::report::Reason;

/// Removes `v` and retriangulates its star.
pub(super) fn remove(patch: &Patch, v: usize) -> Result<Shape, Reason> {
    if let Some(reason) = patch.reason_to_exist(v) {
        return Err(reason);
    }
    let cavity = Cavity::of_stars(&patch.shape, &[v])?;
    let triangles = fill(&patch.shape, &cavity.rim, None).ok_or(Reason::Fold)?;
    Ok(cavity.filled(&patch.shape, &triangles))
}
