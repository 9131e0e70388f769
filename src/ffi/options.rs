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
use crate::options::{Boundary, Ideal, Options, Order, Plane};
use crate::quality::Parameter;
use crate::tail::TailOptions;

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

/// Order in which a sweep visits the vertices: QSM_ORDER_COLORS or QSM_ORDER_INDEX.
pub type qsm_order = i32;
/// By colour, on all threads: no two vertices of one colour have a neighbour in common.
pub const QSM_ORDER_COLORS: qsm_order = 0;
/// By vertex index, on one thread.
pub const QSM_ORDER_INDEX: qsm_order = 1;

/// Answer of the progress callback: QSM_CONTINUE or QSM_CANCEL. Any other value counts as QSM_CANCEL.
pub type qsm_flow = i32;
/// Go on.
pub const QSM_CONTINUE: qsm_flow = 0;
/// Stop: the call returns QSM_CANCELLED and all buffers stay as they were.
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

/// Settings of qsm_smooth_*, qsm_collapse_tails_* and qsm_improve_*. Set up with qsm_options_init, then change what
/// you like. The library keeps no pointer out of it after the call. Everything is free of scale but max_deviation.
///
/// A host that only smooths may know this struct up to user alone, with struct_size accordingly; every field that it
/// does not know has its default then.
///
/// The fields from tail_edge_ratio on belong to the tail, the triangles that sweeps leave bad: qsm_smooth_* does not
/// look at these fields, so nothing in them is an error there. The other calls check every field, iterations too where
/// it has no meaning.
#[repr(C)]
pub struct qsm_options {
    /// Size of this struct in bytes. Set by qsm_options_init; leave it alone.
    pub struct_size: size_t,
    /// Sweeps over the mesh, 0 to 10000. No meaning for qsm_collapse_tails_*. Default 2.
    pub iterations: u32,
    /// Plane of projection. Default QSM_PLANE_VECTOR_AREA.
    pub plane: qsm_plane,
    /// Shape asked of the triangles. Default QSM_IDEAL_MODELLED.
    pub ideal: qsm_ideal,
    /// Treatment of boundary vertices. Default QSM_BOUNDARY_FIXED.
    pub boundary: qsm_boundary,
    /// Order of the visits. Default QSM_ORDER_COLORS.
    pub order: qsm_order,
    /// Threads at most, 0 to 1024; 0: as many as the machine runs at once. Small meshes stay on one. The result is the
    /// same for any number. Default 0.
    pub threads: u32,
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
    /// Longest over shortest edge above which a triangle belongs to the tail, above 1 and finite. Default 3.
    pub tail_edge_ratio: f64,
    /// Smallest angle in degrees below which a triangle belongs to the tail, above 0 and below 60. Default 20.
    pub tail_min_angle: f64,
    /// Largest angle in degrees above which a triangle belongs to the tail, above 60 and below 180. Default 130.
    pub tail_max_angle: f64,
    /// How often one triangle is taken up at most, 1 to 1000. Default 3.
    pub tail_attempts: u32,
    /// 1: before the tail is treated, flip every interior edge that is no feature where the Delaunay criterion in the
    /// tangent plane and the normals allow it. 0: flip edges only to cure a triangle. Default 0.
    pub flips: i32,
    /// Operations on the tail that are carried out at most, over the whole mesh; 0: no bound. Default 0.
    pub tail_operations: size_t,
    /// One byte a triangle, index_count / 3 in all; a triangle whose byte is 0 is never taken up as one of the tail,
    /// but may change where a neighbour is cured. NULL: every triangle may be taken up. Default NULL.
    pub triangle_mask: *const u8,
}

impl Default for qsm_options {
    fn default() -> Self {
        let defaults = Options::default();
        let tail = TailOptions::default();
        Self {
            struct_size: size_of::<Self>(),
            iterations: defaults.iterations,
            plane: QSM_PLANE_VECTOR_AREA,
            ideal: QSM_IDEAL_MODELLED,
            boundary: QSM_BOUNDARY_FIXED,
            order: QSM_ORDER_COLORS,
            threads: defaults.threads,
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
            tail_edge_ratio: tail.edge_ratio,
            tail_min_angle: tail.min_angle,
            tail_max_angle: tail.max_angle,
            tail_attempts: tail.attempts,
            flips: i32::from(tail.flips),
            tail_operations: tail.operations.unwrap_or(0),
            triangle_mask: null(),
        }
    }
}

