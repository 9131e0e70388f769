//! The validated mesh: every index in range, every coordinate finite.

use std::borrow::Cow;
use std::ops::Range;

use fearless_simd::{Level, dispatch};
use glam::DVec3;

use super::{Coordinate, Positions, Vertices};
use crate::error::Error;
use crate::threads::{PART, Threads};

/// A mesh that the upper layers can trust. Triangles that name a vertex twice are still in it: no star takes them up.
pub(crate) struct Mesh<'a> {
    /// Positions in units of `unit`; where that is 1, in the precision of the caller's buffer, and there if they lie one after the other.
    pub positions: Positions<'a>,
    /// Corners of each triangle.
    pub triangles: &'a [[u32; 3]],
    /// The least and the greatest corner of each [`PART`] of the triangles.
    spans: Vec<[u32; 2]>,
    /// Power of two by which positions were divided, so that squares and cubes of them stay within range.
    pub unit: f64,
    /// Whether the caller's buffer holds single precision.
    single: bool,
}

impl<'a> Mesh<'a> {
    /// Checks the buffers.
    pub fn new<T: Coordinate>(
        positions: &'a (impl Vertices<T> + ?Sized),
        triangles: &'a [[u32; 3]],
        threads: &Threads<'_>,
    ) -> Result<Self, Error> {
        let vertex_count = positions.count();
        check_counts(vertex_count, triangles.len())?;
        let parts = threads.parts(triangles.len(), |part| check_indices(triangles, part, vertex_count));
        let spans = parts.into_iter().collect::<Result<_, Error>>()?;
        let parts = threads.parts(vertex_count, |part| largest_coordinate(positions, part));
        let unit = unit_of(parts.into_iter().try_fold(0.0, |largest, part| Ok(f64::max(largest, part?)))?);
        let single = T::from_f64(0.1).to_f64() != 0.1;
        let positions = if unit != 1.0 {
            Positions::doubles(vertex_count, |v| in_units(positions.get(v), unit), threads)?
        } else if let Some(all) = positions.as_slice() {
            T::positions(Cow::Borrowed(all))
        } else {
            T::positions(Cow::Owned(threads.collect(vertex_count, |v| positions.get(v))?))
        };
        Ok(Self { positions, triangles, spans, unit, single })
    }

    /// Position of a vertex.
    #[inline(always)]
    pub fn position(&self, v: u32) -> DVec3 {
        self.positions.at(v as usize)
    }

    /// The triangles, part by part, without those parts in which no corner is one of these `vertices`. With each part goes the number
    /// of its first triangle.
    #[inline(always)]
    pub fn parts_with(&self, vertices: Range<usize>) -> impl DoubleEndedIterator<Item = (usize, &'a [[u32; 3]])> {
        let parts = self.triangles.chunks(PART).zip(&self.spans).enumerate();
        let meets =
            move |&[least, greatest]: &[u32; 2]| (least as usize) < vertices.end && greatest as usize >= vertices.start;
        parts.filter(move |(_, (_, span))| meets(span)).map(|(part, (triangles, _))| (part * PART, triangles))
    }

    /// Positions of the corners of a triangle.
    #[inline]
    pub fn corners(&self, triangle: &[u32; 3]) -> [DVec3; 3] {
        triangle.map(|v| self.position(v))
    }

    /// The nearest position that the caller's buffers can hold.
    #[inline(always)]
    pub fn storable(&self, position: DVec3) -> DVec3 {
        if self.holds_everything() {
            position
        } else if self.single {
            self.rounded::<f32>(position)
        } else {
            self.rounded::<f64>(position)
        }
    }

    /// Whether the caller's buffers can hold every position.
    #[inline(always)]
    pub fn holds_everything(&self) -> bool {
        !self.single && self.unit == 1.0
    }

    fn rounded<T: Coordinate>(&self, position: DVec3) -> DVec3 {
        DVec3::from_array(position.to_array().map(|x| T::from_f64(x * self.unit).to_f64() / self.unit))
    }
}

/// A position of the caller's in units.
#[inline(always)]
pub(crate) fn in_units<T: Coordinate>(position: [T; 3], unit: f64) -> DVec3 {
    // Scaling down takes two steps where the reciprocal itself would be subnormal.
    DVec3::from_array(position.map(Coordinate::to_f64)) / unit
}

/// A position in units as it is written into the caller's buffer.
#[inline(always)]
pub(crate) fn stored<T: Coordinate>(position: DVec3, unit: f64) -> [T; 3] {
    position.to_array().map(|x| T::from_f64(x * unit))
}

/// Whether a triangle names a vertex twice.
pub(crate) fn repeats_a_vertex(&[a, b, c]: &[u32; 3]) -> bool {
    a == b || b == c || c == a
}

fn check_counts(vertices: usize, triangles: usize) -> Result<(), Error> {
    // Stars take three slots a triangle and one a vertex, numbered by u32.
    let slots = triangles.saturating_mul(3).saturating_add(vertices);
    if slots >= u32::MAX as usize {
        return Err(Error::TooLarge { count: vertices.max(triangles) });
    }
    Ok(())
}

/// Returns the least and the greatest index of a part of the triangles.
fn check_indices(triangles: &[[u32; 3]], part: Range<usize>, vertex_count: usize) -> Result<[u32; 2], Error> {
    let indices = triangles[part.clone()].as_flattened();
    let span = dispatch!(Level::new(), _simd => span(indices));
    if (span[1] as usize) < vertex_count {
        return Ok(span);
    }
    // Only now does it matter which it was.
    for triangle in part {
        for index in triangles[triangle] {
            if index as usize >= vertex_count {
                return Err(Error::IndexOutOfRange { triangle, index, vertex_count });
            }
        }
    }
    Ok(span)
}

/// The least and the greatest of several numbers.
#[inline(always)]
fn span(numbers: &[u32]) -> [u32; 2] {
    let (mut least, mut greatest) = (u32::MAX, 0);
    for &number in numbers {
        least = least.min(number);
        greatest = greatest.max(number);
    }
    [least, greatest]
}

fn largest_coordinate<T: Coordinate>(
    positions: &(impl Vertices<T> + ?Sized),
    part: Range<usize>,
) -> Result<f64, Error> {
    let mut largest = 0.0_f64;
    for vertex in part {
        let position = positions.at(vertex);
        let size = position.iter().fold(0.0_f64, |m, x| m + x.to_f64().abs());
        // A sum may be too large of coordinates that are not.
        if !size.is_finite() && !position.iter().all(|x| x.to_f64().is_finite()) {
            return Err(Error::NonFinite { vertex });
        }
        largest = largest.max(size.min(f64::MAX));
    }
    Ok(largest)
}

/// 1 for coordinates of ordinary size, so that nothing is rescaled; else the power of two next below `largest`.
fn unit_of(largest: f64) -> f64 {
    const ORDINARY: std::ops::Range<f64> = 1e-10..1e10;
    if largest == 0.0 || ORDINARY.contains(&largest) {
        return 1.0;
    }
    let exponent = libm::ilogb(largest).clamp(-1022, 1022);
    libm::ldexp(1.0, exponent)
}
