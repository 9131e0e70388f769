//! Any bytes as a file in OFF.
#![no_main]

use libfuzzer_sys::fuzz_target;
use qsmesh_fuzz::files::off;
use qsmesh_fuzz::round_trip::{Format, check};

const OFF: Format<off::Carrier> = Format {
    read: off::read,
    write: |carrier, out, old, new, faces| carrier.write(out, old, new, faces),
    seams: |_, _| Ok(vec![]),
    keeps_bytes: |_| true,
};

fuzz_target!(|bytes: &[u8]| check(&OFF, bytes));
