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
//! use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace};
//! use mediant_moves::K;
//! use mediant_search::{Planner, Query};
//! use mediant_subgoal::{Hierarchy, SubgoalAStar, SubgoalGraph};
//!
//! let map = AsciiMap::parse("
//!     ......
//!     .####.
//!     ......
//! ")?;
//! let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
//! let graph = SubgoalGraph::new(&space, K::Any, Hierarchy::Contracted)?;
//! let mut planner = SubgoalAStar::new(&space, &graph);
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
//! (Hormazábal's graph, of directly h_k-reachable subgoals, has at k = 9 one and a half to three times as many edges. It is what
//! [`Hierarchy::Levels`] makes, for the papers' figures.)
//!
//! **How it is exact.** A hierarchy takes subgoals out of the graph and adds shortcuts where a lightest way led over them. Ways are weighed by
//! (h_k, Euclidean length), so that the lightest are taut, and pairs of arcs that make no taut bend need no shortcut. A query goes up from both ends
//! (`planner.rs`), at any angle along taut bends only.
//!
//! **How it is fast.** What a vertex sees is found row by row, by words of cells and eight rows at once where nothing is in the way
//! ([`VisibilitySweep`](mediant_search::VisibilitySweep)); at centers, along the straight lines of cells (`lines.rs`). On AR0011SR, at any angle, that
//! is half of a query; it builds the edges of the maps of 1024 × 1024 cells in 30 to 40 ms. Measured on the way, in µs a query at any angle (from several runs, all
//! but the last with other work beside them):
//!
//! | | AR0011SR | Moscow_2_1024 | ArcticStation |
//! |---|--:|--:|--:|
//! | contracted, one-sided A*, all arcs | 33 | 321 | 159 |
//! | both sides A*, each bounded by the other | 22 | 202 | 149 |
//! | the first look along the line from start to goal without divisions | 22 | 91 | 109 |
//! | only subgoals that taut paths pass; fans by eight rows, along walls without divisions | 17 | 79 | 106 |
//! | arcs only along taut bends | 14 | 52 | 47 |
//!
//! Contraction takes most of the preparation, which takes 7 to 162 ms on these maps. At k = 9, with directly reachable edges in the place of taut ones, it took 10 s
//! on ArcticStation and 37 s on Moscow_2_1024, and left 59 and 82 % of the subgoals. A budget of work bounds it, in noise above all.
//!
//! **What Hormazábal et al. 2017 claim, and what is found** (each 20th instance of eleven maps of games and two of rooms, corners, gaps open; against the Anya and
//! the Sub2-Theta* of this workspace, in one run):
//!
//! | claim | found |
//! |---|---|
//! | Sub2-A*(k) is faster than Sub2-Theta*, for every k | on every map, k = 3, 5, 7, 9: by 2.1 to 13, in the mean by 5 (k = 3) and 4 |
//! | an order of magnitude faster than ANYA, at most 0.0005 % longer with smoothing | k = 9: 0.00006 % longer, pulled taut, on the game maps. Faster by 5.1 in the mean (up to 14; smoothed 3.4, pulled taut 1.7) than our Anya, which itself takes 0.23 of the time of the Java one. At any angle, with nothing longer, by 5.9 (2 to 17). Against the Java Anya: by 24 |
//! | branching factor of rooms 5.3 at k = 3, 9.3 at k = 9 | all 40 maps, gaps open, highest of 2 levels: 5.3 and 8.6 in the mean of maps, 5.6 and 9.2 over all subgoals |
//! | of Baldur's Gate II 9.3 and 19.8 | all 75 maps of bg512: 5.6 and 12.6 in the mean, 6.7 and 16.5 over all subgoals; with one level 12.7 and 33.6. Which subgoals and maps the paper averages over it does not say |
//!
//! With the feature `parallel` edges are found on all cores.
//!
//! What is not here: files. A graph comes and goes as bytes.

mod centers;
mod codec;
mod contract;
mod corners;
mod direct;
mod error;
mod graph;
mod lines;
mod norm;
mod placement;
mod planner;
mod subgoals;
mod taut;
mod theta;
mod turns;

pub use error::SubgoalError;
pub use graph::{Hierarchy, Progress, Stage, SubgoalGraph};
pub use placement::SubgoalPlacement;
pub use planner::SubgoalAStar;
pub use theta::SubgoalTheta;
