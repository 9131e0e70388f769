//! OFF with its prefixes ST, C and N. Every line is kept; only counts, coordinates of moved vertices, vertex normals
//! and vertices of faces that have another number are written anew, and lines go with what they describe.

use std::io::Write;
use std::iter::Peekable;
use std::ops::Range;

use super::faces::Faces;
use super::normals;
use super::positions::Positions;
use super::revision::Revision;
use super::splice::{Change, Splice, changed};
use super::text::{Line, Lines, brief, integer_text, joined_lines, number, require_text, tokens};
use crate::failure::{Failure, Result};

/// An OFF file as it was read.
pub struct Carrier {
    bytes: Vec<u8>,
    header: Header,
    has_extras: bool,
}

/// The words before the vertices.
struct Header {
    has_normals: bool,
    vertices: usize,
    faces: usize,
    /// Places of the counts of vertices, faces and, where it is written, edges.
    counts: Vec<Range<usize>>,
}

/// Reads positions and faces out of the bytes of a file.
pub fn read(bytes: Vec<u8>) -> Result<(Positions, Faces, Carrier)> {
    require_text(&bytes)?;
    let mut rows = Rows::of(&bytes);
    let header = rows.header()?;
    let mut has_extras = header.has_normals;
    let mut points = Vec::new();
    for done in 0..header.vertices {
        let row = rows.next(|| short("vertices", header.vertices, done))?;
        has_extras |= row.places.len() > 3;
        points.push(read_point(&bytes, &row, done)?);
    }
    let mut faces = Faces::default();
    for done in 0..header.faces {
        let row = rows.next(|| short("faces", header.faces, done))?;
        let corners = read_face(&bytes, &row, done)?;
        has_extras |= row.places.len() > corners.len() + 1;
        faces.push(&corners, points.len(), |face| format!("line {}: face {face}", row.line))?;
    }
    Ok((Positions::F64(points), faces, Carrier { bytes, header, has_extras }))
}

fn short(what: &str, claimed: usize, found: usize) -> Failure {
    Failure::new(format!("the file ends too early: {claimed} {what} are declared, but only {found} are there"))
}

fn read_point(bytes: &[u8], row: &Row, vertex: usize) -> Result<[f64; 3]> {
    let [x, y, z] = row.places.first_chunk::<3>().ok_or_else(|| {
        Failure::at_line(row.line, format!("vertex {vertex} has {} of 3 coordinates", row.places.len()))
    })?;
    let axis = |span: &Range<usize>| number::<f64>(bytes, span.clone(), row.line);
    Ok([axis(x)?, axis(y)?, axis(z)?])
}

fn read_face(bytes: &[u8], row: &Row, face: usize) -> Result<Vec<i64>> {
    let count: usize = number(bytes, row.places[0].clone(), row.line)?;
    let corners = row.places.get(1..).and_then(|rest| rest.get(..count)).ok_or_else(|| {
        let found = row.places.len() - 1;
        Failure::at_line(row.line, format!("face {face} is to have {count} corners, but the line has {found} numbers"))
    })?;
    corners.iter().map(|span| number(bytes, span.clone(), row.line)).collect()
}

/// A line with something on it.
struct Row {
    line: usize,
    /// All of it, with its end.
    whole: Range<usize>,
    places: Vec<Range<usize>>,
}

/// The lines that hold more than a comment.
struct Rows<'a> {
    bytes: &'a [u8],
    lines: Peekable<Lines<'a>>,
}

impl<'a> Rows<'a> {
    fn of(bytes: &'a [u8]) -> Self {
        Self { bytes, lines: Lines::of(bytes).peekable() }
    }

    fn next(&mut self, at_end: impl FnOnce() -> Failure) -> Result<Row> {
        for line in self.lines.by_ref() {
            let Line { span, number, full_end } = line;
            let whole = span.start..full_end;
            let places: Vec<_> = tokens(self.bytes, span).collect();
            if !places.is_empty() {
                return Ok(Row { line: number, whole, places });
            }
        }
        Err(at_end())
    }