impl Versioned for qsm_options {
    const NAME: &'static CStr = c"options";
    // Up to the tail: all that a host which only smooths has to know.
    const FIRST_SIZE: usize = offset_of!(Self, user) + size_of::<*mut c_void>();
    const LATER_SIZES: &'static [usize] = &[Self::INIT_SIZE];
    const INIT_SIZE: usize = offset_of!(Self, triangle_mask) + size_of::<*const u8>();
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
            order: order(self.order).ok_or(unknown("order", self.order))?,
            threads: self.threads,
            max_deviation: Some(self.max_deviation).filter(|&bound| bound != f64::INFINITY),
            measure,
            ..Options::default()
        })
    }

    /// The settings of the tail. Errors name the fields as they are called here.
    pub(super) fn tail<'a>(&self, mask: &'a [bool]) -> Result<TailOptions<'a>, Error> {
        let tail = TailOptions {
            edge_ratio: self.tail_edge_ratio,
            min_angle: self.tail_min_angle,
            max_angle: self.tail_max_angle,
            flips: switch("flips", self.flips)?,
            attempts: self.tail_attempts,
            operations: Some(self.tail_operations).filter(|&bound| bound != 0),
            mask,
        };
        tail.validate().map_err(named_as_in_c)?;
        Ok(tail)
    }

    /// The memory that the options point to for the tail.
    pub(super) fn mask_block(&self, triangle_count: usize) -> Result<Block, Failure> {
        let count = if self.triangle_mask.is_null() { 0 } else { triangle_count };
        Block::array(c"triangle_mask", self.triangle_mask, c"index_count", count)
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

fn order(value: qsm_order) -> Option<Order> {
    match value {
        QSM_ORDER_COLORS => Some(Order::Colors),
        QSM_ORDER_INDEX => Some(Order::Index),
        _ => None,
    }
}

fn switch(name: &'static str, value: i32) -> Result<bool, Error> {
    match value {
        0 => Ok(false),
        1 => Ok(true),
        _ => Err(Error::BadOption { name, value: f64::from(value) }),
    }
}

/// The library's settings of the tail are in a struct of their own; in C their names say what they belong to.
fn named_as_in_c(error: Error) -> Error {
    let Error::BadOption { name, value } = error else {
        return error;
    };
    let name = match name {
        "edge_ratio" => "tail_edge_ratio",
        "min_angle" => "tail_min_angle",
        "max_angle" => "tail_max_angle",
        "attempts" => "tail_attempts",
        other => other,
    };
    Error::BadOption { name, value }
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
        assert_eq!(qsm_options::default().tail(&[]).unwrap(), TailOptions::default());
    }

    #[test]
    fn switches_turn_off_what_they_say() {
        let options = qsm_options { feature_angle: 0.0, max_deviation: 0.0, ..Default::default() };
        let settings = options.settings(false).unwrap();
        assert_eq!((settings.feature_angle, settings.max_deviation, settings.measure), (None, Some(0.0), false));
    }

    #[test]
    fn tail_fields_reach_the_tail() {
        let given = qsm_options {
            tail_edge_ratio: 2.5,
            tail_min_angle: 30.0,
            tail_max_angle: 110.0,
            tail_attempts: 9,
            flips: 1,
            tail_operations: 4,
            ..Default::default()
        };
        let expected = TailOptions {
            edge_ratio: 2.5,
            min_angle: 30.0,
            max_angle: 110.0,
            flips: true,
            attempts: 9,
            operations: Some(4),
            mask: &[true, false],
        };
        assert_eq!(given.tail(&[true, false]).unwrap(), expected);
    }

    #[test]
    fn each_constant_means_its_own_variant() {
        let given = qsm_options { plane: 1, ideal: 1, boundary: 1, order: 1, threads: 3, ..Default::default() };
        let settings = given.settings(true).unwrap();
        assert_eq!(settings.plane, Plane::LeastSquares);
        assert_eq!(settings.ideal, Ideal::Equilateral);
        assert_eq!(settings.boundary, Boundary::Slide);
        assert_eq!((settings.order, settings.threads), (Order::Index, 3));
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
