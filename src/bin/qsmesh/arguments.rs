//! The command line.

use std::path::PathBuf;

use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};
use qsmesh::{Options, TailOptions};

use crate::files::{Format, Positions};
use crate::plot::PlotFile;

const EXAMPLES: &str = "\
Formats by extension: .ply (ASCII and binary), .obj, .off, .stl.
Exit codes: 0 done, 1 refused (the reason is on stderr and no file has changed), 2 wrong usage.";

/// Better triangles for surface meshes: vertices move, the few that stay bad are collapsed, the enclosed volume stays.
#[derive(Debug, Parser)]
#[command(name = "qsmesh", version, about, after_help = EXAMPLES)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The things that the command does.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Improve the triangles of a mesh file by moving vertices alone and write it under another name.
    Smooth(SmoothArguments),
    /// Smooth a mesh file, then cure the triangles that are still bad by collapses, removals and flips.
    Improve(ImproveArguments),
    /// Cure the bad triangles of a mesh file by collapses, removals and flips, without smoothing the rest.
    CollapseTails(CollapseTailsArguments),
    /// Measure the quality of a mesh file. Nothing is written but a plot that is asked for.
    Measure(MeasureArguments),
    /// Make a mesh with bad triangles, smooth it and write both.
    Demo(DemoArguments),
}

/// Arguments of `qsmesh smooth`. What sets a heading comes last, because it holds for everything after it.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct SmoothArguments {
    #[command(flatten)]
    pub files: FileArguments,

    #[command(flatten)]
    pub sweeps: SweepArguments,

    #[command(flatten)]
    pub method: MethodArguments,
}

/// Arguments of `qsmesh improve`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ImproveArguments {
    #[command(flatten)]
    pub files: FileArguments,

    /// Leave out the treatment of the tail: the same as `qsmesh smooth`.
    #[arg(long, conflicts_with = "TailArguments")]
    pub keep_tails: bool,

    #[command(flatten)]
    pub tail: TailArguments,

    #[command(flatten)]
    pub sweeps: SweepArguments,

    #[command(flatten)]
    pub method: MethodArguments,
}

/// Arguments of `qsmesh collapse-tails`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct CollapseTailsArguments {
    #[command(flatten)]
    pub files: FileArguments,

    #[command(flatten)]
    pub tail: TailArguments,

    #[command(flatten)]
    pub method: MethodArguments,
}

/// What is read and what is written.
#[derive(Debug, Args)]
pub struct FileArguments {
    /// Mesh file to read.
    #[arg(value_name = "IN")]
    pub input: PathBuf,

    /// Mesh file to write; may be IN, since it is replaced only once the new file is whole.
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,

    /// Draw the histograms of edge ratio, smallest and largest angle, before against after, into a picture, .svg or
    /// .png. Default: none.
    #[arg(long, value_name = "FILE", value_parser = PathBufValueParser::new().try_map(PlotFile::new))]
    pub plot: Option<PlotFile>,

    /// Write how good each triangle was or is into OUT, which must be PLY: its mean-ratio shape (0 no area, 1
    /// equilateral) as the faces' property `quality`, and its colour, dark where it is bad, in place of their own; each
    /// vertex that has none of its own gets those of the worst triangle around it. Default: neither; without a value:
    /// before.
    #[arg(long, value_enum, value_name = "STATE", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "before")]
    pub quality_colors: Option<Shown>,

    /// Write the report as one JSON object to stdout instead of the table.
    #[arg(long)]
    pub json: bool,

    /// No table, no notes and no progress bar; errors and --json are still written.
    #[arg(short, long)]
    pub quiet: bool,
}

impl FileArguments {
    /// Ends the process with a usage error of `subcommand` if OUT cannot hold what is asked for.
    pub fn require_valid(&self, subcommand: &str) {
        // What is no mesh file at all is told later, with what the name lacks.
        let other = Format::of(&self.output).ok().filter(|&format| format != Format::Ply);
        if let Some(format) = other.filter(|_| self.quality_colors.is_some()) {
            let output = self.output.display();
            usage_error(subcommand, format!("--quality-colors needs a .ply file to write, but {output} is {format}"));
        }
    }
}

