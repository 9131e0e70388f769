//! What must hold of every result on every mesh.

use glam::DVec3;
use qsmesh::progress::silent;
use qsmesh::{
    Constraints, Coordinate, Error, Measurement, Method, Options, Sources, TailOptions, collapse_tails, improve, smooth,
};

use crate::meshes::Mesh;

/// Meshes whose relative volume says something: closed, and not as good as flat.
fn encloses(measured: &Measurement) -> bool {
    let closed = measured.boundary_edges == 0 && measured.non_manifold_edges == 0 && measured.triangles > 0;
    closed
        && measured.volume.is_finite()
        && measured.area.is_finite()
        && measured.volume != 0.0
        && measured.volume.abs() > 1e-3 * measured.area.powf(1.5)
}

fn assert_finite<T: Coordinate>(name: &str, positions: &[[T; 3]]) {
    assert!(positions.iter().flatten().all(|x| x.to_f64().is_finite()), "{name}: a coordinate is not finite");
}

fn assert_volume(name: &str, before: &Measurement, change: f64, most: f64, options: &Options) {
    assert!(!change.is_nan(), "{name}: the volume's change is not a number");
    let stays = options.method != Method::Laplacian && encloses(before);
    assert!(!stays || change.abs() <= most, "{name}: the volume has changed by {change:e}");
}

fn assert_quality(name: &str, before: &Measurement, after: &Measurement, options: &Options) {
    let least = before.shape.min.min(options.quality_floor);
    let (then, now) = (before.shape.min, after.shape.min);
    assert!(now >= least - 1e-9, "{name}: the worst triangle went from {then} to {now}");
}

/// Positions of about size 1, so that areas neither overflow nor vanish.
fn sized<T: Coordinate>(positions: &[[T; 3]], size: f64) -> Vec<DVec3> {
    positions.iter().map(|p| DVec3::from_array(p.map(|x| x.to_f64() / size))).collect()
}

/// Twice the vector area.
fn normal(positions: &[DVec3], &[a, b, c]: &[u32; 3]) -> DVec3 {
    let [a, b, c] = [a, b, c].map(|v| positions[v as usize]);
    (b - a).cross(c - a)
}

/// No triangle that had a shape and lay flat among its neighbours has turned by more than the 75° that a visit may turn it.
fn assert_no_folds<T: Coordinate>(name: &str, before: &[[T; 3]], after: &[[T; 3]], triangles: &[[u32; 3]]) {
    let size = before.iter().flatten().map(|x| x.to_f64().abs()).fold(f64::MIN_POSITIVE, f64::max);
    let (before, after) = (sized(before, size), sized(after, size));
    let mut areas = vec![DVec3::ZERO; before.len()];
    triangles.iter().for_each(|t| t.iter().for_each(|&v| areas[v as usize] += normal(&before, t)));
    for (i, t) in triangles.iter().enumerate() {
        let (then, now) = (normal(&before, t), normal(&after, t));
        let [a, b, c] = t.map(|v| before[v as usize]);
        let squares = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
        let is_flat = t.iter().all(|&v| then.dot(areas[v as usize]) >= 0.0);
        if is_flat && 12.0_f64.sqrt() * then.length() > 0.01 * squares {
            let cosine = then.dot(now) / (then.length() * now.length());
            assert!(cosine > 0.2588, "{name}: triangle {i} has turned, cosine {cosine}");
        }
    }
}

/// Smooths a copy in one precision.
pub fn assert_smooths<T: Coordinate>(
    name: &str,
    positions: &[[T; 3]],
    triangles: &[[u32; 3]],
    options: &Options,
    most: f64,
) {
    let mut after = positions.to_vec();
    let report = smooth(&mut after, triangles, options, &Constraints::default(), &mut silent).expect(name);
    assert_finite(name, &after);
    assert_volume(name, &report.before, report.volume_relative_change, most, options);
    assert_quality(name, &report.before, &report.after, options);
    assert_no_folds(name, positions, &after, triangles);
    let bits = |p: &[T; 3]| p.map(|x| x.to_f64().to_bits());
    let moved = after.iter().zip(positions).filter(|(a, b)| bits(a) != bits(b)).count();
    assert_eq!(moved, report.moved, "{name}: vertices moved");
    assert!(options.max_deviation.is_none_or(|bound| report.max_deviation <= bound), "{name}: the bound is passed");
}

/// Treats the tail of a copy in one precision, with and without sweeps before it.
pub fn assert_improves<T: Coordinate>(
    name: &str,
    mesh: (&[[T; 3]], &[[u32; 3]]),
    options: &Options,
    tail: &TailOptions<'_>,
    most: f64,
) {
    for sweeps in [false, true] {
        let (mut positions, mut triangles, mut sources) = (mesh.0.to_vec(), mesh.1.to_vec(), Sources::default());
        let (points, all, from, fixed) = (&mut positions, &mut triangles, &mut sources, Constraints::default());
        let report = if sweeps {
            improve(points, all, options, tail, &fixed, from, &mut silent).map(|done| done.tail)
        } else {
            collapse_tails(points, all, options, tail, &fixed, from, &mut silent)
        }
        .expect(name);
        assert_finite(name, &positions);
        assert!(
            triangles.iter().flatten().all(|&v| (v as usize) < positions.len()),
            "{name}: an index is out of range"
        );
        assert_eq!((sources.vertex.len(), sources.corner.len()), (positions.len(), 3 * triangles.len()), "{name}");
        assert_eq!(report.tails_after, report.leftovers.len(), "{name}");
        assert_volume(name, &report.before, report.volume_relative_change, most, options);
        assert_quality(name, &report.before, &report.after, options);
    }
}

/// A mesh that cannot be read gives this error, and its bits stay.
pub fn assert_refused(name: &str, (positions, triangles): &Mesh, options: &Options, expected: &Error) {
    let bits = |p: &[[f64; 3]]| p.iter().map(|p| p.map(f64::to_bits)).collect::<Vec<_>>();
    let mut after = positions.clone();
    let told = smooth(&mut after, triangles, options, &Constraints::default(), &mut silent);
    assert_eq!(told.as_ref().err(), Some(expected), "{name}");
    let (mut all, mut sources, tail) = (triangles.clone(), Sources::default(), TailOptions::default());
    let fixed = Constraints::default();
    let told = improve(&mut after, &mut all, options, &tail, &fixed, &mut sources, &mut silent);
    assert_eq!(told.as_ref().err(), Some(expected), "{name}");
    let told = collapse_tails(&mut after, &mut all, options, &tail, &fixed, &mut sources, &mut silent);
    assert_eq!(told.as_ref().err(), Some(expected), "{name}");
    assert!(bits(&after) == bits(positions) && all == *triangles, "{name}: changed on an error");
    assert_eq!(sources, Sources::default(), "{name}: changed on an error");
}
