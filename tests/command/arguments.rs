//! The command line itself.

use crate::meshes::sphere;
use crate::workspace::Workspace;

#[test]
fn the_version_is_that_of_the_package() {
    let run = Workspace::new().done(&["--version"]);
    assert_eq!(run.stdout, format!("qsmesh {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn help_gives_ranges_and_defaults() {
    let method = [
        ("--iterations", "2"),
        ("--relaxation", "1.2"),
        ("--plane", "vector-area"),
        ("--ideal", "modelled"),
        ("--feature-angle", "30"),
        ("--boundary", "fixed"),
        ("--order", "colors"),
        ("--threads", "0"),
        ("--interval-width", "0.5"),
        ("--sample-limit", "3"),
        ("--quality-floor", "0.5"),
    ];
    let tail =
        [("--tail-edge-ratio", "3"), ("--tail-min-angle", "20"), ("--tail-max-angle", "130"), ("--tail-attempts", "3")];
    let workspace = Workspace::new();
    let help = |subcommand| workspace.done(&[subcommand, "--help"]).stdout;
    assert_help(&help("smooth"), &method);
    assert_help(&help("improve"), &[&method[..], &tail].concat());
    assert_help(&help("collapse-tails"), &[&method[1..], &tail].concat());
    assert!(!help("collapse-tails").contains("--iterations"));
    assert!(help("improve").contains("--flips") && help("improve").contains("--keep-tails"));
}

fn assert_help(help: &str, options: &[(&str, &str)]) {
    for (option, default) in options {
        let (_, rest) = help.split_once(&format!("\n      {option} ")).unwrap_or_else(|| panic!("{option} is missing"));
        let text = rest.split("\n      --").next().unwrap();
        assert!(text.contains(&format!("[default: {default}]")), "{option}: {text}");
        assert!(text.contains("Range") || text.contains("Possible values"), "{option}: {text}");
    }
    for option in ["--max-deviation", "--json", "--quiet", "--plot <FILE>", "--quality-colors[=<STATE>]"] {
        assert!(help.contains(option), "{option} is missing");
    }
}

#[test]
fn wrong_usage_is_told_apart() {
    let workspace = Workspace::with(&[("a.off", sphere().off().as_bytes())]);
    for (option, value) in [
        ("--relaxation", "2.5"),
        ("--relaxation", "-1"),
        ("--iterations", "10001"),
        ("--feature-angle", "180"),
        ("--feature-angle", "on"),
        ("--interval-width", "0"),
        ("--sample-limit", "nan"),
        ("--quality-floor", "1.5"),
        ("--max-deviation", "-1%"),
        ("--plane", "flat"),
        ("--order", "random"),
        ("--threads", "1025"),
    ] {
        let run = workspace.run(&["smooth", "a.off", "-o", "b.off", option, value]);
        assert_eq!(run.code, 2, "{option} {value}: {}", run.stderr);
        assert!(run.stderr.contains(option), "{option} {value}: {}", run.stderr);
    }
    assert_eq!(workspace.run(&["smooth", "a.off"]).code, 2);
    assert_eq!(workspace.run(&[]).code, 2);
    assert_eq!(workspace.names(), ["a.off"]);
}

#[test]
fn wrong_usage_of_the_tail_is_told_apart() {
    let workspace = Workspace::with(&[("a.off", sphere().off().as_bytes())]);
    for (option, value) in [
        ("--tail-edge-ratio", "1"),
        ("--tail-min-angle", "60"),
        ("--tail-min-angle", "-5"),
        ("--tail-max-angle", "180"),
        ("--tail-attempts", "0"),
        ("--relaxation", "2.5"),
    ] {
        for subcommand in ["improve", "collapse-tails"] {
            let run = workspace.run(&[subcommand, "a.off", "-o", "b.off", option, value]);
            assert_eq!(run.code, 2, "{option} {value}: {}", run.stderr);
            assert!(run.stderr.contains(option) && run.stderr.contains(subcommand), "{option} {value}: {}", run.stderr);
        }
    }
    // Settings of what is left out.
    assert_eq!(workspace.run(&["improve", "a.off", "-o", "b.off", "--keep-tails", "--flips"]).code, 2);
    assert_eq!(workspace.names(), ["a.off"]);
}

#[test]
fn the_distance_may_be_a_share_of_the_diagonal() {
    let workspace = Workspace::with(&[("a.off", sphere().off().as_bytes())]);
    let free = workspace.smooth("a.off", "b.off", &[])["max_deviation"].as_f64().unwrap();
    // The box around the sphere has sides of about 8.
    let bound = 0.0004 * 8.0 * 3.0_f64.sqrt();
    assert!(free > 2.0 * bound, "unbounded: {free}");
    let report = workspace.smooth("a.off", "c.off", &["--max-deviation", "0.04%"]);
    let bounded = report["max_deviation"].as_f64().unwrap();
    assert!(bounded > 0.0 && bounded < 1.1 * bound, "bounded: {bounded}");
    let still = workspace.smooth("a.off", "d.off", &["--max-deviation", "0"]);
    assert!(still["max_deviation"].as_f64().unwrap() < 1e-12);
}
