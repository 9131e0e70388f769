//! PLY. The file's bytes are kept and only what changes is replaced in them, so that every element, property, comment
//! and number stays as it was written.
//!
//! The header is parsed and new files are written by `ply-rs-bw`. Its payload reader isn't used: it yields values
//! without their places, so that a file could only be written anew, with its comments moved and its numbers respelled,
//! and it refuses ASCII numbers such as `.5`, `5.` and `nan`.

mod fresh;
mod layout;
mod numbers;
mod painted;
mod rows;
mod seams;
mod write;

use std::io::Write;

use ply_rs_bw::ply::ScalarType;

pub use self::fresh::write_fresh;
use self::layout::Layout;
use self::numbers::{Binary, integer, number};
use self::painted::Brush;
use self::rows::{Row, walk};
use self::write::Writer;
use super::faces::Faces;
use super::paint::Paint;
use super::positions::{Positions, Stored};
use super::revision::Revision;
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

    /// Edges along which texture coordinates or materials of the faces part; all faces are triangles.
    pub fn seams(&self, faces: &Faces) -> Result<Vec<[u32; 2]>> {
        seams::find(&self.bytes, &self.layout, faces)
    }

    /// Writes the file as it has become. Returns what to tell the user.
    pub fn write(
        &self,
        out: impl Write,
        old: &Positions,
        new: &Revision,
        faces: &Faces,
        paint: Option<&Paint>,
    ) -> Result<Vec<String>> {
        let brush = paint.map(|paint| Brush::new(paint, &self.layout)).transpose()?;
        Writer::new(&self.bytes, &self.layout, old, new, faces, brush)?.write(out)
    }
}
