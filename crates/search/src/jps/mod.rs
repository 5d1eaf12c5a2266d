//! Jump point search (Harabor & Grastien 2011, 2014; Hammoud & Lupin 2023), for every k: canonical A*(k) whose runs are scanned rather
//! than queued.
//!
//! What a node leads to, and which vertices have turns, is [`canonical`](crate::canonical)'s rule, and so is the proof. Only vertices with a
//! turn and the goal become nodes, and, unless they are pruned, vertices of a slanted run from which a straight one finds such. At all
//! others a path has one natural way on, or three on a slanted run, and they are followed at once. At k = 3 under `Never` these are just the
//! jump points of the original; nothing is special about k = 3 or about any rule of motion.
//!
//! How runs are followed is the [`JumpFinder`]'s to say:
//!
//! | engine | straight runs | slanted runs | k |
//! |---|---|---|---|
//! | [`Jps`] | vertex by vertex; far from obstacles several at once | vertex by vertex | all |
//! | [`BlockJps`] | 64 vertices a word operation (module `planes`) | vertex by vertex, two such scans each | 2, 3 |
//! | [`JpsPlus`] | looked up ([`JumpTable`]) | looked up | 2, 3 |
//!
//! **Intermediate jump points** (Harabor & Grastien 2014) are pruned by default: where a straight run beside a slanted one finds something, that
//! becomes the successor, and the vertex between becomes no node; the path is put together again from its two legs.
//!
//! **Bounded jumps** (Sturtevant & Rabin 2016): a run of more steps than the jump limit ends in a node that goes on. From k = 9 on, where
//! turns are not tabulated, every run ends so after one step.
//!
//! # What made it fast
//!
//! Against Warthog's programs on the eighteen maps of `benchdata/reference_timings.json`, through both baselines: block-based JPS takes 0.81 of JPS2's
//! time (worst map 0.96), JPS+ 0.61 of that of JPS+ (worst 0.83).
//! - Straight runs from combined planes, one row a scan instead of three: 3 to 4 ns instead of 5 to 6.
//! - One bit a step of a slanted run says whether a straight run beside it comes to anything (module `slants`): arena2 from 16.6 to 10.8 µs
//!   a query, AR0011SR from 9.4 to 5.0.
//! - Whether the goal lies beside a slanted run is computed once a run, not once a step.
//! - A table of one byte a vertex and move, so that a vertex's entries are one word.
//!
//! For k ≥ 4 there is no such table, but a vertex is asked for turns only once (module `canonical::settled`), and far from corners a run takes
//! several steps at once. Against A*: 9 times as fast at k = 4 and 7 times at k = 5 on ArcticStation; 2.6 at k = 5 on brc202d; no
//! gain on dense noise, where every vertex has turns. From k = 6 on canonical A* is faster: more runs are scanned than nodes are saved.
//! A jump limit changes times by some percent either way: 32 gave 0.92 to 1.03 at k = 3 and 5 (arena2,
//! AR0011SR), 4 took 1.3 to 1.7 times as long.

mod axial;
mod diagonals;
mod finder;
mod table;

#[cfg(test)]
mod tests;

use std::{ops::Deref, sync::Arc};

use mediant_grid::{GridGraph, Placement, Vertex, VertexId};
use mediant_moves::KError;

use crate::{
    BestFirst, ExpandedNode, Heuristic, Pruning, Successor, Successors,
    canonical::{prunes, rank},
};
pub use finder::{BlockFinder, JumpContext, JumpFinder, StepwiseFinder};
pub use table::{JumpTable, JumpTableError};

/// A planner of the jump point family: 24 bytes a vertex.
pub type JumpPointSearch<L, H, P, J> = BestFirst<L, H, JumpMoves<P, J>, VertexId>;

/// Jump point search for every k, vertex by vertex.
pub type Jps<L, H, P> = JumpPointSearch<L, H, P, StepwiseFinder>;

/// Block-based jump point search (Harabor & Grastien 2014).
pub type BlockJps<L, H, P> = JumpPointSearch<L, H, P, BlockFinder>;

/// JPS+ (Harabor & Grastien 2014): jump point search on a table.
pub type JpsPlus<L, H, P> = JumpPointSearch<L, H, P, Arc<JumpTable>>;

/// The jump points that a node leads to.
#[derive(Clone, Debug)]
pub struct JumpMoves<P: Placement, J> {
    pruning: Arc<Pruning<P>>,
    finder: J,
    /// Whether the finder is one of another grid graph.
    stepwise: bool,
    limit: u32,
    keeps_intermediate: bool,
}

