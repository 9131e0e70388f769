//! Bad input: exit code 1, the offender by name, and no file touched.

use std::fs;

use crate::meshes::sphere;
use crate::workspace::Workspace;

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// Has to be refused by `smooth`, with an existing output staying as it is, and by `measure`; the message.
fn refused(name: &str, bytes: &[u8]) -> String {
    let output = format!("out{}", &name[name.find('.').unwrap()..]);
    let workspace = Workspace::with(&[(name, bytes), (&output, b"old")]);
    let message = workspace.refused(&["smooth", name, "-o", &output]);
    assert_eq!(workspace.bytes(&output), b"old");
    assert_eq!(workspace.refused(&["smooth", name, "-o", &format!("new_{output}")]), message);
    assert_eq!(workspace.refused(&["measure", name]), message);
    assert!(message.starts_with(&format!("error: {name}: ")), "{message}");
    message
}

fn assert_refused(name: &str, bytes: impl AsRef<[u8]>, expected: &str) {
    let message = refused(name, bytes.as_ref());
    assert!(message.contains(expected), "{message} should say {expected}");
}

fn binary_ply(face: [u8; 13]) -> Vec<u8> {
    let mut bytes = PLY.split("end_header").next().unwrap().replace("ascii", "binary_little_endian").into_bytes();
    bytes.extend(b"end_header\n");
    for point in [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
        bytes.extend(point.iter().flat_map(|x| x.to_le_bytes()));
    }
    bytes.extend(face);
    bytes
}

#[test]
fn coordinates_that_are_not_finite_are_named_with_their_line() {
    assert_refused("a.off", "OFF\n3 1 0\n# c\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "line 5: vertex 1 (counted from 0)");
    assert_refused("a.obj", "v 0 0 0\n\nv 1 0 0\nv 0 inf 0\nf 1 2 3\n", "line 4: vertex 2 (counted from 0)");
    assert_refused("a.ply", PLY.replace("1 0 0", "1 0 -inf"), "line 11: vertex 1 (counted from 0)");
    let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 NaN 0\nvertex 0 1 0\nendloop\nendfacet\n";
    assert_refused("a.stl", format!("solid a\n{facet}endsolid a\n"), "line 5: vertex 1 (counted from 0)");
    let mut bytes = binary_ply([3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
    let nan = bytes.len() - 13 - 12;
    bytes[nan..nan + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_refused("a.ply", bytes, "vertex 2 (counted from 0) has a coordinate that is not finite");
}

#[test]
fn indices_without_a_vertex_are_named_with_their_face() {
    assert_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6: face 0 names vertex 3");
    assert_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n", "line 5: face 1 names vertex 3");
    assert_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "line 4: face 0 names vertex -1");
    assert_refused("a.ply", PLY.replace("3 0 1 2", "3 0 -1 2"), "line 13: face 0 names vertex -1");
    assert_refused("a.ply", binary_ply([3, 0, 0, 0, 0, 1, 0, 0, 0, 9, 0, 0, 0]), "face 0 names vertex 9");
}

#[test]
fn cut_files_and_empty_files_are_refused() {
    let off = sphere().off();
    assert_refused("a.off", &off[..off.len() / 2], "258 vertices are declared, but only");
    assert_refused("a.off", &off[..off.len() - 40], "512 faces are declared, but only");
    assert_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1", "line 5: vertex 2 has 2 of 3 coordinates");
    assert_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1", "line 6: face 0 is to have 3 corners");
    assert_refused("a.ply", &PLY[..PLY.len() - 8], "1 rows of element `face` are declared, but only 0 are there");
    assert_refused("a.ply", &PLY[..60], "end_header");
    let bytes = binary_ply([3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
    for length in [bytes.len() - 1, bytes.len() - 13, bytes.len() - 20] {
        assert_refused("a.ply", &bytes[..length], "ends too early");
    }
    for name in ["a.ply", "a.off", "a.obj", "a.stl"] {
        assert_refused(name, "", "the file is empty");
    }
}

#[test]
fn claims_of_the_header_are_not_believed() {
    let many = "4000000000";
    assert_refused("a.off", format!("OFF\n{many} {many} 0\n0 0 0\n"), "4000000000 vertices are declared, but only 1");
    assert_refused("a.ply", PLY.replace("vertex 3", &format!("vertex {many}")), "4000000000 rows of element `vertex`");
    assert_refused("a.ply", PLY.replace("face 1", &format!("face {many}")), "but only 1 are there");
    let list = binary_ply([255; 13]);
    assert_refused("a.ply", list, "ends too early");
    let mut stl = vec![b' '; 84];
    stl[80..].fill(255);
    assert_refused("a.stl", stl, "4294967295 facets are declared");
}

#[test]
fn garbage_is_refused() {
    let garbage: Vec<u8> = (0..4000_u32).map(|k| (k.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    for name in ["a.ply", "a.off", "a.obj", "a.stl"] {
        refused(name, &garbage);
    }
    assert_refused(
        "a.ply",
        PLY.replace("property float y", "property float"),
        "line 5: `property float` is no PLY header",
    );
    assert_refused("a.ply", PLY.replace("property float y", "property float x"), "two properties of the same name");
    assert_refused("a.ply", PLY.replace("float", "int"), "must be all `float` or all `double`");
    assert_refused("a.ply", PLY.replace("vertex_indices", "corners"), "vertex_indices");
    assert_refused("a.ply", PLY.replace("1 0 0", "1 zero 0"), "line 11: `zero` is not a number");
    assert_refused("a.off", "OFF\n1 0 0\n0 zero 0\n", "line 3: `zero` is not a number");
    assert_refused("a.obj", "v 0 0 zero\n", "line 1: `zero` is not a number");
}

#[test]
fn the_output_is_looked_at_before_the_work() {
    let workspace = Workspace::new();
    fs::create_dir(workspace.path("folder.off")).unwrap();
    // The input does not exist: whatever is said about the output is said before reading.
    let told = |output: &str| workspace.refused(&["smooth", "none.off", "-o", output]);
    assert!(told("b.xyz").contains("b.xyz: the format .xyz is not known"));
    assert!(told("plain").contains("no extension"));
    assert!(told("missing/b.off").contains("missing does not exist"));
    assert!(told("folder.off").contains("not a plain file"));
    assert!(told("b.off").contains("none.off: "));
}

#[test]
fn inputs_that_are_no_files_are_refused() {
    let workspace = Workspace::with(&[("a.txt", b"text")]);
    fs::create_dir(workspace.path("folder.ply")).unwrap();
    assert!(workspace.refused(&["measure", "none.ply"]).contains("none.ply"));
    assert!(workspace.refused(&["measure", "folder.ply"]).contains("folder.ply"));
    assert!(workspace.refused(&["measure", "a.txt"]).contains("the format .txt is not known"));
}
