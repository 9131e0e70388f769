//! A temporary folder in which the command is run.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use tempfile::TempDir;

/// The folder; it goes when this goes.
pub struct Workspace {
    folder: TempDir,
}

/// What a run of the command left behind.
pub struct Run {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Workspace {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// With these files in it.
    pub fn with(files: &[(&str, &[u8])]) -> Self {
        let workspace = Self::new();
        for (name, bytes) in files {
            fs::write(workspace.path(name), bytes).unwrap();
        }
        workspace
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.bytes(name)).unwrap()
    }

    /// Names in the folder, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_qsmesh"));
        command.args(arguments).current_dir(self.folder.path());
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Run {
        let Output { status, stdout, stderr } = self.command(arguments).output().unwrap();
        let run = Run {
            code: status.code().expect("no exit code: ended by a signal"),
            stdout: String::from_utf8(stdout).unwrap(),
            stderr: String::from_utf8(stderr).unwrap(),
        };
        assert!(!run.stderr.contains("panicked"), "{}", run.stderr);
        run
    }

    /// A run that has to succeed.
    pub fn done(&self, arguments: &[&str]) -> Run {
        let run = self.run(arguments);
        assert_eq!(run.code, 0, "{arguments:?}: {}", run.stderr);
        run
    }

    /// A run that has to be refused with exit code 1 and nothing on stdout; its message.
    pub fn refused(&self, arguments: &[&str]) -> String {
        let before = self.names();
        let run = self.run(arguments);
        assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{arguments:?}: {}", run.stderr);
        assert_eq!(self.names(), before, "a refused run left a file behind");
        run.stderr
    }

    /// Smooths with `--json` and further arguments; the object.
    pub fn smooth(&self, input: &str, output: &str, more: &[&str]) -> serde_json::Value {
        self.report("smooth", input, output, more)
    }

    /// Runs a subcommand with `--json` and further arguments; the object.
    pub fn report(&self, subcommand: &str, input: &str, output: &str, more: &[&str]) -> serde_json::Value {
        let arguments = [&[subcommand, input, "-o", output, "--json"], more].concat();
        serde_json::from_str(&self.done(&arguments).stdout).unwrap()
    }
}
