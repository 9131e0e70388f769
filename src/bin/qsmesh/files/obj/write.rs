//! Writing an OBJ file anew, line by line.

use std::io::Write;
use std::ops::Range;

use super::corner::{composed, parts, reindexed, zero_based};
use super::texture::Textures;
use super::{Carrier, Normals, lines};
use crate::failure::Result;
use crate::files::faces::Faces;
use crate::files::normals;
use crate::files::positions::Positions;
use crate::files::revision::Revision;
use crate::files::splice::{Change, Splice, changed};
use crate::files::text::{Line, joined_lines, tokens};

/// Vertices or normals up to the line that is being read.
#[derive(Default)]
struct Count {
    before: usize,
    now: usize,
}

/// The way through the lines.
pub struct Writer<'a, W: Write> {
    bytes: &'a [u8],
    old: &'a Positions,
    revision: &'a Revision,
    faces: &'a Faces,
    fate: Normals,
    normals: Vec<Option<[f64; 3]>>,
    textures: Option<Textures>,
    splice: Splice<'a, W>,
    vertices: Count,
    vertex_normals: Count,
    face: usize,
    dropped: usize,
    /// Inside of a free-form element that is being dropped.
    dropping: bool,
}

impl<'a, W: Write> Writer<'a, W> {
    pub fn new(carrier: &'a Carrier, out: W, old: &'a Positions, revision: &'a Revision, faces: &'a Faces) -> Self {
        let fate = if revision.changes(old, faces) { carrier.normals } else { Normals::Absent };
        let normals = match fate {
            Normals::OnePerVertex => normals::of_vertices(&revision.positions, revision.triangles(faces)),
            _ => Vec::new(),
        };
        Self {
            bytes: &carrier.bytes,
            old,
            revision,
            faces,
            fate,
            normals,
            textures: revision.is_remeshed().then(|| Textures::read(&carrier.bytes)),
            splice: Splice::new(&carrier.bytes, out),
            vertices: Count::default(),
            vertex_normals: Count::default(),
            face: 0,
            dropped: 0,
            dropping: false,
        }
    }

    /// Writes the whole file. Returns what to tell the user.
    pub fn write(mut self) -> Result<Vec<String>> {
        for line in lines(self.bytes) {
            self.line(&line)?;
        }
        self.splice.finish()?;
        let mut notes: Vec<_> = self.fate.note().into_iter().collect();
        if self.dropped > 0 {
            let what = "lines, points or free-form elements were dropped, because a vertex of theirs is gone";
            notes.push(format!("{} {what}", self.dropped));
        }
        Ok(notes)
    }

    fn line(&mut self, line: &Line) -> Result<()> {
        let bytes = self.bytes;
        let mut places = tokens(bytes, line.span.clone());
        let keyword = places.next().map_or(&b""[..], |span| &bytes[span]);
        if self.dropping {
            self.dropping = keyword != b"end";
            return self.drop_line(line);
        }
        match keyword {
            b"v" => self.vertex(line, places),
            b"vn" => self.normal(line, places),
            b"f" => self.corners(line, &places.collect::<Vec<_>>()),
            b"l" | b"p" => self.element(line, places).map(|_| ()),
            b"curv" => self.element(line, places.skip(2)).map(|kept| self.dropping = !kept),
            b"surf" => self.element(line, places.skip(4)).map(|kept| self.dropping = !kept),
            _ => Ok(()),
        }
    }

    fn drop_line(&mut self, line: &Line) -> Result<()> {
        Ok(self.splice.replace(line.span.start..line.full_end, b"")?)
    }

    fn vertex(&mut self, line: &Line, places: impl Iterator<Item = Range<usize>>) -> Result<()> {
        let former = self.vertices.before;
        self.vertices.before += 1;
        if self.revision.vertex(former).is_none() {
            return self.drop_line(line);
        }
        self.vertices.now += 1;
        if let Some(new) = self.revision.moved(self.old, former) {
            for (axis, span) in places.take(3).enumerate() {
                self.splice.replace(span, self.revision.positions.text(new, axis).as_bytes())?;
            }
        }
        Ok(())
    }

