//! Marching tetrahedra: the mesh of an implicit surface, with the bad triangles that such methods leave.

use std::collections::HashMap;

/// Bisections by which a vertex is brought onto the surface.
const BISECTIONS: usize = 40;

/// The cube is cut into six tetrahedra, one for each order in which its three axes can be walked from corner 0 to
/// corner 7; bit i of a corner's number is its step along axis i. True: the tetrahedron has positive volume.
const TETRAHEDRA: [([usize; 4], bool); 6] = [
    ([0, 1, 3, 7], true),
    ([0, 2, 6, 7], true),
    ([0, 4, 5, 7], true),
    ([0, 1, 5, 7], false),
    ([0, 2, 3, 7], false),
    ([0, 4, 6, 7], false),
];

/// A surface of genus 5 within the cube of half side 3: negative inside.
pub fn tangle([x, y, z]: [f64; 3]) -> f64 {
    let axis = |t: f64| t * t * (t * t - 5.0);
    axis(x) + axis(y) + axis(z) + 11.8
}

/// Triangles of the surface `function` = 0, counter-clockwise seen from where it is positive, from a grid of `cells`
/// cells a side over the cube of half side `half`.
pub fn extract(function: fn([f64; 3]) -> f64, half: f64, cells: usize) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut marcher = Marcher::new(function, half, cells);
    for cell in 0..cells * cells * cells {
        let origin = [cell % cells, cell / cells % cells, cell / cells / cells];
        for (corners, positive) in TETRAHEDRA {
            let nodes = corners.map(|corner| [0, 1, 2].map(|axis| origin[axis] + (corner >> axis & 1)));
            marcher.cut(nodes.map(|node| marcher.number(node)), positive);
        }
    }
    (marcher.points, marcher.triangles)
}

struct Marcher {
    function: fn([f64; 3]) -> f64,
    half: f64,
    cells: usize,
    values: Vec<f64>,
    on_edge: HashMap<(usize, usize), u32>,
    points: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Marcher {
    fn new(function: fn([f64; 3]) -> f64, half: f64, cells: usize) -> Self {
        let (on_edge, points, triangles) = (HashMap::new(), Vec::new(), Vec::new());
        let mut marcher = Self { function, half, cells, values: Vec::new(), on_edge, points, triangles };
        let nodes = (cells + 1).pow(3);
        marcher.values = (0..nodes).map(|node| function(marcher.place(node))).collect();
        marcher
    }

    fn number(&self, [i, j, k]: [usize; 3]) -> usize {
        i + (self.cells + 1) * (j + (self.cells + 1) * k)
    }

    fn place(&self, node: usize) -> [f64; 3] {
        let side = self.cells + 1;
        [node % side, node / side % side, node / side / side]
            .map(|step| self.half * (2.0 * step as f64 / self.cells as f64 - 1.0))
    }

    /// Adds the triangles in which a tetrahedron cuts the surface.
    fn cut(&mut self, nodes: [usize; 4], positive: bool) {
        let (nodes, inside, positive) = self.inside_first(nodes, positive);
        let [a, b, c, d] = nodes;
        match inside {
            1 => self.add([(a, b), (a, c), (a, d)], positive),
            2 => {
                self.add([(a, c), (a, d), (b, d)], positive);
                self.add([(a, c), (b, d), (b, c)], positive);
            }
            3 => self.add([(d, a), (d, b), (d, c)], positive),
            _ => {}
        }
    }

    /// The nodes with those inside first, how many these are, and whether the volume is still positive.
    fn inside_first(&self, mut nodes: [usize; 4], mut positive: bool) -> ([usize; 4], usize, bool) {
        let is_inside = |node: usize| self.values[node] < 0.0;
        let mut inside = 0;
        for place in 0..4 {
            if is_inside(nodes[place]) {
                if place != inside {
                    nodes.swap(place, inside);
                    positive = !positive;
                }
                inside += 1;
            }
        }
        (nodes, inside, positive)
    }

    fn add(&mut self, edges: [(usize, usize); 3], positive: bool) {
        let [a, b, c] = edges.map(|(from, to)| self.vertex(from, to));
        self.triangles.push(if positive { [a, b, c] } else { [a, c, b] });
    }

    /// The vertex on the edge between two nodes, of which exactly one is inside.
    fn vertex(&mut self, from: usize, to: usize) -> u32 {
        let edge = (from.min(to), from.max(to));
        if let Some(&vertex) = self.on_edge.get(&edge) {
            return vertex;
        }
        let vertex = self.points.len() as u32;
        self.points.push(self.crossing(edge));
        self.on_edge.insert(edge, vertex);
        vertex
    }

    fn crossing(&self, edge: (usize, usize)) -> [f64; 3] {
        let (start, end) = (self.place(edge.0), self.place(edge.1));
        let at = |share: f64| [0, 1, 2].map(|axis| start[axis] + share * (end[axis] - start[axis]));
        let starts_inside = self.values[edge.0] < 0.0;
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if ((self.function)(at(middle)) < 0.0) == starts_inside { low = middle } else { high = middle }
        }
        at(0.5 * (low + high))
    }
}

#[cfg(test)]
mod tests {
    use super::{extract, tangle};

    #[test]
    fn a_sphere_is_closed_and_turns_outward() {
        let (points, triangles) = extract(|[x, y, z]| x * x + y * y + z * z - 1.0, 1.3, 12);
        let found = qsmesh::measure(&points, &triangles).unwrap();
        assert_eq!((found.boundary_edges, found.non_manifold_edges, found.zero_area), (0, 0, 0));
        let ball = 4.0 / 3.0 * std::f64::consts::PI;
        assert!((found.volume / ball - 1.0).abs() < 0.02, "volume {}", found.volume);
    }

    #[test]
    fn the_tangle_has_genus_five() {
        let (points, triangles) = extract(tangle, 3.0, 20);
        let found = qsmesh::measure(&points, &triangles).unwrap();
        assert_eq!((found.boundary_edges, found.non_manifold_edges), (0, 0));
        // Vertices − edges + faces = 2 − 2·genus, and three faces share two edges each.
        assert_eq!(points.len() as i64 - triangles.len() as i64 / 2, -8);
        assert!(found.volume > 0.0);
    }
}
