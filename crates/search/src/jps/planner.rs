//! Jump point search: the planner.

use std::{ops::Deref, sync::Arc};

use mediant_grid::{GridGraph, Mismatch, Placement, Vertex};
use mediant_moves::KError;

use super::{
    block_finder::BlockFinder,
    dead_ends::NearGoal,
    error::JumpError,
    finder::{JumpContext, JumpFinder, JumpRules, StepwiseFinder, in_order},
    table::JumpTable,
    to_goal::ToGoal,
};
use crate::{
    best_first::BestFirst,
    canonical::{Pruning, pattern_at, prunes, rank},
    heuristic::Heuristic,
    parent::JumpParent,
    successors::{ExpandedNode, KnownPath, LookUp, Successor, Successors},
};

/// Jump point search with any [`JumpFinder`]. Its scratch memory is 20 bytes for each vertex of a
/// block of eight to which searches come, and half a byte for each vertex of the map.
pub type JumpPointSearch<G, H, P, J> = BestFirst<G, H, JumpMoves<P, J>, JumpParent>;

/// Jump point search for every k, which scans jumps vertex by vertex.
pub type Jps<G, H, P> = JumpPointSearch<G, H, P, StepwiseFinder>;

/// Block-based jump point search (Harabor & Grastien 2014), for k = 2 and 3.
pub type BlockJps<G, H, P> = JumpPointSearch<G, H, P, BlockFinder>;

/// JPS+ (Harabor & Grastien 2014): jump point search by lists of where all jumps from each jump point lead,
/// precomputed, for k = 2 and 3.
pub type JpsPlus<G, H, P> = JumpPointSearch<G, H, P, Arc<JumpTable>>;

