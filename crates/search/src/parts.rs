//! The parts of which the planners are made, for planners of one's own.
//!
//! - [`BestFirst`] is the search loop of A*, canonical A* and jump point search. With successors of one's own
//!   ([`Successors`]) it is a planner: see the example at [`BestFirst::with_successors`].
//! - [`OpenList`] with a [`NodeStore`] is the memory of a search on a grid graph; [`SearchTree`] is that of a
//!   search on any other graph of numbered nodes.
//! - [`JumpPointSearch`] is jump point search with any [`JumpFinder`]; [`Theta`] is Theta* with any
//!   [`SightCheck`].
//! - [`Metric`] is the length of a displacement where no obstacle is in the way.
//! - [`follow_line`] turns a line of sight into moves of N(k).
//! - [`count_work`] answers a query that can be stopped, and counts its work.
//! - [`Part`] is the observer of a part of a search.
//! - [`HasFreeSpace`] is what a planner needs to be generic over grid graphs and free spaces.

pub use crate::{
    astar::AllMoves,
    best_first::BestFirst,
    counted::count_work,
    jps::{BlockFinder, JumpFinder, JumpPointSearch, StepwiseFinder},
    line_path::{along_line, elbows, follow_line, leg_is_free, legs_are_free, push_waypoint},
    metric::Metric,
    nodes::{Node, NodeStore},
    observer::Part,
    open_list::{Entry, OpenList},
    parent::{JumpParent, ParentPointer},
    search_tree::SearchTree,
    segment::segment_cost,
    smoothing::HasFreeSpace,
    successors::{ExpandedNode, KnownPath, Successor, Successors},
    theta::{Eager, Lazy, SightCheck, Theta},
};
