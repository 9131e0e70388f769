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
use crate::options::{Boundary, Ideal, Method, Metric, Options, Order, Plane};
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

/// Order in which a sweep visits the vertices: one of the constants QSM_ORDER_COLORS to QSM_ORDER_GIVEN.
pub type qsm_order = i32;
/// By colour, on all threads: no two vertices of one colour have a neighbour in common.
pub const QSM_ORDER_COLORS: qsm_order = 0;
/// By vertex index, on one thread.
pub const QSM_ORDER_INDEX: qsm_order = 1;
/// A front that spreads ring by ring from seeds, else from the boundary, else from the worst triangle; on one thread.
pub const QSM_ORDER_WAVE: qsm_order = 2;
/// Around the worst triangles first, measured again as their surroundings change, with no more visits in all than the
/// other orders make; on one thread.
pub const QSM_ORDER_TAIL: qsm_order = 3;
/// The vertices of visits, one after the other, in each sweep; on one thread.
pub const QSM_ORDER_GIVEN: qsm_order = 4;

/// What the triangles around a vertex want: one of the constants QSM_METHOD_QUASI_STATISTICAL to
/// QSM_METHOD_TANGENTIAL_LAPLACIAN.
pub type qsm_method = i32;
/// The mean of forms modelled from the triangles' own statistics.
pub const QSM_METHOD_QUASI_STATISTICAL: qsm_method = 0;
/// The mean of the ring around the vertex, wherever that is. The enclosed volume changes: for comparison.
pub const QSM_METHOD_LAPLACIAN: qsm_method = 1;
/// The part of the Laplacian step that leaves the enclosed volume as it is.
pub const QSM_METHOD_TANGENTIAL_LAPLACIAN: qsm_method = 2;

/// Quality parameter whose values are sampled and modelled: one of the constants QSM_METRIC_EDGE_RATIO to
/// QSM_METRIC_SHAPE. They are other numbers than those of qsm_parameter.
pub type qsm_metric = i32;
/// Longest edge over shortest edge.
pub const QSM_METRIC_EDGE_RATIO: qsm_metric = 0;
/// Smallest angle.
pub const QSM_METRIC_MIN_ANGLE: qsm_metric = 1;
/// Largest angle.
pub const QSM_METRIC_MAX_ANGLE: qsm_metric = 2;
/// Area relative to the mean area of the triangles around the vertex.
pub const QSM_METRIC_AREA: qsm_metric = 3;
/// Mean ratio.
pub const QSM_METRIC_SHAPE: qsm_metric = 4;

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
/// A host that only smooths may know this struct up to user alone, one that also treats the tail up to triangle_mask,
/// with struct_size accordingly; every field that it does not know has its default then.
///
/// The fields from tail_edge_ratio to triangle_mask belong to the tail, the triangles that sweeps leave bad: qsm_smooth_* does not
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
    /// What the triangles around a vertex want. Default QSM_METHOD_QUASI_STATISTICAL.
    pub method: qsm_method,
    /// Quality parameter that is modelled; of no meaning for the Laplacian methods. Default QSM_METRIC_EDGE_RATIO.
    pub metric: qsm_metric,
    /// 1: keep the ratios of neighbouring sizes, so that a graded mesh stays graded. 0: leave them to the method.
    /// Default 0.
    pub keep_sizes: i32,
    // Padding in its place would carry bytes of the library's stack to the host.
    /// Fills up to the next pointer. Means nothing.
    pub unused: i32,
    /// Where the front of QSM_ORDER_WAVE starts: one byte a vertex, vertex_count in all, not 0 where it does. In parts of
    /// the mesh without such a vertex, or if this is NULL, it starts at the boundary, or else at the worst triangle. No
    /// other order looks at it. Default NULL.
    pub seeds: *const u8,
    /// The visits of one sweep in QSM_ORDER_GIVEN, as vertex numbers. Any vertex may be missing or come more than once,
    /// and one that may not move is passed over. May be NULL if visit_count is 0. No other order looks at it.
    /// Default NULL.
    pub visits: *const u32,
    /// Number of visits. No order but QSM_ORDER_GIVEN looks at it. Default 0.
    pub visit_count: size_t,
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
            method: QSM_METHOD_QUASI_STATISTICAL,
            metric: QSM_METRIC_EDGE_RATIO,
            keep_sizes: i32::from(defaults.keep_sizes),
            unused: 0,
            seeds: null(),
            visits: null(),
            visit_count: 0,
        }
    }
}

impl Versioned for qsm_options {
    const NAME: &'static CStr = c"options";
    // Up to the tail: all that a host which only smooths has to know.
    const FIRST_SIZE: usize = offset_of!(Self, user) + size_of::<*mut c_void>();
    const LATER_SIZES: &'static [usize] = &[offset_of!(Self, triangle_mask) + size_of::<*const u8>(), Self::INIT_SIZE];
    const INIT_SIZE: usize = offset_of!(Self, visit_count) + size_of::<size_t>();
}

