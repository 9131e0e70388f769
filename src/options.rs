//! What a caller can choose, with units, ranges and defaults.

use crate::error::Error;

/// Plane into which a star is projected before its triangles are sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Plane {
    /// Orthogonal to the vector area of the ring: moves inside it cannot change the volume.
    #[default]
    VectorArea,
    /// Least-squares plane of the star's vertices (Hoppe et al., SIGGRAPH 1992), the paper's choice.
    /// The move found in it is then brought back into the volume-neutral plane.
    LeastSquares,
}

/// Which shape every triangle of a star is asked to take.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ideal {
    /// Values modelled from the star's own statistics, formula (4) of the paper.
    #[default]
    Modelled,
    /// The paper's variant in which every modelled value is 1: equilateral triangles, or equal areas.
    Equilateral,
}

/// What happens to vertices on the boundary of an open mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Boundary {
    /// They keep their bits.
    #[default]
    Fixed,
    /// They slide along the boundary; its corners stay.
    Slide,
}

/// What a star wants.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// The mean of the potential centers of its triangles, modelled from their statistics: the paper's method.
    #[default]
    QuasiStatistical,
    /// The mean of its ring, wherever that is. The enclosed volume changes, by about 1 % in two sweeps over a scan: for
    /// comparison.
    Laplacian,
    /// The part of the Laplacian step that leaves the enclosed volume as it is.
    TangentialLaplacian,
}

/// Quality parameter whose values are sampled and modelled. `docs/metrics.md` derives the random variable of each, says
/// what each improves most, and by how much.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Metric {
    /// Longest edge over shortest edge, the paper's AR; itself the variable. Lowest mean edge ratio.
    #[default]
    EdgeRatio,
    /// Smallest angle θ; variable √3·cot θ. Lowest variance of the smallest angles.
    MinAngle,
    /// Largest angle φ; variable 2·sin(φ/2). Lowest variance of the largest angles.
    MaxAngle,
    /// Area a relative to the mean area m of the star; variable (a/m)² or (m/a)². Most equal areas; shapes matter less.
    Area,
    /// Mean ratio q = 4√3·area / Σ edge²; variable 1 + √(2/q − 2). Lowest variance of the shapes.
    Shape,
}

/// Order in which a sweep visits the stars. Each star sees what its neighbours visited before have become.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// By colour: no two stars of one colour share a vertex, so threads can visit them at once; the result does not
    /// depend on the number of threads.
    #[default]
    Colors,
    /// By vertex index, the paper's "Gentle Enhancement Algorithm". One thread.
    Index,
    /// The paper's "Wave": a front that spreads ring by ring from [`Constraints::seeds`], else from the boundary, else
    /// from the worst triangle. One thread.
    Wave,
    /// The paper's "Triangle-tail": stars of the worst triangles first, measured again as their surroundings change. No
    /// more visits than the other orders make. One thread.
    Tail,
    /// The caller's: the vertices of [`Constraints::visits`], one after the other, in each sweep. One thread.
    /// [`Error::VisitOutOfRange`] if one of them does not exist.
    Given,
}

