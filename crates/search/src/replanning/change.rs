//! The values of nodes after a change of the map.

use std::ops::Deref;

use mediant_grid::{Change, GridGraph, Identity, Placement, Rectangle, Vector, Vertex, VertexId};
use mediant_moves::Cost;

use super::{
    costs::MoveCosts,
    nodes::Node,
    reach::Reach,
    search::{Replanner, State, opposite},
};
use crate::gap_nodes::{ends_at, node_at, upper};

/// So many cells are always followed one by one.
const FEW_CELLS: usize = 128;

impl<P, G, C> Replanner<G, C>
where
    P: Placement,
    G: Deref<Target = GridGraph<P>>,
    C: MoveCosts<P>,
{
    /// Continues with the grid graph after a change of the map, at the same costs.
    pub(super) fn change(&mut self, graph: G, change: &Change)
    where
        C: Clone,
    {
        let (before, after) = (change.before().id(), change.after().id());
        let follows = self.graph.identity().map == Some(before) && graph.identity().map == Some(after);
        let costs = self.costs.clone();
        if follows {
            self.change_costs(graph, costs, change.cells());
        } else {
            self.set_graph(graph, costs);
        }
    }

    /// Continues with another grid graph and other costs, which are the same outside of some cells.
    pub(super) fn change_costs(&mut self, graph: G, costs: C, cells: &[Rectangle]) {
        let is_same_but_for_the_map = graph.identity()
            == Identity { map: graph.identity().map, ..self.graph.identity() }
            && graph.vertex_count() == self.graph.vertex_count();
        if self.state.root.is_none() || !is_same_but_for_the_map {
            return self.set_graph(graph, costs);
        }
        let most = FEW_CELLS.max(self.state.nodes.known() / self.nodes_a_cell);
        let changed: Vec<_> = changed_cells::<P, C>(&self.graph, &graph, cells).take(most + 1).collect();
        if changed.len() > most {
            return self.set_graph(graph, costs);
        }
        let reach = self.reach.get_or_insert_with(|| Reach::new(&*graph));
        let moves = [(&*self.graph, &self.costs), (&*graph, &costs)];
        let moves = moves.map(|(graph, costs)| Moves { graph, costs });
        if C::ARE_FIXED {
            self.state.change_gaps(&moves, &changed);
            let (freed, blocked): (Vec<_>, Vec<_>) =
                changed.iter().partition(|at| graph.grid().is_free(at.x, at.y));
            for &cell in &freed {
                self.state.lower_across(&moves[1], cell, reach);
            }
            for id in around(&blocked, reach, &graph) {
                self.state.mark_if_illegal(&graph, id);
            }
        } else {
            for id in around(&changed, reach, &graph) {
                self.state.change_moves(&moves, id);
            }
        }
        self.state.stale.sort_unstable();
        self.state.stale.dedup();
        self.state.renew(&graph, &costs, &mut ());
        (self.graph, self.costs) = (graph, costs);
    }
}

/// The cells in these rectangles that differ: where moves may cost something else, all of them.
fn changed_cells<P: Placement, C: MoveCosts<P>>(
    before: &GridGraph<P>,
    after: &GridGraph<P>,
    cells: &[Rectangle],
) -> impl Iterator<Item = Vertex> {
    let (before, after) = (before.grid(), after.grid());
    let all = cells.iter().flat_map(|&Rectangle { x, y, width, height }| {
        let [columns, rows] = [(x, width, after.width()), (y, height, after.height())]
            .map(|(first, length, end)| first.min(end) as i32..first.saturating_add(length).min(end) as i32);
        rows.flat_map(move |y| columns.clone().map(move |x| Vertex::new(x, y)))
    });
    all.filter(|at| !C::ARE_FIXED || before.is_blocked(at.x, at.y) != after.is_blocked(at.x, at.y))
}

/// The vertices of which a move may sweep one of these cells, in order.
fn around<P: Placement>(cells: &[Vertex], reach: &Reach, graph: &GridGraph<P>) -> Vec<VertexId> {
    let around = |&cell| reach.vertices.iter().filter_map(move |&offset| graph.id(cell + offset));
    let mut vertices: Vec<VertexId> = cells.iter().flat_map(around).collect();
    if cells.len() > 1 {
        vertices.sort_unstable();
        vertices.dedup();
    }
    vertices
}

/// The moves on the map before a change, or after it.
struct Moves<'m, P: Placement, C> {
    graph: &'m GridGraph<P>,
    costs: &'m C,
}

/// A legal move between two nodes, each with its vertex.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Joint {
    ends: [(VertexId, Vertex); 2],
    /// The move from the first to the second one, and the move back.
    moves: [usize; 2],
    cost: Cost,
}

