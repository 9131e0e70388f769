//! Quality and colours of the triangles in PLY; an independent reader checks them.

use std::io::Cursor;

use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Ply, Property};

use crate::meshes::{Mesh, grid, sphere, torus};
use crate::workspace::Workspace;

fn parsed(bytes: &[u8]) -> Ply<DefaultElement> {
    Parser::new().read_ply(&mut Cursor::new(bytes)).unwrap()
}

/// A number of a row, of whatever type.
fn number(row: &DefaultElement, name: &str) -> f64 {
    match row[name] {
        Property::Float(x) => f64::from(x),
        Property::Double(x) => x,
        Property::UChar(x) => f64::from(x),
        ref other => panic!("{name} is {other:?}"),
    }
}

fn point(row: &DefaultElement) -> [f64; 3] {
    ["x", "y", "z"].map(|axis| number(row, axis))
}

fn corners(row: &DefaultElement) -> Vec<usize> {
    match &row["vertex_indices"] {
        Property::ListUInt(list) => list.iter().map(|&v| v as usize).collect(),
        Property::ListInt(list) => list.iter().map(|&v| v as usize).collect(),
        other => panic!("{other:?}"),
    }
}

/// Mean ratio of a triangle.
fn shape(points: [[f64; 3]; 3]) -> f64 {
    let edge = |i: usize, j: usize| [0, 1, 2].map(|axis| points[j][axis] - points[i][axis]);
    let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let (u, v, w) = (edge(0, 1), edge(0, 2), edge(1, 2));
    let area = 0.5 * (dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v)).sqrt();
    4.0 * 3.0_f64.sqrt() * area / (dot(u, u) + dot(v, v) + dot(w, w))
}

/// Worst shape of a fan of triangles around its first corner.
fn worst(points: &[[f64; 3]], corners: &[usize]) -> f64 {
    let fan = corners[1..].windows(2).map(|edge| shape([corners[0], edge[0], edge[1]].map(|v| points[v])));
    fan.fold(1.0, f64::min)
}

/// The faces have these qualities, the vertices the worst around them, and the colours rise with them.
fn assert_painted(ply: &Ply<DefaultElement>, expected: &[f64]) {
    let rows = &ply.payload["face"];
    assert_eq!(rows.len(), expected.len());
    let mut around = vec![1.0_f64; ply.payload["vertex"].len()];
    for (row, &expected) in rows.iter().zip(expected) {
        let found = number(row, "quality");
        assert!((found - expected).abs() < 1e-5, "{found} is not {expected}");
        corners(row).into_iter().for_each(|v| around[v] = around[v].min(found));
    }
    for (row, expected) in ply.payload["vertex"].iter().zip(around) {
        assert!((number(row, "quality") - expected).abs() < 1e-5);
    }
    let light = |row: &DefaultElement| {
        let linear = |name: &str| (number(row, name) / 255.0).powf(2.2);
        0.2126 * linear("red") + 0.7152 * linear("green") + 0.0722 * linear("blue")
    };
    let mut pairs: Vec<_> =
        rows.iter().chain(&ply.payload["vertex"]).map(|r| (number(r, "quality"), light(r))).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(pairs.windows(2).all(|pair| pair[0].1 <= pair[1].1 + 0.01), "colours do not rise with quality");
    assert!(pairs[0].1 + 0.2 < pairs[pairs.len() - 1].1, "colours hardly differ");
}

fn qualities(points: &[[f64; 3]], ply: &Ply<DefaultElement>) -> Vec<f64> {
    ply.payload["face"].iter().map(|row| worst(points, &corners(row))).collect()
}

#[test]
fn before_and_after_are_told_apart() {
    let mesh = sphere();
    let workspace = Workspace::with(&[("a.off", mesh.off().as_bytes())]);
    for (option, is_after) in
        [("--quality-colors", false), ("--quality-colors=before", false), ("--quality-colors=after", true)]
    {
        workspace.done(&["smooth", "a.off", "-o", "b.ply", option]);
        let ply = parsed(&workspace.bytes("b.ply"));
        let points: Vec<_> = ply.payload["vertex"].iter().map(point).collect();
        assert_ne!(points, mesh.points);
        assert_painted(&ply, &qualities(if is_after { &points } else { &mesh.points }, &ply));
    }
}

#[test]
fn polygons_show_their_worst_triangle() {
    let mesh = grid();
    let workspace = Workspace::with(&[("a.off", mesh.off().as_bytes())]);
    workspace.done(&["smooth", "a.off", "-o", "b.ply", "--quality-colors"]);
    workspace.done(&["smooth", "b.ply", "-o", "c.ply", "--quality-colors=after", "--iterations", "0"]);
    let [before, after] = ["b.ply", "c.ply"].map(|name| parsed(&workspace.bytes(name)));
    let points: Vec<_> = after.payload["vertex"].iter().map(point).collect();
    for (ply, points) in [(&before, &mesh.points), (&after, &points)] {
        for (row, expected) in ply.payload["face"].iter().zip(qualities(points, ply)) {
            assert!((number(row, "quality") - expected).abs() < 1e-5);
        }
    }
}

