//! How the goal lies from a vertex: by which moves a path comes to it where nothing is in the way.

use mediant_grid::{GridGraph, Placement, Vector};
use mediant_moves::FiniteK;

/// The canonical path to the goal on an empty grid that begins with a given odd move: its two straight legs.
#[derive(Clone, Copy)]
pub(super) struct GoalLegs {
    /// How often the odd move is taken.
    pub(super) diagonal: u32,
    /// The even move that follows.
    pub(super) index: usize,
    /// How often that is taken.
    pub(super) axial: u32,
}

impl GoalLegs {
    /// The legs to a goal in this direction, if it lies between the odd move and one of the even moves beside
    /// it.
    #[inline]
    pub(super) fn new<P: Placement>(
        graph: &GridGraph<P>,
        d: Vector,
        (index, [before, after]): (usize, [usize; 2]),
    ) -> Option<Self> {
        let u = graph.step(index).vector();
        // Less than a right angle lies between a move and the legs that begin with it.
        if dot(u, d) <= 0 {
            return None;
        }
        // Moves are ordered by their angle, so the sign says on which side of the odd move the goal lies.
        // Adjacent moves span a parallelogram of area 1: this is Cramer's rule without its denominator.
        let across = cross(u, d);
        let index = if across > 0 { before } else { after };
        let diagonal = cross(d, graph.step(index).vector()) * if across > 0 { 1 } else { -1 };
        let legs = || Self { diagonal: diagonal as u32, index, axial: across.unsigned_abs() };
        (diagonal > 0).then(legs)
    }
}

/// How the goal lies from a node, for k ≤ 3: straight ahead by one even move, or by the legs of one odd move.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ToGoal {
    /// The move that leads there or that begins the legs.
    pub(super) index: usize,
    /// Its steps; 0 if there is no goal, or if the node is there.
    pub(super) steps: u32,
    /// The move of the second leg, and its steps.
    pub(super) then: (usize, u32),
}

impl ToGoal {
    /// The moves to a goal in this direction.
    #[inline]
    pub(super) fn new(d: Vector, k: FiniteK) -> Self {
        let ((index, steps), (x, y)) = (Self::first(d, k), d.abs());
        if k == FiniteK::N4 {
            let vertical = if d.y > 0 { 0 } else { 2 };
            return Self { index, steps, then: if x == 0 { (index, 0) } else { (vertical, y) } };
        }
        if index & 1 == 0 {
            return Self { index, steps, then: (index, 0) };
        }
        let (vertical, horizontal) = (if d.y > 0 { 0 } else { 4 }, if d.x > 0 { 2 } else { 6 });
        Self { index, steps, then: (if x > y { horizontal } else { vertical }, x.abs_diff(y)) }
    }

    /// The first of these moves, and its steps.
    #[inline]
    pub(super) fn first(d: Vector, k: FiniteK) -> (usize, u32) {
        let (x, y) = d.abs();
        if k == FiniteK::N4 {
            let (vertical, horizontal) = (if d.y > 0 { 0 } else { 2 }, if d.x > 0 { 1 } else { 3 });
            return if x == 0 { (vertical, y) } else { (horizontal, x) };
        }
        // The moves by the signs of y and x, four bits each. (At the goal it is any one.)
        let signs = 3 * d.y.signum() + d.x.signum() + 4;
        let index = (0x1_0724_6345_u64 >> (4 * signs) & 7) as usize;
        let diagonal = x.min(y);
        (index, if diagonal == 0 { x + y } else { diagonal })
    }

    /// The number of steps to the goal by an even move, if it is straight ahead.
    #[inline]
    pub(super) fn straight(&self, index: usize) -> Option<u32> {
        (self.index == index && self.steps > 0).then_some(self.steps)
    }
}

#[inline]
pub(super) fn dot(v: Vector, d: Vector) -> i32 {
    v.x * d.x + v.y * d.y
}

#[inline]
pub(super) fn cross(v: Vector, d: Vector) -> i32 {
    v.x * d.y - v.y * d.x
}
