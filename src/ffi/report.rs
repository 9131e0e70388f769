//! Reports and measurements as C sees them.
#![forbid(unsafe_code)]

use std::ffi::CStr;
use std::mem::offset_of;
use std::ptr::null;

use libc::{c_char, size_t};

use super::status::{Failure, QSM_OK, qsm_status};
use super::struct_size::Versioned;
use crate::improve::Improvement;
use crate::quality::{Distribution, Measurement};
use crate::report::{Kept, Report, Seconds};
use crate::tail::TailReport;

/// Size of message in qsm_report, the final 0 byte included.
// Chosen so that no padding follows: padding would carry bytes of the library's stack to the host.
pub const QSM_MESSAGE_BYTES: usize = 260;

/// Value of offender in qsm_report where no element is to blame.
pub const QSM_NO_OFFENDER: u64 = u64::MAX;

/// Distribution of one quality parameter. Infinite values are counted and left out of everything else.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct qsm_distribution {
    /// Finite values.
    pub count: size_t,
    /// Values that are not finite.
    pub infinite: size_t,
    /// Mean.
    pub mean: f64,
    /// Variance over the count.
    pub variance: f64,
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// Values at 1, 5, 25, 50, 75, 95 and 99 percent.
    pub percentiles: [f64; 7],
}

/// Quality of a mesh. Set up with qsm_measurement_init.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct qsm_measurement {
    /// Size of this struct in bytes. Set by qsm_measurement_init; 0, in a struct filled with zeros, stands for the
    /// first version.
    pub struct_size: size_t,
    /// Vertices, used or not.
    pub vertices: size_t,
    /// Triangles, degenerate ones included.
    pub triangles: size_t,
    /// Longest over shortest edge of a triangle.
    pub edge_ratio: qsm_distribution,
    /// Smallest angle of a triangle, degrees.
    pub min_angle: qsm_distribution,
    /// Largest angle of a triangle, degrees.
    pub max_angle: qsm_distribution,
    /// Mean ratio, 4 * sqrt(3) * area / (sum of squared edges).
    pub shape: qsm_distribution,
    /// Circumradius over twice the inradius.
    pub radius_ratio: qsm_distribution,
    /// Triangles whose smallest angle is below 10 degrees.
    pub below_10: size_t,
    /// Triangles whose smallest angle is below 20 degrees.
    pub below_20: size_t,
    /// Triangles whose smallest angle is below 30 degrees.
    pub below_30: size_t,
    /// Triangles without area.
    pub zero_area: size_t,
    /// Edges with one triangle.
    pub boundary_edges: size_t,
    /// Edges with more than two triangles, or with two that disagree in winding.
    pub non_manifold_edges: size_t,
    /// Signed volume in cubed units of the coordinates: positive where the triangles turn counter-clockwise seen from
    /// outside. For a mesh that is not closed, the volume of the cone from the centre of its bounding box.
    pub volume: f64,
    /// Sum of the areas, in squared units of the coordinates.
    pub area: f64,
}

/// Vertices that kept their bits, by reason. Each vertex has either moved or is counted here exactly once.
#[repr(C)]
#[derive(Default)]
pub struct qsm_kept {
    /// In no triangle.
    pub unreferenced: size_t,
    /// Locked through vertex_lock.
    pub locked: size_t,
    /// On a non-manifold edge or vertex, or where the winding is inconsistent.
    pub non_manifold: size_t,
    /// Among triangles without area, or too few to have an inside.
    pub degenerate: size_t,
    /// On a boundary that stays fixed.
    pub boundary: size_t,
    /// On a corner of the features or of a sliding boundary.
    pub corner: size_t,
    /// Every move that was tried would have made triangles worse.
    pub guard: size_t,
    /// Every move that was tried would have passed max_deviation.
    pub deviation: size_t,
    /// Already in place, or not visited in the order that was chosen.
    pub settled: size_t,
}

/// Wall time of the library's own work, in seconds; measuring is not part of it.
#[repr(C)]
#[derive(Default)]
pub struct qsm_seconds {
    /// Everything but measuring. After qsm_collapse_tails_* the same as tail: the rest is not told apart.
    pub total: f64,
    /// Validation, and finding the triangles around each vertex.
    pub adjacency: f64,
    /// Finding features.
    pub features: f64,
    /// Sweeps.
    pub sweeps: f64,
    /// Treatment of the worst triangles; 0 where there was none.
    pub tail: f64,
}

