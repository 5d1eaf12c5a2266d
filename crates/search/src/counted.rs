//! The work of a search, which an interrupt can stop.

use mediant_grid::{Interrupt, Interrupted, Vertex};
use mediant_moves::Cost;

use crate::{
    observer::{Counters, NodeEvent, Observer},
    planner::{Planner, SearchStatus},
    query::Limits,
    query::{Ends, QueryError},
};

/// Answers a query and counts its work, as [`Planner::solve_observed`] does with [`Counters`]. An interrupt
/// is asked every [`Limits::EXPANSIONS_PER_LOOK`] expansions.
///
/// # Errors
/// [`Interrupted`]; within, those of [`Planner::solve`].
pub fn count_work(
    planner: &mut impl Planner,
    query: Ends,
    interrupt: &Interrupt,
) -> Result<Result<Counters, QueryError>, Interrupted> {
    let counters = Counters::default();
    let mut watch = Watch { counters, interrupt, next_look: 0, stopped: Ok(()) };
    let status = planner.begin(query, &mut watch);
    let status = match status {
        Ok(SearchStatus::Searching) => planner.proceed(&mut watch),
        status => status,
    };
    watch.stopped?;
    Ok(status.map(|_| watch.counters))
}

struct Watch<'i> {
    counters: Counters,
    interrupt: &'i Interrupt,
    next_look: u64,
    stopped: Result<(), Interrupted>,
}

impl Observer for Watch<'_> {
    fn pauses(&mut self, _: Cost) -> bool {
        if self.counters.expanded >= self.next_look {
            self.next_look = self.counters.expanded + Limits::EXPANSIONS_PER_LOOK;
            self.stopped = self.interrupt.check("comparing engines");
        }
        self.stopped.is_err()
    }

    fn expanded(&mut self, node: NodeEvent) {
        self.counters.expanded(node);
    }

    fn reached(&mut self, at: Vertex, g: Cost) {
        self.counters.reached(at, g);
    }

    fn generated(&mut self, node: NodeEvent) {
        self.counters.generated(node);
    }

    fn updated(&mut self, node: NodeEvent) {
        self.counters.updated(node);
    }

    fn percolated(&mut self, swaps: u32) {
        self.counters.percolated(swaps);
    }

    fn scanned(&mut self, vertices: u32) {
        self.counters.scanned(vertices);
    }

    fn fell_back(&mut self) {
        self.counters.fell_back();
    }
}
