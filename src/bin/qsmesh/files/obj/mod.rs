//! Wavefront OBJ. Every line is kept; only coordinates of moved vertices, vertex normals and what names a vertex that
//! has another number are written anew, and lines go with what they describe.

mod corner;
mod texture;
mod write;

use std::io::Write;
use std::ops::Range;

use self::corner::zero_based;
use self::texture::Textures;
use self::write::Writer;
use super::faces::Faces;
use super::positions::Positions;
use super::revision::Revision;
use super::text::{Line, Lines, brief, number, require_text, tokens};
use crate::failure::{Failure, Result};

/// An OBJ file as it was read.
pub struct Carrier {
    bytes: Vec<u8>,
    normals: Normals,
    beside: Vec<String>,
}

/// What becomes of the file's vertex normals once vertices have moved.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Normals {
    /// There are none.
    Absent,
    /// Normal k belongs to vertex k: they can be recomputed.
    OnePerVertex,
    /// Several normals at a vertex, or shared ones: whose they would be is unknown, so they are dropped.
    Loose,
}

/// Reads positions and faces out of the bytes of a file.
pub fn read(bytes: Vec<u8>) -> Result<(Positions, Faces, Carrier)> {
    require_text(&bytes)?;
    let points = read_points(&bytes)?;
    let mut survey = Survey { all_vertices: points.len(), ..Survey::default() };
    let mut faces = Faces::default();
    for line in lines(&bytes) {
        survey.read(&bytes, &line, &mut faces)?;
    }
    let (normals, beside) = (survey.normals(), survey.beside());
    Ok((Positions::F64(points), faces, Carrier { bytes, normals, beside }))
}

fn lines(bytes: &[u8]) -> Lines<'_> {
    Lines::of(bytes).joining()
}

/// Whether the line is a record of that keyword; the tokens that follow it, if so.
fn record<'a>(bytes: &'a [u8], line: &Line, keyword: &str) -> Option<impl Iterator<Item = Range<usize>> + 'a> {
    let mut tokens = tokens(bytes, line.span.clone());
    tokens.next().filter(|span| &bytes[span.clone()] == keyword.as_bytes()).map(|_| tokens)
}

fn read_points(bytes: &[u8]) -> Result<Vec<[f64; 3]>> {
    let mut points = Vec::new();
    for line in lines(bytes) {
        let Some(mut tokens) = record(bytes, &line, "v") else { continue };
        let mut axis = || {
            let missing = || Failure::at_line(line.number, format!("vertex {} lacks a coordinate", points.len()));
            number::<f64>(bytes, tokens.next().ok_or_else(missing)?, line.number)
        };
        let point = [axis()?, axis()?, axis()?];
        points.push(point);
    }
    Ok(points)
}

/// What is found on the way through the records.
#[derive(Default)]
struct Survey {
    all_vertices: usize,
    vertices: usize,
    normals: usize,
    has_texture: bool,
    has_other: bool,
    has_colour: bool,
    corners: Vec<i64>,
    loose: bool,
}

impl Survey {
    fn read(&mut self, bytes: &[u8], line: &Line, faces: &mut Faces) -> Result<()> {
        let mut tokens = tokens(bytes, line.span.clone());
        let Some(keyword) = tokens.next() else { return Ok(()) };
        match &bytes[keyword] {
            b"v" => {
                self.vertices += 1;
                self.has_colour |= tokens.nth(3).is_some();
            }
            b"vn" => self.normals += 1,
            b"vt" => self.has_texture = true,
            b"f" => {
                self.corners.clear();
                for token in tokens {
                    self.read_corner(bytes, token, line.number)?;
                }
                let number = line.number;
                faces.push(&self.corners, self.all_vertices, |face| format!("line {number}: face {face}"))?;
            }
            _ => self.has_other = true,
        }
        Ok(())
    }

    /// A corner `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn read_corner(&mut self, bytes: &[u8], token: Range<usize>, line: usize) -> Result<()> {
        let mut parts = bytes[token.clone()].split(|&b| b == b'/');
        let index = parts.next().and_then(|part| zero_based(part, self.vertices));
        let index = index.ok_or_else(|| {
            let text = brief(&String::from_utf8_lossy(&bytes[token.clone()]));
            Failure::at_line(line, format!("`{text}` is not a corner of a face"))
        })?;
        let normal = parts.nth(1).and_then(|part| zero_based(part, self.normals));
        self.loose |= normal != Some(index);
        self.corners.push(index);
        Ok(())
    }

    fn normals(&self) -> Normals {
        match self.normals {
            0 => Normals::Absent,
            count if count == self.vertices && !self.loose => Normals::OnePerVertex,
            _ => Normals::Loose,
        }
    }

    fn beside(&self) -> Vec<String> {
        let found = [
            (self.has_colour, "weights or colours of vertices"),
            (self.has_texture, "texture coordinates"),
            (self.normals > 0, "vertex normals"),
            (self.has_other, "groups, materials and other records"),
        ];
        found.iter().filter(|(found, _)| *found).map(|(_, name)| (*name).to_string()).collect()
    }
}

impl Carrier {
    /// Line in which `vertex` is written.
    pub fn place_of_vertex(&self, vertex: usize) -> Option<usize> {
        let vertices = lines(&self.bytes).filter(|line| record(&self.bytes, line, "v").is_some());
        vertices.map(|line| line.number).nth(vertex)
    }

