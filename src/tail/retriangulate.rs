//! Filling a polygon with triangles: the constrained Delaunay triangulation of the rim and an inner vertex.

use glam::DVec2;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Triangles, as indices into `points`, that fill the polygon of the first `rim` points, which must run counter-clockwise;
/// further points lie inside. `None` if the polygon is not simple, points coincide, or one that should lie inside does not.
pub(super) fn retriangulate(points: &[DVec2], rim: usize) -> Option<Vec<[usize; 3]>> {
    let size = points.iter().fold(0.0_f64, |m, p| m.max(p.x.abs()).max(p.y.abs()));
    let vertices = points.iter().map(|p| spade::mitigate_underflow(Point2::new(p.x / size, p.y / size))).collect();
    let edges = (0..rim).map(|i| [i, (i + 1) % rim]).collect();
    let mut conflicts = false;
    let triangulation =
        ConstrainedDelaunayTriangulation::<_>::try_bulk_load_cdt(vertices, edges, |_| conflicts = true).ok()?;
    // Fewer vertices than points: some coincide, and the indices no longer tell which.
    if conflicts || triangulation.num_vertices() != points.len() {
        return None;
    }
    let faces = triangulation.inner_faces().map(|face| face.vertices().map(|v| v.index()));
    let triangles: Vec<_> = faces.filter(|f| is_inside(points, rim, *f)).collect();
    // Euler's formula for a disc.
    (triangles.len() + 2 == rim + 2 * (points.len() - rim)).then_some(triangles)
}

/// Whether the middle of a triangle lies inside the polygon: a ray to the right crosses it an odd number of times.
fn is_inside(points: &[DVec2], rim: usize, face: [usize; 3]) -> bool {
    let middle = face.iter().map(|&i| points[i]).sum::<DVec2>() / 3.0;
    let crossings = (0..rim).filter(|&i| {
        let (a, b) = (points[i] - middle, points[(i + 1) % rim] - middle);
        // The crossing lies to the right if the edge turns counter-clockwise where it rises.
        (a.y > 0.0) != (b.y > 0.0) && (a.perp_dot(b) > 0.0) == (b.y > a.y)
    });
    crossings.count() % 2 == 1
}
