//! Around which vertices it is plain that no edge is sharp.

use crate::error::Error;
use crate::mesh::{Mesh, Stars};
use crate::star::{ConeFinder, Cones};
use crate::threads::{PART, Threads};

/// Where a mesh is plainly flat.
pub(super) enum Flat<'a> {
    /// Cones say so, of which this is the cosine of the angle.
    Cones(&'a Cones, f64),
    /// A bit for each vertex.
    Bits(Vec<u64>),
}

impl Flat<'_> {
    /// Asks cones that are not kept.
    pub fn bits(mesh: &Mesh<'_>, stars: &Stars, sharp: f64, threads: &Threads<'_>) -> Result<Self, Error> {
        let finder = ConeFinder::new(mesh);
        let parts = threads.map(0..stars.len().div_ceil(PART), |part| {
            let vertices = part * PART..((part + 1) * PART).min(stars.len());
            let cones = finder.some(mesh, stars, vertices.clone())?;
            let bit = |v: usize| u64::from(cones.is_flat(v as u32, sharp)) << (v % 64);
            let word = |first: usize| (first..vertices.end.min(first + 64)).fold(0, |word, v| word | bit(v));
            Ok(vertices.clone().step_by(64).map(word).collect::<Vec<_>>())
        });
        Ok(Self::Bits(parts.into_iter().collect::<Result<Vec<_>, Error>>()?.concat()))
    }

    /// Whether it is plain that no edge at `v` is sharp.
    pub fn is_around(&self, v: u32) -> bool {
        match self {
            Self::Cones(cones, sharp) => cones.is_flat(v, *sharp),
            Self::Bits(bits) => bits[v as usize / 64] >> (v % 64) & 1 == 1,
        }
    }
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
        let (kept, asked) = (Flat::Cones(&cones, 0.9), Flat::bits(&mesh, &stars, 0.9, &Threads::ONE).expect("bits"));
        let flat: Vec<_> = (0..20_000).map(|v| kept.is_around(v)).collect();
        assert!((0..20_000).all(|v| asked.is_around(v) == flat[v as usize]));
        assert!(flat.contains(&true) && flat.contains(&false));
    }
}
