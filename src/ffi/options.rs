//! Options as C sees them.
#![forbid(unsafe_code)]

use std::ffi::CStr;
use std::mem::offset_of;
use std::ptr::{null, null_mut};

use libc::{c_void, size_t};

use super::block::Block;
use super::status::Failure;
use super::struct_size::Versioned;
use crate::error::Error;
use crate::options::{Boundary, Ideal, Options, Plane};
use crate::quality::Parameter;

/// Plane into which the triangles around a vertex are projected: QSM_PLANE_VECTOR_AREA or QSM_PLANE_LEAST_SQUARES.
pub type qsm_plane = i32;
/// Orthogonal to the vector area of the ring around the vertex: moves inside it cannot change the volume.
pub const QSM_PLANE_VECTOR_AREA: qsm_plane = 0;
/// Least-squares plane of the vertex and its neighbours. The move found in it is brought back into the volume-neutral
/// plane.
pub const QSM_PLANE_LEAST_SQUARES: qsm_plane = 1;

/// Shape that every triangle is asked to take: QSM_IDEAL_MODELLED or QSM_IDEAL_EQUILATERAL.
pub type qsm_ideal = i32;
/// Modelled from the statistics of the triangles around the vertex.
pub const QSM_IDEAL_MODELLED: qsm_ideal = 0;
/// Equilateral.
pub const QSM_IDEAL_EQUILATERAL: qsm_ideal = 1;

/// What happens to vertices on the boundary of an open mesh: QSM_BOUNDARY_FIXED or QSM_BOUNDARY_SLIDE.
pub type qsm_boundary = i32;
/// They keep their bits.
pub const QSM_BOUNDARY_FIXED: qsm_boundary = 0;
/// They slide along the boundary; its corners stay.
pub const QSM_BOUNDARY_SLIDE: qsm_boundary = 1;

/// Answer of the progress callback: QSM_CONTINUE or QSM_CANCEL. Any other value counts as QSM_CANCEL.
pub type qsm_flow = i32;
/// Go on.
pub const QSM_CONTINUE: qsm_flow = 0;
/// Stop: the call returns QSM_CANCELLED and the positions stay as they were.
#[allow(dead_code, reason = "only hosts answer with it; here it is what every other value is")]
pub const QSM_CANCEL: qsm_flow = 1;

/// A quality parameter of a triangle: one of the constants QSM_EDGE_RATIO to QSM_RADIUS_RATIO.
pub type qsm_parameter = i32;
/// Longest edge over shortest edge, 1 to infinity.
pub const QSM_EDGE_RATIO: qsm_parameter = 0;
/// Smallest angle in degrees, 0 to 60.
pub const QSM_MIN_ANGLE: qsm_parameter = 1;
/// Largest angle in degrees, 60 to 180.
pub const QSM_MAX_ANGLE: qsm_parameter = 2;
/// Mean ratio, 4 * sqrt(3) * area / (sum of squared edges), 0 to 1.
pub const QSM_SHAPE: qsm_parameter = 3;
/// Circumradius over twice the inradius, 1 to infinity.
pub const QSM_RADIUS_RATIO: qsm_parameter = 4;

/// Settings of qsm_smooth_f32 and qsm_smooth_f64. Set up with qsm_options_init, then change what you like. The library
/// keeps no pointer out of it after the call. Everything is free of scale but max_deviation.
#[repr(C)]
pub struct qsm_options {
    /// Size of this struct in bytes. Set by qsm_options_init; leave it alone.
    pub struct_size: size_t,
    /// Sweeps over the mesh, 0 to 10000. Default 2.
    pub iterations: u32,
    /// Plane of projection. Default QSM_PLANE_VECTOR_AREA.
    pub plane: qsm_plane,
    /// Shape asked of the triangles. Default QSM_IDEAL_MODELLED.
    pub ideal: qsm_ideal,
    /// Treatment of boundary vertices. Default QSM_BOUNDARY_FIXED.
    pub boundary: qsm_boundary,
    /// Over-relaxation of each move, above 0 and at most 2. Default 1.2.
    pub relaxation: f64,
    /// Interval width of the sampling histogram in units of the edge ratio, 0.001 to 1000. Default 0.5.
    pub interval_width: f64,
    /// Edge ratios above this count as this, at least 1 and finite. Default 3.
    pub sample_limit: f64,
    /// Mean-ratio shape below which the worst triangle around a vertex may not fall or fall further, 0 to 1.
    /// Default 0.5.
    pub quality_floor: f64,
    /// Dihedral angle in degrees above which an edge may be a crease, below 180; 0: only the edges in feature_edges are
    /// features. Default 30.
    pub feature_angle: f64,
    /// Greatest distance of a vertex from the original surface, in the units of the coordinates, at least 0; positive
    /// infinity (INFINITY or HUGE_VAL of math.h): no bound. Default infinity. A bound of 0 is a bound.
    pub max_deviation: f64,
    /// One byte a vertex, vertex_count in all; a vertex whose byte is not 0 keeps its bits. NULL: every vertex is free.
    /// Default NULL.
    pub vertex_lock: *const u8,
    /// Edges to be kept as features: two vertex indices an edge, in any order, 2 * feature_edge_count in all. A pair
    /// that is no edge of the mesh is ignored. May be NULL if feature_edge_count is 0. Default NULL.
    pub feature_edges: *const u32,
    /// Number of pairs in feature_edges. Default 0.
    pub feature_edge_count: size_t,
    /// Called on the calling thread with the share of the work that is done, 0 to 1, never falling, and with user.
    /// Answers QSM_CONTINUE or QSM_CANCEL. It must not throw, must not jump out, and must not change or free the memory
    /// of the call. NULL: no callback. Default NULL.
    pub progress: Option<unsafe extern "C" fn(done: f64, user: *mut c_void) -> qsm_flow>,
    /// Handed to progress as it is. Default NULL.
    pub user: *mut c_void,
}

