//! Any bytes as a file in STL.
#![no_main]

use libfuzzer_sys::fuzz_target;
use qsmesh_fuzz::files::stl;
use qsmesh_fuzz::round_trip::{Format, check};

const STL: Format<stl::Carrier> = Format {
    read: stl::read,
    write: |carrier, out, old, new, faces| carrier.write(out, old, new, faces),
    seams: |_, _| Ok(vec![]),
    keeps_bytes: is_binary,
};

fuzz_target!(|bytes: &[u8]| check(&STL, bytes));

/// A file in ASCII is written as a binary one.
fn is_binary(bytes: &[u8]) -> bool {
    let count = bytes.get(80..84).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    count.is_some_and(|count| bytes.len() == 84 + 50 * count as usize)
}
