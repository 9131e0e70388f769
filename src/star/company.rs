//! Which stars go side by side.

/// Stars side by side.
pub(crate) const LANES: usize = 8;

/// Vertices that are sorted at once, at most.
pub(crate) const TOGETHER: usize = 64;

/// Largest star that goes side by side with others.
const COMPANIONABLE: usize = 16;

/// Stands for the size of all larger stars, and for that of those which are not to go with others.
const OTHERS: usize = COMPANIONABLE + 1;

/// Sizes of stars, and some to spare: a power of two, so that no index needs to be checked.
const SIZES: usize = 32;

/// Vertices whose stars have few triangles, sorted by how many, since a lane waits for the largest star of its company; and
/// behind them the others.
pub(crate) struct Companions {
    sorted: [u32; TOGETHER],
    /// How many have few triangles.
    count: usize,
    /// How many there are in all.
    total: usize,
}

impl Companions {
    /// Sorts at most [`TOGETHER`] `vertices`. `valence` says how many triangles one has, or that it is not to be among the
    /// companions.
    #[inline(always)]
    pub fn new(vertices: impl Iterator<Item = u32>, valence: impl Fn(u32) -> Option<usize>) -> Self {
        // How many there are of each size stands one place further, and becomes where the next size starts.
        let (mut found, mut total, mut starts) = ([(0, 0); TOGETHER], 0, [0; SIZES]);
        for (v, found) in vertices.zip(&mut found) {
            let size = valence(v).map_or(OTHERS, |valence| valence.min(OTHERS));
            *found = (v, size as u32);
            starts[(size + 1) % SIZES] += 1;
            total += 1;
        }
        for size in 1..=OTHERS {
            starts[size] += starts[size - 1];
        }
        let (mut sorted, count) = ([0; TOGETHER], starts[OTHERS]);
        for &(v, size) in &found[..total] {
            let place = &mut starts[size as usize % SIZES];
            sorted[*place % TOGETHER] = v;
            *place += 1;
        }
        Self { sorted, count, total }
    }

    /// How many companions there are.
    pub fn len(&self) -> usize {
        self.count
    }

    /// The companions, and behind them the others.
    pub fn all(&self) -> &[u32] {
        &self.sorted[..self.total]
    }

    /// Companies of companions. With each goes how many there are.
    #[inline(always)]
    pub fn companies(&self) -> impl Iterator<Item = ([u32; LANES], usize)> {
        companies(&self.sorted[..self.count])
    }
}

/// Companies of as many vertices as there are lanes; the last one may be smaller, and then repeats its first. With each goes
/// how many it has.
#[inline(always)]
pub(crate) fn companies(vertices: &[u32]) -> impl Iterator<Item = ([u32; LANES], usize)> {
    let (full, rest) = vertices.as_chunks::<LANES>();
    let last = rest.first().map(|&first| {
        let at = |i: usize| rest.get(i).copied().unwrap_or(first);
        (std::array::from_fn(at), rest.len())
    });
    full.iter().map(|&company| (company, LANES)).chain(last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Mesh, Stars};
    use crate::threads::Threads;

    /// Separate closed fans with these numbers of triangles, and the vertices in their centres.
    fn fans(valences: &[u32]) -> (Vec<[u32; 3]>, Vec<u32>, usize) {
        let (mut triangles, mut centres, mut count) = (Vec::new(), Vec::new(), 0);
        for &valence in valences {
            triangles.extend((0..valence).map(|i| [count, count + 1 + i, count + 1 + (i + 1) % valence]));
            centres.push(count);
            count += valence + 1;
        }
        (triangles, centres, count as usize)
    }

    #[test]
    fn small_stars_are_sorted_and_the_others_named() {
        let (triangles, centres, count) = fans(&[7, 3, 16, 17, 5, 3, 6, 6, 4, 5, 40]);
        let positions = vec![[0.0_f64; 3]; count];
        let mesh = Mesh::new(positions.as_slice(), &triangles, &Threads::ONE).unwrap();
        let stars = Stars::new(&mesh, &Threads::ONE).unwrap();
        let unwanted = centres[6];
        let companions = Companions::new(centres.iter().copied(), |v| stars.valence(v).filter(|_| v != unwanted));
        assert_eq!(companions.all(), [1, 5, 8, 4, 9, 7, 0, 2, 3, 6, 10].map(|i| centres[i]));
        let found: Vec<_> = companions.companies().collect();
        assert_eq!(found, [([1, 5, 8, 4, 9, 7, 0, 2].map(|i| centres[i]), 8)]);
    }

    #[test]
    fn a_small_company_repeats_its_first() {
        let (triangles, centres, count) = fans(&[5; 10]);
        let positions = vec![[0.0_f64; 3]; count];
        let mesh = Mesh::new(positions.as_slice(), &triangles, &Threads::ONE).unwrap();
        let stars = Stars::new(&mesh, &Threads::ONE).unwrap();
        let companions = Companions::new(centres.iter().copied(), |v| stars.valence(v));
        let (last, count) = companions.companies().nth(1).unwrap();
        assert_eq!((last, count), ([8, 9, 8, 8, 8, 8, 8, 8].map(|i| centres[i]), 2));
    }
}