/// What a call did, in figures, or why it failed. Set up with qsm_report_init; may then be used for any number of
/// calls. After a failure status, offender, offender_name and message are set and all figures are 0. A report that is
/// itself at fault (QSM_BAD_STRUCT_SIZE, or QSM_OVERLAP of the report with other memory of the call) is not written.
#[repr(C)]
pub struct qsm_report {
    /// Size of this struct in bytes. Set by qsm_report_init; 0, in a struct filled with zeros, stands for the first
    /// version.
    pub struct_size: size_t,
    /// Number of the first vertex (QSM_NON_FINITE_VERTEX), triangle (QSM_INDEX_OUT_OF_RANGE) or marked edge
    /// (QSM_FEATURE_EDGE_OUT_OF_RANGE) at fault, from 0; QSM_NO_OFFENDER where no element is.
    pub offender: u64,
    /// Name of the argument, option or map at fault, as in this header; NULL where none is. Lives for ever.
    pub offender_name: *const c_char,
    /// What the call returned.
    pub status: qsm_status,
    /// What went wrong, in English, with the values found; ends with a 0 byte. Empty after success.
    pub message: [c_char; QSM_MESSAGE_BYTES],
    /// The mesh as it came.
    pub before: qsm_measurement,
    /// The mesh as it left.
    pub after: qsm_measurement,
    /// (after - before) / |before| of the signed volume; 0 for a mesh that is not closed.
    pub volume_relative_change: f64,
    /// Vertices that the sweeps have moved. This and all up to moves_refused tells of the sweeps alone, and is 0 after
    /// qsm_collapse_tails_*, which makes none.
    pub moved: size_t,
    /// Vertices that the sweeps have not moved, by reason.
    pub kept: qsm_kept,
    /// Triangles that were left out because they name a vertex twice.
    pub skipped_triangles: size_t,
    /// Edges taken as features: creases and marked edges, boundary edges not counted.
    pub feature_edges: size_t,
    /// Visits, over all sweeps, in which a step was shortened.
    pub moves_halved: size_t,
    /// Visits, over all sweeps, in which no step was acceptable.
    pub moves_refused: size_t,
    /// Greatest distance of a moved vertex from the original surface, and of a removed one from the triangles that took
    /// its place, in the units of the coordinates. Found by a local search, so never less than the true distance.
    pub max_deviation: f64,
    /// Where the time went.
    pub seconds: qsm_seconds,
    /// Triangles in the tail when its treatment began. This and all that follows is 0 after qsm_smooth_*.
    pub tails_before: size_t,
    /// Triangles in the tail when its treatment ended, each of them a leftover.
    pub tails_after: size_t,
    /// Triangles cured by moving vertices alone.
    pub tail_moved: size_t,
    /// Edges collapsed.
    pub collapsed: size_t,
    /// Vertices removed whose triangles were made anew without them.
    pub removed: size_t,
    /// Edges flipped to cure a triangle.
    pub flipped: size_t,
    /// Edges flipped because flips was 1.
    pub general_flips: size_t,
    /// Vertices that are no longer there.
    pub vertices_removed: size_t,
    /// Triangles that are no longer there.
    pub triangles_removed: size_t,
    /// Share of the triangles that went in which have kept their three vertices, 0 to 1.
    pub triangles_unchanged: f64,
}

impl Versioned for qsm_measurement {
    const NAME: &'static CStr = c"out";
    const FIRST_SIZE: usize = offset_of!(Self, area) + size_of::<f64>();
    const IS_OUTPUT: bool = true;
}

impl Versioned for qsm_report {
    const NAME: &'static CStr = c"report";
    const FIRST_SIZE: usize = offset_of!(Self, triangles_unchanged) + size_of::<f64>();
    const IS_OUTPUT: bool = true;
}

impl Default for qsm_measurement {
    fn default() -> Self {
        Self::from(&Measurement::default())
    }
}

impl Default for qsm_report {
    fn default() -> Self {
        Self::from(&Report::default())
    }
}

impl From<&Distribution> for qsm_distribution {
    fn from(d: &Distribution) -> Self {
        Self {
            count: d.count,
            infinite: d.infinite,
            mean: d.mean,
            variance: d.variance,
            min: d.min,
            max: d.max,
            percentiles: d.percentiles,
        }
    }
}

impl From<&Measurement> for qsm_measurement {
    fn from(m: &Measurement) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            vertices: m.vertices,
            triangles: m.triangles,
            edge_ratio: (&m.edge_ratio).into(),
            min_angle: (&m.min_angle).into(),
            max_angle: (&m.max_angle).into(),
            shape: (&m.shape).into(),
            radius_ratio: (&m.radius_ratio).into(),
            below_10: m.below_10,
            below_20: m.below_20,
            below_30: m.below_30,
            zero_area: m.zero_area,
            boundary_edges: m.boundary_edges,
            non_manifold_edges: m.non_manifold_edges,
            volume: m.volume,
            area: m.area,
        }
    }
}

impl From<&Kept> for qsm_kept {
    fn from(k: &Kept) -> Self {
        Self {
            unreferenced: k.unreferenced,
            locked: k.locked,
            non_manifold: k.non_manifold,
            degenerate: k.degenerate,
            boundary: k.boundary,
            corner: k.corner,
            guard: k.guard,
            deviation: k.deviation,
            settled: k.settled,
        }
    }
}

