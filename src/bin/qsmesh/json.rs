//! The JSON objects. Numbers that are not finite become null.

use qsmesh::{Defect, Distribution, Kept, Leftover, Measurement, Reason, Report, Seconds, TailReport};
use serde::Serialize;

use crate::failure::{Failure, Result};

/// The one object of `qsmesh smooth --json`.
pub fn of_report(report: &Report) -> Result<String> {
    write(&ReportObject::from(report))
}

/// The one object of `qsmesh improve --json`: that of `qsmesh smooth` and `tail`.
pub fn of_improvement(whole: &Report, tail: &TailReport) -> Result<String> {
    write(&ImprovementObject { whole: whole.into(), tail: tail.into() })
}

/// The one object of `qsmesh measure --json`.
pub fn of_measurement(measurement: &Measurement) -> Result<String> {
    write(&MeasurementObject::from(measurement))
}

fn write(object: &impl Serialize) -> Result<String> {
    serde_json::to_string_pretty(object).map_err(|error| Failure::new(format!("JSON: {error}")))
}

#[derive(Serialize)]
struct ReportObject {
    version: &'static str,
    before: MeasurementObject,
    after: MeasurementObject,
    volume_relative_change: f64,
    max_deviation: f64,
    moved: usize,
    kept: KeptObject,
    skipped_triangles: usize,
    feature_edges: usize,
    moves_halved: usize,
    moves_refused: usize,
    seconds: SecondsObject,
}

impl From<&Report> for ReportObject {
    fn from(report: &Report) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION"),
            before: (&report.before).into(),
            after: (&report.after).into(),
            volume_relative_change: report.volume_relative_change,
            max_deviation: report.max_deviation,
            moved: report.moved,
            kept: (&report.kept).into(),
            skipped_triangles: report.skipped_triangles,
            feature_edges: report.feature_edges,
            moves_halved: report.moves_halved,
            moves_refused: report.moves_refused,
            seconds: (&report.seconds).into(),
        }
    }
}

#[derive(Serialize)]
struct ImprovementObject {
    #[serde(flatten)]
    whole: ReportObject,
    tail: TailObject,
}

#[derive(Serialize)]
struct TailObject {
    tails_before: usize,
    tails_after: usize,
    moved: usize,
    collapsed: usize,
    removed: usize,
    flipped: usize,
    general_flips: usize,
    vertices_removed: usize,
    triangles_removed: usize,
    triangles_unchanged: f64,
    leftovers: Vec<LeftoverObject>,
}

impl From<&TailReport> for TailObject {
    fn from(tail: &TailReport) -> Self {
        Self {
            tails_before: tail.tails_before,
            tails_after: tail.tails_after,
            moved: tail.moved,
            collapsed: tail.collapsed,
            removed: tail.removed,
            flipped: tail.flipped,
            general_flips: tail.general_flips,
            vertices_removed: tail.vertices_removed,
            triangles_removed: tail.triangles_removed,
            triangles_unchanged: tail.triangles_unchanged,
            leftovers: tail.leftovers.iter().map(LeftoverObject::from).collect(),
        }
    }
}

#[derive(Serialize)]
struct LeftoverObject {
    triangle: u32,
    defect: &'static str,
    reason: &'static str,
}

impl From<&Leftover> for LeftoverObject {
    fn from(leftover: &Leftover) -> Self {
        let defect = match leftover.defect {
            Defect::Degenerate => "degenerate",
            Defect::Needle => "needle",
            Defect::Cap => "cap",
            Defect::SmallAngle => "small_angle",
        };
        let reason = match leftover.reason {
            Reason::Feature => "feature",
            Reason::Locked => "locked",
            Reason::Boundary => "boundary",
            Reason::Topology => "topology",
            Reason::Deviation => "deviation",
            Reason::Fold => "fold",
            Reason::NoGain => "no_gain",
        };
        Self { triangle: leftover.triangle, defect, reason }
    }
}

#[derive(Serialize)]
struct MeasurementObject {
    vertices: usize,
    triangles: usize,
    edge_ratio: DistributionObject,
    min_angle: DistributionObject,
    max_angle: DistributionObject,
    shape: DistributionObject,
    radius_ratio: DistributionObject,
    below_10: usize,
    below_20: usize,
    below_30: usize,
    zero_area: usize,
    boundary_edges: usize,
    non_manifold_edges: usize,
    volume: f64,
    area: f64,
}

impl From<&Measurement> for MeasurementObject {
    fn from(m: &Measurement) -> Self {
        Self {
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

#[derive(Serialize)]
struct DistributionObject {
    mean: f64,
    variance: f64,
    min: f64,
    max: f64,
    infinite: usize,
    percentiles: PercentilesObject,
}

/// One key for each of the library's percentile levels.
#[derive(Serialize)]
struct PercentilesObject {
    p1: f64,
    p5: f64,
    p25: f64,
    p50: f64,
    p75: f64,
    p95: f64,
    p99: f64,
}

impl From<&Distribution> for DistributionObject {
    fn from(d: &Distribution) -> Self {
        let [p1, p5, p25, p50, p75, p95, p99] = d.percentiles;
        let percentiles = PercentilesObject { p1, p5, p25, p50, p75, p95, p99 };
        Self { mean: d.mean, variance: d.variance, min: d.min, max: d.max, infinite: d.infinite, percentiles }
    }
}

#[derive(Serialize)]
struct KeptObject {
    unreferenced: usize,
    locked: usize,
    non_manifold: usize,
    degenerate: usize,
    boundary: usize,
    corner: usize,
    guard: usize,
    deviation: usize,
    settled: usize,
}

impl From<&Kept> for KeptObject {
    fn from(kept: &Kept) -> Self {
        Self {
            unreferenced: kept.unreferenced,
            locked: kept.locked,
            non_manifold: kept.non_manifold,
            degenerate: kept.degenerate,
            boundary: kept.boundary,
            corner: kept.corner,
            guard: kept.guard,
            deviation: kept.deviation,
            settled: kept.settled,
        }
    }
}

#[derive(Serialize)]
struct SecondsObject {
    total: f64,
    adjacency: f64,
    features: f64,
    sweeps: f64,
    tail: f64,
}

impl From<&Seconds> for SecondsObject {
    fn from(s: &Seconds) -> Self {
        Self { total: s.total, adjacency: s.adjacency, features: s.features, sweeps: s.sweeps, tail: s.tail }
    }
}

#[cfg(test)]
mod tests {
    use qsmesh::{Measurement, Report};

    #[test]
    fn what_is_not_finite_becomes_null() {
        let measurement = Measurement { volume: f64::NAN, area: f64::INFINITY, ..Measurement::default() };
        let text = super::of_measurement(&measurement).unwrap();
        let object: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert!(object["volume"].is_null() && object["area"].is_null());
        assert_eq!(object["edge_ratio"]["percentiles"]["p99"], 0.0);
    }

    #[test]
    fn the_levels_are_those_of_the_keys() {
        assert_eq!(qsmesh::quality::PERCENTILE_LEVELS, [1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0]);
        assert!(super::of_report(&Report::default()).unwrap().contains("\"p25\""));
    }
}