/// Triangles that changed show the shape of the one that they were.
#[test]
fn improvement_shows_what_triangles_were() {
    let mesh = torus();
    let workspace = Workspace::with(&[("a.ply", &numbered(&mesh))]);
    let harsh = ["--tail-min-angle", "35", "--tail-max-angle", "105"];
    let report = workspace.report("improve", "a.ply", "b.ply", &[&harsh[..], &["--quality-colors"]].concat());
    assert!(report["tail"]["vertices_removed"].as_u64().unwrap() > 0);
    let ply = parsed(&workspace.bytes("b.ply"));
    for row in &ply.payload["face"] {
        let former: Vec<_> = mesh.faces[number(row, "former") as usize].iter().map(|&v| v as usize).collect();
        assert!((number(row, "quality") - worst(&mesh.points, &former)).abs() < 1e-5);
    }
    workspace.report("improve", "a.ply", "c.ply", &[&harsh[..], &["--quality-colors=after"]].concat());
    let ply = parsed(&workspace.bytes("c.ply"));
    let points: Vec<_> = ply.payload["vertex"].iter().map(point).collect();
    assert_painted(&ply, &qualities(&points, &ply));
}

/// Faces carry their numbers.
fn numbered(mesh: &Mesh) -> Vec<u8> {
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty double former\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.points.len(),
        mesh.faces.len()
    );
    mesh.points.iter().for_each(|[x, y, z]| text += &format!("{x} {y} {z}\n"));
    for (number, face) in mesh.faces.iter().enumerate() {
        text += &format!("{number} 3 {} {} {}\n", face[0], face[1], face[2]);
    }
    text.into_bytes()
}

/// Two triangles whose faces have a quality and a colour already, between and behind other properties.
const OWN: &str = "ply\nformat ENCODING 1.0\nelement vertex 4\nproperty double x\nproperty double y\n\
    property double z\nelement face 2\nproperty float red\nproperty list uchar int vertex_indices\ncomment between\n\
    property double quality\nproperty uchar flags\nproperty uchar green\nproperty uchar blue\n\
    property list uchar float texcoord\nelement edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n";
const OWN_PAINTED: &str = "ply\nformat ENCODING 1.0\nelement vertex 4\nproperty double x\nproperty double y\n\
    property double z\nproperty float quality\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
    element face 2\nproperty list uchar int vertex_indices\ncomment between\nproperty uchar flags\n\
    property list uchar float texcoord\nproperty float quality\nproperty uchar red\nproperty uchar green\n\
    property uchar blue\nelement edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n";

fn own(encoding: &str) -> Vec<u8> {
    let mut bytes = OWN.replace("ENCODING", encoding).into_bytes();
    if encoding == "ascii" {
        bytes.extend(
            b"0 0 0\n1 0 0 surplus\n1 1 0\n0  1 0\n0.5 3 0 1 2  0.25 7 8 9 0\n0.5 3 0 2 3 .25 7 8 9 1 4.5 more\n0 2\n",
        );
        return bytes;
    }
    let big = encoding == "binary_big_endian";
    let mut put = |value: &[u8]| {
        let reversed: Vec<u8> = value.iter().rev().copied().collect();
        bytes.extend(if big { &reversed } else { value });
    };
    for coordinate in [[0.0_f64, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]].concat() {
        put(&coordinate.to_le_bytes());
    }
    for (face, texture) in [([0_i32, 1, 2], &[][..]), ([0, 2, 3], &[4.5_f32])] {
        put(&0.5_f32.to_le_bytes());
        put(&[3]);
        face.iter().for_each(|v| put(&v.to_le_bytes()));
        put(&0.25_f64.to_le_bytes());
        [7, 8, 9, texture.len() as u8].iter().for_each(|&byte| put(&[byte]));
        texture.iter().for_each(|x| put(&x.to_le_bytes()));
    }
    [0_i32, 2].iter().for_each(|v| put(&v.to_le_bytes()));
    bytes
}

