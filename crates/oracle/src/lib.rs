//! Slow, obvious references that every engine is tested against.
//!
//! **The key decision: nothing here is clever, and nothing is shared.** From `mediant-grid` come the map and
//! the words for the rules, from `mediant-moves` the plain vector and the number k; legality, neighborhoods
//! and searches are written again, from the definitions, so that an error in an engine is not repeated by its
//! judge.
//!
//! * [`segment_is_legal`], [`vertex_is_free`], [`turn_is_legal`]: the rules of motion, by clipping a segment
//!   against every cell around it, in exact fractions.
//! * [`neighborhood`]: the moves of N(k), mediant by mediant.
//! * [`Explicit`]: Dijkstra on the graph of all legal moves, for every k and for any-angle paths.
//! * [`Visibility`]: the same costs at corners from the visibility graph of the obstacles' convex corners,
//!   one for all k.
//! * [`validate`]: whether a path is what a planner promised.
//! * [`random_grid`], [`wide_grid`], [`Case`] and the generators behind them: maps and queries from a seed,
//!   those of a suite from its [`seeds`].
//! * [`describe`]: what a failing test should say.
//!
//! What is not here: speed. Use it on small maps.
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
mod generate;
mod geometry;
mod legality;
mod neighborhood;
mod random;
mod validate;
mod visibility;

pub use case::{Case, describe, on_all_cores, seeds};
pub use dijkstra::{Costs, Explicit};
pub use generate::{
    adversarial, caves, maze, noise, random_free_vertex, random_grid, random_vertex, rooms, suite_grid,
    wide_grid,
};
pub use legality::{is_gap, segment_is_legal, turn_is_legal, vertex_is_free};
pub use neighborhood::neighborhood;
pub use random::Rng;
pub use validate::{Fault, validate};
pub use visibility::{Visibility, VisibilityCosts, VisibilityGraph};
