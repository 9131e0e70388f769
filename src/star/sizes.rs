//! Keeping sizes: a pull of each star towards the sizes that the original mesh has there.
//!
//! What shapes want does not depend on sizes, so smoothing evens them out. Weights on the potential centers could not
//! hold against that: in a regular star all centers coincide. So the sizes get a say of their own.

use glam::DVec3;

use super::local::LocalStar;
use crate::error::Error;
use crate::memory;
use crate::mesh::{Mesh, Stars};
use crate::threads::{PART, Threads};

/// Share of the sizes in what a star wants; the rest is what its shapes want.
pub(super) const SHARE: f64 = 2.0 / 3.0;

/// The mean of pulls in all directions of a plane is half as long as the step that would satisfy them.
const ALL_DIRECTIONS: f64 = 2.0;

/// Original size of each vertex: the root of the mean area of its star's triangles, 0 where there is none.
pub(crate) struct Sizes(Vec<f32>);

impl Sizes {
    /// Measures the original mesh.
    pub fn new(mesh: &Mesh<'_>, stars: &Stars, threads: &Threads<'_>) -> Result<Self, Error> {
        let mut sizes = memory::filled(0.0_f32, mesh.positions.len())?;
        let parts = sizes.chunks_mut(PART).enumerate().collect();
        threads.each(parts, |(part, sizes): (usize, &mut [f32])| {
            for (v, size) in (part * PART..).zip(sizes) {
                *size = original_size(mesh, stars, v as u32) as f32;
            }
        });
        Ok(Self(sizes))
    }

    /// The step by which a star would get its triangles' heights into the ratios that its original sizes ask for.
    ///
    /// The height over a rim edge of length L is to be in proportion to s·√(s/L), s being the original size at the
    /// triangle: half way between the same height whatever the edge, and the same area whatever the edge.
    pub fn pull(&self, star: &LocalStar) -> DVec3 {
        let (mut total, mut wanted, mut lengths) = (0.0, 0.0, 0.0);
        for Spoke { foot, length, height } in self.spokes(star) {
            total += foot.length() * length;
            wanted += height * length;
            lengths += length;
        }
        if !(total > 0.0 && wanted > 0.0) {
            return DVec3::ZERO;
        }
        let scale = total / wanted;
        let pulls = self.spokes(star).map(|Spoke { foot, length, height }| {
            let now = foot.length();
            if now > 0.0 { foot * ((now - height * scale) / now * length) } else { DVec3::ZERO }
        });
        pulls.sum::<DVec3>() * (ALL_DIRECTIONS / lengths)
    }

    /// The triangles of a star that have a rim edge and a size.
    fn spokes(&self, star: &LocalStar) -> impl Iterator<Item = Spoke> {
        (0..star.valence()).filter_map(move |i| {
            let (start, end) = (star.point(i), star.point(i + 1));
            let edge = end - start;
            let length = edge.length();
            let [r, s] = star.rim_edge(i);
            let size = self.mean([star.number(), r, s]);
            (length > 0.0 && size > 0.0).then(|| Spoke {
                foot: start - edge * (start.dot(edge) / (length * length)),
                length,
                height: size * (size / length).sqrt(),
            })
        })
    }

    /// The mean of those sizes that are known.
    fn mean(&self, corners: [u32; 3]) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for size in corners.map(|v| f64::from(self.0[v as usize])) {
            sum += size;
            count += if size > 0.0 { 1.0 } else { 0.0 };
        }
        if count > 0.0 { sum / count } else { 0.0 }
    }
}

/// A triangle of a star, as sizes see it.
struct Spoke {
    /// From the centre to the line of the rim edge.
    foot: DVec3,
    /// Of the rim edge.
    length: f64,
    /// That the original sizes ask for, up to a factor that the whole star has in common.
    height: f64,
}

fn original_size(mesh: &Mesh<'_>, stars: &Stars, v: u32) -> f64 {
    let rim = stars.rim(v);
    let at = |r: u32| mesh.position(r) - mesh.position(v);
    let double_areas = rim.windows(2).map(|edge| at(edge[0]).cross(at(edge[1])).length());
    let triangles = rim.len().saturating_sub(1).max(1);
    (0.5 * double_areas.sum::<f64>() / triangles as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::star::Site;

    fn site(vertex: u32, place: DVec3) -> Site {
        Site { vertex, place, origin: place }
    }

    /// The pull on a centre inside a regular hexagon, the original sizes of which are given from the centre on.
    fn pull(centre: DVec3, sizes: [f32; 7]) -> DVec3 {
        let corner = |i: u32| {
            let angle = f64::from(i) * std::f64::consts::FRAC_PI_3;
            site(i + 1, DVec3::new(libm::cos(angle), libm::sin(angle), 0.0))
        };
        let ring: Vec<_> = (0..6).map(corner).collect();
        let mut star = LocalStar::default();
        star.take_ring(site(0, centre), &ring, None);
        Sizes(sizes.to_vec()).pull(&star)
    }

    #[test]
    fn nothing_pulls_at_a_regular_star_of_equal_sizes() {
        assert!(pull(DVec3::ZERO, [0.7; 7]).length() < 1e-15);
    }

    #[test]
    fn equal_sizes_pull_back_to_the_middle() {
        let off = DVec3::new(0.02, -0.01, 0.0);
        assert!((pull(off, [0.7; 7]) + off).length() < 0.1 * off.length(), "{}", pull(off, [0.7; 7]));
    }

    #[test]
    fn the_centre_is_pulled_to_where_it_was_finer() {
        let found = pull(DVec3::ZERO, [0.7, 0.5, 0.7, 0.7, 0.7, 0.7, 0.7]);
        assert!(found.x > 0.01 && found.y.abs() < 1e-15, "{found}");
    }

    #[test]
    fn unknown_sizes_have_no_say() {
        let known = pull(DVec3::new(0.1, 0.0, 0.0), [0.7; 7]);
        let partly = pull(DVec3::new(0.1, 0.0, 0.0), [0.7, 0.0, 0.7, 0.0, 0.7, 0.7, 0.7]);
        assert!(known.distance(partly) < 1e-8);
        assert_eq!(pull(DVec3::new(0.1, 0.0, 0.0), [0.0; 7]), DVec3::ZERO);
    }
}
