//! Results change only on purpose: hashes of what comes out of many calls, as `tests/snapshots.txt` has them. They are the same on
//! every machine, so the meshes are made without functions that are not. `QSMESH_WRITE_SNAPSHOTS=1` writes them anew; then
//! CHANGELOG.md has something to say.

mod meshes;

use std::fmt::Write;

use meshes::{Mesh, Random, cube, scattered};
use qsmesh::progress::silent;
use qsmesh::{Boundary, Constraints, Coordinate, Ideal, Method, Metric, Options, Order, Parameter, Plane, Report};
use qsmesh::{Measurement, Sources, TailOptions, TailReport, collapse_tails, histogram, improve, measure, smooth};

/// FNV-1a over the bits of numbers.
struct Hash(u64);

impl Hash {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn word(&mut self, word: u64) -> &mut Self {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
        }
        self
    }

    fn number(&mut self, number: f64) -> &mut Self {
        self.word(number.to_bits())
    }

    fn positions<T: Coordinate>(&mut self, positions: &[[T; 3]]) -> &mut Self {
        for x in positions.as_flattened() {
            self.number(x.to_f64());
        }
        self
    }

    fn indices(&mut self, indices: &[u32]) -> &mut Self {
        for &index in indices {
            self.word(index.into());
        }
        self
    }

    fn text(&mut self, text: &str) -> &mut Self {
        for byte in text.bytes() {
            self.word(byte.into());
        }
        self
    }

    fn measurement(&mut self, measured: &Measurement) -> &mut Self {
        self.text(&format!("{measured:?}"))
    }

    fn report(&mut self, report: &Report) -> &mut Self {
        self.measurement(&report.before).measurement(&report.after).text(&format!("{:?}", report.kept));
        self.number(report.volume_relative_change).number(report.max_deviation).word(report.moved as u64);
        self.word(report.feature_edges as u64).word(report.moves_halved as u64).word(report.moves_refused as u64)
    }

    fn tail_report(&mut self, report: &TailReport) -> &mut Self {
        self.text(&format!("{:?}", TailReport { seconds: 0.0, ..report.clone() }))
    }

    fn sources(&mut self, sources: &Sources) -> &mut Self {
        self.indices(&sources.vertex).indices(&sources.triangle).indices(&sources.corner)
    }
}

/// A closed surface without creases, its vertices shaken: a cube blown up to a ball with bulges.
fn ball(n: u32, jitter: f64, seed: u64) -> Mesh {
    let (mut positions, triangles) = cube(n, jitter, seed);
    for [x, y, z] in &mut positions {
        let radius = (1.0 + 0.3 * *x * *y + 0.2 * *z * *z) / (*x * *x + *y * *y + *z * *z).sqrt();
        (*x, *y, *z) = (*x * radius, *y * radius, *z * radius);
    }
    (positions, triangles)
}

/// A quarter of the triangles turned inside out, doubled, or with a corner that is named twice.
fn spoilt() -> Mesh {
    let (positions, mut triangles) = ball(6, 0.3, 5);
    let mut random = Random(3);
    for t in (0..triangles.len()).step_by(29) {
        match (random.signed() * 3.0) as i32 {
            0 => triangles[t].swap(0, 1),
            1 => triangles[t][2] = triangles[t][1],
            _ => triangles.push(triangles[t]),
        }
    }
    (positions, triangles)
}

fn all_meshes() -> Vec<(&'static str, Mesh)> {
    // The largest has three blocks of vertices, and colours between them.
    let balls = [("ball", ball(9, 0.45, 2)), ("large ball", ball(14, 0.4, 7))];
    let others = [("cube", cube(7, 0.42, 1)), ("plane", scattered(160, 3)), ("spoilt", spoilt())];
    balls.into_iter().chain(others).collect()
}

/// Each option away from its default.
fn all_options() -> Vec<Options> {
    let usual = Options::default;
    let mut all = vec![
        usual(),
        Options { feature_angle: None, ..usual() },
        Options { feature_angle: Some(60.0), iterations: 4, ..usual() },
        Options { iterations: 6, relaxation: 1.8, ..usual() },
        Options { plane: Plane::LeastSquares, ..usual() },
        Options { ideal: Ideal::Equilateral, ..usual() },
        Options { interval_width: 0.2, sample_limit: 2.0, ..usual() },
        Options { quality_floor: 0.8, ..usual() },
        Options { boundary: Boundary::Slide, ..usual() },
        Options { max_deviation: Some(0.01), ..usual() },
        Options { keep_sizes: true, ..usual() },
        Options { measure: false, ..usual() },
    ];
    all.extend([Order::Index, Order::Wave, Order::Tail, Order::Given].map(|order| Options { order, ..usual() }));
    let metrics = [Metric::MinAngle, Metric::MaxAngle, Metric::Area, Metric::Shape];
    all.extend(metrics.map(|metric| Options { metric, ..usual() }));
    all.extend([Method::Laplacian, Method::TangentialLaplacian].map(|method| Options { method, ..usual() }));
    all
}

