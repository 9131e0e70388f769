//! What must hold of every result.

use std::collections::BTreeMap;

use qsmesh::{Sources, measure};

use crate::meshes::{Point, Soup};

/// Directed edges with the number of triangles that have them.
pub fn directed_edges(triangles: &[[u32; 3]]) -> BTreeMap<(u32, u32), usize> {
    let mut edges = BTreeMap::new();
    for &[a, b, c] in triangles {
        for edge in [(a, b), (b, c), (c, a)] {
            *edges.entry(edge).or_insert(0) += 1;
        }
    }
    edges
}

/// Edges with one triangle, in the triangle's direction.
pub fn boundary(triangles: &[[u32; 3]]) -> Vec<(u32, u32)> {
    let edges = directed_edges(triangles);
    edges.keys().copied().filter(|&(a, b)| !edges.contains_key(&(b, a))).collect()
}

/// Vertices in use − edges + triangles.
pub fn euler_characteristic(triangles: &[[u32; 3]]) -> i64 {
    let mut vertices: Vec<_> = triangles.iter().flatten().collect();
    vertices.sort_unstable();
    vertices.dedup();
    let edges = directed_edges(triangles);
    let undirected = edges.keys().filter(|&&(a, b)| a < b || !edges.contains_key(&(b, a))).count();
    vertices.len() as i64 - undirected as i64 + triangles.len() as i64
}

/// Checks everything that must hold of the result for a manifold input: topology, orientation, boundary, sources, bits
/// of untouched elements.
pub fn assert_sound(before: &Soup, after: &Soup, sources: &Sources) {
    assert!(after.positions.iter().flatten().all(|x| x.is_finite()), "a coordinate is not finite");
    assert_topology(before, after, sources);
    assert_sources(before, after, sources);
    for t in 0..after.triangles.len() {
        let old = before.triangles[sources.triangle[t] as usize];
        let new = after.triangles[t].map(|v| sources.vertex[v as usize]);
        let same = (0..3).all(|k| old.contains(&new[k]));
        assert!(!same || old == new, "a kept triangle was turned: {old:?} {new:?}");
    }
}

fn assert_topology(before: &Soup, after: &Soup, sources: &Sources) {
    let edges = directed_edges(&after.triangles);
    assert!(edges.values().all(|&n| n == 1), "an edge is used twice in one direction");
    assert_eq!(euler_characteristic(&before.triangles), euler_characteristic(&after.triangles));
    let outer: Vec<_> = boundary(&after.triangles)
        .into_iter()
        .map(|(a, b)| (sources.vertex[a as usize], sources.vertex[b as usize]))
        .collect();
    assert_eq!(outer, boundary(&before.triangles), "the boundary has changed");
    for (a, b) in boundary(&after.triangles) {
        for v in [a, b] {
            assert_eq!(after.positions[v as usize], before.positions[sources.vertex[v as usize] as usize]);
        }
    }
}

fn assert_sources(before: &Soup, after: &Soup, sources: &Sources) {
    assert_eq!(sources.vertex.len(), after.positions.len());
    assert_eq!(sources.triangle.len(), after.triangles.len());
    assert_eq!(sources.corner.len(), 3 * after.triangles.len());
    assert!(sources.vertex.windows(2).all(|w| w[0] < w[1]), "vertices have changed their order");
    for (c, &source) in sources.corner.iter().enumerate() {
        let vertex = after.triangles[c / 3][c % 3];
        let old = before.triangles[source as usize / 3][source as usize % 3];
        assert_eq!(old, sources.vertex[vertex as usize], "corner {c} comes from another vertex");
    }
}

/// Relative change of the enclosed volume.
pub fn volume_change(before: &Soup, after: &Soup) -> f64 {
    let volume = |soup: &Soup| measure(&soup.positions, &soup.triangles).expect("a valid mesh").volume;
    (volume(after) - volume(before)) / volume(before).abs()
}

/// Least mean-ratio shape of any triangle.
pub fn worst_shape(soup: &Soup) -> f64 {
    measure(&soup.positions, &soup.triangles).expect("a valid mesh").shape.min
}

/// Largest angle in degrees between the normal of a triangle and the direction from the inside that `outward` gives for
/// its middle.
pub fn steepest(soup: &Soup, outward: impl Fn(Point) -> Point) -> f64 {
    let angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| soup.positions[v as usize]);
        let middle = std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0);
        let (u, v): (Point, Point) = (std::array::from_fn(|k| b[k] - a[k]), std::array::from_fn(|k| c[k] - a[k]));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let dot = |p: Point, q: Point| (0..3).map(|k| p[k] * q[k]).sum::<f64>();
        let out = outward(middle);
        (dot(normal, out) / (dot(normal, normal) * dot(out, out)).sqrt()).acos().to_degrees()
    };
    soup.triangles.iter().map(angle).fold(0.0, f64::max)
}
