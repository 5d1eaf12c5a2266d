//! Answering queries on a [`SegmentGraph`].

use std::{
    num::NonZeroU32,
    ops::{Deref, DerefMut},
};

use mediant_grid::{Centers, Change, GridGraph, Identity, Vertex};
use mediant_moves::Cost;
use mediant_search::{
    AStar, Ends, Guarantee, Heuristic, Observer, Path, Planner, QueryError, SearchStatus,
    parts::{NodeStore, Part, SearchTree},
};

use super::{search::SegmentSearch, segments::SegmentGraph};
use crate::{HierarchyError, check, waypoints::waypoints};

/// CHPA* (Teleiša & Čalnerytė 2023): A* over segments finds checkpoints, A* over cells finds a path from each
/// to the next.
///
/// There is a checkpoint in each [`step`](Self::with_step)-th segment of the path over segments: the cell at
/// which this path enters it, the free one nearest to the middle of the wall. `H1` is the heuristic of the
/// search over segments, whose costs are counted in segments, `H2` that of the searches over cells. Where a
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
    cell_search: AStar<G, H2>,
    step: NonZeroU32,
    fallback: FallbackPolicy,
    tree: SearchTree,
    /// The path over segments.
    segments: Vec<u32>,
    /// The checkpoints on it, then the goal.
    checkpoints: Vec<Vertex>,
    path: Vec<Vertex>,
    /// The cost of that path.
    length: Cost,
    query: Ends,
    phase: Phase,
}

/// The phase of the current search.
#[derive(Clone, Copy, Debug)]
enum Phase {
    /// Nothing: no search was begun, or it is over.
    Over(SearchStatus),
    /// Phase 1: it searches a path over segments.
    Segments,
    /// Phase 2: it extends the path to the next checkpoint.
    Cells(Leg),
}

/// Which checkpoint the path is to be extended to.
#[derive(Clone, Copy, Debug)]
struct Leg {
    next: usize,
    /// How many checkpoints to skip if this one cannot be reached.
    skip: usize,
    /// Whether the search for it has begun.
    has_begun: bool,
}

/// CHPA*'s fallback where a checkpoint cannot be reached, or only by a detour. Both happen, since segments do
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

