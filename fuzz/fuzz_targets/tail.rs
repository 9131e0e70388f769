//! The tail of any soup, with or without sweeps before it, under any options.
#![no_main]

use libfuzzer_sys::fuzz_target;
use qsmesh::{Constraints, Measurement, Sources, TailOptions, progress};
use qsmesh_fuzz::input::{self, Bytes, Soup};
use qsmesh_fuzz::promises;

fuzz_target!(|bytes: &[u8]| {
    let bytes = &mut Bytes(bytes);
    let (options, tail, sweeps) = (input::options(bytes), input::tail_options(bytes), bytes.flag());
    let before = input::soup(bytes);
    let count = before.positions.len();
    let (locked, edges) = (input::marks(bytes, count), input::edges(bytes, count));
    let (seeds, visits) = (input::marks(bytes, count), input::visits(bytes, count));
    let mask = input::marks(bytes, before.triangles.len());
    let (tail, constraints) = (TailOptions { mask: &mask, ..tail }, Constraints { locked: &locked, feature_edges: &edges, seeds: &seeds, visits: &visits });

    let mut sources = Sources::default();
    let (mut positions, mut triangles) = (before.positions.clone(), before.triangles.clone());
    let (points, all, from, silent) = (&mut positions, &mut triangles, &mut sources, &mut progress::silent);
    let report = if sweeps {
        qsmesh::improve(points, all, &options, &tail, &constraints, from, silent).map(|done| done.tail)
    } else {
        qsmesh::collapse_tails(points, all, &options, &tail, &constraints, from, silent)
    };
    let after = Soup { positions, triangles };
    match report {
        Err(error) => {
            promises::assert_allowed(&error);
            promises::assert_bits(&before.positions, &after.positions, |_| true);
            assert!(after.triangles == before.triangles && sources == Sources::default(), "changed on an error");
        }
        Ok(report) => {
            assert_sound(&before, &after, &sources, &locked);
            assert_eq!(report.leftovers.len(), report.tails_after);
            if report.before != Measurement::default() {
                let (then, now) = (&report.before, &report.after);
                promises::assert_figures(then, now, report.volume_relative_change, report.max_deviation);
                promises::assert_no_worse(then, now, &options);
                assert!(options.max_deviation.is_none_or(|bound| report.max_deviation <= bound), "deviation");
            }
        }
    }
});

fn assert_sound(before: &Soup, after: &Soup, sources: &Sources, locked: &[bool]) {
    promises::assert_finite(&after.positions);
    assert!(after.triangles.as_flattened().iter().all(|&v| (v as usize) < after.positions.len()));
    promises::assert_sources(sources, before.positions.len(), &before.triangles, &after.triangles);
    let origins: Vec<_> = sources.vertex.iter().map(|&v| before.positions[v as usize]).collect();
    let is_locked = |v: usize| locked.get(v) == Some(&true);
    promises::assert_bits(&origins, &after.positions, |v| is_locked(sources.vertex[v] as usize));
    let lost = (0..before.positions.len()).find(|&v| is_locked(v) && !sources.vertex.contains(&(v as u32)));
    assert_eq!(lost, None, "a locked vertex is gone");
}
