//! Search engines on the 2^k neighborhoods of a grid.
//!
//! Every engine is a [`Planner`]: it borrows an immutable [`GridGraph`](mediant_grid::GridGraph), owns its scratch memory, and answers
//! [`Query`] after [`Query`] with an [`Outcome`] that it stands behind by a [`Guarantee`].
//!
//! **The key decision: costs are integers.** Open lists compare fixed-point sums ([`Cost`](mediant_moves::Cost)), so equal paths are
//! equal, the heuristic is exactly consistent, and the same query gives the same path and the same counts on every
//! platform. The cost of a [`Path`] is recomputed in floating point from its waypoints.
//!
//! What varies, placement, heuristic and observer, is a type parameter, and the unused costs nothing: a search without
//! counters is compiled without them.
//!
//! What is not here: preprocessing (`mediant-subgoal`, `mediant-hierarchy`), threads, serialization.

mod anya;
mod astar;
mod best_first;
mod canonical;
mod distances;
mod heuristic;
mod jps;
mod nodes;
mod observer;
mod open_list;
mod path;
mod planner;
mod query;
mod search_tree;
mod segment;
mod smoothing;
mod successors;
mod theta;
mod wavefront;

pub use anya::Anya;
pub use astar::{AStar, AllMoves, Dijkstra};
pub use best_first::BestFirst;
pub use canonical::{
    Canonical, CanonicalMoves, CanonicalRule, LocalRule, PaperCanonical, PaperMoves, Pruning,
};
pub use distances::Distances;
pub use heuristic::{Euclidean, Heuristic, Hk, SquaredEuclidean, Zero};
pub use jps::{
    BlockFinder, BlockJps, Jps, JpsPlus, JumpContext, JumpFinder, JumpMoves, JumpPointSearch, JumpTable,
    JumpTableError, StepwiseFinder,
};
pub use nodes::{Node, NodeStore};
pub use observer::{Counters, NodeEvent, Observer};
pub use open_list::{Entry, OpenList};
pub use path::{Guarantee, Outcome, Path};
pub use planner::Planner;
pub use query::{End, Query, QueryError};
pub use search_tree::SearchTree;
pub use segment::segment_cost;
pub use smoothing::{HasFreeSpace, Smoothed, Smoothing, pull_taut, smooth};
pub use successors::{ExpandedNode, ParentPointer, Successor, Successors};
pub use theta::{Eager, Lazy, LazyThetaStar, SightCheck, Theta, ThetaStar};
pub use wavefront::Wavefront;
