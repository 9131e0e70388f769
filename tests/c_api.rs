//! C and C++ programs against the header and both libraries, as a host would build them.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const WARNINGS: [&str; 4] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"];
const C89: &[&str] = &["-x", "c", "-std=c89"];
const CPP17: &[&str] = &["-x", "c++", "-std=c++17"];

/// Compilers to use where they are installed; the first of each has to be.
const C_COMPILERS: [&str; 3] = ["cc", "gcc", "clang"];
const CPP_COMPILERS: [&str; 3] = ["c++", "g++", "clang++"];

/// What the static library needs beside itself.
const NATIVE_LIBRARIES: &[&str] =
    if cfg!(target_os = "linux") { &["-lgcc_s", "-lpthread", "-ldl", "-lm", "-lc"] } else { &["-lm"] };

#[derive(Clone, Copy, Debug)]
enum Linkage {
    Shared,
    Static,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Where the programs' own library was built: cargo puts all kinds of it beside the integration tests.
fn library_folder() -> PathBuf {
    let this_test = std::env::current_exe().expect("a test knows where it is");
    this_test.parent().expect("a file is in a folder").to_path_buf()
}

fn on_path(program: &str) -> Option<PathBuf> {
    let path: OsString = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|folder| folder.join(program)).find(|candidate| candidate.is_file())
}

