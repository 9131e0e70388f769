//! The promises for every combination of method, metric, order, sizes and features, on small random meshes. Other choices
//! are drawn.

mod meshes;

use std::collections::BTreeMap;

use meshes::{Mesh, Random, cube, scattered, sheet, torus};
use qsmesh::progress::silent;
use qsmesh::{Boundary, Constraints, Error, Flow, Ideal, Method, Metric, Options, Order, Plane, Report, smooth};

const METHODS: [Method; 3] = [Method::QuasiStatistical, Method::Laplacian, Method::TangentialLaplacian];
const METRICS: [Metric; 5] = [Metric::EdgeRatio, Metric::MinAngle, Metric::MaxAngle, Metric::Area, Metric::Shape];
const ORDERS: [Order; 5] = [Order::Colors, Order::Index, Order::Wave, Order::Tail, Order::Given];

/// Every combination, numbered; other choices are drawn for each.
fn combinations() -> Vec<(u64, Options)> {
    let mut all = Vec::new();
    for (method, metric, order) in METHODS.into_iter().flat_map(with_each_metric_and_order) {
        for (keep_sizes, features) in [(false, false), (false, true), (true, false), (true, true)] {
            let number = all.len() as u64;
            let mut random = Random(number);
            let options = Options {
                method,
                metric,
                order,
                keep_sizes,
                feature_angle: features.then_some(30.0),
                plane: if random.signed() < 0.0 { Plane::VectorArea } else { Plane::LeastSquares },
                ideal: if random.signed() < 0.0 { Ideal::Modelled } else { Ideal::Equilateral },
                boundary: if random.signed() < 0.0 { Boundary::Fixed } else { Boundary::Slide },
                relaxation: 1.2 + 0.8 * random.signed(),
                quality_floor: 0.5 + 0.5 * random.signed(),
                iterations: 1 + (number % 3) as u32,
                ..Options::default()
            };
            all.push((number, options));
        }
    }
    assert_eq!(all.len(), 3 * 5 * 5 * 2 * 2);
    all
}

fn with_each_metric_and_order(method: Method) -> impl Iterator<Item = (Method, Metric, Order)> {
    METRICS.into_iter().flat_map(move |metric| ORDERS.map(|order| (method, metric, order)))
}

/// A mesh with one vertex in no triangle, and wishes about it.
struct Situation {
    mesh: Mesh,
    is_closed: bool,
    locked: Vec<bool>,
    seeds: Vec<bool>,
    visits: Vec<u32>,
}

impl Situation {
    fn new((mut positions, triangles): Mesh, is_closed: bool, seed: u64) -> Self {
        let mut random = Random(seed);
        positions.push([0.25, -0.5, 0.75]);
        let count = positions.len();
        let mut share = |part: f64| positions.iter().map(|_| random.signed() < 2.0 * part - 1.0).collect();
        let (locked, seeds) = (share(0.15), share(0.02));
        let visits = (0..2 * count).map(|_| ((0.5 + 0.5 * random.signed()) * count as f64) as u32).collect();
        Self { mesh: (positions, triangles), is_closed, locked, seeds, visits }
    }

    fn constraints(&self) -> Constraints<'_> {
        let Self { locked, seeds, visits, .. } = self;
        Constraints { locked, seeds, visits, ..Constraints::default() }
    }

    fn run(&self, options: &Options) -> (Vec<[f64; 3]>, Report) {
        let mut positions = self.mesh.0.clone();
        let report = smooth(&mut positions, &self.mesh.1, options, &self.constraints(), &mut silent).expect("a result");
        (positions, report)
    }

    fn run_in_single_precision(&self, options: &Options) -> (Self, Vec<[f64; 3]>) {
        let wide = |positions: &[[f32; 3]]| positions.iter().map(|p| p.map(f64::from)).collect();
        let mut single = meshes::to_f32(&self.mesh.0);
        let before = (wide(&single), self.mesh.1.clone());
        smooth(&mut single, &self.mesh.1, options, &self.constraints(), &mut silent).expect("a result");
        let Self { is_closed, locked, seeds, visits, .. } = self;
        let before = Self {
            mesh: before,
            is_closed: *is_closed,
            locked: locked.clone(),
            seeds: seeds.clone(),
            visits: visits.clone(),
        };
        (before, wide(&single))
    }
}

