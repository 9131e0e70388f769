//! What the command says on stdout and stderr.

use std::process::Stdio;

use crate::meshes::{grid, sphere, torus};
use crate::workspace::Workspace;

const MEASUREMENT: [&str; 15] = [
    "vertices",
    "triangles",
    "edge_ratio",
    "min_angle",
    "max_angle",
    "shape",
    "radius_ratio",
    "below_10",
    "below_20",
    "below_30",
    "zero_area",
    "boundary_edges",
    "non_manifold_edges",
    "volume",
    "area",
];
const REPORT: [&str; 12] = [
    "version",
    "before",
    "after",
    "volume_relative_change",
    "max_deviation",
    "moved",
    "kept",
    "skipped_triangles",
    "feature_edges",
    "moves_halved",
    "moves_refused",
    "seconds",
];
const TAIL: [&str; 11] = [
    "tails_before",
    "tails_after",
    "moved",
    "collapsed",
    "removed",
    "flipped",
    "general_flips",
    "vertices_removed",
    "triangles_removed",
    "triangles_unchanged",
    "leftovers",
];
const DISTRIBUTION: [&str; 6] = ["mean", "variance", "min", "max", "infinite", "percentiles"];
const LEVELS: [&str; 7] = ["p1", "p5", "p25", "p50", "p75", "p95", "p99"];
const KEPT: [&str; 9] =
    ["unreferenced", "locked", "non_manifold", "degenerate", "boundary", "corner", "guard", "deviation", "settled"];
const SECONDS: [&str; 5] = ["total", "adjacency", "features", "sweeps", "tail"];

fn assert_keys(object: &serde_json::Value, expected: &[&str]) {
    let mut keys: Vec<_> = object.as_object().unwrap().keys().map(String::as_str).collect();
    let mut expected = expected.to_vec();
    keys.sort_unstable();
    expected.sort_unstable();
    assert_eq!(keys, expected);
}

#[test]
fn the_json_object_has_all_keys() {
    let workspace = Workspace::with(&[("a.off", grid().off().as_bytes())]);
    let report = workspace.smooth("a.off", "b.off", &[]);
    assert_keys(&report, &REPORT);
    assert_keys(&report["kept"], &KEPT);
    assert_keys(&report["seconds"], &SECONDS);
    for side in ["before", "after"] {
        assert_keys(&report[side], &MEASUREMENT);
        for parameter in ["edge_ratio", "min_angle", "max_angle", "shape", "radius_ratio"] {
            assert_keys(&report[side][parameter], &DISTRIBUTION);
            assert_keys(&report[side][parameter]["percentiles"], &LEVELS);
        }
    }
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"));
    let kept: u64 = KEPT.iter().map(|reason| report["kept"][reason].as_u64().unwrap()).sum();
    assert_eq!(kept + report["moved"].as_u64().unwrap(), 64);
}

#[test]
fn the_table_shows_before_and_after() {
    let workspace = Workspace::with(&[("a.off", grid().off().as_bytes())]);
    let table = workspace.done(&["smooth", "a.off", "-o", "b.off"]).stdout;
    let rows = [
        "edge ratio, mean",
        "edge ratio, variance",
        "edge ratio, greatest",
        "smallest angle, least",
        "smallest angle, mean",
        "largest angle, greatest",
        "triangles below 10°",
        "triangles below 20°",
        "triangles below 30°",
        "volume",
        "volume, relative change",
        "area",
        "largest deviation",
        "vertices moved",
        "vertices kept: boundary",
    ];
    for row in rows {
        assert!(table.lines().any(|line| line.starts_with(&format!("│ {row} "))), "{row} is missing:\n{table}");
    }
    assert!(!table.contains("kept: locked"), "nothing was locked:\n{table}");
    let measured = workspace.done(&["measure", "a.off"]).stdout;
    let triangles = measured.lines().find(|line| line.starts_with("│ triangles ")).unwrap();
    assert!(triangles.ends_with(" 98 │"), "{triangles}");
}

