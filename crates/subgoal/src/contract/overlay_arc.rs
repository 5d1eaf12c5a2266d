//! Arcs of the graph that is contracted.

use crate::arc::NONE;

/// An arc of the overlay graph, which holds the subgoals that are not contracted yet: an edge or a shortcut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct OverlayArc {
    pub(crate) cost: u128,
    pub(crate) to: u32,
    /// The contracted subgoal that a shortcut passes; [`NONE`] for an edge.
    pub(crate) middle: u32,
    /// The end of the first edge of the path that the arc stands for.
    pub(crate) first: u32,
    /// The beginning of its last edge.
    pub(crate) last: u32,
}

impl OverlayArc {
    /// No arc.
    pub(super) const NONE: Self = Self { cost: 0, to: NONE, middle: NONE, first: NONE, last: NONE };
}
