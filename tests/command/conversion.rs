//! From one format to another: positions and faces, and a word on what stays behind.

use crate::meshes::{grid, sphere};
use crate::workspace::Workspace;

fn measured(workspace: &Workspace, name: &str) -> serde_json::Value {
    serde_json::from_str(&workspace.done(&["measure", name, "--json"]).stdout).unwrap()
}

#[test]
fn every_format_holds_the_same_mesh() {
    let workspace = Workspace::with(&[("a.off", sphere().off().as_bytes())]);
    let report = workspace.smooth("a.off", "b.off", &[]);
    for name in ["b.obj", "b.ply"] {
        workspace.smooth("a.off", name, &[]);
        assert_eq!(measured(&workspace, name), report["after"], "{name}");
    }
    // Through a chain of formats nothing is lost either.
    workspace.done(&["smooth", "b.ply", "-o", "c.obj", "--iterations", "0"]);
    workspace.done(&["smooth", "c.obj", "-o", "c.off", "--iterations", "0"]);
    assert_eq!(measured(&workspace, "c.off"), report["after"]);
    // STL holds 32 bits, so the work is done in 32 bits and the report is about what was written.
    let report = workspace.smooth("a.off", "b.stl", &[]);
    let written = measured(&workspace, "b.stl");
    for key in ["triangles", "vertices", "below_20", "boundary_edges"] {
        assert_eq!(written[key], report["after"][key], "{key}");
    }
    let (found, told) = (written["volume"].as_f64().unwrap(), report["after"]["volume"].as_f64().unwrap());
    assert!((found / told - 1.0).abs() < 1e-12, "volume {found} against {told}");
}

#[test]
fn coordinates_of_32_bits_keep_their_value_as_text() {
    let workspace = Workspace::with(&[("a.off", sphere().off().as_bytes())]);
    workspace.done(&["smooth", "a.off", "-o", "a.stl"]);
    workspace.done(&["smooth", "a.stl", "-o", "b.ply", "--iterations", "0"]);
    workspace.done(&["smooth", "b.ply", "-o", "b.obj", "--iterations", "0"]);
    for line in workspace.text("b.obj").lines().filter(|line| line.starts_with("v ")) {
        for number in line.split(' ').skip(1) {
            let value: f64 = number.parse().unwrap();
            assert_eq!(value, f64::from(value as f32), "{number} is no 32-bit number");
        }
    }
    assert_eq!(measured(&workspace, "b.obj")["volume"], measured(&workspace, "b.ply")["volume"]);
}

#[test]
fn polygons_stay_polygons() {
    let workspace = Workspace::with(&[("a.off", grid().off().as_bytes())]);
    let run = workspace.done(&["smooth", "a.off", "-o", "b.obj", "--iterations", "0"]);
    assert_eq!(run.stderr, "");
    let faces = |text: &str| text.lines().filter(|line| line.starts_with('f')).map(String::from).collect::<Vec<_>>();
    assert_eq!(faces(&workspace.text("b.obj")), faces(&grid().obj()));
    workspace.done(&["smooth", "b.obj", "-o", "b.ply", "--iterations", "0"]);
    workspace.done(&["smooth", "b.ply", "-o", "c.obj", "--iterations", "0"]);
    assert_eq!(workspace.text("c.obj"), workspace.text("b.obj"));
    let run = workspace.done(&["smooth", "b.obj", "-o", "b.stl"]);
    assert!(run.stderr.contains("polygons"), "{}", run.stderr);
}

#[test]
fn what_stays_behind_is_named() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        property uchar red\nelement face 1\nproperty list uchar int vertex_indices\nelement camera 1\n\
        property int a\nend_header\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n5\n";
    let obj = "g one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n";
    let off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n";
    let workspace = Workspace::with(&[("p.ply", ply.as_bytes()), ("o.obj", obj.as_bytes()), ("f.off", off.as_bytes())]);
    let told = |from: &str, to: &str| workspace.done(&["smooth", from, "-o", to]).stderr;
    let note = told("p.ply", "1.obj");
    assert!(
        note.contains("vertex red") && note.contains("element camera") && !note.contains("vertex_indices"),
        "{note}"
    );
    let note = told("o.obj", "2.off");
    assert!(note.contains("texture") && note.contains("normals") && note.contains("groups"), "{note}");
    assert!(told("f.off", "3.ply").contains("colours"));
    assert_eq!(told("1.obj", "4.off"), "");
}

#[test]
fn an_empty_mesh_stays_readable() {
    let workspace = Workspace::with(&[("a.off", b"OFF\n0 0 0\n")]);
    for name in ["b.ply", "b.obj", "b.off", "b.stl"] {
        workspace.done(&["smooth", "a.off", "-o", name]);
        assert_eq!(measured(&workspace, name)["vertices"], 0, "{name}");
    }
}

#[test]
fn coordinates_too_large_for_stl_are_named() {
    let workspace = Workspace::with(&[("a.off", b"OFF\n3 1 0\n0 0 0\n1e300 0 0\n0 1 0\n3 0 1 2\n")]);
    let message = workspace.refused(&["smooth", "a.off", "-o", "b.stl"]);
    assert!(message.contains("line 4: vertex 1") && message.contains("too large for 32 bits"), "{message}");
    workspace.done(&["smooth", "a.off", "-o", "b.ply"]);
}
