//! Orders of the visits, in small situations. Where an order is to be seen, it is compared with the same one given by
//! hand.

mod meshes;

use std::collections::BTreeSet;

use meshes::{Mesh, scattered, sheet, torus};
use qsmesh::progress::silent;
use qsmesh::{Boundary, Constraints, Error, Flow, Options, Order, Report, smooth};

const ALONE: [Order; 4] = [Order::Index, Order::Wave, Order::Tail, Order::Given];

fn run(mesh: &Mesh, options: &Options, constraints: &Constraints<'_>) -> (Vec<[u64; 3]>, Report) {
    let mut positions = mesh.0.clone();
    let report = smooth(&mut positions, &mesh.1, options, constraints, &mut silent).expect("a result");
    (positions.iter().map(|p| p.map(f64::to_bits)).collect(), report)
}

fn in_order(order: Order) -> Options {
    Options { order, feature_angle: None, ..Options::default() }
}

/// Result of the visits `visits`, and the report.
fn given(mesh: &Mesh, visits: &[u32]) -> (Vec<[u64; 3]>, Report) {
    run(mesh, &in_order(Order::Given), &Constraints { visits, ..Constraints::default() })
}

/// Result of a front that starts at `seeds`.
fn wave(mesh: &Mesh, seeds: &[bool]) -> Vec<[u64; 3]> {
    run(mesh, &in_order(Order::Wave), &Constraints { seeds, ..Constraints::default() }).0
}

/// Vertices ring by ring from `start` on, each ring by index.
fn rings(mesh: &Mesh, start: &[u32]) -> Vec<u32> {
    let mut ring: BTreeSet<u32> = start.iter().copied().collect();
    let mut order: Vec<u32> = Vec::new();
    while !ring.is_empty() {
        order.extend(&ring);
        let touches = |t: &&[u32; 3]| t.iter().any(|v| ring.contains(v));
        ring = mesh.1.iter().filter(touches).flatten().copied().filter(|v| !order.contains(v)).collect();
    }
    order
}

fn mask(mesh: &Mesh, vertices: &[u32]) -> Vec<bool> {
    (0..mesh.0.len() as u32).map(|v| vertices.contains(&v)).collect()
}

fn worst_triangle(mesh: &Mesh) -> [u32; 3] {
    *mesh.1.iter().min_by(|s, t| meshes::shape(&mesh.0, s).total_cmp(&meshes::shape(&mesh.0, t))).expect("a triangle")
}

/// Two meshes in one, beside each other.
fn beside(one: Mesh, other: &Mesh) -> Mesh {
    let (mut positions, mut triangles) = one;
    let first = positions.len() as u32;
    positions.extend(other.0.iter().map(|&[x, y, z]| [x + 10.0, y, z]));
    triangles.extend(other.1.iter().map(|t| t.map(|v| v + first)));
    (positions, triangles)
}

#[test]
fn each_order_has_a_result_of_its_own() {
    let mesh = torus(48, 24, 0.4, 5);
    let backwards: Vec<u32> = (0..mesh.0.len() as u32).rev().collect();
    let constraints = Constraints { visits: &backwards, ..Constraints::default() };
    let orders = [Order::Colors, Order::Index, Order::Wave, Order::Tail, Order::Given];
    let results: BTreeSet<_> = orders.map(|order| run(&mesh, &in_order(order), &constraints).0).into();
    assert_eq!(results.len(), orders.len());
}

#[test]
fn all_vertices_by_number_are_the_index_order() {
    let mesh = torus(20, 14, 0.4, 6);
    let all: Vec<u32> = (0..mesh.0.len() as u32).collect();
    let (by_index, report) = run(&mesh, &in_order(Order::Index), &Constraints::default());
    let (listed, same) = given(&mesh, &all);
    assert!(listed == by_index);
    assert_eq!((same.moves_halved, same.moves_refused), (report.moves_halved, report.moves_refused));
}

#[test]
fn a_front_from_the_boundary_reaches_every_vertex_once() {
    let mesh = sheet(9, 0.2, 0.4, 7);
    let boundary: Vec<u32> = (0..100).filter(|v| v / 10 % 9 == 0 || v % 10 % 9 == 0).collect();
    let order = rings(&mesh, &boundary);
    assert_eq!((order.len(), boundary.len()), (100, 36));
    assert!(wave(&mesh, &[]) == given(&mesh, &order).0);
    assert!(wave(&mesh, &[false; 100]) == given(&mesh, &order).0);
}

