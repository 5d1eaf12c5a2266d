//! The legal moves from a vertex, with their costs: the inner loop of all searches.
//!
//! The moves of N(5) are written out, quadrant by quadrant, since most searches are over these, and share
//! what they read: at k = 5 a field takes half as long as with a table. All others are read from a table. A
//! cell of weight 0 is blocked, so what a move costs tells whether it is legal, too.

mod far;
mod quadrant;

use mediant_grid::{CornerRule, Rules};
use mediant_moves::Vector;

use self::{far::Far, quadrant::Scan};
use crate::{
    gaps::{Gaps, is_lower},
    layout::Steps,
    moves::{Factor, Move, Moves, Part},
    scale::Scale,
    surface::CostSurface,
};

/// Calls a function for the `K` and the `CENTER` of a [scan](Scanner::scan) of a graph.
macro_rules! by_kind {
    ($graph:expr, [$($call:tt)+]($($argument:expr),*)) => {
        match ($graph.k().get(), $graph.is_center()) {
            (2, true) => $($call)+::<2, true>($($argument),*),
            (3, true) => $($call)+::<3, true>($($argument),*),
            (4, true) => $($call)+::<4, true>($($argument),*),
            (5, true) => $($call)+::<5, true>($($argument),*),
            (_, true) => $($call)+::<6, true>($($argument),*),
            (2, false) => $($call)+::<2, false>($($argument),*),
            (3, false) => $($call)+::<3, false>($($argument),*),
            (4, false) => $($call)+::<4, false>($($argument),*),
            (5, false) => $($call)+::<5, false>($($argument),*),
            (_, false) => $($call)+::<6, false>($($argument),*),
        }
    };
}

pub(crate) use by_kind;

/// A search's use of the moves of a vertex.
pub(crate) trait Visit {
    /// The cost of the best path known to a state, which a new one has to beat: the greatest for none, 0 for
    /// a blocked cell.
    fn known(&self, to: usize) -> u64;

    /// Takes note of a better path to a state, by the move with this index.
    fn relax(&mut self, by: usize, to: usize, cost: u64);
}

impl<V: Visit + ?Sized> Visit for &mut V {
    fn known(&self, to: usize) -> u64 {
        (**self).known(to)
    }

    fn relax(&mut self, by: usize, to: usize, cost: u64) {
        (**self).relax(by, to, cost);
    }
}

/// The moves of a search graph, as searches read them.
pub(crate) trait Scanning: Copy + Sync {
    /// A lower and an upper bound of the costs of moves.
    fn bounds(self) -> (u64, u64);

    /// Visits the legal moves from a state whose cost is known.
    fn scan(self, from: (usize, u64), visit: &mut impl Visit);
}

/// The moves of a cost surface: those of N(`K`) for K = 2 to 5, those of any k above for K = 6, at centers or
/// at corners.
#[derive(Clone, Copy)]
pub(crate) struct OfCosts<'g, const K: u32, const CENTER: bool> {
    scanner: &'g Scanner,
    scale: &'g Scale,
    weights: &'g [u32],
}

impl<'g, const K: u32, const CENTER: bool> OfCosts<'g, K, CENTER> {
    pub(crate) fn new(scanner: &'g Scanner, map: &'g CostSurface) -> Self {
        Self { scanner, scale: map.scale(), weights: map.weights() }
    }
}

impl<const K: u32, const CENTER: bool> Scanning for OfCosts<'_, K, CENTER> {
    fn bounds(self) -> (u64, u64) {
        self.scanner.bounds(self.scale)
    }

    #[inline]
    fn scan(self, from: (usize, u64), visit: &mut impl Visit) {
        self.scanner.scan::<K, CENTER>(self.weights, from, visit);
    }
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
    far: Far,
}

/// The moves of N(5).
#[derive(Clone, Debug)]
struct Near {
    /// The index of each, by quadrant, in the order of [`QUADRANT`].
    index: [[u16; QUADRANT.len()]; 4],
    factors: [Factor; QUADRANT.len()],
}

/// The moves of N(5) in the quadrant of +x and +y, with the two along its axes.
const QUADRANT: [(i32, i32); 9] = [(1, 0), (0, 1), (1, 1), (2, 1), (1, 2), (3, 1), (1, 3), (3, 2), (2, 3)];
/// The signs of the quadrants.
const SIGNS: [(i32, i32); 4] = [(1, 1), (-1, 1), (1, -1), (-1, -1)];

impl Near {
    fn new(moves: &Moves) -> Self {
        let place = |(x, y): (i32, i32)| moves.all().iter().position(|of| of.vector == Vector::new(x, y));
        let index =
            SIGNS.map(|(sx, sy)| QUADRANT.map(|(x, y)| place((sx * x, sy * y)).unwrap_or_default() as u16));
        let factors = QUADRANT.map(|v| place(v).map(|at| moves.all()[at].factor).unwrap_or_default());
        Self { index, factors }
    }
}

impl Scanner {
    pub(crate) fn new(moves: Moves, steps: Steps, gaps: Gaps, rules: Rules) -> Self {
        let is_near = |v: Vector| v.abs().0.max(v.abs().1) <= 3;
        let (near, far) = (Near::new(&moves), Far::new(&moves, |v| !is_near(v)));
        let allowed = match rules {
            Rules::Center(CornerRule::Never) => 0b1000,
            Rules::Center(CornerRule::One) => 0b1110,
            Rules::Center(CornerRule::Always) | Rules::Corner(_) | Rules::CenterGap(_) => 0b1111,
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
        map: &CostSurface,
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
    pub(crate) const fn may_pass(&self, one: u32, other: u32) -> bool {
        self.allowed >> ((one > 0) as u8 | ((other > 0) as u8) << 1) & 1 == 1
    }

    /// Visits the legal moves from a state whose cost is known: those of N(`K`) for K = 2 to 5, those of any
    /// k above for K = 6, at centers or at corners.
    #[inline]
    pub(crate) fn scan<const K: u32, const CENTER: bool>(
        &self,
        weights: &[u32],
        (state, cost): (usize, u64),
        visit: &mut impl Visit,
    ) {
        let at = self.gaps.position(state);
        let gap = self.gaps.quadrant(state);
        let [x, y] = self.steps.near(at).map(|[c, b, a, d, e, f]| [[d, e, f], [a, b, c]]);
        let mut scan = Scan { at, x, y, cost, weights, scanner: self, visit };
        scan.quadrant::<K, CENTER, 0>(gap);
        scan.quadrant::<K, CENTER, 1>(gap);
        scan.quadrant::<K, CENTER, 2>(gap);
        scan.quadrant::<K, CENTER, 3>(gap);
        if K > 5 {
            self.scan_far(weights, (state, cost), visit);
        }
    }

    /// The sum of share · weight of a move from a position; `None` if the move is not legal there, gaps
    /// aside.
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
