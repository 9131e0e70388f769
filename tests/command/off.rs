//! OFF keeps everything but the coordinates of moved vertices.

use crate::meshes::{changed_lines, grid, sphere};
use crate::workspace::Workspace;

#[test]
fn no_sweep_no_change() {
    let text = sphere().off();
    let workspace = Workspace::with(&[("a.off", text.as_bytes())]);
    assert_eq!(workspace.smooth("a.off", "b.off", &["--iterations", "0"])["moved"], 0);
    assert_eq!(workspace.text("b.off"), text);
}

#[test]
fn colours_comments_and_resting_vertices_stay() {
    let mesh = grid();
    let mut text = "# first\nCOFF # kind\n64 49 0\n\n".to_string();
    for (number, [x, y, _]) in mesh.points.iter().enumerate() {
        text += &format!("  {x:.6e}\t{y:.6e} 0 {number} 1 2 255 # vertex {number}\n");
    }
    for (number, face) in mesh.faces.iter().enumerate() {
        text += &format!("4 {} {} {} {} {number} 0 0\n", face[0], face[1], face[2], face[3]);
    }
    text += "# last";
    let workspace = Workspace::with(&[("a.off", text.as_bytes())]);
    let report = workspace.smooth("a.off", "b.off", &[]);
    let after = workspace.text("b.off");
    let changed = changed_lines(&text, &after);
    assert_eq!(report["moved"].as_u64().unwrap() as usize, changed.len());
    assert_eq!(changed.len(), 36, "every inner vertex moves");
    for line in changed {
        let number = line - 4;
        assert!(number % 8 != 0 && number % 8 != 7 && number / 8 != 0 && number / 8 != 7, "a boundary vertex moved");
        let line = after.split('\n').nth(line).unwrap();
        assert!(line.ends_with(&format!(" {number} 1 2 255 # vertex {number}")), "{line}");
    }
}

#[test]
fn sliding_moves_the_boundary_but_not_its_corners() {
    let mut mesh = grid();
    mesh.points[3][0] += 0.4;
    let workspace = Workspace::with(&[("a.off", mesh.off().as_bytes())]);
    workspace.smooth("a.off", "b.off", &["--boundary", "slide"]);
    let changed = changed_lines(&mesh.off(), &workspace.text("b.off"));
    assert!(changed.contains(&5), "vertex 3 should have slid");
    for corner in [0, 7, 56, 63] {
        assert!(!changed.contains(&(corner + 2)), "corner {corner} moved");
    }
}

#[test]
fn faces_with_two_corners_stay_in_the_file() {
    let text = sphere().off().replacen("258 512 0", "258 513 0", 1) + "2 0 1\n";
    let workspace = Workspace::with(&[("a.off", text.as_bytes())]);
    let report = workspace.smooth("a.off", "b.off", &[]);
    assert_eq!(report["after"]["triangles"], 512);
    assert!(workspace.text("b.off").ends_with("2 0 1\n"));
}

#[test]
fn the_file_may_replace_itself() {
    let text = sphere().off();
    let workspace = Workspace::with(&[("a.off", text.as_bytes()), ("b.off", text.as_bytes())]);
    workspace.smooth("a.off", "a.off", &[]);
    workspace.smooth("b.off", "c.off", &[]);
    assert_eq!(workspace.text("a.off"), workspace.text("c.off"));
    assert_ne!(workspace.text("a.off"), text);
    assert_eq!(workspace.names(), ["a.off", "b.off", "c.off"]);
}

#[test]
fn what_is_written_is_what_was_reported() {
    let workspace = Workspace::with(&[("a.off", sphere().off().as_bytes())]);
    let report = workspace.smooth("a.off", "b.off", &[]);
    let measured = workspace.done(&["measure", "b.off", "--json"]).stdout;
    assert_eq!(serde_json::from_str::<serde_json::Value>(&measured).unwrap(), report["after"]);
}

#[test]
fn an_empty_mesh_gives_a_result() {
    let workspace = Workspace::with(&[("a.off", b"OFF\n0 0 0\n"), ("b.off", b"OFF\n1 0 0\n1 2 3\n")]);
    assert_eq!(workspace.smooth("a.off", "c.off", &[])["after"]["vertices"], 0);
    assert_eq!(workspace.smooth("b.off", "d.off", &[])["kept"]["unreferenced"], 1);
    assert_eq!(workspace.bytes("d.off"), workspace.bytes("b.off"));
}
