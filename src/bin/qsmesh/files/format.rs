//! The file formats by name.

use std::fmt;
use std::path::Path;

use crate::failure::{Failure, Result};

/// A format that can be read and written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Polygon File Format, in its three encodings.
    Ply,
    /// Wavefront OBJ.
    Obj,
    /// Object File Format.
    Off,
    /// Stereolithography, ASCII or binary.
    Stl,
}

impl Format {
    /// By the extension, whatever its case.
    pub fn of(path: &Path) -> Result<Self> {
        let extension = path.extension().map(|x| x.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("ply") => Ok(Self::Ply),
            Some("obj") => Ok(Self::Obj),
            Some("off") => Ok(Self::Off),
            Some("stl") => Ok(Self::Stl),
            Some(other) => Err(unknown(path, &format!("the format .{other} is not known"))),
            None => Err(unknown(path, "the name has no extension to tell the format by")),
        }
    }
}

fn unknown(path: &Path, what: &str) -> Failure {
    Failure::new(format!("{}: {what}; known are .ply, .obj, .off and .stl", path.display()))
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Ply => "PLY",
            Self::Obj => "OBJ",
            Self::Off => "OFF",
            Self::Stl => "STL",
        })
    }
}
