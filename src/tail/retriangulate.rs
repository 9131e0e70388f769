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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn points(coordinates: &[[f64; 2]]) -> Vec<DVec2> {
        coordinates.iter().map(|&p| DVec2::from_array(p)).collect()
    }

    fn area(points: &[DVec2], [a, b, c]: [usize; 3]) -> f64 {
        0.5 * (points[b] - points[a]).perp_dot(points[c] - points[a])
    }

    #[test]
    fn a_square_with_a_point_inside() {
        let points = points(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.4, 0.5]]);
        let triangles = retriangulate(&points, 4).expect("a simple polygon");
        assert_eq!(triangles.len(), 4);
        assert!(triangles.iter().all(|t| t.contains(&4) && area(&points, *t) > 0.0));
    }

    #[test]
    fn what_lies_outside_a_bent_polygon_is_left_out() {
        let points = points(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [3.0, 4.0], [3.0, 1.0], [0.0, 1.0]]);
        let triangles = retriangulate(&points, 6).expect("a simple polygon");
        assert_eq!(triangles.len(), 4);
        assert_eq!(triangles.iter().map(|t| area(&points, *t)).sum::<f64>(), 7.0);
    }

    #[test]
    fn a_polygon_that_crosses_itself_is_refused() {
        assert_eq!(retriangulate(&points(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), 4), None);
    }

    #[test]
    fn coinciding_and_outlying_points_are_refused() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        for last in [[1.0, 1.0], [2.0, 0.5]] {
            let all: Vec<_> = square.into_iter().chain([last]).collect();
            assert_eq!(retriangulate(&points(&all), 4), None);
        }
    }

    #[test]
    fn no_extent_and_no_number_are_refused() {
        assert_eq!(retriangulate(&points(&[[0.0; 2]; 4]), 4), None);
        assert_eq!(retriangulate(&points(&[[0.0, 0.0], [1.0, f64::NAN], [1.0, 1.0]]), 3), None);
    }

    proptest! {
        #[test]
        fn any_points_give_a_triangulation_or_none(
            corners in prop::collection::vec(prop::array::uniform2(-3..=3_i8), 3..12),
            inner in 0..2_usize,
            scale in prop_oneof![Just(1e-200), Just(1.0), Just(1e200)],
        ) {
            let points: Vec<_> = corners.iter().map(|p| DVec2::from_array(p.map(f64::from)) * scale).collect();
            let rim = points.len() - inner;
            if let Some(triangles) = retriangulate(&points, rim) {
                prop_assert_eq!(triangles.len(), rim - 2 + 2 * inner);
            }
        }
    }
}
