//! Smoothing of any soup under any options.
#![no_main]

use libfuzzer_sys::fuzz_target;
use qsmesh::{Constraints, Flow};
use qsmesh_fuzz::input::{self, Bytes};
use qsmesh_fuzz::promises;

fuzz_target!(|bytes: &[u8]| {
    let bytes = &mut Bytes(bytes);
    let options = input::options(bytes);
    let soup = input::soup(bytes);
    let count = soup.positions.len();
    let (locked, edges) = (input::marks(bytes, count), input::edges(bytes, count));
    let (seeds, visits) = (input::marks(bytes, count), input::visits(bytes, count));
    let constraints = Constraints { locked: &locked, feature_edges: &edges, seeds: &seeds, visits: &visits };
    let mut patience = if bytes.below(8) == 0 { bytes.below(6) } else { usize::MAX };
    let mut progress = |_| {
        patience -= usize::from(patience > 0);
        if patience > 0 { Flow::Continue } else { Flow::Cancel }
    };
    let mut after = soup.positions.clone();
    match qsmesh::smooth(&mut after, &soup.triangles, &options, &constraints, &mut progress) {
        Err(error) => {
            promises::assert_allowed(&error);
            promises::assert_bits(&soup.positions, &after, |_| true);
        }
        Ok(report) => {
            promises::assert_finite(&after);
            promises::assert_bits(&soup.positions, &after, |v| locked.get(v) == Some(&true));
            let used = |v: usize| soup.triangles.as_flattened().contains(&(v as u32));
            promises::assert_bits(&soup.positions, &after, |v| !used(v));
            if options.measure {
                let (before, now) = (&report.before, &report.after);
                promises::assert_figures(before, now, report.volume_relative_change, report.max_deviation);
                promises::assert_no_worse(before, now, &options);
                assert!(options.max_deviation.is_none_or(|bound| report.max_deviation <= bound), "deviation");
            }
        }
    }
});
