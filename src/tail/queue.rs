//! Worst first: the order in which tail triangles are treated, and the bounds within which that ends.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use super::commit::commit;
use super::detect;
use super::limits::Limits;
use super::live::Live;
use super::options::TailOptions;
use super::report::{Reason, TailReport};
use super::treat::{Cure, Operation, Surgeon};
use crate::error::Error;
use crate::memory;
use crate::progress::{self, Progress};

/// Triangles treated between two calls of the progress callback.
const INTERVAL: usize = 64;

/// A tail triangle that waits.
#[derive(PartialEq)]
struct Waiting {
    excess: f64,
    slot: u32,
}

impl Eq for Waiting {}

impl Ord for Waiting {
    /// The worst first, among equals the first.
    fn cmp(&self, other: &Self) -> Ordering {
        self.excess.total_cmp(&other.excess).then(other.slot.cmp(&self.slot))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The triangles that wait, and what is known of those that were treated.
pub(super) struct Queue<'a> {
    limits: &'a Limits,
    options: &'a TailOptions<'a>,
    heap: BinaryHeap<Waiting>,
    /// How often each slot that was ever in the tail has been treated.
    attempts: BTreeMap<u32, u32>,
    /// Why the last attempt at a slot failed.
    pub reasons: BTreeMap<u32, Reason>,
    /// Greatest distance of a removed vertex from the triangles that took its place.
    pub lost_height: f64,
}

impl<'a> Queue<'a> {
    /// All tail triangles of the mesh wait.
    pub fn new(live: &Live<'_>, limits: &'a Limits, options: &'a TailOptions<'a>) -> Result<Self, Error> {
        let tails = detect::tails(live, limits, options.mask);
        let waiting = memory::gathered(tails.map(|(slot, excess)| Waiting { excess, slot }))?;
        // One by one: collecting would take memory for all of them at once.
        let mut attempts = BTreeMap::new();
        attempts.extend(waiting.iter().map(|w| (w.slot, 0)));
        Ok(Self { limits, options, heap: waiting.into(), attempts, reasons: BTreeMap::new(), lost_height: 0.0 })
    }

    /// How many wait.
    pub fn len(&self) -> usize {
        self.heap.len()
    }

    /// Slots that still hold a triangle of the tail, rising.
    pub fn left<'q>(&'q self, live: &'q Live) -> impl Iterator<Item = u32> + 'q {
        self.attempts.keys().copied().filter(|&slot| detect::excess(live, self.limits, slot).is_some_and(|x| x > 1.0))
    }

    /// Treats the worst until none waits any more or the bound on operations is reached. `tell` hears the share of the
    /// triangles in the tail at the start that have been dealt with.
    pub fn run(
        &mut self,
        live: &mut Live<'_>,
        surgeon: &mut Surgeon<'_>,
        report: &mut TailReport,
        tell: &mut Progress<'_>,
    ) -> Result<(), Error> {
        self.treat_all(live, surgeon, report, tell)?;
        self.explain(live, surgeon)
    }

    fn treat_all(
        &mut self,
        live: &mut Live<'_>,
        surgeon: &mut Surgeon<'_>,
        report: &mut TailReport,
        tell: &mut Progress<'_>,
    ) -> Result<(), Error> {
        let first = self.len().max(1) as f64;
        let mut treated = 0_usize;
        let mut operations = 0_usize;
        while self.options.operations.is_none_or(|bound| operations < bound) {
            let Some(slot) = self.next(live) else { break };
            if treated.is_multiple_of(INTERVAL) {
                progress::tell(tell, (treated as f64 / first).min(1.0))?;
            }
            treated += 1;
            match surgeon.treat(live, slot) {
                Ok(cure) => {
                    operations += 1;
                    self.carry_out(live, &cure, report)?;
                }
                Err(reason) => {
                    self.reasons.insert(slot, reason);
                }
            }
        }
        Ok(())
    }

    /// Finds the reasons of those whose attempts have all been of use and yet not enough.
    fn explain(&mut self, live: &Live<'_>, surgeon: &mut Surgeon<'_>) -> Result<(), Error> {
        let spent = |slot: &u32| self.attempts[slot] >= self.options.attempts && !self.reasons.contains_key(slot);
        let slots = memory::gathered(self.left(live).filter(spent))?;
        for slot in slots {
            if let Err(reason) = surgeon.treat(live, slot) {
                self.reasons.insert(slot, reason);
            }
        }
        Ok(())
    }

    /// The worst slot that is still as it was when it was put here and has attempts left.
    fn next(&mut self, live: &Live<'_>) -> Option<u32> {
        loop {
            let Waiting { excess, slot } = self.heap.pop()?;
            let tried = self.attempts.entry(slot).or_insert(0);
            if detect::excess(live, self.limits, slot) == Some(excess) && *tried < self.options.attempts {
                *tried += 1;
                return Some(slot);
            }
        }
    }

    /// Puts the change into the mesh, and the tail triangles near it back into the queue.
    fn carry_out(&mut self, live: &mut Live<'_>, cure: &Cure, report: &mut TailReport) -> Result<(), Error> {
        let near = commit(live, &cure.patch, &cure.shape);
        self.lost_height = self.lost_height.max(cure.lost_height);
        match cure.operation {
            Operation::Move | Operation::MoveAll => report.moved += 1,
            Operation::Flip(..) => report.flipped += 1,
            Operation::Collapse(..) => report.collapsed += 1,
            Operation::Remove(_) => report.removed += 1,
        }
        for slot in near {
            let asked = self.options.mask.get(live.origin(slot).triangle as usize).copied().unwrap_or(true);
            match detect::excess(live, self.limits, slot) {
                Some(excess) if excess > 1.0 && asked => {
                    self.attempts.entry(slot).or_insert(0);
                    let bytes = (self.heap.len() + 1) * size_of::<Waiting>();
                    self.heap.try_reserve(1).map_err(|_| Error::OutOfMemory { bytes })?;
                    self.heap.push(Waiting { excess, slot });
                }
                _ => {}
            }
        }
        Ok(())
    }
}
