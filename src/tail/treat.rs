//! One tail triangle: the candidates for its cure, the cheapest first.

use super::accept::Judge;
use super::collapse::collapse;
use super::debt;
use super::flip::flip;
use super::limits::Limits;
use super::live::Live;
use super::patch::{Patch, Shape};
use super::rank::Rank;
use super::relax::Relaxer;
use super::remove::remove;
use super::report::Reason;
use super::topology::fresh;
use crate::mesh::repeats_a_vertex;
use crate::sweep::Surroundings;

/// Rounds of moves over the three corners, and over the whole patch.
const ROUNDS: [usize; 2] = [2, 3];

/// What can be done to a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Operation {
    /// Move the corners of the triangle.
    Move,
    /// Move all free vertices of the patch.
    MoveAll,
    Flip(usize, usize),
    Collapse(usize, usize),
    Remove(usize),
}

/// A change that has been found good.
pub(super) struct Cure {
    pub patch: Patch,
    pub shape: Shape,
    pub operation: Operation,
    /// Greatest distance of a vertex that it removes from the triangles that take its place.
    pub lost_height: f64,
}

/// Treats tail triangles, with working memory that is reused.
pub(super) struct Surgeon<'a> {
    around: &'a Surroundings<'a>,
    limits: &'a Limits,
    relaxer: Relaxer<'a>,
}

/// What the candidates for one triangle came to.
struct Findings {
    before: Rank,
    best: Option<(Rank, Shape, Operation)>,
    /// Why candidates that would have cured it were refused.
    refused: Vec<Reason>,
    /// Why candidates could not be made at all.
    impossible: Vec<Reason>,
}

impl Findings {
    /// What a candidate has to be better than.
    fn to_beat(&self) -> &Rank {
        self.best.as_ref().map_or(&self.before, |best| &best.0)
    }

    /// Why nothing has helped: what stood between the triangle and a cure, else what might have.
    fn reason(&self) -> Reason {
        let first = |reasons: &[Reason]| reasons.iter().min().copied();
        first(&self.refused).or(first(&self.impossible)).unwrap_or(Reason::NoGain)
    }
}

impl<'a> Surgeon<'a> {
    pub fn new(around: &'a Surroundings<'a>, limits: &'a Limits) -> Self {
        Self { around, limits, relaxer: Relaxer::new(around, limits) }
    }

    /// The first candidate that takes a triangle of the patch out of the tail; if none does, the one that makes the worst
    /// triangle best; else the reason.
    pub fn treat(&mut self, live: &Live<'_>, slot: u32) -> Result<Cure, Reason> {
        let corners = live.triangles[slot as usize];
        if repeats_a_vertex(&corners) {
            return Err(Reason::Topology);
        }
        let patch = Patch::around(live, self.around, slot);
        let before = Rank::of(self.limits, &patch.shape);
        let mut findings = Findings { before, best: None, refused: Vec::new(), impossible: Vec::new() };
        for operation in self.operations(live, &patch, slot) {
            if self.attempt(live, &patch, operation, &mut findings) {
                break;
            }
        }
        match findings.best {
            Some((_, shape, operation)) => {
                let lost_height =
                    Judge { around: self.around, live, patch: &patch, limits: self.limits }.lost_height(&shape);
                Ok(Cure { patch, shape, operation, lost_height })
            }
            None => Err(findings.reason()),
        }
    }

    /// The candidates, the cheapest first.
    fn operations(&self, live: &Live<'_>, patch: &Patch, slot: u32) -> Vec<Operation> {
        let p = &patch.shape.positions;
        let mut edges = [(0, 1), (1, 2), (2, 0)];
        edges.sort_by(|e, f| p[e.0].distance_squared(p[e.1]).total_cmp(&p[f.0].distance_squared(p[f.1])));
        let flips = edges.iter().rev().map(|&(a, b)| Operation::Flip(a, b));
        let collapses = edges.iter().map(|&(a, b)| Operation::Collapse(a, b));
        // The largest angle lies opposite the longest edge.
        let removals = edges.iter().rev().map(|&(a, b)| Operation::Remove(3 - a - b));
        let mut all = vec![Operation::Move, Operation::MoveAll];
        all.extend(flips);
        if self.limits.is_needle(live.corners(slot)) {
            all.extend(collapses.chain(removals));
        } else {
            all.extend(removals.chain(collapses));
        }
        all
    }

    /// Tries one candidate. True if it cures.
    fn attempt(&mut self, live: &Live<'_>, patch: &Patch, operation: Operation, findings: &mut Findings) -> bool {
        match self.candidate(patch, operation, findings) {
            Ok(Some(shape)) => self.consider(live, patch, shape, operation, findings),
            Ok(None) => false,
            Err(reason) => {
                findings.impossible.push(reason);
                false
            }
        }
    }

    /// Carries an operation out on a copy of the patch, pays its volume debt and relaxes the surroundings. `None` if what
    /// no move can change is already too bad.
    fn candidate(&mut self, patch: &Patch, operation: Operation, found: &Findings) -> Result<Option<Shape>, Reason> {
        let mut shape = match operation {
            Operation::Move | Operation::MoveAll => patch.shape.clone(),
            Operation::Flip(a, b) => flip(patch, self.around, a, b)?,
            Operation::Collapse(a, b) => collapse(patch, self.around, a, b)?,
            Operation::Remove(v) => remove(patch, v)?,
        };
        if Rank::of_frozen(self.limits, patch, &shape).compare(found.to_beat()).is_ge() {
            return Ok(None);
        }
        let all: Vec<_> = (0..patch.vertices.len()).collect();
        if fresh(&shape).next().is_some() && !debt::pay(&mut self.relaxer, patch, &mut shape, &all) {
            return Err(Reason::Fold);
        }
        let (vertices, rounds) =
            if operation == Operation::Move { (&all[..3], ROUNDS[0]) } else { (&all[..], ROUNDS[1]) };
        self.relaxer.relax_all(patch, &mut shape, vertices, rounds);
        Ok(Some(shape))
    }

    /// Notes a candidate if it is the best so far and nothing speaks against it. True if it cures.
    fn consider(
        &mut self,
        live: &Live<'_>,
        patch: &Patch,
        shape: Shape,
        operation: Operation,
        findings: &mut Findings,
    ) -> bool {
        let rank = Rank::of(self.limits, &shape);
        let cures = rank.cures(&findings.before);
        if !cures && rank.compare(findings.to_beat()).is_ge() {
            return false;
        }
        let judge = Judge { around: self.around, live, patch, limits: self.limits };
        if let Some(reason) = judge.objection(&shape) {
            if cures {
                findings.refused.push(reason);
            }
            return false;
        }
        findings.best = Some((rank, shape, operation));
        cures
    }
}
