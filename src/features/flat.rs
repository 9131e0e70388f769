//! Around which vertices it is plain that no edge is sharp: a bit for each, since cones lie too far apart to be asked edge by edge.

use std::ops::Range;

use crate::error::Error;
use crate::mesh::{Mesh, Stars};
use crate::star::{ConeFinder, Cones};
use crate::threads::{PART, Threads};

/// Where a mesh is plainly flat.
pub(super) struct Flat(Vec<u64>);

impl Flat {
    /// Asks the cones, or where they are not kept finds them and forgets them; `sharp` is the cosine of the angle.
    pub fn new(
        (mesh, stars, cones): (&Mesh<'_>, &Stars, Option<&Cones>),
        sharp: f64,
        threads: &Threads<'_>,
    ) -> Result<Self, Error> {
        let finder = ConeFinder::new(mesh);
        let parts = threads.parts(stars.len(), |vertices| match cones {
            Some(cones) => Ok(words(cones, vertices, sharp)),
            None => finder.some(mesh, stars, vertices.clone()).map(|cones| words(&cones, vertices, sharp)),
        });
        Ok(Self(parts.into_iter().collect::<Result<Vec<_>, Error>>()?.concat()))
    }

    /// Those of a part of the vertices at which that is not plain, by index.
    pub fn others(&self, part: Range<usize>) -> impl Iterator<Item = u32> {
        let words = (part.start / 64..part.end.div_ceil(64)).zip(&self.0[part.start / 64..]);
        words.flat_map(|(number, &word)| {
            let mut rest = !word;
            std::iter::from_fn(move || {
                let bit = rest.trailing_zeros();
                rest &= rest.wrapping_sub(1);
                (bit < u64::BITS).then_some(number as u32 * u64::BITS + bit)
            })
        })
    }

    /// Whether it is plain that no edge at `v` is sharp.
    #[inline]
    pub fn is_around(&self, v: u32) -> bool {
        self.0[v as usize / 64] >> (v % 64) & 1 == 1
    }
}

// The parts of a mesh begin with a new word.
const _: () = assert!(PART.is_multiple_of(64));

/// The bits of some vertices.
fn words(cones: &Cones, vertices: Range<usize>, sharp: f64) -> Vec<u64> {
    let bit = |v: usize| u64::from(cones.is_flat(v as u32, sharp)) << (v % 64);
    // Behind the last vertex nothing is to be found.
    let behind = |first: usize| u64::MAX.checked_shl((vertices.end - first) as u32).unwrap_or(0);
    let word = |first: usize| (first..vertices.end.min(first + 64)).fold(behind(first), |word, v| word | bit(v));
    vertices.clone().step_by(64).map(word).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_say_what_cones_say() {
        // A strip that is bent at each hundredth step.
        let at = |i: u32| [f64::from(i / 2), f64::from(i % 2), f64::from(i / 2 % 100) * f64::from(i / 200 % 2)];
        let positions: Vec<_> = (0..20_000).map(at).collect();
        let triangles: Vec<_> =
            (0..19_998).map(|i| if i % 2 == 0 { [i, i + 2, i + 1] } else { [i, i + 1, i + 2] }).collect();
        let mesh = Mesh::new(positions.as_slice(), &triangles, &Threads::ONE).expect("a mesh");
        let stars = Stars::new(&mesh, &Threads::ONE).expect("stars");
        let cones = ConeFinder::new(&mesh).all(&mesh, &stars, &Threads::ONE).expect("cones");
        let flat: Vec<_> = (0..20_000).map(|v| cones.is_flat(v, 0.9)).collect();
        for cones in [Some(&cones), None] {
            let bits = Flat::new((&mesh, &stars, cones), 0.9, &Threads::ONE).expect("bits");
            assert!((0..20_000).all(|v| bits.is_around(v) == flat[v as usize]));
            for part in [0..PART, PART..2 * PART, 2 * PART..20_000] {
                let others: Vec<_> = part.clone().filter(|&v| !flat[v]).map(|v| v as u32).collect();
                assert!(bits.others(part).eq(others));
            }
        }
        assert!(flat.contains(&true) && flat.contains(&false));
    }
}
