//! The paper's "Triangle-tail": the star with the worst triangle first, and again as long as that is bad and something
//! near it moves; then the others, from worse to better.
//!
//! A sweep makes no more visits than there are vertices that move. What the worst stars take beyond their own visit is
//! missing at the end, where the stars are best and a visit does least.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::end::Tally;
use super::outcome::Outcomes;
use super::places::Places;
use super::surroundings::Surroundings;
use super::visit::LoneVisitor;
use crate::error::Error;
use crate::memory;
use crate::progress::{self, Progress};
use crate::quality::triangle::Sides;

/// Mean-ratio shape below which a triangle is bad enough for another visit to its star in the same sweep.
const BAD: f64 = 0.5;

/// Visits of a star at most in one sweep. Measured on scans and isosurfaces: up to here the worst triangle gets better,
/// beyond it hardly does.
const VISITS: u8 = 6;

/// Sweeps `iterations` times, with as many visits as there are vertices to move or fewer. `tell` hears the share of the
/// visits that is done.
pub(super) fn run(
    around: &Surroundings<'_>,
    places: &Places,
    outcomes: &Outcomes,
    iterations: u32,
    tell: &mut Progress<'_>,
) -> Result<Tally, Error> {
    let movable = around.movable()?;
    let mut visitor = LoneVisitor::new(around);
    let mut queue = Queue::new(around, places, movable.len())?;
    let total = f64::from(iterations) * movable.len() as f64;
    for sweep in 0..iterations {
        queue.fill(&movable);
        for visit in 0..movable.len() {
            if visit.is_multiple_of(progress::INTERVAL) {
                progress::tell(tell, (f64::from(sweep) * movable.len() as f64 + visit as f64) / total)?;
            }
            let Some(v) = queue.next() else { break };
            let before = places.get(v);
            visitor.visit(v, places, outcomes);
            if places.get(v) != before {
                queue.measure_around(v)?;
            }
        }
    }
    Ok(visitor.tally)
}

/// A star that waits for a visit.
#[derive(PartialEq)]
struct Waiting {
    shape: f64,
    vertex: u32,
}

impl Eq for Waiting {}

impl Ord for Waiting {
    /// The worst is the greatest, among equals the one of least index.
    fn cmp(&self, other: &Self) -> Ordering {
        other.shape.total_cmp(&self.shape).then(other.vertex.cmp(&self.vertex))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The stars that wait in one sweep, worst first.
struct Queue<'a> {
    around: &'a Surroundings<'a>,
    places: &'a Places,
    /// An entry holds only if its star waits and its shape is the star's bound; others are left behind by stars that
    /// have got worse since.
    heap: BinaryHeap<Waiting>,
    stars: Vec<Standing>,
}

/// What is known of a star.
#[derive(Clone, Copy)]
struct Standing {
    /// No triangle of the star has a shape below this. That triangles have got better is not looked at before the star
    /// comes up.
    bound: f64,
    /// Visits in this sweep.
    visits: u8,
    waits: bool,
}

impl<'a> Queue<'a> {
    /// An empty queue with room for `movable` stars.
    fn new(around: &'a Surroundings<'a>, places: &'a Places, movable: usize) -> Result<Self, Error> {
        let unknown = Standing { bound: f64::INFINITY, visits: 0, waits: false };
        let stars = memory::filled(unknown, around.stars.len())?;
        let heap = BinaryHeap::from(memory::reserved(movable)?);
        Ok(Self { around, places, heap, stars })
    }

    /// Starts a sweep: all stars wait, measured as they are now.
    fn fill(&mut self, movable: &[u32]) {
        self.heap.clear();
        for &v in movable {
            let bound = self.worst_shape(v);
            self.stars[v as usize] = Standing { bound, visits: 0, waits: true };
            self.heap.push(Waiting { shape: bound, vertex: v });
        }
    }

