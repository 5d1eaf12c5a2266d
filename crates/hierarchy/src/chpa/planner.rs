//! Answering queries on a [`SegmentGraph`].

use std::{
    iter::successors,
    num::NonZeroU32,
    ops::{Deref, DerefMut},
};

use mediant_grid::{Centers, GridGraph, Rectangle, Vertex};
use mediant_moves::Cost;
use mediant_search::{
    AStar, Guarantee, Heuristic, NodeEvent, Observer, Outcome, Path, Planner, Query, QueryError, SearchTree,
};

use super::segments::SegmentGraph;
use crate::{HierarchyError, check, straighten::waypoints};

/// CHPA* (Teleiša & Čalnerytė 2023): A* over segments finds checkpoints, A* over tiles goes from each to the next.
///
/// A checkpoint is the tile at which the path arrives in each [`step`](Self::with_step)-th segment: of those along the wall to the segment before, the free one nearest to its middle. `H1` guides
/// the search over segments, whose costs are counted in segments, `H2` those over tiles. What happens where a checkpoint cannot be reached is the planner's [`FallbackPolicy`].
///
/// `L` and `G` are how the planner holds the grid graph and its index: by reference or `Arc`; a planner that holds its index in a `Box` can [repair](Self::repair) it.
///
/// **Ties** are decided by the open lists' order (f, h, the number of segment or vertex). Events are those of both phases; those of the first have the middle of the segment. Scratch memory:
/// 16 bytes a vertex, 24 a segment.
#[derive(Clone, Debug)]
pub struct ChpaStar<L, G, H1, H2> {
    grid_graph: L,
    graph: G,
    first: H1,
    second: AStar<L, H2>,
    step: NonZeroU32,
    fallback: FallbackPolicy,
    labels: SearchTree,
    /// The segments on the way.
    segments: Vec<u32>,
    checkpoints: Vec<Vertex>,
    way: Vec<Vertex>,
}

/// What CHPA* does where a checkpoint cannot be reached, or only by a detour, since the segments do not tell all of the map ('preprocessing edge cases' in the paper, Section 6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FallbackPolicy {
    /// As published: the planner goes the detour, and gives up where there is none ([`QueryError::GaveUp`]).
    Paper,
    /// The planner leaves out checkpoints, first one, then two, four and so on, until one can be reached, at the latest the goal; where the segments are not connected it goes straight to the goal. So it finds a
    /// path whenever there is one. Each time is told to the observer ([`Observer::fell_back`]).
    Complete {
        /// How many times h_k, what it would cost on an empty map, the way to a checkpoint may cost.
        detour: NonZeroU32,
    },
}

/// Complete, with detours of up to three times h_k.
impl Default for FallbackPolicy {
    fn default() -> Self {
        Self::Complete { detour: NonZeroU32::MIN.saturating_add(2) }
    }
}

impl<L, G, H1, H2> ChpaStar<L, G, H1, H2>
where
    L: Deref<Target = GridGraph<Centers>> + Clone,
    G: Deref<Target = SegmentGraph>,
    H1: Heuristic,
    H2: Heuristic,
{
    /// A planner with scratch memory for `graph`, which must be the index of `grid_graph`; with a step of 2, and complete.
    ///
    /// # Errors
    /// [`HierarchyError`] when it is that of a map of another size or of other moves. With the index of another map paths may be longer, no more.
    pub fn new(grid_graph: L, graph: G, first: H1, second: H2) -> Result<Self, HierarchyError> {
        check::grid_graph(graph.k, graph.size, &grid_graph)?;
        Ok(Self {
            labels: SearchTree::new(graph.segments()),
            graph,
            first,
            second: AStar::new(grid_graph.clone(), second),
            step: NonZeroU32::MIN.saturating_add(1),
            fallback: FallbackPolicy::default(),
            segments: Vec::new(),
            checkpoints: Vec::new(),
            way: Vec::new(),
            grid_graph,
        })
    }

    /// The paper's Pstep: each how many segments there is a checkpoint.
    #[must_use]
    pub fn with_step(self, step: NonZeroU32) -> Self {
        Self { step, ..self }
    }

    /// What to do where a checkpoint cannot be reached.
    #[must_use]
    pub fn with_fallback_policy(self, fallback: FallbackPolicy) -> Self {
        Self { fallback, ..self }
    }
}

