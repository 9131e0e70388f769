//! Where a mesh goes.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use super::{Format, Place};
use crate::failure::Result;

/// A place for a mesh file, looked at before the work begins.
#[derive(Debug)]
pub struct Target {
    place: Place,
    format: Format,
}

impl Target {
    /// Looks at `path`: its format must be known, besides what [`Place::prepare`] asks.
    pub fn prepare(path: &Path) -> Result<Self> {
        let format = Format::of(path)?;
        Ok(Self { place: Place::prepare(path)?, format })
    }

    /// What the file is to hold.
    pub fn format(&self) -> Format {
        self.format
    }

    /// Where the file goes.
    pub fn path(&self) -> &Path {
        self.place.path()
    }

    /// As [`Place::write`].
    pub fn write(&self, content: impl FnOnce(&mut BufWriter<&File>) -> Result<()>) -> Result<()> {
        self.place.write(content)
    }
}
