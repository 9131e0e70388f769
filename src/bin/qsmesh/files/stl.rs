//! STL. Corners at equal places are welded into vertices. A binary file keeps its header, its attribute bytes and all
//! facets that stay as they are; an ASCII file becomes a binary one.
//!
//! `stl_io` reads in the tests only: it takes a binary file whose header begins with `solid ` for text, reads just the
//! first solid of an ASCII file, and drops header and attributes.

use std::collections::HashMap;
use std::io::Write;
use std::ops::Range;

use super::faces::Faces;
use super::normals;
use super::positions::Positions;
use super::revision::Revision;
use super::splice::Splice;
use super::text::{Lines, brief, number, tokens};
use crate::failure::{Failure, Result};

/// Bytes before the first facet of a binary file: text of any kind, then the count.
const HEADER: usize = 84;
/// Bytes of a facet: normal and three corners of three 32-bit numbers, and two attribute bytes.
const FACET: usize = 50;

/// An STL file as it was read.
pub struct Carrier {
    /// The bytes of a binary file, none for an ASCII one.
    binary: Option<Vec<u8>>,
    /// Line of the first corner at each vertex of an ASCII file.
    lines: Vec<usize>,
}

/// Reads positions and triangles out of the bytes of a file.
pub fn read(bytes: Vec<u8>) -> Result<(Positions, Faces, Carrier)> {
    let mut weld = Weld::default();
    let binary = is_binary(&bytes)?;
    if binary {
        read_binary(&bytes, &mut weld);
    } else {
        read_ascii(&bytes, &mut weld)?;
    }
    let carrier = Carrier { binary: binary.then_some(bytes), lines: weld.lines };
    Ok((Positions::F32(weld.points), Faces::of_triangles(weld.triangles), carrier))
}

/// Only the length tells: headers of binary files do begin with `solid`.
fn is_binary(bytes: &[u8]) -> Result<bool> {
    if bytes.is_empty() {
        return Err(Failure::new("the file is empty"));
    }
    let claimed = bytes.get(HEADER - 4..HEADER).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
    let facets = claimed.and_then(|count| usize::try_from(count).ok()?.checked_mul(FACET));
    if facets.and_then(|length| length.checked_add(HEADER)).is_some_and(|needed| bytes.len() == needed) {
        return Ok(true);
    }
    let word = bytes.trim_ascii_start().get(..5);
    if word.is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) && !bytes.contains(&0) {
        return Ok(false);
    }
    let length = bytes.len();
    Err(Failure::new(match claimed {
        Some(count) => {
            format!("{count} facets are declared, which do not make {length} bytes, and it is not ASCII STL")
        }
        None => "the file is too short for binary STL, and it is not ASCII STL".to_string(),
    }))
}

/// Joins corners at equal places.
#[derive(Default)]
struct Weld {
    vertices: HashMap<[u32; 3], u32>,
    points: Vec<[f32; 3]>,
    lines: Vec<usize>,
    triangles: Vec<[u32; 3]>,
}

impl Weld {
    /// The vertex at `point`.
    fn vertex(&mut self, point: [f32; 3]) -> u32 {
        // Adding 0 makes -0 and 0 one place; everything else keeps its bits.
        let key = point.map(|x| (x + 0.0).to_bits());
        let next = self.points.len() as u32;
        let vertex = *self.vertices.entry(key).or_insert(next);
        if vertex == next {
            self.points.push(point);
        }
        vertex
    }
}

fn read_binary(bytes: &[u8], weld: &mut Weld) {
    for facet in bytes[HEADER..].chunks_exact(FACET) {
        let triangle = [0, 1, 2].map(|corner| weld.vertex([0, 1, 2].map(|axis| number_at(facet, corner + 1, axis))));
        weld.triangles.push(triangle);
    }
}

/// Number `axis` of the normal (0) or of a corner (1 to 3) of a facet.
fn number_at(facet: &[u8], row: usize, axis: usize) -> f32 {
    let at = row * 12 + axis * 4;
    f32::from_le_bytes([facet[at], facet[at + 1], facet[at + 2], facet[at + 3]])
}

