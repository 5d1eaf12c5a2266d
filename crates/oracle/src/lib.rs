//! Slow, obvious references against which every engine is tested.
//!
//! **The key decision: nothing here is clever, and no code is shared with what is tested.** The map and the
//! names of the rules come from `mediant-grid`, plain vectors and the number k from `mediant-moves`.
//! Legality, neighborhoods and searches are written anew from their definitions, so that the reference does
//! not repeat the errors of an engine.
//!
//! * [`segment_is_legal`], [`vertex_is_free`], [`turn_is_legal`]: the rules of motion. A segment is clipped
//!   against every cell around it, in exact fractions.
//! * [`neighborhood`]: the moves of N(k), by inserting mediants.
//! * [`Explicit`]: Dijkstra's algorithm on the graph of all legal moves, for every k and for any-angle paths.
//! * [`Visibility`]: the same costs under corner placement from the visibility graph of the obstacles' convex
//!   corners, one graph for all k.
//! * [`PointVisibility`]: any-angle costs between points anywhere in free space, in 1/1024 of a cell, from
//!   the same graph. [`segment_between_points_is_legal`], [`turn_at_point_is_legal`] and [`point_is_free`]
//!   are the rules of motion for them, [`validate_between_points`] checks a path, [`random_point`] draws
//!   points of every [`PointKind`] from a seed. [`magnified`]: a map whose vertices are points of another
//!   one.
//! * [`WeightedGraph`]: Dijkstra's algorithm where cells have a cost a unit of length, a [`WeightedMap`], and
//!   [`Shares`]: the exact integral of this cost along a segment. [`random_weighted`]: such maps from a seed.
//! * [`validate`]: checks that a path is legal and has the stated cost.
//! * [`random_grid`], [`wide_grid`], [`Case`] and the generators behind them: maps and queries from a seed.
//!   [`seeds`] are those of a suite. [`random_change`]: edits of them.
//! * [`Surface`] and [`heights`]: cost surfaces and elevations of any size, from a seed.
//! * [`check_interrupts`]: that work can be stopped anywhere, and then stops.
//! * [`describe`]: the query and its map, for the message of a failing test.
//!
//! Speed is no aim: it is meant for small maps.
//!
//! ```
//! use mediant_grid::{AsciiMap, CornerRule, Rules};
//! use mediant_moves::FiniteK;
//! use mediant_oracle::{Explicit, validate};
//!
//! let map = AsciiMap::parse("
//!     s..
//!     .#g
//! ")?;
//! let (rules, k) = (Rules::Center(CornerRule::Never), FiniteK::N8);
//! let (start, goal) = (map.mark('s').unwrap(), map.mark('g').unwrap());
//! let graph = Explicit::new(&map.grid, rules, Some(k));
//! let costs = graph.costs_from(start);
//! assert_eq!(costs.to(goal), Some(3.0));
//! let path = costs.path_to(goal).unwrap();
//! assert_eq!(validate(&map.grid, rules, Some(k), start, goal, &path, 3.0), Ok(()));
//! # Ok::<(), mediant_grid::GridError>(())
//! ```

mod case;
mod dijkstra;
mod edits;
mod generate;
mod geometry;
mod graph;
mod interrupts;
mod legality;
mod neighborhood;
mod points;
mod random;
mod surfaces;
mod validate;
mod visibility;
mod weighted;

pub use case::{Case, describe, every, is_exhaustive, maps_of_nine_cells, on_all_cores, seeds};
pub use dijkstra::{Costs, Explicit};
pub use edits::random_change;
pub use generate::{
    adversarial, caves, maze, noise, random_free_vertex, random_grid, random_vertex, rooms, sparse,
    suite_grid, wide_grid,
};
pub use interrupts::check_interrupts;
pub use legality::{is_gap, segment_is_legal, turn_is_legal, vertex_is_free};
pub use neighborhood::neighborhood;
pub use points::{
    PARTS_PER_CELL, Parts, PointCosts, PointFault, PointKind, PointVisibility, describe_points, magnified,
    point_is_free, random_free_point, random_point, segment_between_points_is_legal, turn_at_point_is_legal,
    validate_between_points,
};
pub use random::Rng;
pub use surfaces::{Surface, heights};
pub use validate::{Fault, validate};
pub use visibility::{Visibility, VisibilityCosts, VisibilityGraph};
pub use weighted::{
    Integral, Piece, Shares, WeightedGraph, WeightedMap, random_weighted, weighted_costs, weighted_lengths,
    weighted_path_cost, weighted_path_length,
};
