//! Arcs of the graph that is contracted.

/// An arc of the overlay graph, which holds the subgoals that are not contracted yet: an edge or a shortcut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct OverlayArc {
    pub(crate) cost: u128,
    pub(crate) to: u32,
    /// The contracted subgoal that a shortcut passes; [`NONE`](crate::arc::NONE) for an edge.
    pub(crate) middle: u32,
    /// The end of the first edge of the path that the arc stands for.
    pub(crate) first: u32,
    /// The beginning of its last edge.
    pub(crate) last: u32,
}
