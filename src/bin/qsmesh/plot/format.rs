//! The picture formats by name.

use std::path::Path;

/// A format that pictures are drawn in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Scalable Vector Graphics.
    Svg,
    /// Portable Network Graphics.
    Png,
}

impl Format {
    /// By the extension, whatever its case.
    pub fn of(path: &Path) -> Result<Self, String> {
        let extension = path.extension().map(|x| x.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("svg") => Ok(Self::Svg),
            Some("png") => Ok(Self::Png),
            _ => Err("plots are drawn as .svg or .png".to_string()),
        }
    }
}