    /// Takes out the star with the worst triangle of all that wait.
    fn next(&mut self) -> Option<u32> {
        while let Some(Waiting { shape, vertex }) = self.heap.pop() {
            let star = self.stars[vertex as usize];
            if !star.waits || star.bound.total_cmp(&shape).is_ne() || self.waits_on(vertex) {
                continue;
            }
            let star = &mut self.stars[vertex as usize];
            star.waits = false;
            if star.may_be_visited() {
                star.visits += 1;
                return Some(vertex);
            }
        }
        None
    }

    /// Measures the star of `v`, whose turn it would be, and lets it wait on if it has got better.
    fn waits_on(&mut self, v: u32) -> bool {
        // The bound has to do for a star of very many triangles, which would be measured whenever one of them changes.
        if self.around.stars.is_hub(v) {
            return false;
        }
        let now = self.worst_shape(v);
        let star = &mut self.stars[v as usize];
        let is_better = now > star.bound;
        if is_better {
            star.bound = now;
            self.heap.push(Waiting { shape: now, vertex: v });
        }
        is_better
    }

    /// Measures what the move of `v` has changed, and lets its neighbours wait where another visit may help.
    fn measure_around(&mut self, v: u32) -> Result<(), Error> {
        let rim = self.around.stars.rim(v);
        let room = self.heap.try_reserve(2 * rim.len());
        room.map_err(|_| Error::OutOfMemory { bytes: 2 * rim.len() * size_of::<Waiting>() })?;
        let mut worst = f64::INFINITY;
        for ends in rim.windows(2) {
            let shape = self.shape(v, ends);
            worst = worst.min(shape);
            ends.iter().for_each(|&r| self.lower(r, shape));
        }
        self.stars[v as usize].bound = worst;
        Ok(())
    }

    /// Takes notice of a triangle in the star of `v` that has changed.
    fn lower(&mut self, v: u32, shape: f64) {
        if !self.around.features.role(v).moves() {
            return;
        }
        let star = &mut self.stars[v as usize];
        let is_worse = shape < star.bound;
        star.bound = star.bound.min(shape);
        if star.may_be_visited() && (is_worse || !star.waits) {
            star.waits = true;
            self.heap.push(Waiting { shape: star.bound, vertex: v });
        }
    }

    /// Shape of the worst triangle of a star.
    fn worst_shape(&self, v: u32) -> f64 {
        self.around.stars.rim(v).windows(2).map(|ends| self.shape(v, ends)).fold(f64::INFINITY, f64::min)
    }

    /// Mean-ratio shape of the triangle between `v` and an edge of its rim: to the bit the same in the stars of all its
    /// corners, so that these are equals.
    fn shape(&self, v: u32, ends: &[u32]) -> f64 {
        let [a, b] = [ends[0], ends[1]];
        let from_least = match v.min(a).min(b) {
            least if least == v => [v, a, b],
            least if least == a => [a, b, v],
            _ => [b, v, a],
        };
        Sides::new(from_least.map(|corner| self.places.get(corner))).shape()
    }
}

impl Standing {
    /// Whether this sweep has a visit left for it.
    fn may_be_visited(&self) -> bool {
        self.visits == 0 || self.visits < VISITS && self.bound < BAD
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_comes_first_and_among_equals_the_first() {
        let waiting = [(0.5, 1), (0.2, 7), (0.2, 3), (0.0, 9)].map(|(shape, vertex)| Waiting { shape, vertex });
        let mut heap = BinaryHeap::from(waiting);
        let order: Vec<u32> = std::iter::from_fn(|| heap.pop()).map(|waiting| waiting.vertex).collect();
        assert_eq!(order, [9, 3, 7, 1]);
    }

    #[test]
    fn only_bad_stars_are_visited_again() {
        let may = |visits, bound| Standing { bound, visits, waits: true }.may_be_visited();
        assert!(may(0, 0.9) && may(1, 0.4) && may(VISITS - 1, 0.4));
        assert!(!may(1, 0.5) && !may(VISITS, 0.0));
    }
}
