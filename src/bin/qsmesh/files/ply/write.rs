//! Writing a PLY file anew, row by row.

use std::collections::HashMap;
use std::io::Write;
use std::ops::Range;

use ply_rs_bw::ply::{Encoding, ScalarType};

use super::layout::{Edit, Layout, Number};
use super::numbers::{integer, written, written_integer};
use super::painted::Brush;
use super::rows::{Row, walk};
use crate::failure::Result;
use crate::files::faces::Faces;
use crate::files::normals;
use crate::files::positions::Positions;
use crate::files::revision::Revision;
use crate::files::splice::{Change, Splice, changed};
use crate::files::text::joined_lines;

/// All that is needed to write the rows.
pub struct Writer<'a> {
    bytes: &'a [u8],
    layout: &'a Layout,
    old: &'a Positions,
    revision: &'a Revision,
    faces: &'a Faces,
    edits: Vec<Edit>,
    /// Of the vertices; none where they stay.
    normals: Vec<Option<[f64; 3]>>,
    /// For each element the properties that name vertices; none where they keep their numbers.
    references: Vec<Vec<usize>>,
    /// Lists around the corners of the faces; none where the corners stay.
    corner_lists: Vec<usize>,
    /// Rows of faces from which corners went to other faces.
    lenders: HashMap<usize, Row>,
    renews_normals: bool,
    renews_face_normals: bool,
    brush: Option<Brush<'a>>,
}

impl<'a> Writer<'a> {
    pub fn new(
        bytes: &'a [u8],
        layout: &'a Layout,
        old: &'a Positions,
        revision: &'a Revision,
        faces: &'a Faces,
        brush: Option<Brush<'a>>,
    ) -> Result<Self> {
        let changes = revision.changes(old, faces);
        let renews_normals = layout.normals.is_some() && changes;
        let references = |element| if revision.is_remeshed() { layout.references(element) } else { Vec::new() };
        let mut writer = Self {
            bytes,
            layout,
            old,
            revision,
            faces,
            edits: layout.edits(renews_normals),
            normals: Vec::new(),
            references: (0..layout.elements.len()).map(references).collect(),
            corner_lists: if revision.is_remeshed() { layout.corner_lists() } else { Vec::new() },
            lenders: HashMap::new(),
            renews_normals,
            renews_face_normals: layout.face_normals.is_some() && changes && faces.polygons.is_empty(),
            brush,
        };
        if renews_normals {
            writer.normals = normals::of_vertices(&revision.positions, revision.triangles(faces));
        }
        if !writer.corner_lists.is_empty() {
            writer.lenders = writer.find_lenders()?;
        }
        Ok(writer)
    }

    /// Writes the whole file. Returns what to tell the user.
    pub fn write(&self, out: impl Write) -> Result<Vec<String>> {
        let dropped = self.count_dropped()?;
        let mut splice = Splice::new(self.bytes, out);
        self.write_header(&mut splice, &dropped)?;
        let (mut vertex, mut face) = (0, 0);
        walk(self.bytes, self.layout, |element, row| {
            if element == self.layout.vertex {
                vertex += 1;
                self.write_vertex(&mut splice, row, vertex - 1)
            } else if self.layout.face.is_some_and(|(face, _)| face == element) {
                face += 1;
                self.write_face(&mut splice, row, face - 1)
            } else {
                self.write_other(&mut splice, row, element)
            }
        })?;
        splice.finish()?;
        let mut notes = self.notes(&dropped);
        notes.extend(self.brush.iter().flat_map(|brush| brush.notes(self.layout)));
        Ok(notes)
    }

    fn notes(&self, dropped: &[usize]) -> Vec<String> {
        let mut notes = Vec::new();
        if self.renews_normals {
            notes.push("the vertex normals were recomputed from the new positions".to_string());
        }
        if self.renews_face_normals {
            notes.push("the normals of changed faces were recomputed".to_string());
        }
        for (element, count) in self.layout.elements.iter().zip(dropped).filter(|(_, count)| **count > 0) {
            let name = &element.name;
            notes.push(format!("{count} rows of element {name} were dropped, because a vertex of theirs is gone"));
        }
        notes
    }