impl ChpaStar<(), (), (), ()> {
    /// The scratch memory that a planner on this graph and index takes when it is made, in bytes.
    #[must_use]
    pub fn scratch_bytes(grid_graph: &GridGraph<Centers>, index: &SegmentGraph) -> usize {
        let cells = NodeStore::<()>::bytes(grid_graph.vertex_count());
        SearchTree::<()>::bytes(index.segments()).saturating_add(cells)
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
            cell_search: AStar::new(grid_graph.clone(), second),
            step: NonZeroU32::MIN.saturating_add(1),
            fallback: FallbackPolicy::default(),
            segments: Vec::new(),
            checkpoints: Vec::new(),
            path: Vec::new(),
            length: Cost::ZERO,
            query: Ends::new((0, 0), (0, 0)),
            phase: Phase::Over(SearchStatus::Unreachable),
            grid_graph,
        })
    }

    /// Continues on another grid graph and its index: those of a map after a change. The search that was
    /// begun last is forgotten. The scratch memory is kept if the map has the same size.
    ///
    /// # Errors
    /// As for [`new`](Self::new). Nothing is changed then.
    pub fn follow(&mut self, grid_graph: G, index: I) -> Result<(), HierarchyError> {
        check::belongs(index.identity, &grid_graph)?;
        self.index = index;
        self.follow_graph(grid_graph);
        Ok(())
    }

    /// Continues on another grid graph, whose index is there.
    fn follow_graph(&mut self, grid_graph: G) {
        self.tree.fit(self.index.segments());
        self.cell_search.follow(grid_graph.clone());
        self.phase = Phase::Over(SearchStatus::Unreachable);
        self.grid_graph = grid_graph;
    }

    /// The paper's Pstep: every how many segments there is a checkpoint.
    #[must_use]
    pub fn with_step(self, step: NonZeroU32) -> Self {
        Self { step, ..self }
    }

    /// Sets the fallback where a checkpoint cannot be reached.
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
    /// Changes the map: `grid_graph` is that of the map after the change. Repairs the index, and keeps the
    /// scratch memory. The search that was begun last is forgotten.
    ///
    /// # Errors
    /// [`HierarchyError::Mismatch`] for a grid graph of another rule of motion or k, or of another map than
    /// the one after the change, and for a change of another map than the index is of. Nothing is changed
    /// then.
    pub fn repair(&mut self, grid_graph: G, change: &Change) -> Result<(), HierarchyError> {
        check::same_moves(self.index.identity, &grid_graph)?;
        check::after(&grid_graph, change)?;
        self.index.repair(change)?;
        self.follow_graph(grid_graph);
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
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.phase = Phase::Over(SearchStatus::Unreachable);
        if query.ids(&self.grid_graph)?.is_none() {
            return Ok(SearchStatus::Unreachable);
        }
        self.path.clear();
        self.path.push(query.start);
        self.length = Cost::ZERO;
        self.query = query;
        self.search(observer).begin();
        self.phase = Phase::Segments;
        Ok(SearchStatus::Searching)
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if let Phase::Segments = self.phase {
            let status = self.search(observer).run();
            if status == SearchStatus::Searching {
                return Ok(status);
            }
            self.phase = Phase::Over(SearchStatus::Unreachable);
            self.plan(status == SearchStatus::Found, observer)?;
            self.phase = Phase::Cells(Leg { next: 0, skip: 1, has_begun: false });
        }
        while let Phase::Cells(leg) = self.phase {
            let phase = self.extend(leg, observer);
            self.phase = *phase.as_ref().unwrap_or(&Phase::Over(SearchStatus::Unreachable));
            phase?;
            if let Phase::Cells(Leg { has_begun: true, .. }) = self.phase {
                return Ok(SearchStatus::Searching);
            }
        }
        Ok(match self.phase {
            Phase::Over(status) => status,
            Phase::Segments | Phase::Cells(_) => SearchStatus::Searching,
        })
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        let length = match self.phase {
            Phase::Over(SearchStatus::Found) if at == self.query.goal => self.path.len(),
            Phase::Over(SearchStatus::Unreachable) => return None,
            _ => 1 + self.path.iter().position(|&vertex| vertex == at)?,
        };
        Some(path_along(&self.path[..length]))
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
    /// The search of phase 1, with its memory.
    fn search<'s, O: Observer>(&'s mut self, observer: &'s mut O) -> SegmentSearch<'s, H1, O> {
        let Self { grid_graph, index, heuristic, tree, query, .. } = self;
        SegmentSearch { grid_graph, graph: index, heuristic: *heuristic, tree, query: *query, observer }
    }

    /// Between the phases: makes the checkpoints.
    fn plan(&mut self, is_connected: bool, observer: &mut impl Observer) -> Result<(), QueryError> {
        let mut segments = std::mem::take(&mut self.segments);
        self.checkpoints.clear();
        if is_connected {
            self.search(observer).path(&mut segments);
            let Self { grid_graph, index, query, step, checkpoints, .. } = self;
            index.append_checkpoints(grid_graph, &segments, query.goal, *step, checkpoints);
        }
        self.segments = segments;
        self.checkpoints.push(self.query.goal);
        match self.fallback {
            FallbackPolicy::Paper if !is_connected => {
                return Err(QueryError::GaveUp { why: "the segments of its ends are not connected" });
            }
            FallbackPolicy::Complete { .. } if !is_connected => observer.fell_back(),
            FallbackPolicy::Paper | FallbackPolicy::Complete { .. } => {}
        }
        Ok(())
    }

    /// Phase 2: extends the path to the next checkpoint. The complete planner takes the next one that can be
    /// reached without a detour, and may take any to the last, the goal.
    fn extend(&mut self, leg: Leg, observer: &mut impl Observer) -> Result<Phase, QueryError> {
        let Self { grid_graph, cell_search, checkpoints, path, length, fallback, .. } = self;
        let Leg { next, skip, has_begun } = leg;
        let (Some(&at), Some(&to)) = (path.last(), checkpoints.get(next)) else {
            return Ok(Phase::Over(SearchStatus::Found));
        };
        let last = checkpoints.len() - 1;
        if !has_begun {
            let limit = match *fallback {
                FallbackPolicy::Complete { detour } if next != last => {
                    times(grid_graph.costs().distance(at.to(to)), detour)
                }
                FallbackPolicy::Complete { .. } | FallbackPolicy::Paper => Cost::MAX,
            };
            cell_search.begin_within(Ends::new(at, to), limit, observer)?;
        }
        // Whether this leg becomes part of the path is not known yet.
        let status = cell_search.proceed(&mut Part::pausing(observer, *length))?;
        Ok(match (status, *fallback) {
            (SearchStatus::Searching, _) => Phase::Cells(Leg { has_begun: true, ..leg }),
            (SearchStatus::Found, _) => {
                let known = path.len();
                cell_search.extend_to(path, to);
                let costs = grid_graph.costs();
                for ends in path[known - 1..].windows(2) {
                    *length += costs.distance(ends[0].to(ends[1]));
                    observer.reached(ends[1], *length);
                }
                Phase::Cells(Leg { next: next + 1, skip: 1, has_begun: false })
            }
            (SearchStatus::Unreachable, FallbackPolicy::Paper) => {
                return Err(QueryError::GaveUp { why: "a checkpoint cannot be reached" });
            }
            (SearchStatus::Unreachable, FallbackPolicy::Complete { .. }) if next == last => {
                Phase::Over(SearchStatus::Unreachable)
            }
            (SearchStatus::Unreachable, FallbackPolicy::Complete { .. }) => {
                observer.fell_back();
                Phase::Cells(Leg { next: (next + skip).min(last), skip: 2 * skip, has_begun: false })
            }
        })
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
