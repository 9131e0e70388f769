//! Where every element came from, and what could not be cured, as C sees them.
#![forbid(unsafe_code)]

use std::ffi::CStr;
use std::mem::offset_of;
use std::ptr::null_mut;

use libc::size_t;

use super::block::Block;
use super::status::Failure;
use super::struct_size::Versioned;
use crate::tail::{Defect, Leftover, Reason};

/// What is wrong with a triangle: one of the constants QSM_DEFECT_DEGENERATE to QSM_DEFECT_SMALL_ANGLE.
pub type qsm_defect = i32;
/// It names a vertex twice, or has no area.
pub const QSM_DEFECT_DEGENERATE: qsm_defect = 0;
/// Its longest edge is too long for its shortest.
pub const QSM_DEFECT_NEEDLE: qsm_defect = 1;
/// Its largest angle is too large.
pub const QSM_DEFECT_CAP: qsm_defect = 2;
/// Its smallest angle is too small, and nothing else is wrong.
pub const QSM_DEFECT_SMALL_ANGLE: qsm_defect = 3;

/// Why a triangle could not be cured: one of the constants QSM_REASON_FEATURE to QSM_REASON_NO_GAIN.
pub type qsm_reason = i32;
/// The cure would have moved or crossed a feature.
pub const QSM_REASON_FEATURE: qsm_reason = 0;
/// The cure would have moved or removed a vertex locked through vertex_lock.
pub const QSM_REASON_LOCKED: qsm_reason = 1;
/// The cure would have moved the boundary.
pub const QSM_REASON_BOUNDARY: qsm_reason = 2;
/// The neighbourhood is no disc, or the cure would have made it none.
pub const QSM_REASON_TOPOLOGY: qsm_reason = 3;
/// The cure would have passed max_deviation.
pub const QSM_REASON_DEVIATION: qsm_reason = 4;
/// The cure would have folded the surface or bent it sharply, or left a triangle below quality_floor.
pub const QSM_REASON_FOLD: qsm_reason = 5;
/// Nothing made the worst triangle of the neighbourhood better, or tail_attempts or tail_operations was reached.
pub const QSM_REASON_NO_GAIN: qsm_reason = 6;

/// A triangle that is still in the tail.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct qsm_leftover {
    /// Its number in the triangles that came out, from 0.
    pub triangle: u32,
    /// What is wrong with it.
    pub defect: qsm_defect,
    /// Why it could not be cured.
    pub reason: qsm_reason,
}

/// Where qsm_collapse_tails_* and qsm_improve_* write where everything came from. Set up with qsm_maps_init, then set
/// the arrays that you want; each may be NULL. How much room an array needs is told by the counts before the call; how
/// much of it is filled, by the counts after it. What lies behind that keeps its bits, and after a failure everything
/// does.
#[repr(C)]
pub struct qsm_maps {
    /// Size of this struct in bytes. Set by qsm_maps_init; leave it alone.
    pub struct_size: size_t,
    /// For each vertex that came out, the number of the vertex that went in which it is. Rising, so that an array of
    /// attributes can be brought along in place, from its first entry to its last: a[v] = a[vertex_source[v]]. Room for
    /// as many numbers as vertices go in. NULL: not wanted. Default NULL.
    pub vertex_source: *mut u32,
    /// For each triangle that came out, the number of the triangle that went in whose place it took. Not always rising.
    /// Room for as many numbers as triangles go in. NULL: not wanted. Default NULL.
    pub triangle_source: *mut u32,
    /// For each corner that came out (3 * triangle + 0, 1 or 2), a corner that went in (numbered likewise) of the same
    /// vertex on the same side of all features, in the triangle in triangle_source if that is known to have one there.
    /// Not always rising. Room for as many numbers as indices go in. NULL: not wanted. Default NULL.
    pub corner_source: *mut u32,
    /// Triangles that could not be cured, by rising number. May be NULL if leftover_capacity is 0. Default NULL.
    pub leftovers: *mut qsm_leftover,
    /// Entries for which leftovers has room. Default 0.
    pub leftover_capacity: size_t,
    /// Set by the call: triangles that could not be cured. May be more than leftover_capacity; then only the first
    /// leftover_capacity of them are in leftovers.
    pub leftover_count: size_t,
}

