//! General flips: every interior edge that is no feature, where the Delaunay criterion in the tangent plane wants it.

use std::collections::VecDeque;

use glam::DVec3;

use super::accept::Judge;
use super::commit::commit;
use super::debt;
use super::flip::flip;
use super::limits::Limits;
use super::live::{GONE, Live};
use super::patch::{Patch, Shape};
use super::rank::Rank;
use super::relax::Relaxer;
use super::topology::{fresh, slots_taken_out};
use crate::error::Error;
use crate::memory;
use crate::mesh::repeats_a_vertex;
use crate::progress::{self, Progress};
use crate::quality::triangle::Sides;
use crate::star::{TangentPlane, double_vector_area};
use crate::sweep::Surroundings;

/// How often one triangle may take part in a flip, so that it ends although the plane changes from edge to edge.
const MOST_FLIPS: u8 = 8;

/// Triangles looked at between two calls of the progress callback.
const INTERVAL: usize = 4096;

/// The flips, with working memory that is reused.
pub(super) struct Flipper<'a> {
    around: &'a Surroundings<'a>,
    limits: &'a Limits,
    relaxer: Relaxer<'a>,
    /// Flips that each slot has taken part in.
    flips: Vec<u8>,
    /// Slots still to be looked at.
    queue: VecDeque<u32>,
    is_queued: Vec<bool>,
    /// Flips carried out.
    pub count: usize,
    /// Whether a vertex is one of a flipped triangle.
    is_touched: Vec<bool>,
}

impl<'a> Flipper<'a> {
    pub fn new(around: &'a Surroundings<'a>, limits: &'a Limits, live: &Live<'_>) -> Result<Self, Error> {
        let slots = live.triangles.len();
        let mut queue = memory::reserved(slots)?;
        queue.extend(0..slots as u32);
        Ok(Self {
            around,
            limits,
            relaxer: Relaxer::new(around, limits),
            flips: memory::filled(0, slots)?,
            queue: queue.into(),
            is_queued: memory::filled(true, slots)?,
            count: 0,
            is_touched: memory::filled(false, live.positions.len())?,
        })
    }

    /// Flips until no edge wants it any more, then visits the stars that have changed.
    pub fn run(&mut self, live: &mut Live<'_>, tell: &mut Progress<'_>) -> Result<(), Error> {
        let first = self.queue.len().max(1) as f64;
        let mut seen = 0_usize;
        while let Some(slot) = self.queue.pop_front() {
            if seen.is_multiple_of(INTERVAL) {
                progress::tell(tell, (seen as f64 / first).min(1.0))?;
            }
            seen += 1;
            self.is_queued[slot as usize] = false;
            self.look_at(live, slot);
        }
        for v in 0..self.is_touched.len() {
            if self.is_touched[v] {
                self.visit(live, v as u32);
            }
        }
        Ok(())
    }

    /// Flips the first edge of a triangle that wants it and may be flipped.
    fn look_at(&mut self, live: &mut Live<'_>, slot: u32) {
        let corners = live.triangles[slot as usize];
        if corners == GONE || repeats_a_vertex(&corners) {
            return;
        }
        let [a, b, c] = corners;
        for (p, q, r) in [(a, b, c), (b, c, a), (c, a, b)] {
            if let Some(s) = third_corner(live, q, p)
                && wants_flip([p, s, q, r].map(|v| live.positions[v as usize]))
                && self.flip(live, [p, q, r, s])
            {
                return;
            }
        }
    }

