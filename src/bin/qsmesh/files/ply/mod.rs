//! PLY. The file's bytes are kept and only coordinates and normals are replaced in them, so that every element,
//! property, comment and number stays as it was written.
//!
//! The header is parsed and new files are written by `ply-rs-bw`. Its payload reader isn't used: it yields values
//! without their places, so that a file could only be written anew, with its comments moved and its numbers respelled,
//! and it refuses ASCII numbers such as `.5`, `5.` and `nan`.

mod fresh;
mod layout;
mod numbers;
mod rows;

use std::io::Write;

use ply_rs_bw::ply::ScalarType;

pub use self::fresh::write_fresh;
use self::layout::{Edit, Layout, Number};
use self::numbers::{Binary, integer, number, written};
use self::rows::{Row, walk};
use super::faces::Faces;
use super::normals;
use super::positions::{Positions, Stored};
use super::splice::Splice;
use crate::failure::{Failure, Result};

/// A PLY file as it was read.
pub struct Carrier {
    bytes: Vec<u8>,
    layout: Layout,
}

/// Reads positions and faces out of the bytes of a file.
pub fn read(bytes: Vec<u8>) -> Result<(Positions, Faces, Carrier)> {
    let layout = Layout::parse(&bytes)?;
    let (positions, faces) = match layout.precision()? {
        ScalarType::Float => {
            let (points, faces) = read_payload::<f32>(&bytes, &layout)?;
            (Positions::F32(points), faces)
        }
        _ => {
            let (points, faces) = read_payload::<f64>(&bytes, &layout)?;
            (Positions::F64(points), faces)
        }
    };
    Ok((positions, faces, Carrier { bytes, layout }))
}

fn read_payload<T: Stored + Binary>(bytes: &[u8], layout: &Layout) -> Result<(Vec<[T; 3]>, Faces)> {
    let mut points = Vec::new();
    let mut faces = Faces::default();
    let mut corners = Vec::new();
    let vertex_count = layout.elements[layout.vertex].count;
    walk(bytes, layout, |element, row| {
        if element == layout.vertex {
            points.push(read_point(bytes, layout, row)?);
        } else if layout.face.is_some_and(|(face, _)| face == element) {
            read_corners(bytes, layout, row, &mut corners)?;
            faces.push(&corners, vertex_count, |face| format!("{}face {face}", row.place()))?;
        }
        Ok(())
    })?;
    Ok((points, faces))
}

fn read_point<T: Stored + Binary>(bytes: &[u8], layout: &Layout, row: &Row) -> Result<[T; 3]> {
    let axis = |axis: usize| {
        let span = row.of(layout.coordinates[axis])[0].clone();
        number::<T>(layout.encoding, &bytes[span.clone()]).ok_or_else(|| row.not_a_number(bytes, span))
    };
    Ok([axis(0)?, axis(1)?, axis(2)?])
}

fn read_corners(bytes: &[u8], layout: &Layout, row: &Row, corners: &mut Vec<i64>) -> Result<()> {
    let Some((face, property)) = layout.face else { return Ok(()) };
    let kind = layout.elements[face].properties[property].item();
    corners.clear();
    for span in row.of(property) {
        let index = integer(kind, layout.encoding, &bytes[span.clone()]);
        corners.push(index.ok_or_else(|| row.not_a_number(bytes, span.clone()))?);
    }
    Ok(())
}

impl Carrier {
    /// Where `vertex` is written, for messages.
    pub fn place_of_vertex(&self, vertex: usize) -> Option<usize> {
        let mut line = None;
        let mut number = 0;
        let _ = walk(&self.bytes, &self.layout, |element, row| {
            if element == self.layout.vertex {
                if number == vertex {
                    line = row.line;
                    return Err(Failure::new("found"));
                }
                number += 1;
            }
            Ok(())
        });
        line
    }

    /// What a plain mesh of positions and faces would lose.
    pub fn beside(&self) -> Vec<String> {
        self.layout.beside()
    }

    /// Writes the file with the new positions and, where it has normals, new normals. Returns what to tell the user.
    pub fn write(&self, out: impl Write, old: &Positions, new: &Positions, faces: &Faces) -> Result<Option<String>> {
        let mut splice = Splice::new(&self.bytes, out);
        let renew = self.layout.normals.is_some() && new.any_moved(old);
        let normals = if renew { normals::of_vertices(new, &faces.triangles) } else { Vec::new() };
        let edits = self.layout.edits(renew);
        let mut vertex = 0;
        walk(&self.bytes, &self.layout, |element, row| {
            if element == self.layout.vertex {
                let moved = new.moved(old, vertex).then_some(new);
                let normal = normals.get(vertex).copied().flatten();
                for edit in &edits {
                    if let Some(number) = self.renewed(*edit, vertex, moved, normal) {
                        splice.replace(row.of(edit.property)[0].clone(), &number)?;
                    }
                }
                vertex += 1;
            }
            Ok(())
        })?;
        splice.finish()?;
        Ok(renew.then(|| "the vertex normals were recomputed from the new positions".to_string()))
    }

    /// The new text or bytes of a number of a vertex; `None` if it stays.
    fn renewed(&self, edit: Edit, vertex: usize, to: Option<&Positions>, normal: Option<[f64; 3]>) -> Option<Vec<u8>> {
        match edit.number {
            Number::Coordinate(axis) => to.map(|positions| self.coordinate(positions, vertex, axis)),
            Number::Normal(axis) => normal.map(|normal| self.normal(edit.property, normal[axis])),
        }
    }

    fn coordinate(&self, positions: &Positions, vertex: usize, axis: usize) -> Vec<u8> {
        match positions {
            Positions::F32(p) => written(self.layout.encoding, p[vertex][axis]),
            Positions::F64(p) => written(self.layout.encoding, p[vertex][axis]),
        }
    }

    fn normal(&self, property: usize, value: f64) -> Vec<u8> {
        match self.layout.elements[self.layout.vertex].properties[property].item() {
            ScalarType::Float => written(self.layout.encoding, value as f32),
            _ => written(self.layout.encoding, value),
        }
    }
}
