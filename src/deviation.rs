//! Distance from the original surface.

use glam::DVec3;

use crate::mesh::{Mesh, Positions, Stars};
use crate::threads::{PART, Threads};

/// The surface as it came in.
pub(crate) struct Surface<'a> {
    mesh: &'a Mesh<'a>,
    stars: &'a Stars,
}

impl<'a> Surface<'a> {
    pub fn new(mesh: &'a Mesh<'a>, stars: &'a Stars) -> Self {
        Self { mesh, stars }
    }

    /// The greatest distance of those vertices that have moved to `new` and that `counts` holds for.
    pub fn farthest(&self, new: &Positions<'_>, counts: impl Fn(u32) -> bool + Sync, threads: &Threads<'_>) -> f64 {
        let of_part = |part: usize| {
            let vertices = part * PART..((part + 1) * PART).min(new.len());
            let moved = vertices.filter(|&v| new.at(v) != self.mesh.positions.at(v) && counts(v as u32));
            moved.map(|v| self.distance(v as u32, new.at(v))).fold(0.0, f64::max)
        };
        threads.map(0..new.len().div_ceil(PART), of_part).into_iter().fold(0.0, f64::max)
    }

    /// Distance from `point`, where vertex `v` has come to lie, to the original surface. Only triangles around the
    /// original vertex nearest to the point are looked at, found by walking from `v`, and those around its ring, hubs left
    /// out, if the surface comes nearer to the point towards the rim: never less than the true distance.
    pub fn distance(&self, v: u32, point: DVec3) -> f64 {
        let nearest = self.walk(v, point);
        let Reach { mut least, rim } = self.distance_to_star(nearest, point);
        if least >= rim * (1.0 - 1e-9) {
            for &r in self.stars.ring(nearest).iter().filter(|&&r| !self.stars.is_hub(r)) {
                least = least.min(self.distance_to_star(r, point).least);
            }
        }
        least.sqrt()
    }

    /// From vertex to vertex, hubs left out, as long as one of the ring is nearer to the point.
    fn walk(&self, mut v: u32, point: DVec3) -> u32 {
        loop {
            let square = |r: u32| self.mesh.position(r).distance_squared(point);
            let ring = self.stars.ring(v).iter().copied().filter(|&r| !self.stars.is_hub(r));
            let next = ring.min_by(|&a, &b| square(a).total_cmp(&square(b)));
            match next {
                Some(next) if square(next) < square(v) => v = next,
                _ => return v,
            }
        }
    }

    /// Squared distances to the original triangles around `v` and to their rim.
    fn distance_to_star(&self, v: u32, point: DVec3) -> Reach {
        let p = |k: u32| self.mesh.position(k);
        let ring = self.stars.ring(v);
        let turn = if self.stars.flanks(v, 0).is_some() { ring.first() } else { None };
        let around = ring.iter().chain(turn).map(|&r| p(r));
        let mut reach = Reach { least: p(v).distance_squared(point), rim: f64::INFINITY };
        for (a, b) in around.clone().zip(around.skip(1)) {
            reach.least = reach.least.min(nearest_on_triangle(point, [p(v), a, b]).distance_squared(point));
            reach.rim = reach.rim.min(nearest_on_segment(point, a, b).distance_squared(point));
        }
        reach
    }
}

/// Squared distances from a point to a star.
struct Reach {
    /// To its triangles.
    least: f64,
    /// To its rim.
    rim: f64,
}

/// The point of a triangle nearest to `point`: the foot of the perpendicular, if it falls inside, else the nearest point
/// of the sides.
pub(crate) fn nearest_on_triangle(point: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let normal = (b - a).cross(c - a);
    let square = normal.length_squared();
    let inside = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal) >= 0.0;
    if square > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        return point - normal * ((point - a).dot(normal) / square);
    }
    let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| nearest_on_segment(point, from, to));
    sides.into_iter().min_by(|p, q| p.distance_squared(point).total_cmp(&q.distance_squared(point))).unwrap_or(a)
}

fn nearest_on_segment(point: DVec3, a: DVec3, b: DVec3) -> DVec3 {
    let along = b - a;
    let square = along.length_squared();
    let t = if square > 0.0 { (point - a).dot(along) / square } else { 0.0 };
    a + along * t.clamp(0.0, 1.0)
}
