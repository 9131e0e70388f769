//! How time and memory grow with the mesh: `cargo bench --bench growth [-- TRIANGLES]`, 10,000,000 triangles at most
//! unless another number says so. `benches/growth/run` draws the plot from it.
//!
//! Every row is a process of its own, so that its peak memory is its own: it makes a mesh, smooths it with two sweeps,
//! and reports. Rows go to stdout as tab-separated values.

mod child;
mod memory;
mod wavy;

use std::process::{Command, ExitCode};

const DEFAULT_MAXIMUM: f64 = 1e7;

/// Half a power of ten between sizes.
const SMALLEST_EXPONENT: i32 = 8;

/// How the vertices are numbered, whether features are looked for, and threads (0: all).
const SETTINGS: [(&str, &str, u32); 6] = [
    ("sane", "features", 1),
    ("sane", "off", 1),
    ("sane", "features", 0),
    ("permuted", "features", 1),
    ("permuted", "off", 1),
    ("permuted", "features", 0),
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        [] => parent(DEFAULT_MAXIMUM),
        ["child", triangles, numbering, features, threads] => {
            child::run(triangles, numbering == "permuted", features == "features", threads)
        }
        [maximum] => maximum.replace([',', '_'], "").parse().map_or_else(|_| usage(), parent),
        _ => usage(),
    }
}

fn usage() -> ExitCode {
    eprintln!("usage: growth [TRIANGLES], the size of the largest mesh; default 10,000,000");
    ExitCode::FAILURE
}

/// Runs a child for every size and setting, one after the other.
fn parent(maximum: f64) -> ExitCode {
    println!("triangles\tvertices\tnumbering\tfeatures\tthreads\t{}", child::COLUMNS);
    let sizes = (SMALLEST_EXPONENT..).map(|e| 10_f64.powf(f64::from(e) / 2.0)).take_while(|&n| n <= 1.01 * maximum);
    for triangles in sizes {
        for (numbering, features, threads) in SETTINGS {
            let arguments = ["child", &format!("{triangles:.0}"), numbering, features, &threads.to_string()];
            let program = std::env::current_exe().expect("a program with a path");
            if !Command::new(program).args(arguments).status().is_ok_and(|status| status.success()) {
                eprintln!("{triangles:.0} triangles, {numbering}, {features}, {threads} threads: failed");
                return ExitCode::FAILURE;
            }
        }
    }
    ExitCode::SUCCESS
}