    /// The keyword, which may be missing, and the counts, which may stand on the keyword's line.
    fn header(&mut self) -> Result<Header> {
        let no_counts = || Failure::new("the file ends before the counts of vertices and faces");
        let mut row = self.next(no_counts)?;
        let word = String::from_utf8_lossy(&self.bytes[row.places[0].clone()]).into_owned();
        let mut has_normals = false;
        if word.parse::<usize>().is_err() {
            has_normals = normals_of_keyword(&word).map_err(|what| Failure::at_line(row.line, what))?;
            row.places.remove(0);
            if row.places.is_empty() {
                row = self.next(no_counts)?;
            }
        }
        let [vertices, faces, ..] = row.places.as_slice() else {
            return Err(Failure::at_line(row.line, "the counts of vertices and faces are expected here"));
        };
        let count = |span: &Range<usize>| number::<usize>(self.bytes, span.clone(), row.line);
        let (vertices, faces) = (count(vertices)?, count(faces)?);
        row.places.truncate(3);
        Ok(Header { has_normals, vertices, faces, counts: row.places })
    }
}

/// Whether the keyword announces vertex normals.
fn normals_of_keyword(word: &str) -> std::result::Result<bool, String> {
    let prefix = word.strip_suffix("OFF").ok_or_else(|| format!("`{}` is no OFF keyword", brief(word)))?;
    let prefix = prefix.strip_prefix("ST").unwrap_or(prefix);
    let prefix = prefix.strip_prefix('C').unwrap_or(prefix);
    match prefix {
        "" => Ok(false),
        "N" => Ok(true),
        _ => Err(format!("`{}` has other than three coordinates a vertex, which cannot be read", brief(word))),
    }
}

impl Carrier {
    /// Line in which `vertex` is written.
    pub fn place_of_vertex(&self, vertex: usize) -> Option<usize> {
        let mut rows = Rows::of(&self.bytes);
        rows.header().ok()?;
        let end = || Failure::new("no such vertex");
        for _ in 0..vertex {
            rows.next(end).ok()?;
        }
        rows.next(end).ok().map(|row| row.line)
    }

    /// What a plain mesh of positions and faces would lose.
    pub fn beside(&self) -> Vec<String> {
        if self.has_extras { vec!["colours and other numbers of vertices and faces".to_string()] } else { Vec::new() }
    }

    /// Writes the file as it has become. Returns what to tell the user.
    pub fn write(&self, out: impl Write, old: &Positions, new: &Revision, faces: &Faces) -> Result<Vec<String>> {
        let renew = self.header.has_normals && new.changes(old, faces);
        let normals = if renew { normals::of_vertices(&new.positions, new.triangles(faces)) } else { Vec::new() };
        let mut splice = Splice::new(&self.bytes, out);
        let mut rows = Rows::of(&self.bytes);
        rows.header()?;
        if new.is_remeshed() {
            self.write_counts(&mut splice, new, faces)?;
        }
        for former in 0..old.len() {
            let row = rows.next(|| short("vertices", old.len(), former))?;
            match new.vertex(former) {
                Some(vertex) => {
                    if new.moved(old, former).is_some() {
                        write_point(&mut splice, &row, &new.positions, vertex)?;
                    }
                    write_normal(&mut splice, &row, normals.get(vertex).copied().flatten())?;
                }
                None => splice.replace(row.whole, b"")?,
            }
        }
        let faces_to_write = if new.is_remeshed() { faces.len() } else { 0 };
        for face in 0..faces_to_write {
            let row = rows.next(|| short("faces", faces.len(), face))?;
            self.write_face(&mut splice, &row, new.triangles(faces), new.successors(face))?;
        }
        splice.finish()?;
        Ok(if renew { vec!["the vertex normals were recomputed from the new positions".to_string()] } else { vec![] })
    }

    fn write_counts(&self, splice: &mut Splice<'_, impl Write>, new: &Revision, faces: &Faces) -> Result<()> {
        let triangles = new.triangles(faces);
        let counts = [new.positions.len(), triangles.len(), edge_count(triangles)];
        for (what, (place, count)) in self.header.counts.iter().zip(counts).enumerate() {
            let text = &self.bytes[place.clone()];
            // Many files leave the edges uncounted.
            let uncounted = what == 2 && text.iter().all(|&digit| digit == b'0');
            if !uncounted {
                splice.replace(place.clone(), &integer_text(text, count as i64))?;
            }
        }
        Ok(())
    }

    /// Writes the row of a triangle once for each of its `successors`, which keep what follows the corners.
    fn write_face(
        &self,
        splice: &mut Splice<'_, impl Write>,
        row: &Row,
        triangles: &[[u32; 3]],
        successors: Range<usize>,
    ) -> Result<()> {
        let renumbered = |triangle: &[u32; 3]| -> Vec<u8> {
            let change = |(place, &vertex): (&Range<usize>, &u32)| -> Change {
                (place.clone(), integer_text(&self.bytes[place.clone()], i64::from(vertex)))
            };
            let changes: Vec<_> = row.places[1..].iter().zip(triangle).map(change).collect();
            changed(&self.bytes, row.whole.clone(), &changes)
        };
        let rows = triangles[successors].iter().map(renumbered).collect();
        Ok(splice.replace(row.whole.clone(), &joined_lines(rows))?)
    }
}

