//! Any bytes as a file in OBJ.
#![no_main]

use libfuzzer_sys::fuzz_target;
use qsmesh_fuzz::files::obj;
use qsmesh_fuzz::round_trip::{Format, check};

const OBJ: Format<obj::Carrier> = Format {
    read: obj::read,
    write: |carrier, out, old, new, faces| carrier.write(out, old, new, faces),
    seams: |carrier, faces| Ok(carrier.seams(faces)),
    keeps_bytes: |_| true,
};

fuzz_target!(|bytes: &[u8]| check(&OBJ, bytes));