#[test]
fn the_tail_is_part_of_json_and_table() {
    let workspace = Workspace::with(&[("a.off", torus().off().as_bytes())]);
    let harsh = ["--tail-min-angle", "35", "--tail-max-angle", "105", "--feature-angle", "off"];
    for subcommand in ["improve", "collapse-tails"] {
        let report = workspace.report(subcommand, "a.off", "b.off", &harsh);
        assert_keys(&report, &[&REPORT[..], &["tail"]].concat());
        assert_keys(&report["tail"], &TAIL);
        let count = |key: &str| report["tail"][key].as_u64().unwrap();
        let leftovers = report["tail"]["leftovers"].as_array().unwrap();
        assert_eq!(leftovers.len() as u64, count("tails_after"));
        assert!(count("tails_after") < count("tails_before") / 2, "{subcommand}: {report}");
        leftovers.iter().for_each(|leftover| assert_keys(leftover, &["triangle", "defect", "reason"]));
        let removed = |key: &str| report["before"][key].as_u64().unwrap() - report["after"][key].as_u64().unwrap();
        assert_eq!(removed("vertices"), count("vertices_removed"));
        assert_eq!(removed("triangles"), count("triangles_removed"));
        assert!(count("vertices_removed") > 0);
        assert!(report["volume_relative_change"].as_f64().unwrap().abs() < 1e-12);
        assert!(report["max_deviation"].as_f64().unwrap() > 0.0 && report["seconds"]["tail"].as_f64().unwrap() > 0.0);
        let measured = workspace.done(&["measure", "b.off", "--json"]).stdout;
        let measured: serde_json::Value = serde_json::from_str(&measured).unwrap();
        for key in ["vertices", "triangles", "below_30", "min_angle", "boundary_edges"] {
            let (found, told) = (&measured[key], &report["after"][key]);
            assert_eq!(found["min"], told["min"], "{key}");
            assert!(found == told || found.is_object(), "{key}: {found} {told}");
        }
        let table = workspace.done(&[&[subcommand, "a.off", "-o", "b.off"], &harsh[..]].concat()).stdout;
        let row = |name: &str, figure: u64| {
            let line = table.lines().find(|line| line.starts_with(&format!("│ {name} ")));
            line.is_some_and(|line| line.ends_with(&format!(" {figure} │")))
        };
        assert!(row("triangles in the tail", count("tails_after")), "{table}");
        assert!(row("vertices removed", count("vertices_removed")), "{table}");
        assert!(row("tail cured by collapses", count("collapsed")), "{table}");
    }
    assert!(workspace.smooth("a.off", "b.off", &[]).get("tail").is_none());
}

#[test]
fn quiet_says_nothing_but_does_the_work() {
    let text = format!("{}vn 0 0 1\n", sphere().obj());
    let workspace = Workspace::with(&[("a.obj", text.as_bytes())]);
    let run = workspace.done(&["smooth", "a.obj", "-o", "b.obj", "--quiet"]);
    assert_eq!((run.stdout.as_str(), run.stderr.as_str()), ("", ""));
    assert_ne!(workspace.text("b.obj"), text);
    assert!(workspace.done(&["smooth", "a.obj", "-o", "b.obj", "-q", "--json"]).stdout.starts_with('{'));
}

#[test]
fn a_reader_that_left_is_no_failure() {
    let workspace = Workspace::with(&[("a.off", sphere().off().as_bytes())]);
    for arguments in [&["measure", "a.off"][..], &["smooth", "a.off", "-o", "b.off", "--json"][..]] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = workspace.command(arguments).stdout(Stdio::from(writer)).output().unwrap();
        assert_eq!((output.status.code(), String::from_utf8(output.stderr).unwrap().as_str()), (Some(0), ""));
    }
    assert!(workspace.path("b.off").exists());
}
