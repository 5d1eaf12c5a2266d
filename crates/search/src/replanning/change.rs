//! What a change of the map does to the values of nodes.

use std::ops::Deref;

use mediant_grid::{Change, GridGraph, Identity, Placement, Rectangle, Vertex, VertexId};
use mediant_moves::Cost;

use super::{
    costs::MoveCosts,
    reach::reach,
    search::{Replanner, State},
};
use crate::gap_nodes::{ends_at, node_at, upper};

/// So many cells are always followed one by one.
const FEW_CELLS: usize = 8;
/// Of more cells, one for so many known nodes at most: beyond that all is searched anew, which takes less
/// (`docs/measurements/replanning.md`).
const NODES_A_CELL: usize = 16;

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
        let most = FEW_CELLS.max(self.state.nodes.known() / NODES_A_CELL);
        let changed: Vec<_> = changed_cells::<P, C>(&self.graph, &graph, cells).take(most + 1).collect();
        if changed.len() > most {
            return self.set_graph(graph, costs);
        }
        let reach = self.reach.get_or_insert_with(|| reach(&graph));
        let mut near: Vec<VertexId> = Vec::new();
        for cell in changed {
            let around = reach.iter().filter_map(|&offset| graph.id(cell + offset));
            near.extend(around.filter(|&id| is_known(&self.state, &graph, id)));
        }
        near.sort_unstable();
        near.dedup();
        let moves =
            [(&*self.graph, &self.costs), (&*graph, &costs)].map(|(graph, costs)| Moves { graph, costs });
        for id in near {
            self.state.change_moves(&moves, id);
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

/// Whether a node at a vertex is known. (An upper node counts in either grid graph: it may be one of the past.)
fn is_known<P: Placement>(state: &State, graph: &GridGraph<P>, id: VertexId) -> bool {
    state.nodes.is_known(id) || P::closes_gaps(graph.rule()) && state.nodes.is_known(upper(graph, id))
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
    cost: Cost,
}

impl<P: Placement, C: MoveCosts<P>> Moves<'_, P, C> {
    /// A legal move.
    fn joint(&self, id: VertexId, at: Vertex, index: usize) -> Option<Joint> {
        let (graph, step) = (self.graph, self.graph.step(index));
        let (to, to_at) = (step.target(id), at + step.vector());
        let ends = [(node_at(graph, (id, at), to_at), at), (node_at(graph, (to, to_at), at), to_at)];
        Some(Joint { ends, cost: self.costs.cost(graph, at, index)? })
    }
}

impl State {
    /// Changes the rhs of a vertex and its neighbors as far as its moves differ; or marks them, where a way is no
    /// more by which they had it.
    ///
    /// No g changes here. So the order of the moves does not matter: a node that is not marked has an rhs by a
    /// move that is legal after the change.
    fn change_moves<P: Placement, C: MoveCosts<P>>(
        &mut self,
        [before, after]: &[Moves<'_, P, C>; 2],
        id: VertexId,
    ) {
        let at = after.graph.vertex(id);
        let [legal_before, legal_after] = [before.graph, after.graph].map(|graph| graph.legal_moves(at));
        // Where a gap comes or goes, moves join other nodes.
        let quadrants = |graph: &GridGraph<P>| graph.is_closed_gap(at).then(|| ends_at(graph, at));
        let only_illegal = C::ARE_FIXED && quadrants(before.graph) == quadrants(after.graph);
        for index in legal_before.iter() {
            let stays = legal_after.contains(index);
            if !(stays && only_illegal) {
                let new = if stays { after.joint(id, at, index) } else { None };
                self.replace_joint(after.graph, before.joint(id, at, index), new);
            }
        }
        for index in legal_after.iter().filter(|&index| !legal_before.contains(index)) {
            self.replace_joint(after.graph, None, after.joint(id, at, index));
        }
    }

    fn replace_joint<P: Placement>(&mut self, graph: &GridGraph<P>, old: Option<Joint>, new: Option<Joint>) {
        if old == new {
            return;
        }
        let both = |Joint { ends: [one, other], cost }| [(one, other, cost), (other, one, cost)];
        for ((from, _), (to, _), cost) in old.into_iter().flat_map(both) {
            if let Some(g) = self.nodes.get(to).settled() {
                self.mark_if_by(from, g + cost);
            }
        }
        for (from, (to, _), cost) in new.into_iter().flat_map(both) {
            if let Some(g) = self.nodes.get(to).settled() {
                self.lower(graph, from, g + cost, &mut ());
            }
        }
    }
}
