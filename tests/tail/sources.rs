//! Every attribute finds its way home.

use qsmesh::{Constraints, Options, TailOptions};

use crate::check::{assert_sound, directed_edges};
use crate::meshes::{self, Soup};
use crate::{Result, improve};

const AROUND: u32 = 36;
const ACROSS: u32 = 18;

/// Edges of a torus where one of its two angles passes from 1 to 0: the seam of its UVs.
fn seam() -> Vec<[u32; 2]> {
    let index = |i: u32, j: u32| (j % ACROSS) * AROUND + i % AROUND;
    let long = (0..AROUND).map(|i| [index(i, 0), index(i + 1, 0)]);
    let short = (0..ACROSS).map(|j| [index(0, j), index(0, j + 1)]);
    long.chain(short).collect()
}

/// UV of each corner: on the seam it is 0 or 1, as the triangle needs it.
fn uvs(soup: &Soup) -> Vec<[f64; 2]> {
    let unwrapped = |x: f64, others: f64| if x == 0.0 && others > 0.5 { 1.0 } else { x };
    let corner = |t: &[u32; 3], k: usize| {
        let at = |v: u32| [f64::from(v % AROUND) / f64::from(AROUND), f64::from(v / AROUND) / f64::from(ACROSS)];
        let largest = |axis: usize| t.iter().map(|&v| at(v)[axis]).fold(0.0, f64::max);
        let [u, v] = at(t[k]);
        [unwrapped(u, largest(0)), unwrapped(v, largest(1))]
    };
    soup.triangles.iter().flat_map(|t| (0..3).map(move |k| corner(t, k))).collect()
}

fn treated() -> (Soup, Result<qsmesh::Improvement>) {
    let before = meshes::torus(AROUND, ACROSS).jittered(11, 0.13);
    let seam = seam();
    let fixed = Constraints { feature_edges: &seam, ..Constraints::default() };
    let options = Options { feature_angle: None, ..Options::default() };
    let tail =
        TailOptions { min_angle: 35.0, max_angle: 105.0, edge_ratio: 2.0, flips: true, ..TailOptions::default() };
    let result = improve(&before, &options, &tail, &fixed);
    assert_sound(&before, &result.after, &result.sources);
    let report = &result.report.tail;
    assert!(report.vertices_removed > 3 && report.general_flips > 10, "there must be something to follow: {report:?}");
    (before, result)
}

#[test]
fn uvs_stay_on_their_side_of_the_seam() {
    let (before, result) = treated();
    let uvs = uvs(&before);
    for (t, corners) in result.after.triangles.iter().enumerate() {
        let own: Vec<_> = (0..3).map(|k| uvs[result.sources.corner[3 * t + k] as usize]).collect();
        for axis in 0..2 {
            let [low, high] = [f64::min, f64::max].map(|f| own.iter().map(|uv| uv[axis]).reduce(f).expect("three"));
            assert!(high - low < 0.4, "triangle {corners:?} has its corners on both sides of the seam: {own:?}");
        }
    }
}

#[test]
fn seam_edges_all_survive() {
    let (_, result) = treated();
    let edges = directed_edges(&result.after.triangles);
    let number = |v: u32| result.sources.vertex.binary_search(&v).expect("seam vertices survive") as u32;
    for [a, b] in seam() {
        assert!(edges.contains_key(&(number(a), number(b))) && edges.contains_key(&(number(b), number(a))));
    }
}

#[test]
fn corners_come_from_the_source_triangle_where_nothing_has_changed() {
    let (before, result) = treated();
    let mut elsewhere = 0;
    for (t, corners) in result.after.triangles.iter().enumerate() {
        let source = result.sources.triangle[t];
        let own = [0, 1, 2].map(|k| result.sources.corner[3 * t + k]);
        let is_kept = before.triangles[source as usize] == corners.map(|v| result.sources.vertex[v as usize]);
        if is_kept {
            assert_eq!(own, [3 * source, 3 * source + 1, 3 * source + 2]);
        } else {
            elsewhere += own.iter().filter(|&corner| corner / 3 != source).count();
        }
    }
    assert!(elsewhere > 0, "there must be corners that come from elsewhere");
}

#[test]
fn weights_of_vertices_that_did_not_move_stay_at_their_place() {
    let (before, result) = treated();
    let kept = result.sources.vertex.len();
    assert_eq!(kept + result.report.tail.vertices_removed, before.positions.len());
    let locked_like = result.sources.vertex.iter().zip(&result.after.positions);
    let unmoved = locked_like.filter(|&(&v, p)| before.positions[v as usize] == *p).count();
    // The one vertex where both seams cross is a corner.
    assert!(unmoved >= 1);
    let crossing = result.sources.vertex.binary_search(&0).expect("the crossing survives");
    assert_eq!(result.after.positions[crossing], before.positions[0]);
}

#[test]
fn materials_meet_along_the_marked_edges_only() {
    let before = meshes::torus(AROUND, ACROSS).jittered(11, 0.13);
    let index = |i: u32, j: u32| (j % ACROSS) * AROUND + i % AROUND;
    // Two materials, parted by two rings of edges.
    let parting: Vec<_> =
        [0, 9].into_iter().flat_map(|j| (0..AROUND).map(move |i| [index(i, j), index(i + 1, j)])).collect();
    let material = |t: u32| u32::from(t >= 2 * AROUND * 9);
    let fixed = Constraints { feature_edges: &parting, ..Constraints::default() };
    let options = Options { feature_angle: None, ..Options::default() };
    let tail = TailOptions { min_angle: 35.0, max_angle: 105.0, edge_ratio: 2.0, ..TailOptions::default() };
    let result = improve(&before, &options, &tail, &fixed);
    assert!(result.report.tail.vertices_removed > 3);
    let mut owner = std::collections::BTreeMap::new();
    for (t, &[a, b, c]) in result.after.triangles.iter().enumerate() {
        for edge in [(a, b), (b, c), (c, a)] {
            owner.insert(edge, material(result.sources.triangle[t]));
        }
    }
    let old = |v: u32| result.sources.vertex[v as usize];
    let meeting =
        owner.iter().filter(|&(&(a, b), m)| a < b && owner[&(b, a)] != *m).map(|(&(a, b), _)| [old(a), old(b)]);
    let mut meeting: Vec<_> = meeting.collect();
    let mut marked: Vec<_> = parting.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
    meeting.sort_unstable();
    marked.sort_unstable();
    assert_eq!(meeting, marked);
}
