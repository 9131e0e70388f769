//! What ends the command: one sentence for stderr.

use std::fmt;
use std::io;
use std::path::Path;

/// Result of everything that can end the command.
pub type Result<T> = std::result::Result<T, Failure>;

/// A sentence that names the offender; the command prints it and exits with code 1.
#[derive(Debug, PartialEq)]
pub struct Failure(String);

impl Failure {
    /// From a finished sentence.
    pub fn new(message: impl Into<String>) -> Self {
        Self(message.into())
    }

    /// For a place in a text file; lines count from 1.
    pub fn at_line(line: usize, message: impl fmt::Display) -> Self {
        Self(format!("line {line}: {message}"))
    }

    /// For a file that the system refused.
    pub fn of_path(path: &Path, error: &io::Error) -> Self {
        Self(format!("{}: {error}", path.display()))
    }

    /// The same failure, with the file it is about in front.
    pub fn in_file(self, path: &Path) -> Self {
        Self(format!("{}: {}", path.display(), self.0))
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self(error.to_string())
    }
}