/// The jump points to which a node leads.
#[derive(Clone, Debug)]
pub struct JumpMoves<P: Placement, J> {
    pruning: Arc<Pruning<P>>,
    finder: J,
    /// The most steps of a jump.
    limit: u32,
    /// Whether intermediate jump points become nodes.
    keeps_intermediate: bool,
    /// The options of this search's jumps.
    rules: JumpRules,
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>, H: Heuristic, J: JumpFinder<P>>
    JumpPointSearch<G, H, P, J>
{
    /// A planner with a finder and a pruning rule, both of which may be shared with other planners.
    ///
    /// # Errors
    /// [`Mismatch`] for a rule or a finder that was made for another map, k or rule of motion.
    pub fn with_finder(
        graph: G,
        pruning: Arc<Pruning<P>>,
        finder: J,
        heuristic: H,
    ) -> Result<Self, Mismatch> {
        Self::check(&graph, &pruning, &finder)?;
        Ok(Self::with_parts(graph, pruning, finder, heuristic))
    }

    /// Checks that a pruning rule and a finder are those of a grid graph.
    fn check(graph: &GridGraph<P>, pruning: &Pruning<P>, finder: &J) -> Result<(), Mismatch> {
        pruning.check(graph)?;
        match finder.identity() {
            Some(identity) => identity.check("the jump finder", ("the grid graph", graph.identity())),
            None => Ok(()),
        }
    }

    /// Continues with another grid graph, by its pruning rule and finder. The search that was begun last is
    /// forgotten. The scratch memory is kept if the grid graph has as many vertices.
    ///
    /// # Errors
    /// As for [`with_finder`](Self::with_finder). Nothing is changed then.
    pub fn follow(&mut self, graph: G, pruning: Arc<Pruning<P>>, finder: J) -> Result<(), Mismatch> {
        Self::check(&graph, &pruning, &finder)?;
        (self.successors.pruning, self.successors.finder) = (pruning, finder);
        self.successors.rules = JumpRules::PLAIN;
        self.follow_graph(graph);
        Ok(())
    }

    /// A planner with a finder and a pruning rule that are those of the grid graph.
    fn with_parts(graph: G, pruning: Arc<Pruning<P>>, finder: J, heuristic: H) -> Self {
        let (limit, keeps_intermediate, rules) = (u32::MAX, false, JumpRules::PLAIN);
        let successors = JumpMoves { pruning, finder, limit, keeps_intermediate, rules };
        Self::with_successors(graph, heuristic, successors)
    }

    /// The same planner with jumps of at most `limit` steps, at least 1; `None` for no limit. (Axial
    /// jumps that are scanned by words or looked up are not limited.)
    #[must_use]
    pub fn with_jump_limit(mut self, limit: Option<u32>) -> Self {
        self.successors.limit = limit.unwrap_or(u32::MAX).max(1);
        self
    }

    /// The same planner with (`true`) or without nodes for intermediate jump points. By default they are
    /// pruned.
    #[must_use]
    pub fn with_intermediate(mut self, keep: bool) -> Self {
        self.successors.keeps_intermediate = keep;
        self
    }
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>, H: Heuristic> Jps<G, H, P> {
    /// A planner with scratch memory for `graph`, and its own [`Pruning`].
    #[must_use]
    pub fn new(graph: G, heuristic: H) -> Self {
        let pruning = Arc::new(Pruning::new(&*graph));
        Self::with_parts(graph, pruning, StepwiseFinder, heuristic)
    }
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>, H: Heuristic> BlockJps<G, H, P> {
    /// A planner with scratch memory for `graph`, and its own [`BlockFinder`].
    ///
    /// # Errors
    /// [`KError::TooLarge`] above k = 3.
    pub fn new(graph: G, heuristic: H) -> Result<Self, KError> {
        let pruning = Arc::new(Pruning::new(&*graph));
        let blocks = BlockFinder::prepare(&*graph, &pruning)?;
        Ok(Self::with_parts(graph, pruning, blocks, heuristic))
    }
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>, H: Heuristic> JpsPlus<G, H, P> {
    /// A planner with scratch memory for `graph`, on its table.
    ///
    /// # Errors
    /// [`JumpError::Mismatch`] for the table of a grid graph of another map, k or rule of motion.
    pub fn new(graph: G, table: Arc<JumpTable>, heuristic: H) -> Result<Self, JumpError> {
        JumpTable::identity(&table).check("the jump table", ("the grid graph", graph.identity()))?;
        let pruning = Arc::new(Pruning::new(&*graph));
        Ok(Self::with_parts(graph, pruning, table, heuristic))
    }
}

/// All jumps from a node, step by step. Returns the number of vertices scanned.
///
/// `visit` is called through a pointer, so that this is compiled once for a placement and not once for each
/// kind of planner: a page has less to load, and instructions a query change by 0.2 % at most.
#[inline(never)]
fn follow_stepwise<P: Placement>(
    context: &JumpContext<'_, P>,
    node: &ExpandedNode,
    mut visit: &mut dyn FnMut(Successor) -> KnownPath,
) -> u32 {
    let (graph, pruning, goal, finder) = (context.graph, context.pruning, context.goal, StepwiseFinder);
    let mut scanned = 0;
    let mut follow = |index: usize| {
        if index & 1 == 1 {
            finder.diagonal(context, node, index, &mut scanned, &mut visit);
            return;
        }
        let step = graph.step(index);
        let goal_steps = context.steps_to_goal(node.at, step.vector());
        if let Some(n) = finder.axial(context, node, index, goal_steps, &mut scanned) {
            visit(context.after(node, step, index, n).reached(step.cost * n, index));
        }
    };
    match node.by.filter(|&by| !pruning.is_exempt(graph, node.at, by, goal)) {
        None => graph.for_each_successor(node.at, node.by, goal, follow),
        Some(by) => pruning.for_each(graph, node, by, &mut follow),
    }
    scanned
}

/// All moves from a node, as a set, for k ≤ 3, where gaps are closed: the start and what is near a gap are
/// not pruned.
#[cold]
#[inline(never)]
fn all_moves<P: Placement>(graph: &GridGraph<P>, node: &ExpandedNode, goal: Vertex) -> u8 {
    let mut moves = 0;
    graph.for_each_successor(node.at, node.by, goal, |index| moves |= 1 << index);
    moves
}

impl<P: Placement, J: JumpFinder<P>> JumpMoves<P, J> {
    /// The context of the jumps from a vertex that is no closed gap.
    #[inline]
    fn context<'c>(&'c self, graph: &'c GridGraph<P>, at: Vertex, goal: Vertex) -> JumpContext<'c, P> {
        JumpContext {
            graph,
            pruning: &self.pruning,
            goal,
            rules: &self.rules,
            stepwise: self.rules.stepwise,
            to_goal: ToGoal::new(at.to(goal), graph.k()),
        }
    }

    /// Whether closed gaps do not alter by which moves a path goes on that arrives at a vertex by a move.
    #[cold]
    fn is_far_from_gaps(&self, graph: &GridGraph<P>, (at, by): (Vertex, usize), goal: Vertex) -> bool {
        !graph.is_closed_gap(at) && !self.pruning.is_exempt(graph, at, by, goal)
    }

    /// All jumps from a node, made. Returns the number of vertices scanned.
    #[inline]
    fn scan(
        &self,
        graph: &GridGraph<P>,
        node: &ExpandedNode,
        goal: Vertex,
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) -> u32 {
        let mut context = self.context(graph, node.at, goal);
        // Asked once for the whole node: a jump never goes on from a gap, so only the node itself and the
        // goal may be one.
        context.stepwise |= graph.has_closed_gaps() && graph.is_closed_gap(node.at);
        let Some(table) = self.pruning.table().filter(|_| !context.stepwise) else {
            return follow_stepwise(&context, node, visit);
        };
        let moves = match node.by.filter(|&by| !self.pruning.is_exempt(graph, node.at, by, goal)) {
            None if !graph.has_closed_gaps() => table.legal(pattern_at(graph, node.at)),
            None => all_moves(graph, node, goal),
            Some(by) => table.successors(by, pattern_at(graph, node.at)),
        };
        let mut scanned = 0;
        if moves >> context.to_goal.index & 1 == 1
            && let Some(goal) = self.finder.goal_in_sight(&context, node, &mut scanned)
        {
            visit(goal);
            return scanned;
        }
        Self::follow(&self.finder, &context, node, moves, visit) + scanned
    }

    /// [`scan`](Self::scan) where few nodes come to it: the loop of the search keeps its registers.
    #[inline(never)]
    fn scan_apart(
        &self,
        graph: &GridGraph<P>,
        node: ExpandedNode,
        goal: Vertex,
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) -> u32 {
        self.scan(graph, &node, goal, visit)
    }

    /// The jumps from a node by a set of moves, for k ≤ 3. Returns the number of vertices scanned.
    #[inline]
    fn follow(
        finder: &J,
        context: &JumpContext<'_, P>,
        node: &ExpandedNode,
        moves: u8,
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) -> u32 {
        let mut scanned = 0;
        let [mut even, mut odd] = in_order(moves);
        while even != 0 {
            let index = even.trailing_zeros() as usize;
            even &= even - 1;
            let step = context.graph.step(index);
            let goal_steps = context.to_goal.straight(index);
            if let Some(n) = finder.axial(context, node, index, goal_steps, &mut scanned) {
                visit(context.after(node, step, index, n).reached(step.cost * n, index));
            }
        }
        while odd != 0 {
            let index = odd.trailing_zeros() as usize;
            odd &= odd - 1;
            finder.diagonal(context, node, index, &mut scanned, visit);
        }
        scanned
    }
}

impl<P: Placement, J: JumpFinder<P>> Successors<P> for JumpMoves<P, J> {
    type ParentPointer = JumpParent;

    fn begin(&mut self, graph: &GridGraph<P>, goal: Vertex) {
        let keeps_intermediate = self.keeps_intermediate;
        // Where forced successors are unknown, a jump would end almost everywhere and find little.
        let limit = if self.pruning.knows_forced() { self.limit } else { 1 };
        let stepwise = !prunes(graph) || graph.has_closed_gaps() && graph.is_closed_gap(goal);
        let is_plain = limit == u32::MAX && !keeps_intermediate && !stepwise;
        self.rules = JumpRules {
            stepwise,
            looks_up: J::LOOKS_UP && is_plain && self.pruning.table().is_some(),
            limit,
            keeps_intermediate,
            has_other_nodes: keeps_intermediate || limit != u32::MAX || self.pruning.diagonals_may_force(),
            near: if keeps_intermediate { NearGoal::EVERYWHERE } else { self.finder.near_goal(goal) },
        };
    }

    #[inline]
    fn for_each(
        &self,
        graph: &GridGraph<P>,
        node: ExpandedNode,
        goal: Vertex,
        mut visit: impl FnMut(Successor) -> KnownPath,
    ) -> u32 {
        if J::LOOKS_UP {
            self.scan_apart(graph, node, goal, &mut visit)
        } else {
            self.scan(graph, &node, goal, &mut visit)
        }
    }

    #[inline]
    fn look_up(
        &self,
        graph: &GridGraph<P>,
        node: ExpandedNode,
        goal: Vertex,
        mut visit: impl FnMut(Successor) -> KnownPath,
    ) -> LookUp {
        match node.by.filter(|_| self.rules.looks_up) {
            Some(by) if !graph.has_closed_gaps() || self.is_far_from_gaps(graph, (node.at, by), goal) => {
                self.finder.known_successors((graph, &self.rules.near, goal), (&node, by), &mut visit)
            }
            _ => LookUp::Unknown,
        }
    }

    #[inline]
    fn prefers(&self, graph: &GridGraph<P>, new: usize, known: usize) -> bool {
        prunes(graph) && rank(new) < rank(known)
    }
}
