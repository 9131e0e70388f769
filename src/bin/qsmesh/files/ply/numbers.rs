//! One number of a payload: from bytes and to bytes.

use ply_rs_bw::ply::{Encoding, ScalarType};

use crate::files::positions::Stored;
use crate::files::text::integer_text;

/// A number with a fixed width in the binary encodings.
pub trait Binary: Sized {
    /// From exactly as many bytes as it has.
    fn from_little_endian(bytes: &[u8]) -> Option<Self>;
    /// Its bytes.
    fn to_little_endian(self) -> Vec<u8>;
}

impl Binary for f32 {
    fn from_little_endian(bytes: &[u8]) -> Option<Self> {
        Some(Self::from_le_bytes(bytes.try_into().ok()?))
    }
    fn to_little_endian(self) -> Vec<u8> {
        self.to_le_bytes().to_vec()
    }
}

impl Binary for f64 {
    fn from_little_endian(bytes: &[u8]) -> Option<Self> {
        Some(Self::from_le_bytes(bytes.try_into().ok()?))
    }
    fn to_little_endian(self) -> Vec<u8> {
        self.to_le_bytes().to_vec()
    }
}

/// Bytes that one value takes in the binary encodings.
pub fn width(kind: &ScalarType) -> usize {
    match kind {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

/// A coordinate; `None` if the text is no number.
pub fn number<T: Stored + Binary>(encoding: Encoding, bytes: &[u8]) -> Option<T> {
    match encoding {
        Encoding::Ascii => std::str::from_utf8(bytes).ok()?.parse().ok(),
        _ => T::from_little_endian(little(encoding, bytes).get(..bytes.len())?),
    }
}

/// An index or a count; `None` if it is none.
pub fn integer(kind: &ScalarType, encoding: Encoding, bytes: &[u8]) -> Option<i64> {
    if encoding == Encoding::Ascii {
        return std::str::from_utf8(bytes).ok()?.parse().ok();
    }
    // Bytes past the value are 0, so the unsigned kinds can be read as the widest integer.
    let wide = u64::from_le_bytes(little(encoding, bytes));
    match kind {
        ScalarType::Char => Some(i64::from(wide as i8)),
        ScalarType::Short => Some(i64::from(wide as i16)),
        ScalarType::Int => Some(i64::from(wide as i32)),
        ScalarType::UChar | ScalarType::UShort | ScalarType::UInt => i64::try_from(wide).ok(),
        ScalarType::Float | ScalarType::Double => None,
    }
}

/// A floating-point value as the payload holds it.
pub fn written<T: Stored + Binary>(encoding: Encoding, value: T) -> Vec<u8> {
    let little = |value: T| value.to_little_endian();
    match encoding {
        Encoding::Ascii => format!("{value:?}").into_bytes(),
        Encoding::BinaryLittleEndian => little(value),
        Encoding::BinaryBigEndian => little(value).into_iter().rev().collect(),
    }
}

/// An index or a count in the place of `now`, which stays as it is if it says that already.
pub fn written_integer(kind: &ScalarType, encoding: Encoding, now: &[u8], value: usize) -> Vec<u8> {
    if encoding == Encoding::Ascii {
        return integer_text(now, value as i64);
    }
    // A new number of a vertex is never above its former one, so no byte that is cut off holds anything.
    let mut bytes = (value as u64).to_le_bytes()[..width(kind)].to_vec();
    if encoding == Encoding::BinaryBigEndian {
        bytes.reverse();
    }
    bytes
}

/// At most eight bytes in little-endian order, filled up with 0.
fn little(encoding: Encoding, bytes: &[u8]) -> [u8; 8] {
    let mut all = [0; 8];
    for (place, &byte) in all.iter_mut().zip(bytes) {
        *place = byte;
    }
    if encoding == Encoding::BinaryBigEndian {
        all[..bytes.len().min(8)].reverse();
    }
    all
}

#[cfg(test)]
mod tests {
    use super::{Encoding, ScalarType, integer, number, written, written_integer};

    #[test]
    fn signed_and_unsigned_in_both_byte_orders() {
        let (big, little) = (Encoding::BinaryBigEndian, Encoding::BinaryLittleEndian);
        assert_eq!(integer(&ScalarType::Char, little, &[0xFF]), Some(-1));
        assert_eq!(integer(&ScalarType::UChar, big, &[0xFF]), Some(255));
        assert_eq!(integer(&ScalarType::Short, big, &[0xFF, 0xFE]), Some(-2));
        assert_eq!(integer(&ScalarType::UShort, little, &[0x01, 0x02]), Some(0x201));
        assert_eq!(integer(&ScalarType::Int, big, &[0, 0, 1, 2]), Some(0x102));
        assert_eq!(integer(&ScalarType::UInt, little, &[0xFF; 4]), Some(i64::from(u32::MAX)));
        assert_eq!(integer(&ScalarType::Double, little, &[0; 8]), None);
    }

    #[test]
    fn what_is_written_reads_back() {
        for encoding in [Encoding::Ascii, Encoding::BinaryBigEndian, Encoding::BinaryLittleEndian] {
            assert_eq!(number::<f32>(encoding, &written(encoding, 0.1_f32)), Some(0.1));
            assert_eq!(number::<f64>(encoding, &written(encoding, -1e-300)), Some(-1e-300));
        }
    }

    #[test]
    fn indices_are_written_in_their_width_and_order() {
        let index = |kind, encoding| written_integer(&kind, encoding, b"0", 0x102);
        assert_eq!(index(ScalarType::UShort, Encoding::BinaryBigEndian), [1, 2]);
        assert_eq!(index(ScalarType::Int, Encoding::BinaryLittleEndian), [2, 1, 0, 0]);
        assert_eq!(index(ScalarType::Int, Encoding::Ascii), b"258");
    }

    #[test]
    fn ascii_numbers_may_lack_digits() {
        assert_eq!(number::<f64>(Encoding::Ascii, b".5"), Some(0.5));
        assert_eq!(number::<f64>(Encoding::Ascii, b"5."), Some(5.0));
        assert!(number::<f32>(Encoding::Ascii, b"nan").is_some_and(f32::is_nan));
        assert_eq!(number::<f64>(Encoding::Ascii, b"five"), None);
    }
}
