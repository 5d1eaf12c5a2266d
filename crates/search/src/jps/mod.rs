//! Jump point search (Harabor & Grastien 2011, 2014; Hammoud & Lupin 2023), for every k: canonical A*(k) that
//! scans vertices without forced successors instead of queueing them.
//!
//! The successors of a node, and which vertices have forced ones, follow the rule of
//! [`canonical`](crate::canonical), and so does the proof. Only *jump points*, which are the vertices with a
//! forced successor, and the goal become nodes. At any other vertex a path has only its natural successors:
//! one after an even move, three after an odd one. These are followed at once, by *jumps*.
//!
//! An *axial* jump repeats an even-indexed move until its first jump point. A *diagonal* jump repeats an
//! odd-indexed move; from each of its vertices it makes the axial jumps of the two even moves beside it, and
//! where one of these finds a jump point, the vertex is an *intermediate* jump point. (At k = 3 these are the
//! jumps along axes and diagonals of the original, and under `Never` its jump points. Nothing here is special
//! about k = 3 or about any rule of motion; for other k 'axial' and 'diagonal' just mean even and odd.)
//!
//! The engines differ in the [`JumpFinder`]:
//!
//! | engine | axial jumps | diagonal jumps | k |
//! |---|---|---|---|
//! | [`Jps`] | vertex by vertex; far from obstacles several at once | vertex by vertex | all |
//! | [`BlockJps`] | 64 vertices a word operation (module `axial`) | likewise (module `diagonals`) | 2, 3 |
//! | [`JpsPlus`] | from jump points looked up ([`JumpTable`], module `lists`), else as `BlockJps` | likewise | 2, 3 |
//!
//! **Intermediate jump points** (Harabor & Grastien 2014) are pruned by default: what an axial jump beside a
//! diagonal one finds becomes the successor, and the vertex between becomes no node. The path is put together
//! again from its two legs.
//!
//! **Cut jumps.** Jumps from different nodes scan the same places, and find the same jump points again and
//! again; on open ground with few obstacles that is almost all of the work. So a diagonal jump ends at vertex
//! p, without a node, if an axial jump from there leads to a jump point s, n steps away, to which a path is
//! known that
//! - costs no more than the one through p, and ends with more than n steps of the same move. It leads
//!   through p as well, where it costs no more than the diagonal jump does, and its last move there has an
//!   even index, so it is the earlier one of the two in the order of [`canonical`](crate::canonical). Or that
//! - costs so much less that p is reached at a lower cost by it and back from s to p.
//!
//! Either way the earliest path to p is not this jump. Every prefix of the earliest optimal path is the
//! earliest optimal path to its own end, so that does not reach p by this jump, and nothing is lost. (The
//! idea to constrain jumps by what is known is that of Zhao, Harabor & Stuckey 2023; the tests here need
//! nothing but the node of s.) The axial jumps of a node are made first: what they find may cut the others.
//!
//! **A goal in sight** ([`BlockJps`], [`JpsPlus`]). If the path to the goal that goes on by one of the moves
//! from a node, and then straight on by a move beside it, has nothing in its way, no path from the node to
//! the goal is cheaper. Paths that cost as much have the same moves in another order, so it is the earliest
//! of them: all of its odd moves come first. So no jump need be made from there.
//!
//! **Dead ends.** Most jump points on maps of games are dead ends: from there a path can only go straight on,
//! or comes to an end near by. [`BlockJps`] and [`JpsPlus`] pass them, but for those near the goal. The
//! module `dead_ends` defines them, and proves that nothing is lost.
//!
//! **Bounded jumps** (Sturtevant & Rabin 2016): a jump of more steps than the jump limit ends in a node, from
//! which the search goes on. From k = 9 on, where forced successors are not tabulated, every jump ends so
//! after one step.
//!
//! The speed comes from: bit planes that combine the three rows of cells along an axial jump, so that a scan
//! loads one row; bit planes that hold each diagonal in the order of a jump, with the places where it stops
//! and which axial jump leads on from there; cut jumps; passing dead ends; one loop over the jumps of a node,
//! in which all that a search or a node has in common is found before; and, for JPS+, lists of where all
//! jumps from a jump point lead, so that nothing is scanned. For k ≥ 4 there are no such planes, but a vertex
//! is tested for forced successors only once. From k = 6 on canonical A* is faster: scanning costs more than
//! the saved nodes. Figures: `docs/measurements/search.md`.

mod axial;
mod block_finder;
mod cell_rows;
mod dead_ends;
mod diagonals;
mod error;
mod finder;
mod lists;
mod planes;
mod planner;
mod repair;
mod stop_rows;
mod table;
mod table_finder;
mod to_goal;
mod zone;

#[cfg(test)]
mod tests;

/// The stage that an interrupted call names.
const DURING: &str = "finding where jumps lead";

pub use block_finder::BlockFinder;
pub use error::JumpError;
pub use finder::{JumpFinder, StepwiseFinder};
pub use planner::{BlockJps, Jps, JpsPlus, JumpPointSearch};
pub use table::JumpTable;
