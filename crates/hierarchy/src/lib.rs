//! Hierarchical path planning, HPA* and CHPA*: near-optimal paths, from small indexes that are repaired where
//! the map changes.
//!
//! Both cut the map into parts, store which parts are joined, and answer a query in two steps: A* over parts,
//! then short searches within the parts on the way. HPA* also stores the cost of crossing each part.
//!
//! | paper | index | planner |
//! |---|---|---|
//! | Botea, Müller & Schaeffer 2004, HPA* | [`ClusterGraph`]: clusters, transitions between them, and the costs between transitions, on one or more levels | [`HpaStar`] |
//! | Teleiša & Čalnerytė 2023, CHPA* | [`SegmentGraph`]: segments, and which neighbors a path within a sliding window joins | [`ChpaStar`], as published or [complete](FallbackPolicy) |
//!
//! ```
//! use std::sync::Arc;
//! use mediant_grid::{AsciiMap, Centers, Change, CornerRule, GridGraph};
//! use mediant_hierarchy::{ClusterGraph, Clustering, HpaStar};
//! use mediant_moves::FiniteK;
//! use mediant_search::{Ends, Planner};
//!
//! let map = AsciiMap::parse("
//!     ..#..
//!     ..#..
//!     ..#..
//! ")?;
//! let grid_graph = |grid| GridGraph::<Centers>::new(grid, FiniteK::N8, CornerRule::Never);
//! let before = Arc::new(grid_graph(Arc::new(map.grid))?);
//! let graph = Box::new(ClusterGraph::new(&before, Clustering { side: 2, levels: 1 })?);
//! let mut planner = HpaStar::new(Arc::clone(&before), graph)?;
//! let query = Ends::new((0, 0), (4, 0));
//! assert_eq!(planner.solve(query)?.path(), None);
//!
//! // A door opens.
//! let change = Change::new(Arc::clone(before.grid())).edit_cells([(2, 2, false)]);
//! let after = Arc::new(grid_graph(Arc::clone(change.after()))?);
//! planner.repair(after, &change)?;
//! assert!(planner.solve(query)?.path().is_some());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **The key idea: an index is a function of the map, part by part.** What is stored of a part follows from
//! its own cells and those along its border, or on an upper level of HPA* from the parts that it consists of.
//! Node numbers, the order of work and earlier versions of the map do not enter. Two things follow. A change
//! can affect only the parts that it touches, their neighbors, and the parts above them, so that a repair
//! computes these anew and nothing else. And a repaired index is *equal* to a new one, value by value, so
//! that nothing decays over many repairs, and one comparison tests it. The price is the length of paths: a
//! path must pass through given cells on the borders of its parts, transitions that were chosen before the
//! query or checkpoints near the middle of a border. In HPA*, [straightening](HpaStar::with_straightening)
//! regains most of that.
//!
//! How long the paths are, how fast the planners, and how the results compare with what the papers claim: see
//! `docs/measurements/hierarchy.md`. In short, paths of HPA* are 0.2 to 0.4 % longer than optimal in the mean
//! on maps of games.
//!
//! **Not here.** No path is promised to be optimal; `mediant-search` and `mediant-subgoal` have the engines
//! that promise it. There are no hierarchies for k above 3, for corners that may be cut at k = 3, or for
//! corner placement. There are no files: an index is written to and read from bytes.

mod bytes;
mod check;
mod chpa;
mod error;
mod hpa;
#[cfg(doctest)]
mod readme;
mod touched;
mod waypoints;
mod window;

pub use chpa::{ChpaStar, FallbackPolicy, SegmentGraph};
pub use error::HierarchyError;
pub use hpa::{ClusterGraph, Clustering, HpaStar};
