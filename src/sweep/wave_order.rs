//! The paper's "Wave": a front that spreads ring by ring.
//!
//! Where it starts and how it runs depends on the original mesh alone, so it is found once and every sweep follows it.
//! It passes through vertices that stay: what they are does not keep the triangles beyond from being neighbours.

use super::in_turn;
use super::neighbours::{NONE, Neighbours, components};
use super::outcome::Outcomes;
use super::places::Places;
use super::visit::{Surroundings, Tally};
use crate::error::Error;
use crate::memory;
use crate::mesh::{Mesh, StarKind, repeats_a_vertex};
use crate::progress::Progress;
use crate::quality::triangle::Sides;

/// Sweeps `iterations` times over all vertices. The front starts at the `seeds` of each component; without one, at its
/// boundary; without that, at its worst triangle. `tell` hears the share of the sweeps that is done.
pub(super) fn run(
    around: &Surroundings<'_>,
    places: &Places,
    outcomes: &Outcomes,
    (seeds, iterations): (&[bool], u32),
    tell: &mut Progress<'_>,
) -> Result<Tally, Error> {
    let mut front = front(around, seeds)?;
    front.retain(|&v| around.features.role(v).moves());
    in_turn::run(around, places, outcomes, (&front, iterations), tell)
}

/// All vertices that have a triangle: first where the front starts, then ring by ring, each ring by index.
fn front(around: &Surroundings<'_>, seeds: &[bool]) -> Result<Vec<u32>, Error> {
    let neighbours = Neighbours::new(around.mesh)?;
    let components = components(&neighbours)?;
    let start = start(around, seeds, &components)?;
    spread(&neighbours, &start)
}

/// What is known of where the front may start in a component.
#[derive(Clone, Copy)]
struct Origin {
    has_seed: bool,
    has_boundary: bool,
    /// Shape and number of its worst triangle, the first among equals.
    worst: Option<(f64, u32)>,
}

impl Origin {
    const UNKNOWN: Self = Self { has_seed: false, has_boundary: false, worst: None };

    fn takes_worst(&self) -> bool {
        !self.has_seed && !self.has_boundary
    }
}

/// The vertices where the front starts, by index.
fn start(around: &Surroundings<'_>, seeds: &[bool], components: &[u32]) -> Result<Vec<u32>, Error> {
    let is_seed = |v: usize| seeds.get(v).copied().unwrap_or(false);
    let is_open = |v: usize| around.stars.kind(v as u32) == StarKind::Open;
    let mut origins = memory::filled(Origin::UNKNOWN, components.len())?;
    let known = || components.iter().enumerate().filter(|&(_, &component)| component != NONE);
    for (v, &component) in known() {
        let origin = &mut origins[component as usize];
        origin.has_seed |= is_seed(v);
        origin.has_boundary |= is_open(v);
    }
    find_worst(around.mesh, components, &mut origins);
    let mut starts = memory::filled(false, components.len())?;
    for (v, &component) in known() {
        let origin = &origins[component as usize];
        starts[v] = if origin.has_seed { is_seed(v) } else { is_open(v) };
    }
    for (_, triangle) in origins.iter().filter(|origin| origin.takes_worst()).filter_map(|origin| origin.worst) {
        around.mesh.triangles[triangle as usize].iter().for_each(|&corner| starts[corner as usize] = true);
    }
    let mut vertices = memory::reserved(starts.iter().filter(|&&starts| starts).count())?;
    vertices.extend((0..starts.len() as u32).filter(|&v| starts[v as usize]));
    Ok(vertices)
}

fn find_worst(mesh: &Mesh<'_>, components: &[u32], origins: &mut [Origin]) {
    for (number, triangle) in (0_u32..).zip(mesh.triangles).filter(|(_, t)| !repeats_a_vertex(t)) {
        let shape = Sides::new(mesh.corners(triangle)).shape();
        let worst = &mut origins[components[triangle[0] as usize] as usize].worst;
        if worst.is_none_or(|(least, _)| shape.total_cmp(&least).is_lt()) {
            *worst = Some((shape, number));
        }
    }
}

/// The front: the vertices of `start`, then those that share a triangle with them, and so on.
fn spread(neighbours: &Neighbours<'_>, start: &[u32]) -> Result<Vec<u32>, Error> {
    let count = neighbours.mesh.positions.len();
    let mut reached = memory::filled(false, count)?;
    let mut front: Vec<u32> = memory::reserved(count)?;
    front.extend(start);
    start.iter().for_each(|&v| reached[v as usize] = true);
    let mut ring = 0..front.len();
    while !ring.is_empty() {
        for at in ring.clone() {
            for r in neighbours.of(front[at]) {
                if !std::mem::replace(&mut reached[r as usize], true) {
                    front.push(r);
                }
            }
        }
        ring = ring.end..front.len();
        front[ring.clone()].sort_unstable();
    }
    Ok(front)
}