impl Default for qsm_options {
    fn default() -> Self {
        let defaults = Options::default();
        Self {
            struct_size: size_of::<Self>(),
            iterations: defaults.iterations,
            plane: QSM_PLANE_VECTOR_AREA,
            ideal: QSM_IDEAL_MODELLED,
            boundary: QSM_BOUNDARY_FIXED,
            relaxation: defaults.relaxation,
            interval_width: defaults.interval_width,
            sample_limit: defaults.sample_limit,
            quality_floor: defaults.quality_floor,
            feature_angle: defaults.feature_angle.unwrap_or(0.0),
            max_deviation: defaults.max_deviation.unwrap_or(f64::INFINITY),
            vertex_lock: null(),
            feature_edges: null(),
            feature_edge_count: 0,
            progress: None,
            user: null_mut(),
        }
    }
}

impl Versioned for qsm_options {
    const NAME: &'static CStr = c"options";
    const FIRST_SIZE: usize = offset_of!(Self, user) + size_of::<*mut c_void>();
}

impl qsm_options {
    /// The settings proper. Numbers for enumerations are compared, never taken for a Rust enumeration unseen.
    pub(super) fn settings(&self, measure: bool) -> Result<Options, Error> {
        let unknown = |name, value| Error::BadOption { name, value: f64::from(value) };
        Ok(Options {
            iterations: self.iterations,
            relaxation: self.relaxation,
            plane: plane(self.plane).ok_or(unknown("plane", self.plane))?,
            ideal: ideal(self.ideal).ok_or(unknown("ideal", self.ideal))?,
            interval_width: self.interval_width,
            sample_limit: self.sample_limit,
            quality_floor: self.quality_floor,
            feature_angle: Some(self.feature_angle).filter(|&angle| angle != 0.0),
            boundary: boundary(self.boundary).ok_or(unknown("boundary", self.boundary))?,
            max_deviation: Some(self.max_deviation).filter(|&bound| bound != f64::INFINITY),
            measure,
        })
    }

    /// The memory that the options point to: locks, then feature edges.
    pub(super) fn blocks(&self, vertex_count: usize) -> Result<[Block; 2], Failure> {
        let locks = if self.vertex_lock.is_null() { 0 } else { vertex_count };
        let pairs = self.feature_edges.cast::<[u32; 2]>();
        Ok([
            Block::array(c"vertex_lock", self.vertex_lock, c"vertex_count", locks)?,
            Block::array(c"feature_edges", pairs, c"feature_edge_count", self.feature_edge_count)?,
        ])
    }
}

fn plane(value: qsm_plane) -> Option<Plane> {
    match value {
        QSM_PLANE_VECTOR_AREA => Some(Plane::VectorArea),
        QSM_PLANE_LEAST_SQUARES => Some(Plane::LeastSquares),
        _ => None,
    }
}

fn ideal(value: qsm_ideal) -> Option<Ideal> {
    match value {
        QSM_IDEAL_MODELLED => Some(Ideal::Modelled),
        QSM_IDEAL_EQUILATERAL => Some(Ideal::Equilateral),
        _ => None,
    }
}

fn boundary(value: qsm_boundary) -> Option<Boundary> {
    match value {
        QSM_BOUNDARY_FIXED => Some(Boundary::Fixed),
        QSM_BOUNDARY_SLIDE => Some(Boundary::Slide),
        _ => None,
    }
}

/// The parameter that a C constant stands for.
pub(super) fn parameter(value: qsm_parameter) -> Result<Parameter, Error> {
    match value {
        QSM_EDGE_RATIO => Ok(Parameter::EdgeRatio),
        QSM_MIN_ANGLE => Ok(Parameter::MinAngle),
        QSM_MAX_ANGLE => Ok(Parameter::MaxAngle),
        QSM_SHAPE => Ok(Parameter::Shape),
        QSM_RADIUS_RATIO => Ok(Parameter::RadiusRatio),
        _ => Err(Error::BadOption { name: "parameter", value: f64::from(value) }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_those_of_the_library() {
        assert_eq!(qsm_options::default().settings(true).unwrap(), Options::default());
    }

    #[test]
    fn switches_turn_off_what_they_say() {
        let options = qsm_options { feature_angle: 0.0, max_deviation: 0.0, ..Default::default() };
        let settings = options.settings(false).unwrap();
        assert_eq!((settings.feature_angle, settings.max_deviation, settings.measure), (None, Some(0.0), false));
    }

    #[test]
    fn each_constant_means_its_own_variant() {
        let given = qsm_options { plane: 1, ideal: 1, boundary: 1, ..Default::default() };
        let settings = given.settings(true).unwrap();
        assert_eq!(settings.plane, Plane::LeastSquares);
        assert_eq!(settings.ideal, Ideal::Equilateral);
        assert_eq!(settings.boundary, Boundary::Slide);
        for (value, expected) in (0..).zip(Parameter::ALL) {
            assert_eq!(parameter(value), Ok(expected));
        }
    }

    #[test]
    fn parameters_beyond_the_last_are_refused() {
        for value in [-1, 5] {
            assert_eq!(parameter(value), Err(Error::BadOption { name: "parameter", value: f64::from(value) }));
        }
    }
}
