//! Any bytes as a file in PLY.
#![no_main]

use libfuzzer_sys::fuzz_target;
use qsmesh_fuzz::files::ply;
use qsmesh_fuzz::round_trip::{Format, check};

const PLY: Format<ply::Carrier> = Format {
    read: ply::read,
    write: |carrier, out, old, new, faces| carrier.write(out, old, new, faces, None),
    seams: ply::Carrier::seams,
    keeps_bytes: |_| true,
};

fuzz_target!(|bytes: &[u8]| check(&PLY, bytes));
