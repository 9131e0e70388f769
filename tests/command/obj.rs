//! OBJ keeps everything but the coordinates of moved vertices and its normals.

use crate::meshes::{changed_lines, grid, sphere};
use crate::workspace::Workspace;

#[test]
fn groups_colours_and_negative_indices_stay() {
    let mesh = grid();
    let mut text = "# made by hand\r\nmtllib a.mtl\r\no thing\r\n".to_string();
    for [x, y, z] in &mesh.points {
        text += &format!("v {x:.6} {y:.6} {z:.1} 0.5 0.25 1\r\n");
    }
    text += "vt 0 0\r\ng first\r\nusemtl red\r\ns off\r\n";
    for face in &mesh.faces {
        let corners: Vec<_> = face.iter().map(|v| format!("{}/1", i64::from(*v) - 64)).collect();
        text += &format!("f {} \\\r\n  {}\r\n", corners[..2].join(" "), corners[2..].join(" "));
    }
    let workspace = Workspace::with(&[("a.obj", text.as_bytes())]);
    let report = workspace.smooth("a.obj", "b.obj", &[]);
    assert_eq!(report["before"]["triangles"], 98);
    assert_eq!(report["before"]["boundary_edges"], 28);
    let after = workspace.text("b.obj");
    let changed = changed_lines(&text, &after);
    assert_eq!((changed.len(), report["moved"].as_u64()), (36, Some(36)));
    for line in changed {
        let line = after.split('\n').nth(line).unwrap();
        assert!(line.starts_with("v ") && line.ends_with(" 0.5 0.25 1\r"), "{line:?}");
    }
}

#[test]
fn no_sweep_no_change_even_with_normals() {
    let text = sphere().obj().replacen("f 1 ", "vn 0 0 1\nf 1//1 ", 1);
    assert!(text.contains("//1"));
    let workspace = Workspace::with(&[("a.OBJ", text.as_bytes())]);
    let run = workspace.done(&["smooth", "a.OBJ", "-o", "b.Obj", "--iterations", "0"]);
    assert_eq!(workspace.text("b.Obj"), text);
    assert_eq!(run.stderr, "");
}

#[test]
fn normals_that_belong_to_no_vertex_are_dropped_and_that_is_said() {
    let text = format!("{}vn 0 0 1\n", sphere().obj()).replacen("f 1 ", "f 1//1 ", 1);
    let workspace = Workspace::with(&[("a.obj", text.as_bytes())]);
    let run = workspace.done(&["smooth", "a.obj", "-o", "b.obj"]);
    assert!(run.stderr.contains("normals were dropped"), "{}", run.stderr);
    let after = workspace.text("b.obj");
    assert!(!after.contains("vn") && !after.contains('/'));
    let faces = |text: &str| text.lines().filter(|line| line.starts_with('f')).map(String::from).collect::<Vec<_>>();
    assert_eq!(faces(&after), faces(&sphere().obj()));
}

#[test]
fn one_normal_a_vertex_is_recomputed_and_that_is_said() {
    let mesh = sphere();
    let mut text = mesh.obj().lines().filter(|line| line.starts_with('v')).fold(String::new(), |t, l| t + l + "\n");
    text += &"vn 1 0 0\n".repeat(mesh.points.len());
    for face in &mesh.faces {
        let corners: Vec<_> = face.iter().map(|v| format!("{0}//{0}", v + 1)).collect();
        text += &format!("f {}\n", corners.join(" "));
    }
    let workspace = Workspace::with(&[("a.obj", text.as_bytes())]);
    let run = workspace.done(&["smooth", "a.obj", "-o", "b.obj"]);
    assert!(run.stderr.contains("normals were recomputed"), "{}", run.stderr);
    let after = workspace.text("b.obj");
    let vectors = |keyword: &str| {
        let numbers = |line: &str| line.split(' ').skip(1).map(|x| x.parse().unwrap()).collect::<Vec<f64>>();
        after.lines().filter(|line| line.split(' ').next() == Some(keyword)).map(numbers).collect::<Vec<_>>()
    };
    let normals = vectors("vn");
    assert_eq!(normals.len(), mesh.points.len());
    for (point, normal) in vectors("v").iter().zip(&normals) {
        let cosine = (0..3).map(|axis| point[axis] * normal[axis]).sum::<f64>() / 4.0;
        assert!(cosine > 0.9, "the normal {normal:?} at {point:?} does not point outward");
    }
}
