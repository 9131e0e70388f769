//! The demonstration.

use std::fs;

use crate::workspace::Workspace;

#[test]
fn bad_triangles_in_better_ones_out() {
    let workspace = Workspace::new();
    fs::create_dir(workspace.path("folder")).unwrap();
    let run = workspace.done(&["demo", "-o", "folder"]);
    assert!(run.stdout.contains("before") && run.stdout.contains("smallest angle, least"), "{}", run.stdout);
    let measured = |name: &str| {
        let text = workspace.done(&["measure", name, "--json"]).stdout;
        serde_json::from_str::<serde_json::Value>(&text).unwrap()
    };
    let (before, after) = (measured("folder/demo_before.ply"), measured("folder/demo_after.ply"));
    let count = |side: &serde_json::Value, key: &str| side[key].as_u64().unwrap();
    assert!((20_000..60_000).contains(&count(&before, "triangles")));
    assert_eq!(count(&before, "triangles"), count(&after, "triangles"));
    assert!(count(&before, "below_20") > 2000);
    assert!(count(&after, "below_20") < count(&before, "below_20") / 4);
    assert_eq!((count(&before, "boundary_edges"), count(&before, "non_manifold_edges")), (0, 0));
    let change = after["volume"].as_f64().unwrap() / before["volume"].as_f64().unwrap() - 1.0;
    assert!(change.abs() < 1e-9, "the volume changed by {change}");
}

#[test]
fn the_folder_must_exist() {
    let message = Workspace::new().refused(&["demo", "-o", "missing"]);
    assert!(message.contains("missing does not exist"), "{message}");
}
