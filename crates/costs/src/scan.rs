//! The legal moves from a vertex, with their costs: the inner loop of all searches.
//!
//! The moves of N(5) are written out, quadrant by quadrant, since most searches are over these, and share
//! what they read: at k = 5 a field takes half as long as with a table. All others are read from a table. A
//! cell of weight 0 is blocked, so what a move costs tells whether it is legal, too.

use mediant_grid::{CornerRule, Rules};
use mediant_moves::Vector;

use crate::{
    gaps::{Gaps, is_lower},
    layout::Steps,
    map::CostMap,
    moves::{Factor, Move, Moves, Part},
    scale::Scale,
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
    pub(crate) fn new(scanner: &'g Scanner, map: &'g CostMap) -> Self {
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

/// The moves that are read from a table, and the cells that they read.
#[derive(Clone, Debug)]
struct Far {
    moves: Box<[FarMove]>,
    parts: Box<[FarPart]>,
    /// From the vertex.
    cells: Box<[(i8, i8)]>,
}

#[derive(Clone, Copy, Debug)]
struct FarMove {
    factor: Factor,
    least: u64,
    /// Its parts.
    first: u32,
    last: u32,
    /// Of the cells that it touches in a corner; where there are none, the cell where it begins, which is
    /// free.
    touched: [u16; 2],
    index: u16,
    dx: i8,
    dy: i8,
    is_along: bool,
}

impl FarMove {
    const fn vector(&self) -> Vector {
        Vector::new(self.dx as i32, self.dy as i32)
    }
}

#[derive(Clone, Copy, Debug)]
struct FarPart {
    /// By its number among the cells.
    cell: u16,
    share: u16,
}

/// In place of the weight of a blocked cell: more than any sum of shares times weights, and so is the sum of
/// these of all cells of a move.
const BLOCKED: u64 = 1 << 48;
/// At least as many cells as the moves of k = 8 read.
const CELLS: usize = 1 << 10;

impl Far {
    fn new(moves: &Moves, is_far: impl Fn(Vector) -> bool) -> Self {
        let mut cells: Vec<(i8, i8)> = Vec::new();
        let mut number = |cell: (i8, i8)| {
            let known = cells.iter().position(|&known| known == cell);
            known.unwrap_or_else(|| {
                cells.push(cell);
                cells.len() - 1
            }) as u16
        };
        let mut parts = Vec::new();
        let far = (0..).zip(moves.all()).filter(|(_, of)| is_far(of.vector)).map(|(index, of)| {
            let first = parts.len() as u32;
            let of_move = moves.parts(of);
            parts.extend(
                of_move.iter().map(|part| FarPart { cell: number((part.dx, part.dy)), share: part.share }),
            );
            let begins = of_move.first().map_or((0, 0), |part| (part.dx, part.dy));
            FarMove {
                factor: of.factor,
                least: of.least,
                first,
                last: parts.len() as u32,
                touched: of.touched.unwrap_or([begins; 2]).map(&mut number),
                index,
                dx: of.vector.x as i8,
                dy: of.vector.y as i8,
                is_along: of.is_along,
            }
        });
        let moves = far.collect();
        Self { moves, parts: parts.into(), cells: cells.into() }
    }
}

impl Scanner {
    pub(crate) fn new(moves: Moves, steps: Steps, gaps: Gaps, rules: Rules) -> Self {
        let is_near = |v: Vector| v.abs().0.max(v.abs().1) <= 3;
        let (near, far) = (Near::new(&moves), Far::new(&moves, |v| !is_near(v)));
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

    /// The moves beyond N(5).
    fn scan_far(&self, weights: &[u32], (state, cost): (usize, u64), visit: &mut impl Visit) {
        let at = self.gaps.position(state);
        let (from, quadrant) = (self.steps.from(at), self.gaps.quadrant(state));
        // Read when the first move needs them.
        let mut window = [0; CELLS];
        let mut is_read = false;
        for of in &self.far.moves {
            if quadrant.is_some_and(|lower| lower != is_lower(weights, at, of.vector())) {
                continue;
            }
            let to = self.gaps.state(weights, from.to(of.dx, of.dy), -of.vector());
            let known = visit.known(to);
            if cost + of.least >= known {
                continue;
            }
            if !std::mem::replace(&mut is_read, true) {
                for (read, &(dx, dy)) in window.iter_mut().zip(&self.far.cells) {
                    let weight = weights[from.to(dx, dy)];
                    *read = if weight == 0 { BLOCKED } else { u64::from(weight) };
                }
            }
            let read = |cell: u16| window[usize::from(cell) % CELLS];
            let [one, other] = of.touched.map(|cell| read(cell) < BLOCKED);
            if self.allowed >> (u8::from(one) | u8::from(other) << 1) & 1 == 0 {
                continue;
            }
            let parts = &self.far.parts[of.first as usize..of.last as usize];
            let sum = if of.is_along {
                parts.iter().fold(BLOCKED, |least, part| least.min(read(part.cell)))
            } else {
                parts.iter().fold(0, |sum, part| sum + read(part.cell) * u64::from(part.share))
            };
            if sum < BLOCKED {
                let cost = cost + of.factor.cost(sum);
                if cost < known {
                    visit.relax(usize::from(of.index), to, cost);
                }
            }
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

/// A vertex while it is scanned. `Q` is one of the quadrants of [`SIGNS`].
struct Scan<'s, V> {
    at: usize,
    /// The steps by 1, 2, 3 along each axis, forward and backward.
    x: [[isize; 3]; 2],
    y: [[isize; 3]; 2],
    cost: u64,
    weights: &'s [u32],
    scanner: &'s Scanner,
    visit: &'s mut V,
}

/// Whether the move along an axis that a quadrant visits is the one along x: each axis borders two quadrants.
const fn is_along_x(quadrant: usize) -> bool {
    matches!(quadrant, 0 | 3)
}

impl<V: Visit> Scan<'_, V> {
    /// Visits the moves in a quadrant. `gap` is the quadrant of a state at a closed gap.
    #[inline]
    fn quadrant<const K: u32, const CENTER: bool, const Q: usize>(&mut self, gap: Option<bool>) {
        if CENTER { self.between_centers::<K, Q>() } else { self.between_corners::<K, Q>(gap) }
    }

    #[inline]
    fn weight(&self, step: isize) -> u32 {
        self.weights[self.at.wrapping_add_signed(step)]
    }

    /// Visits a move, by its number in [`QUADRANT`], with its sum of shares times weights.
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
            self.cross::<Q, _>(axis, step, [(least, 1)]);
        }
        if !leads_across {
            return;
        }
        self.cross::<Q, _>(2, x1 + y1, [(near, 1)]);
        if K < 4 {
            return;
        }
        let cell = |cells: &Self, column: usize, row: usize| cells.weight(columns[column] + rows[row]);
        let [beside, below] = [cell(self, 1, 0), cell(self, 0, 1)];
        self.cross::<Q, _>(3, x2 + y1, [(near, 1), (beside, 1)]);
        self.cross::<Q, _>(4, x1 + y2, [(near, 1), (below, 1)]);
        if K < 5 {
            return;
        }
        let across = cell(self, 1, 1);
        self.cross::<Q, _>(5, x3 + y1, [(near, 1), (beside, 1), (cell(self, 2, 0), 1)]);
        self.cross::<Q, _>(6, x1 + y3, [(near, 1), (below, 1), (cell(self, 0, 2), 1)]);
        self.cross::<Q, _>(7, x3 + y2, [(near, 2), (beside, 1), (across, 1), (cell(self, 2, 1), 2)]);
        self.cross::<Q, _>(8, x2 + y3, [(near, 2), (below, 1), (across, 1), (cell(self, 1, 2), 2)]);
    }
}