    /// How many rows of each element lose a vertex.
    fn count_dropped(&self) -> Result<Vec<usize>> {
        let mut dropped = vec![0; self.layout.elements.len()];
        if self.references.iter().any(|properties| !properties.is_empty()) {
            walk(self.bytes, self.layout, |element, row| {
                dropped[element] += usize::from(self.renumbered(row, element).is_none());
                Ok(())
            })?;
        }
        Ok(dropped)
    }

    fn write_header(&self, splice: &mut Splice<'_, impl Write>, dropped: &[usize]) -> Result<()> {
        let mut changes = self.count_changes(dropped);
        changes.extend(self.brush.iter().flat_map(|brush| brush.header_changes(self.layout, self.bytes)));
        changes.sort_by_key(|(place, _)| place.start);
        changes.into_iter().try_for_each(|(place, new)| Ok(splice.replace(place, &new)?))
    }

    fn count_changes(&self, dropped: &[usize]) -> Vec<Change> {
        let mut changes = Vec::new();
        for (number, element) in self.layout.elements.iter().enumerate() {
            let count = if number == self.layout.vertex {
                self.revision.positions.len()
            } else if self.revision.is_remeshed() && self.layout.face.is_some_and(|(face, _)| face == number) {
                self.revision.triangles(self.faces).len()
            } else {
                element.count - dropped[number]
            };
            if count != element.count {
                changes.push((element.count_place.clone(), count.to_string().into_bytes()));
            }
        }
        changes
    }

    fn write_vertex(&self, splice: &mut Splice<'_, impl Write>, row: &Row, former: usize) -> Result<()> {
        let Some(vertex) = self.revision.vertex(former) else { return Ok(splice.replace(row.whole.clone(), b"")?) };
        let moved = self.revision.moved(self.old, former).is_some();
        let normal = self.normals.get(vertex).copied().flatten();
        for edit in &self.edits {
            let number = match edit.number {
                Number::Coordinate(axis) => moved.then(|| self.coordinate(vertex, axis)),
                Number::Normal(axis) => {
                    normal.map(|normal| self.direction(self.layout.vertex, edit.property, normal[axis]))
                }
            };
            if let Some(number) = number {
                splice.replace(row.of(edit.property)[0].clone(), &number)?;
            }
        }
        let mut painted = self.brush.iter().flat_map(|brush| brush.vertex_changes(row, self.layout.encoding, vertex));
        painted.try_for_each(|(place, new)| Ok(splice.replace(place, &new)?))
    }

    fn coordinate(&self, vertex: usize, axis: usize) -> Vec<u8> {
        match &self.revision.positions {
            Positions::F32(p) => written(self.layout.encoding, p[vertex][axis]),
            Positions::F64(p) => written(self.layout.encoding, p[vertex][axis]),
        }
    }

    fn direction(&self, element: usize, property: usize, value: f64) -> Vec<u8> {
        match self.layout.elements[element].properties[property].item() {
            ScalarType::Float => written(self.layout.encoding, value as f32),
            _ => written(self.layout.encoding, value),
        }
    }

    fn write_face(&self, splice: &mut Splice<'_, impl Write>, row: &Row, face: usize) -> Result<()> {
        if !self.revision.is_remeshed() && !self.renews_face_normals && self.brush.is_none() {
            return Ok(());
        }
        let of = |triangle| changed(self.bytes, row.whole.clone(), &self.face_changes(row, face, triangle));
        let rows: Vec<_> = self.revision.successors(face).map(of).collect();
        let rows = if self.layout.encoding == Encoding::Ascii { joined_lines(rows) } else { rows.concat() };
        Ok(splice.replace(row.whole.clone(), &rows)?)
    }

    /// What makes the row of `face` that of `successor`, in rising order.
    fn face_changes(&self, row: &Row, face: usize, successor: usize) -> Vec<Change> {
        let mut changes = Vec::new();
        // Only where all faces are triangles do they have the numbers of triangles.
        if self.revision.is_remeshed() || self.renews_face_normals {
            changes = self.triangle_changes(row, face, successor);
        }
        if let Some(brush) = &self.brush {
            changes.extend(brush.face_changes(row, self.layout.encoding, successor));
        }
        changes.sort_by_key(|(place, _)| place.start);
        changes
    }

