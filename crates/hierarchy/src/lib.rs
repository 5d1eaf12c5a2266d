//! Hierarchical path planning, HPA* and CHPA*: paths that are nearly as short as the shortest, on maps that change.
//!
//! An index tells what crossing a part of the map takes. A planner finds its way from part to part, and then through each. Nothing in an index depends on cells that are far away, so
//! that it is *repaired* where the map changed, and then equal to a new one.
//!
//! | paper | index | planner |
//! |---|---|---|
//! | Botea, Müller & Schaeffer 2004, HPA* | [`ClusterGraph`]: clusters, transitions, costs between them, on one or more levels | [`HpaStar`] |
//! | Teleiša & Čalnerytė 2023, CHPA* | [`SegmentGraph`]: segments, and which neighbors a path through a sliding window joins | [`ChpaStar`], as published or [complete](FallbackPolicy) |
//!
//! ```
//! use std::sync::Arc;
//! use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph, Rectangle};
//! use mediant_hierarchy::{ClusterGraph, Clustering, HpaStar};
//! use mediant_moves::FiniteK;
//! use mediant_search::{Planner, Query};
//!
//! let map = AsciiMap::parse("
//!     ..#..
//!     ..#..
//!     ..#..
//! ")?;
//! let grid_graph = |grid| GridGraph::<Centers>::new(Arc::new(grid), FiniteK::N8, CornerRule::Never);
//! let before = Arc::new(grid_graph(map.grid.clone())?);
//! let graph = Box::new(ClusterGraph::new(&before, Clustering { side: 2, levels: 1 })?);
//! let mut planner = HpaStar::new(before, graph)?;
//! let query = Query::new((0, 0), (4, 0));
//! assert_eq!(planner.solve(query)?.path(), None);
//!
//! // A door opens.
//! let door = Rectangle { x: 2, y: 2, width: 1, height: 1 };
//! let after = Arc::new(grid_graph(map.grid.with_rectangle(door, |_, _| false))?);
//! planner.repair(after, door)?;
//! assert!(planner.solve(query)?.path().is_some());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **The key decision: what is stored follows from the map alone, part by part.** No numbering, no order of work and no history enters an index. So 'a repaired index equals a rebuilt one'
//! is a comparison of values, and repairing is making anew what the changed cells can have touched.
//!
//! **How good, how fast.** `cargo xtask reproduce-tables --only hpa-games teleisa2023` measures it; lengths and counts are the same on every machine. HPA* with its default clustering on all maps of four sets
//! of games, each 100th instance, means over the maps:
//!
//! | k | set | as refined, longer than optimal | smoothed | worst map | fewer nodes than A* | less time |
//! |--:|---|--:|--:|--:|--:|--:|
//! | 2 | bg512 | 0.94 % | 0.27 % | 1.42 % | 51 × | 16 × |
//! | 2 | dao | 4.69 % | 0.37 % | 4.44 % | 17 × | 8.6 × |
//! | 2 | sc1 | 1.45 % | 0.22 % | 0.77 % | 71 × | 25 × |
//! | 2 | wc3maps512 | 1.09 % | 0.25 % | 0.61 % | 44 × | 14 × |
//! | 3 | bg512 | 4.12 % | 0.23 % | 1.09 % | 47 × | 13 × |
//! | 3 | dao | 6.69 % | 0.36 % | 4.96 % | 12 × | 7.0 × |
//! | 3 | sc1 | 3.88 % | 0.25 % | 0.63 % | 56 × | 24 × |
//! | 3 | wc3maps512 | 3.81 % | 0.26 % | 0.67 % | 36 × | 13 × |
//!
//! (Its authors: within 1 % of optimal after smoothing, up to ten times faster than A*. In noise, on random512-10-0, it is 1.5 % longer and 3.7 times as fast.)
//!
//! On Moscow_2_1024, 1024 × 1024 cells, k = 3, one core, an index takes 31 ms to make (CHPA*: 41 ms). Repairing it after a square of 10 × 10 cells changed takes 0.2 ms in the mean of 300,
//! 0.4 ms at most (CHPA*: 0.01 ms); on random512-10-0 0.3 and 0.6 ms. (The first in a process, whose memory is new, took 2 ms.) The new grid takes 0.02 ms (0.1 where its memory is new), the new grid graph 0.4 ms, on other maps of this size up to 0.9 ms.
//!
//! **What Teleiša & Čalnerytė 2023 claim** stands beside what is found in `docs/results/teleisa2023.md`, and where it differs, with the causes, in `docs/results/deviations.md`. In short, on
//! their four maps of 768 × 768 tiles, 200 instances of each drawn as they say, k = 2: CHPA*'s paths are 1.6 % longer than optimal (theirs: 2 to 4 %), with 87 % fewer nodes than A* by the
//! Manhattan distance (over 80 %) and 88 % less time (97 %: the time follows the nodes here, theirs does not). A* by the squared Euclidean distance is theirs only if closed nodes stay
//! closed; reopened, it would be 11 % longer and expand twice as many. With one end of a wall first, in the place of its middle, paths are 1.8 to 1.9 % longer than optimal.
//!
//! As published, CHPA* finds no path for 6 of the 800 instances. Complete, it finds all, at the price of 7 % more nodes. How much longer than optimal complete CHPA*'s paths are
//! depends on the map more than all else: at k = 3, on each 40th instance, 0.8 % on set street, 1.8 % on bg512, 3.5 % on sc1, 4.4 % on dao, 8 % on wc3maps512, 18 % on random and 31 % on
//! room; those of HPA* 0.1 to 0.5 %, on random 1.1 % (`cargo xtask verify --every 40 --engine hpa chpa`).
//!
//! What is not here: files. An index comes and goes as bytes.

mod bytes;
mod check;
mod chpa;
mod error;
mod hpa;
mod straighten;
mod window;

pub use chpa::{ChpaStar, FallbackPolicy, SegmentGraph};
pub use error::HierarchyError;
pub use hpa::{ClusterGraph, Clustering, HpaStar};
