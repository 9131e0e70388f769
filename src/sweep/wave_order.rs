//! The paper's "Wave": a front that spreads ring by ring.
//!
//! Where it starts and how it runs depends on the original mesh alone, so it is found once and every sweep follows it.
//! It passes through vertices that stay: what they are does not keep the triangles beyond from being neighbours.

use super::end::Tally;
use super::in_turn;
use super::neighbours::{NONE, Neighbours, components};
use super::outcome::Outcomes;
use super::places::Places;
use super::surroundings::Surroundings;
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
    let mut origins = memory::filled(Origin::UNKNOWN, components.len())?;
    find_seeds_and_boundaries(around, seeds, &components, &mut origins);
    find_worst(around.mesh, &components, &mut origins);
    let mut front = memory::reserved(components.len())?;
    let mut reached = memory::filled(false, components.len())?;
    start(around, seeds, &components, &origins, &mut reached);
    front.extend((0..reached.len() as u32).filter(|&v| reached[v as usize]));
    spread(&neighbours, &mut front, &mut reached);
    Ok(front)
}

/// What is known of where the front may start in a component. It stands at the number of the component.
#[derive(Clone, Copy)]
struct Origin {
    has_seed: bool,
    has_boundary: bool,
    /// Shape and number of its worst triangle, the first among equals.
    worst: Option<(f64, u32)>,
}

impl Origin {
    const UNKNOWN: Self = Self { has_seed: false, has_boundary: false, worst: None };
}

/// Vertices that have a component, with its number.
fn members(components: &[u32]) -> impl Iterator<Item = (u32, u32)> {
    (0..).zip(components.iter().copied()).filter(|&(_, component)| component != NONE)
}

fn is_seed(seeds: &[bool], v: u32) -> bool {
    seeds.get(v as usize).copied().unwrap_or(false)
}

fn is_on_boundary(around: &Surroundings<'_>, v: u32) -> bool {
    around.stars.kind(v) == StarKind::Open
}

fn find_seeds_and_boundaries(around: &Surroundings<'_>, seeds: &[bool], components: &[u32], origins: &mut [Origin]) {
    for (v, component) in members(components) {
        let origin = &mut origins[component as usize];
        origin.has_seed |= is_seed(seeds, v);
        origin.has_boundary |= is_on_boundary(around, v);
    }
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

/// Tells at which vertices the front starts.
fn start(around: &Surroundings<'_>, seeds: &[bool], components: &[u32], origins: &[Origin], starts: &mut [bool]) {
    for (v, component) in members(components) {
        let has_seed = origins[component as usize].has_seed;
        starts[v as usize] = if has_seed { is_seed(seeds, v) } else { is_on_boundary(around, v) };
    }
    let is_closed_without_seed = |origin: &&Origin| !origin.has_seed && !origin.has_boundary;
    for (_, triangle) in origins.iter().filter(is_closed_without_seed).filter_map(|origin| origin.worst) {
        around.mesh.triangles[triangle as usize].iter().for_each(|&corner| starts[corner as usize] = true);
    }
}

/// Adds ring after ring to the vertices in `front`: those that share a triangle with the ring before and are not `reached`.
fn spread(neighbours: &Neighbours<'_>, front: &mut Vec<u32>, reached: &mut [bool]) {
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
}
