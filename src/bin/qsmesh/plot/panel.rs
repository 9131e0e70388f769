//! One histogram with its legend and its axes.

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::element::{PathElement, Polygon, Rectangle};
use plotters::prelude::{DrawingArea, DrawingBackend};
use plotters::style::TRANSPARENT;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use qsmesh::{Distribution, Parameter};

use super::bins::{Bins, Scale};
use super::look::{LEGEND, LINE, Look};
use super::state::State;
use crate::failure::Result;

/// Height of the type of labels and of headings.
const SMALL: u32 = 16;
const LARGE: u32 = 18;
/// Space beside a histogram, and that of the labels of its vertical axis.
const MARGIN: u32 = 20;
const LABELS: u32 = 60;
/// Width of a sample in the legend.
const SAMPLE: i32 = 34;
/// Gap before the bar of what lies past the axis, the bar, and what follows, as shares of the axis.
const GAP: f64 = 0.06;
const BAR: f64 = 0.07;
const REST: f64 = 0.03;

type Drawn<B> = std::result::Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;
type Chart<'a, B> = ChartContext<'a, B, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// One state in one panel.
struct Curve<'a> {
    name: &'static str,
    figures: &'a Distribution,
    bins: Bins,
}

/// One quality parameter: the first state is an area, the second a line.
pub struct Panel<'a> {
    scale: Scale,
    curves: Vec<Curve<'a>>,
}

