//! Quality of a whole mesh.

use glam::DVec3;

use super::Parameter;
use super::distribution::Distribution;
use super::triangle::Sides;
use crate::error::Error;
use crate::memory;
use crate::mesh::{Coordinate, Mesh, Positions, repeats_a_vertex};
use crate::threads::Threads;

/// What [`measure`] finds.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Measurement {
    /// Vertices, used or not.
    pub vertices: usize,
    /// Triangles, degenerate ones included.
    pub triangles: usize,
    /// Longest over shortest edge; mean and variance are the paper's M and D.
    pub edge_ratio: Distribution,
    /// Smallest angle of a triangle, degrees.
    pub min_angle: Distribution,
    /// Largest angle of a triangle, degrees.
    pub max_angle: Distribution,
    /// Mean ratio 4√3·area / Σ edge².
    pub shape: Distribution,
    /// Circumradius over twice the inradius.
    pub radius_ratio: Distribution,
    /// Triangles whose smallest angle is below 10°.
    pub below_10: usize,
    /// Triangles whose smallest angle is below 20°.
    pub below_20: usize,
    /// Triangles whose smallest angle is below 30°.
    pub below_30: usize,
    /// Triangles without area.
    pub zero_area: usize,
    /// Edges with one triangle.
    pub boundary_edges: usize,
    /// Edges with more than two triangles, or with two that disagree in winding.
    pub non_manifold_edges: usize,
    /// Signed volume: positive where the triangles turn counter-clockwise seen from outside. For a mesh that is not
    /// closed it is the volume of the cone from the centre of its bounding box.
    pub volume: f64,
    /// Sum of the areas.
    pub area: f64,
}

/// Measures a mesh. Nothing is changed.
///
/// # Errors
/// [`Error::IndexOutOfRange`], [`Error::NonFinite`] or [`Error::TooLarge`], as for [`smooth`](crate::smooth).
pub fn measure<T: Coordinate>(positions: &[[T; 3]], triangles: &[[u32; 3]]) -> Result<Measurement, Error> {
    let mesh = Mesh::new(positions, triangles, &Threads::ONE)?;
    Measurement::of(&mesh.positions, triangles, mesh.unit, &Threads::ONE)
}

/// The value of `parameter` for each triangle, infinite ones included.
///
/// # Errors
/// As for [`measure`], and [`Error::OutOfMemory`].
pub fn triangle_quality<T: Coordinate>(
    positions: &[[T; 3]],
    triangles: &[[u32; 3]],
    parameter: Parameter,
) -> Result<Vec<f64>, Error> {
    let mesh = Mesh::new(positions, triangles, &Threads::ONE)?;
    let mut values = memory::reserved(triangles.len())?;
    values.extend(triangles.iter().map(|t| parameter.of(&Sides::new(mesh.corners(t)))));
    Ok(values)
}

/// Counts how many triangles have a value of `parameter` in each interval of width `interval` from `lower` on; values
/// below `lower` go into the first bin, values past the last bin, infinite ones too, into the last.
///
/// # Errors
/// As for [`measure`]; [`Error::BadOption`] if `interval` is not above 0, `lower` not finite, or `bins` 0.
pub fn histogram<T: Coordinate>(
    positions: &[[T; 3]],
    triangles: &[[u32; 3]],
    parameter: Parameter,
    lower: f64,
    interval: f64,
    bins: usize,
) -> Result<Vec<usize>, Error> {
    let bad = |name, value| Err(Error::BadOption { name, value });
    if !(interval > 0.0 && interval.is_finite()) {
        return bad("interval", interval);
    }
    if !lower.is_finite() {
        return bad("lower", lower);
    }
    if bins == 0 {
        return bad("bins", 0.0);
    }
    let mesh = Mesh::new(positions, triangles, &Threads::ONE)?;
    let mut counts = memory::reserved(bins)?;
    counts.resize(bins, 0);
    for t in triangles {
        let value = parameter.of(&Sides::new(mesh.corners(t)));
        // The cast takes negative values to 0 and infinity to the largest number.
        counts[(((value - lower) / interval) as usize).min(bins - 1)] += 1;
    }
    Ok(counts)
}

impl Measurement {
    /// Measures positions in units of `unit`.
    pub(crate) fn of(
        positions: &Positions<'_>,
        triangles: &[[u32; 3]],
        unit: f64,
        threads: &Threads<'_>,
    ) -> Result<Self, Error> {
        let sides = |t: &[u32; 3]| Sides::new(t.map(|v| positions.at(v as usize)));
        let found = threads.map(0..Parameter::ALL.len(), |i| distribution(Parameter::ALL[i], triangles, sides));
        let mut found = found.into_iter();
        let mut next = || found.next().unwrap_or(Ok(Default::default()));
        let (edge_ratio, (min_angle, [below_10, below_20, below_30])) = (next()?.0, next()?);
        let edges = EdgeCount::of(triangles, positions.len())?;
        let double_areas = || triangles.iter().map(|t| sides(t).double_area());
        Ok(Self {
            vertices: positions.len(),
            triangles: triangles.len(),
            edge_ratio,
            min_angle,
            max_angle: next()?.0,
            shape: next()?.0,
            radius_ratio: next()?.0,
            below_10,
            below_20,
            below_30,
            zero_area: double_areas().filter(|&a| a == 0.0).count(),
            boundary_edges: edges.boundary,
            non_manifold_edges: edges.non_manifold,
            volume: signed_volume(positions, triangles) * unit * unit * unit,
            area: 0.5 * double_areas().sum::<f64>() * unit * unit,
        })
    }

