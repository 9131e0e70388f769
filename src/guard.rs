//! The guard: which moves are allowed. No triangle below the floor gets worse, and none folds over.

use glam::DVec3;

use crate::star::{LocalStar, double_vector_area};

/// Original shape below which a triangle's original normal says nothing: comparing with it would freeze exactly
/// those triangles that need to move.
const MEANINGLESS: f64 = 1e-3;

/// 2√3: mean-ratio shape = 2√3·|cross product| / Σ edge².
const TWO_ROOT_THREE: f64 = 3.464_101_615_137_754_6;

/// Settings of the guard.
pub(crate) struct Guard {
    /// Shape that the worst triangle of a star may not fall below.
    pub floor: f64,
    /// Cosine of the largest turn of a triangle's normal against its original one.
    pub least_cosine: f64,
}

/// A star as the guard sees it before the move.
#[derive(Default)]
pub(crate) struct Before {
    /// Signed shapes of the triangles; negative where one is folded against its sector.
    shapes: Vec<f64>,
    /// Vector area of the sector of each triangle, doubled.
    outward: Vec<DVec3>,
    /// Unit normals of the triangles as they were in the original mesh; zero where meaningless.
    normals: Vec<DVec3>,
    bar: f64,
}

impl Before {
    /// Looks at the star, and at the same star in the original mesh.
    pub fn take(&mut self, star: &LocalStar, originals: &[DVec3], original_centre: DVec3, floor: f64) {
        self.shapes.clear();
        self.outward.clear();
        self.normals.clear();
        for sector in star.sectors() {
            let outward = double_vector_area(sector);
            for e in sector.windows(2) {
                self.shapes.push(signed_shape(e[0], e[1], e[0].cross(e[1]), outward));
                self.outward.push(outward);
            }
        }
        let original = |v: u32| originals[v as usize] - original_centre;
        self.normals.extend(star.vertices.windows(2).map(|e| original_normal(original(e[0]), original(e[1]))));
        self.bar = self.shapes.iter().fold(floor, |least, &s| least.min(s));
    }
}

impl Guard {
    /// Whether the centre of the star may move by `step`.
    pub fn admits(&self, star: &LocalStar, before: &Before, step: DVec3) -> bool {
        star.rim.windows(2).enumerate().all(|(i, e)| {
            let (a, b) = (e[0] - step, e[1] - step);
            let normal = a.cross(b);
            let shape = signed_shape(a, b, normal, before.outward[i]);
            let turned = before.normals[i].dot(normal) < self.least_cosine * normal.length() * before.normals[i].length();
            shape >= before.bar && (shape >= 0.0 || shape >= before.shapes[i]) && !turned
        })
    }
}

/// Mean-ratio shape of the triangle (0, a, b), negative if its normal turns against `outward`.
fn signed_shape(a: DVec3, b: DVec3, normal: DVec3, outward: DVec3) -> f64 {
    let sum = a.length_squared() + b.length_squared() + (b - a).length_squared();
    if sum == 0.0 {
        return 0.0;
    }
    let shape = TWO_ROOT_THREE * normal.length() / sum;
    if normal.dot(outward) < 0.0 { -shape } else { shape }
}

fn original_normal(a: DVec3, b: DVec3) -> DVec3 {
    let normal = a.cross(b);
    let sum = a.length_squared() + b.length_squared() + (b - a).length_squared();
    let length = normal.length();
    if TWO_ROOT_THREE * length <= MEANINGLESS * sum { DVec3::ZERO } else { normal / length }
}
