//! PLY keeps every element, property and comment in its encoding; an independent reader checks it.

use std::io::Cursor;

use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Ply, Property};

use crate::meshes::{Mesh, sphere};
use crate::workspace::Workspace;

const ENCODINGS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

/// Writes values in an encoding.
struct Payload {
    encoding: &'static str,
    bytes: Vec<u8>,
}

macro_rules! put {
    ($payload:expr, $value:expr) => {{
        let value = $value;
        match $payload.encoding {
            "ascii" => $payload.bytes.extend(format!("{value} ").bytes()),
            "binary_big_endian" => $payload.bytes.extend(value.to_be_bytes()),
            _ => $payload.bytes.extend(value.to_le_bytes()),
        }
    }};
}

impl Payload {
    fn end_row(&mut self) {
        if self.encoding == "ascii" {
            self.bytes.push(b'\n');
        }
    }
}

/// An element without properties can claim any number of rows.
const HEADER: &str = "ply\nformat ENCODING 1.0\ncomment one\nelement vertex VERTICES\nproperty uchar red\n\
    property list uchar short tags\nproperty float32 z\nproperty float x\nproperty double weight\ncomment between\n\
    property float y\nproperty float nx\nproperty double ny\nproperty float nz\nelement camera 2\nproperty char a\n\
    property ushort b\nproperty int c\nproperty uint d\nobj_info made by hand\nelement face FACES\n\
    property uint8 flags\nproperty list uchar int INDICES\nproperty list int float texcoord\n\
    element nothing 4000000000\nelement edge 1\nproperty int vertex1\nend_header\n";

/// A file with all scalar types, lists before and after what counts, and elements of its own.
fn rich(mesh: &Mesh, encoding: &'static str, index_list: &str) -> Vec<u8> {
    let header = HEADER
        .replace("ENCODING", encoding)
        .replace("INDICES", index_list)
        .replace("VERTICES", &mesh.points.len().to_string())
        .replace("FACES", &mesh.faces.len().to_string());
    let mut payload = Payload { encoding, bytes: header.into_bytes() };
    for (number, [x, y, z]) in mesh.points.iter().enumerate() {
        put!(payload, number as u8);
        put!(payload, (number % 3) as u8);
        (0..number % 3).for_each(|k| put!(payload, k as i16 - 1));
        put!(payload, *z as f32);
        put!(payload, *x as f32);
        put!(payload, 0.1 * number as f64);
        put!(payload, *y as f32);
        put!(payload, 1.0_f32);
        put!(payload, 0.0_f64);
        put!(payload, 0.0_f32);
        payload.end_row();
    }
    for camera in 0..2 {
        put!(payload, -(camera as i8));
        put!(payload, u16::MAX);
        put!(payload, i32::MIN);
        put!(payload, u32::MAX);
        payload.end_row();
    }
    mesh.faces.iter().enumerate().for_each(|(number, face)| put_face(&mut payload, number, face));
    put!(payload, 7_i32);
    payload.end_row();
    payload.bytes
}

fn put_face(payload: &mut Payload, number: usize, face: &[u32]) {
    put!(payload, number as u8);
    put!(payload, face.len() as u8);
    face.iter().for_each(|&corner| put!(payload, corner as i32));
    put!(payload, 1_i32);
    put!(payload, 0.5_f32);
    payload.end_row();
}

/// What an independent reader finds; the element without properties, which it would store row by row, is cut away.
fn parsed(bytes: &[u8]) -> Ply<DefaultElement> {
    let text = b"element nothing 4000000000\n";
    let at = bytes.windows(text.len()).position(|window| window == text).expect("the element without properties");
    let bytes = [&bytes[..at], &bytes[at + text.len()..]].concat();
    Parser::new().read_ply(&mut Cursor::new(bytes)).unwrap()
}

fn header(bytes: &[u8]) -> &[u8] {
    let end = b"end_header\n";
    &bytes[..bytes.windows(end.len()).position(|window| window == end).unwrap() + end.len()]
}