/// Every installed compiler once, whatever names it goes by.
fn compilers(names: [&'static str; 3]) -> Vec<&'static str> {
    assert!(on_path(names[0]).is_some(), "the tests of the C interface need a compiler by the name of {}", names[0]);
    let mut seen = BTreeSet::new();
    let is_new = |name: &&str| on_path(name).is_some_and(|found| seen.insert(found.canonicalize().unwrap_or(found)));
    names.into_iter().filter(is_new).collect()
}

fn link_arguments(linkage: Linkage) -> Vec<OsString> {
    let folder = library_folder();
    let mut arguments: Vec<OsString> = match linkage {
        Linkage::Shared => {
            let mut run_path = OsString::from("-Wl,-rpath,");
            run_path.push(&folder);
            vec!["-L".into(), folder.into(), "-lqsmesh".into(), run_path, "-lm".into()]
        }
        Linkage::Static => vec![folder.join("libqsmesh.a").into()],
    };
    if matches!(linkage, Linkage::Static) {
        arguments.extend(NATIVE_LIBRARIES.iter().map(OsString::from));
    }
    arguments
}

/// Compiles the sources into a program in `folder`.
fn build(folder: &Path, compiler: &str, dialect: &[&str], sources: &[&str], linkage: Linkage) -> PathBuf {
    let program = folder.join("program");
    let output = Command::new(compiler)
        .args(dialect)
        .args(WARNINGS)
        .arg(concat!("-DEXPECTED_VERSION=\"", env!("CARGO_PKG_VERSION"), "\""))
        .arg("-I")
        .arg(root().join("include"))
        .args(sources.iter().map(|source| root().join(source)))
        .args(["-x", "none", "-o"])
        .arg(&program)
        .args(link_arguments(linkage))
        .output()
        .expect("the compiler starts");
    succeed(&output, &format!("{compiler} {dialect:?} {sources:?}"));
    program
}

fn succeed(output: &Output, what: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{what}: {}\n{said}", output.status);
}

/// A command that finds the shared library where the program was told to look: cargo's own search path, which names
/// older builds too, would come first.
fn host(program: impl AsRef<std::ffi::OsStr>) -> Command {
    let mut command = Command::new(program);
    command.env_remove("LD_LIBRARY_PATH").env_remove("DYLD_FALLBACK_LIBRARY_PATH");
    command
}

/// Builds and runs the sources with every compiler and both libraries; returns what the last run printed.
fn run_everywhere(names: [&'static str; 3], dialect: &[&str], sources: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut printed = String::new();
    for compiler in compilers(names) {
        for linkage in [Linkage::Shared, Linkage::Static] {
            let program = build(folder.path(), compiler, dialect, sources, linkage);
            let output = host(program).output().expect("the program starts");
            succeed(&output, &format!("{sources:?} by {compiler}, {linkage:?} library"));
            printed = String::from_utf8(output.stdout).expect("programs print text");
        }
    }
    printed
}

#[test]
fn c89_host_gets_what_the_header_says() {
    run_everywhere(C_COMPILERS, C89, &["tests/c/smooth_c89.c", "tests/c/torus.c"]);
}

#[test]
fn c89_host_is_told_of_every_misuse() {
    run_everywhere(C_COMPILERS, C89, &["tests/c/misuse_c89.c", "tests/c/torus.c"]);
}

#[test]
fn c89_host_gets_smaller_meshes_and_where_they_came_from() {
    run_everywhere(C_COMPILERS, C89, &["tests/c/tails_c89.c", "tests/c/spoilt.c", "tests/c/torus.c"]);
}

#[test]
fn c89_host_is_told_of_every_misuse_with_tails() {
    run_everywhere(C_COMPILERS, C89, &["tests/c/tails_misuse_c89.c", "tests/c/spoilt.c", "tests/c/torus.c"]);
}

#[test]
#[cfg(unix)]
fn host_may_fork() {
    run_everywhere(C_COMPILERS, C89, &["tests/c/fork.c"]);
}

#[test]
fn cpp17_host_smooths_vertices_with_attributes() {
    run_everywhere(CPP_COMPILERS, CPP17, &["tests/c/smooth_cpp17.cpp", "tests/c/torus.c"]);
}

#[test]
fn c_programs_mean_the_same_in_cpp17() {
    run_everywhere(CPP_COMPILERS, CPP17, &["tests/c/smooth_c89.c", "tests/c/torus.c"]);
    run_everywhere(CPP_COMPILERS, CPP17, &["tests/c/misuse_c89.c", "tests/c/torus.c"]);
    run_everywhere(CPP_COMPILERS, CPP17, &["tests/c/tails_c89.c", "tests/c/spoilt.c", "tests/c/torus.c"]);
    run_everywhere(CPP_COMPILERS, CPP17, &["tests/c/tails_misuse_c89.c", "tests/c/spoilt.c", "tests/c/torus.c"]);
}

#[test]
fn example_moves_the_middle_vertex() {
    let printed = run_everywhere(C_COMPILERS, C89, &["examples/smooth.c"]);
    assert!(printed.starts_with("1 vertices moved, "), "it printed: {printed}");
}

#[test]
fn example_loses_a_vertex_and_keeps_its_colours() {
    let printed = run_everywhere(C_COMPILERS, C89, &["examples/improve.c"]);
    assert!(printed.starts_with("7 -> 6 vertices, 10 -> 8 triangles, 0 left"), "it printed: {printed}");
    assert!(printed.contains("vertex 0:  1.00  0.00  0.00, red\n"), "it printed: {printed}");
    assert!(printed.contains("triangle 7: 0 3 5, material 8\n"), "it printed: {printed}");
}

#[test]
fn memory_is_used_as_it_should_be() {
    if on_path("valgrind").is_none() {
        assert!(std::env::var_os("QSMESH_TESTS_REQUIRE_ALL").is_none(), "valgrind is missing");
        // Written past the test harness, which would swallow it.
        writeln!(std::io::stderr(), "SKIPPED: no valgrind, so the C programs' memory use goes unchecked").unwrap();
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let sources = ["smooth_c89.c", "misuse_c89.c", "tails_c89.c", "tails_misuse_c89.c"];
    for source in sources.map(|name| format!("tests/c/{name}")) {
        let linked = [source.as_str(), "tests/c/spoilt.c", "tests/c/torus.c"];
        let program = build(folder.path(), C_COMPILERS[0], C89, &linked, Linkage::Shared);
        let checked = ["--quiet", "--error-exitcode=9", "--leak-check=full", "--show-leak-kinds=definite"];
        let output = host("valgrind").args(checked).arg(program).output().expect("valgrind starts");
        succeed(&output, &format!("{source} under valgrind"));
    }
}