/// Settings of the treatment of the tail. Edges along which texture coordinates, materials or groups part are kept.
#[derive(Debug, Args)]
#[command(next_help_heading = "Tail", allow_negative_numbers = true)]
pub struct TailArguments {
    /// Edge ratio (longest over shortest edge) above which a triangle is in the tail. Range above 1.
    #[arg(long, value_name = "X", default_value_t = TailOptions::default().edge_ratio)]
    pub tail_edge_ratio: f64,

    /// Smallest angle in degrees below which a triangle is in the tail. Range above 0 to below 60.
    #[arg(long, value_name = "DEG", default_value_t = TailOptions::default().min_angle)]
    pub tail_min_angle: f64,

    /// Largest angle in degrees above which a triangle is in the tail. Range above 60 to below 180.
    #[arg(long, value_name = "DEG", default_value_t = TailOptions::default().max_angle)]
    pub tail_max_angle: f64,

    /// How often one triangle is taken up at most; again only after something near it has changed. Range 1 to 1000.
    #[arg(long, value_name = "N", default_value_t = TailOptions::default().attempts)]
    pub tail_attempts: u32,

    /// First flip every inner edge where the Delaunay criterion in the tangent plane asks for it. Default: no flips but
    /// those that cure a triangle.
    #[arg(long)]
    pub flips: bool,
}

/// How often the mesh is swept.
#[derive(Debug, Args)]
#[command(next_help_heading = "Method", allow_negative_numbers = true)]
pub struct SweepArguments {
    /// Sweeps over the mesh. Range 0 to 10000.
    #[arg(long, value_name = "N", default_value_t = Options::default().iterations)]
    pub iterations: u32,
}

/// Settings of the method.
#[derive(Debug, Args)]
#[command(next_help_heading = "Method", allow_negative_numbers = true)]
pub struct MethodArguments {
    /// Over-relaxation of each move, as a factor. Range above 0 to 2; 1 is the setting of the original method.
    #[arg(long, value_name = "W", default_value_t = Options::default().relaxation)]
    pub relaxation: f64,

    /// Plane into which a star of triangles is projected before its triangles are modelled.
    #[arg(long, value_enum, default_value_t = Plane::VectorArea)]
    pub plane: Plane,

    /// Shape that is asked of the triangles of a star.
    #[arg(long, value_enum, default_value_t = Ideal::Modelled)]
    pub ideal: Ideal,

    /// Dihedral angle in degrees above which an edge may be a crease that is kept; `off`: no creases. Range above 0 to
    /// below 180.
    #[arg(long, value_name = "DEGREES|off", value_parser = parse_angle)]
    #[arg(default_value_t = Angle(Options::default().feature_angle))]
    pub feature_angle: Angle,

    /// Vertices on the boundary of an open mesh.
    #[arg(long, value_enum, default_value_t = Boundary::Fixed)]
    pub boundary: Boundary,

    /// What a star of triangles wants.
    #[arg(long, value_enum, default_value_t = Method::QuasiStatistical)]
    pub method: Method,

    /// Quality parameter whose values are sampled and modelled.
    #[arg(long, value_enum, default_value_t = Metric::EdgeRatio)]
    pub metric: Metric,

    /// Keep the ratios of neighbouring sizes, so that a graded mesh stays graded.
    #[arg(long)]
    pub keep_sizes: bool,

    /// Order in which a sweep visits the vertices.
    #[arg(long, value_enum, default_value_t = Order::Colors)]
    pub order: Order,

    /// Threads at most; 0: as many as the machine runs at once. The result is the same for any number. Range 0 to 1024.
    #[arg(long, value_name = "N", default_value_t = Options::default().threads)]
    pub threads: u32,