/// Settings of [`smooth`](crate::smooth). Everything is free of scale but `max_deviation`.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Sweeps over the mesh, 0 to 10,000. Default 2: the method does its work in one or two.
    pub iterations: u32,
    /// What a star wants. Default [`Method::QuasiStatistical`].
    pub method: Method,
    /// Quality parameter that is modelled; of no meaning for the Laplacian methods. Default [`Metric::EdgeRatio`].
    pub metric: Metric,
    /// Keep the ratios of neighbouring sizes: a graded mesh stays graded, and shapes get a little less good. For every
    /// metric and method; takes four bytes a vertex. Default false.
    pub keep_sizes: bool,
    /// Over-relaxation ω of each move, above 0 and at most 2. Default 1.2; 1 is the paper's setting.
    pub relaxation: f64,
    /// Tangent plane of a star. Default [`Plane::VectorArea`].
    pub plane: Plane,
    /// Shape asked of the triangles. Default [`Ideal::Modelled`].
    pub ideal: Ideal,
    /// Interval width w of the sampling histogram (formula (3)), in units of the metric's random variable, 0.001 to
    /// 1,000. Default 0.5.
    pub interval_width: f64,
    /// Samples of the metric's random variable above this count as this, at least 1. Default 3, which is edge ratio 3 or
    /// smallest angle 30°: one sliver must not decide for a star.
    pub sample_limit: f64,
    /// Mean-ratio shape below which no star's worst triangle may fall or fall further, 0 to 1. Default 0.5.
    pub quality_floor: f64,
    /// Dihedral angle in degrees above which an edge may be a crease, above 0 and below 180; `None`: only marked
    /// edges are features. Default 30.
    pub feature_angle: Option<f64>,
    /// Boundary vertices. Default [`Boundary::Fixed`].
    pub boundary: Boundary,
    /// Order of the visits. Default [`Order::Colors`].
    pub order: Order,
    /// Threads at most, 0 to 1,024; 0: as many as the machine runs at once. Small meshes stay on one. The result is
    /// the same for any number. Default 0.
    pub threads: u32,
    /// Greatest distance of a vertex from the original surface, in the units of the coordinates, at least 0;
    /// `None`: no bound. Default `None`.
    pub max_deviation: Option<f64>,
    /// Fill `before`, `after` and `max_deviation` of the report. Costs as much as several sweeps. Default true.
    pub measure: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            iterations: 2,
            method: Method::default(),
            metric: Metric::default(),
            keep_sizes: false,
            relaxation: 1.2,
            plane: Plane::default(),
            ideal: Ideal::default(),
            interval_width: 0.5,
            sample_limit: 3.0,
            quality_floor: 0.5,
            feature_angle: Some(30.0),
            boundary: Boundary::default(),
            order: Order::default(),
            threads: 0,
            max_deviation: None,
            measure: true,
        }
    }
}

impl Options {
    /// Checks every range.
    ///
    /// # Errors
    /// [`Error::BadOption`] names the first field that lies outside its range.
    pub fn validate(&self) -> Result<(), Error> {
        let reject = |name, value| Err(Error::BadOption { name, value });
        if self.iterations > 10_000 {
            return reject("iterations", f64::from(self.iterations));
        }
        if !(self.relaxation > 0.0 && self.relaxation <= 2.0) {
            return reject("relaxation", self.relaxation);
        }
        if !(0.001..=1000.0).contains(&self.interval_width) {
            return reject("interval_width", self.interval_width);
        }
        if !(self.sample_limit >= 1.0 && self.sample_limit.is_finite()) {
            return reject("sample_limit", self.sample_limit);
        }
        if !(0.0..=1.0).contains(&self.quality_floor) {
            return reject("quality_floor", self.quality_floor);
        }
        if self.threads > 1024 {
            return reject("threads", f64::from(self.threads));
        }
        match self.feature_angle {
            Some(angle) if !(angle > 0.0 && angle < 180.0) => reject("feature_angle", angle),
            _ => match self.max_deviation {
                Some(bound) if !(bound >= 0.0 && bound.is_finite()) => reject("max_deviation", bound),
                _ => Ok(()),
            },
        }
    }
}

/// Which vertices must stay, which edges are features beside what the geometry says, and where an order begins.
#[derive(Debug, Clone, Copy, Default)]
pub struct Constraints<'a> {
    /// One entry a vertex, true: keeps its bits. Empty: every vertex is free.
    pub locked: &'a [bool],
    /// Edges to be kept as features, as pairs of vertex indices in any order. A pair that is no edge is ignored.
    pub feature_edges: &'a [[u32; 2]],
    /// Where the front of [`Order::Wave`] starts. One entry a vertex, else [`Error::SeedLength`]; empty: nowhere. A
    /// component of the mesh without a seed starts from its boundary, or else from its worst triangle. No other order
    /// looks at it.
    pub seeds: &'a [bool],
    /// The visits of one sweep in [`Order::Given`], as vertex numbers; any may be missing or come more than once, and one
    /// that may not move is passed over. No other order looks at it.
    pub visits: &'a [u32],
}