impl<P: Placement, L: Deref<Target = GridGraph<P>>, H: Heuristic, J: JumpFinder<P>>
    JumpPointSearch<L, H, P, J>
{
    /// A planner with a finder that was made for this grid graph, and a pruning rule that it may share with other planners. Where either was
    /// made for another map, k or rule of motion, it is not used, and runs are walked. (Of a [`JumpTable`] only the size is held against
    /// the grid graph.)
    #[must_use]
    pub fn with_finder(graph: L, pruning: Arc<Pruning<P>>, finder: J, heuristic: H) -> Self {
        let (pruning, stepwise) = (pruning.matching(&graph), !finder.fits(&graph));
        let successors = JumpMoves { pruning, finder, stepwise, limit: u32::MAX, keeps_intermediate: false };
        Self::with(graph, heuristic, successors)
    }

    /// The same planner with runs of at most `limit` steps, at least 1; `None` for no limit. (Runs of a [`JumpTable`] are not limited.)
    #[must_use]
    pub fn with_jump_limit(mut self, limit: Option<u32>) -> Self {
        self.successors.limit = limit.unwrap_or(u32::MAX).max(1);
        self
    }

    /// The same planner, with or without nodes for intermediate jump points. By default they are pruned.
    #[must_use]
    pub fn with_intermediate(mut self, keep: bool) -> Self {
        self.successors.keeps_intermediate = keep;
        self
    }
}

impl<P: Placement, L: Deref<Target = GridGraph<P>>, H: Heuristic> Jps<L, H, P> {
    /// A planner with scratch memory for `graph`, and its own [`Pruning`].
    #[must_use]
    pub fn new(graph: L, heuristic: H) -> Self {
        let pruning = Arc::new(Pruning::new(&*graph));
        Self::with_finder(graph, pruning, StepwiseFinder, heuristic)
    }
}

impl<P: Placement, L: Deref<Target = GridGraph<P>>, H: Heuristic> BlockJps<L, H, P> {
    /// A planner with scratch memory for `graph`, and a byte a vertex for its own scans.
    ///
    /// # Errors
    /// [`KError::TooLarge`] above k = 3.
    pub fn new(graph: L, heuristic: H) -> Result<Self, KError> {
        let pruning = Arc::new(Pruning::new(&*graph));
        let blocks = BlockFinder::new(&*graph, &pruning)?;
        Ok(Self::with_finder(graph, pruning, blocks, heuristic))
    }
}

impl<P: Placement, L: Deref<Target = GridGraph<P>>, H: Heuristic> JpsPlus<L, H, P> {
    /// A planner with scratch memory for `graph`, on its table.
    ///
    /// # Errors
    /// [`JumpTableError`] for a table of a grid graph of another size or k.
    pub fn new(graph: L, table: Arc<JumpTable>, heuristic: H) -> Result<Self, JumpTableError> {
        table.check(&*graph)?;
        let pruning = Arc::new(Pruning::new(&*graph));
        Ok(Self::with_finder(graph, pruning, table, heuristic))
    }
}

impl<P: Placement, J: JumpFinder<P>> Successors<P> for JumpMoves<P, J> {
    type ParentPointer = VertexId;

    #[inline]
    fn for_each(
        &self,
        graph: &GridGraph<P>,
        node: ExpandedNode,
        goal: Vertex,
        mut visit: impl FnMut(Successor),
    ) -> u32 {
        let context = JumpContext {
            graph,
            pruning: &self.pruning,
            goal,
            // Once a node: a run never goes on from a gap, so only the node itself and the goal may be one.
            stepwise: self.stepwise
                || !prunes(graph)
                || graph.has_closed_gaps() && (graph.is_closed_gap(goal) || graph.is_closed_gap(node.at)),
            // Without knowing the turns, a scan would end almost everywhere, and find little that is new.
            limit: if self.pruning.knows_forced() { self.limit } else { 1 },
            keeps_intermediate: self.keeps_intermediate,
        };
        let mut scanned = 0;
        let mut follow = |index: usize| {
            if index & 1 == 1 {
                self.finder.diagonal(&context, &node, index, &mut scanned, &mut visit);
                return;
            }
            let step = graph.step(index);
            let goal_steps = context.steps_to_goal(node.at, step.vector());
            if let Some(n) = self.finder.axial(&context, &node, index, goal_steps, &mut scanned) {
                visit(context.after(&node, step, index, n).reached(step.cost * n, index));
            }
        };
        match node.by.filter(|&by| !self.pruning.is_exempt(graph, node.at, by, goal)) {
            None => graph.for_each_successor(node.at, node.by, goal, follow),
            Some(by) => self.pruning.for_each(graph, &node, by, &mut follow),
        }
        scanned
    }

    #[inline]
    fn prefers(&self, graph: &GridGraph<P>, new: usize, known: usize) -> bool {
        prunes(graph) && rank(new) < rank(known)
    }
}
