//! Vertex positions in the precision of their file.

use std::fmt::Debug;
use std::str::FromStr;

use qsmesh::Coordinate;

/// A coordinate that files can hold, as text and as bytes.
pub trait Stored: Coordinate + FromStr + Debug + PartialEq {
    /// Its bits, widened: two coordinates are written alike exactly if these agree.
    fn bits(self) -> u64;
}

impl Stored for f32 {
    fn bits(self) -> u64 {
        u64::from(self.to_bits())
    }
}

impl Stored for f64 {
    fn bits(self) -> u64 {
        self.to_bits()
    }
}

/// All positions of a mesh. The library works on the type that the file holds, so that what it has checked is what
/// is written.
#[derive(Debug, Clone, PartialEq)]
pub enum Positions {
    /// PLY `float`, STL.
    F32(Vec<[f32; 3]>),
    /// PLY `double` and the text formats OBJ and OFF.
    F64(Vec<[f64; 3]>),
}

impl Positions {
    /// How many.
    pub fn len(&self) -> usize {
        match self {
            Self::F32(p) => p.len(),
            Self::F64(p) => p.len(),
        }
    }

    /// Position of `vertex`, widened exactly.
    pub fn at(&self, vertex: usize) -> [f64; 3] {
        match self {
            Self::F32(p) => p[vertex].map(f64::from),
            Self::F64(p) => p[vertex],
        }
    }

    /// Whether `vertex` has other bits than vertex `former` of `before`, which is in the same precision.
    pub fn differ(&self, vertex: usize, before: &Self, former: usize) -> bool {
        match (self, before) {
            (Self::F32(a), Self::F32(b)) => a[vertex].map(Stored::bits) != b[former].map(Stored::bits),
            (Self::F64(a), Self::F64(b)) => a[vertex].map(Stored::bits) != b[former].map(Stored::bits),
            _ => true,
        }
    }

    /// Rounded to 32 bits.
    pub fn narrowed(&self) -> Self {
        match self {
            Self::F32(p) => Self::F32(p.clone()),
            Self::F64(p) => Self::F32(p.iter().map(|p| p.map(|x| x as f32)).collect()),
        }
    }

    /// One coordinate as the shortest text that reads back to the same bits.
    pub fn text(&self, vertex: usize, axis: usize) -> String {
        match self {
            Self::F32(p) => format!("{:?}", p[vertex][axis]),
            Self::F64(p) => format!("{:?}", p[vertex][axis]),
        }
    }

    /// Diagonal of the bounding box of the finite positions, 0 without any.
    pub fn diagonal(&self) -> f64 {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for point in (0..self.len()).map(|vertex| self.at(vertex)).filter(|p| p.iter().all(|x| x.is_finite())) {
            for axis in 0..3 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        let sides = [0, 1, 2].map(|axis| (high[axis] - low[axis]).max(0.0));
        sides[0].hypot(sides[1]).hypot(sides[2])
    }
}

#[cfg(test)]
mod tests {
    use super::Positions;

    #[test]
    fn negative_zero_counts_as_moved() {
        let before = Positions::F64(vec![[0.0, 1.0, 2.0]]);
        assert!(Positions::F64(vec![[-0.0, 1.0, 2.0]]).differ(0, &before, 0));
        assert!(!before.differ(0, &before, 0));
    }

    #[test]
    fn text_reads_back_to_the_same_bits() {
        let value = 0.1 + 0.2;
        let text = Positions::F64(vec![[value, 1e300, -0.0]]).text(0, 0);
        assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits());
        assert_eq!(Positions::F32(vec![[0.1, 0.0, 0.0]]).text(0, 0), "0.1");
    }

    #[test]
    fn diagonal_leaves_out_what_is_not_finite() {
        let positions = Positions::F32(vec![[0.0; 3], [f32::NAN, 0.0, 0.0], [2.0, 1.0, 2.0]]);
        assert_eq!(positions.diagonal(), 3.0);
        assert_eq!(Positions::F64(Vec::new()).diagonal(), 0.0);
    }
}
