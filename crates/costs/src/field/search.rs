//! The search behind a field.

use std::num::NonZeroUsize;

use mediant_grid::{Interrupt, Interrupted, PlacementKind, room_for};

use super::buckets::Buckets;
#[cfg(not(target_family = "wasm"))]
use super::threads;
use crate::{
    graph::CostGraph,
    scan::{OfCosts, Scanning, Visit, by_kind},
};

/// A state that no path reaches.
pub(crate) const NONE: u64 = u64::MAX;

/// The costs of all states, and, if asked for, the least number of the sources that are as near as any.
#[derive(Debug)]
pub(crate) struct Labels {
    pub(crate) costs: Vec<u64>,
    pub(crate) sources: Option<Vec<u32>>,
    /// The memory of the queue when the search was done, in bytes.
    pub(crate) queue_bytes: usize,
}

/// The states between two questions of an interrupt.
const PIECE: usize = 1 << 14;
pub(super) const STAGE: &str = "searching the field";

/// Dijkstra's algorithm from sources, each a state with its number, up to a cost.
pub(super) fn search(
    graph: &CostGraph,
    sources: &[(usize, u32)],
    (limit, with_sources): (u64, bool),
    threads: NonZeroUsize,
    interrupt: &Interrupt,
) -> Result<Labels, Interrupted> {
    fn run<const K: u32, const CENTER: bool>(
        graph: &CostGraph,
        search: Search<'_>,
    ) -> Result<Labels, Interrupted> {
        search
            .run(unreached(graph, search.interrupt)?, OfCosts::<K, CENTER>::new(graph.scanner(), graph.map()))
    }
    let across = graph.map().layout().tiles_across();
    let size = graph.size();
    let search = Search { sources, limit, with_sources, threads, across, size, interrupt };
    by_kind!(graph, [run](graph, search))
}

/// The question of a search.
#[derive(Clone, Copy)]
pub(crate) struct Search<'s> {
    /// States, each with its number.
    pub(crate) sources: &'s [(usize, u32)],
    /// The greatest cost.
    pub(crate) limit: u64,
    /// Whether it finds the nearest source of each state.
    pub(crate) with_sources: bool,
    pub(crate) threads: NonZeroUsize,
    /// The tiles in a row of the map.
    pub(crate) across: usize,
    /// The numbers of columns and rows of vertices.
    pub(crate) size: (u32, u32),
    pub(crate) interrupt: &'s Interrupt,
}

/// The progress of a search: the states that were scanned, of those that are not blocked. In buckets that are
/// wider than a move some are scanned twice.
pub(super) struct Progress<'s> {
    interrupt: &'s Interrupt,
    scanned: usize,
    total: usize,
    /// It is told next when so many are scanned.
    next: usize,
}

/// It is told at most so many times between the first and the last.
const TOLD: usize = 128;
/// Nor are fewer states scanned between two times.
const LEAST_TOLD: usize = 1 << 12;

impl<'s> Progress<'s> {
    /// Nothing is done yet: with the costs before a search.
    fn of(costs: &[u64], (width, height): (u32, u32), interrupt: &'s Interrupt) -> Self {
        let mut progress = Self { interrupt, scanned: 0, total: 0, next: 0 };
        if progress.is_heard() {
            // At corners the frame is open, too.
            let open = costs.iter().filter(|&&cost| cost == NONE).count();
            progress.total = open.min(width as usize * height as usize);
            progress.tell();
        }
        progress
    }

    /// Whether somebody listens. If not, nothing need be counted.
    pub(super) const fn is_heard(&self) -> bool {
        self.interrupt.is_heard()
    }

    /// So many states more were scanned.
    pub(super) fn adds(&mut self, scanned: usize) {
        self.scanned += scanned;
        if self.scanned >= self.next {
            self.tell();
        }
    }

    #[cold]
    #[inline(never)]
    fn tell(&mut self) {
        self.next = self.scanned + (self.total / TOLD).max(LEAST_TOLD);
        self.interrupt.tell(self.scanned.min(self.total), self.total);
    }

    /// No more are scanned.
    pub(super) fn ends(mut self) {
        if self.is_heard() {
            self.tell();
        }
    }
}

/// The costs before a search. At centers a blocked cell has cost 0, which no path beats.
fn unreached(graph: &CostGraph, interrupt: &Interrupt) -> Result<Vec<u64>, Interrupted> {
    let states = graph.states();
    let weights = graph.map().weights();
    room_for::<u64>(states, "filling memory")?;
    let mut costs = Vec::with_capacity(states);
    for piece in weights.chunks(1 << 18) {
        interrupt.check("filling memory")?;
        match graph.rules().placement() {
            PlacementKind::Center => {
                costs.extend(piece.iter().map(|&weight| if weight > 0 { NONE } else { 0 }));
            }
            PlacementKind::Corner => costs.resize(costs.len() + piece.len(), NONE),
        }
    }
    costs.resize(states, NONE);
    Ok(costs)
}

