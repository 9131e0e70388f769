//! Corners of faces and other references to vertices, as they are written.

use crate::files::text::integer_text;

/// An index counted from 0; written ones count from 1, or back from the last of `so_far` if negative.
pub fn zero_based(text: &[u8], so_far: usize) -> Option<i64> {
    let index: i64 = std::str::from_utf8(text).ok()?.parse().ok()?;
    match index {
        0 => None,
        1.. => Some(index - 1),
        // A vertex before the first one comes out negative and is refused with its face.
        _ => index.checked_add(i64::try_from(so_far).ok()?),
    }
}

/// `text` is a written index; its text for record `index` (from 0) where `so_far` of them come before. It keeps its
/// sign where it can, and its spelling where it says that already.
pub fn reindexed(text: &[u8], index: usize, so_far: usize) -> Vec<u8> {
    let value = if text.starts_with(b"-") && index < so_far { -((so_far - index) as i64) } else { index as i64 + 1 };
    integer_text(text, value)
}

/// The parts of `v`, `v/vt`, `v//vn` or `v/vt/vn`; a part that is not there is empty.
pub fn parts(text: &[u8]) -> [&[u8]; 3] {
    let mut parts = text.split(|&b| b == b'/');
    [(); 3].map(|()| parts.next().unwrap_or_default())
}

/// A corner of these parts; `text`, which may end in idle slashes, if they are its own.
pub fn composed(text: &[u8], new: [&[u8]; 3]) -> Vec<u8> {
    let [vertex, texture, normal] = new;
    if parts(text) == new {
        text.to_vec()
    } else if !normal.is_empty() {
        [vertex, texture, normal].join(&b'/')
    } else if !texture.is_empty() {
        [vertex, texture].join(&b'/')
    } else {
        vertex.to_vec()
    }
}

#[cfg(test)]
mod tests {
    use super::{composed, reindexed};

    #[test]
    fn indices_keep_sign_and_spelling() {
        assert_eq!(reindexed(b"007", 6, 9), b"007");
        assert_eq!(reindexed(b"7", 5, 9), b"6");
        assert_eq!(reindexed(b"-3", 6, 9), b"-3");
        assert_eq!(reindexed(b"-3", 6, 8), b"-2");
        // Nothing counts back to a vertex that is yet to come.
        assert_eq!(reindexed(b"-3", 8, 8), b"9");
    }

    #[test]
    fn missing_parts_take_their_slashes_along() {
        assert_eq!(composed(b"1//3", [b"1", b"", b""]), b"1");
        assert_eq!(composed(b"1/2/3", [b"1", b"2", b""]), b"1/2");
        assert_eq!(composed(b"1", [b"2", b"", b"4"]), b"2//4");
        assert_eq!(composed(b"1/", [b"1", b"", b""]), b"1/");
    }
}
