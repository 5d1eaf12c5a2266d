//! Where diagonal jumps stop, row by row, and turned into the order of the jumps.
//!
//! Which axial jumps come to a jump point is carried from row to row, or along a row from bit to bit. So all
//! is computed 64 vertices at a time.

use mediant_grid::{
    BitMatrix, CellOffset, Footprint, GridGraph, Interrupt, Interrupted, Placement, Vector, Vertex, load,
    transpose,
};

use super::{DURING, axial::JumpPointRule, dead_ends::DeadEndRows};
use crate::canonical::{Pruning, pattern_at};

/// Of 64 vertices, those that stop a jump, and those from which its first and its second axial jump come to a
/// jump point. One from which they come to dead ends alone stops no jump.
pub(super) type Stops = [u64; 3];

/// For axial jumps in each direction, the vertices from which they come to a jump point, in rows: a word for
/// 64 vertices.
pub(super) struct Leads {
    rows: [Vec<u64>; 4],
    per_row: usize,
}

impl Leads {
    /// Where jumps pass dead ends.
    pub(super) fn new<P: Placement>(
        graph: &GridGraph<P>,
        dead: &DeadEndRows,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let per_row = P::vertices(graph.grid()).0.div_ceil(64) as usize;
        let mut rows = [const { Vec::new() }; 4];
        for quarter in (0..4).step_by(8 / graph.steps().len()) {
            let v = graph.step(quarter << (graph.k().get() - 2)).vector();
            rows[quarter] = leads(graph, v, dead.of(quarter), interrupt)?;
        }
        Ok(Self { rows, per_row })
    }

    fn of(&self, quarter: usize) -> &[u64] {
        &self.rows[quarter]
    }

    /// Whether a jump in this direction comes to a jump point from a vertex of the map.
    pub(super) fn any(&self, quarter: usize, from: Vertex) -> bool {
        let word = self.rows[quarter][from.y as usize * self.per_row + from.x as usize / 64];
        word >> (from.x % 64) & 1 == 1
    }
}

