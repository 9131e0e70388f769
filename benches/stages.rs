//! Stages of a call as ratios measured in one run: `cargo bench --features cli [-- MESH.ply]`.
//!
//! Every figure is the median of several runs, in nanoseconds per vertex (for sweeps: and iteration), beside a plain
//! Laplacian sweep over flat arrays of the same mesh, which is about what reading and writing the memory costs. All rows
//! but the one that says so are of one thread.

#[path = "../tests/meshes/mod.rs"]
mod meshes;

use std::fs::File;
use std::hint::black_box;
use std::io::BufReader;
use std::time::Instant;

use meshes::Mesh;
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Property};
use qsmesh::progress::silent;
use qsmesh::{Constraints, Options, Seconds, Sources, TailOptions, improve, smooth};

const RUNS: usize = 9;

/// Sweeps behind the first two, which alone pay for the schedule and the copy that sweeps work on.
const FURTHER: u32 = 8;

fn main() {
    let named = std::env::args().skip(1).find(|argument| argument.ends_with(".ply"));
    let horse = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/horse.ply");
    let path = named.or_else(|| std::fs::exists(horse).unwrap_or(false).then(|| horse.to_owned()));
    let mesh = path.as_deref().map_or_else(|| meshes::torus(300, 160, 0.35, 1), read);
    println!("{}: {} vertices", path.as_deref().unwrap_or("a torus"), mesh.0.len());

    let plain = laplacian(&mesh);
    let one = Options { threads: 1, measure: false, ..Options::default() };
    let off = stages(&mesh, &Options { feature_angle: None, ..one.clone() });
    let many = stages(&mesh, &Options { feature_angle: None, iterations: 2 + FURTHER, ..one.clone() });
    let defaults = stages(&mesh, &one);
    let all = stages(&mesh, &Options { threads: 0, ..one.clone() });
    let row = |name: &str, nanoseconds: f64| println!("{name:<34} {nanoseconds:8.1} ns  {:6.1} ×", nanoseconds / plain);
    row("plain Laplacian sweep", plain);
    row("validation and stars", defaults.adjacency);
    row("features", defaults.features);
    row("sweep with guard, features off", off.sweeps / 2.0);
    row("  a further one", (many.sweeps - off.sweeps) / f64::from(FURTHER));
    row("sweep with guard, defaults", defaults.sweeps / 2.0);
    row("whole call, 2 sweeps, defaults", defaults.total);
    row("whole call on all threads", all.total);
    for (name, feature_angle) in [("tail, features off", None), ("tail, defaults", Some(30.0))] {
        let seconds = tail(&mesh, &Options { feature_angle, ..one.clone() });
        row(name, seconds.tail);
        println!("{:<34} {:8.2} × two sweeps", "", seconds.tail / seconds.sweeps);
    }
}

/// Median seconds of the stages of smoothing and tail treatment, in nanoseconds per vertex.
fn tail(mesh: &Mesh, options: &Options) -> Seconds {
    let run = || {
        let (mut positions, mut triangles) = mesh.clone();
        let (tail, free) = (TailOptions::default(), Constraints::default());
        let done = improve(&mut positions, &mut triangles, options, &tail, &free, &mut Sources::default(), &mut silent);
        done.expect("a mesh that can be improved").smoothing.seconds
    };
    middle(mesh, run)
}

/// Median seconds of the stages of smoothing, in nanoseconds per vertex.
fn stages(mesh: &Mesh, options: &Options) -> Seconds {
    let run = || {
        let mut positions = mesh.0.clone();
        let done = smooth(&mut positions, &mesh.1, options, &Constraints::default(), &mut silent);
        done.expect("a mesh that can be smoothed").seconds
    };
    middle(mesh, run)
}

fn middle(mesh: &Mesh, run: impl Fn() -> Seconds) -> Seconds {
    let runs: Vec<Seconds> = (0..RUNS).map(|_| run()).collect();
    let of = |part: fn(&Seconds) -> f64| median(runs.iter().map(part).collect()) * 1e9 / mesh.0.len() as f64;
    Seconds {
        total: of(|s| s.total),
        adjacency: of(|s| s.adjacency),
        features: of(|s| s.features),
        sweeps: of(|s| s.sweeps),
        tail: of(|s| s.tail),
    }
}

/// Nanoseconds per vertex of one sweep that moves each vertex into the middle of its neighbours.
fn laplacian((positions, triangles): &Mesh) -> f64 {
    let mut neighbours = vec![Vec::new(); positions.len()];
    for &[a, b, c] in triangles {
        for (v, r) in [(a, b), (b, c), (c, a)] {
            neighbours[v as usize].push(r);
        }
    }
    let starts: Vec<usize> = std::iter::once(0)
        .chain(neighbours.iter().scan(0, |sum, n| {
            *sum += n.len();
            Some(*sum)
        }))
        .collect();
    let flat: Vec<u32> = neighbours.concat();
    let mut moved = positions.clone();
    let sweep = |moved: &mut Vec<[f64; 3]>| {
        for v in 0..moved.len() {
            let ring = &flat[starts[v]..starts[v + 1]];
            let mut sum = [0.0; 3];
            for &r in ring {
                (0..3).for_each(|k| sum[k] += moved[r as usize][k]);
            }
            moved[v] = sum.map(|x| x / ring.len().max(1) as f64);
        }
    };
    let time = |_| {
        let clock = Instant::now();
        sweep(black_box(&mut moved));
        clock.elapsed().as_secs_f64() * 1e9 / positions.len() as f64
    };
    median((0..RUNS).map(time).collect())
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn read(path: &str) -> Mesh {
    let mut file = BufReader::new(File::open(path).expect("a readable file"));
    let ply = Parser::<DefaultElement>::new().read_ply(&mut file).expect("a PLY file");
    let number = |property: &Property| match *property {
        Property::Float(x) => f64::from(x),
        Property::Double(x) => x,
        ref other => panic!("a coordinate of type {other:?}"),
    };
    let vertex = |v: &DefaultElement| ["x", "y", "z"].map(|axis| number(&v[axis]));
    let face = |f: &DefaultElement| match &f["vertex_indices"] {
        Property::ListInt(corners) => [0, 1, 2].map(|k| corners[k] as u32),
        Property::ListUInt(corners) => [0, 1, 2].map(|k| corners[k]),
        other => panic!("indices of type {other:?}"),
    };
    (ply.payload["vertex"].iter().map(vertex).collect(), ply.payload["face"].iter().map(face).collect())
}
