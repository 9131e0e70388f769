//! Texture coordinates of corners, and the edges along which they, materials or groups part.

use std::ops::Range;

use super::corner::{parts, zero_based};
use super::lines;
use crate::files::seams::{self, Values};
use crate::files::text::tokens;

/// Records that govern the faces after them.
const STATES: [&[u8]; 4] = [b"o", b"g", b"usemtl", b"s"];

/// What belongs to the faces and their corners, all faces being triangles.
pub struct Textures {
    /// The `vt` record, from 0, of each corner (3 × face + 0, 1 or 2).
    pub corners: Vec<Option<usize>>,
    /// A number for each `vt` record, the same where the coordinates are the same.
    values: Vec<u32>,
    /// A number for each face, the same where object, groups, material and smoothing group are the same.
    regions: Vec<u32>,
}

impl Textures {
    /// From the bytes of a file.
    pub fn read(bytes: &[u8]) -> Self {
        let mut all = Self { corners: Vec::new(), values: Vec::new(), regions: Vec::new() };
        let (mut places, mut governors) = (Values::default(), Values::default());
        let mut states = [const { Vec::new() }; STATES.len()];
        for line in lines(bytes) {
            let mut tokens = tokens(bytes, line.span);
            let Some(keyword) = tokens.next() else { continue };
            let keyword = &bytes[keyword];
            if keyword == b"vt" {
                all.values.push(places.number(&coordinates(bytes, tokens)));
            } else if keyword == b"f" {
                let texture = |token: Range<usize>| zero_based(parts(&bytes[token])[1], all.values.len());
                all.corners.extend(tokens.map(|token| texture(token).and_then(|index| usize::try_from(index).ok())));
                all.regions.push(governors.number(&states.join(&b'\n')));
            } else if let Some(state) = STATES.iter().position(|&state| state == keyword) {
                states[state] = tokens.map(|token| &bytes[token]).collect::<Vec<_>>().join(&b' ');
            }
        }
        all
    }

    /// Edges of `triangles`, the faces of the file, along which something parts.
    pub fn seams(&self, triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
        let value = |corner: &Option<usize>| corner.and_then(|vt| self.values.get(vt)).map_or(0, |value| value + 1);
        let corners: Vec<u32> = self.corners.iter().map(value).collect();
        seams::find(triangles, &corners, &self.regions)
    }
}

/// The numbers of a record, so that 1 and 1.0 are the same.
fn coordinates(bytes: &[u8], tokens: impl Iterator<Item = Range<usize>>) -> Vec<u8> {
    let mut value = Vec::new();
    for token in tokens {
        let text = &bytes[token];
        match std::str::from_utf8(text).ok().and_then(|text| text.parse::<f64>().ok()) {
            // Adding 0 makes -0 and 0 one place.
            Some(number) => value.extend((number + 0.0).to_bits().to_le_bytes()),
            None => value.extend(text),
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::Textures;

    fn seams(records: &str) -> Vec<[u32; 2]> {
        Textures::read(records.as_bytes()).seams(&[[0, 1, 2], [3, 2, 1]])
    }

    #[test]
    fn places_part_by_their_values() {
        let coordinates = "vt 0 0\nvt 1 0\nvt 0 1\nvt 1.0 0\nvt 5 5\n";
        assert_eq!(seams(&format!("{coordinates}f 1/1 2/2 3/3\nf 4/1 3/3 2/-2\n")), [[0; 2]; 0]);
        assert_eq!(seams(&format!("{coordinates}f 1/1 2/2 3/3\nf 4/1 3/3 2/5\n")), [[1, 2]]);
        assert_eq!(seams(&format!("{coordinates}f 1/1 2/2 3/3\nf 4 3 2\n")), [[1, 2]]);
    }

    #[test]
    fn materials_and_groups_part() {
        assert_eq!(seams("f 1 2 3\nusemtl a\nf 4 3 2\n"), [[1, 2]]);
        assert_eq!(seams("g a b\nf 1 2 3\ng a  b # again\nf 4 3 2\n"), [[0; 2]; 0]);
    }
}