fn all_tails() -> Vec<TailOptions<'static>> {
    let usual = TailOptions::default;
    vec![
        usual(),
        TailOptions { min_angle: 32.0, max_angle: 110.0, edge_ratio: 2.2, ..usual() },
        TailOptions { flips: true, min_angle: 28.0, ..usual() },
        TailOptions { operations: Some(3), attempts: 1, min_angle: 35.0, ..usual() },
    ]
}

/// A line for each call: what was called, and a hash of all that came of it.
fn snapshots() -> String {
    let mut lines = String::new();
    let mut line = |name: &str, hash: &Hash| writeln!(lines, "{name}: {:016x}", hash.0).expect("room");
    for (name, (positions, triangles)) in &all_meshes() {
        let count = positions.len();
        let locked: Vec<bool> = (0..count).map(|v| v % 17 == 3).collect();
        let visits: Vec<u32> = (0..count as u32).rev().step_by(2).collect();
        let edges: Vec<[u32; 2]> = triangles.iter().step_by(13).map(|t| [t[0], t[1]]).collect();
        let constraints = Constraints {
            locked: &locked,
            seeds: &locked,
            visits: &visits,
            feature_edges: &edges[..edges.len().min(4)],
        };
        for (number, options) in all_options().iter().enumerate() {
            let mut after = positions.clone();
            let report = smooth(&mut after, triangles, options, &constraints, &mut silent).expect("a result");
            line(&format!("{name}, smooth, options {number}"), Hash::new().positions(&after).report(&report));
        }
        let mut single = meshes::to_f32(positions);
        let report = smooth(&mut single, triangles, &Options::default(), &Constraints::default(), &mut silent);
        line(&format!("{name}, smooth, f32"), Hash::new().positions(&single).report(&report.expect("a result")));
        for (number, tail) in all_tails().iter().enumerate() {
            let options = Options { feature_angle: (number != 1).then_some(30.0), ..Options::default() };
            let (mut points, mut faces, mut sources) = (positions.clone(), triangles.clone(), Sources::default());
            let done = improve(&mut points, &mut faces, &options, tail, &constraints, &mut sources, &mut silent);
            let done = done.expect("a result");
            let mut hash = Hash::new();
            hash.positions(&points).indices(faces.as_flattened()).sources(&sources).report(&done.smoothing);
            line(&format!("{name}, improve, tail {number}"), hash.tail_report(&done.tail));
            let (mut points, mut faces, free) = (positions.clone(), triangles.clone(), Constraints::default());
            let done = collapse_tails(&mut points, &mut faces, &options, tail, &free, &mut sources, &mut silent);
            let done = done.expect("a result");
            let mut hash = Hash::new();
            hash.positions(&points).indices(faces.as_flattened()).sources(&sources);
            line(&format!("{name}, collapse_tails, tail {number}"), hash.tail_report(&done));
        }
        let mut hash = Hash::new();
        hash.measurement(&measure(positions, triangles).expect("a result"));
        for parameter in Parameter::ALL {
            let bins = histogram(positions, triangles, parameter, 1.0, 0.25, 40).expect("a result");
            for count in bins {
                hash.word(count as u64);
            }
        }
        line(&format!("{name}, measure"), &hash);
    }
    lines
}

#[test]
fn results_change_only_on_purpose() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/snapshots.txt");
    let now = snapshots();
    if std::env::var_os("QSMESH_WRITE_SNAPSHOTS").is_some() {
        std::fs::write(file, &now).expect("a file that can be written");
    }
    let then = std::fs::read_to_string(file).expect("tests/snapshots.txt");
    let other: Vec<_> = now.lines().filter(|line| !then.lines().any(|known| known == *line)).collect();
    assert!(other.is_empty() && now.lines().count() == then.lines().count(), "not as before: {other:#?}");
}
