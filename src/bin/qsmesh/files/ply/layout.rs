//! What the header says about the payload.

use std::io::Cursor;
use std::ops::Range;

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{DefaultElement, Encoding, Header, PropertyType, ScalarType};

use crate::failure::{Failure, Result};
use crate::files::text::{Line, Lines};

/// Names under which other elements than faces name vertices.
const REFERENCES: [&str; 4] = ["vertex1", "vertex2", "vertex_index", "vertex_indices"];
/// Names of lists of a face that go around its corners, with the same number of values for each.
const AROUND_CORNERS: [&str; 3] = ["texcoord", "texcoords", "color"];
/// Names of numbers of a face whose borders are seams.
const REGIONS: [&str; 2] = ["texnumber", "material_index"];

/// A declared property.
pub struct Property {
    pub name: String,
    pub kind: PropertyType,
    /// Its line in the header, with the end.
    pub line: Range<usize>,
}

impl Property {
    /// Type of its value, or of its values if it is a list.
    pub fn item(&self) -> &ScalarType {
        match &self.kind {
            PropertyType::Scalar(kind) | PropertyType::List(_, kind) => kind,
        }
    }
}

/// A declared element.
pub struct Element {
    pub name: String,
    pub count: usize,
    /// Where the count is written in the header.
    pub count_place: Range<usize>,
    /// Its line in the header, with the end.
    pub line: Range<usize>,
    pub properties: Vec<Property>,
}

impl Element {
    /// The property of that name.
    pub fn property(&self, name: &str) -> Option<usize> {
        self.properties.iter().position(|property| property.name == name)
    }

    /// Properties of these names that hold integers (or, if not `integers`, anything).
    fn properties_named(&self, names: &[&str], integers: bool) -> Vec<usize> {
        let fits = |property: &Property| {
            let is_float = matches!(property.item(), ScalarType::Float | ScalarType::Double);
            names.contains(&property.name.as_str()) && !(integers && is_float)
        };
        (0..self.properties.len()).filter(|&p| fits(&self.properties[p])).collect()
    }
}

/// Where things are in the payload. Elements and properties are named by their numbers.
pub struct Layout {
    pub encoding: Encoding,
    /// First byte of the payload.
    pub payload: usize,
    /// Line of the file in which the payload begins, from 1.
    pub payload_line: usize,
    pub elements: Vec<Element>,
    /// The element of that name.
    pub vertex: usize,
    /// Properties x, y, z of a vertex.
    pub coordinates: [usize; 3],
    /// Properties nx, ny, nz of a vertex, if all are there and floating-point.
    pub normals: Option<[usize; 3]>,
    /// The element of that name and its list of vertex indices.
    pub face: Option<(usize, usize)>,
    /// Properties nx, ny, nz of a face, if all are there and floating-point.
    pub face_normals: Option<[usize; 3]>,
}

/// A number of a vertex row that may be written anew.
#[derive(Debug, Clone, Copy)]
pub enum Number {
    Coordinate(usize),
    Normal(usize),
}

/// A property of the vertices that may be written anew.
#[derive(Debug, Clone, Copy)]
pub struct Edit {
    pub property: usize,
    pub number: Number,
}

impl Layout {
    /// From the bytes of a file.
    pub fn parse(bytes: &[u8]) -> Result<Self> {
        let payload = end_of_header(bytes)?;
        let text = String::from_utf8_lossy(&bytes[..payload]);
        let header = parse_header(&text)?;
        let elements = elements(&header, &bytes[..payload])?;
        let find = |name: &str| elements.iter().position(|element| element.name == name);
        let vertex = find("vertex").ok_or_else(|| Failure::new("the header declares no element `vertex`"))?;
        if find("tristrips").is_some() {
            return Err(Failure::new("triangle strips (element `tristrips`) cannot be read"));
        }
        let face = find("face").map(|face| index_list(&elements[face]).map(|list| (face, list))).transpose()?;
        let coordinates = coordinates(&elements[vertex])?;
        let normals_of_faces = face.and_then(|(face, _)| normals(&elements[face]));
        let normals = normals(&elements[vertex]);
        let payload_line = text.lines().count() + 1;
        Ok(Self {
            encoding: header.encoding,
            payload,
            payload_line,
            elements,
            vertex,
            coordinates,
            normals,
            face,
            face_normals: normals_of_faces,
        })
    }