/// Finds where jumps by one odd move stop, row by row.
pub(super) struct StopRows<'g, P: Placement> {
    graph: &'g GridGraph<P>,
    pruning: &'g Pruning<P>,
    index: usize,
    v: Vector,
    step: Footprint,
    width: i64,
    height: usize,
    per_row: usize,
    /// The vertices from which the first and the second axial jump come to a jump point.
    leads: [&'g [u64]; 2],
    /// Likewise, where they pass dead ends.
    live: [&'g [u64]; 2],
}

impl<'g, P: Placement> StopRows<'g, P> {
    pub(super) fn new(
        graph: &'g GridGraph<P>,
        pruning: &'g Pruning<P>,
        index: usize,
        [leads, live]: [&'g Leads; 2],
    ) -> Self {
        let (width, height) = P::vertices(graph.grid());
        let (v, per_row) = (graph.step(index).vector(), width.div_ceil(64) as usize);
        let step = Footprint::new::<P>(graph.rule(), v);
        let (width, height) = (i64::from(width), height as usize);
        let beside = [index - 1, (index + 1) % graph.steps().len()];
        let of = |leads: &'g Leads| beside.map(|even| leads.of(even >> (graph.k().get() - 2)));
        Self { graph, pruning, index, v, step, width, height, per_row, leads: of(leads), live: of(live) }
    }

    fn matrix(&self) -> &BitMatrix {
        self.graph.grid().rows()
    }

    /// The stops in row y.
    fn row(&self, y: usize) -> Vec<Stops> {
        let words = y * self.per_row..(y + 1) * self.per_row;
        let stops = words.map(|word| {
            let (x, y) = ((word % self.per_row) as i32 * 64, y as i32);
            let mut enters =
                holds(self.matrix(), (x - self.v.x, y - self.v.y), &self.step.free, &self.step.either);
            if self.graph.has_closed_gaps() {
                enters &= !self.gaps((x, y));
            }
            let forced = if self.pruning.diagonals_may_force() { self.forced((x, y), enters) } else { 0 };
            let [first, second] = [0, 1].map(|i| self.leads[i][word] & enters);
            let live = (self.live[0][word] | self.live[1][word]) & enters;
            [!enters | forced | live, first, second]
        });
        stops.collect()
    }

    /// Of 64 vertices, those with a forced successor of the odd move.
    fn forced(&self, (x, y): (i32, i32), enters: u64) -> u64 {
        let is_forced = |i: u64| {
            let pattern = pattern_at(self.graph, Vertex::new(x + i as i32, y));
            u64::from(self.pruning.has_forced_at(pattern, self.index)) << i
        };
        (0..64).filter(|i| enters >> i & 1 == 1).fold(0, |forced, i| forced | is_forced(i))
    }

    /// Of 64 corners, those where two blocked cells meet diagonally and two free ones.
    fn gaps(&self, (x, y): (i32, i32)) -> u64 {
        let cell = |dx: i32, dy: i32| load(self.matrix().words(), self.matrix().index(x + dx, y + dy));
        let [a, b, c, d] = [cell(-1, -1), cell(0, -1), cell(-1, 0), cell(0, 0)];
        (a ^ b) & (a ^ c) & !(a ^ d)
    }

    /// The stops of 64 vertices of a row from column x on; none beyond the row.
    fn at(&self, row: &[Stops], x: i64) -> Stops {
        let word = |i: i64| match usize::try_from(i).ok().and_then(|i| row.get(i)) {
            None => [0; 3],
            Some(stops) if i as usize + 1 < self.per_row => *stops,
            Some(stops) => stops.map(|word| word & !0 >> (63 - (self.width - 1) % 64)),
        };
        let (low, high, shift) = (word(x >> 6), word((x >> 6) + 1), x & 63);
        [0, 1, 2].map(|i| low[i] >> shift | high[i] << 1 << (63 - shift))
    }

    /// Calls `put` with words of the stops in the order of the jumps: with the line, the number of the word
    /// in it, and the bits. The bits of one word may come in two calls.
    /// The interrupt is asked before each row.
    pub(super) fn for_each_word(
        &self,
        interrupt: &Interrupt,
        mut put: impl FnMut(usize, usize, Stops),
    ) -> Result<(), Interrupted> {
        let v = self.v;
        if v.y == 0 {
            for y in 0..self.height {
                interrupt.check(DURING)?;
                let row = self.row(y);
                for word in 0..self.per_row {
                    if v.x > 0 {
                        put(y, word, row[word]);
                    } else {
                        let bits = self.at(&row, self.width - 64 * (word as i64 + 1));
                        put(y, word, bits.map(u64::reverse_bits));
                    }
                }
            }
            return Ok(());
        }
        for place in (0..self.height).step_by(64) {
            let last = (place + 63).min(self.height - 1);
            let y_at = |place: usize| if v.y > 0 { place } else { self.height - 1 - place };
            let row = |place| interrupt.check(DURING).map(|()| self.row(y_at(place)));
            let rows: Vec<Vec<Stops>> = (place..=last).map(row).collect::<Result<_, _>>()?;
            // How far to the right of its line a jump is in the first and in the last of these rows.
            let [from, to] = [place, last].map(|place| i64::from(v.x) * place as i64);
            let mut first = -from.max(to);
            while first < self.width - from.min(to) {
                let [stops, one, other] = self.square(&rows, first + from);
                for (line, bits) in (first..).zip(stops.into_iter().zip(one.into_iter().zip(other))) {
                    let (stops, (one, other)) = bits;
                    put(line.rem_euclid(self.width) as usize, place / 64, [stops, one, other]);
                }
                first += 64;
            }
        }
        Ok(())
    }

    /// The stops of diagonal jumps along 64 lines through these rows, a word for each line. The first line
    /// begins at column x.
    fn square(&self, rows: &[Vec<Stops>], x: i64) -> [[u64; 64]; 3] {
        let mut squares = [[0; 64]; 3];
        for (i, row) in rows.iter().enumerate() {
            let bits = self.at(row, x + i64::from(self.v.x) * i as i64);
            for (square, bits) in squares.iter_mut().zip(bits) {
                square[i] = bits;
            }
        }
        squares.iter_mut().for_each(transpose);
        squares
    }
}

/// The bits `start`, and those of the bits `through` that follow them without a break, from high to low bits
/// if `DOWN`.
pub(super) fn carried<const DOWN: bool>(start: u64, through: u64) -> u64 {
    let (mut start, mut through) = (start, through);
    for by in [1, 2, 4, 8, 16, 32] {
        let shifted = |word: u64| if DOWN { word >> by } else { word << by };
        start |= through & shifted(start);
        through &= shifted(through);
    }
    start
}

/// Of 64 vertices from (x, y) on, those where the cells `free`, and one of each pair `either`, are free.
pub(super) fn holds(
    rows: &BitMatrix,
    (x, y): (i32, i32),
    free: &[CellOffset],
    either: &[[CellOffset; 2]],
) -> u64 {
    let at = rows.index(x, y);
    let cell = |&(dx, dy): &CellOffset| !load(rows.words(), at.offset(dy * rows.bits_per_row() + dx));
    let all = free.iter().fold(!0, |all, offset| all & cell(offset));
    either.iter().fold(all, |all, [a, b]| all & (cell(a) | cell(b)))
}

/// The vertices from which the axial jump by `v` comes to a jump point that is none of the dead ends.
fn leads<P: Placement>(
    graph: &GridGraph<P>,
    v: Vector,
    dead: &[u64],
    interrupt: &Interrupt,
) -> Result<Vec<u64>, Interrupted> {
    let (width, height) = P::vertices(graph.grid());
    let (per_row, rule) = (width.div_ceil(64) as usize, JumpPointRule::of(graph));
    let ends = |word: usize| {
        let place = ((word % per_row) as i32 * 64, (word / per_row) as i32);
        let ends = rule.ends_in_row::<P>(graph.grid().rows(), place, v);
        [ends.jump & !dead.get(word).unwrap_or(&0), !ends.dead]
    };
    let mut leads = vec![0; per_row * height as usize];
    let ascending = v.x + v.y > 0;
    // The ends of the word that the jumps of a row enter next.
    let mut next_ends = [0; 2];
    // Each word after the one that the jump enters next.
    for i in 0..leads.len() {
        interrupt.check_every(1 << 10, i, DURING)?;
        let word = if ascending { leads.len() - 1 - i } else { i };
        leads[word] = if v.x == 0 {
            let next = word as isize + v.y as isize * per_row as isize;
            let Some(&beyond) = usize::try_from(next).ok().and_then(|next| leads.get(next)) else {
                continue;
            };
            let [jump, enters] = ends(next as usize);
            enters & (jump | beyond)
        } else {
            // The jump from vertex x comes to a jump point if it can enter x + 1, and that is one or
            // leads to one.
            let next = (word % per_row) as isize + v.x as isize;
            let inside = (0..per_row as isize).contains(&next);
            let beyond = if inside { leads[word.wrapping_add_signed(v.x as isize)] } else { 0 };
            let [next_jump, next_enters] = if inside { next_ends } else { [0, 0] };
            let [jump, enters] = ends(word);
            next_ends = [jump, enters];
            if ascending {
                let shifted = |word: u64, next: u64| word >> 1 | next << 63;
                let enters = shifted(enters, next_enters);
                let start = enters & (shifted(jump, next_jump) | beyond << 63);
                carried::<true>(start, enters)
            } else {
                let shifted = |word: u64, next: u64| word << 1 | next >> 63;
                let enters = shifted(enters, next_enters);
                let start = enters & (shifted(jump, next_jump) | beyond >> 63);
                carried::<false>(start, enters)
            }
        };
    }
    Ok(leads)
}
