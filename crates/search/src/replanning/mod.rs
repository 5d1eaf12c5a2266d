//! Replanning over N(k): searches that keep what they know while the map changes, for every k, both
//! placements and all rules of motion.
//!
//! - [`LpaStar`] is LPA* (Koenig, Likhachev & Furcy 2004): a start and a goal that stay where they are.
//! - [`DStarLite`] is D* Lite (Koenig & Likhachev 2002, the optimized version with k_m): the start moves, as
//!   a robot does that uncovers its map on the way.
//!
//! Both are the same search (`search.rs`) from a *root* to a *target*. LPA* searches from the start to the
//! goal; D* Lite searches from the goal to the start, so that its distances hold wherever the robot goes.
//! Moves are legal in reverse, at the same cost: predecessors and successors are the same.
//!
//! A vertex has two values: g, its distance from the root as last settled, and rhs, what its neighbors' g say
//! that it is. Where the two differ it is in the open list. A change of the map alters the rhs of the
//! vertices beside the changed moves, and the search settles what follows from that, as far as the target
//! needs it.
//!
//! **The key decision: no edge is stored, and the moves that matter are found.** 2^k moves a vertex are too
//! many to store, and many sweep one cell: at k = 7 more than a thousand, at k = 12 some 240,000. The
//! footprints of all moves, turned round, name the moves that may sweep a changed cell, by offsets from it
//! (`reach.rs`). Few of them matter, and which ones the values tell (`change.rs`):
//!
//! - *A cell was blocked.* Moves became illegal. A node knows the move by which it has its rhs. While that
//!   one is legal, others may go as they please. So one move a vertex is looked at, instead of 2^k.
//! - *A cell was freed.* Moves became legal. One matters if it lowers the rhs of one of its ends. That is a
//!   comparison of sums, which few moves pass, and only of these the cells are looked at.
//! - *Costs changed* ([`MoveCosts`]), or a closed gap came or went. All moves of the vertices are compared,
//!   before and after: the grid graph of the map before is still there.
//!
//! The same move tells whether a node is concerned when a neighbor turns out to be farther: the published
//! algorithms ask whether the sums are equal, which is true of many neighbors on open ground, where many
//! paths are equally long. Each question is a look at 2^k moves.
//!
//! Of a node nothing else is stored: g, rhs, a move, and a slot of the open list are 24 bytes.
//!
//! **Exact costs.** g, rhs and keys are integers ([`Cost`](mediant_moves::Cost)), so 'the two differ' needs
//! no tolerance. h_k is the cost of a path on an empty grid in the same integers. So it is a lower bound, and
//! h(s, s″) ≤ h(s, s′) + h(s′, s″) holds to the last bit: this is what D* Lite needs for the keys of an open
//! list in which the target has moved since.
//!
//! **Keys of 16 bytes.** A key is min(g, rhs) + h + k_m, then min(g, rhs), and here the second part counts
//! whole cells. That suffices. The second part has one task: of two vertices on a path whose first parts are
//! equal, the one nearer to the root comes first. No move is shorter than 1 cell, so their second parts
//! differ by 1 cell or more, and so do the whole cells. Vertices that still tie are taken by their number:
//! the order is total, and the same on every platform.
//!
//! **Closed gaps.** Whether a path may go on from a gap depends on how it came there, while g and rhs are
//! values of a place alone. So a gap is two nodes, one for each free quadrant (module `gap_nodes`), and a
//! move joins the nodes of the quadrants in which it lies. Paths in this graph are exactly those that closed
//! gaps allow. It does not depend on the goal, and no k is special. A path starts and ends at a gap in the
//! quadrant of the vertex's own cell, which is that of the lower node if it is free. Where a gap comes or
//! goes, all moves of the vertex join other nodes, and count as changed.
//!
//! **Ties.** Of several shortest paths the one is taken that, followed from the target, goes straight on
//! where it can and else takes the move of the lowest index.
//!
//! **When it is not worth it.** Large changes are searched anew (`change.rs`). Where the ground ahead is
//! free, A* goes straight to the goal, and is faster from k = 4 on: see `docs/measurements/replanning.md`.

mod change;
mod costs;
mod d_star_lite;
mod lpa_star;
mod nodes;
mod reach;
mod search;
#[cfg(test)]
mod tests;

pub use self::{
    costs::{Lengths, MoveCosts},
    d_star_lite::DStarLite,
    lpa_star::LpaStar,
};