impl Default for qsm_maps {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            vertex_source: null_mut(),
            triangle_source: null_mut(),
            corner_source: null_mut(),
            leftovers: null_mut(),
            leftover_capacity: 0,
            leftover_count: 0,
        }
    }
}

impl Versioned for qsm_maps {
    const NAME: &'static CStr = c"maps";
    const FIRST_SIZE: usize = offset_of!(Self, leftover_count) + size_of::<size_t>();
}

impl qsm_maps {
    /// The memory that the maps point to: vertex, triangle and corner sources, then leftovers.
    pub(super) fn blocks(&self, vertex_count: usize, index_count: usize) -> Result<[Block; 4], Failure> {
        let unless_null = |array: *mut u32, count| if array.is_null() { 0 } else { count };
        let vertices = unless_null(self.vertex_source, vertex_count);
        let triangles = unless_null(self.triangle_source, index_count / 3);
        let corners = unless_null(self.corner_source, index_count);
        Ok([
            Block::array(c"vertex_source", self.vertex_source, c"vertex_count", vertices)?,
            Block::array(c"triangle_source", self.triangle_source, c"index_count", triangles)?,
            Block::array(c"corner_source", self.corner_source, c"index_count", corners)?,
            Block::array(c"leftovers", self.leftovers, c"leftover_capacity", self.leftover_capacity)?,
        ])
    }
}

impl From<&Leftover> for qsm_leftover {
    fn from(leftover: &Leftover) -> Self {
        Self { triangle: leftover.triangle, defect: defect(leftover.defect), reason: reason(leftover.reason) }
    }
}

fn defect(defect: Defect) -> qsm_defect {
    match defect {
        Defect::Degenerate => QSM_DEFECT_DEGENERATE,
        Defect::Needle => QSM_DEFECT_NEEDLE,
        Defect::Cap => QSM_DEFECT_CAP,
        Defect::SmallAngle => QSM_DEFECT_SMALL_ANGLE,
    }
}

fn reason(reason: Reason) -> qsm_reason {
    match reason {
        Reason::Feature => QSM_REASON_FEATURE,
        Reason::Locked => QSM_REASON_LOCKED,
        Reason::Boundary => QSM_REASON_BOUNDARY,
        Reason::Topology => QSM_REASON_TOPOLOGY,
        Reason::Deviation => QSM_REASON_DEVIATION,
        Reason::Fold => QSM_REASON_FOLD,
        Reason::NoGain => QSM_REASON_NO_GAIN,
    }
}

#[cfg(test)]
mod tests {
    use std::ptr::without_provenance_mut;

    use super::*;

    #[test]
    fn leftovers_keep_what_they_say() {
        let leftover = Leftover { triangle: 7, defect: Defect::Cap, reason: Reason::Locked };
        assert_eq!(qsm_leftover::from(&leftover), qsm_leftover { triangle: 7, defect: 2, reason: 1 });
    }

    #[test]
    fn arrays_have_the_size_of_what_goes_in() {
        let [a, b, c, d] = [64, 1000, 2000, 4000].map(without_provenance_mut::<u32>);
        let all = qsm_maps {
            vertex_source: a,
            triangle_source: b,
            corner_source: c,
            leftovers: d.cast(),
            leftover_capacity: 5,
            ..Default::default()
        };
        let blocks = all.blocks(8, 36).unwrap();
        assert_eq!(blocks.map(|block| block.elements::<u8>()), [32, 48, 144, 60]);
        assert!(qsm_maps::default().blocks(8, 36).unwrap().iter().all(Block::is_empty));
    }
}