fn read_ascii(bytes: &[u8], weld: &mut Weld) -> Result<()> {
    let mut corners: Vec<u32> = Vec::new();
    let mut last = 1;
    let mut closed = true;
    for line in Lines::of(bytes) {
        let mut words = tokens(bytes, line.span);
        let Some(keyword) = words.next() else { continue };
        last = line.number;
        match bytes[keyword.clone()].to_ascii_lowercase().as_slice() {
            b"vertex" => {
                corners.push(weld.vertex(read_corner(bytes, &mut words, last)?));
                weld.lines.resize(weld.points.len(), last);
            }
            b"endfacet" => weld.triangles.push(close_facet(&mut corners, last)?),
            b"solid" => closed = false,
            b"endsolid" => closed = true,
            b"facet" | b"outer" | b"endloop" => {}
            _ => {
                let word = brief(&String::from_utf8_lossy(&bytes[keyword]));
                return Err(Failure::at_line(last, format!("`{word}` is no keyword of ASCII STL")));
            }
        }
    }
    if closed && corners.is_empty() { Ok(()) } else { Err(Failure::at_line(last, "the file ends inside a solid")) }
}

fn read_corner(bytes: &[u8], words: &mut impl Iterator<Item = Range<usize>>, line: usize) -> Result<[f32; 3]> {
    let mut axis = || {
        let missing = || Failure::at_line(line, "a coordinate is missing");
        number::<f32>(bytes, words.next().ok_or_else(missing)?, line)
    };
    Ok([axis()?, axis()?, axis()?])
}

fn close_facet(corners: &mut Vec<u32>, line: usize) -> Result<[u32; 3]> {
    let facet = <[u32; 3]>::try_from(corners.as_slice());
    let found = corners.len();
    corners.clear();
    facet.map_err(|_| Failure::at_line(line, format!("a facet ends here with {found} of 3 vertices")))
}

impl Carrier {
    /// Line in which `vertex` is first written; `None` in a binary file.
    pub fn place_of_vertex(&self, vertex: usize) -> Option<usize> {
        self.lines.get(vertex).copied()
    }

    /// What a plain mesh of positions and faces would lose.
    pub fn beside(&self) -> Vec<String> {
        let what = if self.binary.is_some() { "header and attribute bytes" } else { "names of solids" };
        vec![what.to_string()]
    }

    /// Writes the mesh as it has become, as a binary file. Returns what to tell the user.
    pub fn write(&self, out: impl Write, old: &Positions, new: &Revision, faces: &Faces) -> Result<Vec<String>> {
        let Some(bytes) = &self.binary else {
            write_fresh(out, &new.positions, &Faces::of_triangles(new.triangles(faces).to_vec()))?;
            return Ok(vec!["ASCII STL is written as binary STL; names of solids are not kept".to_string()]);
        };
        let mut splice = Splice::new(bytes, out);
        splice.replace(HEADER - 4..HEADER, &count(new.triangles(faces))?.to_le_bytes())?;
        for (face, former) in faces.triangles.iter().enumerate() {
            let start = HEADER + face * FACET;
            let facet = &bytes[start..start + FACET];
            let facets = new.successors(face).map(|t| refaceted(facet, *former, new.triangles(faces)[t], old, new));
            splice.replace(start..start + FACET, &facets.collect::<Vec<_>>().concat())?;
        }
        splice.finish()?;
        let changes = new.changes(old, faces);
        Ok(if changes { vec!["the normals of changed facets were recomputed".to_string()] } else { vec![] })
    }
}

/// A facet that has become `triangle`; it keeps its attribute bytes, and its corners where they are as they were.
fn refaceted(facet: &[u8], former: [u32; 3], triangle: [u32; 3], old: &Positions, new: &Revision) -> Vec<u8> {
    let mut facet = facet.to_vec();
    let corners = triangle.map(|vertex| new.positions.at(vertex as usize));
    let mut normal = None;
    for (corner, (&vertex, former)) in triangle.iter().zip(former.map(|v| v as usize)).enumerate() {
        let same = new.vertex(former) == Some(vertex as usize) && new.moved(old, former).is_none();
        if !same {
            facet[12 * (corner + 1)..12 * (corner + 2)].copy_from_slice(&packed(corners[corner]));
            normal = Some(normals::of_triangle(corners));
        }
    }
    if let Some(normal) = normal {
        facet[..12].copy_from_slice(&packed(normal));
    }
    facet
}

