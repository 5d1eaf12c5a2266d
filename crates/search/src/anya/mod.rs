//! Anya (Harabor, Grastien, Öz & Aksakalli 2016, 'Optimal Any-Angle Pathfinding In Practice'): optimal paths
//! between corner vertices, at any angle or over N(k), found online, with nothing preprocessed.
//!
//! **Nodes.** A *root* is the start or a vertex at which paths turn. A *cone node* is what a root sees of
//! another horizontal line: an interval between two rays from the root, its ends included. A *flat node* is a
//! vertex of the root's own line at which a path may turn.
//!
//! f is the length of the path to the root plus that of the shortest path from there through the interval to
//! the goal, or to the mirror image of the goal where that lies on the near side of the line (Section 4.3).
//! It never falls from a node to its successors, and it is exact where the interval holds the goal. So the
//! first such node taken from the open list is optimal.
//!
//! **Successors.** A cone crosses the row of cells ahead of its line through the runs of free cells that it
//! enters:
//! - what the root sees of the next line through a run is an *observable* successor;
//! - what the corner of an obstacle hides of a run is a *non-observable* successor, whose root is that
//!   corner. The corner is an end of the interval with the obstacle on the near side of the line, or an end
//!   of the run that the ray passes inwards;
//! - around a corner on the near side the path may also turn onto the line itself: to a flat node at the next
//!   corner there.
//!
//! Every successor is *taut*: the path bends only around a corner of an obstacle, and towards it. Each
//! optimal path is a chain of such successors. The intervals of a root are closed, so a path that touches a
//! corner and goes straight on also 'turns' there by an angle of 0. Therefore intervals of width 0 need not
//! be kept.
//!
//! **Pruning.** A vertex that another root has reached as cheaply does not become a root again, and the nodes
//! of a root to which a shorter path was found are dropped (*root history*). Successors with nothing behind
//! them are not queued (*cul-de-sac*). While a node has just one successor, the search goes on with that
//! without queueing it (*intermediate*). Most lines have one successor and hide nothing: those are crossed by
//! additions and one word of cells (module `cone`).
//!
//! **Dead ends.** No shortest path enters a part of the map behind a straight door, unless it starts or ends
//! there. Where many queries are made on a map, these parts may be found beforehand, in some nanoseconds a
//! cell, and left out (module `dead_ends`): on maps of games often more than half of the nodes.
//!
//! **Over N(k).** Only lengths know the metric (module `norm`). With h_k for the Euclidean length the search
//! finds optimal paths over N(k); no publication has this search.
//! - *Paths.* h_k is a norm, so a path over N(k) costs no less than the path pulled taut, and moves of N(k)
//!   follow each of its lines of sight at the cost h_k (Kramm 2018, Lemma 13). So a taut path is optimal over
//!   N(k). The successors of a node are all taut continuations; they do not depend on lengths.
//! - *Bounds.* The length of a path from the root through a point of the interval to the goal is convex in
//!   the point. In every norm the straight way makes it least, and so the point of the interval nearest to
//!   that. h_k is computed there in fixed point, rounded down, and never below h_k from the root to the goal,
//!   which keeps ties exact. Where the interval holds the goal the bound is an exact integer.
//! - *Ties.* h_k is not strictly convex: a vertex may be reached at the same cost by many lines, of which one
//!   turns tautly towards the goal and another does not. So lengths are pairs of h_k and the Euclidean length
//!   of the line, compared in this order. Pulled taut, a line gets shorter by at least 1 / 4L³ for a bend
//!   between segments of length L from vertex to vertex: by over 2⁻⁴⁹ on the largest map. Lines have 60
//!   binary places. So the least path by these pairs is taut, and so is each part of it: whichever root the
//!   history keeps, the least path to it is among those kept. The open list compares by pairs, too. Otherwise
//!   vertices are reached by longer lines first and expanded again: in noise, 9 times as many nodes at k = 3.
//!
//! At k = 2 to 12 it expands about as many nodes as at any angle, and takes 1.03 (k = 2) to 1.35 (k = 12)
//! times as long in the mean of ten maps.
//!
//! **Gap rules.** Under [`DiagonalGap::Open`](mediant_grid::DiagonalGap::Open) a gap is a corner that hides
//! all of the run beyond it. Under [`DiagonalGap::Closed`](mediant_grid::DiagonalGap::Closed), the rule of
//! the paper, no path turns at one, and flat nodes end there. A start or goal that is a gap is left or
//! entered through the quadrant of its own cell.
//!
//! **Ends anywhere.** At any angle start and goal may be places between vertices, in 1/1024 of a cell. The
//! start's row of cells is crossed like any other. A goal between vertices lies on no line: a root sees it
//! through the interval before the row of cells that it touches, or from that row's border (module `goal`).
//! Then its node's f is exact, as where an interval holds the goal.
//!
//! **Exactness.** An interval end is the rational where a ray, stored as the vector between two places of
//! the map of which one is a vertex, meets a line. Its floor, its ceiling, and whether it is a vertex are
//! computed exactly; no two ends are ever compared within a tolerance. The proof, also that nothing
//! overflows on the largest map, is in [`mediant_grid::sight`]. At any angle lengths are sums of square
//! roots, in `f64`; over N(k) integers.
//!
//! **Ties.** The open list orders by f, then h (over N(k): then the line), then the age of the node.
//!
//! **Memory** follows the search, not the map: roots, nodes, and blocks of the root history (module
//! `history`).
//!
//! On eighteen benchmark maps it takes less than half the time of Polyanya in the geometric mean without dead
//! ends (`docs/performance.md`), and about as long with nothing prepared (`docs/measurements/compared.md`).
//! Times over N(k), and what was tried on the way, are in `docs/measurements/search.md`.

mod cone;
mod dead_ends;
mod frontier;
mod goal;
mod history;
mod norm;
mod planner;
mod search;

pub use dead_ends::DeadEnds;
pub use norm::{EuclideanNorm, LatticeNorm, Norm};
pub use planner::Anya;
