//! Theta* (Daniel, Nash, Koenig & Felner 2010, 'Theta*: Any-Angle Path Planning on Grids') and Lazy Theta*
//! (Nash, Koenig & Tovey 2010, 'Lazy Theta*: Any-Angle Path Planning and Path Length Analysis in 3D') over
//! N(k), for every k, both placements and all rules of motion. (The papers have k = 3, at corners, gaps
//! open.)
//!
//! Rule variant: a vertex is expanded with all its legal moves. The parent of a successor is the parent of
//! the expanded node, if the straight segment from there keeps the rules of motion, and otherwise the
//! expanded node itself. Under closed gaps the turns of the path at the parent and at the goal must be legal
//! too.
//!
//! **Closed nodes stay closed**, as in the papers, though a cheaper path to one may be found: any-angle paths
//! are shorter than h_k. Reopening makes paths at most 1.6 % shorter and costs up to ten times the expansions
//! (`docs/measurements/search.md`).
//!
//! **Properties of the paths.**
//! - A path is found whenever there is one at any angle: whenever N(k) has one, since which vertices are
//!   reached does not depend on the parents; and at k = 2 where corners are always cut, whenever N(3) has
//!   one.
//! - No path is shorter than the any-angle optimum.
//! - With a consistent heuristic, as all admissible ones of this crate are, no path of Theta* is longer than
//!   the optimum over N(k). Take an optimal path over N(k) to a vertex s that is about to be expanded, and
//!   let m be its first vertex that is not closed. The predecessor of m was closed at no more than its
//!   optimal cost, so m has no more either (triangle inequality); and f(s) ≤ f(m) then implies the same of s.
//! - For Lazy Theta* the last statement is false: s may be expanded while its best neighbor is open. (In a
//!   random suite 51 of 13,698 paths were longer, by a quarter at most.)
//!
//! **Ties.** The order of the open list is that of all engines. Of equally cheap paths to a vertex the first
//! is kept; successors and closed neighbors are tried in the order of
//! [`GridGraph::for_each_legal_move`](mediant_grid::GridGraph::for_each_legal_move).

mod planner;
mod search;
mod sight_cache;
mod sight_check;

pub use planner::{LazyThetaStar, Theta, ThetaStar};
pub use sight_check::{Eager, Lazy, SightCheck};