#[test]
fn a_boundary_that_slides_goes_first() {
    let mesh = scattered(60, 8);
    let sliding = |order| Options { boundary: Boundary::Slide, ..in_order(order) };
    let is_inside = |p: &[f64; 3]| p[..2].iter().all(|x| (0.001..0.999).contains(x));
    let (mut sides, mut triangles) = (mesh.0.clone(), mesh.1.clone());
    // A vertex in the middle of a side, so that there is something to slide.
    let split =
        triangles.iter().position(|t| t.iter().filter(|&&v| !is_inside(&sides[v as usize])).count() == 2).unwrap();
    let [a, b, c] = triangles[split];
    let turned = [[a, b, c], [b, c, a], [c, a, b]];
    let [a, b, c] = *turned.iter().find(|t| is_inside(&sides[t[2] as usize])).unwrap();
    let middle = sides.len() as u32;
    let [p, q] = [a, b].map(|v| sides[v as usize]);
    sides.push([0, 1, 2].map(|k| 0.6 * p[k] + 0.4 * q[k]));
    triangles[split] = [a, middle, c];
    triangles.push([middle, b, c]);
    let mesh = (sides, triangles);
    let boundary: Vec<u32> = (0..=middle).filter(|&v| !is_inside(&mesh.0[v as usize])).collect();
    let order = rings(&mesh, &boundary);
    let constraints = Constraints { visits: &order, ..Constraints::default() };
    let expected = run(&mesh, &sliding(Order::Given), &constraints).0;
    assert_eq!(run(&mesh, &sliding(Order::Wave), &Constraints::default()).0, expected);
    assert_ne!(expected[middle as usize], mesh.0[middle as usize].map(f64::to_bits), "it slides");
}

#[test]
fn a_front_on_a_closed_surface_starts_at_the_worst_triangle() {
    let mesh = torus(20, 14, 0.4, 9);
    assert!(wave(&mesh, &[]) == given(&mesh, &rings(&mesh, &worst_triangle(&mesh))).0);
}

#[test]
fn seeds_come_before_boundary_and_worst_triangle() {
    for mesh in [sheet(9, 0.2, 0.4, 10), torus(20, 14, 0.4, 10)] {
        let seeds = [41, 17, 80];
        let expected = given(&mesh, &rings(&mesh, &seeds)).0;
        assert!(wave(&mesh, &mask(&mesh, &seeds)) == expected);
        assert!(wave(&mesh, &[]) != expected);
    }
}

#[test]
fn each_component_has_its_own_front() {
    let (closed, open) = (torus(20, 14, 0.4, 11), sheet(9, 0.2, 0.4, 11));
    let both = beside(closed.clone(), &open);
    let first = closed.0.len() as u32;
    let mut starts = worst_triangle(&closed).to_vec();
    starts.extend((0..100).filter(|v| v / 10 % 9 == 0 || v % 10 % 9 == 0).map(|v| first + v));
    assert!(wave(&both, &[]) == given(&both, &rings(&both, &starts)).0);
    // A seed in one component leaves the other one as it was.
    let seed = first + 44;
    starts.truncate(3);
    starts.push(seed);
    assert!(wave(&both, &mask(&both, &[seed])) == given(&both, &rings(&both, &starts)).0);
}

#[test]
fn a_front_passes_through_vertices_that_stay() {
    let mesh = sheet(9, 0.2, 0.4, 12);
    let locked = mask(&mesh, &(0..10).map(|row| 10 * row + 4).collect::<Vec<u32>>());
    let seeds = mask(&mesh, &[11]);
    let visits = rings(&mesh, &[11]);
    let constraints = Constraints { locked: &locked, seeds: &seeds, visits: &visits, ..Constraints::default() };
    let [waved, listed] = [Order::Wave, Order::Given].map(|order| run(&mesh, &in_order(order), &constraints).0);
    assert!(waved == listed);
    let behind = 10 * 5 + 7;
    assert_ne!(waved[behind], mesh.0[behind].map(f64::to_bits));
}

#[test]
fn only_the_vertices_of_the_list_move() {
    let mesh = torus(20, 14, 0.4, 13);
    let (after, report) = given(&mesh, &[5, 90, 5, 17]);
    let moved: Vec<usize> = (0..after.len()).filter(|&v| after[v] != mesh.0[v].map(f64::to_bits)).collect();
    assert_eq!((moved, report.moved), (vec![5, 17, 90], 3));
    assert_ne!(after[5], given(&mesh, &[5, 90, 17]).0[5], "a second visit in the same sweep counts");
    assert_eq!(given(&mesh, &[]).1.moved, 0);
}