    fn triangle_changes(&self, row: &Row, face: usize, triangle: usize) -> Vec<Change> {
        let Some((element, indices)) = self.layout.face else { return Vec::new() };
        let corners = self.revision.triangles(self.faces)[triangle];
        let mut changes = Vec::new();
        for (place, vertex) in row.of(indices).iter().zip(corners) {
            changes.push((place.clone(), self.index(element, indices, place, vertex as usize)));
        }
        for &list in &self.corner_lists {
            self.carry_corners(row, face, triangle, list, &mut changes);
        }
        if let Some(properties) = self.layout.face_normals.filter(|_| self.changes_plane(face, corners)) {
            let normal = normals::of_triangle(corners.map(|vertex| self.revision.positions.at(vertex as usize)));
            for (property, value) in properties.into_iter().zip(normal) {
                changes.push((row.of(property)[0].clone(), self.direction(element, property, value)));
            }
        }
        changes
    }

    fn index(&self, element: usize, property: usize, place: &Range<usize>, vertex: usize) -> Vec<u8> {
        let kind = self.layout.elements[element].properties[property].item();
        written_integer(kind, self.layout.encoding, &self.bytes[place.clone()], vertex)
    }

    /// Whether a triangle that was `face` has another or a moved corner.
    fn changes_plane(&self, face: usize, corners: [u32; 3]) -> bool {
        let rests = |(former, new): (u32, u32)| {
            let former = former as usize;
            self.revision.vertex(former) == Some(new as usize) && self.revision.moved(self.old, former).is_none()
        };
        !self.faces.triangles[face].into_iter().zip(corners).all(rests)
    }

    /// Fills a list around the corners with the values of the corners that those of `triangle` came from.
    fn carry_corners(&self, row: &Row, face: usize, triangle: usize, list: usize, changes: &mut Vec<Change>) {
        let own = row.of(list);
        let each = own.len() / 3;
        for (corner, source) in self.revision.corners(triangle).into_iter().enumerate() {
            let lender = self.lenders.get(&(source / 3)).map_or(own, |row| row.of(list));
            if source == 3 * face + corner || lender.len() != own.len() {
                continue;
            }
            for value in 0..each {
                let text = self.bytes[lender[each * (source % 3) + value].clone()].to_vec();
                changes.push((own[each * corner + value].clone(), text));
            }
        }
    }

    /// The rows of all faces whose corners went to other faces.
    fn find_lenders(&self) -> Result<HashMap<usize, Row>> {
        let mut lends = vec![false; self.faces.len()];
        for face in 0..self.faces.len() {
            let sources = self.revision.successors(face).flat_map(|triangle| self.revision.corners(triangle));
            sources.map(|source| source / 3).filter(|&lender| lender != face).for_each(|lender| lends[lender] = true);
        }
        let mut lenders = HashMap::new();
        let mut face = 0;
        walk(self.bytes, self.layout, |element, row| {
            if self.layout.face.is_some_and(|(face, _)| face == element) {
                if lends[face] {
                    lenders.insert(face, row.clone());
                }
                face += 1;
            }
            Ok(())
        })?;
        Ok(lenders)
    }

    fn write_other(&self, splice: &mut Splice<'_, impl Write>, row: &Row, element: usize) -> Result<()> {
        match self.renumbered(row, element) {
            Some(changes) => changes.iter().try_for_each(|(place, new)| Ok(splice.replace(place.clone(), new)?)),
            None => Ok(splice.replace(row.whole.clone(), b"")?),
        }
    }

    /// New numbers of the vertices that a row names; `None` if one of them is gone.
    fn renumbered(&self, row: &Row, element: usize) -> Option<Vec<Change>> {
        let mut changes = Vec::new();
        for &property in &self.references[element] {
            let kind = self.layout.elements[element].properties[property].item();
            for place in row.of(property) {
                let former = integer(kind, self.layout.encoding, &self.bytes[place.clone()]);
                // What names no vertex stays as it is.
                let former = former.and_then(|index| usize::try_from(index).ok()).filter(|&v| v < self.old.len());
                if let Some(former) = former {
                    let new = self.revision.vertex(former)?;
                    changes.push((place.clone(), self.index(element, property, place, new)));
                }
            }
        }
        Some(changes)
    }
}