impl<L, G, H1, H2> ChpaStar<L, G, H1, H2>
where
    L: Deref<Target = GridGraph<Centers>> + Clone,
    G: DerefMut<Target = SegmentGraph>,
    H1: Heuristic,
    H2: Heuristic,
{
    /// Goes on on a changed map: `grid_graph` differs from the one before only in the cells of a rectangle. Repairs the index, and keeps the scratch memory.
    ///
    /// # Errors
    /// [`HierarchyError`] for a grid graph of another size or other moves; nothing is changed then.
    pub fn repair(&mut self, grid_graph: L, changed: Rectangle) -> Result<(), HierarchyError> {
        check::grid_graph(self.graph.k, self.graph.size, &grid_graph)?;
        self.graph.repair(grid_graph.grid(), changed)?;
        self.second.set_graph(grid_graph.clone());
        self.grid_graph = grid_graph;
        Ok(())
    }
}

impl<L, G, H1, H2> Planner for ChpaStar<L, G, H1, H2>
where
    L: Deref<Target = GridGraph<Centers>> + Clone,
    G: Deref<Target = SegmentGraph>,
    H1: Heuristic,
    H2: Heuristic,
{
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        if query.ends(&self.grid_graph)?.is_none() {
            return Ok(Outcome::Unreachable);
        }
        let found = self.abstract_path(query, observer);
        self.place_checkpoints(found, query.goal);
        match self.fallback {
            FallbackPolicy::Paper if !found => {
                Err(QueryError::GaveUp { why: "the segments of its ends are not connected" })
            }
            FallbackPolicy::Paper => self.visit_all(query, observer),
            FallbackPolicy::Complete { detour } => {
                if !found {
                    observer.fell_back();
                }
                self.visit_some(query, detour, observer)
            }
        }
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Suboptimal
    }
}

impl<L, G, H1, H2> ChpaStar<L, G, H1, H2>
where
    L: Deref<Target = GridGraph<Centers>> + Clone,
    G: Deref<Target = SegmentGraph>,
    H1: Heuristic,
    H2: Heuristic,
{
    /// Phase 1: finds a path over segments. Whether there is one.
    fn abstract_path(&mut self, query: Query, observer: &mut impl Observer) -> bool {
        let Self { grid_graph, graph, first, labels, segments, .. } = self;
        let (start, goal) = (graph.segment_at(query.start), graph.segment_at(query.goal));
        let goal_at = graph.place(goal);
        let estimate = |at: Vertex| first.estimate(grid_graph, at.to(goal_at));
        let h = estimate(graph.place(start));
        labels.start_search();
        labels.reach(start, Cost::ZERO, h, SearchTree::<()>::NONE, ());
        observer.generated(NodeEvent { at: graph.center(start), parent: None, g: Cost::ZERO, f: h });
        while let Some((f, id, g, swaps)) = labels.pop() {
            observer.percolated(swaps);
            if id == goal {
                segments.clear();
                segments.push(goal);
                segments
                    .extend(successors(labels.parent(id), |&(id, ())| labels.parent(id)).map(|(id, ())| id));
                segments.reverse();
                return true;
            }
            let parent = labels.parent(id).map(|(parent, ())| graph.center(parent));
            observer.expanded(NodeEvent { at: graph.center(id), parent, g, f });
            graph.for_each_neighbor(id, |to, d| {
                let g = g + grid_graph.costs().distance(d);
                // With a heuristic that overestimates, going back to closed segments would cost much and promise nothing.
                let is_settled = !H1::ADMISSIBLE && labels.is_closed(to);
                if is_settled || labels.cost(to).is_some_and(|known| known <= g) {
                    return;
                }
                let h = estimate(graph.place(to));
                let (is_first, swaps) = labels.reach(to, g, h, id, ());
                observer.percolated(swaps);
                let event = NodeEvent { at: graph.center(to), parent: Some(graph.center(id)), g, f: g + h };
                if is_first { observer.generated(event) } else { observer.updated(event) }
            });
        }
        false
    }

    /// The places that phase 2 visits: the checkpoints of the path over segments, if there is one, and the goal.
    fn place_checkpoints(&mut self, has_path: bool, goal: Vertex) {
        let Self { grid_graph, graph, segments, checkpoints, step, .. } = self;
        checkpoints.clear();
        if has_path {
            let step = step.get() as usize;
            let legs = segments.windows(2).skip(step - 1).step_by(step);
            // The goal itself stands for its segment.
            let legs = legs.filter(|legs| legs[1] != graph.segment_at(goal));
            checkpoints.extend(legs.filter_map(|legs| graph.checkpoint(grid_graph, legs[0], legs[1])));
        }
        checkpoints.push(goal);
    }

    /// Phase 2 as published: from each checkpoint to the next.
    fn visit_all(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        let Self { second, checkpoints, way, .. } = self;
        way.clear();
        way.push(query.start);
        for &to in &*checkpoints {
            if !second.extend(way, to, Cost::MAX, observer)? {
                return Err(QueryError::GaveUp { why: "a checkpoint cannot be reached" });
            }
        }
        Ok(Outcome::Found(along(way)))
    }

    /// Phase 2, complete: to the next checkpoint that can be reached without a detour.
    fn visit_some(
        &mut self,
        query: Query,
        detour: NonZeroU32,
        observer: &mut impl Observer,
    ) -> Result<Outcome, QueryError> {
        let Self { grid_graph, second, checkpoints, way, .. } = self;
        way.clear();
        way.push(query.start);
        let (mut at, mut next, mut skip) = (query.start, 0, 1);
        // The goal is the last one, and to be reached whatever it costs.
        let last = checkpoints.len().saturating_sub(1);
        while let Some(&to) = checkpoints.get(next) {
            let limit =
                if next == last { Cost::MAX } else { times(grid_graph.costs().distance(at.to(to)), detour) };
            if second.extend(way, to, limit, observer)? {
                (at, next, skip) = (to, next + 1, 1);
            } else if next == last {
                return Ok(Outcome::Unreachable);
            } else {
                observer.fell_back();
                (next, skip) = ((next + skip).min(last), 2 * skip);
            }
        }
        Ok(Outcome::Found(along(way)))
    }
}