    /// Greatest distance of a vertex from the original surface: a number in the units of the coordinates, or a number
    /// with % in percent of the bounding box's diagonal. Range from 0. Default: no bound.
    #[arg(long, value_name = "D|D%", allow_hyphen_values = true, value_parser = parse_distance)]
    pub max_deviation: Option<Distance>,

    /// Interval width of the sampling histogram, in units of edge ratio. Range 0.001 to 1000.
    #[arg(long, visible_alias = "interval", value_name = "W", default_value_t = Options::default().interval_width)]
    pub interval_width: f64,

    /// Edge ratio above which a sample counts as this one. Range from 1.
    #[arg(long, value_name = "R", default_value_t = Options::default().sample_limit)]
    pub sample_limit: f64,

    /// Mean-ratio shape (0 no area, 1 equilateral) below which no star's worst triangle may fall, or fall further.
    /// Range 0 to 1.
    #[arg(long, value_name = "Q", default_value_t = Options::default().quality_floor)]
    pub quality_floor: f64,
}

/// Arguments of `qsmesh measure`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct MeasureArguments {
    /// Mesh file to read.
    #[arg(value_name = "IN")]
    pub input: PathBuf,

    /// Write the measurement as one JSON object to stdout instead of the table.
    #[arg(long)]
    pub json: bool,

    /// Draw the histograms of edge ratio, smallest and largest angle into a picture, .svg or .png. Default: none.
    #[arg(long, value_name = "FILE", value_parser = PathBufValueParser::new().try_map(PlotFile::new))]
    pub plot: Option<PlotFile>,
}

/// Arguments of `qsmesh demo`.
#[derive(Debug, Args)]
pub struct DemoArguments {
    /// Folder for demo_before.ply and demo_after.ply; it must exist.
    #[arg(short, long, value_name = "FOLDER", default_value = ".")]
    pub output: PathBuf,
}

/// `--quality-colors`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Shown {
    /// The triangles of IN; a triangle that is another now shows the one whose place it took.
    Before,
    /// The triangles of OUT.
    After,
}

/// `--plane`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Plane {
    /// Orthogonal to the vector area of the star's ring.
    VectorArea,
    /// Least-squares plane of the star's vertices.
    LeastSquares,
}

/// `--ideal`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Ideal {
    /// Values modelled from the star's own statistics.
    Modelled,
    /// Equilateral triangles.
    Equilateral,
}

/// `--boundary`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Boundary {
    /// They stay.
    Fixed,
    /// They slide along the boundary; its corners stay.
    Slide,
}

/// `--order`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Order {
    /// By colour, on all threads.
    Colors,
    /// By vertex index, on one thread.
    Index,
    /// A front that spreads ring by ring from the boundary, or from the worst triangle; on one thread.
    Wave,
    /// The stars of the worst triangles first; on one thread.
    Tail,
}

/// `--method`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// The mean of forms modelled from the star's own statistics.
    QuasiStatistical,
    /// The mean of the ring. The enclosed volume changes: for comparison.
    Laplacian,
    /// The part of the Laplacian step that keeps the volume.
    TangentialLaplacian,
}

/// `--metric`, by the names that measurements use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum Metric {
    /// Longest over shortest edge.
    EdgeRatio,
    /// Smallest angle.
    MinAngle,
    /// Largest angle.
    MaxAngle,
    /// Area relative to the mean of the star.
    Area,
    /// Mean ratio.
    Shape,
}

/// `--feature-angle`: degrees, or `None` for `off`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Angle(pub Option<f64>);

impl std::fmt::Display for Angle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Some(angle) => write!(f, "{angle}"),
            None => f.write_str("off"),
        }
    }
}

fn parse_angle(text: &str) -> Result<Angle, String> {
    if text.eq_ignore_ascii_case("off") {
        return Ok(Angle(None));
    }
    text.parse().map(|angle| Angle(Some(angle))).map_err(|_| "neither a number of degrees nor `off`".to_string())
}

/// `--max-deviation`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Distance {
    /// In the units of the coordinates.
    Absolute(f64),
    /// In percent of the bounding box's diagonal.
    Percent(f64),
}

