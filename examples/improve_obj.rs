//! Improves an OBJ file of nothing but vertices and triangles: `cargo run --release --example improve_obj IN OUT`.

use std::error::Error;
use std::fmt::Write;
use std::str::FromStr;
use std::{env, fs};

use qsmesh::progress::silent;
use qsmesh::{Constraints, Options, Sources, TailOptions, improve};

/// Three numbers after the letter of a line.
fn three<T: FromStr<Err: Error + 'static>>(line: &str) -> Result<[T; 3], Box<dyn Error>> {
    let numbers: Vec<T> = line[1..].split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
    numbers.try_into().map_err(|_| format!("three numbers expected: {line}").into())
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().collect();
    let [_, input, output] = arguments.as_slice() else {
        return Err("usage: improve_obj IN OUT".into());
    };
    let text = fs::read_to_string(input)?;
    let lines = |letter| text.lines().filter(move |line| line.starts_with(letter));
    let mut positions = lines('v').map(three).collect::<Result<Vec<[f64; 3]>, _>>()?;
    let from_one = lines('f').map(three).collect::<Result<Vec<[u32; 3]>, _>>()?;
    let mut triangles: Vec<_> = from_one.iter().map(|t| t.map(|v| v - 1)).collect();

    let options = Options { iterations: 3, feature_angle: Some(40.0), ..Options::default() };
    let tail = TailOptions { min_angle: 25.0, ..TailOptions::default() };
    let (constraints, mut sources) = (Constraints::default(), Sources::default());
    improve(&mut positions, &mut triangles, &options, &tail, &constraints, &mut sources, &mut silent)?;

    let mut better = String::new();
    for [x, y, z] in positions {
        writeln!(better, "v {x} {y} {z}")?;
    }
    for [a, b, c] in triangles.iter().map(|t| t.map(|v| v + 1)) {
        writeln!(better, "f {a} {b} {c}")?;
    }
    fs::write(output, better)?;
    Ok(())
}
