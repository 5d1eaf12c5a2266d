//! Subgoal graphs: prepared maps on which optimal paths are found in microseconds.
//!
//! A shortest path goes around obstacles at their convex corners, the *subgoals*, and between them as on an
//! empty grid. A [`SubgoalGraph`] joins subgoals by edges, once for each map. A planner joins the start and
//! the goal of a query to the graph, searches it, and turns its edges into moves. With [`HubLabels`] nothing
//! is searched: the distance is looked up, and the path is followed from subgoal to subgoal.
//!
//! | paper | here |
//! |---|---|
//! | Uras, Koenig & Hernández 2013, subgoal graphs | [`Centers`], k = 2 and 3, [`Hierarchy::Levels`] |
//! | Hormazábal, Díaz, Hernández & Baier 2017, Sub2-A*(k) | [`Corners`], every k, [`Hierarchy::Levels`] |
//! | Uras & Koenig 2015, Sub-Theta* | [`SubgoalTheta`] |
//! | Uras & Koenig 2018, contraction hierarchies of subgoal graphs | [`Hierarchy::Contracted`], the default |
//! | Du, Shen & Cheema 2023, Euclidean hub labels | [`HubLabels`], every k; labels of subgoals, not of regions |
//!
//! [`Centers`]: mediant_grid::Centers
//! [`Corners`]: mediant_grid::Corners
//!
//! ```
//! use std::sync::Arc;
//! use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace};
//! use mediant_moves::K;
//! use mediant_search::{Ends, Planner};
//! use mediant_subgoal::{Hierarchy, SubgoalAStar, SubgoalGraph};
//!
//! let map = AsciiMap::parse("
//!     ......
//!     .####.
//!     ......
//! ")?;
//! let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
//! let graph = SubgoalGraph::new(&space, K::Any, Hierarchy::Contracted)?;
//! let mut planner = SubgoalAStar::new(&space, &graph)?;
//! let answer = planner.solve(Ends::new((0, 0), (5, 3)))?;
//! let path = answer.path().ok_or("there is a way")?;
//! assert_eq!(path.waypoints(), [(0, 0), (1, 2), (5, 3)].map(Into::into));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The key idea: one graph serves every k
//!
//! h_k is a norm, as is the Euclidean length. Take a path that is optimal over N(k), and pull it taut like a
//! string. Each straight piece that replaces a detour costs no more, by the triangle inequality, in any norm.
//! Where the path cannot be pulled further, it bends around a convex corner. So the taut path consists of
//! lines of sight between subgoals. Moves of N(k) can follow each of these lines at the cost h_k (Kramm 2018,
//! Lemma 13), so the taut path is optimal over N(k), too.
//!
//! The graph therefore needs only *taut* edges: lines of sight along which a taut path can pass at both ends.
//! They contain an optimal path for every k and at any angle. k changes only the lengths of the edges, and k
//! = ∞ is no special case.
//!
//! The papers join *directly h_k-reachable* subgoals instead: h_k is the cost of an optimal path, and no
//! third subgoal is on one. Such graphs have more edges the larger k is. Here the graphs at centers have
//! these edges, and those of [`Hierarchy::Levels`] for finite k, to reproduce the papers' figures.
//!
//! # Why paths are optimal
//!
//! Contracting a subgoal removes it from the graph, and adds a shortcut between two of its neighbors if the
//! shortest path between them led over it. Paths are compared by the pair (h_k, Euclidean length), in exact
//! integers. So the lexicographically shortest paths are taut, and two arcs that meet in a bend that is not
//! taut need no shortcut. A query searches up the hierarchy from both ends and skips arcs at bends that no
//! shortest path makes.
//!
//! # Why queries are fast
//!
//! The subgoals that a vertex sees are found row by row, by words of cells, and eight rows at once where all
//! cells are free ([`VisibilitySweep`](mediant_grid::sight::VisibilitySweep)). At centers they are found by
//! scanning the bits of rows, columns and diagonals. The work follows what is visible, not 2^k. Times, and
//! what became of the claims of Hormazábal et al., are in `docs/measurements/subgoal.md`.
//!
//! # Hub labels
//!
//! [`PreparedSubgoals::within`] makes [`HubLabels`] of the contraction where they fit in a budget of memory.
//! Where they do not, it keeps the contraction, or nothing if an engine that prepares nothing is faster. A
//! label is a list of hubs with distances; the distance between two subgoals is the least sum over a common
//! hub. The subgoals that each vertex sees are stored as well, so neither end needs geometry. `labels/mod.rs`
//! defines the hubs, and proves that no shortest path is lost. [`Goals`] answer one start to many goals, and
//! the nearest of many.
//!
//! # What this crate does not do
//!
//! It reads and writes no files: a graph is converted to bytes and back. When the map changes, it repairs
//! graphs with levels alone, by a [`LevelRecord`], at corners and for finite k. Contraction hierarchies and
//! labels it does not repair; but those of an [`EarlierMap`] answer most queries still, exactly. It uses one
//! thread, unless the feature `parallel` is on; then it finds edges and contracts subgoals in rayon's current
//! pool. The graph is the same.

mod arc;
mod bends;
mod bounds;
mod build;
mod centers;
mod chunks;
mod clearance;
mod codec;
mod cones;
mod contract;
mod corners;
mod costs;
mod direct_reachability;
mod earlier;
mod edge_path;
mod error;
mod graph;
mod hierarchy;
mod labels;
mod levels;
mod parts;
mod placement;
mod planner;
mod prepared;
mod progress;
#[cfg(doctest)]
mod readme;
mod seen;
mod subgoals;
mod theta;
mod worth;

pub use earlier::{EarlierMap, EarlierSearch};
pub use error::SubgoalError;
pub use graph::SubgoalGraph;
pub use hierarchy::Hierarchy;
pub use labels::{Goals, GoalsError, HubLabelSearch, HubLabels};
pub use levels::LevelRecord;
pub use placement::SubgoalPlacement;
pub use planner::SubgoalAStar;
pub use prepared::PreparedSubgoals;
pub use progress::{Progress, Stage};
pub use theta::SubgoalTheta;
pub use worth::Counted;