    fn normal(&mut self, line: &Line, places: impl Iterator<Item = Range<usize>>) -> Result<()> {
        let former = self.vertex_normals.before;
        self.vertex_normals.before += 1;
        match (self.fate, self.revision.vertex(former)) {
            (Normals::Absent, _) => {}
            (Normals::Loose, _) | (Normals::OnePerVertex, None) => return self.drop_line(line),
            (Normals::OnePerVertex, Some(new)) => {
                // Directions need no more than 32 bits.
                for (value, span) in self.normals[new].into_iter().flatten().zip(places) {
                    self.splice.replace(span, format!("{:?}", value as f32).as_bytes())?;
                }
            }
        }
        self.vertex_normals.now += 1;
        Ok(())
    }

    fn corners(&mut self, line: &Line, places: &[Range<usize>]) -> Result<()> {
        let face = self.face;
        self.face += 1;
        if self.textures.is_none() {
            // Only normals can go from a face that stays.
            if self.fate != Normals::Loose {
                return Ok(());
            }
            let keep = |place: &Range<usize>| self.former_corner(place).map(|text| (place.clone(), text));
            let changes = places.iter().filter_map(keep).collect();
            return self.replace(changes);
        }
        let mut triangles: Vec<_> =
            self.revision.successors(face).map(|triangle| self.triangle(face, triangle, places)).collect();
        if triangles.len() == 1 {
            return self.replace(triangles.swap_remove(0));
        }
        let whole = line.span.start..line.full_end;
        let rows = triangles.iter().map(|changes| changed(self.bytes, whole.clone(), changes)).collect();
        Ok(self.splice.replace(whole, &joined_lines(rows))?)
    }

    /// The three corners of a new triangle in the places of those of `face`.
    fn triangle(&self, face: usize, triangle: usize, places: &[Range<usize>]) -> Vec<Change> {
        let vertices = self.revision.triangles(self.faces)[triangle].map(|vertex| vertex as usize);
        let sources = self.revision.corners(triangle);
        let textures = self.textures.as_ref().map_or(&[][..], |textures| &textures.corners);
        let corner = |(k, place): (usize, &Range<usize>)| {
            let text = &self.bytes[place.clone()];
            let texture = if sources[k] == 3 * face + k {
                parts(text)[1].to_vec()
            } else {
                let record = textures.get(sources[k]).copied().flatten();
                record.map_or_else(Vec::new, |record| (record + 1).to_string().into_bytes())
            };
            (place.clone(), self.corner(text, vertices[k], &texture))
        };
        places.iter().take(3).enumerate().map(corner).collect()
    }

    /// Text of a corner at the new vertex `vertex`, in the way in which `text` is written.
    fn corner(&self, text: &[u8], vertex: usize, texture: &[u8]) -> Vec<u8> {
        let [place, _, normal] = parts(text);
        let normal = match self.fate {
            Normals::Absent => normal.to_vec(),
            Normals::Loose => Vec::new(),
            Normals::OnePerVertex if normal.is_empty() => Vec::new(),
            Normals::OnePerVertex => reindexed(normal, vertex, self.vertex_normals.now),
        };
        composed(text, [&reindexed(place, vertex, self.vertices.now), texture, &normal])
    }

    /// The same corner under its new number; `None` if its vertex is gone.
    fn former_corner(&self, place: &Range<usize>) -> Option<Vec<u8>> {
        let text = &self.bytes[place.clone()];
        let [vertex, texture, _] = parts(text);
        let former = usize::try_from(zero_based(vertex, self.vertices.before)?).ok()?;
        Some(self.corner(text, self.revision.vertex(former)?, texture))
    }

    /// A record that names vertices; it goes if one of them is gone. Returns whether it stays.
    fn element(&mut self, line: &Line, places: impl Iterator<Item = Range<usize>>) -> Result<bool> {
        if self.textures.is_none() {
            return Ok(true);
        }
        let mut changes = Vec::new();
        for place in places {
            match self.former_corner(&place) {
                Some(text) => changes.push((place, text)),
                None => {
                    self.dropped += 1;
                    return self.drop_line(line).map(|()| false);
                }
            }
        }
        self.replace(changes).map(|()| true)
    }

    fn replace(&mut self, changes: Vec<Change>) -> Result<()> {
        for (place, text) in changes {
            if self.bytes[place.clone()] != text {
                self.splice.replace(place, &text)?;
            }
        }
        Ok(())
    }
}
