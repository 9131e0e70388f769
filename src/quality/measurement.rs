//! Quality of a whole mesh.

use glam::DVec3;

use super::Parameter;
use super::distribution::Distribution;
use super::triangle::Sides;
use crate::error::Error;
use crate::memory;
use crate::mesh::{Coordinate, Mesh, repeats_a_vertex};

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
    let mesh = Mesh::new(positions, triangles)?;
    Measurement::of(&mesh.positions, triangles, mesh.unit)
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
    let mesh = Mesh::new(positions, triangles)?;
    let mut counts = memory::filled(0, bins)?;
    for t in triangles {
        let value = parameter.of(&Sides::new(mesh.corners(t)));
        // The cast takes negative values to 0 and infinity to the largest number.
        counts[(((value - lower) / interval) as usize).min(bins - 1)] += 1;
    }
    Ok(counts)
}

impl Measurement {
    /// Measures positions in units of `unit`.
    pub(crate) fn of(positions: &[DVec3], triangles: &[[u32; 3]], unit: f64) -> Result<Self, Error> {
        let mut values = memory::reserved(triangles.len())?;
        let sides = |t: &[u32; 3]| Sides::new(t.map(|v| positions[v as usize]));
        let mut distribution = |parameter: Parameter| {
            values.clear();
            values.extend(triangles.iter().map(|t| parameter.of(&sides(t))));
            let below = |angle: f64| values.iter().filter(|&&x| x < angle).count();
            let counts = [below(10.0), below(20.0), below(30.0)];
            (Distribution::of(&mut values), counts)
        };
        let (min_angle, [below_10, below_20, below_30]) = distribution(Parameter::MinAngle);
        let edges = EdgeCount::of(triangles)?;
        let double_areas = || triangles.iter().map(|t| sides(t).double_area());
        Ok(Self {
            vertices: positions.len(),
            triangles: triangles.len(),
            edge_ratio: distribution(Parameter::EdgeRatio).0,
            min_angle,
            max_angle: distribution(Parameter::MaxAngle).0,
            shape: distribution(Parameter::Shape).0,
            radius_ratio: distribution(Parameter::RadiusRatio).0,
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

/// Volume of the cone from the centre of the bounding box, summed with error compensation (Neumaier 1974), so that the
/// figure is good enough to show a change of 1e-15.
fn signed_volume(positions: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
    let used = || triangles.iter().flatten().map(|&v| positions[v as usize]);
    let low = used().fold(DVec3::INFINITY, DVec3::min);
    let high = used().fold(DVec3::NEG_INFINITY, DVec3::max);
    let centre = low * 0.5 + high * 0.5;
    let (mut sum, mut lost) = (0.0_f64, 0.0_f64);
    for t in triangles {
        let [a, b, c] = t.map(|v| positions[v as usize] - centre);
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
    fn of(triangles: &[[u32; 3]]) -> Result<Self, Error> {
        let mut edges = memory::reserved(3 * triangles.len())?;
        for &[a, b, c] in triangles.iter().filter(|t| !repeats_a_vertex(t)) {
            edges.extend([(a, b), (b, c), (c, a)].map(|(from, to)| (from.min(to), from.max(to), from < to)));
        }
        edges.sort_unstable();
        let mut count = Self { boundary: 0, non_manifold: 0 };
        for same in edges.chunk_by(|e, f| (e.0, e.1) == (f.0, f.1)) {
            match same {
                [_] => count.boundary += 1,
                [first, second] if first.2 != second.2 => {}
                _ => count.non_manifold += 1,
            }
        }
        Ok(count)
    }
}
