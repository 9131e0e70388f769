//! STL is welded on the way in; an independent reader checks what comes out.

use std::io::Cursor;

use stl_io::{IndexedMesh, IndexedTriangle};

use crate::meshes::sphere;
use crate::workspace::Workspace;

/// The sphere as binary STL whose header begins like that of an ASCII file, with attribute bytes.
fn binary() -> Vec<u8> {
    let mesh = sphere();
    let mut bytes = b"solid by hand".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((mesh.faces.len() as u32).to_le_bytes());
    for (number, face) in mesh.faces.iter().enumerate() {
        bytes.extend([0; 12]);
        for &corner in face {
            bytes.extend(mesh.points[corner as usize].iter().flat_map(|&x| (x as f32).to_le_bytes()));
        }
        bytes.extend((number as u16).to_le_bytes());
    }
    bytes
}

/// The same as text, in two solids.
fn ascii() -> String {
    let mesh = sphere();
    let mut text = "solid one\n".to_string();
    for (number, face) in mesh.faces.iter().enumerate() {
        if number == 100 {
            text += "endsolid one\nsolid\n";
        }
        text += "  facet normal 0 0 0\n    outer loop\n";
        for &corner in face {
            let [x, y, z] = mesh.points[corner as usize];
            text += &format!("      vertex {x:e} {y:e} {z:e}\n");
        }
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid\n"
}

/// What an independent reader finds.
fn parsed(mut bytes: Vec<u8>) -> IndexedMesh {
    // That reader takes this header for text.
    bytes[..5].copy_from_slice(b"_____");
    stl_io::read_stl(&mut Cursor::new(bytes)).unwrap()
}

fn corners(mesh: &IndexedMesh) -> Vec<[usize; 3]> {
    mesh.faces.iter().map(|face| face.vertices).collect()
}

#[test]
fn header_and_attributes_stay_and_normals_fit() {
    let bytes = binary();
    let workspace = Workspace::with(&[("a.stl", &bytes)]);
    let report = workspace.smooth("a.stl", "b.stl", &[]);
    assert_eq!((&report["before"]["vertices"], &report["before"]["boundary_edges"]), (&258.into(), &0.into()));
    let after = workspace.bytes("b.stl");
    assert_eq!(after.len(), bytes.len());
    assert_eq!(after[..84], bytes[..84]);
    for (number, facet) in after[84..].chunks_exact(50).enumerate() {
        assert_eq!(facet[48..], (number as u16).to_le_bytes());
    }
    let (old, new) = (parsed(bytes), parsed(after));
    assert!(corners(&old) == corners(&new), "the connectivity changed");
    let moved = old.vertices.iter().zip(&new.vertices).filter(|(a, b)| a != b).count();
    assert_eq!(report["moved"].as_u64().unwrap() as usize, moved);
    let rests = |v: &usize| old.vertices[*v] == new.vertices[*v];
    let (resting, moving): (Vec<&IndexedTriangle>, Vec<_>) =
        new.faces.iter().partition(|face| face.vertices.iter().all(rests));
    assert!(resting.iter().all(|face| face.normal.0 == [0.0; 3]), "the normal of a resting facet changed");
    for face in moving {
        let middle = [0, 1, 2].map(|axis| face.vertices.iter().map(|&v| new.vertices[v][axis]).sum::<f32>() / 12.0);
        let cosine: f32 = (0..3).map(|axis| middle[axis] * face.normal[axis]).sum();
        assert!(cosine > 0.8, "a facet's normal does not point outward");
    }
}

#[test]
fn ascii_with_several_solids_becomes_binary_and_that_is_said() {
    let workspace = Workspace::with(&[("a.stl", ascii().as_bytes()), ("c.stl", &binary())]);
    let run = workspace.done(&["smooth", "a.stl", "-o", "b.stl"]);
    assert!(run.stderr.contains("binary STL"), "{}", run.stderr);
    workspace.done(&["smooth", "c.stl", "-o", "d.stl"]);
    let (from_text, from_binary) = (parsed(workspace.bytes("b.stl")), parsed(workspace.bytes("d.stl")));
    assert!(corners(&from_text) == corners(&from_binary), "the connectivity differs");
    assert!(from_text.vertices == from_binary.vertices, "the positions differ");
}

#[test]
fn zero_and_negative_zero_are_one_place() {
    let text = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
        facet normal 0 0 1\nouter loop\nvertex 1 -0 0\nvertex 1 1 -0\nvertex -0 1 0\nendloop\nendfacet\nendsolid\n";
    let workspace = Workspace::with(&[("a.stl", text.as_bytes())]);
    let measured: serde_json::Value =
        serde_json::from_str(&workspace.done(&["measure", "a.stl", "--json"]).stdout).unwrap();
    assert_eq!((&measured["vertices"], &measured["boundary_edges"]), (&4.into(), &4.into()));
}
