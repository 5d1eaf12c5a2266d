//! A* over N(k) (Hart, Nilsson & Raphael 1968), for every k, both placements and all rules of motion.
//!
//! Rule variant: a vertex is expanded with all its legal moves, nothing is pruned. A cheaper path to a closed node reopens
//! it, so the result is optimal with every heuristic that never overestimates, consistent or not.

use std::ops::Deref;

use mediant_grid::{Lattice, Place, Vertex, VertexId};
use mediant_moves::Cost;

use crate::{
    Entry, Guarantee, Heuristic, Node, NodeEvent, NodeStore, Observer, OpenList, Outcome, Path, Planner,
    Query, QueryError,
};

/// A* on a lattice.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Centers, CornerRule, Lattice};
/// use mediant_moves::K;
/// use mediant_search::{AStar, LatticeDistance, Planner, Query};
///
/// let map = AsciiMap::parse("
///     ....
///     .##.
///     ....
/// ")?;
/// let lattice = Lattice::<Centers>::new(Arc::new(map.grid), K::new(3)?, CornerRule::Never)?;
/// let mut planner = AStar::new(&lattice, LatticeDistance);
/// let outcome = planner.solve(Query::new((0, 1), (3, 1)))?;
/// assert_eq!(outcome.path().map(|path| path.cost()), Some(5.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// `L` is how the planner holds its lattice: by reference, or, where both belong in one struct, by `Arc`.
#[derive(Clone, Debug)]
pub struct AStar<L, H> {
    lattice: L,
    heuristic: H,
    nodes: NodeStore,
    open: OpenList,
}

impl<P: Place, L: Deref<Target = Lattice<P>>, H: Heuristic> AStar<L, H> {
    /// A planner with scratch memory for `lattice`: 16 bytes a vertex.
    #[must_use]
    pub fn new(lattice: L, heuristic: H) -> Self {
        let nodes = NodeStore::new(lattice.vertex_count());
        Self { lattice, heuristic, nodes, open: OpenList::default() }
    }

    /// Expands nodes until the goal is the best of them. Whether it was found.
    fn search(
        &mut self,
        start: VertexId,
        goal: Vertex,
        goal_id: VertexId,
        observer: &mut impl Observer,
    ) -> bool {
        let Self { lattice, heuristic, nodes, open } = self;
        let lattice: &Lattice<P> = lattice;
        let at = lattice.vertex(start);
        let h = heuristic.estimate(lattice, at.to(goal));
        nodes.start_search();
        open.clear();
        nodes.set_path(start, Cost::ZERO, 0);
        observer.generated(NodeEvent { at, parent: None, g: Cost::ZERO, f: h });
        open.push(Entry::new(h, h, start), |id, slot| nodes.set_slot(id, slot));

        while let Some((entry, swaps)) = open.pop(|id, slot| nodes.set_slot(id, slot)) {
            observer.percolated(swaps);
            let id = entry.id();
            if id == goal_id {
                return true;
            }
            nodes.set_slot(id, Node::CLOSED);
            let Some(&node) = nodes.get(id) else { continue };
            let at = lattice.vertex(id);
            let arrived_by = (id != start).then(|| node.arrived_by());
            let parent = arrived_by.map(|index| at + -lattice.step(index).vector());
            observer.expanded(NodeEvent { at, parent, g: node.g, f: entry.f() });

            lattice.for_each_successor(at, arrived_by, goal, |index| {
                let step = lattice.step(index);
                let (to, g) = (step.target(id), node.g + step.cost);
                let event = |f| NodeEvent { at: at + step.vector(), parent: Some(at), g, f };
                let estimate = || heuristic.estimate(lattice, (at + step.vector()).to(goal));
                match nodes.get(to) {
                    Some(known) if known.g <= g => {}
                    Some(&known) => {
                        let gain = known.g - g;
                        nodes.set_path(to, g, index);
                        let (f, swaps) = if known.slot == Node::CLOSED {
                            let h = estimate();
                            (g + h, open.push(Entry::new(g + h, h, to), |id, slot| nodes.set_slot(id, slot)))
                        } else {
                            let f = open.get(known.slot).map_or(g, |entry| entry.f() - gain);
                            (f, open.decrease(known.slot, gain, |id, slot| nodes.set_slot(id, slot)))
                        };
                        observer.updated(event(f));
                        observer.percolated(swaps);
                    }
                    None => {
                        let h = estimate();
                        nodes.set_path(to, g, index);
                        observer.generated(event(g + h));
                        observer.percolated(
                            open.push(Entry::new(g + h, h, to), |id, slot| nodes.set_slot(id, slot)),
                        );
                    }
                }
            });
        }
        false
    }

    /// The waypoints of the path that the search found: its start, its goal, and where it changes its move.
    fn path(&self, start: VertexId, goal: VertexId) -> Path {
        let steps_back = || {
            let mut id = goal;
            std::iter::from_fn(move || {
                let node = self.nodes.get(id).filter(|_| id != start)?;
                let (from, index) = (id, node.arrived_by());
                id = self.lattice.step(index).source(id);
                Some((from, index))
            })
        };
        let mut last = None;
        let mut turns = |&(_, index): &(VertexId, usize)| last.replace(index) != Some(index);
        let count = steps_back().filter(&mut turns).count();
        let mut waypoints = Vec::with_capacity(count + 1);
        last = None;
        let turns = |&(_, index): &(VertexId, usize)| last.replace(index) != Some(index);
        waypoints.extend(steps_back().filter(turns).map(|(id, _)| self.lattice.vertex(id)));
        waypoints.push(self.lattice.vertex(start));
        waypoints.reverse();
        Path::new(waypoints)
    }
}

impl<P: Place, L: Deref<Target = Lattice<P>>, H: Heuristic> Planner for AStar<L, H> {
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        query.check(&self.lattice)?;
        let (Some(start), Some(goal)) = (self.lattice.id(query.start), self.lattice.id(query.goal)) else {
            return Ok(Outcome::Unreachable);
        };
        // The components know, in constant time, what the search would find out by expanding all that it can reach.
        if !self.lattice.connected(query.start, query.goal) || !self.search(start, query.goal, goal, observer)
        {
            return Ok(Outcome::Unreachable);
        }
        Ok(Outcome::Found(self.path(start, goal)))
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Optimal(self.lattice.k())
    }
}
