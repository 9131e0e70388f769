//! Lines and tokens of the text formats, as places in the file's bytes.

use std::ops::Range;
use std::str::FromStr;

use crate::failure::{Failure, Result};

/// One line without its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Where it lies.
    pub span: Range<usize>,
    /// Its end with the characters that end it.
    pub full_end: usize,
    /// Its number, from 1; where lines were joined, that of the first.
    pub number: usize,
}

/// Iterator over lines that end with LF, CR LF or CR.
pub struct Lines<'a> {
    source: &'a [u8],
    at: usize,
    number: usize,
    joining: bool,
}

impl<'a> Lines<'a> {
    /// From byte `start` on, which lies in line `number`.
    pub fn from(source: &'a [u8], start: usize, number: usize) -> Self {
        Self { source, at: start, number, joining: false }
    }

    /// From the start; a byte order mark is stepped over.
    pub fn of(source: &'a [u8]) -> Self {
        let start = if source.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        Self::from(source, start, 1)
    }

    /// A backslash at the end of a line joins it with the next, as in OBJ.
    pub fn joining(self) -> Self {
        Self { joining: true, ..self }
    }

    /// End of the physical line that holds byte `from`, without and with the characters that end it.
    fn end_of_line(&self, from: usize) -> (usize, usize) {
        let rest = &self.source[from..];
        let end = from + rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(rest.len());
        let width = match &self.source[end..] {
            [b'\r', b'\n', ..] => 2,
            [] => 0,
            _ => 1,
        };
        (end, end + width)
    }
}

impl Iterator for Lines<'_> {
    type Item = Line;

    fn next(&mut self) -> Option<Line> {
        if self.at >= self.source.len() {
            return None;
        }
        let (start, number) = (self.at, self.number);
        loop {
            let (end, full_end) = self.end_of_line(self.at);
            self.at = full_end;
            self.number += 1;
            let joined = self.joining && end > start && self.source[end - 1] == b'\\' && full_end < self.source.len();
            if !joined {
                return Some(Line { span: start..end, full_end, number });
            }
        }
    }
}

/// Tokens of a stretch of text, up to a comment that `#` begins.
pub fn tokens(source: &[u8], span: Range<usize>) -> impl Iterator<Item = Range<usize>> {
    let mut at = span.start;
    let end = span.end;
    std::iter::from_fn(move || {
        while at < end && is_space(source, at) {
            at += 1;
        }
        let start = at;
        if at < end && source[at] == b'#' {
            at = end;
            return None;
        }
        while at < end && !is_space(source, at) {
            at += 1;
        }
        (start < at).then_some(start..at)
    })
}

/// Whether the byte at `at` separates tokens; a backslash that joins two lines does.
fn is_space(source: &[u8], at: usize) -> bool {
    match source[at] {
        b' ' | b'\t' | b'\n' | b'\r' | 0x0B | 0x0C => true,
        b'\\' => matches!(source.get(at + 1), Some(b'\n' | b'\r')),
        _ => false,
    }
}

/// A number written at `span`, or what is wrong with it.
pub fn number<T: FromStr>(source: &[u8], span: Range<usize>, line: usize) -> Result<T> {
    let text = String::from_utf8_lossy(&source[span]);
    text.parse().map_err(|_| Failure::at_line(line, format!("`{}` is not a number of the kind expected", brief(&text))))
}

/// `text` is an integer written in a file; its text for `value`, which is the same text if it says that already.
pub fn integer_text(text: &[u8], value: i64) -> Vec<u8> {
    let same = std::str::from_utf8(text).ok().and_then(|text| text.parse::<i64>().ok()) == Some(value);
    if same { text.to_vec() } else { value.to_string().into_bytes() }
}

/// Whole lines one after the other; where the last line of a file is repeated, it may lack its end.
pub fn joined_lines(lines: Vec<Vec<u8>>) -> Vec<u8> {
    let mut all: Vec<u8> = Vec::new();
    for line in lines {
        if all.last().is_some_and(|end| !matches!(end, b'\n' | b'\r')) {
            all.push(b'\n');
        }
        all.extend(line);
    }
    all
}

/// Enough of a token to find it by.
pub fn brief(text: &str) -> String {
    let mut short: String = text.chars().take(24).map(|c| if c.is_control() { '?' } else { c }).collect();
    if text.chars().nth(24).is_some() {
        short.push('…');
    }
    short
}

/// The bytes of a text file, or why they cannot be one.
pub fn require_text(source: &[u8]) -> Result<()> {
    if source.is_empty() {
        return Err(Failure::new("the file is empty"));
    }
    match source.iter().position(|&b| b == 0) {
        Some(at) => Err(Failure::new(format!("byte {at} is 0: this is not a text file"))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Lines, integer_text, joined_lines, number, tokens};

    fn words(source: &[u8]) -> Vec<(usize, Vec<String>)> {
        let word = |span| String::from_utf8_lossy(&source[span]).into_owned();
        Lines::of(source).joining().map(|l| (l.number, tokens(source, l.span).map(word).collect())).collect()
    }

    #[test]
    fn every_kind_of_line_end_counts_once() {
        let numbers: Vec<_> = Lines::of(b"a\nb\r\nc\rd\n\ne").map(|line| (line.number, line.span)).collect();
        assert_eq!(numbers, [(1, 0..1), (2, 2..3), (3, 5..6), (4, 7..8), (5, 9..9), (6, 10..11)]);
    }

    #[test]
    fn joined_lines_keep_the_number_of_the_first() {
        let lines = words(b"\xEF\xBB\xBFf 1 \\\n 2 3\\\r\n4\nv # no\n#all\\");
        let expected = [(1, vec!["f", "1", "2", "3", "4"]), (4, vec!["v"]), (5, vec![])];
        assert_eq!(lines, expected.map(|(n, w)| (n, w.into_iter().map(String::from).collect::<Vec<_>>())));
    }

    #[test]
    fn integers_keep_their_spelling() {
        assert_eq!(integer_text(b"+07", 7), b"+07");
        assert_eq!(integer_text(b"+07", 6), b"6");
    }

    #[test]
    fn a_last_line_without_end_can_be_repeated() {
        assert_eq!(joined_lines(vec![b"a".to_vec(), b"b".to_vec()]), b"a\nb");
        assert_eq!(joined_lines(vec![b"a\r\n".to_vec(), b"b\r\n".to_vec()]), b"a\r\nb\r\n");
    }

    #[test]
    fn numbers_that_are_not_finite_are_numbers() {
        assert!(number::<f64>(b"nan", 0..3, 1).unwrap().is_nan());
        assert_eq!(number::<f64>(b"-inf", 0..4, 1).unwrap(), f64::NEG_INFINITY);
        let failure = number::<f64>(b"1,5", 0..3, 7).unwrap_err().to_string();
        assert_eq!(failure, "line 7: `1,5` is not a number of the kind expected");
    }
}
