//! Edges along which texture coordinates, materials or groups part: no triangle may be made across them.

/// Pairs of vertices of all edges whose triangles disagree. `corners` has a value for each corner (3 × triangle + 0, 1
/// or 2), `regions` one for each triangle; values matter only by being equal or not. Either may be empty.
pub fn find(triangles: &[[u32; 3]], corners: &[u32], regions: &[u32]) -> Vec<[u32; 2]> {
    if corners.is_empty() && regions.is_empty() {
        return Vec::new();
    }
    let corner = |t: usize, k: usize| corners.get(3 * t + k).copied().unwrap_or_default();
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (t, triangle) in triangles.iter().enumerate() {
        let region = regions.get(t).copied().unwrap_or_default();
        for (k, l) in [(0, 1), (1, 2), (2, 0)] {
            let (k, l) = if triangle[k] < triangle[l] { (k, l) } else { (l, k) };
            sides.push(([triangle[k], triangle[l]], [corner(t, k), corner(t, l), region]));
        }
    }
    sides.sort_unstable();
    let parts = |pair: &&[([u32; 2], [u32; 3])]| pair[0].0 == pair[1].0 && pair[0].1 != pair[1].1;
    let mut edges: Vec<_> = sides.windows(2).filter(parts).map(|pair| pair[0].0).collect();
    edges.dedup();
    edges
}

/// Gives equal values equal numbers, from 0 in the order in which they come.
#[derive(Default)]
pub struct Values(std::collections::HashMap<Vec<u8>, u32>);

impl Values {
    /// The number of this value.
    pub fn number(&mut self, value: &[u8]) -> u32 {
        if let Some(&number) = self.0.get(value) {
            return number;
        }
        let number = self.0.len() as u32;
        self.0.insert(value.to_vec(), number);
        number
    }
}

#[cfg(test)]
mod tests {
    use super::{Values, find};

    const SQUARE: [[u32; 3]; 2] = [[0, 1, 2], [3, 2, 1]];

    #[test]
    fn corners_part_where_one_end_differs() {
        assert_eq!(find(&SQUARE, &[9, 1, 2, 8, 2, 1], &[]), [[0; 2]; 0]);
        assert_eq!(find(&SQUARE, &[9, 1, 2, 8, 2, 7], &[]), [[1, 2]]);
    }

    #[test]
    fn regions_part_along_their_border() {
        assert_eq!(find(&SQUARE, &[], &[4, 4]), [[0; 2]; 0]);
        assert_eq!(find(&SQUARE, &[], &[4, 5]), [[1, 2]]);
        assert_eq!(find(&SQUARE, &[], &[]), [[0; 2]; 0]);
    }

    #[test]
    fn equal_values_have_equal_numbers() {
        let mut values = Values::default();
        assert_eq!([b"a", b"b", b"a"].map(|value| values.number(value)), [0, 1, 0]);
    }
}
