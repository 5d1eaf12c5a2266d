//! The observer of a search for a query, which enforces its limits.

use mediant_grid::{Point, Vertex};
use mediant_moves::Cost;

use super::limits::{Limit, Limits};
use crate::{
    limit::at_most,
    metric::Metric,
    observer::{NodeEvent, Observer},
};

/// Why a search paused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pause {
    /// The step is over.
    Step,
    /// A limit is met.
    Limit(Limit),
    /// Another path is known that is at least as short.
    Beaten,
}

/// The progress of a query through the searches of its pairs.
#[derive(Debug)]
pub(super) struct Progress {
    pub(super) limits: Limits,
    /// All expansions, of all pairs.
    pub(super) expansions: u64,
    /// After how many of them the deadline is looked at. Some planners make several expansions between two
    /// pauses.
    pub(super) next_look: u64,
    /// The number of pairs whose search was begun.
    pub(super) pairs: u64,
    /// How many expansions there are when the step is over.
    pub(super) step_end: u64,
    /// Whether the observer may pause the search, too.
    pub(super) is_step: bool,
    /// The greatest cost that the query allows.
    pub(super) greatest: Cost,
    /// The cost of the best path that is known.
    pub(super) known: Cost,
    /// The least f of the open nodes when the search paused.
    pub(super) least: Cost,
    pub(super) pause: Option<Pause>,
    pub(super) goal: Point,
    /// The vertex nearest to the goal among those that were reached, and its distance; before any was reached
    /// the start.
    pub(super) nearest: (Cost, Point),
}

/// An observer that counts, pauses at limits, and knows what is nearest to the goal.
pub(super) struct Watch<'w, O> {
    pub(super) progress: &'w mut Progress,
    pub(super) metric: Metric,
    pub(super) observer: &'w mut O,
}

impl Progress {
    /// Whether all paths that cost at least `least` are longer than the best path that is known. Equally long
    /// paths at any angle may differ in their costs, which are sums of rounded lengths.
    pub(super) const fn is_beaten(&self, least: Cost) -> bool {
        least.to_bits() > at_most(self.known).to_bits()
    }

    /// Begins with another pair. A planner may answer many of them without an expansion.
    pub(super) const fn begin_pair(&mut self) {
        self.pairs += 1;
        if self.pairs.is_multiple_of(Limits::PAIRS_PER_LOOK) {
            self.next_look = self.expansions;
        }
    }

    /// The reason to pause now, if there is one.
    pub(super) fn reason(&mut self) -> Option<Pause> {
        let Self { expansions, .. } = *self;
        if self.least > self.greatest {
            return Some(Pause::Limit(Limit::Cost));
        }
        if self.is_beaten(self.least) {
            return Some(Pause::Beaten);
        }
        let looks = expansions >= self.next_look;
        if looks {
            self.next_look = expansions + Limits::EXPANSIONS_PER_LOOK;
        }
        if let Some(limit) = self.limits.met(expansions, looks) {
            return Some(Pause::Limit(limit));
        }
        (expansions >= self.step_end).then_some(Pause::Step)
    }
}

impl<O: Observer> Observer for Watch<'_, O> {
    fn expanded(&mut self, node: NodeEvent) {
        self.progress.expansions += 1;
        self.observer.expanded(node);
    }

    fn reached(&mut self, at: Vertex, g: Cost) {
        let distance = self.metric.between(at.into(), self.progress.goal);
        if distance < self.progress.nearest.0 && g <= self.progress.greatest {
            self.progress.nearest = (distance, at.into());
        }
        self.observer.reached(at, g);
    }

    fn pauses(&mut self, least: Cost) -> bool {
        self.progress.least = least;
        self.progress.pause = self.progress.reason();
        self.progress.pause.is_some() || self.progress.is_step && self.observer.pauses(least)
    }

    fn generated(&mut self, node: NodeEvent) {
        self.observer.generated(node);
    }

    fn updated(&mut self, node: NodeEvent) {
        self.observer.updated(node);
    }

    fn percolated(&mut self, swaps: u32) {
        self.observer.percolated(swaps);
    }

    fn scanned(&mut self, vertices: u32) {
        self.observer.scanned(vertices);
    }

    fn counts_swaps(&self) -> bool {
        self.observer.counts_swaps()
    }

    fn fell_back(&mut self) {
        self.observer.fell_back();
    }
}
