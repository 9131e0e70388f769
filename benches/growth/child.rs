//! One row: a mesh is made, smoothed, and what that took is printed.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use qsmesh::progress::silent;
use qsmesh::{Constraints, Options, Seconds, smooth};

use crate::memory::resident;
use crate::wavy::{Wavy, wavy};

/// Nanoseconds per vertex, but those of a sweep (per vertex and sweep); bytes per triangle beyond the caller's buffers.
pub const COLUMNS: &str = "total_ns\tadjacency_ns\tfeatures_ns\tsweep_ns\twall_ns\tbytes_per_triangle\tpeak_gib";

const SWEEPS: u32 = 2;

/// The fastest run counts; runs are repeated this often at most, and for this long, but once in any case: the first one also takes
/// memory from the system, and on a virtual machine that from its host.
const RUNS: usize = 9;
const LONG: Duration = Duration::from_secs(4);

/// Wall time of a call, and what the library says of its stages.
type Time = (Duration, Seconds);

pub fn run(triangles: &str, permuted: bool, features: bool, threads: &str) -> ExitCode {
    let (Ok(triangles), Ok(threads)) = (triangles.parse(), threads.parse()) else { return ExitCode::FAILURE };
    let mut mesh = wavy(triangles, permuted);
    let feature_angle = features.then_some(30.0);
    let options = Options { iterations: SWEEPS, feature_angle, measure: false, threads, ..Options::default() };
    let before = resident("VmRSS").unwrap_or(0);
    let started = Instant::now();
    let mut best = timed(&mut mesh, &options);
    let peak = resident("VmHWM").unwrap_or(0);
    // A copy of the mesh would raise the peak, so later runs go on with what the first has left.
    for run in 1..RUNS {
        if run == 1 || started.elapsed() < LONG {
            best = std::cmp::min_by_key(best, timed(&mut mesh, &options), |time| time.0);
        }
    }
    let counts = (mesh.triangles.len(), mesh.positions.len());
    let names = [if permuted { "permuted" } else { "sane" }, if features { "features" } else { "off" }];
    let own = peak.saturating_sub(before) as f64 / counts.0 as f64;
    let gibibytes = peak as f64 / f64::from(1 << 30);
    println!(
        "{}\t{}\t{}\t{threads}\t{}\t{own:.1}\t{gibibytes:.3}",
        counts.0,
        counts.1,
        names.join("\t"),
        row(best, counts.1)
    );
    ExitCode::SUCCESS
}

fn timed(mesh: &mut Wavy, options: &Options) -> Time {
    let clock = Instant::now();
    let done = smooth(&mut mesh.positions, &mesh.triangles, options, &Constraints::default(), &mut silent);
    (clock.elapsed(), done.expect("a mesh that can be smoothed").seconds)
}

fn row((wall, seconds): Time, vertices: usize) -> String {
    let sweep = seconds.sweeps / f64::from(SWEEPS);
    let all = [seconds.total, seconds.adjacency, seconds.features, sweep, wall.as_secs_f64()];
    all.map(|seconds| format!("{:.1}", seconds * 1e9 / vertices as f64)).join("\t")
}