impl From<&Seconds> for qsm_seconds {
    fn from(s: &Seconds) -> Self {
        Self { total: s.total, adjacency: s.adjacency, features: s.features, sweeps: s.sweeps, tail: s.tail }
    }
}

impl From<&Report> for qsm_report {
    fn from(r: &Report) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            offender: QSM_NO_OFFENDER,
            offender_name: null(),
            status: QSM_OK,
            message: [0; QSM_MESSAGE_BYTES],
            before: (&r.before).into(),
            after: (&r.after).into(),
            volume_relative_change: r.volume_relative_change,
            moved: r.moved,
            kept: (&r.kept).into(),
            skipped_triangles: r.skipped_triangles,
            feature_edges: r.feature_edges,
            moves_halved: r.moves_halved,
            moves_refused: r.moves_refused,
            max_deviation: r.max_deviation,
            seconds: (&r.seconds).into(),
            tails_before: 0,
            tails_after: 0,
            tail_moved: 0,
            collapsed: 0,
            removed: 0,
            flipped: 0,
            general_flips: 0,
            vertices_removed: 0,
            triangles_removed: 0,
            triangles_unchanged: 0.0,
        }
    }
}

impl From<&TailReport> for qsm_report {
    fn from(r: &TailReport) -> Self {
        let seconds = Seconds { total: r.seconds, tail: r.seconds, ..Seconds::default() };
        Self::from(&Report { before: r.before, seconds, ..Report::default() }).with_tail(r)
    }
}

impl From<&Improvement> for qsm_report {
    fn from(improvement: &Improvement) -> Self {
        Self::from(&improvement.smoothing).with_tail(&improvement.tail)
    }
}

impl qsm_report {
    /// What the treatment of the tail did, and what the mesh is like after it.
    fn with_tail(self, tail: &TailReport) -> Self {
        Self {
            after: (&tail.after).into(),
            volume_relative_change: tail.volume_relative_change,
            max_deviation: tail.max_deviation,
            tails_before: tail.tails_before,
            tails_after: tail.tails_after,
            tail_moved: tail.moved,
            collapsed: tail.collapsed,
            removed: tail.removed,
            flipped: tail.flipped,
            general_flips: tail.general_flips,
            vertices_removed: tail.vertices_removed,
            triangles_removed: tail.triangles_removed,
            triangles_unchanged: tail.triangles_unchanged,
            ..self
        }
    }
}

impl From<&Failure> for qsm_report {
    fn from(failure: &Failure) -> Self {
        Self {
            offender: failure.offender.map_or(QSM_NO_OFFENDER, |at| at as u64),
            offender_name: failure.name.map_or(null(), CStr::as_ptr),
            status: failure.status,
            message: c_text(&failure.message),
            ..Self::default()
        }
    }
}

/// The text with a 0 behind it, cut between two characters if it is too long.
fn c_text<const N: usize>(text: &str) -> [c_char; N] {
    let end = (0..N).rev().find(|&at| text.is_char_boundary(at.min(text.len()))).unwrap_or(0);
    let mut bytes = [0; N];
    for (to, from) in bytes.iter_mut().zip(text.bytes().take(end)) {
        *to = c_char::from_ne_bytes([from]);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(text: &[c_char]) -> Vec<u8> {
        text.iter().map(|c| c.to_ne_bytes()[0]).collect()
    }

    #[test]
    fn texts_end_with_zero_and_are_cut_between_characters() {
        assert_eq!(bytes(&c_text::<6>("four")), b"four\0\0");
        assert_eq!(bytes(&c_text::<4>("four")), b"fou\0");
        assert_eq!(bytes(&c_text::<4>("ab\u{3c9}")), b"ab\0\0");
    }

    #[test]
    fn a_failure_is_told_in_full() {
        let failure = Failure { offender: Some(3), ..Failure::of(8, c"positions", "went wrong") };
        let report = qsm_report::from(&failure);
        assert_eq!((report.status, report.offender), (8, 3));
        assert_eq!(report.offender_name, c"positions".as_ptr());
        assert!(bytes(&report.message).starts_with(b"positions went wrong\0"));
    }
    #[test]
    fn an_improvement_tells_of_the_whole_call() {
        let measured = |triangles| Measurement { triangles, ..Measurement::default() };
        let smoothing =
            Report { before: measured(9), after: measured(8), moved: 5, max_deviation: 1.0, ..Report::default() };
        let tail = TailReport {
            before: measured(9),
            after: measured(7),
            moved: 2,
            max_deviation: 3.0,
            ..TailReport::default()
        };
        let report = qsm_report::from(&Improvement { smoothing, tail });
        assert_eq!((report.before.triangles, report.after.triangles), (9, 7));
        assert_eq!((report.moved, report.tail_moved, report.max_deviation), (5, 2, 3.0));
    }
}