impl Distance {
    fn in_units(self, positions: &Positions) -> f64 {
        match self {
            Self::Absolute(distance) => distance,
            Self::Percent(percent) => percent / 100.0 * positions.diagonal(),
        }
    }
}

fn parse_distance(text: &str) -> Result<Distance, String> {
    let (number, kind): (_, fn(f64) -> Distance) = match text.strip_suffix('%') {
        Some(number) => (number, Distance::Percent),
        None => (text, Distance::Absolute),
    };
    match number.trim().parse::<f64>() {
        Ok(value) if value >= 0.0 && value.is_finite() => Ok(kind(value)),
        _ => Err("neither a number from 0 nor such a number with %".to_string()),
    }
}

impl MethodArguments {
    /// As the library takes them, for `iterations` sweeps over a mesh at `positions`.
    pub fn options(&self, iterations: u32, positions: &Positions) -> Options {
        let max_deviation = self.max_deviation.map(|distance| distance.in_units(positions));
        Options { iterations, max_deviation, ..self.unscaled() }
    }

    /// Ends the process with a usage error of `subcommand` if a value is outside its range.
    pub fn require_valid(&self, iterations: u32, subcommand: &str) {
        require_valid(Options { iterations, ..self.unscaled() }.validate(), subcommand, "");
    }

    /// Everything but the number of sweeps and the one option that depends on the mesh.
    fn unscaled(&self) -> Options {
        Options {
            relaxation: self.relaxation,
            plane: match self.plane {
                Plane::VectorArea => qsmesh::Plane::VectorArea,
                Plane::LeastSquares => qsmesh::Plane::LeastSquares,
            },
            ideal: match self.ideal {
                Ideal::Modelled => qsmesh::Ideal::Modelled,
                Ideal::Equilateral => qsmesh::Ideal::Equilateral,
            },
            interval_width: self.interval_width,
            sample_limit: self.sample_limit,
            quality_floor: self.quality_floor,
            feature_angle: self.feature_angle.0,
            boundary: match self.boundary {
                Boundary::Fixed => qsmesh::Boundary::Fixed,
                Boundary::Slide => qsmesh::Boundary::Slide,
            },
            order: match self.order {
                Order::Colors => qsmesh::Order::Colors,
                Order::Index => qsmesh::Order::Index,
                Order::Wave => qsmesh::Order::Wave,
                Order::Tail => qsmesh::Order::Tail,
            },
            method: match self.method {
                Method::QuasiStatistical => qsmesh::Method::QuasiStatistical,
                Method::Laplacian => qsmesh::Method::Laplacian,
                Method::TangentialLaplacian => qsmesh::Method::TangentialLaplacian,
            },
            metric: match self.metric {
                Metric::EdgeRatio => qsmesh::Metric::EdgeRatio,
                Metric::MinAngle => qsmesh::Metric::MinAngle,
                Metric::MaxAngle => qsmesh::Metric::MaxAngle,
                Metric::Area => qsmesh::Metric::Area,
                Metric::Shape => qsmesh::Metric::Shape,
            },
            keep_sizes: self.keep_sizes,
            threads: self.threads,
            ..Options::default()
        }
    }
}

impl TailArguments {
    /// As the library takes them.
    pub fn options(&self) -> TailOptions<'static> {
        TailOptions {
            edge_ratio: self.tail_edge_ratio,
            min_angle: self.tail_min_angle,
            max_angle: self.tail_max_angle,
            flips: self.flips,
            attempts: self.tail_attempts,
            ..TailOptions::default()
        }
    }

    /// Ends the process with a usage error of `subcommand` if a value is outside its range.
    pub fn require_valid(&self, subcommand: &str) {
        require_valid(self.options().validate(), subcommand, "tail-");
    }
}

/// Ends the process with a usage error if the library refused an option, which the command calls by the same name
/// behind `prefix`.
fn require_valid(checked: Result<(), qsmesh::Error>, subcommand: &str, prefix: &str) {
    if let Err(qsmesh::Error::BadOption { name, value }) = checked {
        let option = name.replace('_', "-");
        let message = format!("{value} is outside the range of --{prefix}{option}; see `qsmesh {subcommand} --help`");
        usage_error(subcommand, message);
    }
}

