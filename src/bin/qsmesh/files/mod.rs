//! Mesh files: one in-memory form, and a carrier of everything else that the file holds.

mod faces;
mod format;
mod normals;
mod obj;
mod off;
mod paint;
mod ply;
mod positions;
mod revision;
mod save;
mod seams;
mod splice;
mod stl;
mod target;
mod text;

use std::fs;
use std::io::Write;
use std::path::Path;

pub use self::faces::Faces;
pub use self::format::Format;
pub use self::paint::{Paint, Tint};
pub use self::positions::Positions;
pub use self::revision::Revision;
pub use self::save::{Place, Staged};
pub use self::target::Target;
use crate::failure::{Failure, Result};

/// A mesh as its file holds it.
pub struct MeshFile {
    /// All vertices, in the order and the precision of the file.
    pub positions: Positions,
    /// All faces in their order, and their triangles.
    pub faces: Faces,
    carrier: Carrier,
}

/// What a file holds beside positions and faces, in the form of its format.
enum Carrier {
    Ply(ply::Carrier),
    Obj(obj::Carrier),
    Off(off::Carrier),
    Stl(stl::Carrier),
    /// The mesh was never in a file.
    Nothing,
}

impl MeshFile {
    /// Reads a file in the format that its extension names.
    pub fn read(path: &Path) -> Result<Self> {
        let format = Format::of(path)?;
        let bytes = fs::read(path).map_err(|error| Failure::of_path(path, &error))?;
        Self::parse(format, bytes).map_err(|failure| failure.in_file(path))
    }

    fn parse(format: Format, bytes: Vec<u8>) -> Result<Self> {
        let (positions, faces, carrier) = match format {
            Format::Ply => ply::read(bytes).map(|(p, f, carrier)| (p, f, Carrier::Ply(carrier)))?,
            Format::Obj => obj::read(bytes).map(|(p, f, carrier)| (p, f, Carrier::Obj(carrier)))?,
            Format::Off => off::read(bytes).map(|(p, f, carrier)| (p, f, Carrier::Off(carrier)))?,
            Format::Stl => stl::read(bytes).map(|(p, f, carrier)| (p, f, Carrier::Stl(carrier)))?,
        };
        Ok(Self { positions, faces, carrier })
    }

    /// A mesh that comes from no file.
    pub fn new(positions: Positions, triangles: Vec<[u32; 3]>) -> Self {
        Self { positions, faces: Faces::of_triangles(triangles), carrier: Carrier::Nothing }
    }

    /// A vertex by its number from 0, with the line it is written in if the file is text.
    pub fn name_of_vertex(&self, vertex: usize) -> String {
        let line = match &self.carrier {
            Carrier::Ply(carrier) => carrier.place_of_vertex(vertex),
            Carrier::Obj(carrier) => carrier.place_of_vertex(vertex),
            Carrier::Off(carrier) => carrier.place_of_vertex(vertex),
            Carrier::Stl(carrier) => carrier.place_of_vertex(vertex),
            Carrier::Nothing => None,
        };
        match line {
            Some(line) => format!("line {line}: vertex {vertex} (counted from 0)"),
            None => format!("vertex {vertex} (counted from 0)"),
        }
    }

    /// The positions in the precision that `format` holds, so that what is computed is what is written.
    pub fn positions_for(&self, format: Format) -> Positions {
        match format {
            Format::Stl => self.positions.narrowed(),
            Format::Ply | Format::Obj | Format::Off => self.positions.clone(),
        }
    }

    /// Edges along which what belongs to the faces or their corners parts: texture coordinates, materials, groups.
    /// All faces must be triangles.
    pub fn seams(&self) -> Result<Vec<[u32; 2]>> {
        match &self.carrier {
            Carrier::Ply(carrier) => carrier.seams(&self.faces),
            Carrier::Obj(carrier) => Ok(carrier.seams(&self.faces)),
            Carrier::Off(_) | Carrier::Stl(_) | Carrier::Nothing => Ok(Vec::new()),
        }
    }

    /// Writes the mesh as it has become; its positions come from [`positions_for`](Self::positions_for) the target's
    /// format. Within one format everything else is kept. Only PLY takes `paint`. Returns what to tell the user.
    pub fn save(&self, target: &Target, new: &Revision, paint: Option<&Paint>) -> Result<Vec<String>> {
        let mut notes = Vec::new();
        let (old, faces) = (&self.positions, &self.faces);
        target.write(|out| {
            notes = match (&self.carrier, target.format()) {
                (Carrier::Ply(carrier), Format::Ply) => carrier.write(out, old, new, faces, paint)?,
                (Carrier::Obj(carrier), Format::Obj) => carrier.write(out, old, new, faces)?,
                (Carrier::Off(carrier), Format::Off) => carrier.write(out, old, new, faces)?,
                (Carrier::Stl(carrier), Format::Stl) => carrier.write(out, old, new, faces)?,
                (_, format) => self.convert(format, out, new, paint)?,
            };
            Ok(())
        })?;
        Ok(notes)
    }

    /// Writes positions and faces alone. Returns what was left behind.
    fn convert(&self, format: Format, out: impl Write, new: &Revision, paint: Option<&Paint>) -> Result<Vec<String>> {
        let remeshed = new.is_remeshed().then(|| Faces::of_triangles(new.triangles(&self.faces).to_vec()));
        let (positions, faces) = (&new.positions, remeshed.as_ref().unwrap_or(&self.faces));
        match format {
            Format::Ply => ply::write_fresh(out, positions, faces, paint)?,
            Format::Obj => obj::write_fresh(out, positions, faces)?,
            Format::Off => off::write_fresh(out, positions, faces)?,
            Format::Stl => stl::write_fresh(out, positions, faces)?,
        }
        let lost = self.lost_in(format);
        Ok(if lost.is_empty() { vec![] } else { vec![format!("not carried over to {format}: {}", lost.join(", "))] })
    }

    /// What a conversion to `format` leaves behind.
    fn lost_in(&self, format: Format) -> Vec<String> {
        let mut lost = match &self.carrier {
            Carrier::Ply(carrier) => carrier.beside(),
            Carrier::Obj(carrier) => carrier.beside(),
            Carrier::Off(carrier) => carrier.beside(),
            Carrier::Stl(carrier) => carrier.beside(),
            Carrier::Nothing => Vec::new(),
        };
        if format == Format::Stl {
            if !self.faces.polygons.is_empty() {
                lost.push("polygons (only their triangles)".to_string());
            }
            if matches!(self.positions, Positions::F64(_)) {
                lost.push("64-bit precision (coordinates are rounded to 32 bits)".to_string());
            }
            lost.push("numbering of vertices".to_string());
        }
        lost
    }
}
