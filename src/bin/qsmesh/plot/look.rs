//! Sizes, colours and type of a picture.

use plotters::style::{Color, FontStyle, IntoFont, RGBColor, ShapeStyle, TextStyle, register_font};

use crate::failure::{Failure, Result};

/// Size of the picture in units.
pub const SIZE: [u32; 2] = [1620, 540];
/// Height of the title.
pub const TITLE: u32 = 48;
/// Height of the lines above a histogram.
pub const LEGEND: u32 = 104;
/// Height of one of them.
pub const LINE: i32 = 24;

// Orange and blue of Okabe and Ito's palette, which the colour-blind tell apart. In grey the one is a light area and the
// other a dark line.
const ORANGE: RGBColor = RGBColor(230, 159, 0);
const BLUE: RGBColor = RGBColor(0, 86, 140);
const INK: RGBColor = RGBColor(30, 30, 30);
const GRID: RGBColor = RGBColor(222, 222, 222);

/// Pixels a unit, and the styles that depend on it.
#[derive(Debug, Clone, Copy)]
pub struct Look {
    scale: u32,
}

impl Look {
    /// Makes the type known that sizes are computed by and that PNG is set in; DejaVu Sans is wide, so what other
    /// viewers of SVG take for `sans-serif` fits too.
    pub fn new(scale: u32) -> Result<Self> {
        register_font("sans-serif", FontStyle::Normal, dejavu::sans::regular())
            .map_err(|_| Failure::new("the type of the plots cannot be read"))?;
        Ok(Self { scale })
    }

    /// Pixels of so many units.
    pub fn pixels(self, units: i32) -> i32 {
        units * self.scale as i32
    }

    /// Pixels of so many units.
    pub fn size(self, units: u32) -> u32 {
        units * self.scale
    }

    /// Type of this height.
    pub fn text(self, height: u32) -> TextStyle<'static> {
        ("sans-serif", self.size(height)).into_font().color(&INK)
    }

    /// The area of the first state.
    pub fn area(self) -> ShapeStyle {
        ORANGE.mix(0.5).filled()
    }

    /// The outline of the first state.
    pub fn outline(self) -> ShapeStyle {
        ORANGE.stroke_width(self.scale)
    }

    /// The line of the second state.
    pub fn line(self) -> ShapeStyle {
        BLUE.stroke_width(2 * self.scale)
    }

    /// The axes.
    pub fn axis(self) -> ShapeStyle {
        INK.stroke_width(self.scale)
    }

    /// Lines behind the histogram.
    pub fn grid(self) -> ShapeStyle {
        GRID.stroke_width(self.scale)
    }
}