#[test]
fn vertices_that_may_not_move_are_passed_over() {
    let mut mesh = torus(20, 14, 0.4, 14);
    mesh.0.push([9.0; 3]);
    let unused = mesh.0.len() as u32 - 1;
    let locked = mask(&mesh, &[7]);
    let constraints = Constraints { locked: &locked, visits: &[7, unused, 8], ..Constraints::default() };
    let (after, report) = run(&mesh, &in_order(Order::Given), &constraints);
    assert_eq!((report.moved, report.kept.locked, report.kept.unreferenced), (1, 1, 1));
    assert_ne!(after[8], mesh.0[8].map(f64::to_bits));
}

#[test]
fn what_an_order_asks_for_has_to_fit_the_mesh() {
    let mesh = torus(6, 6, 0.3, 15);
    let failure = |order, constraints: &Constraints<'_>| {
        let mut positions = mesh.0.clone();
        let result = smooth(&mut positions, &mesh.1, &in_order(order), constraints, &mut silent);
        assert!(result.is_ok() || positions == mesh.0);
        result.err()
    };
    let visits = Constraints { visits: &[3, 35, 36, 99], ..Constraints::default() };
    let expected = Error::VisitOutOfRange { visit: 2, index: 36, vertex_count: 36 };
    assert_eq!(expected.to_string(), "visit 2 names vertex 36, but there are 36 vertices");
    assert_eq!(failure(Order::Given, &visits), Some(expected));
    let seeds = Constraints { seeds: &[true; 35], ..Constraints::default() };
    assert_eq!(failure(Order::Wave, &seeds), Some(Error::SeedLength { found: 35, vertex_count: 36 }));
    for order in [Order::Colors, Order::Index, Order::Tail] {
        assert_eq!([&visits, &seeds].map(|unread| failure(order, unread)), [None, None], "{order:?} looks at neither");
    }
}

/// A torus on which one vertex in twelve has come very close to a neighbour, too bad for two sweeps by index.
fn with_slivers(seed: u64) -> Mesh {
    let mut mesh = torus(40, 24, 0.2, seed);
    for v in (0..mesh.0.len() - 1).step_by(12) {
        let (at, to) = (mesh.0[v], mesh.0[v + 1]);
        mesh.0[v] = [0, 1, 2].map(|k| 0.02 * at[k] + 0.98 * to[k]);
    }
    mesh
}

#[test]
fn worst_first_leaves_a_better_worst_triangle_than_by_index() {
    for seed in 1..9 {
        let mesh = with_slivers(seed);
        let after = |order| run(&mesh, &Options { iterations: 1, ..in_order(order) }, &Constraints::default()).1.after;
        let (by_index, tail) = (after(Order::Index), after(Order::Tail));
        assert!(by_index.shape.min < 0.5, "seed {seed}: nothing is left to do");
        assert!(tail.shape.min > by_index.shape.min, "seed {seed}: {} {}", tail.shape.min, by_index.shape.min);
        assert!(tail.edge_ratio.mean < 1.02 * by_index.edge_ratio.mean, "seed {seed}: the others are forgotten");
    }
}

/// Shape of the worst triangle at each vertex.
fn worst_shapes(mesh: &Mesh) -> Vec<f64> {
    let mut worst = vec![f64::INFINITY; mesh.0.len()];
    for t in &mesh.1 {
        let first = (0..3).min_by_key(|&k| t[k]).expect("three corners");
        let shape = meshes::shape(&mesh.0, &[0, 1, 2].map(|k| t[(first + k) % 3]));
        t.iter().for_each(|&v| worst[v as usize] = worst[v as usize].min(shape));
    }
    worst
}