impl<P: Placement, C: MoveCosts<P>> Moves<'_, P, C> {
    /// A legal move.
    fn joint(&self, id: VertexId, at: Vertex, index: usize) -> Option<Joint> {
        let (graph, step) = (self.graph, self.graph.step(index));
        let (to, to_at) = (step.target(id), at + step.vector());
        let ends = [(node_at(graph, (id, at), to_at), at), (node_at(graph, (to, to_at), at), to_at)];
        Some(Joint { ends, moves: [index, opposite(graph, index)], cost: self.costs.cost(graph, at, index)? })
    }
}

impl State {
    /// Where a gap comes or goes beside changed cells, the moves of the vertex join other nodes.
    fn change_gaps<P: Placement, C: MoveCosts<P>>(&mut self, moves: &[Moves<'_, P, C>; 2], cells: &[Vertex]) {
        let [before, after] = [moves[0].graph, moves[1].graph];
        if !before.has_closed_gaps() && !after.has_closed_gaps() {
            return;
        }
        let corners = [(0, 0), (1, 0), (0, 1), (1, 1)].map(Vector::from);
        for at in cells.iter().flat_map(|&cell| corners.map(|corner| cell + corner)) {
            let quadrants = |graph: &GridGraph<P>| graph.is_closed_gap(at).then(|| ends_at(graph, at));
            if quadrants(before) != quadrants(after)
                && let Some(id) = after.id(at)
            {
                self.change_moves(moves, id);
            }
        }
    }

    /// Changes the rhs of a vertex and its neighbors as far as its moves differ; or marks them, where a way
    /// is no more by which they had it.
    ///
    /// No g changes here. So the order of the moves does not matter: a node that is not marked has an rhs by
    /// a move that is legal after the change.
    fn change_moves<P: Placement, C: MoveCosts<P>>(
        &mut self,
        [before, after]: &[Moves<'_, P, C>; 2],
        id: VertexId,
    ) {
        // A move between two vertices without a g changes nothing, and where one has it all neighbors are
        // known.
        let may_be_known = P::closes_gaps(after.graph.rule()) || self.nodes.is_known(id);
        let at = after.graph.vertex(id);
        let legal = [before.graph, after.graph].map(|graph| graph.legal_moves(at));
        for index in (0..before.graph.steps().len()).filter(|_| may_be_known) {
            let joint = |side: usize, moves: &Moves<'_, P, C>| {
                if legal[side].contains(index) { moves.joint(id, at, index) } else { None }
            };
            let (old, new) = (joint(0, before), joint(1, after));
            if old == new {
                continue;
            }
            if let Some(Joint { ends: [(one, _), (other, _)], moves: [to, back], .. }) = old {
                self.mark_if_by(other, to);
                self.mark_if_by(one, back);
            }
            if let Some(new) = new {
                self.lower_by(after.graph, new);
            }
        }
    }

    /// Lowers the rhs of both ends of a move that is legal after the change, as far as the other end's g says
    /// so.
    fn lower_by<P: Placement>(&mut self, graph: &GridGraph<P>, joint: Joint) {
        let Joint { ends: [one, other], moves: [to, back], cost } = joint;
        for (from, end, by) in [(one.0, other, to), (other.0, one, back)] {
            if let Some(g) = self.nodes.get(from).settled() {
                self.lower(graph, end, (g + cost, by), &mut ());
            }
        }
    }

    /// Lowers rhs by the moves that sweep a freed cell. Few of them would, and only of these is it asked
    /// whether they are legal; if they were before, nothing changes.
    fn lower_across<P: Placement, C: MoveCosts<P>>(
        &mut self,
        moves: &Moves<'_, P, C>,
        cell: Vertex,
        reach: &Reach,
    ) {
        let graph = moves.graph;
        for sweep in &reach.moves {
            let (at, index) = (cell + sweep.offset(), sweep.index());
            let to = at + graph.step(index).vector();
            let Some(id) = graph.id(at).filter(|_| graph.id(to).is_some()) else { continue };
            let Some(joint) = moves.joint(id, at, index) else { continue };
            let [one, other] = joint.ends.map(|(id, _)| self.nodes.get(id));
            let lowers = |from: Node, to: Node| from.settled().is_some_and(|g| g + joint.cost < to.rhs);
            if (lowers(one, other) || lowers(other, one)) && graph.sees(at, to) {
                self.lower_by(graph, joint);
            }
        }
    }

    /// Marks the nodes of a vertex whose rhs comes by a move that is legal no more: where cells were blocked,
    /// no other move matters.
    fn mark_if_illegal<P: Placement>(&mut self, graph: &GridGraph<P>, id: VertexId) {
        let at = graph.vertex(id);
        let upper = P::closes_gaps(graph.rule()).then(|| upper(graph, id));
        for node in [Some(id), upper].into_iter().flatten() {
            let Node { rhs, by, .. } = self.nodes.get(node);
            let has_move = rhs != Cost::MAX && self.root != Some(node);
            if has_move && !graph.sees(at, at + -graph.step(by).vector()) {
                self.stale.push(node);
            }
        }
    }
}
