//! The whole picture: a title and three histograms side by side.

use plotters::coord::Shift;
use plotters::prelude::{BitMapBackend, DrawingArea, DrawingBackend, IntoDrawingArea, SVGBackend};
use plotters::style::WHITE;

use super::bins::Scale;
use super::look::{Look, SIZE, TITLE};
use super::panel::Panel;
use super::state::State;
use crate::failure::{Failure, Result};

/// Pixels a unit in PNG: enough for print in a column.
const PNG_SCALE: u32 = 2;
/// More of a title would not fit.
const TITLE_LENGTH: usize = 100;

/// What is drawn.
pub struct Picture<'a> {
    title: String,
    panels: [Panel<'a>; 3],
}

impl<'a> Picture<'a> {
    /// The histograms of one or two states on the same axes.
    pub fn new(title: &str, states: &'a [State<'a>]) -> Result<Self> {
        let measurements = || states.iter().map(|state| state.measurement);
        let scales = [Scale::of_edge_ratio(measurements()), Scale::of_min_angle(), Scale::of_max_angle()];
        let [ratio, small, large] = scales.map(|scale| Panel::new(scale, states));
        Ok(Self { title: fitting(title), panels: [ratio?, small?, large?] })
    }

    /// As the text of an SVG file.
    pub fn svg(&self) -> Result<String> {
        let mut text = String::new();
        let area = SVGBackend::with_string(&mut text, (SIZE[0], SIZE[1])).into_drawing_area();
        self.draw(&area, Look::new(1)?)?;
        drop(area);
        Ok(text)
    }

    /// As the bytes of a PNG file.
    pub fn png(&self) -> Result<Vec<u8>> {
        let look = Look::new(PNG_SCALE)?;
        let [width, height] = SIZE.map(|units| look.size(units));
        let mut pixels = vec![0; (3 * width * height) as usize];
        let area = BitMapBackend::with_buffer(&mut pixels, (width, height)).into_drawing_area();
        self.draw(&area, look)?;
        drop(area);
        encoded(&pixels, width, height).map_err(|error| Failure::new(format!("the plot cannot be encoded: {error}")))
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, look: Look) -> Result<()> {
        let drawn = || {
            area.fill(&WHITE)?;
            let (title, rest) = area.split_vertically(look.size(TITLE));
            title.draw_text(&self.title, &look.text(22), (look.pixels(24), look.pixels(18)))?;
            for (panel, part) in self.panels.iter().zip(rest.split_evenly((1, self.panels.len()))) {
                panel.draw(&part, look)?;
            }
            area.present()
        };
        drawn().map_err(|error| Failure::new(format!("the plot cannot be drawn: {error}")))
    }
}

/// One line that fits: SVG knows no control characters.
fn fitting(title: &str) -> String {
    let clean = title.chars().map(|c| if c.is_control() { '?' } else { c });
    let mut short: String = clean.take(TITLE_LENGTH).collect();
    if title.chars().nth(TITLE_LENGTH).is_some() {
        short.push('…');
    }
    short
}

fn encoded(pixels: &[u8], width: u32, height: u32) -> std::result::Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}