/// A closed and an open mesh, other ones for each number, some of them with folds and slivers.
fn situations(number: u64) -> [Situation; 2] {
    let jitter = 0.3 + 0.2 * Random(number).signed();
    let size = 3 + (number % 4) as u32;
    let closed = if number.is_multiple_of(3) {
        cube(size, jitter, number)
    } else {
        torus(4 + 2 * size, 3 + size, jitter, number)
    };
    let open = if number.is_multiple_of(2) {
        scattered(12 * size as usize, number)
    } else {
        sheet(2 * size, 0.2, jitter, number)
    };
    [Situation::new(closed, true, number), Situation::new(open, false, number)]
}

/// Calls `check` with every combination on its meshes.
fn everywhere(check: impl Fn(&Options, &Situation)) {
    for (number, options) in combinations() {
        situations(number).iter().for_each(|situation| check(&options, situation));
    }
}

fn bits(positions: &[[f64; 3]]) -> Vec<[u64; 3]> {
    positions.iter().map(|p| p.map(f64::to_bits)).collect()
}

fn least_shape(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> f64 {
    triangles.iter().map(|t| meshes::shape(positions, t)).fold(f64::INFINITY, f64::min)
}

#[test]
fn the_volume_stays() {
    let change = |before: &Mesh, after: Vec<[f64; 3]>| {
        let volume = meshes::volume(before);
        (meshes::volume(&(after, before.1.clone())) - volume).abs() / volume
    };
    everywhere(|options, situation| {
        if situation.is_closed && options.method != Method::Laplacian {
            let exact = change(&situation.mesh, situation.run(options).0);
            assert!(exact <= 1e-12, "{exact}: {options:?}");
            let (before, after) = situation.run_in_single_precision(options);
            let rounded = change(&before.mesh, after);
            assert!(rounded <= 1e-6, "{rounded}: {options:?}");
        }
    });
}

#[test]
fn nothing_gets_worse_or_folds() {
    let check = |options: &Options, (before, triangles): &Mesh, after: &[[f64; 3]]| {
        assert!(after.iter().flatten().all(|x| x.is_finite()), "{options:?}");
        let bound = least_shape(before, triangles).min(options.quality_floor);
        let least = least_shape(after, triangles);
        assert!(least >= bound * (1.0 - 1e-12), "{least} below {bound}: {options:?}");
        let folded = meshes::folded(&(before.clone(), triangles.clone()));
        let flipped = meshes::flipped(before, after, triangles);
        assert!(flipped.iter().all(|t| folded.contains(t)), "{flipped:?}: {options:?}");
    };
    everywhere(|options, situation| {
        check(options, &situation.mesh, &situation.run(options).0);
        let (before, after) = situation.run_in_single_precision(options);
        check(options, &before.mesh, &after);
    });
}

#[test]
fn only_what_was_asked() {
    everywhere(|options, situation| {
        let (after, report) = situation.run(options);
        let (before, unused) = (bits(&situation.mesh.0), after.len() - 1);
        let moved: Vec<usize> = (0..after.len()).filter(|&v| before[v] != bits(&after)[v]).collect();
        assert!(moved.iter().all(|&v| !situation.locked[v] && v != unused), "{options:?}");
        if options.order == Order::Given {
            assert!(moved.iter().all(|&v| situation.visits.contains(&(v as u32))), "{options:?}");
        }
        let k = report.kept;
        let kept = k.unreferenced + k.locked + k.non_manifold + k.degenerate + k.boundary + k.corner + k.guard;
        assert_eq!((report.moved, kept + k.deviation + k.settled), (moved.len(), after.len() - moved.len()));
    });
}

#[test]
fn the_deviation_bound_is_kept() {
    everywhere(|options, situation| {
        let options = Options { max_deviation: Some(0.004), ..options.clone() };
        let (after, report) = situation.run(&options);
        assert!(report.max_deviation <= 0.004, "{options:?}");
        // The vertex without a triangle is on no surface.
        let on_surface = &after[..after.len() - 1];
        let farthest = on_surface.iter().map(|&p| meshes::distance(p, &situation.mesh)).fold(0.0, f64::max);
        assert!(farthest <= report.max_deviation + 1e-12, "{farthest}: {options:?}");
    });
}

#[test]
fn the_same_bits_again() {
    everywhere(|options, situation| {
        assert!(bits(&situation.run(options).0) == bits(&situation.run(options).0), "{options:?}");
    });
}

#[test]
fn errors_leave_the_buffers() {
    everywhere(|options, situation| {
        let Situation { mesh, visits, .. } = situation;
        let vertex = visits[0] as usize;
        let mut positions = mesh.0.clone();
        positions[vertex][1] = f64::INFINITY;
        let spoilt = bits(&positions);
        let error = smooth(&mut positions, &mesh.1, options, &situation.constraints(), &mut silent).unwrap_err();
        assert_eq!(error, Error::NonFinite { vertex }, "{options:?}");
        assert!(bits(&positions) == spoilt, "{options:?}");
        for stop in 0..3 {
            let (mut positions, mut told) = (mesh.0.clone(), 0);
            let mut listen = |_: f64| {
                told += 1;
                if told > stop { Flow::Cancel } else { Flow::Continue }
            };
            let result = smooth(&mut positions, &mesh.1, options, &situation.constraints(), &mut listen);
            assert_eq!(result.unwrap_err(), Error::Cancelled, "{options:?}");
            assert!(bits(&positions) == bits(&mesh.0), "{options:?}");
        }
    });
}

/// What a thread does depends on the method, and where threads meet on the order; each is seen with every other once.
#[test]
fn any_number_of_threads_gives_the_same_bits() {
    // Large enough for three threads.
    let situation = Situation::new(torus(260, 232, 0.4, 1), true, 1);
    for (number, order) in ORDERS.into_iter().enumerate() {
        for (turn, method) in METHODS.into_iter().enumerate() {
            let metric = METRICS[(number + turn) % METRICS.len()];
            let keep_sizes = (number + turn) % 2 == 0;
            let options =
                Options { method, metric, order, keep_sizes, iterations: 1, measure: false, ..Options::default() };
            let with = |threads| bits(&situation.run(&Options { threads, ..options.clone() }).0);
            let expected = with(1);
            assert!(with(3) == expected, "{options:?}");
            assert!(order != Order::Colors || with(2) == expected, "{options:?}");
        }
    }
}

/// Asserts that no two of these options have the same result on a mesh that has much to improve.
fn assert_all_differ(choices: &[Options]) {
    let situation = Situation::new(torus(48, 24, 0.45, 2), true, 2);
    let mut results = BTreeMap::new();
    for options in choices {
        if let Some(same) = results.insert(bits(&situation.run(options).0), options) {
            panic!("{options:?}\nhas the result of\n{same:?}");
        }
    }
}

#[test]
fn each_choice_changes_the_result() {
    let plain = Options::default();
    let orders = ORDERS.map(|order| Options { order, ..plain.clone() });
    let others = [
        Options { feature_angle: None, ..plain.clone() },
        Options { plane: Plane::LeastSquares, ..plain.clone() },
        Options { ideal: Ideal::Equilateral, ..plain.clone() },
        Options { relaxation: 1.0, ..plain.clone() },
        Options { interval_width: 0.05, ..plain.clone() },
        Options { sample_limit: 10.0, ..plain.clone() },
        Options { quality_floor: 0.0, ..plain.clone() },
        Options { max_deviation: Some(1e-3), ..plain.clone() },
        Options { iterations: 3, ..plain.clone() },
    ];
    assert_all_differ(&[&orders[..], &others[..]].concat());
}

#[test]
fn each_method_changes_the_result_and_so_does_keeping_sizes() {
    let plain = Options::default();
    let methods = METHODS.map(|method| Options { method, ..plain.clone() });
    let sizes = Options { keep_sizes: true, ..plain };
    assert_all_differ(&[&methods[..], &[sizes]].concat());
}
