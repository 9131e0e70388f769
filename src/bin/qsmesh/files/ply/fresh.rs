//! A new PLY file of positions and faces.

use std::io::Write;

use ply_rs_bw::ply::{Addable, ElementDef, Encoding, Header, PropertyAccess, PropertyDef, PropertyType, ScalarType};
use ply_rs_bw::writer::Writer;

use super::painted::{COLOR, QUALITY};
use crate::failure::Result;
use crate::files::faces::Faces;
use crate::files::paint::{Paint, Tint};
use crate::files::positions::Positions;

/// A row on its way out: no more than what its element declares is ever set.
#[derive(Default)]
struct Row {
    point: [f64; 3],
    corners: Vec<u32>,
    tint: Option<Tint>,
}

impl PropertyAccess for Row {
    fn new() -> Self {
        Self::default()
    }

    fn get_uchar(&self, name: &str) -> Option<u8> {
        let channel = COLOR.iter().position(|channel| *channel == name)?;
        self.tint.map(|tint| tint.color[channel])
    }

    fn get_float(&self, name: &str) -> Option<f32> {
        match name {
            QUALITY => self.tint.map(|tint| tint.quality),
            _ => self.get_double(name).map(|x| x as f32),
        }
    }

    fn get_double(&self, name: &str) -> Option<f64> {
        match name {
            "x" => Some(self.point[0]),
            "y" => Some(self.point[1]),
            "z" => Some(self.point[2]),
            _ => None,
        }
    }

    fn get_list_uint(&self, _: &str) -> Option<&[u32]> {
        Some(&self.corners)
    }
}

/// Writes a binary little-endian file; coordinates are `float` or `double` as they are held.
pub fn write_fresh(mut out: impl Write, positions: &Positions, faces: &Faces, paint: Option<&Paint>) -> Result<()> {
    let scalar = match positions {
        Positions::F32(_) => ScalarType::Float,
        Positions::F64(_) => ScalarType::Double,
    };
    let most_corners = faces.polygons.iter().map(|polygon| polygon.corners.len()).max().unwrap_or(0);
    let counter = if most_corners < 256 { ScalarType::UChar } else { ScalarType::UInt };
    let coordinate = PropertyType::Scalar(scalar);
    let mut vertex = element("vertex", positions.len(), &["x", "y", "z"], &coordinate);
    let mut face = element("face", faces.len(), &["vertex_indices"], &PropertyType::List(counter, ScalarType::UInt));

    if paint.is_some() {
        [&mut vertex, &mut face].into_iter().for_each(declare_tint);
    }
    let writer = Writer::<Row>::new();
    writer.write_header(&mut out, &header([vertex.clone(), face.clone()]))?;
    let mut row = Row::new();
    for number in 0..positions.len() {
        row.point = positions.at(number);
        row.tint = paint.map(|paint| paint.vertices[number]);
        writer.write_little_endian_element(&mut out, &row, &vertex)?;
    }
    let mut number = 0;
    faces.each(|corners| {
        row.tint = paint.map(|paint| paint.faces[number]);
        number += 1;
        row.corners.clear();
        row.corners.extend_from_slice(corners);
        writer.write_little_endian_element(&mut out, &row, &face)?;
        Ok(())
    })
}

fn declare_tint(element: &mut ElementDef) {
    element.properties.add(PropertyDef::new(QUALITY.to_string(), PropertyType::Scalar(ScalarType::Float)));
    for channel in COLOR {
        element.properties.add(PropertyDef::new(channel.to_string(), PropertyType::Scalar(ScalarType::UChar)));
    }
}

fn header(elements: [ElementDef; 2]) -> Header {
    let mut header = Header::new();
    header.encoding = Encoding::BinaryLittleEndian;
    elements.into_iter().for_each(|element| header.elements.add(element));
    header
}

fn element(name: &str, count: usize, properties: &[&str], kind: &PropertyType) -> ElementDef {
    let mut element = ElementDef::new(name.to_string());
    element.count = count;
    for property in properties {
        element.properties.add(PropertyDef::new((*property).to_string(), kind.clone()));
    }
    element
}
