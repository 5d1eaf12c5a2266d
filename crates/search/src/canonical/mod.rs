//! Canonical A*(k) (Rivera, Hernández & Baier 2017, 'Canonical Orderings for 2^k'): of all paths that differ
//! only in the order of their moves, or by a detour that two consecutive moves reveal, the search follows
//! one.
//!
//! # The rule
//!
//! Rank the moves: those with an even index before those with an odd one, then by index. The ranks order all
//! paths between the same two vertices. Of two different paths the *earlier* one is
//! - the cheaper one;
//! - at equal cost, the one whose last move has the lower rank;
//! - at equal last moves, the one that is earlier without its last move.
//!
//! (Costs are integers, so 'equal' is well defined.)
//!
//! **Pruning.** A node was reached from vertex u by move a. Its successor by move b is pruned **if a legal
//! path from u with displacement a + b is earlier than the path a, b**.
//!
//! **Replacement.** A path to a vertex that is known already replaces the known path if it is cheaper, or if
//! it costs the same and its last move has the lower rank. If the vertex is closed, it is expanded again.
//!
//! # Why an optimal path always survives
//!
//! Let P be the earliest of all optimal paths from start to goal. 'Earlier' is a total order, and it compares
//! paths from their ends backwards: if a prefix of a path is exchanged for an earlier one, the whole path
//! becomes earlier. Hence *every prefix of P is the earliest of all optimal paths to its own end*; otherwise
//! exchanging it would make P earlier.
//!
//! 1. No successor along P is pruned. Let a, b be two consecutive moves of P. If a path with displacement a +
//!    b were earlier than a, b, then exchanging a, b for it would make the prefix of P that ends with b
//!    cheaper or earlier.
//! 2. The last move of a prefix has the lowest rank among the last moves of *all* optimal paths to the vertex
//!    where it ends. So once the search has reached that vertex at the optimal cost by that move, no other
//!    path replaces this one. If it has first reached the vertex by an optimal path with another last move,
//!    the prefix replaces that path. Successors depend on the vertex and the last move alone, so no sets of
//!    successors need to be united.
//! 3. By induction along P, each of its vertices is at some time in the open list with its optimal cost and
//!    with the move of P, and its expansion generates the next vertex of P. Until the goal is taken, some
//!    vertex of P is in the open list, with an f of at most the optimal cost. So the goal is not taken at a
//!    greater cost. ∎
//!
//! The proof does not say *which* alternative paths the search looks for: every choice is exact, and more
//! alternatives prune more. Here they are the single moves, the pairs of moves, and the cheapest path on an
//! empty grid in its plainest orders (module `alternatives`).
//!
//! On open ground this leaves the *natural* successors: an odd move is followed by itself and by its two
//! neighbors, an even move by itself alone. These are the bidimensional and the unidimensional nodes of the
//! paper; its canonical paths take their odd moves first. Every other successor is *forced*: it is kept
//! because obstacles block every alternative. A vertex with a forced successor is a jump point.
//!
//! The paper prunes by another rule, that of the jump points of the 8-neighborhood ([`PaperCanonical`]),
//! which is not optimal. With cell (1, 1) blocked, k = 4, from (0, 0) to (3, 1), the optimal path turns at
//! (1, 0), where no arrival on the 8-neighborhood has a forced successor.
//!
//! # How successors are found
//!
//! - k ≤ 3: a table gives the successors for each arriving move and each pattern of cells around the vertex
//!   (module `pattern_table`).
//! - 4 ≤ k ≤ 8: for each arriving move there is a tree over its possible forced successors, tested with words
//!   of the map (module `forced_trees`). From k = 7 on the tree only says whether there is a forced
//!   successor, and where there is one canonical A* takes all legal moves. That is faster than to find out
//!   which of them are forced, and just as exact.
//! - k ≥ 9: near corners of obstacles nothing is pruned. Trees would take hundreds of megabytes.
//!
//! For k ≥ 4 two bytes a vertex store the distances to the nearest obstacle and to the nearest corner of one
//! (module `clearance`). Far from corners, also along walls, there are no forced successors; on open ground
//! not even legality is tested. A cache keeps the trees' results by vertex and arriving move (module
//! `forced_cache`). Both follow an edit of the map by work that follows the edit: distances change where they
//! must, and versions of the map share what is known of vertices that the edit does not reach.
//!
//! # Closed gaps
//!
//! Under `DiagonalGap::Closed` no path passes a gap, and a path may end at one only through one quadrant. So
//! an alternative path also requires that the vertices it passes are no gaps. A node whose predecessor is a
//! gap (the start), or that is near a goal which is a gap, is not pruned. At k = 2, where paths may pass
//! gaps, nothing is pruned on a map with gaps.

mod alternatives;
mod cells;
mod clearance;
mod forced_cache;
mod forced_trees;
mod order;
mod paper;
mod pattern_table;
mod planner;
mod pruning;
mod rule;
#[cfg(test)]
mod tests;

pub(crate) use order::rank;
pub use paper::PaperCanonical;
pub(crate) use pattern_table::{PatternTable, pattern_at};
pub use planner::Canonical;
pub use pruning::Pruning;
pub(crate) use pruning::prunes;
pub use rule::CanonicalRule;