impl Search<'_> {
    /// Lowers the costs of all states to those of the cheapest paths.
    pub(crate) fn run(self, costs: Vec<u64>, moves: impl Scanning) -> Result<Labels, Interrupted> {
        let Self { limit, with_sources, interrupt, .. } = self;
        room_for::<u32>(if with_sources { costs.len() } else { 0 }, "filling memory")?;
        let sources = with_sources.then(|| vec![u32::MAX; costs.len()]);
        let progress = Progress::of(&costs, self.size, interrupt);
        let mut labels = Labels { costs, sources, queue_bytes: 0 };
        labels.queue_bytes = self.run_together(&mut labels, moves, progress)?;
        if limit != NONE {
            for piece in labels.costs.chunks_mut(1 << 18) {
                interrupt.check("filling memory")?;
                piece.iter_mut().filter(|cost| **cost > limit).for_each(|cost| *cost = NONE);
            }
        }
        Ok(labels)
    }

    /// Returns the memory of the queues, in bytes.
    #[cfg(not(target_family = "wasm"))]
    fn run_together(
        self,
        labels: &mut Labels,
        moves: impl Scanning,
        progress: Progress<'_>,
    ) -> Result<usize, Interrupted> {
        if self.threads.get() > 1 && !self.with_sources {
            return threads::run(moves, &mut labels.costs, progress, self);
        }
        self.run_alone(labels, moves, progress)
    }

    /// WebAssembly has no threads, and loads what it does not need.
    #[cfg(target_family = "wasm")]
    fn run_together(
        self,
        labels: &mut Labels,
        moves: impl Scanning,
        progress: Progress<'_>,
    ) -> Result<usize, Interrupted> {
        debug_assert!(self.threads.get() > 0 && self.across > 0);
        self.run_alone(labels, moves, progress)
    }

    /// Returns the memory of the queue, in bytes.
    fn run_alone(
        self,
        labels: &mut Labels,
        moves: impl Scanning,
        progress: Progress<'_>,
    ) -> Result<usize, Interrupted> {
        let (least, greatest) = moves.bounds();
        let mut queue = Buckets::new(least, greatest);
        let costs = Costs { costs: &mut labels.costs, queue: &mut queue };
        match &mut labels.sources {
            None => self.label(moves, costs, progress)?,
            Some(numbers) => self.label(moves, Numbered { costs, numbers, from: 0 }, progress)?,
        }
        Ok(queue.memory_bytes())
    }

    fn label(
        self,
        moves: impl Scanning,
        mut label: impl Label,
        mut progress: Progress<'_>,
    ) -> Result<(), Interrupted> {
        for &(state, number) in self.sources {
            label.starts(state, number);
        }
        let mut states = Vec::new();
        while label.queue().take(&mut states) {
            let queue = label.queue();
            if queue.start_of(queue.current()) > self.limit {
                break;
            }
            for piece in states.chunks(PIECE) {
                self.interrupt.check(STAGE)?;
                let current = label.queue().current();
                for &state in piece {
                    let state = state as usize;
                    let cost = label.cost(state);
                    // It was queued by a longer path, and is done.
                    if label.queue().of(cost) == current {
                        label.scans(state);
                        moves.scan((state, cost), &mut label);
                    }
                }
                if progress.is_heard() {
                    // Others were done in an earlier bucket.
                    let least = label.queue().start_of(current);
                    progress.adds(count_from(least, piece, label.costs()));
                }
            }
            states.clear();
        }
        progress.ends();
        Ok(())
    }
}

/// The number of these states that cost so much or more. It is no part of the loop that scans them, whose
/// registers are all taken. It is handed slices alone, so that labels stay in registers.
#[inline(never)]
fn count_from(least: u64, states: &[u32], costs: &[u64]) -> usize {
    states.iter().filter(|&&state| costs[state as usize] >= least).count()
}

/// The labels that a search writes.
trait Label: Visit {
    fn queue(&mut self) -> &mut Buckets;

    /// The costs of all states.
    fn costs(&self) -> &[u64];

    #[inline]
    fn cost(&self, state: usize) -> u64 {
        self.costs()[state]
    }

    /// The state is scanned next.
    fn scans(&mut self, _state: usize) {}

    /// The state is a source.
    fn starts(&mut self, state: usize, number: u32);
}

/// Costs alone.
struct Costs<'s> {
    costs: &'s mut [u64],
    queue: &'s mut Buckets,
}

impl Visit for Costs<'_> {
    #[inline]
    fn known(&self, to: usize) -> u64 {
        self.costs[to]
    }

    #[inline]
    fn relax(&mut self, _: usize, to: usize, cost: u64) {
        let before = std::mem::replace(&mut self.costs[to], cost);
        self.queue.push(to, cost, before);
    }
}

impl Label for Costs<'_> {
    #[inline]
    fn queue(&mut self) -> &mut Buckets {
        self.queue
    }

    #[inline]
    fn costs(&self) -> &[u64] {
        self.costs
    }

    fn starts(&mut self, state: usize, _: u32) {
        if self.costs[state] > 0 {
            self.relax(0, state, 0);
        }
    }
}

/// Costs with the numbers of sources.
struct Numbered<'s> {
    costs: Costs<'s>,
    numbers: &'s mut [u32],
    /// The number at the state that is scanned.
    from: u32,
}

impl Visit for Numbered<'_> {
    /// A path that costs as much as the best one known counts as better if its source has a lesser number.
    #[inline]
    fn known(&self, to: usize) -> u64 {
        let known = self.costs.costs[to];
        // Blocked cells and sources have cost 0, which stays.
        if known > 0 && known < NONE && self.from < self.numbers[to] { known + 1 } else { known }
    }

    #[inline]
    fn relax(&mut self, by: usize, to: usize, cost: u64) {
        self.numbers[to] = self.from;
        self.costs.relax(by, to, cost);
    }
}

impl Label for Numbered<'_> {
    #[inline]
    fn queue(&mut self) -> &mut Buckets {
        self.costs.queue
    }

    #[inline]
    fn costs(&self) -> &[u64] {
        self.costs.costs
    }

    #[inline]
    fn scans(&mut self, state: usize) {
        self.from = self.numbers[state];
    }

    fn starts(&mut self, state: usize, number: u32) {
        // The first of several numbers at one place is the least.
        if self.costs.costs[state] > 0 {
            self.from = number;
            self.relax(0, state, 0);
        }
    }
}