impl SegmentGraph {
    /// The tile of `target` at which a path arrives that comes from the segment `origin` beside it: of those along the wall between the two, the free one that is nearest to the
    /// middle, first to the left or above it.
    fn checkpoint(&self, grid_graph: &GridGraph<Centers>, origin: u32, target: u32) -> Option<Vertex> {
        let d = self.place(origin).to(self.place(target));
        let at = self.place(target);
        let side = self.side as i32;
        // Of the tiles of the segment along one axis, that at the wall, or the one so far along it.
        let tile = |first: i32, d: i32, along: i32, cells: u32| {
            let tile = match d {
                1 => first,
                -1 => first + side - 1,
                _ => first + along,
            };
            // Beyond the map, the nearest tile on it.
            tile.min(cells as i32 - 1)
        };
        from_the_middle(side)
            .map(|along| {
                let x = tile(at.x * side, d.x, along, self.size.0);
                Vertex::new(x, tile(at.y * side, d.y, along, self.size.1))
            })
            .find(|&tile| grid_graph.is_free(tile))
    }
}

/// The places along a wall, the middle one first, then outward from it, the lower one of two first.
fn from_the_middle(length: i32) -> impl Iterator<Item = i32> {
    (0..length).map(move |i| length / 2 + if i % 2 == 1 { -(i + 1) / 2 } else { i / 2 })
}

/// So many times a cost; [`Cost::MAX`], which is no limit, where that is too much for any path.
fn times(cost: Cost, factor: NonZeroU32) -> Cost {
    Cost::from_bits(cost.to_bits().saturating_mul(u64::from(factor.get())))
}

/// The path through these vertices.
fn along(way: &[Vertex]) -> Path {
    let mut path = Vec::with_capacity(way.len());
    waypoints(way, &mut path);
    Path::new(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_tile_of_a_wall_is_tried_once_the_middle_one_first() {
        assert_eq!(from_the_middle(1).collect::<Vec<_>>(), [0]);
        assert_eq!(from_the_middle(3).collect::<Vec<_>>(), [1, 0, 2]);
        assert_eq!(from_the_middle(4).collect::<Vec<_>>(), [2, 1, 3, 0]);
        for length in 1..=63 {
            let mut order: Vec<i32> = from_the_middle(length).collect();
            order.sort_unstable();
            assert_eq!(order, (0..length).collect::<Vec<_>>());
        }
    }

    #[test]
    fn the_largest_detour_is_no_limit() {
        let far = Cost::of_move(mediant_grid::Vector::new(30_000, 30_000));
        assert_eq!(times(far, NonZeroU32::MAX), Cost::MAX);
        assert_eq!(times(far, NonZeroU32::MIN), far);
    }
}
