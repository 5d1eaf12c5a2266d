//! Answering queries on a [`SegmentGraph`].

use std::{
    num::NonZeroU32,
    ops::{Deref, DerefMut},
};

use mediant_grid::{Centers, GridGraph, Identity, Rectangle, Vertex};
use mediant_moves::Cost;
use mediant_search::{
    AStar, Guarantee, Heuristic, Observer, Outcome, Path, Planner, Query, QueryError, parts::SearchTree,
};

use super::{search::search, segments::SegmentGraph};
use crate::{HierarchyError, check, waypoints::waypoints};

/// CHPA* (Teleiša & Čalnerytė 2023): A* over segments finds checkpoints, A* over tiles finds a path from each
/// to the next.
///
/// There is a checkpoint in each [`step`](Self::with_step)-th segment of the path over segments: the tile at
/// which this path enters it, the free one nearest to the middle of the wall. `H1` is the heuristic of the
/// search over segments, whose costs are counted in segments, `H2` that of the searches over tiles. Where a
/// checkpoint cannot be reached, the [`FallbackPolicy`] says what happens.
///
/// `G` and `I` are how the planner holds the grid graph and its index: by reference or by `Arc`. A planner
/// that holds its index in a `Box` can [repair](Self::repair) it.
///
/// **Ties** are decided by the order of the open lists: f, then h, then the number of the segment or vertex.
/// An observer gets the events of both phases; an event of the first is at the middle of its segment. Scratch
/// memory: 16 bytes a vertex, 24 a segment.
#[derive(Clone, Debug)]
pub struct ChpaStar<G, I, H1, H2> {
    grid_graph: G,
    index: I,
    heuristic: H1,
    tile_search: AStar<G, H2>,
    step: NonZeroU32,
    fallback: FallbackPolicy,
    tree: SearchTree,
    /// The path over segments.
    segments: Vec<u32>,
    /// The checkpoints on it, then the goal.
    checkpoints: Vec<Vertex>,
    path: Vec<Vertex>,
}

/// What CHPA* does where a checkpoint cannot be reached, or only by a detour. Both happen, since segments do
/// not tell whether paths lead through them ('preprocessing edge cases' in the paper, Section 6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FallbackPolicy {
    /// As published: the planner takes the detour, and gives up where there is none ([`QueryError::GaveUp`]).
    Paper,
    /// The planner finds a path whenever there is one. Where the next checkpoint cannot be reached without a
    /// detour, it skips that one, then two more, then four and so on, until one can be reached, at the latest
    /// the goal. Where the segments of start and goal are not connected, it searches for the goal at once.
    /// Each fallback is an event ([`Observer::fell_back`]).
    ///
    /// The default, with detours of up to three times h_k.
    Complete {
        /// The highest cost of the path to a checkpoint that is no detour: this many times h_k, its cost on
        /// an empty map.
        detour: NonZeroU32,
    },
}

impl Default for FallbackPolicy {
    fn default() -> Self {
        Self::Complete { detour: NonZeroU32::MIN.saturating_add(2) }
    }
}

