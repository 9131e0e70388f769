//! Small meshes with room for improvement, and their texts.

/// Positions and polygons.
#[derive(Clone)]
pub struct Mesh {
    pub points: Vec<[f64; 3]>,
    pub faces: Vec<Vec<u32>>,
}

/// A whole number from −8 to 7 that looks like chance.
fn noise(seed: usize) -> f64 {
    let mixed = (seed as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    (mixed >> 60) as f64 - 8.0
}

/// A closed surface: an octahedron cut finely and shifted within its faces. All coordinates fit into 32 bits.
pub fn sphere() -> Mesh {
    let mut points =
        vec![[4.0, 0.0, 0.0], [-4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, -4.0, 0.0], [0.0, 0.0, 4.0], [0.0, 0.0, -4.0]];
    let mut faces: Vec<[u32; 3]> = Vec::new();
    for [x, y, z] in [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]] {
        faces.push([x, y, z]);
    }
    for _ in 0..3 {
        faces = halve(&mut points, &faces);
    }
    for (number, point) in points.iter_mut().enumerate() {
        let length = point.iter().map(|x| x * x).sum::<f64>().sqrt();
        let shifted = [0, 1, 2].map(|axis| point[axis] * 4.0 / length + noise(3 * number + axis) / 64.0);
        *point = shifted.map(|x| f64::from(x as f32));
    }
    Mesh { points, faces: faces.iter().map(|face| face.to_vec()).collect() }
}

/// Cuts every triangle into four at the middles of its sides.
fn halve(points: &mut Vec<[f64; 3]>, faces: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles = std::collections::HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let (p, q) = (points[a as usize], points[b as usize]);
            points.push([0, 1, 2].map(|axis| 0.5 * (p[axis] + q[axis])));
            points.len() as u32 - 1
        })
    };
    let cut = |&[a, b, c]: &[u32; 3]| {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    faces.iter().flat_map(cut).collect()
}

/// An open surface: a flat grid of quadrilaterals whose inner vertices were shifted.
pub fn grid() -> Mesh {
    let side = 8;
    let mut mesh = Mesh { points: Vec::new(), faces: Vec::new() };
    for (j, i) in (0..side).flat_map(|j| (0..side).map(move |i| (j, i))) {
        let inner = i > 0 && j > 0 && i < side - 1 && j < side - 1;
        let shift = |axis: usize| if inner { noise(2 * mesh.points.len() + axis) / 24.0 } else { 0.0 };
        mesh.points.push([i as f64 + shift(0), j as f64 + shift(1), 0.0]);
    }
    for (j, i) in (0..side - 1).flat_map(|j| (0..side - 1).map(move |i| (j, i))) {
        let corner = (i + side * j) as u32;
        mesh.faces.push(vec![corner, corner + 1, corner + 1 + side as u32, corner + side as u32]);
    }
    mesh
}

/// Vertices of the torus along its two circles; vertex `i + AROUND × j` is number i of the long one, j of the short.
pub const AROUND: usize = 54;
pub const ACROSS: usize = 18;

/// A closed surface of triangles on a grid that is wrapped around both ways, its vertices shifted so far that some
/// triangles are needles and caps. All coordinates fit into 32 bits.
pub fn torus() -> Mesh {
    let circle = |k: usize, count: usize| std::f64::consts::TAU * k as f64 / count as f64;
    let mut mesh = Mesh { points: Vec::new(), faces: Vec::new() };
    for (j, i) in (0..ACROSS).flat_map(|j| (0..AROUND).map(move |i| (j, i))) {
        let (u, v) = (circle(i, AROUND), circle(j, ACROSS));
        let radius = 3.0 + v.cos();
        let shift = |axis: usize| noise(3 * mesh.points.len() + axis) / 50.0;
        let point = [radius * u.cos() + shift(0), radius * u.sin() + shift(1), v.sin() + shift(2)];
        mesh.points.push(point.map(|x| f64::from(x as f32)));
    }
    let index = |i: usize, j: usize| ((j % ACROSS) * AROUND + i % AROUND) as u32;
    for (j, i) in (0..ACROSS).flat_map(|j| (0..AROUND).map(move |i| (j, i))) {
        let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
        mesh.faces.extend([vec![a, b, d], vec![b, c, d]]);
    }
    mesh
}

/// Texture coordinates of the corners of a face of the torus: 0 to 1 along its circles, with a seam where they close.
pub fn torus_texture(face: &[u32]) -> [[f64; 2]; 3] {
    let place = |v: u32| [v as usize % AROUND, v as usize / AROUND];
    let whole = [AROUND, ACROSS];
    [0, 1, 2].map(|corner| {
        [0, 1].map(|axis| {
            let wraps = face.iter().any(|&v| place(v)[axis] > whole[axis] / 2);
            let k = place(face[corner])[axis];
            (if k == 0 && wraps { whole[axis] } else { k }) as f64 / 64.0
        })
    })
}

impl Mesh {
    /// As a plain OFF file.
    pub fn off(&self) -> String {
        let mut text = format!("OFF\n{} {} 0\n", self.points.len(), self.faces.len());
        for [x, y, z] in &self.points {
            text += &format!("{x} {y} {z}\n");
        }
        for face in &self.faces {
            let corners: Vec<_> = face.iter().map(u32::to_string).collect();
            text += &format!("{} {}\n", face.len(), corners.join(" "));
        }
        text
    }

    /// As a plain OBJ file.
    pub fn obj(&self) -> String {
        let mut text = String::new();
        for [x, y, z] in &self.points {
            text += &format!("v {x} {y} {z}\n");
        }
        for face in &self.faces {
            let corners: Vec<_> = face.iter().map(|v| (v + 1).to_string()).collect();
            text += &format!("f {}\n", corners.join(" "));
        }
        text
    }
}

/// Numbers of the lines that differ, from 0; there must be as many lines in both.
pub fn changed_lines(before: &str, after: &str) -> Vec<usize> {
    let (before, after): (Vec<_>, Vec<_>) = (before.split('\n').collect(), after.split('\n').collect());
    assert_eq!(before.len(), after.len());
    (0..before.len()).filter(|&line| before[line] != after[line]).collect()
}