/// What worst first is to do, said in another way: before each visit everything is measured.
fn worst_first_by_hand(mesh: &Mesh, movable: &[u32], sweeps: u32) -> (Mesh, usize) {
    let mut mesh = mesh.clone();
    let mut again = 0;
    for _ in 0..sweeps {
        let mut visits = vec![0; mesh.0.len()];
        let mut wants = vec![true; mesh.0.len()];
        for _ in 0..movable.len() {
            let worst = worst_shapes(&mesh);
            let at = |v: &u32| *v as usize;
            let may = |v: &&u32| wants[at(v)] && (visits[at(v)] == 0 || visits[at(v)] < 6 && worst[at(v)] < 0.5);
            let Some(&v) = movable.iter().filter(may).min_by(|a, b| worst[at(a)].total_cmp(&worst[at(b)])) else {
                break;
            };
            again += usize::from(visits[v as usize] > 0);
            visits[v as usize] += 1;
            wants[v as usize] = false;
            let options = Options { iterations: 1, ..in_order(Order::Given) };
            let after = run(&mesh, &options, &Constraints { visits: &[v], ..Constraints::default() }).0;
            let after: Vec<[f64; 3]> = after.iter().map(|p| p.map(f64::from_bits)).collect();
            if after != mesh.0 {
                mesh.0 = after;
                mesh.1
                    .iter()
                    .filter(|t| t.contains(&v))
                    .flatten()
                    .filter(|&&r| r != v)
                    .for_each(|r| wants[at(r)] = true);
            }
        }
    }
    (mesh, again)
}

#[test]
fn worst_first_is_what_measuring_before_each_visit_gives() {
    for seed in 1..6 {
        // In a plane no visit depends on where the call before it began.
        let mesh = scattered(70, seed);
        let triangles = |v: u32| mesh.1.iter().filter(move |t| t.contains(&v));
        let closes = |&v: &u32| triangles(v).flatten().collect::<BTreeSet<_>>().len() == triangles(v).count() + 1;
        let movable: Vec<u32> = (0..mesh.0.len() as u32).filter(closes).collect();
        let (expected, again) = worst_first_by_hand(&mesh, &movable, 2);
        assert!(again > 0, "seed {seed}: no star was bad enough for a second visit");
        let after = run(&mesh, &in_order(Order::Tail), &Constraints::default()).0;
        assert!(after == expected.0.iter().map(|p| p.map(f64::to_bits)).collect::<Vec<_>>(), "seed {seed}");
    }
}

#[test]
fn a_cancelled_order_leaves_everything() {
    let mesh = torus(80, 60, 0.4, 16);
    let all: Vec<u32> = (0..mesh.0.len() as u32).collect();
    let constraints = Constraints { visits: &all, ..Constraints::default() };
    for order in ALONE {
        let mut told = Vec::new();
        let mut positions = mesh.0.clone();
        let mut listen = |done: f64| {
            told.push(done);
            if done >= 0.5 { Flow::Cancel } else { Flow::Continue }
        };
        let result = smooth(&mut positions, &mesh.1, &in_order(order), &constraints, &mut listen);
        assert_eq!(result.unwrap_err(), Error::Cancelled, "{order:?}");
        assert!(positions == mesh.0, "{order:?}");
        assert!(told.is_sorted() && told.len() >= 3 && told[1..].iter().all(|&d| d < 1.0), "{order:?}: {told:?}");
    }
}

/// Measuring a star of many triangles whenever one of them changes would take hours.
#[test]
fn two_vertices_with_very_many_triangles_take_no_order_long() {
    let count = 100_000_u32;
    let mut random = meshes::Random(18);
    let around = |k: u32| f64::from(k) / f64::from(count) * std::f64::consts::TAU;
    let ring = (0..count).map(|k| [around(k).cos(), around(k).sin(), 1e-6 * random.signed()]);
    let positions = [[0.0, 0.0, 1.0], [0.1, 0.0, -1.0]].into_iter().chain(ring).collect();
    let sides = (0..count).map(|k| [k + 2, (k + 1) % count + 2]);
    let triangles = sides.flat_map(|[a, b]| [[0, a, b], [1, b, a]]).collect();
    let mesh: Mesh = (positions, triangles);
    let visits: Vec<u32> = (0..count + 2).collect();
    for order in ALONE {
        let constraints = Constraints { visits: &visits, ..Constraints::default() };
        let report = run(&mesh, &in_order(order), &constraints).1;
        assert!(report.moved > 1000, "{order:?} moves {}", report.moved);
    }
}

#[test]
fn where_nothing_moves_every_order_ends() {
    let mesh = sheet(4, 0.0, 0.0, 17);
    let locked = [true; 25];
    for order in ALONE {
        let constraints = Constraints { locked: &locked, visits: &[12, 12], ..Constraints::default() };
        let options = Options { iterations: 10_000, ..in_order(order) };
        assert_eq!(run(&mesh, &options, &constraints).1.moved, 0, "{order:?}");
        let empty: Mesh = (Vec::new(), Vec::new());
        assert_eq!(run(&empty, &options, &Constraints::default()).1.moved, 0, "{order:?}");
    }
}
