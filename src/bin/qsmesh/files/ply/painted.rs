//! Quality and colours as properties of the faces and vertices of a file.

use ply_rs_bw::ply::{Encoding, PropertyType};

use super::layout::{Element, Layout};
use super::numbers::written;
use super::rows::Row;
use crate::failure::{Failure, Result};
use crate::files::paint::{Paint, Tint};
use crate::files::splice::Change;

/// The number, by the name that MeshLab reads and Blender shows.
pub const QUALITY: &str = "quality";
/// Its colour.
pub const COLOR: [&str; 3] = ["red", "green", "blue"];

/// A paint with what it changes in a file.
pub struct Brush<'a> {
    paint: &'a Paint,
    vertices: Painted,
    /// `None` in a file without faces.
    faces: Option<Painted>,
}

impl<'a> Brush<'a> {
    /// Fails where a property cannot be replaced.
    pub fn new(paint: &'a Paint, layout: &Layout) -> Result<Self> {
        let faces = layout.face.map(|(face, _)| Painted::replacing(&layout.elements[face])).transpose()?;
        Ok(Self { paint, vertices: Painted::completing(&layout.elements[layout.vertex]), faces })
    }

    /// The elements that it changes, with what it changes in them.
    fn elements<'b>(&'b self, layout: &'b Layout) -> impl Iterator<Item = (&'b Painted, &'b Element)> {
        let faces = self.faces.as_ref().zip(layout.face).map(|(faces, (face, _))| (faces, &layout.elements[face]));
        std::iter::once((&self.vertices, &layout.elements[layout.vertex])).chain(faces)
    }

    /// Changes of the header, in any order.
    pub fn header_changes(&self, layout: &Layout, bytes: &[u8]) -> Vec<Change> {
        self.elements(layout).flat_map(|(painted, element)| painted.header_changes(element, bytes)).collect()
    }

    /// What to tell the user.
    pub fn notes(&self, layout: &Layout) -> Vec<String> {
        self.elements(layout).filter_map(|(painted, element)| painted.note(element)).collect()
    }

    /// Changes of the row that becomes face `face`, in rising order.
    pub fn face_changes(&self, row: &Row, encoding: Encoding, face: usize) -> Vec<Change> {
        self.faces.as_ref().map_or_else(Vec::new, |faces| faces.row_changes(row, encoding, self.paint.faces[face]))
    }

    /// Changes of the row that becomes vertex `vertex`, in rising order; all lie behind its values.
    pub fn vertex_changes(&self, row: &Row, encoding: Encoding, vertex: usize) -> Vec<Change> {
        self.vertices.row_changes(row, encoding, self.paint.vertices[vertex])
    }
}

/// What changes in the declaration and the rows of one element.
struct Painted {
    /// Properties that are taken out.
    dropped: Vec<usize>,
    adds_quality: bool,
    adds_color: bool,
}

impl Painted {
    /// For faces: whatever bears one of the names is replaced.
    fn replacing(element: &Element) -> Result<Self> {
        let names = [QUALITY].into_iter().chain(COLOR);
        let mut dropped: Vec<usize> = names.filter_map(|name| element.property(name)).collect();
        dropped.sort_unstable();
        for property in dropped.iter().map(|&p| &element.properties[p]) {
            if matches!(property.kind, PropertyType::List(..)) {
                let what = format!("property `{}` of element `{}` is a list", property.name, element.name);
                return Err(Failure::new(format!("{what}, which cannot be replaced by a quality or its colour")));
            }
        }
        Ok(Self { dropped, adds_quality: true, adds_color: true })
    }

    /// For vertices: what they have of their own stays.
    fn completing(element: &Element) -> Self {
        let lacks = |name: &&str| element.property(name).is_none();
        Self { dropped: Vec::new(), adds_quality: lacks(&QUALITY), adds_color: COLOR.iter().all(lacks) }
    }

    /// What to tell the user of it.
    fn note(&self, element: &Element) -> Option<String> {
        let name = &element.name;
        if !self.dropped.is_empty() {
            let names: Vec<_> = self.dropped.iter().map(|&p| element.properties[p].name.as_str()).collect();
            return Some(format!("{} of element {name} was replaced by the quality and its colour", names.join(", ")));
        }
        let kept = match (self.adds_quality, self.adds_color) {
            (true, true) => return None,
            (false, true) => "quality",
            (true, false) => "colour",
            (false, false) => "quality and colour",
        };
        Some(format!("element {name} keeps its own {kept}; the quality of the triangles is that of element face"))
    }

    /// Changes of the declaration, in rising order.
    fn header_changes(&self, element: &Element, bytes: &[u8]) -> Vec<Change> {
        let mut changes: Vec<Change> =
            self.dropped.iter().map(|&p| (element.properties[p].line.clone(), Vec::new())).collect();
        let last = element.properties.last().map_or(&element.line, |property| &property.line);
        let line_end: &str = if bytes[..last.end].ends_with(b"\r\n") { "\r\n" } else { "\n" };
        let mut lines = String::new();
        if self.adds_quality {
            lines += &format!("property float {QUALITY}{line_end}");
        }
        for name in COLOR.iter().filter(|_| self.adds_color) {
            lines += &format!("property uchar {name}{line_end}");
        }
        changes.push((last.end..last.end, lines.into_bytes()));
        changes
    }

    /// Changes of a row that gets `tint`, in rising order.
    fn row_changes(&self, row: &Row, encoding: Encoding, tint: Tint) -> Vec<Change> {
        let dropped = self.dropped.iter().flat_map(|&property| row.of(property));
        let mut changes: Vec<Change> = dropped
            .map(|place| {
                // In text the space before the value goes with it.
                let space = usize::from(encoding == Encoding::Ascii && place.start > row.whole.start);
                (place.start - space..place.end, Vec::new())
            })
            .collect();
        changes.push((row.end..row.end, self.values(encoding, tint)));
        changes
    }

    fn values(&self, encoding: Encoding, tint: Tint) -> Vec<u8> {
        let mut values = Vec::new();
        let mut add = |value: Vec<u8>| {
            if encoding == Encoding::Ascii {
                values.push(b' ');
            }
            values.extend(value);
        };
        if self.adds_quality {
            add(written(encoding, tint.quality));
        }
        for channel in tint.color.into_iter().filter(|_| self.adds_color) {
            add(if encoding == Encoding::Ascii { channel.to_string().into_bytes() } else { vec![channel] });
        }
        values
    }
}