#[test]
fn faces_own_values_are_replaced_and_the_rest_is_kept() {
    let right_angled = (3.0_f64.sqrt() / 2.0) as f32;
    for encoding in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let workspace = Workspace::with(&[("a.ply", &own(encoding))]);
        let run = workspace.done(&["smooth", "a.ply", "-o", "b.ply", "--quality-colors"]);
        assert!(run.stderr.contains("red, quality, green, blue of element face was replaced"), "{}", run.stderr);
        let mut written = workspace.bytes("b.ply");
        if encoding == "ascii" {
            // The reader that checks does not know that more may stand in a line.
            written = workspace.text("b.ply").replace(" surplus", "").replace(" more", "").into_bytes();
        }
        assert!(written.starts_with(OWN_PAINTED.replace("ENCODING", encoding).as_bytes()), "{encoding}");
        let ply = parsed(&written);
        assert_painted_alike(&ply, right_angled);
        assert_eq!(ply.payload["edge"][0]["vertex2"], Property::Int(2));
        for (row, texture) in ply.payload["face"].iter().zip([vec![], vec![4.5]]) {
            assert_eq!((&row["flags"], &row["texcoord"]), (&Property::UChar(7), &Property::ListFloat(texture)));
        }
        // What was written is replaced again, by the same.
        workspace.done(&["smooth", "b.ply", "-o", "c.ply", "--quality-colors"]);
        assert_eq!(workspace.bytes("c.ply"), workspace.bytes("b.ply"));
    }
    let workspace = Workspace::with(&[("a.ply", &own("ascii"))]);
    workspace.done(&["smooth", "a.ply", "-o", "b.ply", "--quality-colors"]);
    let text = workspace.text("b.ply");
    let rows: Vec<_> = text.split_once("end_header\n").unwrap().1.lines().collect();
    let tint = rows[0].strip_prefix("0 0 0 ").unwrap();
    assert_eq!(rows[1], format!("1 0 0 {tint} surplus"));
    assert_eq!(rows[3], format!("0  1 0 {tint}"));
    assert_eq!(rows[4], format!(" 3 0 1 2  7 0 {tint}"));
    assert_eq!(rows[5], format!(" 3 0 2 3 7 1 4.5 {tint} more"));
    assert_eq!(rows[6], "0 2");
}

fn assert_painted_alike(ply: &Ply<DefaultElement>, quality: f32) {
    let rows: Vec<_> = ply.payload["face"].iter().chain(&ply.payload["vertex"]).collect();
    for row in &rows {
        assert!((number(row, "quality") - f64::from(quality)).abs() < 1e-6);
        for channel in ["red", "green", "blue"] {
            assert_eq!(row[channel], rows[0][channel]);
        }
    }
}

#[test]
fn vertices_own_values_stay() {
    let header = "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\n\
        property float z\r\nproperty uchar red\r\nelement face 1\r\nproperty list uchar int vertex_index\r\n";
    let text = format!("{header}end_header\r\n0 0 0 1\r\n1 0 0 2\r\n0 1 0 3\r\n3 0 1 2\r\n");
    let workspace = Workspace::with(&[("a.ply", text.as_bytes())]);
    let run = workspace.done(&["smooth", "a.ply", "-o", "b.ply", "--quality-colors"]);
    assert!(run.stderr.contains("element vertex keeps its own colour"), "{}", run.stderr);
    let written = workspace.text("b.ply");
    assert!(written.contains("property uchar red\r\nproperty float quality\r\nelement face"), "{written}");
    assert!(written.contains("\r\n1 0 0 2 0.8660254\r\n"), "{written}");
    assert!(written.contains("\r\n3 0 1 2 0.8660254 146 224 89\r\n"), "{written}");
}

#[test]
fn what_cannot_hold_it_is_refused() {
    let list = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nproperty list uchar float quality\nend_header\n\
        0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0\n";
    let workspace = Workspace::with(&[("a.ply", list.as_bytes())]);
    let message = workspace.refused(&["smooth", "a.ply", "-o", "b.ply", "--quality-colors", "--plot", "p.svg"]);
    assert!(message.contains("property `quality` of element `face` is a list"), "{message}");
    for subcommand in ["smooth", "improve", "collapse-tails"] {
        for output in ["b.obj", "b.off", "b.stl"] {
            let run = workspace.run(&[subcommand, "a.ply", "-o", output, "--quality-colors=after"]);
            assert_eq!(run.code, 2, "{}", run.stderr);
            assert!(run.stderr.contains("--quality-colors") && run.stderr.contains(output), "{}", run.stderr);
        }
    }
    let run = workspace.run(&["smooth", "a.ply", "-o", "b.ply", "--quality-colors=now"]);
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("before") && run.stderr.contains("after"), "{}", run.stderr);
    assert!(workspace.refused(&["smooth", "a.ply", "-o", "b.xyz", "--quality-colors"]).contains(".xyz is not known"));
    assert_eq!(workspace.names(), ["a.ply"]);
}

#[test]
fn a_file_without_faces_is_painted_too() {
    let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n";
    let workspace = Workspace::with(&[("a.ply", text.as_bytes())]);
    workspace.done(&["smooth", "a.ply", "-o", "b.ply", "--quality-colors"]);
    assert!(workspace.text("b.ply").ends_with("1 2 3 1.0 248 234 50\n"));
}
