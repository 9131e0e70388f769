//! The tables for people.

use comfy_table::{CellAlignment, Table, presets};
use qsmesh::{Kept, Measurement, Reason, Report, TailReport};

/// Before and after, then what was done.
pub fn of_report(report: &Report) -> String {
    before_and_after(report).trim_fmt()
}

/// The same, with the treatment of the tail.
pub fn of_improvement(whole: &Report, tail: &TailReport) -> String {
    let mut table = before_and_after(whole);
    table.add_row(["triangles in the tail".to_string(), tail.tails_before.to_string(), tail.tails_after.to_string()]);
    for (what, count) in operations(tail) {
        table.add_row([what.to_string(), String::new(), count.to_string()]);
    }
    let unchanged = format!("{:.3} %", 100.0 * tail.triangles_unchanged);
    table.add_row(["triangles unchanged".to_string(), String::new(), unchanged]);
    for (reason, name) in REASONS {
        let count = tail.leftovers.iter().filter(|leftover| leftover.reason == reason).count();
        if count > 0 {
            table.add_row([format!("tail left: {name}"), String::new(), count.to_string()]);
        }
    }
    table.trim_fmt()
}

fn before_and_after(report: &Report) -> Table {
    let mut table = new_table(&["", "before", "after"]);
    for (name, value) in rows() {
        table.add_row([name.to_string(), value(&report.before), value(&report.after)]);
    }
    let change = if report.before.boundary_edges == 0 {
        format!("{:+.1e}", report.volume_relative_change)
    } else {
        "not closed".to_string()
    };
    table.add_row(["volume, relative change".to_string(), String::new(), change]);
    table.add_row(["largest deviation".to_string(), String::new(), number(report.max_deviation)]);
    table.add_row(["vertices moved".to_string(), String::new(), report.moved.to_string()]);
    for (reason, count) in reasons(&report.kept).into_iter().filter(|(_, count)| *count > 0) {
        table.add_row([format!("vertices kept: {reason}"), String::new(), count.to_string()]);
    }
    table
}

/// One column of figures.
pub fn of_measurement(measurement: &Measurement) -> String {
    let mut table = new_table(&["", "value"]);
    for (name, value) in rows() {
        table.add_row([name.to_string(), value(measurement)]);
    }
    table.trim_fmt()
}

fn new_table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header(header.to_vec());
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

type Figure = (&'static str, fn(&Measurement) -> String);

fn rows() -> [Figure; 17] {
    [
        ("vertices", |m| m.vertices.to_string()),
        ("triangles", |m| m.triangles.to_string()),
        ("edge ratio, mean", |m| format!("{:.4}", m.edge_ratio.mean)),
        ("edge ratio, variance", |m| format!("{:.4}", m.edge_ratio.variance)),
        ("edge ratio, greatest", greatest_edge_ratio),
        ("smallest angle, least", |m| format!("{:.2}°", m.min_angle.min)),
        ("smallest angle, mean", |m| format!("{:.2}°", m.min_angle.mean)),
        ("largest angle, greatest", |m| format!("{:.2}°", m.max_angle.max)),
        ("shape, mean", |m| format!("{:.4}", m.shape.mean)),
        ("triangles below 10°", |m| m.below_10.to_string()),
        ("triangles below 20°", |m| m.below_20.to_string()),
        ("triangles below 30°", |m| m.below_30.to_string()),
        ("triangles without area", |m| m.zero_area.to_string()),
        ("boundary edges", |m| m.boundary_edges.to_string()),
        ("non-manifold edges", |m| m.non_manifold_edges.to_string()),
        ("volume", |m| number(m.volume)),
        ("area", |m| number(m.area)),
    ]
}

fn greatest_edge_ratio(m: &Measurement) -> String {
    if m.edge_ratio.infinite > 0 { "infinite".to_string() } else { number(m.edge_ratio.max) }
}

/// Six or seven digits, with an exponent where it is needed.
fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_string(),
        1e-3..1e6 => {
            let whole = value.abs().log10().floor() as i32;
            format!("{value:.*}", usize::try_from(5 - whole).unwrap_or(0))
        }
        _ => format!("{value:.5e}"),
    }
}

fn operations(tail: &TailReport) -> [(&'static str, usize); 7] {
    [
        ("tail cured by moves", tail.moved),
        ("tail cured by collapses", tail.collapsed),
        ("tail cured by removals", tail.removed),
        ("tail cured by flips", tail.flipped),
        ("other flips", tail.general_flips),
        ("vertices removed", tail.vertices_removed),
        ("triangles removed", tail.triangles_removed),
    ]
}

const REASONS: [(Reason, &str); 7] = [
    (Reason::Feature, "feature"),
    (Reason::Locked, "locked"),
    (Reason::Boundary, "boundary"),
    (Reason::Topology, "topology"),
    (Reason::Deviation, "deviation bound"),
    (Reason::Fold, "fold"),
    (Reason::NoGain, "no gain"),
];

fn reasons(kept: &Kept) -> [(&'static str, usize); 9] {
    [
        ("in no triangle", kept.unreferenced),
        ("locked", kept.locked),
        ("non-manifold", kept.non_manifold),
        ("star without area", kept.degenerate),
        ("boundary", kept.boundary),
        ("corner", kept.corner),
        ("quality guard", kept.guard),
        ("deviation bound", kept.deviation),
        ("already in place", kept.settled),
    ]
}

#[cfg(test)]
mod tests {
    use qsmesh::{Defect, Kept, Leftover, Reason, Report, TailReport};

    use super::{number, of_improvement, of_report};

    #[test]
    fn numbers_have_six_digits() {
        assert_eq!(number(0.0), "0");
        assert_eq!(number(-0.001), "-0.00100000");
        assert_eq!(number(123456.7), "123457");
        assert_eq!(number(1e6), "1.00000e6");
        assert_eq!(number(f64::NAN), "NaN");
    }

    #[test]
    fn only_reasons_that_occurred_are_listed() {
        let report = Report { kept: Kept { boundary: 12, ..Kept::default() }, ..Report::default() };
        let text = of_report(&report);
        assert!(text.contains("kept: boundary") && !text.contains("kept: corner"), "{text}");
    }

    #[test]
    fn leftovers_are_counted_by_reason() {
        let leftover = |reason| Leftover { triangle: 0, defect: Defect::Cap, reason };
        let leftovers = [Reason::Fold, Reason::Boundary, Reason::Fold].map(leftover).to_vec();
        let text = of_improvement(&Report::default(), &TailReport { leftovers, ..TailReport::default() });
        let count = |name: &str| text.lines().find(|line| line.contains(name)).map(|line| line.contains(" 2 │"));
        assert_eq!(["left: fold", "left: boundary", "left: locked"].map(count), [Some(true), Some(false), None]);
    }
}