impl<G, I, H1, H2> ChpaStar<G, I, H1, H2>
where
    G: Deref<Target = GridGraph<Centers>> + Clone,
    I: Deref<Target = SegmentGraph>,
    H1: Heuristic,
    H2: Heuristic,
{
    /// A planner on `index`, which must be that of `grid_graph`, with the heuristics of the two phases;
    /// with a step of 2 and the default [`FallbackPolicy`].
    ///
    /// # Errors
    /// [`HierarchyError::Mismatch`] for the index of another map, rule of motion or k.
    pub fn new(grid_graph: G, index: I, first: H1, second: H2) -> Result<Self, HierarchyError> {
        check::belongs(index.identity, &grid_graph)?;
        Ok(Self {
            tree: SearchTree::new(index.segments()),
            index,
            heuristic: first,
            tile_search: AStar::new(grid_graph.clone(), second),
            step: NonZeroU32::MIN.saturating_add(1),
            fallback: FallbackPolicy::default(),
            segments: Vec::new(),
            checkpoints: Vec::new(),
            path: Vec::new(),
            grid_graph,
        })
    }

    /// The paper's Pstep: every how many segments there is a checkpoint.
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

impl<G, I, H1, H2> ChpaStar<G, I, H1, H2>
where
    G: Deref<Target = GridGraph<Centers>> + Clone,
    I: DerefMut<Target = SegmentGraph>,
    H1: Heuristic,
    H2: Heuristic,
{
    /// Changes the map: `grid_graph` may differ from the one before only in the cells of a rectangle. Repairs
    /// the index, and keeps the scratch memory.
    ///
    /// # Errors
    /// [`HierarchyError::Mismatch`] for a grid graph of another rule of motion or k,
    /// [`HierarchyError::Size`] for one of another size, and [`HierarchyError::ChangedOutside`] if the maps
    /// differ outside of the rectangle. Nothing is changed then.
    pub fn repair(&mut self, grid_graph: G, changed: Rectangle) -> Result<(), HierarchyError> {
        check::same_moves(self.index.identity, &grid_graph)?;
        self.index.repair(self.grid_graph.grid(), grid_graph.grid(), changed)?;
        self.tile_search.set_graph(grid_graph.clone());
        self.grid_graph = grid_graph;
        Ok(())
    }
}

impl<G, I, H1, H2> Planner for ChpaStar<G, I, H1, H2>
where
    G: Deref<Target = GridGraph<Centers>> + Clone,
    I: Deref<Target = SegmentGraph>,
    H1: Heuristic,
    H2: Heuristic,
{
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        if query.ends(&self.grid_graph)?.is_none() {
            return Ok(Outcome::Unreachable);
        }
        let Self { grid_graph, index, heuristic, tree, segments, checkpoints, step, .. } = self;
        let is_connected = search(grid_graph, index, *heuristic, tree, query, segments, observer);
        checkpoints.clear();
        if is_connected {
            index.append_checkpoints(grid_graph, segments, query.goal, *step, checkpoints);
        }
        checkpoints.push(query.goal);
        match self.fallback {
            FallbackPolicy::Paper if !is_connected => {
                Err(QueryError::GaveUp { why: "the segments of its ends are not connected" })
            }
            FallbackPolicy::Paper => self.visit_all(query, observer),
            FallbackPolicy::Complete { detour } => {
                if !is_connected {
                    observer.fell_back();
                }
                self.visit_some(query, detour, observer)
            }
        }
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Suboptimal
    }

    fn identity(&self) -> Identity {
        self.grid_graph.identity()
    }
}

impl<G, I, H1, H2> ChpaStar<G, I, H1, H2>
where
    G: Deref<Target = GridGraph<Centers>> + Clone,
    I: Deref<Target = SegmentGraph>,
    H1: Heuristic,
    H2: Heuristic,
{
    /// Phase 2 as published: finds a path from each checkpoint to the next.
    fn visit_all(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        let Self { tile_search, checkpoints, path, .. } = self;
        path.clear();
        path.push(query.start);
        for &to in &*checkpoints {
            if !tile_search.extend(path, to, Cost::MAX, observer)? {
                return Err(QueryError::GaveUp { why: "a checkpoint cannot be reached" });
            }
        }
        Ok(Outcome::Found(path_along(path)))
    }

    /// Phase 2, complete: finds a path to the next checkpoint that can be reached without a detour, until it
    /// is at the goal.
    fn visit_some(
        &mut self,
        query: Query,
        detour: NonZeroU32,
        observer: &mut impl Observer,
    ) -> Result<Outcome, QueryError> {
        let Self { grid_graph, tile_search, checkpoints, path, .. } = self;
        path.clear();
        path.push(query.start);
        let (mut at, mut next, mut skip) = (query.start, 0, 1);
        // The last one is the goal, which may cost any detour.
        let last = checkpoints.len().saturating_sub(1);
        while let Some(&to) = checkpoints.get(next) {
            let limit =
                if next == last { Cost::MAX } else { times(grid_graph.costs().distance(at.to(to)), detour) };
            if tile_search.extend(path, to, limit, observer)? {
                (at, next, skip) = (to, next + 1, 1);
            } else if next == last {
                return Ok(Outcome::Unreachable);
            } else {
                observer.fell_back();
                (next, skip) = ((next + skip).min(last), 2 * skip);
            }
        }
        Ok(Outcome::Found(path_along(path)))
    }
}

/// A cost multiplied by a factor; [`Cost::MAX`], which is no limit, if that exceeds the cost of any path.
fn times(cost: Cost, factor: NonZeroU32) -> Cost {
    Cost::from_bits(cost.to_bits().saturating_mul(u64::from(factor.get())))
}

/// The path through these vertices.
fn path_along(vertices: &[Vertex]) -> Path {
    let mut path = Vec::with_capacity(vertices.len());
    waypoints(vertices, &mut path);
    Path::new(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_detour_is_no_limit() {
        let far = Cost::of_move(mediant_grid::Vector::new(30_000, 30_000));
        assert_eq!(times(far, NonZeroU32::MAX), Cost::MAX);
        assert_eq!(times(far, NonZeroU32::MIN), far);
    }
}
