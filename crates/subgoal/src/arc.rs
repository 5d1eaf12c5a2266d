//! The arcs of a subgoal graph.

use mediant_grid::Vector;

/// The number that stands for no subgoal.
pub(crate) const NONE: u32 = u32::MAX;

/// An arc of the graph, from a subgoal to one above it in the hierarchy, or between two subgoals of the core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct UpwardArc {
    pub(crate) cost: u64,
    pub(crate) to: u32,
    /// The middle node of a shortcut: the contracted subgoal that it passes. [`NONE`] for an edge.
    pub(crate) middle: u32,
    /// The first and the last edge of the path that the arc stands for.
    pub(crate) first: Step,
    pub(crate) last: Step,
}

impl UpwardArc {
    /// An arc whose cost and steps are still to be computed.
    pub(crate) const fn without_cost(to: u32, middle: u32) -> Self {
        Self { cost: 0, to, middle, first: Step(0, 0), last: Step(0, 0) }
    }
}

/// The displacement along an edge, in four bytes; zero if it does not fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Step(i16, i16);

impl Step {
    pub(crate) fn of(v: Vector) -> Self {
        let fits = v.x.abs().max(v.y.abs()) <= i32::from(i16::MAX);
        if fits { Self(v.x as i16, v.y as i16) } else { Self::default() }
    }

    /// The same edge in the other direction.
    pub(crate) const fn reversed(self) -> Self {
        // No component is the least `i16`: a side has at most 2¹⁵ cells, and 2¹⁵ does not fit.
        Self(self.0.wrapping_neg(), self.1.wrapping_neg())
    }

    /// The displacement, if it is known.
    #[inline]
    pub(crate) fn vector(self) -> Option<Vector> {
        (self != Self::default()).then(|| Vector::new(self.0.into(), self.1.into()))
    }
}

/// How a search reached a subgoal from its parent: the middle node of the arc, and the last edge of the path.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ParentEdge {
    pub(crate) middle: u32,
    pub(crate) last: Step,
}

/// An edge or a shortcut between two subgoals, in the direction in which a path follows it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PackedArc {
    pub(crate) from: u32,
    pub(crate) to: u32,
    /// [`NONE`] for an edge.
    pub(crate) middle: u32,
}