    /// Flips the edge p–q of the triangles (p, q, r) and (q, p, s) if everything allows it.
    fn flip(&mut self, live: &mut Live<'_>, quad: [u32; 4]) -> bool {
        let patch = Patch::of_stars(live, self.around, &quad);
        let Ok(mut shape) = flip(&patch, self.around, 0, 1) else {
            return false;
        };
        let spent = slots_taken_out(&patch, &shape).iter().any(|&s| self.flips[s as usize] >= MOST_FLIPS);
        if spent
            || !debt::pay(&mut self.relaxer, &patch, &mut shape, &[0, 1, 2, 3])
            || !self.is_gain(live, &patch, &shape)
        {
            return false;
        }
        self.count += 1;
        quad.iter().for_each(|&v| self.is_touched[v as usize] = true);
        for slot in commit(live, &patch, &shape) {
            let is_in_quad = live.triangles[slot as usize].iter().filter(|v| quad.contains(v)).count() == 3;
            self.flips[slot as usize] += u8::from(is_in_quad);
            if !std::mem::replace(&mut self.is_queued[slot as usize], true) {
                self.queue.push_back(slot);
            }
        }
        true
    }

    /// Whether the worse of the two triangles is better afterwards, the tail no worse, and nothing speaks against it.
    fn is_gain(&self, live: &Live<'_>, patch: &Patch, shape: &Shape) -> bool {
        let gone = patch.shape.pieces.iter().filter(|p| !shape.pieces.contains(p));
        let before = gone.map(|p| Sides::new(patch.shape.corners(p)).shape()).fold(f64::INFINITY, f64::min);
        let after = fresh(shape).map(|p| Sides::new(shape.corners(p)).shape()).fold(f64::INFINITY, f64::min);
        let tail = Rank::of(self.limits, shape).compare(&Rank::of(self.limits, &patch.shape));
        let judge = Judge { around: self.around, live, patch, limits: self.limits };
        after > before && tail.is_le() && judge.objection(shape).is_none()
    }

    /// The operation on the star of `v` as it is now.
    fn visit(&mut self, live: &mut Live<'_>, v: u32) {
        let patch = Patch::of_stars(live, self.around, &[v]);
        let mut shape = patch.shape.clone();
        if self.relaxer.operate(&patch, &mut shape, 0) {
            live.positions[v as usize] = shape.positions[0];
        }
    }
}

/// The third corner of the one other triangle at the edge p–q, if the edge has exactly two and they agree.
fn third_corner(live: &Live<'_>, p: u32, q: u32) -> Option<u32> {
    let slots = live.around_all(&[p, q]).iter();
    let mut beside = slots.map(|&s| live.triangles[s as usize]).filter(|t| t.contains(&p) && t.contains(&q));
    let pair = [beside.next()?, beside.next()?];
    let directed = |t: &[u32; 3]| (0..3).find(|&k| t[k] == p && t[(k + 1) % 3] == q).map(|k| t[(k + 2) % 3]);
    let mut thirds = pair.iter().filter_map(directed);
    let third = thirds.next();
    third.filter(|_| thirds.next().is_none() && beside.next().is_none())
}

/// Whether the diagonal between the first and the third corner of a quadrilateral is not Delaunay in the plane orthogonal
/// to its vector area: the angles that face it add up to more than 180°, by a margin above rounding.
fn wants_flip(quad: [DVec3; 4]) -> bool {
    const MARGIN: f64 = 1e-3;
    let relative = quad.map(|p| p - quad[0]);
    let closed = [relative[0], relative[1], relative[2], relative[3], relative[0]];
    let Some(plane) = TangentPlane::orthogonal_to(double_vector_area(closed.into_iter())) else {
        return false;
    };
    let [p, s, q, r] = relative.map(|x| plane.project(x));
    let (cross_r, dot_r) = ((p - r).perp_dot(q - r), (p - r).dot(q - r));
    let (cross_s, dot_s) = ((q - s).perp_dot(p - s), (q - s).dot(p - s));
    // Sine of the sum of both angles, times the four lengths.
    let sine = cross_r * dot_s + cross_s * dot_r;
    let lengths = (cross_r * cross_r + dot_r * dot_r).sqrt() * (cross_s * cross_s + dot_s * dot_s).sqrt();
    cross_r > 0.0 && cross_s > 0.0 && sine < -MARGIN * lengths
}
