//! Straight segments at any angle: whether they are legal, and the integral of the cost along them.
//!
//! A segment is its primitive vector, repeated: from vertex to vertex that lie on it. Along each repetition
//! the shares of the cells are integers, as in the module `moves`, and so is the sum of share · weight. Where
//! the vector is a move of N(k), a segment costs what the moves cost. So paths over N(k) cost the same in
//! both ways. Otherwise the sum over the whole segment, exact in 128 bits, is multiplied by the length of a
//! share and rounded once. Two such segments in a row cost what both cost as one, up to a unit.

use mediant_grid::Vertex;
use mediant_moves::{Cost, Vector};
use mediant_search::Path;

use crate::{
    gaps::is_lower,
    graph::{CostGraph, primitive},
    moves::Move,
};

/// A segment while it is walked.
struct Walk<'g> {
    graph: &'g CostGraph,
    /// The primitive vector.
    v: Vector,
    times: u32,
}

impl CostGraph {
    /// The cost of the straight segment between two vertices: the integral of the cells' costs along it.
    /// `None` if the segment is not legal, by the rules that hold for moves: if it crosses a blocked cell,
    /// passes a corner of one where it may not, runs between two blocked cells, or passes a closed gap.
    ///
    /// For a move, or one repeated, it is exactly the cost of the moves; else it is rounded once.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use mediant_costs::{CostGraph, CostSurface};
    /// use mediant_grid::{CornerRule, Rules, Vertex};
    /// use mediant_moves::FiniteK;
    ///
    /// let map = Arc::new(CostSurface::from_fn(9, 4, |x, _| Some(if x < 4 { 1.0 } else { 3.0 }))?);
    /// let graph = CostGraph::new(map, Rules::Center(CornerRule::Never), FiniteK::N8)?;
    /// // 3.5 columns of cost 1, and 3.5 of cost 3.
    /// let cost = graph.line_cost(Vertex::new(0, 0), Vertex::new(7, 3)).expect("all cells are free");
    /// assert!((graph.to_f64(cost) - 2.0 * 58.0_f64.sqrt()).abs() < 1e-8);
    /// # Ok::<(), mediant_costs::CostsError>(())
    /// ```
    #[must_use]
    pub fn line_cost(&self, from: Vertex, to: Vertex) -> Option<Cost> {
        if !self.is_free(from) || !self.is_free(to) {
            return None;
        }
        self.line(from, to, u64::MAX).map(Cost::from_bits)
    }

    /// The cost of a path of straight segments at any angle; `None` if one is not legal. (It is not asked
    /// whether the path turns at a closed gap.) Of a path over N(k) it is [`path_cost`](Self::path_cost).
    #[must_use]
    pub fn segments_cost(&self, path: &Path) -> Option<Cost> {
        let mut segments = path.waypoints().windows(2);
        segments.try_fold(Cost::ZERO, |cost, ends| Some(cost + self.line_cost(ends[0], ends[1])?))
    }

    /// The cost of the segment between two vertices of the map, if it is legal and not above a limit. Just
    /// above it may still be told.
    pub(crate) fn line(&self, from: Vertex, to: Vertex, limit: u64) -> Option<u64> {
        let d = from.to(to);
        if d == Vector::new(0, 0) {
            return Some(0);
        }
        let (v, times) = primitive(d);
        let walk = Walk { graph: self, v, times };
        match self.known_move(v) {
            Some(of) => walk.of_moves(from, of, limit),
            None => walk.at_any_angle(from, limit),
        }
    }

    /// Tells the cells that a segment crosses whose vector is no move of N(k), each with the length in it.
    /// Returns whether it is legal.
    pub(crate) fn cells_along(&self, from: Vertex, to: Vertex, mut add: impl FnMut((u32, u32), f64)) -> bool {
        let (v, times) = primitive(from.to(to));
        let walk = Walk { graph: self, v, times };
        let (dx, dy) = v.abs();
        let (dx, dy) = (u64::from(dx), u64::from(dy));
        let shares = if self.is_center() { 2 * dx * dy } else { dx * dy };
        let share_length = self.map().scale().length(v) / shares as f64;
        (0..times).all(|time| {
            let at = walk.after(from, time);
            (time == 0 || !walk.is_gap(at))
                && walk.repetition(at, (dx, dy), |(x, y), _, share| {
                    add((x as u32, y as u32), share as f64 * share_length);
                    true
                })
        })
    }

    /// [`line`](Self::line) between two states, which at closed gaps is to lie in their quadrants.
    pub(crate) fn line_between(&self, from: usize, to: usize, limit: u64) -> Option<u64> {
        let [start, end] = [from, to].map(|state| self.vertex(state));
        let v = start.to(end);
        let (gaps, weights) = (&self.scanner().gaps, self.map().weights());
        let may_leave = |state: usize, v: Vector| {
            let quadrant = gaps.quadrant(state);
            quadrant.is_none_or(|lower| lower == is_lower(weights, gaps.position(state), v))
        };
        if !may_leave(from, v) || !may_leave(to, -v) {
            return None;
        }
        self.line(start, end, limit)
    }
}

