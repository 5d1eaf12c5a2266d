//! Subgoal graphs: what can be prepared of a map so that optimal paths are found in microseconds.
//!
//! Paths turn at the convex corners of obstacles, the *subgoals*. A [`SubgoalGraph`] joins them, once for a map; a planner then joins start and goal to it,
//! searches it, and tells the path move by move.
//!
//! | paper | here |
//! |---|---|
//! | Uras, Koenig & Hernández 2013, subgoal graphs of 8-connected grids | [`Centers`](mediant_grid::Centers), k = 2 and 3, [`Hierarchy::Levels`] |
//! | Hormazábal, Díaz, Hernández & Baier 2017, Sub2-A*(k) | [`Corners`](mediant_grid::Corners), every k, [`Hierarchy::Levels`] |
//! | Uras & Koenig 2015, Sub-Theta* | [`SubgoalTheta`] |
//! | Uras & Koenig 2018, contraction hierarchies of subgoal graphs | [`Hierarchy::Contracted`], the default |
//!
//! ```
//! use std::sync::Arc;
//! use mediant_grid::{AsciiMap, Corners, DiagonalGap, Terrain};
//! use mediant_moves::Knob;
//! use mediant_search::{Planner, Query};
//! use mediant_subgoal::{Hierarchy, SubgoalAStar, SubgoalGraph};
//!
//! let map = AsciiMap::parse("
//!     ......
//!     .####.
//!     ......
//! ")?;
//! let terrain = Terrain::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
//! let graph = SubgoalGraph::new(&terrain, Knob::Any, Hierarchy::Contracted)?;
//! let mut planner = SubgoalAStar::new(&terrain, &graph);
//! let outcome = planner.solve(Query::new((0, 0), (5, 3)))?;
//! let path = outcome.path().ok_or("there is a way")?;
//! assert_eq!(path.waypoints(), [(0, 0), (1, 2), (5, 3)].map(Into::into));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **The key decision: one graph serves every k.** h_k is a norm. Pull a path that is optimal over N(k) taut: each straight piece that takes the place of a
//! detour costs no more, in any norm, and what cannot be pulled further bends at convex corners, around them. And a line of sight is followed
//! by moves of N(k) at the cost h_k (Kramm 2018, Lemma 13). So the *taut* lines of sight between subgoals, those that can be part of such a path at
//! both ends, hold a path that is optimal for every k, and at any angle; only the lengths differ. k = ∞ is no special case.
//! (Hormazábal's graph, of directly h_k-reachable subgoals, has at k = 9 three to four times as many edges. It is what
//! [`Hierarchy::Levels`] makes, for the papers' figures.)
//!
//! **How it is exact.** A hierarchy takes subgoals out of the graph and adds shortcuts where a lightest way led over them. Ways are weighed by
//! (h_k, Euclidean length), so that the lightest are taut, and pairs of arcs that make no taut bend need no shortcut. A query goes up from both ends
//! (`planner.rs`), at any angle along taut bends only.
//!
//! **How it is fast.** What a vertex sees is found row by row, by words of cells and eight rows at once where nothing is in the way
//! ([`Fan`](mediant_search::Fan)); at centers, along the straight lines of cells (`lines.rs`). That costs a few microseconds a query, and builds the edges
//! of a map of 1024 × 1024 cells in some 30 ms.
//!
//! With the feature `parallel` edges are found on all cores.
//!
//! What is not here: files. A graph comes and goes as bytes.

mod centers;
mod codec;
mod connect;
mod contract;
mod corners;
mod direct;
mod error;
mod graph;
mod labels;
mod lines;
mod norm;
mod planner;
mod subgoals;
mod taut;
mod theta;
mod turns;

pub use connect::Connect;
pub use error::SubgoalError;
pub use graph::{Hierarchy, Progress, Stage, SubgoalGraph};
pub use planner::SubgoalAStar;
pub use theta::SubgoalTheta;