    /// What a plain mesh of positions and faces would lose.
    pub fn beside(&self) -> Vec<String> {
        self.beside.clone()
    }

    /// Edges along which texture coordinates, materials, groups or smoothing groups part; all faces are triangles.
    pub fn seams(&self, faces: &Faces) -> Vec<[u32; 2]> {
        Textures::read(&self.bytes).seams(&faces.triangles)
    }

    /// Writes the file as it has become. Returns what to tell the user.
    pub fn write(&self, out: impl Write, old: &Positions, new: &Revision, faces: &Faces) -> Result<Vec<String>> {
        Writer::new(self, out, old, new, faces).write()
    }
}

impl Normals {
    fn note(self) -> Option<String> {
        match self {
            Self::Absent => None,
            Self::OnePerVertex => Some("the vertex normals were recomputed from the new positions".to_string()),
            Self::Loose => Some(
                "the vertex normals were dropped: they are not one per vertex, so they can't be recomputed".to_string(),
            ),
        }
    }
}

/// A new file of positions and faces. Coordinates are written so that they read back to the same value.
pub fn write_fresh(mut out: impl Write, positions: &Positions, faces: &Faces) -> Result<()> {
    // Also keeps the file of an empty mesh from being an empty file.
    writeln!(out, "# {} vertices, {} faces", positions.len(), faces.len())?;
    for vertex in 0..positions.len() {
        let [x, y, z] = positions.at(vertex);
        writeln!(out, "v {x:?} {y:?} {z:?}")?;
    }
    faces.each(|corners| {
        write!(out, "f")?;
        corners.iter().try_for_each(|&corner| write!(out, " {}", u64::from(corner) + 1))?;
        Ok(writeln!(out)?)
    })
}

#[cfg(test)]
mod tests {
    use super::{Normals, read};
    use crate::files::positions::Positions;
    use crate::files::revision::Revision;

    fn rewritten(text: &str, change: impl FnOnce(&mut Vec<[f64; 3]>)) -> (String, Vec<String>) {
        let (positions, faces, carrier) = read(text.as_bytes().to_vec()).unwrap();
        let Positions::F64(mut points) = positions.clone() else { panic!("OBJ holds 64-bit coordinates") };
        change(&mut points);
        let mut out = Vec::new();
        let new = Revision::of_positions(Positions::F64(points));
        let notes = carrier.write(&mut out, &positions, &new, &faces).unwrap();
        (String::from_utf8(out).unwrap(), notes)
    }

    #[test]
    fn only_coordinates_of_moved_vertices_change() {
        let text = "# made\r\nv 1e0 +2. .5 1 0.25\r\nv 0 0 0\r\ng a\r\nv 0 1 0 # tip\r\nf -3 -2/7 \\\r\n -1\r\n";
        let (same, notes) = rewritten(text, |_| {});
        assert_eq!((same.as_str(), notes), (text, vec![]));
        let (changed, _) = rewritten(text, |points| points[2] = [0.125, 1.0, -3.0]);
        assert_eq!(changed, text.replace("v 0 1 0 #", "v 0.125 1.0 -3.0 #"));
    }

    #[test]
    fn one_normal_per_vertex_is_recomputed() {
        let text = "v 0 0 0\nvn 1 0 0\nv 1 0 0\nvn 1 0 0\nv 0 1 0\nvn 1 0 0\nf 1//1 2//2 -1//-1\n";
        let (changed, notes) = rewritten(text, |points| points[1] = [2.0, 0.0, 0.0]);
        assert_eq!(changed, text.replace("vn 1 0 0", "vn 0.0 0.0 1.0").replace("v 1 0 0", "v 2.0 0.0 0.0"));
        assert!(notes[0].contains("recomputed"));
    }

    #[test]
    fn loose_normals_are_dropped_and_texture_stays() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nf 1//1 2/1/1 3/1\nf 3 2 1\n";
        let (changed, notes) = rewritten(text, |points| points[1] = [2.0, 0.0, 0.0]);
        assert_eq!(changed, "v 0 0 0\nv 2.0 0.0 0.0\nv 0 1 0\nvt 0 0\nf 1 2/1 3/1\nf 3 2 1\n");
        assert!(notes[0].contains("dropped"));
    }

    #[test]
    fn faces_may_come_before_their_vertices_but_not_without_them() {
        let (_, faces, carrier) = read(b"f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n".to_vec()).unwrap();
        assert_eq!((faces.triangles.as_slice(), carrier.normals), ([[0, 1, 2]].as_slice(), Normals::Absent));
        let refused = |text: &str| read(text.as_bytes().to_vec()).err().unwrap().to_string();
        assert_eq!(refused("v 0 0 0\nf 1 1 -2\n"), "line 2: face 0 names vertex -1, but there are 1 vertices");
        assert_eq!(refused("v 0 0 0\nf 1 2 1\n"), "line 2: face 0 names vertex 1, but there are 1 vertices");
        assert_eq!(refused("v 0 0 0\nf 0 1 1\n"), "line 2: `0` is not a corner of a face");
        assert_eq!(refused("v 0 0\n"), "line 1: vertex 0 lacks a coordinate");
    }
}
