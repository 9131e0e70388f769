//! The rows of a payload one after the other, each as the places of its values.

use std::ops::Range;

use ply_rs_bw::ply::{Encoding, PropertyType, ScalarType};

use super::layout::{Element, Layout};
use super::numbers::{integer, width};
use crate::failure::{Failure, Result};
use crate::files::text::{Line, Lines, brief, tokens};

/// Places of the values of one row.
#[derive(Clone, Default)]
pub struct Row {
    /// Line of the file, from 1; `None` in the binary encodings.
    pub line: Option<usize>,
    /// All of it, with the end of its line.
    pub whole: Range<usize>,
    /// Where the last declared value ends; in text more may follow on the line.
    pub end: usize,
    values: Vec<Range<usize>>,
    starts: Vec<usize>,
}

impl Row {
    /// Values of a property: one, or those of its list without their count.
    pub fn of(&self, property: usize) -> &[Range<usize>] {
        &self.values[self.starts[property]..self.starts[property + 1]]
    }

    /// The line as the beginning of a message.
    pub fn place(&self) -> String {
        self.line.map_or_else(String::new, |line| format!("line {line}: "))
    }

    /// For a value that cannot be read.
    pub fn not_a_number(&self, bytes: &[u8], span: Range<usize>) -> Failure {
        let text = brief(&String::from_utf8_lossy(&bytes[span]));
        Failure::new(format!("{}`{text}` is not a number of the kind declared", self.place()))
    }

    fn clear(&mut self, line: Option<usize>) {
        self.line = line;
        self.values.clear();
        self.starts.clear();
        self.starts.push(0);
    }

    fn close_property(&mut self) {
        self.starts.push(self.values.len());
    }
}

/// Calls `visit` with the element's number and the row, for every row. Nothing is allocated by what the header claims.
pub fn walk(bytes: &[u8], layout: &Layout, mut visit: impl FnMut(usize, &Row) -> Result<()>) -> Result<()> {
    let mut source = Source::new(bytes, layout);
    let mut row = Row::default();
    for (number, element) in layout.elements.iter().enumerate() {
        // Rows without properties take no room, so the claim about their number cannot be checked and doesn't matter.
        let count = if element.properties.is_empty() { 0 } else { element.count };
        for done in 0..count {
            if !source.next(element, &mut row)? {
                let claim = format!("{count} rows of element `{}` are declared", element.name);
                return Err(Failure::new(format!("the file ends too early: {claim}, but only {done} are there")));
            }
            visit(number, &row)?;
        }
    }
    Ok(())
}

/// Where the next row is taken from.
enum Source<'a> {
    Text { bytes: &'a [u8], lines: Lines<'a> },
    Binary { bytes: &'a [u8], at: usize, encoding: Encoding },
}

impl<'a> Source<'a> {
    fn new(bytes: &'a [u8], layout: &Layout) -> Self {
        match layout.encoding {
            Encoding::Ascii => Self::Text { bytes, lines: Lines::from(bytes, layout.payload, layout.payload_line) },
            encoding => Self::Binary { bytes, at: layout.payload, encoding },
        }
    }

    /// Reads a row; false at the end of the file.
    fn next(&mut self, element: &Element, row: &mut Row) -> Result<bool> {
        match self {
            Self::Text { bytes, lines } => {
                let Some(line) = lines.find(|line| !bytes[line.span.clone()].trim_ascii().is_empty()) else {
                    return Ok(false);
                };
                read_line(bytes, line, element, row)?;
                Ok(true)
            }
            Self::Binary { bytes, at, encoding } => {
                row.clear(None);
                let start = *at;
                for property in &element.properties {
                    if !read_property(bytes, at, *encoding, &property.kind, row)? {
                        return Ok(false);
                    }
                }
                row.whole = start..*at;
                row.end = *at;
                Ok(true)
            }
        }
    }
}

fn read_line(bytes: &[u8], line: Line, element: &Element, row: &mut Row) -> Result<()> {
    row.clear(Some(line.number));
    row.whole = line.span.start..line.full_end;
    let mut end = line.span.start;
    let mut tokens = tokens(bytes, line.span).inspect(|token| end = token.end);
    let missing = |name: &str| Failure::at_line(line.number, format!("the value of property `{name}` is missing"));
    for property in &element.properties {
        let mut count = 1;
        if let PropertyType::List(kind, _) = &property.kind {
            let span = tokens.next().ok_or_else(|| missing(&property.name))?;
            let found = integer(kind, Encoding::Ascii, &bytes[span.clone()]);
            count = found.filter(|&count| count >= 0).ok_or_else(|| row.not_a_number(bytes, span))?;
        }
        for _ in 0..count {
            row.values.push(tokens.next().ok_or_else(|| missing(&property.name))?);
        }
        row.close_property();
    }
    drop(tokens);
    row.end = end;
    Ok(())
}

/// Steps over the values of one property; false at the end of the file.
fn read_property(bytes: &[u8], at: &mut usize, encoding: Encoding, kind: &PropertyType, row: &mut Row) -> Result<bool> {
    let (count, item) = match kind {
        PropertyType::Scalar(item) => (1, item),
        PropertyType::List(counter, item) => match read_count(bytes, at, encoding, counter)? {
            Some(count) => (count, item),
            None => return Ok(false),
        },
    };
    let width = width(item);
    if count > (bytes.len() - *at) / width {
        return Ok(false);
    }
    row.values.extend((0..count).map(|k| *at + k * width..*at + (k + 1) * width));
    *at += count * width;
    row.close_property();
    Ok(true)
}

fn read_count(bytes: &[u8], at: &mut usize, encoding: Encoding, kind: &ScalarType) -> Result<Option<usize>> {
    let Some(span) = bytes.get(*at..*at + width(kind)) else { return Ok(None) };
    let count = integer(kind, encoding, span).and_then(|count| usize::try_from(count).ok());
    let count =
        count.ok_or_else(|| Failure::new(format!("byte {at}: the length of a list is negative or no integer")))?;
    *at += width(kind);
    Ok(Some(count))
}