impl qsm_options {
    /// The settings proper. Numbers for enumerations are compared, never taken for a Rust enumeration unseen.
    pub(super) fn settings(&self, measure: bool) -> Result<Options, Error> {
        let unknown = |name, value| Error::BadOption { name, value: f64::from(value) };
        Ok(Options {
            iterations: self.iterations,
            method: method(self.method).ok_or(unknown("method", self.method))?,
            metric: metric(self.metric).ok_or(unknown("metric", self.metric))?,
            keep_sizes: switch("keep_sizes", self.keep_sizes)?,
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

    /// The memory that the options point to: locks, feature edges, seeds, visits. What the order does not look at counts
    /// as none.
    pub(super) fn blocks(&self, vertex_count: usize) -> Result<[Block; 4], Failure> {
        let of_vertices = |bytes: *const u8| if bytes.is_null() { 0 } else { vertex_count };
        let pairs = self.feature_edges.cast::<[u32; 2]>();
        let seeds = if self.order == QSM_ORDER_WAVE { of_vertices(self.seeds) } else { 0 };
        let visits = if self.order == QSM_ORDER_GIVEN { self.visit_count } else { 0 };
        Ok([
            Block::array(c"vertex_lock", self.vertex_lock, c"vertex_count", of_vertices(self.vertex_lock))?,
            Block::array(c"feature_edges", pairs, c"feature_edge_count", self.feature_edge_count)?,
            Block::array(c"seeds", self.seeds, c"vertex_count", seeds)?,
            Block::array(c"visits", self.visits, c"visit_count", visits)?,
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
        QSM_ORDER_WAVE => Some(Order::Wave),
        QSM_ORDER_TAIL => Some(Order::Tail),
        QSM_ORDER_GIVEN => Some(Order::Given),
        _ => None,
    }
}

fn method(value: qsm_method) -> Option<Method> {
    match value {
        QSM_METHOD_QUASI_STATISTICAL => Some(Method::QuasiStatistical),
        QSM_METHOD_LAPLACIAN => Some(Method::Laplacian),
        QSM_METHOD_TANGENTIAL_LAPLACIAN => Some(Method::TangentialLaplacian),
        _ => None,
    }
}

fn metric(value: qsm_metric) -> Option<Metric> {
    match value {
        QSM_METRIC_EDGE_RATIO => Some(Metric::EdgeRatio),
        QSM_METRIC_MIN_ANGLE => Some(Metric::MinAngle),
        QSM_METRIC_MAX_ANGLE => Some(Metric::MaxAngle),
        QSM_METRIC_AREA => Some(Metric::Area),
        QSM_METRIC_SHAPE => Some(Metric::Shape),
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
        let with = |order, method, metric, keep_sizes| {
            let given = qsm_options { order, method, metric, keep_sizes, ..Default::default() };
            given.settings(true).map(|s| (s.order, s.method, s.metric, s.keep_sizes))
        };
        let orders = [Order::Colors, Order::Index, Order::Wave, Order::Tail, Order::Given];
        for (value, order) in (0..).zip(orders) {
            assert_eq!(with(value, 0, 0, 0).unwrap().0, order);
        }
        for (value, method) in (0..).zip([Method::QuasiStatistical, Method::Laplacian, Method::TangentialLaplacian]) {
            assert_eq!(with(0, value, 0, 0).unwrap().1, method);
        }
        let metrics = [Metric::EdgeRatio, Metric::MinAngle, Metric::MaxAngle, Metric::Area, Metric::Shape];
        for (value, metric) in (0..).zip(metrics) {
            assert_eq!(with(0, 0, value, 1).unwrap(), (Order::Colors, Method::QuasiStatistical, metric, true));
        }
        for (value, expected) in (0..).zip(Parameter::ALL) {
            assert_eq!(parameter(value), Ok(expected));
        }
    }

    #[test]
    fn arrays_that_the_order_does_not_look_at_count_as_none() {
        let (seeds, visits) = ([1_u8; 3], [0_u32; 5]);
        let counts = |order| {
            let given = qsm_options {
                order,
                seeds: seeds.as_ptr(),
                visits: visits.as_ptr(),
                visit_count: visits.len(),
                ..Default::default()
            };
            let [_, _, seeds, visits] = given.blocks(3).unwrap();
            [seeds.elements::<u8>(), visits.elements::<u32>()]
        };
        assert_eq!([QSM_ORDER_INDEX, QSM_ORDER_WAVE, QSM_ORDER_GIVEN].map(counts), [[0, 0], [3, 0], [0, 5]]);
        let missing = qsm_options { order: QSM_ORDER_GIVEN, visit_count: 1, ..Default::default() };
        assert_eq!(missing.blocks(3).unwrap_err().name, Some(c"visits"));
    }

    #[test]
    fn parameters_beyond_the_last_are_refused() {
        for value in [-1, 5] {
            assert_eq!(parameter(value), Err(Error::BadOption { name: "parameter", value: f64::from(value) }));
        }
    }
}
