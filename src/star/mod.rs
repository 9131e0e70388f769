//! Stars taken out of the mesh, one or eight side by side: what they look like, and the operation on them, one file for each of
//! its steps.

mod company;
mod cone;
mod fan;
mod form;
mod forms;
mod local;
mod model;
mod number;
mod operation;
mod plane;
mod ring;
mod sample;
mod sizes;
mod vectors;
mod witness;

pub(crate) use company::{Companions, LANES, TOGETHER, companies};
pub(crate) use cone::{ConeFinder, ConeRows, Cones};
pub(crate) use local::{Countdown, LocalStar, LocalStars, Site, double_vector_area};
pub(crate) use number::{Arithmetic, Number, Single};
pub(crate) use operation::{Draft, Operation};
pub(crate) use plane::TangentPlane;
pub(crate) use sizes::Sizes;
pub(crate) use vectors::{Vectors, set_vector, vector};
pub(crate) use witness::{Arm, CLEAR, LARGEST_TURN, MEANINGLESS, THIN, Witness};

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, Simd, dispatch, f64x8};
    use glam::DVec3;

    use super::*;
    use crate::mesh::{Mesh, Stars};
    use crate::options::Options;
    use crate::threads::Threads;

    /// Targets of eight stars at once.
    #[inline(always)]
    fn together<S: Simd>(simd: S, mesh: &Mesh<'_>, stars: &Stars, vertices: &[u32; 8]) -> [DVec3; 8] {
        let (mut local, mut draft) = (LocalStars::<f64x8<S>>::default(), Draft::default());
        local.take(simd, stars, |vertex| site(mesh, vertex), vertices);
        let areas = local.areas(simd);
        let rows = Operation::new(&Options::default(), None).targets(simd, &local, &areas, &mut draft).0.rows();
        std::array::from_fn(|star| vector(&rows, star))
    }

    fn alone(mesh: &Mesh<'_>, stars: &Stars, v: u32) -> DVec3 {
        let mut local = LocalStar::default();
        local.take((), stars, |vertex| site(mesh, vertex), &[v]);
        Operation::new(&Options::default(), None).target(&local, &mut Draft::default()).unwrap()
    }

    fn site(mesh: &Mesh<'_>, vertex: u32) -> Site {
        let place = mesh.position(vertex);
        Site { vertex, place, origin: place }
    }

    #[test]
    fn a_star_has_the_same_bits_alone_and_in_company() {
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        for valence in 3..11_u32 {
            let centre = positions.len() as u32;
            positions.push([0.1, 0.05 * f64::from(valence), 0.2]);
            for i in 0..valence {
                let angle = f64::from(i) / f64::from(valence) * std::f64::consts::TAU;
                positions.push([angle.cos() * (1.0 + f64::from(i % 3)), angle.sin(), 0.3 * f64::from(i % 2)]);
                triangles.push([centre, centre + 1 + i, centre + 1 + (i + 1) % valence]);
            }
        }
        let mesh = Mesh::new(positions.as_slice(), &triangles, &crate::threads::Threads::ONE).unwrap();
        let stars = Stars::new(&mesh, &Threads::ONE).unwrap();
        let mut vertices = [0; 8];
        for (star, v) in vertices.iter_mut().enumerate().skip(1) {
            *v = (0..star as u32).map(|i| i + 4).sum();
        }
        let found = dispatch!(Level::new(), simd => together(simd, &mesh, &stars, &vertices));
        for (star, &v) in vertices.iter().enumerate() {
            assert_eq!(found[star].to_array(), alone(&mesh, &stars, v).to_array(), "star {star}");
        }
    }
}