impl Walk<'_> {
    /// The vertex after some repetitions.
    fn after(&self, from: Vertex, times: u32) -> Vertex {
        Vertex::new(from.x + self.v.x * times as i32, from.y + self.v.y * times as i32)
    }

    /// Whether a closed gap lies at a vertex within the segment.
    fn is_gap(&self, at: Vertex) -> bool {
        let gaps = &self.graph.scanner().gaps;
        !gaps.is_empty() && gaps.upper(self.graph.layout().position(at.x, at.y)).is_some()
    }

    fn of_moves(&self, from: Vertex, of: &Move, limit: u64) -> Option<u64> {
        let mut cost = 0;
        for time in 0..self.times {
            let at = self.after(from, time);
            let rest = u64::from(self.times - time).saturating_mul(of.least);
            if rest.saturating_add(cost) > limit || time > 0 && self.is_gap(at) {
                return None;
            }
            cost += self.graph.cost_of(of, self.graph.layout().position(at.x, at.y))?;
        }
        Some(cost)
    }

    fn at_any_angle(&self, from: Vertex, limit: u64) -> Option<u64> {
        let scale = self.graph.map().scale();
        let (dx, dy) = self.v.abs();
        let (dx, dy) = (u64::from(dx), u64::from(dy));
        let shares = u128::from(if self.graph.is_center() { 2 * dx * dy } else { dx * dy });
        let shares = shares * u128::from(self.times);
        let length = Vector::new(self.v.x * self.times as i32, self.v.y * self.times as i32);
        let share_length = scale.units(scale.length(length)) / shares as f64;
        // With room for its rounding.
        let most = ((limit as f64 + 1.0) * (1.0 + 1e-9) / share_length) as u128;
        let mut sum = Sum { sum: 0, least: scale.least.into(), rest: shares, most };
        for time in 0..self.times {
            let at = self.after(from, time);
            let add = |_, weight, share| sum.add(weight, share);
            if time > 0 && self.is_gap(at) || !self.repetition(at, (dx, dy), add) {
                return None;
            }
        }
        Some((sum.sum as f64 * share_length).round() as u64)
    }

    /// Walks one repetition, whose sizes of coordinates are positive. Returns whether it is legal, and no
    /// piece stopped it: of each `piece` learns the cell, its weight and its share.
    fn repetition(
        &self,
        from: Vertex,
        (dx, dy): (u64, u64),
        mut piece: impl FnMut((i32, i32), u32, u64) -> bool,
    ) -> bool {
        let (layout, weights) = (self.graph.layout(), self.graph.map().weights());
        let weight = |x: i32, y: i32| weights[layout.position(x, y)];
        let (sx, sy) = (self.v.x.signum(), self.v.y.signum());
        let is_center = self.graph.is_center();
        // The first grid line of each axis is passed half a cell ahead between centers, in shares of
        // 1 / (2 dx dy); a whole one between corners, in shares of 1 / (dx dy).
        let scale = if is_center { 2 } else { 1 };
        let shares = scale * dx * dy;
        let (mut next_x, mut next_y, mut at) = (dy, dx, 0);
        let side = |from: i32, sign: i32| if is_center || sign > 0 { from } else { from - 1 };
        let (mut x, mut y) = (side(from.x, sx), side(from.y, sy));
        loop {
            let next = next_x.min(next_y).min(shares);
            let here = weight(x, y);
            if here == 0 || !piece((x, y), here, next - at) {
                return false;
            }
            at = next;
            if at == shares {
                return true;
            }
            let (crosses_x, crosses_y) = (next == next_x, next == next_y);
            if crosses_x && crosses_y && !self.graph.scanner().may_pass(weight(x + sx, y), weight(x, y + sy))
            {
                return false;
            }
            if crosses_x {
                (x, next_x) = (x + sx, next_x + scale * dy);
            }
            if crosses_y {
                (y, next_y) = (y + sy, next_y + scale * dx);
            }
        }
    }
}

/// The sum of share · weight, up to a greatest.
struct Sum {
    sum: u128,
    least: u128,
    /// The shares that are left.
    rest: u128,
    most: u128,
}

impl Sum {
    /// Adds a piece; returns whether the whole may still be small enough.
    #[inline]
    fn add(&mut self, weight: u32, share: u64) -> bool {
        self.sum += u128::from(weight) * u128::from(share);
        self.rest -= u128::from(share);
        self.sum + self.least * self.rest <= self.most
    }
}
