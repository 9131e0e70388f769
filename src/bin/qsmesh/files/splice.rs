//! A copy of a file's bytes in which some stretches are replaced.

use std::io::{self, Write};
use std::ops::Range;

/// Copies `source` to `out`, but for the stretches that are replaced; these must come in rising order.
pub struct Splice<'a, W: Write> {
    source: &'a [u8],
    done: usize,
    out: W,
}

impl<'a, W: Write> Splice<'a, W> {
    /// Nothing is copied yet.
    pub fn new(source: &'a [u8], out: W) -> Self {
        Self { source, done: 0, out }
    }

    /// Copies up to `span` and writes `new` in its place.
    pub fn replace(&mut self, span: Range<usize>, new: &[u8]) -> io::Result<()> {
        self.out.write_all(&self.source[self.done..span.start])?;
        self.out.write_all(new)?;
        self.done = span.end;
        Ok(())
    }

    /// Copies the rest.
    pub fn finish(mut self) -> io::Result<()> {
        self.out.write_all(&self.source[self.done..])
    }
}

/// New content for a stretch of bytes.
pub type Change = (Range<usize>, Vec<u8>);

/// The bytes at `span` with these changes, which lie in it in rising order.
pub fn changed(source: &[u8], span: Range<usize>, changes: &[Change]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(span.len());
    let mut done = span.start;
    for (place, new) in changes {
        bytes.extend_from_slice(&source[done..place.start]);
        bytes.extend_from_slice(new);
        done = place.end;
    }
    bytes.extend_from_slice(&source[done..span.end]);
    bytes
}

#[cfg(test)]
mod tests {
    use super::{Splice, changed};

    #[test]
    fn a_stretch_is_copied_with_its_changes() {
        let changes = [(4..7, b"2".to_vec()), (8..8, b"more ".to_vec())];
        assert_eq!(changed(b"one two three four", 4..13, &changes), b"2 more three");
    }

    #[test]
    fn the_rest_is_copied_byte_for_byte() {
        let mut out = Vec::new();
        let mut splice = Splice::new(b"one two three", &mut out);
        splice.replace(0..3, b"1").unwrap();
        splice.replace(4..8, b"").unwrap();
        splice.finish().unwrap();
        assert_eq!(out, b"1 three");
    }
}
