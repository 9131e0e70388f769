//! stdout for the result, stderr for everything else. A reader that has gone away is no reason to panic.

use std::fmt::Display;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use qsmesh::Flow;

use crate::failure::{Failure, Result};

/// Work shorter than this needs no progress bar.
const PATIENCE: Duration = Duration::from_millis(700);
/// Steps of the progress bar.
const STEPS: u64 = 1000;

/// Writes the result. A closed pipe is no failure: whoever reads has seen enough.
pub fn result(text: &impl Display) -> Result<()> {
    let mut out = io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::new(format!("standard output: {error}"))),
        _ => Ok(()),
    }
}

/// Tells the user something on stderr.
pub fn note(text: impl Display) {
    // Without a stderr there is nobody to tell.
    let _ = writeln!(io::stderr(), "note: {text}");
}

/// Says why the command ends.
pub fn complain(failure: &Failure) {
    let _ = writeln!(io::stderr(), "error: {failure}");
}

/// A progress bar that appears once the work turns out to be long, and only on a terminal.
pub struct Progress {
    wanted: bool,
    start: Instant,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// `quiet`: it never appears.
    pub fn new(quiet: bool) -> Self {
        Self { wanted: !quiet && io::stderr().is_terminal(), start: Instant::now(), bar: None }
    }

    /// For the library: `done` goes from 0 to 1.
    pub fn tell(&mut self, done: f64) -> Flow {
        if self.wanted && self.start.elapsed() > PATIENCE {
            self.bar.get_or_insert_with(new_bar).set_position((done * STEPS as f64) as u64);
        }
        Flow::Continue
    }

    /// Takes the bar off the screen.
    pub fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}

fn new_bar() -> ProgressBar {
    let bar = ProgressBar::new(STEPS);
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {percent:>3} %  {elapsed}") {
        bar.set_style(style);
    }
    bar
}
