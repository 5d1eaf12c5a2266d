//! Watching the search for one piece of a path.

use mediant_moves::Cost;
use mediant_search::{NodeEvent, Observer};

/// The observer of the search for one piece of a path, which may be paused. It is not told what that search
/// reaches: a path to it from the start is known only as long as the piece is searched.
#[derive(Debug)]
pub(crate) struct OfLeg<'o, O> {
    pub(crate) observer: &'o mut O,
    /// The cost of the path up to the piece.
    pub(crate) before: Cost,
}

impl<O: Observer> Observer for OfLeg<'_, O> {
    fn expanded(&mut self, node: NodeEvent) {
        self.observer.expanded(node);
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

    fn pauses(&mut self, _: Cost) -> bool {
        // Whether this piece becomes part of the path, is not known yet.
        self.observer.pauses(self.before)
    }
}
