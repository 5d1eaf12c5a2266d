//! Search engines on the 2^k neighborhoods of a grid.
//!
//! Every engine is a [`Planner`]: it borrows an immutable [`GridGraph`](mediant_grid::GridGraph), owns its
//! scratch memory, and answers one [`Ends`] after another with an [`Answer`], whose quality it states as a
//! [`Guarantee`].
//!
//! | engine | paths | k |
//! |---|---|---|
//! | [`AStar`], [`Dijkstra`] | optimal over N(k) | all |
//! | [`Wavefront`] | of the fewest moves | all |
//! | [`Canonical`] | optimal over N(k) | all |
//! | [`PaperCanonical`], as published | over N(k) | all |
//! | [`Jps`] | optimal over N(k) | all |
//! | [`BlockJps`], [`JpsPlus`] | optimal over N(k) | 2, 3 |
//! | [`ThetaStar`], [`LazyThetaStar`] | any-angle | all |
//! | [`Anya`] | optimal over N(k), or any-angle; at corners | all, ∞ |
//!
//! [`LpaStar`] and [`DStarLite`] answer one query again and again while the map changes, and keep what they
//! know: optimal over N(k), for all k.
//!
//! [`Smoothed`] makes the paths of any planner shorter, at any angle. A [`Search`] answers a [`Query`] by
//! any planner: a query with several ends, a tolerance, limits, in steps.
//!
//! A field has the distances of all vertices to the nearest of one or many sources, and the paths and
//! directions there:
//!
//! | made by | field | distances | k |
//! |---|---|---|---|
//! | [`Fields`] | [`Field`] | over N(k), exact in fixed point | all |
//! | [`AnyAngleFields`] | [`AnyAngleField`] | at any angle, at corners | ∞ |
//! | [`Wavefront::distances`] | [`Distances`] | numbers of moves | all |
//!
//! **The key decision: costs are integers.** Open lists compare fixed-point sums
//! ([`Cost`](mediant_moves::Cost)). So paths of equal length compare as equal, the heuristic [`Hk`] is
//! consistent to the last bit, and the same query gives the same path and the same counts on every platform.
//! The cost of a [`Path`] is recomputed in floating point from its waypoints.
//!
//! Placement, heuristic and observer are type parameters, so that what is not used costs nothing: a search
//! without counters is compiled without them.
//!
//! This crate does not preprocess maps beyond jump tables (`mediant-subgoal` and `mediant-hierarchy` do),
//! starts no threads, reads no clock, and writes no files.

mod answer;
mod anya;
mod astar;
mod best_first;
mod canonical;
mod counted;
mod distances;
mod field;
mod filled;
mod gap_nodes;
mod guarantee;
mod heuristic;
mod jps;
mod limit;
mod line_path;
mod metric;
mod nodes;
mod observer;
mod open_front;
mod open_list;
mod parent;
pub mod parts;
mod path;
mod planner;
mod query;
#[cfg(doctest)]
mod readme;
mod replanning;
mod search_tree;
mod segment;
mod smoothing;
mod successors;
mod theta;
mod trace_back;
mod wavefront;

pub use answer::{Answer, Status};
pub use anya::{Anya, DeadEnds, EuclideanNorm, LatticeNorm, Norm};
pub use astar::{AStar, Dijkstra};
pub use canonical::{Canonical, CanonicalRule, PaperCanonical, Pruning};
pub use distances::Distances;
pub use field::{AnyAngleField, AnyAngleFields, Field, FieldError, FieldQuery, Fields};
pub use guarantee::Guarantee;
pub use heuristic::{Euclidean, Heuristic, Hk, SquaredEuclidean, Zero};
pub use jps::{BlockJps, Jps, JpsPlus, JumpError, JumpTable};
pub use observer::{Counters, NodeEvent, Observer};
pub use path::{BrokenPath, JoinError, Path, SpacingError, Turn};
pub use planner::{Planner, SearchStatus};
pub use query::{
    CenterSpace, End, EndSpace, Ends, Limit, Limits, PathCosts, PointEnds, Query, QueryError, Search, Stopped,
};
pub use replanning::{DStarLite, Lengths, LpaStar, MoveCosts};
pub use smoothing::{Smoothed, Smoothing, pull_taut, smooth};
pub use theta::{LazyThetaStar, ThetaStar};
pub use wavefront::Wavefront;
