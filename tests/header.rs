//! The committed C header is the one that the sources describe.

use std::path::Path;

/// Files of the C interface, in the order in which their items are to stand in the header.
const SOURCES: [&str; 5] = ["status.rs", "options.rs", "report.rs", "maps.rs", "mod.rs"];

fn generated() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).expect("cbindgen.toml can be read");
    let builder = SOURCES.iter().fold(cbindgen::Builder::new().with_config(config), |builder, file| {
        builder.with_src(root.join("src/ffi").join(file))
    });
    let mut header = Vec::new();
    builder.generate().expect("the sources describe a header").write(&mut header);
    String::from_utf8(header).expect("a header is text")
}

#[test]
fn committed_header_is_up_to_date() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/qsmesh.h");
    let expected = generated();
    if std::env::var_os("QSMESH_WRITE_HEADER").is_some() {
        std::fs::write(&path, expected).expect("the header can be written");
        return;
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        committed == expected,
        "include/qsmesh.h is not what src/ffi describes; write it anew with\n    \
         QSMESH_WRITE_HEADER=1 cargo test --test header"
    );
}
