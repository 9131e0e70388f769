//! Prints a hash of the results of smoothing and improving meshes that it makes: `same_bits small|large THREADS`.
//!
//! A line holds a name and the hash of every bit that comes out. The lines are to be the same on every processor and
//! with every number of threads. The instruction set goes to stderr, because it is to differ.

mod meshes;

use std::process::ExitCode;

use fearless_simd::Level;
use meshes::{Mesh, roofs, torus};
use qsmesh::progress::silent;
use qsmesh::{Boundary, Constraints, Coordinate, Ideal, Options, Order, Plane, Sources, TailOptions, improve, smooth};

/// FNV-1a over the bytes of words. Coordinates of either precision go in as the bits of their exact value in `f64`.
struct Hash(u64);

impl Hash {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn take(mut self, words: impl IntoIterator<Item = u64>) -> Self {
        for byte in words.into_iter().flat_map(u64::to_le_bytes) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        self
    }

    fn mesh<T: Coordinate>(self, positions: &[[T; 3]], triangles: &[[u32; 3]]) -> Self {
        let bits = positions.iter().flatten().map(|x| x.to_f64().to_bits());
        self.take(bits).take(triangles.iter().flatten().map(|&v| u64::from(v)))
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (is_large, threads) = match words[..] {
        ["small", threads] => (false, threads.parse()),
        ["large", threads] => (true, threads.parse()),
        _ => return usage(),
    };
    let Ok(threads) = threads else { return usage() };
    eprintln!("{:?}", Level::new());
    if is_large {
        large(threads)
    } else {
        small(threads)
    }
    ExitCode::SUCCESS
}

fn usage() -> ExitCode {
    eprintln!("usage: same_bits small|large THREADS");
    ExitCode::FAILURE
}

/// Everything, on meshes that an emulated processor gets through in seconds.
fn small(threads: u32) {
    for (name, mesh) in [("torus", torus(32, 22)), ("roofs", roofs(12, 2))] {
        print_input(name, &mesh);
        for (setting, options) in settings(threads) {
            let [single, double] = ["f32", "f64"].map(|precision| format!("{name}, {setting}, {precision}"));
            print_smoothed::<f32>(&single, &mesh, &options);
            print_smoothed::<f64>(&double, &mesh, &options);
            print_improved::<f64>(&double, &mesh, &options);
        }
    }
}

/// What threads have to do with, on meshes of more than 200,000 vertices.
fn large(threads: u32) {
    for (name, mesh) in [("torus", torus(640, 330)), ("roofs", roofs(230, 2))] {
        print_input(name, &mesh);
        for (setting, options) in settings(threads).into_iter().filter(|(_, options)| options.order == Order::Colors) {
            let options = Options { measure: false, ..options };
            print_smoothed::<f32>(&format!("{name}, {setting}"), &mesh, &options);
        }
        let options = Options { threads, ..Options::default() };
        print_smoothed::<f64>(&format!("{name}, f64"), &mesh, &options);
        print_improved::<f64>(&format!("{name}, f64"), &mesh, &options);
    }
}

/// Both orders with and without features, and each of the remaining choices once.
fn settings(threads: u32) -> Vec<(&'static str, Options)> {
    let defaults = Options { threads, ..Options::default() };
    let index = Options { order: Order::Index, ..defaults.clone() };
    let least_squares = Options { plane: Plane::LeastSquares, ideal: Ideal::Equilateral, ..defaults.clone() };
    let sliding = Options { boundary: Boundary::Slide, max_deviation: Some(0.001), iterations: 3, ..defaults.clone() };
    vec![
        ("colours, features off", Options { feature_angle: None, ..defaults.clone() }),
        ("index, features off", Options { feature_angle: None, ..index.clone() }),
        ("colours, features", defaults),
        ("index, features", index),
        ("least squares, equilateral", least_squares),
        ("sliding boundary, bounded deviation", sliding),
    ]
}

fn print_input(name: &str, (positions, triangles): &Mesh) {
    println!("{name}: {} vertices {:016x}", positions.len(), Hash::new().mesh(positions, triangles).0);
}

fn print_smoothed<T: Coordinate>(name: &str, mesh: &Mesh, options: &Options) {
    let mut positions = stored::<T>(mesh);
    let report = smooth(&mut positions, &mesh.1, options, &Constraints::default(), &mut silent)
        .expect("a mesh that can be smoothed");
    assert!(2 * report.moved > positions.len(), "{name}: {} vertices moved", report.moved);
    println!("{name}, smooth: {:016x}", report_hash(&report).mesh(&positions, &[]).0);
}

fn print_improved<T: Coordinate>(name: &str, mesh: &Mesh, options: &Options) {
    let (mut positions, mut triangles, mut sources) = (stored::<T>(mesh), mesh.1.clone(), Sources::default());
    let (tail, free) = (TailOptions::default(), Constraints::default());
    let done = improve(&mut positions, &mut triangles, options, &tail, &free, &mut sources, &mut silent)
        .expect("a mesh that can be improved");
    assert!(triangles != mesh.1, "{name}: the tail needs no flip");
    let hash = report_hash(&done.smoothing).mesh(&positions, &triangles);
    println!("{name}, improve: {:016x}", hash.take(sources.corner.into_iter().map(u64::from)).0);
}

fn stored<T: Coordinate>((positions, _): &Mesh) -> Vec<[T; 3]> {
    positions.iter().map(|p| p.map(T::from_f64)).collect()
}

/// The counts and the measured figures of a report.
fn report_hash(report: &qsmesh::Report) -> Hash {
    let counts = [report.moved, report.feature_edges, report.moves_halved, report.moves_refused, report.kept.guard];
    let figures = [report.after.edge_ratio.variance, report.after.min_angle.mean, report.max_deviation];
    Hash::new().take(counts.map(|n| n as u64)).take(figures.map(f64::to_bits))
}