    /// Whether every edge has two triangles that agree.
    pub fn is_closed(&self) -> bool {
        self.boundary_edges == 0 && self.non_manifold_edges == 0
    }

    /// (this − before) / |before| of the signed volume; 0 unless both are closed and enclose one that `f64` can hold.
    pub(crate) fn volume_change_from(&self, before: &Self) -> f64 {
        let comparable = before.volume != 0.0 && before.volume.is_finite() && self.volume.is_finite();
        if self.is_closed() && before.is_closed() && comparable {
            (self.volume - before.volume) / before.volume.abs()
        } else {
            0.0
        }
    }
}

/// Statistics of one parameter, and how many values are below 10, 20 and 30.
fn distribution(
    parameter: Parameter,
    triangles: &[[u32; 3]],
    sides: impl Fn(&[u32; 3]) -> Sides,
) -> Result<(Distribution, [usize; 3]), Error> {
    let mut values = memory::reserved(triangles.len())?;
    values.extend(triangles.iter().map(|t| parameter.of(&sides(t))));
    let below = |angle: f64| values.iter().filter(|&&x| x < angle).count();
    let counts = [below(10.0), below(20.0), below(30.0)];
    Ok((Distribution::of(&mut values), counts))
}

/// Volume of the cone from the centre of the bounding box, summed with error compensation (Neumaier 1974), so that the
/// figure is good enough to show a change of 1e-15.
fn signed_volume(positions: &Positions<'_>, triangles: &[[u32; 3]]) -> f64 {
    let used = || triangles.iter().flatten().map(|&v| positions.at(v as usize));
    let low = used().fold(DVec3::INFINITY, DVec3::min);
    let high = used().fold(DVec3::NEG_INFINITY, DVec3::max);
    let centre = low * 0.5 + high * 0.5;
    let (mut sum, mut lost) = (0.0_f64, 0.0_f64);
    for t in triangles {
        let [a, b, c] = t.map(|v| positions.at(v as usize) - centre);
        let term = a.cross(b).dot(c);
        let next = sum + term;
        lost += if sum.abs() >= term.abs() { (sum - next) + term } else { (term - next) + sum };
        sum = next;
    }
    (sum + lost) / 6.0
}

/// Edges by the number of their triangles.
struct EdgeCount {
    boundary: usize,
    non_manifold: usize,
}

impl EdgeCount {
    /// Triangles that name a vertex twice have no part in it, as they have none in stars.
    fn of(triangles: &[[u32; 3]], vertex_count: usize) -> Result<Self, Error> {
        let mut count = Self { boundary: 0, non_manifold: 0 };
        let mut edges = Buckets::new(triangles, vertex_count)?;
        for v in 0..vertex_count {
            let around = edges.sorted(v);
            for same in around.chunk_by(|e, f| e.0 == f.0) {
                match same {
                    [_] => count.boundary += 1,
                    [first, second] if first.1 != second.1 => {}
                    _ => count.non_manifold += 1,
                }
            }
        }
        Ok(count)
    }
}

/// Directed edges by the lower one of their ends, placed by counting.
struct Buckets {
    /// Where each vertex's edges start; one entry more than vertices.
    starts: Vec<usize>,
    /// The higher end, and whether the edge comes from there.
    edges: Vec<(u32, bool)>,
}

impl Buckets {
    fn new(triangles: &[[u32; 3]], vertex_count: usize) -> Result<Self, Error> {
        let directed = || {
            let proper = triangles.iter().filter(|t| !repeats_a_vertex(t));
            proper.flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)])
        };
        // While edges are placed, entry v + 1 is where the next one of v goes; when all are, it is where they end.
        let mut starts = memory::filled(0, vertex_count + 2)?;
        directed().for_each(|(from, to)| starts[from.min(to) as usize + 2] += 1);
        (2..starts.len()).for_each(|v| starts[v] += starts[v - 1]);
        let mut edges = memory::filled((0, false), starts[vertex_count + 1])?;
        for (from, to) in directed() {
            let place = &mut starts[from.min(to) as usize + 1];
            edges[*place] = (from.max(to), from > to);
            *place += 1;
        }
        Ok(Self { starts, edges })
    }

    /// The edges of `v`, those to one vertex in a row.
    fn sorted(&mut self, v: usize) -> &[(u32, bool)] {
        let own = &mut self.edges[self.starts[v]..self.starts[v + 1]];
        own.sort_unstable();
        own
    }
}