#[test]
fn everything_but_positions_and_normals_is_kept_in_every_encoding() {
    for encoding in ENCODINGS {
        let bytes = rich(&sphere(), encoding, "vertex_indices");
        let workspace = Workspace::with(&[("a.ply", &bytes)]);
        let report = workspace.smooth("a.ply", "b.ply", &[]);
        let written = workspace.bytes("b.ply");
        assert_eq!(header(&written), header(&bytes));
        let (mut before, mut after) = (parsed(&bytes), parsed(&written));
        let moved = blank_positions(&mut before, &mut after);
        assert_eq!(report["moved"].as_u64().unwrap() as usize, moved);
        assert!(moved > 200, "{moved} vertices moved");
        assert_eq!(before, after);
    }
}

/// Counts moved vertices, checks that the new normals point outward, and makes both equal in these properties.
fn blank_positions(before: &mut Ply<DefaultElement>, after: &mut Ply<DefaultElement>) -> usize {
    let mut moved = 0;
    for (old, new) in before.payload["vertex"].iter_mut().zip(after.payload["vertex"].iter_mut()) {
        moved += usize::from(["x", "y", "z"].iter().any(|&axis| old[axis] != new[axis]));
        let value = |name: &str| match new[name] {
            Property::Float(x) => f64::from(x),
            Property::Double(x) => x,
            _ => panic!("{name} has another type"),
        };
        let cosine = (value("x") * value("nx") + value("y") * value("ny") + value("z") * value("nz")) / 4.0;
        assert!(cosine > 0.9, "a normal does not point outward");
        for name in ["x", "y", "z", "nx", "ny", "nz"] {
            let same = old[name].clone();
            new.insert(name.to_string(), same);
        }
    }
    moved
}

#[test]
fn encodings_agree_and_the_note_names_the_normals() {
    let positions = ENCODINGS.map(|encoding| {
        let workspace = Workspace::with(&[("a.ply", &rich(&sphere(), encoding, "vertex_index"))]);
        let run = workspace.done(&["smooth", "a.ply", "-o", "b.ply"]);
        assert!(run.stderr.contains("vertex normals were recomputed"), "{}", run.stderr);
        let vertices = parsed(&workspace.bytes("b.ply")).payload["vertex"].clone();
        vertices.iter().map(|vertex| ["x", "y", "z"].map(|axis| vertex[axis].clone())).collect::<Vec<_>>()
    });
    assert_eq!(positions[0], positions[1]);
    assert_eq!(positions[0], positions[2]);
}

#[test]
fn no_sweep_no_change() {
    for encoding in ENCODINGS {
        let mut bytes = rich(&sphere(), encoding, "vertex_indices");
        bytes.extend(b"\ntrailing bytes");
        let workspace = Workspace::with(&[("a.ply", &bytes)]);
        let run = workspace.done(&["smooth", "a.ply", "-o", "b.ply", "--iterations", "0"]);
        assert_eq!(run.stderr, "");
        assert_eq!(workspace.bytes("b.ply"), bytes);
    }
}

#[test]
fn ascii_numbers_of_every_spelling_are_read_and_kept() {
    let text = "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty double x\r\nproperty double y\r\n\
        property double z\r\nproperty float quality\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\n\
        end_header\r\n.5 +1. 0 nan\r\n\r\n1e0 0 -0 inf\r\n0 0 0 0\r\n9 9 9 0 surplus\r\n3 0 1 2\r\n";
    let workspace = Workspace::with(&[("a.ply", text.as_bytes())]);
    let report = workspace.smooth("a.ply", "b.ply", &[]);
    assert_eq!((&report["after"]["vertices"], &report["after"]["triangles"]), (&4.into(), &1.into()));
    assert_eq!(workspace.text("b.ply"), text);
}

#[test]
fn double_coordinates_are_written_as_double() {
    let mesh = sphere();
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        mesh.points.len(),
        mesh.faces.len()
    );
    text += mesh.off().split_once(" 0\n").unwrap().1;
    let workspace = Workspace::with(&[("a.ply", text.as_bytes()), ("a.off", mesh.off().as_bytes())]);
    workspace.smooth("a.ply", "b.ply", &[]);
    workspace.smooth("a.off", "b.off", &[]);
    let rows = |text: String, mark: &str| text.split_once(mark).unwrap().1.to_string();
    assert_eq!(rows(workspace.text("b.ply"), "end_header\n"), rows(workspace.text("b.off"), " 0\n"));
}