/// Ends the process with a usage error of `subcommand`.
fn usage_error(subcommand: &str, message: String) -> ! {
    let mut command = Arguments::command();
    command.build();
    let found = command.find_subcommand_mut(subcommand).cloned();
    found.unwrap_or(command).error(ErrorKind::ValueValidation, message).exit()
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, Parser};

    use super::{Arguments, Command, Options, Positions, TailOptions};

    fn options(arguments: &[&str]) -> Options {
        let all = ["qsmesh", "smooth", "a.ply", "-o", "b.ply"].iter().chain(arguments);
        let Command::Smooth(smooth) = Arguments::try_parse_from(all).unwrap().command else { panic!("not smooth") };
        smooth.method.options(smooth.sweeps.iterations, &Positions::F64(vec![[0.0; 3], [30.0, 40.0, 0.0]]))
    }

    fn tail_options(arguments: &[&str]) -> TailOptions<'static> {
        let all = ["qsmesh", "improve", "a.ply", "-o", "b.ply"].iter().chain(arguments);
        let Command::Improve(improve) = Arguments::try_parse_from(all).unwrap().command else { panic!("not improve") };
        improve.tail.options()
    }

    #[test]
    fn the_declaration_is_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn defaults_are_those_of_the_library() {
        assert_eq!(options(&[]), Options::default());
        assert_eq!(tail_options(&[]), TailOptions::default());
    }

    #[test]
    fn distances_are_absolute_or_relative() {
        assert_eq!(options(&["--max-deviation", "0.25"]).max_deviation, Some(0.25));
        assert_eq!(options(&["--max-deviation", "0.5%"]).max_deviation, Some(0.25));
    }

    #[test]
    fn every_choice_reaches_the_library() {
        let chosen = options(&[
            "--plane",
            "least-squares",
            "--ideal",
            "equilateral",
            "--boundary",
            "slide",
            "--order",
            "index",
            "--threads",
            "3",
            "--method",
            "tangential-laplacian",
            "--metric",
            "min_angle",
            "--keep-sizes",
            "--feature-angle",
            "off",
            "--iterations",
            "7",
            "--relaxation",
            "1",
            "--interval-width",
            "0.1",
            "--sample-limit",
            "2",
            "--quality-floor",
            "0.25",
        ]);
        let expected = Options {
            plane: qsmesh::Plane::LeastSquares,
            ideal: qsmesh::Ideal::Equilateral,
            boundary: qsmesh::Boundary::Slide,
            order: qsmesh::Order::Index,
            threads: 3,
            method: qsmesh::Method::TangentialLaplacian,
            metric: qsmesh::Metric::MinAngle,
            keep_sizes: true,
            feature_angle: None,
            iterations: 7,
            relaxation: 1.0,
            interval_width: 0.1,
            sample_limit: 2.0,
            quality_floor: 0.25,
            ..Options::default()
        };
        assert_eq!(chosen, expected);
    }

    #[test]
    fn orders_go_by_their_names() {
        use qsmesh::Order::{Colors, Index, Tail, Wave};
        let found = ["colors", "index", "wave", "tail"].map(|name| options(&["--order", name]).order);
        assert_eq!(found, [Colors, Index, Wave, Tail]);
    }

    #[test]
    fn every_choice_about_the_tail_reaches_the_library() {
        let chosen = tail_options(&[
            "--tail-edge-ratio",
            "2.5",
            "--tail-min-angle",
            "30",
            "--tail-max-angle",
            "115",
            "--tail-attempts",
            "9",
            "--flips",
        ]);
        let expected = TailOptions {
            edge_ratio: 2.5,
            min_angle: 30.0,
            max_angle: 115.0,
            attempts: 9,
            flips: true,
            ..TailOptions::default()
        };
        assert_eq!(chosen, expected);
    }
}
