//! The legal moves from a vertex, with their costs: the inner loop of all searches.
//!
//! Between centers the moves of N(4) are written out, since most fields are over these, and share what they
//! read. All others are read from a table. A cell of weight 0 is blocked, so what a move costs tells whether
//! it is legal, too.

use mediant_grid::{CornerRule, Rules};

use crate::{
    gaps::{Gaps, is_lower},
    layout::Steps,
    map::CostMap,
    moves::{Factor, Move, Moves, Part},
    scale::Scale,
};

/// What a search does with the moves of a vertex.
pub(crate) trait Visit {
    /// The cost of the best path known to a state, which a new one has to beat: the greatest for none, 0 for a
    /// blocked cell.
    fn known(&self, to: usize) -> u64;

    /// Takes note of a better path to a state, by the move with this index.
    fn relax(&mut self, by: usize, to: usize, cost: u64);
}

/// All that a scan reads.
#[derive(Clone, Debug)]
pub(crate) struct Scanner {
    pub(crate) moves: Moves,
    pub(crate) steps: Steps,
    pub(crate) gaps: Gaps,
    pub(crate) rules: Rules,
    /// Whether a corner may be cut between two cells, by which of the two are free: a bit each.
    allowed: u8,
    near: Near,
    /// The moves that are read from the table.
    far: Box<[u16]>,
}

/// The moves of N(4) between centers.
#[derive(Clone, Debug, Default)]
struct Near {
    /// The index of each: E, W, S, N, then SE, SW, NE, NW, then the others as they are written out.
    index: [u16; 16],
    along_x: Factor,
    along_y: Factor,
    diagonal: Factor,
    wide: Factor,
    tall: Factor,
}

/// The moves of N(4), in the order in which they are written out.
const NEAR: [(i32, i32); 16] = [
    (1, 0),
    (-1, 0),
    (0, 1),
    (0, -1),
    (1, 1),
    (-1, 1),
    (1, -1),
    (-1, -1),
    (2, 1),
    (2, -1),
    (-2, 1),
    (-2, -1),
    (1, 2),
    (-1, 2),
    (1, -2),
    (-1, -2),
];

impl Scanner {
    pub(crate) fn new(moves: Moves, steps: Steps, gaps: Gaps, rules: Rules) -> Self {
        let place = |&(x, y): &(i32, i32)| {
            moves.all().iter().position(|known| (known.vector.x, known.vector.y) == (x, y))
        };
        let index = std::array::from_fn(|near| place(&NEAR[near]).unwrap_or_default() as u16);
        let factor = |x, y| place(&(x, y)).map(|at| moves.all()[at].factor).unwrap_or_default();
        let near = Near {
            index,
            along_x: factor(1, 0),
            along_y: factor(0, 1),
            diagonal: factor(1, 1),
            wide: factor(2, 1),
            tall: factor(1, 2),
        };
        let is_near =
            |v: &Move| matches!(rules, Rules::Center(_)) && NEAR.contains(&(v.vector.x, v.vector.y));
        let far = (0..).zip(moves.all()).filter(|(_, v)| !is_near(v)).map(|(index, _)| index).collect();
        let allowed = match rules {
            Rules::Center(CornerRule::Never) => 0b1000,
            Rules::Center(CornerRule::One) => 0b1110,
            Rules::Center(CornerRule::Always) | Rules::Corner(_) => 0b1111,
        };
        Self { moves, steps, gaps, rules, allowed, near, far }
    }

    /// A lower and an upper bound of the costs of moves.
    pub(crate) fn bounds(&self, scale: &Scale) -> (u64, u64) {
        let least = self.moves.all().iter().map(|of| of.least).min();
        let greatest = self
            .moves
            .all()
            .iter()
            .map(|of| of.factor.cost(self.moves.shares(of) * u64::from(scale.greatest)));
        (least.unwrap_or(1), greatest.max().unwrap_or(1))
    }

    /// The state to which a move leads; `None` where a closed gap forbids it.
    #[inline]
    pub(crate) fn target(&self, weights: &[u32], state: usize, of: &Move) -> Option<usize> {
        let at = self.gaps.position(state);
        if self.gaps.quadrant(state).is_some_and(|lower| lower != is_lower(weights, at, of.vector)) {
            return None;
        }
        let to = self.steps.from(at).to(of.vector.x as i8, of.vector.y as i8);
        Some(self.gaps.state(weights, to, -of.vector))
    }

    /// The cells that a legal move crosses, with the length in each.
    pub(crate) fn crossed(
        &self,
        map: &CostMap,
        at: usize,
        of: &Move,
    ) -> impl Iterator<Item = ((u32, u32), f64)> {
        let (layout, weights) = (map.layout(), map.weights());
        let (parts, shares) = (self.moves.parts(of), self.moves.shares(of) as f64);
        let length = map.scale().length(of.vector);
        let from = self.steps.from(at);
        let position = move |part: &Part| from.to(part.dx, part.dy);
        // Of the two cells beside a line, the cheaper one.
        let cheaper = parts
            .iter()
            .filter(|part| weights[position(part)] > 0)
            .min_by_key(|part| weights[position(part)]);
        let crossed = if of.is_along { cheaper.map_or(&[][..], std::slice::from_ref) } else { parts };
        crossed.iter().map(move |part| {
            let (x, y) = layout.cell(position(part));
            ((x as u32, y as u32), length * f64::from(part.share) / shares)
        })
    }