    /// Properties that name vertices, of an element that is neither vertices nor faces.
    pub fn references(&self, element: usize) -> Vec<usize> {
        let known = element == self.vertex || self.face.is_some_and(|(face, _)| face == element);
        if known { Vec::new() } else { self.elements[element].properties_named(&REFERENCES, true) }
    }

    /// Lists of a face that go around its corners.
    pub fn corner_lists(&self) -> Vec<usize> {
        let Some((face, _)) = self.face else { return Vec::new() };
        let face = &self.elements[face];
        let is_list = |&p: &usize| matches!(face.properties[p].kind, PropertyType::List(..));
        face.properties_named(&AROUND_CORNERS, false).into_iter().filter(is_list).collect()
    }

    /// Numbers of a face whose borders are seams.
    pub fn regions(&self) -> Vec<usize> {
        self.face.map_or_else(Vec::new, |(face, _)| self.elements[face].properties_named(&REGIONS, false))
    }

    /// The type of the coordinates: float or double.
    pub fn precision(&self) -> Result<ScalarType> {
        let [x, y, z] = self.coordinates.map(|p| self.elements[self.vertex].properties[p].item());
        match x {
            ScalarType::Float | ScalarType::Double if x == y && y == z => Ok(x.clone()),
            _ => Err(Failure::new("the coordinates x, y, z must be all `float` or all `double`")),
        }
    }

    /// Numbers of a vertex row that may be written anew, in the order in which they lie there.
    pub fn edits(&self, with_normals: bool) -> Vec<Edit> {
        let coordinate = |axis: usize| Edit { property: self.coordinates[axis], number: Number::Coordinate(axis) };
        let mut edits: Vec<Edit> = (0..3).map(coordinate).collect();
        if let Some(normals) = self.normals.filter(|_| with_normals) {
            edits.extend((0..3).map(|axis| Edit { property: normals[axis], number: Number::Normal(axis) }));
        }
        edits.sort_by_key(|edit| edit.property);
        edits
    }

    /// What there is beside positions and faces, by name.
    pub fn beside(&self) -> Vec<String> {
        let mut names = Vec::new();
        for (number, element) in self.elements.iter().enumerate() {
            let is_face = |property| self.face == Some((number, property));
            let is_position = |property| number == self.vertex && self.coordinates.contains(&property);
            let known = number == self.vertex || self.face.is_some_and(|(face, _)| face == number);
            if !known {
                names.push(format!("element {}", element.name));
                continue;
            }
            for (place, property) in element.properties.iter().enumerate() {
                if !is_face(place) && !is_position(place) {
                    names.push(format!("{} {}", element.name, property.name));
                }
            }
        }
        names
    }
}

/// First byte after the line `end_header`.
fn end_of_header(bytes: &[u8]) -> Result<usize> {
    if bytes.is_empty() {
        return Err(Failure::new("the file is empty"));
    }
    if !bytes.starts_with(b"ply\n") && !bytes.starts_with(b"ply\r") && !bytes.starts_with(b"ply ") {
        return Err(Failure::new("line 1: a PLY file begins with `ply`"));
    }
    let mut start = 0;
    while let Some(length) = bytes[start..].iter().position(|&b| b == b'\n') {
        if bytes[start..start + length].trim_ascii() == b"end_header" {
            return Ok(start + length + 1);
        }
        start += length + 1;
    }
    // A file without rows may end with the header.
    if bytes[start..].trim_ascii() == b"end_header" {
        return Ok(bytes.len());
    }
    Err(Failure::new("the header has no line `end_header`"))
}