fn count(triangles: &[[u32; 3]]) -> Result<u32> {
    u32::try_from(triangles.len()).map_err(|_| Failure::new("STL cannot hold so many facets"))
}

/// Three 32-bit numbers.
fn packed(vector: [f64; 3]) -> Vec<u8> {
    vector.iter().flat_map(|&x| (x as f32).to_le_bytes()).collect()
}

/// A new binary file. `positions` are written as 32-bit numbers.
pub fn write_fresh(mut out: impl Write, positions: &Positions, faces: &Faces) -> Result<()> {
    let count = count(&faces.triangles)?;
    let mut header = [0; HEADER];
    header[..6].copy_from_slice(b"qsmesh");
    header[HEADER - 4..].copy_from_slice(&count.to_le_bytes());
    out.write_all(&header)?;
    for triangle in &faces.triangles {
        let corners = triangle.map(|vertex| positions.at(vertex as usize));
        out.write_all(&packed(normals::of_triangle(corners)))?;
        corners.iter().try_for_each(|&corner| out.write_all(&packed(corner)))?;
        out.write_all(&[0; 2])?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{FACET, HEADER, read, write_fresh};
    use crate::files::faces::Faces;
    use crate::files::positions::Positions;
    use crate::files::revision::Revision;

    const TWO_SOLIDS: &str = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
        endloop\nendfacet\nendsolid\nSOLID b\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 1 0 -0\nVERTEX 1 1 0\n\
        VERTEX 0 1 0\nENDLOOP\nENDFACET\nENDSOLID b\n";

    #[test]
    fn every_solid_is_read_and_welded() {
        let (positions, faces, carrier) = read(TWO_SOLIDS.as_bytes().to_vec()).unwrap();
        assert_eq!(faces.triangles, [[0, 1, 2], [1, 3, 2]]);
        assert_eq!(positions.len(), 4);
        assert_eq!(carrier.place_of_vertex(3), Some(14));
    }

    #[test]
    fn binary_keeps_header_attributes_and_what_did_not_move() {
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [5.0; 3]];
        let faces = Faces::of_triangles(vec![[0, 1, 2], [0, 2, 3], [4, 1, 2]]);
        let mut bytes = Vec::new();
        write_fresh(&mut bytes, &Positions::F32(points), &faces).unwrap();
        bytes[..8].copy_from_slice(b"solid ab");
        bytes[HEADER + FACET - 2..HEADER + FACET].copy_from_slice(&[7, 9]);

        let (old, faces, carrier) = read(bytes.clone()).unwrap();
        let Positions::F32(mut moved) = old.clone() else { panic!("STL holds 32-bit coordinates") };
        moved[0] = [-1.0, 0.0, 0.0];
        let mut out = Vec::new();
        let new = Revision::of_positions(Positions::F32(moved));
        carrier.write(&mut out, &old, &new, &faces).unwrap();
        assert_eq!(out[..HEADER + 12], bytes[..HEADER + 12]);
        assert_eq!(out[HEADER + 12..HEADER + 16], (-1.0_f32).to_le_bytes());
        assert_eq!(out[HEADER + 24..HEADER + FACET], bytes[HEADER + 24..HEADER + FACET]);
        assert_eq!(out[HEADER + 2 * FACET..], bytes[HEADER + 2 * FACET..]);
    }

    #[test]
    fn what_is_no_stl_is_refused() {
        let refused = |bytes: &[u8]| read(bytes.to_vec()).err().unwrap().to_string();
        assert!(refused(&[255; 100]).contains("4294967295 facets are declared"));
        assert!(refused(b"short").contains("too short"));
        let (cut, _) = TWO_SOLIDS.split_at(TWO_SOLIDS.find("endloop").unwrap());
        assert_eq!(refused(cut.as_bytes()), "line 6: the file ends inside a solid");
        let nonsense = TWO_SOLIDS.replace("vertex 1 0 0\n", "");
        assert_eq!(refused(nonsense.as_bytes()), "line 7: a facet ends here with 2 of 3 vertices");
    }
}
