//! Where a picture goes.

use std::io::Write;
use std::path::PathBuf;

use super::format::Format;
use super::picture::Picture;
use crate::failure::Result;
use crate::files::{Place, Staged};

/// `--plot`: a file name with a known extension.
#[derive(Debug, Clone)]
pub struct PlotFile {
    path: PathBuf,
    format: Format,
}

impl PlotFile {
    /// Fails where the extension is not known.
    pub fn new(path: PathBuf) -> std::result::Result<Self, String> {
        Ok(Self { format: Format::of(&path)?, path })
    }
}

/// A place for a picture, looked at before the work begins.
#[derive(Debug)]
pub struct Plot {
    place: Place,
    format: Format,
}

impl Plot {
    /// As [`Place::prepare`].
    pub fn prepare(file: &PlotFile) -> Result<Self> {
        Ok(Self { place: Place::prepare(&file.path)?, format: file.format })
    }

    /// Draws the picture into a file beside its place, where it waits.
    pub fn stage(&self, picture: &Picture<'_>) -> Result<Staged> {
        let bytes = match self.format {
            Format::Svg => picture.svg()?.into_bytes(),
            Format::Png => picture.png()?,
        };
        self.place.stage(|out| Ok(out.write_all(&bytes)?))
    }
}