fn write_point(splice: &mut Splice<'_, impl Write>, row: &Row, positions: &Positions, vertex: usize) -> Result<()> {
    for (axis, span) in row.places.iter().take(3).enumerate() {
        splice.replace(span.clone(), positions.text(vertex, axis).as_bytes())?;
    }
    Ok(())
}

/// Directions need no more than 32 bits.
fn write_normal(splice: &mut Splice<'_, impl Write>, row: &Row, normal: Option<[f64; 3]>) -> Result<()> {
    for (value, span) in normal.into_iter().flatten().zip(row.places.iter().skip(3)) {
        splice.replace(span.clone(), format!("{:?}", value as f32).as_bytes())?;
    }
    Ok(())
}

fn edge_count(triangles: &[[u32; 3]]) -> usize {
    let edges = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)]);
    let mut edges: Vec<_> = triangles.iter().flat_map(edges).collect();
    edges.sort_unstable();
    edges.dedup();
    edges.len()
}

/// A new file of positions and faces. Coordinates are written so that they read back to the same value.
pub fn write_fresh(mut out: impl Write, positions: &Positions, faces: &Faces) -> Result<()> {
    writeln!(out, "OFF\n{} {} 0", positions.len(), faces.len())?;
    for vertex in 0..positions.len() {
        let [x, y, z] = positions.at(vertex);
        writeln!(out, "{x:?} {y:?} {z:?}")?;
    }
    faces.each(|corners| {
        write!(out, "{}", corners.len())?;
        corners.iter().try_for_each(|corner| write!(out, " {corner}"))?;
        Ok(writeln!(out)?)
    })
}

#[cfg(test)]
mod tests {
    use super::read;
    use crate::files::positions::Positions;
    use crate::files::revision::Revision;

    fn rewritten(text: &str, moved: usize, to: [f64; 3]) -> String {
        let (positions, faces, carrier) = read(text.as_bytes().to_vec()).unwrap();
        let Positions::F64(mut points) = positions.clone() else { panic!("OFF holds 64-bit coordinates") };
        points[moved] = to;
        let mut out = Vec::new();
        let new = Revision::of_positions(Positions::F64(points));
        carrier.write(&mut out, &positions, &new, &faces).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn colours_and_comments_stay() {
        let text = "COFF # a\n# b\n3 1 0\n0 0 0 255 0 0\n\n1e0 .5 0 0 255 0 # tip\n0 1 0 0 0 255\n3 0 1 2 9 9 9\n# end";
        assert_eq!(rewritten(text, 0, [0.0, 0.0, -0.5]), text.replace("\n0 0 0 255", "\n0.0 0.0 -0.5 255"));
        assert_eq!(rewritten(text, 1, [1.0, 0.5, 0.0]), text);
    }

    #[test]
    fn announced_normals_are_recomputed() {
        let text = "NOFF 3 1 0\n0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n3 0 1 2\n";
        let expected = "NOFF 3 1 0\n0 0 0 0.0 0.0 1.0\n2.0 0.0 0.0 0.0 0.0 1.0\n0 1 0 0.0 0.0 1.0\n3 0 1 2\n";
        assert_eq!(rewritten(text, 1, [2.0, 0.0, 0.0]), expected);
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        let refused = |text: &str| read(text.as_bytes().to_vec()).err().unwrap().to_string();
        assert_eq!(refused("OFF\n1 1 0\n0 0 0\n3 0 0 1\n"), "line 4: face 0 names vertex 1, but there are 1 vertices");
        assert_eq!(refused("OFF\n1 0 0\n0 0\n"), "line 3: vertex 0 has 2 of 3 coordinates");
        let early = "the file ends too early: 4000000000 vertices are declared, but only 1 are there";
        assert_eq!(refused("OFF\n4000000000 1 0\n0 0 0\n"), early);
        assert_eq!(refused("FOO\n"), "line 1: `FOO` is no OFF keyword");
        let count = "line 4: face 0 is to have 18446744073709551615 corners, but the line has 2 numbers";
        assert_eq!(refused("OFF\n1 1 0\n0 0 0\n18446744073709551615 0 0\n"), count);
        assert!(refused("nOFF\n3\n").contains("cannot be read"));
    }
}