    /// Whether the rule of corners allows a move between two cells of these weights.
    #[inline]
    const fn may_pass(&self, one: u32, other: u32) -> bool {
        self.allowed >> ((one > 0) as u8 | ((other > 0) as u8) << 1) & 1 == 1
    }

    /// Visits the legal moves from a state whose cost is known, over N(`K`), or N(k) where K = 0.
    #[inline]
    pub(crate) fn scan<const K: u32>(
        &self,
        weights: &[u32],
        (state, cost): (usize, u64),
        visit: &mut impl Visit,
    ) {
        if K > 0 {
            self.scan_near::<K>(weights, (state, cost), visit);
        } else if matches!(self.rules, Rules::Center(_)) {
            self.scan_near::<4>(weights, (state, cost), visit);
            self.scan_far(weights, (state, cost), visit);
        } else {
            self.scan_far(weights, (state, cost), visit);
        }
    }

    /// The moves of N(2), N(3) or N(4) between centers.
    #[inline]
    fn scan_near<const K: u32>(&self, weights: &[u32], (at, cost): (usize, u64), visit: &mut impl Visit) {
        let [w2, w, e, e2, n2, n, s, s2] = self.steps.near(at);
        let Near { index, along_x, along_y, diagonal, wide, tall } = self.near;
        let weight = |step: isize| weights[at.wrapping_add_signed(step)];
        let own = u64::from(weights[at]);
        let mut relax = |near: usize, step: isize, factor: Factor, sum: u64| {
            let to = at.wrapping_add_signed(step);
            let cost = cost + factor.cost(sum);
            if cost < visit.known(to) {
                visit.relax(usize::from(index[near]), to, cost);
            }
        };
        let [east, west, south, north] = [e, w, s, n].map(weight);
        relax(0, e, along_x, own + u64::from(east));
        relax(1, w, along_x, own + u64::from(west));
        relax(2, s, along_y, own + u64::from(south));
        relax(3, n, along_y, own + u64::from(north));
        if K < 3 {
            return;
        }
        let [se, sw, ne, nw] = [s + e, s + w, n + e, n + w].map(weight);
        let sides = [
            (south, east, s + e, se),
            (south, west, s + w, sw),
            (north, east, n + e, ne),
            (north, west, n + w, nw),
        ];
        for (near, (one, other, step, weight)) in (4..).zip(sides) {
            if self.may_pass(one, other) {
                relax(near, step, diagonal, own + u64::from(weight));
            }
        }
        if K < 4 {
            return;
        }
        let wide_moves = [(east, se, e2 + s), (east, ne, e2 + n), (west, sw, w2 + s), (west, nw, w2 + n)];
        for (near, (one, other, step)) in (8..).zip(wide_moves) {
            if one > 0 && other > 0 {
                relax(near, step, wide, own + u64::from(one) + u64::from(other) + u64::from(weight(step)));
            }
        }
        let tall_moves = [(south, se, s2 + e), (south, sw, s2 + w), (north, ne, n2 + e), (north, nw, n2 + w)];
        for (near, (one, other, step)) in (12..).zip(tall_moves) {
            if one > 0 && other > 0 {
                relax(near, step, tall, own + u64::from(one) + u64::from(other) + u64::from(weight(step)));
            }
        }
    }

    /// The other moves.
    fn scan_far(&self, weights: &[u32], (state, cost): (usize, u64), visit: &mut impl Visit) {
        let at = self.gaps.position(state);
        let (from, quadrant) = (self.steps.from(at), self.gaps.quadrant(state));
        for &index in &self.far {
            let index = usize::from(index);
            let of = &self.moves.all()[index];
            if quadrant.is_some_and(|lower| lower != is_lower(weights, at, of.vector)) {
                continue;
            }
            let to = from.to(of.vector.x as i8, of.vector.y as i8);
            let to = self.gaps.state(weights, to, -of.vector);
            let known = visit.known(to);
            if cost + of.least >= known {
                continue;
            }
            if let Some(sum) = self.sum(weights, at, of) {
                let cost = cost + of.factor.cost(sum);
                if cost < known {
                    visit.relax(index, to, cost);
                }
            }
        }
    }

    /// The sum of share · weight of a move from a position; `None` if the move is not legal there, gaps aside.
    #[inline]
    pub(crate) fn sum(&self, weights: &[u32], at: usize, of: &Move) -> Option<u64> {
        let from = self.steps.from(at);
        let parts = self.moves.parts(of);
        if of.is_along {
            let free =
                parts.iter().map(|part| weights[from.to(part.dx, part.dy)]).filter(|&weight| weight > 0);
            return free.min().map(u64::from);
        }
        if let Some(touched) = of.touched {
            let [one, other] = touched.map(|(dx, dy)| weights[from.to(dx, dy)]);
            if !self.may_pass(one, other) {
                return None;
            }
        }
        let mut sum = 0;
        for part in parts {
            let weight = weights[from.to(part.dx, part.dy)];
            if weight == 0 {
                return None;
            }
            sum += u64::from(weight) * u64::from(part.share);
        }
        Some(sum)
    }
}