fn parse_header(text: &str) -> Result<Header> {
    let parser = Parser::<DefaultElement>::new();
    let mut reader = Reader::new(Cursor::new(text.as_bytes()));
    parser.read_header(&mut reader).map_err(|error| {
        let line = error.line();
        let written = line.and_then(|line| text.lines().nth(line - 1)).map(|x| super::super::text::brief(x.trim()));
        match (line, written) {
            (Some(line), Some(written)) => Failure::at_line(line, format!("`{written}` is no PLY header line")),
            _ => Failure::new(format!("the header cannot be read: {error}")),
        }
    })
}

/// The lines that begin with `word`.
fn declarations(header: &[u8], word: &[u8]) -> Vec<Line> {
    let declares = |line: &Line| {
        header[line.span.clone()].split(u8::is_ascii_whitespace).find(|word| !word.is_empty()) == Some(word)
    };
    Lines::of(header).filter(declares).collect()
}

/// Place of the last word of a line.
fn last_word(header: &[u8], line: &Line) -> Range<usize> {
    let end = line.span.start + header[line.span.clone()].trim_ascii_end().len();
    let start = header[..end].iter().rposition(u8::is_ascii_whitespace).map_or(0, |at| at + 1);
    start..end
}

/// Fails where a declaration has not one line: the parser lets a later one of the same name replace the earlier, which
/// would misread every row.
fn elements(header: &Header, bytes: &[u8]) -> Result<Vec<Element>> {
    let (lines, properties) = (declarations(bytes, b"element"), declarations(bytes, b"property"));
    if lines.len() != header.elements.len() {
        return Err(Failure::new("the header declares two elements of the same name"));
    }
    if properties.len() != header.elements.iter().map(|(_, element)| element.properties.len()).sum::<usize>() {
        return Err(Failure::new("the header declares two properties of the same name in one element"));
    }
    let mut properties = properties.into_iter().map(|line| line.span.start..line.full_end);
    let mut elements = Vec::with_capacity(lines.len());
    for ((name, element), line) in header.elements.iter().zip(&lines) {
        let named = element.properties.iter().zip(&mut properties);
        elements.push(Element {
            name: name.clone(),
            count: element.count,
            count_place: last_word(bytes, line),
            line: line.span.start..line.full_end,
            properties: named
                .map(|((name, property), line)| Property { name: name.clone(), kind: property.data_type.clone(), line })
                .collect(),
        });
    }
    Ok(elements)
}

fn coordinates(vertex: &Element) -> Result<[usize; 3]> {
    let find = |name: &str| {
        let place = vertex.property(name).filter(|&p| matches!(vertex.properties[p].kind, PropertyType::Scalar(_)));
        place.ok_or_else(|| Failure::new(format!("element `vertex` has no scalar property `{name}`")))
    };
    Ok([find("x")?, find("y")?, find("z")?])
}

fn normals(vertex: &Element) -> Option<[usize; 3]> {
    let find = |name: &str| {
        vertex.property(name).filter(|&place| {
            let kind = &vertex.properties[place].kind;
            matches!(kind, PropertyType::Scalar(ScalarType::Float | ScalarType::Double))
        })
    };
    Some([find("nx")?, find("ny")?, find("nz")?])
}

fn index_list(face: &Element) -> Result<usize> {
    let place = face.property("vertex_indices").or_else(|| face.property("vertex_index"));
    let place =
        place.ok_or_else(|| Failure::new("element `face` has no property `vertex_indices` or `vertex_index`"))?;
    match &face.properties[place].kind {
        PropertyType::List(_, item) if !matches!(item, ScalarType::Float | ScalarType::Double) => Ok(place),
        _ => Err(Failure::new(format!("property `{}` must be a list of integers", face.properties[place].name))),
    }
}
