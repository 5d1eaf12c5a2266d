//! The moves of N(5), written out for a quadrant.

use super::{Scanner, Visit};
use crate::gaps::is_lower;

/// A vertex while it is scanned. `Q` is one of the quadrants of [`SIGNS`].
pub(super) struct Scan<'s, V> {
    pub(super) at: usize,
    /// The steps by 1, 2, 3 along each axis, forward and backward.
    pub(super) x: [[isize; 3]; 2],
    pub(super) y: [[isize; 3]; 2],
    pub(super) cost: u64,
    pub(super) weights: &'s [u32],
    pub(super) scanner: &'s Scanner,
    pub(super) visit: &'s mut V,
}

/// Whether the move along an axis that a quadrant visits is the one along x: each axis borders two quadrants.
const fn is_along_x(quadrant: usize) -> bool {
    matches!(quadrant, 0 | 3)
}

impl<V: Visit> Scan<'_, V> {
    /// Visits the moves in a quadrant. `gap` is the quadrant of a state at a closed gap.
    #[inline]
    pub(super) fn quadrant<const K: u32, const CENTER: bool, const Q: usize>(&mut self, gap: Option<bool>) {
        if CENTER { self.between_centers::<K, Q>() } else { self.between_corners::<K, Q>(gap) }
    }

    #[inline]
    fn weight(&self, step: isize) -> u32 {
        self.weights[self.at.wrapping_add_signed(step)]
    }

    /// Visits a move, by its number in the quadrant, with its sum of shares times weights.
    #[inline]
    fn relax<const Q: usize>(&mut self, number: usize, to: usize, sum: u64) {
        let cost = self.cost + self.scanner.near.factors[number].cost(sum);
        if cost < self.visit.known(to) {
            self.visit.relax(usize::from(self.scanner.near.index[Q][number]), to, cost);
        }
    }

    /// Visits a move between centers, with the share of the cells at its ends, and the sum of those between,
    /// which are free. Whether the last one is, its known cost says.
    #[inline]
    fn go<const Q: usize>(&mut self, number: usize, step: isize, share: u64, between: u64) {
        let ends = [0, step].map(|step| u64::from(self.weight(step)));
        self.relax::<Q>(number, self.at.wrapping_add_signed(step), share * (ends[0] + ends[1]) + between);
    }

    /// The moves between centers in this quadrant, with one of the two along its axes.
    #[inline]
    fn between_centers<const K: u32, const Q: usize>(&mut self) {
        let ([x1, x2, x3], [y1, y2, y3]) = (self.x[Q % 2], self.y[Q / 2]);
        if is_along_x(Q) {
            self.go::<Q>(0, x1, 1, 0);
        } else {
            self.go::<Q>(1, y1, 1, 0);
        }
        if K < 3 {
            return;
        }
        let [beside, below] = [x1, y1].map(|step| self.weight(step));
        if self.scanner.may_pass(beside, below) {
            self.go::<Q>(2, x1 + y1, 1, 0);
        }
        if K < 4 {
            return;
        }
        let across = self.weight(x1 + y1);
        let sum = |one: u32, other: u32| u64::from(one) + u64::from(other);
        let (is_wide, is_tall) = (beside > 0 && across > 0, below > 0 && across > 0);
        if is_wide {
            self.go::<Q>(3, x2 + y1, 1, sum(beside, across));
        }
        if is_tall {
            self.go::<Q>(4, x1 + y2, 1, sum(below, across));
        }
        if K < 5 {
            return;
        }
        let [wide, tall, far] = [x2 + y1, x1 + y2, x2 + y2].map(|step| self.weight(step));
        if beside > 0 && wide > 0 && self.scanner.may_pass(across, self.weight(x2)) {
            self.go::<Q>(5, x3 + y1, 1, 2 * sum(beside, wide));
        }
        if below > 0 && tall > 0 && self.scanner.may_pass(across, self.weight(y2)) {
            self.go::<Q>(6, x1 + y3, 1, 2 * sum(below, tall));
        }
        if is_wide && wide > 0 && far > 0 {
            self.go::<Q>(7, x3 + y2, 2, sum(beside, far) + 3 * sum(across, wide));
        }
        if is_tall && tall > 0 && far > 0 {
            self.go::<Q>(8, x2 + y3, 2, sum(below, far) + 3 * sum(across, tall));
        }
    }

    /// Visits a move between corners, with the cells that it crosses and their shares.
    #[inline]
    fn cross<const Q: usize, const N: usize>(&mut self, number: usize, step: isize, cells: [(u32, u32); N]) {
        if cells.iter().all(|&(weight, _)| weight > 0) {
            let sum = cells.iter().map(|&(weight, share)| u64::from(weight) * u64::from(share)).sum();
            let v = self.scanner.moves.all()[usize::from(self.scanner.near.index[Q][number])].vector;
            let to = self.scanner.gaps.state(self.weights, self.at.wrapping_add_signed(step), -v);
            self.relax::<Q>(number, to, sum);
        }
    }

    /// The moves between corners in this quadrant, with one of the two along its axes. `gap` is the quadrant
    /// of a state at a closed gap.
    #[inline]
    fn between_corners<const K: u32, const Q: usize>(&mut self, gap: Option<bool>) {
        let ([x1, x2, x3], [y1, y2, y3]) = (self.x[Q % 2], self.y[Q / 2]);
        let (is_left, is_up) = (Q % 2 == 1, Q / 2 == 1);
        let leads = |number: usize| {
            let of = &self.scanner.moves.all()[usize::from(self.scanner.near.index[Q][number])];
            gap.is_none_or(|lower| lower == is_lower(self.weights, self.at, of.vector))
        };
        let (axis, leads_along) = if is_along_x(Q) { (0, leads(0)) } else { (1, leads(1)) };
        let leads_across = K > 2 && leads(2);
        // The first cell of the quadrant is the vertex's own, or lies before it.
        let columns = if is_left { [x1, x2, x3] } else { [0, x1, x2] };
        let rows = if is_up { [y1, y2, y3] } else { [0, y1, y2] };
        let cell = |column: usize, row: usize| self.weight(columns[column] + rows[row]);
        let near = cell(0, 0);
        if leads_along {
            // On the other side of the axis: the quadrant's mirror image.
            let before = self.scanner.steps.near(self.at).map(|steps| steps[2]);
            let (step, other) = match axis {
                0 => (x1, columns[0] + if is_up { 0 } else { before[1] }),
                _ => (y1, rows[0] + if is_left { 0 } else { before[0] }),
            };
            let least = match (near, self.weight(other)) {
                (0, weight) | (weight, 0) => weight,
                (one, other) => one.min(other),
            };
            self.cross::<Q, 1>(axis, step, [(least, 1)]);
        }
        if !leads_across {
            return;
        }
        self.cross::<Q, 1>(2, x1 + y1, [(near, 1)]);
        if K < 4 {
            return;
        }
        let cell = |cells: &Self, column: usize, row: usize| cells.weight(columns[column] + rows[row]);
        let [beside, below] = [cell(self, 1, 0), cell(self, 0, 1)];
        self.cross::<Q, 2>(3, x2 + y1, [(near, 1), (beside, 1)]);
        self.cross::<Q, 2>(4, x1 + y2, [(near, 1), (below, 1)]);
        if K < 5 {
            return;
        }
        let across = cell(self, 1, 1);
        self.cross::<Q, 3>(5, x3 + y1, [(near, 1), (beside, 1), (cell(self, 2, 0), 1)]);
        self.cross::<Q, 3>(6, x1 + y3, [(near, 1), (below, 1), (cell(self, 0, 2), 1)]);
        self.cross::<Q, 4>(7, x3 + y2, [(near, 2), (beside, 1), (across, 1), (cell(self, 2, 1), 2)]);
        self.cross::<Q, 4>(8, x2 + y3, [(near, 2), (below, 1), (across, 1), (cell(self, 1, 2), 2)]);
    }
}