impl<'a> Panel<'a> {
    /// Counts the triangles of each state.
    pub fn new(scale: Scale, states: &'a [State<'a>]) -> Result<Self> {
        let curve = |state: &'a State<'a>| {
            Ok(Curve { name: state.name, figures: scale.distribution(state.measurement), bins: scale.bins(state)? })
        };
        Ok(Self { scale, curves: states.iter().map(curve).collect::<Result<_>>()? })
    }

    /// Draws it all over `area`.
    pub fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, look: Look) -> Drawn<B> {
        let (legend, rest) = area.split_vertically(look.size(LEGEND));
        self.draw_legend(&legend, look)?;
        let mut chart = ChartBuilder::on(&rest)
            .margin_left(look.size(MARGIN))
            .margin_right(look.size(MARGIN))
            .margin_bottom(look.size(8))
            .x_label_area_size(look.size(58))
            .y_label_area_size(look.size(LABELS))
            .build_cartesian_2d(self.scale.lower..self.right_end(), 0.0..self.highest())?;
        self.draw_axes(&mut chart, look)?;
        for (number, curve) in self.curves.iter().enumerate() {
            for outline in self.outlines(&curve.bins) {
                if number == 0 {
                    chart.draw_series([Polygon::new(outline.clone(), look.area())])?;
                    chart.draw_series([PathElement::new(outline, look.outline())])?;
                } else {
                    chart.draw_series([PathElement::new(outline, look.line())])?;
                }
            }
        }
        self.draw_bar_label(&chart, &rest, look)
    }

    fn draw_legend<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, look: Look) -> Drawn<B> {
        let at = |x: i32, y: i32| (look.pixels((MARGIN + LABELS) as i32 + x), look.pixels(y));
        area.draw_text(self.heading(), &look.text(LARGE), at(0, 2))?;
        let mut top = 2 + LINE;
        for (number, curve) in self.curves.iter().enumerate() {
            if number == 0 {
                let corners = [at(0, top), at(SAMPLE, top + 14)];
                area.draw(&Rectangle::new(corners, look.area()))?;
                area.draw(&Rectangle::new(corners, look.outline()))?;
            } else {
                area.draw(&PathElement::new([at(0, top + 7), at(SAMPLE, top + 7)], look.line()))?;
            }
            area.draw_text(&self.figures(curve), &look.text(SMALL), at(SAMPLE + 10, top))?;
            top += LINE;
        }
        match self.remark() {
            Some(remark) => area.draw_text(&remark, &look.text(SMALL), at(SAMPLE + 10, top)),
            None => Ok(()),
        }
    }

    fn heading(&self) -> &'static str {
        match self.scale.parameter {
            Parameter::EdgeRatio => "Edge ratio",
            Parameter::MinAngle => "Smallest angle",
            Parameter::MaxAngle => "Largest angle",
            Parameter::Shape => "Shape",
            Parameter::RadiusRatio => "Radius ratio",
        }
    }

    fn figures(&self, curve: &Curve<'_>) -> String {
        let Distribution { mean, variance, min, max, infinite, .. } = curve.figures;
        let name = curve.name;
        match self.scale.parameter {
            Parameter::MinAngle => format!("{name}: mean {mean:.2}°, variance {variance:.1}, least {min:.2}°"),
            Parameter::MaxAngle => format!("{name}: mean {mean:.2}°, variance {variance:.1}, greatest {max:.2}°"),
            _ if *infinite > 0 => format!("{name}: mean {mean:.3}, variance {variance:.3}, {infinite} infinite"),
            _ => format!("{name}: mean {mean:.3}, variance {variance:.3}, greatest {max:.2}"),
        }
    }

    /// What the histogram cannot show to scale.
    fn remark(&self) -> Option<String> {
        let told = |what: &str, shares: Vec<f64>| {
            let shares: Vec<_> =
                self.curves.iter().zip(shares).map(|(curve, share)| format!("{share:.3} % {}", curve.name)).collect();
            format!("{what}: {}", shares.join(", "))
        };
        let (beyond, without) = (self.shares(|bins| bins.beyond), self.shares(|bins| bins.without));
        if beyond.iter().any(|&share| share > 0.0) {
            return Some(told(&self.bar_label(), beyond));
        }
        without.iter().any(|&share| share > 0.0).then(|| told("without an angle", without))
    }

    fn shares(&self, of: impl Fn(&Bins) -> f64) -> Vec<f64> {
        self.curves.iter().map(|curve| of(&curve.bins)).collect()
    }

    fn has_bar(&self) -> bool {
        self.curves.iter().any(|curve| curve.bins.beyond > 0.0)
    }

    fn bar_label(&self) -> String {
        format!("≥ {}", self.scale.upper().round())
    }

    /// Where the horizontal axis ends.
    fn right_end(&self) -> f64 {
        let bar = if self.has_bar() { (GAP + BAR + REST) * self.scale.length() } else { 0.0 };
        self.scale.upper() + bar
    }

    /// Where the vertical axis ends.
    fn highest(&self) -> f64 {
        let shares = self.curves.iter().flat_map(|curve| curve.bins.shares.iter().chain([&curve.bins.beyond]));
        let highest = shares.copied().fold(0.0, f64::max);
        if highest > 0.0 { 1.05 * highest } else { 1.0 }
    }

    fn draw_axes<B: DrawingBackend>(&self, chart: &mut Chart<'_, B>, look: Look) -> Drawn<B> {
        let end = self.scale.upper() + 0.5 * self.scale.width;
        let (across, unit) = match self.scale.parameter {
            Parameter::MinAngle => ("smallest angle of a triangle (degrees)", "°"),
            Parameter::MaxAngle => ("largest angle of a triangle (degrees)", "°"),
            _ => ("longest over shortest edge (no unit)", ""),
        };
        chart
            .configure_mesh()
            .disable_x_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(look.grid())
            .axis_style(look.axis())
            .x_labels(7)
            .y_labels(7)
            .set_all_tick_mark_size(look.size(5))
            .x_label_formatter(&|x| if *x > end { String::new() } else { plain(*x) })
            .y_label_formatter(&|y| plain(*y))
            .x_desc(across)
            .y_desc(format!("triangles (% per {}{unit})", plain(self.scale.width)))
            .axis_desc_style(look.text(LARGE))
            .label_style(look.text(SMALL))
            .draw()
    }

    /// The outline of the histogram, and that of the bar for what lies past the axis.
    fn outlines(&self, bins: &Bins) -> Vec<Vec<(f64, f64)>> {
        let Scale { lower, width, .. } = self.scale;
        let mut outline = vec![(lower, 0.0)];
        for (number, &share) in bins.shares.iter().enumerate() {
            let left = lower + width * number as f64;
            outline.extend([(left, share), (left + width, share)]);
        }
        outline.push((self.scale.upper(), 0.0));
        let mut outlines = vec![outline];
        if bins.beyond > 0.0 {
            let [left, right] = self.bar();
            outlines.push(vec![(left, 0.0), (left, bins.beyond), (right, bins.beyond), (right, 0.0)]);
        }
        outlines
    }

    /// Left and right side of the bar.
    fn bar(&self) -> [f64; 2] {
        let left = self.scale.upper() + GAP * self.scale.length();
        [left, left + BAR * self.scale.length()]
    }

    fn draw_bar_label<B: DrawingBackend>(
        &self,
        chart: &Chart<'_, B>,
        area: &DrawingArea<B, Shift>,
        look: Look,
    ) -> Drawn<B> {
        if !self.has_bar() {
            return Ok(());
        }
        let [left, right] = self.bar();
        let (x, y) = chart.backend_coord(&(0.5 * (left + right), 0.0));
        let (corner_x, corner_y) = area.get_base_pixel();
        let style = look.text(SMALL).pos(Pos::new(HPos::Center, VPos::Top));
        area.draw_text(&self.bar_label(), &style, (x - corner_x, y - corner_y + look.pixels(12)))
    }
}

/// At most three decimals, and none that says nothing.
fn plain(value: f64) -> String {
    format!("{}", (value * 1000.0).round() / 1000.0)
}
