//! The tail: what is cured, how, and what must not change by it.

mod check;
mod errors;
mod meshes;
mod odd;
mod properties;
mod situations;
mod sources;

use meshes::Soup;
use qsmesh::{Constraints, Improvement, Options, Sources, TailOptions, TailReport, progress};

/// Everything that comes out of a call.
struct Result<R> {
    after: Soup,
    sources: Sources,
    report: R,
}

/// Treats the tail alone.
fn collapse_tails(
    before: &Soup,
    options: &Options,
    tail: &TailOptions<'_>,
    fixed: &Constraints<'_>,
) -> Result<TailReport> {
    let mut after = before.clone();
    let mut sources = Sources::default();
    let (positions, triangles) = (&mut after.positions, &mut after.triangles);
    let silent = &mut progress::silent;
    let report = qsmesh::collapse_tails(positions, triangles, options, tail, fixed, &mut sources, silent);
    Result { report: report.expect("valid input"), after, sources }
}

/// Smooths and treats the tail.
fn improve(before: &Soup, options: &Options, tail: &TailOptions<'_>, fixed: &Constraints<'_>) -> Result<Improvement> {
    let mut after = before.clone();
    let mut sources = Sources::default();
    let (positions, triangles) = (&mut after.positions, &mut after.triangles);
    let report = qsmesh::improve(positions, triangles, options, tail, fixed, &mut sources, &mut progress::silent);
    Result { report: report.expect("valid input"), after, sources }
}
