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
    /// The paper's variant in which every modelled value is 1: equilateral triangles.
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

/// Order in which a sweep visits the stars. Each star sees what its neighbours visited before have become.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// By colour: no two stars of one colour share a vertex, so threads can visit them at once; the result does not
    /// depend on the number of threads.
    #[default]
    Colors,
    /// By vertex index, the paper's "Gentle Enhancement Algorithm". One thread.
    Index,
}

/// Settings of [`smooth`](crate::smooth). Everything is free of scale but `max_deviation`.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Sweeps over the mesh, 0 to 10,000. Default 2: the method does its work in one or two.
    pub iterations: u32,
    /// Over-relaxation ω of each move, above 0 and at most 2. Default 1.2; 1 is the paper's setting.
    pub relaxation: f64,
    /// Tangent plane of a star. Default [`Plane::VectorArea`].
    pub plane: Plane,
    /// Shape asked of the triangles. Default [`Ideal::Modelled`].
    pub ideal: Ideal,
    /// Interval width w of the sampling histogram in units of edge_ratio (formula (3)), 0.001 to 1,000. Default 0.5.
    pub interval_width: f64,
    /// Samples of edge_ratio above this count as this, at least 1. Default 3: one sliver must not decide for a star.
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

/// Which vertices must stay and which edges are features, beside what the geometry says.
#[derive(Debug, Clone, Copy, Default)]
pub struct Constraints<'a> {
    /// One entry a vertex, true: keeps its bits. Empty: every vertex is free.
    pub locked: &'a [bool],
    /// Edges to be kept as features, as pairs of vertex indices in any order. A pair that is no edge is ignored.
    pub feature_edges: &'a [[u32; 2]],
}
