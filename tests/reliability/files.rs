//! The command where the machine lets it down: the old output stays as it was.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use tempfile::TempDir;

use crate::meshes::{Mesh, torus};

/// A folder with a mesh `in.off`, and something older in `out.off`.
fn folder(mesh: &Mesh) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let mut text = format!("OFF\n{} {} 0\n", mesh.0.len(), mesh.1.len());
    mesh.0.iter().for_each(|[x, y, z]| text += &format!("{x} {y} {z}\n"));
    mesh.1.iter().for_each(|[a, b, c]| text += &format!("3 {a} {b} {c}\n"));
    fs::write(folder.path().join("in.off"), text).expect("a file");
    fs::write(folder.path().join("out.off"), "old").expect("a file");
    folder
}

fn qsmesh(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_qsmesh"));
    command.args(arguments).current_dir(folder);
    command
}

fn assert_told(output: &Output, what: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.starts_with("error: ") && said.contains(what) && !said.contains("panicked"), "{said}");
}

fn names(folder: &Path) -> Vec<String> {
    let name =
        |entry: std::io::Result<fs::DirEntry>| entry.expect("an entry").file_name().to_string_lossy().into_owned();
    let mut names: Vec<_> = fs::read_dir(folder).expect("a folder").map(name).collect();
    names.sort();
    names
}

#[test]
fn a_file_that_outgrows_its_limit_leaves_the_old_one() {
    let folder = folder(&torus(40, 20, 0.3, 1));
    for subcommand in ["smooth", "improve"] {
        // One block; the signal that would end the process is ignored, as in programs that handle the error.
        let script = format!("ulimit -f 1; trap '' XFSZ; exec \"$0\" {subcommand} in.off -o out.off");
        let mut shell = Command::new("sh");
        shell.args(["-c", &script, env!("CARGO_BIN_EXE_qsmesh")]).current_dir(folder.path());
        assert_told(&shell.output().expect("a shell"), "out.off");
        assert_eq!(fs::read(folder.path().join("out.off")).expect("the old file"), b"old");
        assert_eq!(names(folder.path()), ["in.off", "out.off"]);
    }
}

#[test]
fn a_folder_in_which_nothing_can_be_made_is_named() {
    // Nobody can make a file there, not even who may do everything.
    if !Path::new("/proc/self").is_dir() {
        return;
    }
    let folder = folder(&torus(8, 6, 0.3, 1));
    let output = qsmesh(folder.path(), &["smooth", "in.off", "-o", "/proc/out.off"]).output().expect("a run");
    assert_told(&output, "/proc/out.off");
}

#[test]
fn a_full_device_behind_stdout_is_told_and_the_file_is_written() {
    let Ok(full) = fs::OpenOptions::new().write(true).open("/dev/full") else { return };
    let folder = folder(&torus(8, 6, 0.3, 1));
    let mut command = qsmesh(folder.path(), &["smooth", "in.off", "-o", "out.off", "--json"]);
    let output = command.stdout(Stdio::from(full)).output().expect("a run");
    assert_told(&output, "");
    assert!(fs::read(folder.path().join("out.off")).expect("a file").starts_with(b"OFF"));
}

#[test]
fn a_closed_stderr_is_no_failure() {
    let folder = folder(&torus(8, 6, 0.3, 1));
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let status = qsmesh(folder.path(), &["smooth", "in.off", "-o", "out.off"])
        .stderr(Stdio::from(writer))
        .stdout(Stdio::null())
        .status();
    assert_eq!(status.expect("a run").code(), Some(0));
}

#[test]
fn a_killed_run_leaves_the_old_file_or_the_whole_new_one() {
    let folder = folder(&torus(200, 100, 0.4, 1));
    let path = folder.path().join("out.off");
    let arguments = ["improve", "in.off", "-o", "out.off", "--quiet"];
    assert!(qsmesh(folder.path(), &arguments).status().expect("a run").success());
    let whole = fs::read(&path).expect("a file");
    for delay in [0, 2, 5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200] {
        fs::write(&path, "old").expect("a file");
        let mut run = qsmesh(folder.path(), &arguments).spawn().expect("a run");
        sleep(Duration::from_millis(delay));
        run.kill().expect("it can be ended, or has ended");
        run.wait().expect("an end");
        let found = fs::read(&path).expect("a file");
        assert!(found == b"old" || found == whole, "half a file after {delay} ms");
    }
}

#[test]
fn an_input_that_is_a_pipe_is_read_to_its_end() {
    let folder = folder(&torus(8, 6, 0.3, 1));
    let path = folder.path().join("pipe.off");
    let made = Command::new("mkfifo").arg(&path).status();
    if !made.is_ok_and(|status| status.success()) {
        return;
    }
    let run = qsmesh(folder.path(), &["measure", "pipe.off"]).stdout(Stdio::null()).stderr(Stdio::piped()).spawn();
    let text = fs::read(folder.path().join("in.off")).expect("a file");
    let mut pipe = fs::OpenOptions::new().write(true).open(&path).expect("a pipe");
    pipe.write_all(&text[..text.len() / 2]).expect("a reader");
    drop(pipe);
    assert_told(&run.expect("a run").wait_with_output().expect("an end"), "pipe.off");
}
