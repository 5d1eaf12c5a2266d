//! Where diagonal jumps stop, row by row, and turned into the order of the jumps.
//!
//! Which axial jumps come to a jump point is carried from row to row, or along a row from bit to bit. So all
//! is computed 64 vertices at a time.

use mediant_grid::{
    BitMatrix, CellOffset, Footprint, GridGraph, Interrupt, Interrupted, Placement, Vector, Vertex, load,
    transpose,
};

use super::{
    DURING,
    axial::{JumpStops, direction},
    cell_rows::{CellRows, EndRows},
    dead_ends::DeadEndRows,
};
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
    /// From where jumps lead on that pass these dead ends.
    pub(super) fn new(
        ends: &EndRows,
        dead: &DeadEndRows,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let mut rows = [const { Vec::new() }; 4];
        for (quarter, rows) in rows.iter_mut().enumerate() {
            *rows = leads(ends, dead, quarter, interrupt)?;
        }
        Ok(Self { rows, per_row: ends.per_row })
    }

    fn of(&self, quarter: usize) -> &[u64] {
        &self.rows[quarter]
    }

    /// Adds the vertices of row y from which a jump in some direction comes to a jump point, and did not by
    /// others of the same size.
    pub(super) fn add_new(&self, before: &Self, y: usize, new: &mut [u64]) {
        let words = y * self.per_row..(y + 1) * self.per_row;
        for (is, was) in self.rows.iter().zip(&before.rows) {
            // Not all directions have rows.
            let [is, was] = [is, was].map(|rows| rows.get(words.clone()).unwrap_or_default());
            new.iter_mut().zip(is.iter().zip(was)).for_each(|(new, (is, was))| *new |= is & !was);
        }
    }

    /// Whether a jump in this direction comes to a jump point from a vertex of the map.
    pub(super) fn any(&self, quarter: usize, from: Vertex) -> bool {
        let word = self.rows[quarter][from.y as usize * self.per_row + from.x as usize / 64];
        word >> (from.x % 64) & 1 == 1
    }
}

/// For each odd move the vertices that it can enter, in rows: a word for 64 vertices.
pub(super) struct EnterRows {
    /// By half the index of the move.
    rows: [Vec<u64>; 4],
    per_row: usize,
    width: i32,
}

impl EnterRows {
    pub(super) fn new<P: Placement>(
        graph: &GridGraph<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let (width, height) = P::vertices(graph.grid());
        let per_row = width.div_ceil(64) as usize;
        let mut rows = [const { Vec::new() }; 4];
        for (rows, odd) in rows.iter_mut().zip((1..graph.steps().len()).step_by(2)) {
            let v = graph.step(odd).vector();
            let step = Footprint::new::<P>(graph.rule(), v);
            rows.reserve_exact(per_row * height as usize);
            for y in 0..height as i32 {
                interrupt.check(DURING)?;
                let cells = CellRows::new(graph.grid().rows(), y, per_row);
                let first = rows.len();
                rows.resize(first + per_row, !0);
                enter(cells, (v, &step), graph.has_closed_gaps(), &mut rows[first..]);
            }
        }
        Ok(Self { rows, per_row, width: width as i32 })
    }

    fn of(&self, index: usize) -> &[u64] {
        &self.rows[index >> 1 & 3]
    }

    /// Whether an odd move can enter a vertex; false outside of the map.
    #[inline]
    pub(super) fn can_enter(&self, index: usize, at: Vertex) -> bool {
        if at.x < 0 || at.x >= self.width || at.y < 0 {
            return false;
        }
        let word = at.y as usize * self.per_row + at.x as usize / 64;
        self.of(index).get(word).is_some_and(|word| word >> (at.x % 64) & 1 == 1)
    }
}

/// Takes away from vertices of a row those that a move cannot enter.
fn enter(cells: CellRows<'_>, (v, step): (Vector, &Footprint), has_closed_gaps: bool, enters: &mut [u64]) {
    // The cells are those of a move to these vertices.
    let at = |(dx, dy): CellOffset| cells.at((dx - v.x, dy - v.y));
    for &cell in &step.free {
        enters.iter_mut().zip(at(cell)).for_each(|(enters, blocked)| *enters &= !blocked);
    }
    for pair in &step.either {
        let [one, other] = pair.map(at);
        enters.iter_mut().zip(one.zip(other)).for_each(|(enters, (one, other))| *enters &= !(one & other));
    }
    if has_closed_gaps {
        let [a, b, c, d] = [(-1, -1), (0, -1), (-1, 0), (0, 0)].map(|cell| cells.at(cell));
        for (enters, ((a, b), (c, d))) in enters.iter_mut().zip(a.zip(b).zip(c.zip(d))) {
            // Two blocked cells meet diagonally, and two free ones.
            *enters &= !((a ^ b) & (a ^ c) & !(a ^ d));
        }
    }
}

/// Finds where jumps by one odd move stop, row by row.
pub(super) struct StopRows<'g, P: Placement> {
    graph: &'g GridGraph<P>,
    pruning: &'g Pruning<P>,
    index: usize,
    v: Vector,
    /// The vertices that the move can enter.
    enters: &'g [u64],
    /// Whether the move may have forced successors.
    forces: bool,
    width: usize,
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
        (enters, [leads, live]): (&'g EnterRows, [&'g Leads; 2]),
    ) -> Self {
        let (width, height) = P::vertices(graph.grid());
        let (v, per_row) = (graph.step(index).vector(), width.div_ceil(64) as usize);
        let (enters, forces) = (enters.of(index), pruning.diagonals_may_force());
        let (width, height) = (width as usize, height as usize);
        let beside = [index - 1, (index + 1) % graph.steps().len()];
        let of = |leads: &'g Leads| beside.map(|even| leads.of(even >> (graph.k().get() - 2)));
        Self {
            graph,
            pruning,
            index,
            v,
            enters,
            forces,
            width,
            height,
            per_row,
            leads: of(leads),
            live: of(live),
        }
    }

    /// Puts the stops in row y into `to`.
    fn row(&self, y: usize, to: &mut [Stops]) {
        let words = y * self.per_row..(y + 1) * self.per_row;
        let of = |rows: &'g [u64]| rows[words.clone()].iter();
        let [leads, live] = [self.leads, self.live].map(|[one, other]| of(one).zip(of(other)));
        let enters = of(self.enters);
        for ((to, &enters), ((one, other), (live, other_live))) in
            to.iter_mut().zip(enters).zip(leads.zip(live))
        {
            *to = [!enters | (live | other_live) & enters, one & enters, other & enters];
        }
        if self.forces {
            for ((to, &enters), x) in to.iter_mut().zip(of(self.enters)).zip((0..).step_by(64)) {
                to[0] |= self.forced((x, y as i32), enters);
            }
        }
    }

    /// Of 64 vertices, those with a forced successor of the odd move.
    fn forced(&self, (x, y): (i32, i32), enters: u64) -> u64 {
        let is_forced = |i: u64| {
            let pattern = pattern_at(self.graph, Vertex::new(x + i as i32, y));
            u64::from(self.pruning.has_forced_at(pattern, self.index)) << i
        };
        (0..64).filter(|i| enters >> i & 1 == 1).fold(0, |forced, i| forced | is_forced(i))
    }

    /// Puts the stops in the order of the jumps, so many words a line.
    /// The interrupt is asked before each row.
    pub(super) fn put(
        &self,
        (to, per_line): (&mut [Stops], usize),
        interrupt: &Interrupt,
    ) -> Result<(), Interrupted> {
        if self.v.y == 0 {
            let mut row = vec![[0; 3]; self.per_row];
            for (y, line) in to.chunks_exact_mut(per_line).enumerate() {
                interrupt.check(DURING)?;
                self.row(y, &mut row);
                for (word, to) in line.iter_mut().take(self.per_row).enumerate() {
                    *to = if self.v.x > 0 { row[word] } else { self.backward(&row, word) };
                }
            }
            return Ok(());
        }
        // A row is a ring: one word more.
        let per_row = self.per_row + 1;
        let (mut rows, mut squares) = (vec![[0; 3]; 64 * per_row], [[0; 64]; 3]);
        for first in (0..self.height).step_by(64) {
            let places = first..(first + 64).min(self.height);
            // The bit of the first line in each row.
            let mut starts = [0; 64];
            for ((place, row), start) in places.clone().zip(rows.chunks_exact_mut(per_row)).zip(&mut starts) {
                interrupt.check(DURING)?;
                self.row(if self.v.y > 0 { place } else { self.height - 1 - place }, row);
                self.join_ends(row);
                *start = (i64::from(self.v.x) * place as i64).rem_euclid(self.width as i64) as usize;
            }
            for line in (0..self.width).step_by(64) {
                let rows = rows.chunks_exact(per_row).take(places.len());
                self.square(rows, &mut starts, &mut squares);
                let [stops, one, other] = &squares;
                let bits = stops.iter().zip(one).zip(other);
                let lines = to.chunks_exact_mut(per_line).skip(line);
                for (to, ((&stops, &one), &other)) in lines.zip(bits) {
                    to[first / 64] = [stops, one, other];
                }
            }
        }
        Ok(())
    }

    /// A word of a row in the order of a jump to smaller coordinates.
    fn backward(&self, row: &[Stops], word: usize) -> Stops {
        // The last word may begin before the row.
        let x = self.width as i64 - 64 * (word as i64 + 1);
        let (at, shift) = ((x >> 6) as usize, x & 63);
        let [low, high] = [at, at.wrapping_add(1)].map(|at| row.get(at).copied().unwrap_or([0; 3]));
        [0, 1, 2].map(|i| (low[i] >> shift | high[i] << 1 << (63 - shift)).reverse_bits())
    }

    /// Lets the first bits of a row follow its last one.
    fn join_ends(&self, row: &mut [Stops]) {
        let (last, used) = (self.width / 64, self.width % 64);
        let first = row[0].map(|bits| bits & !0 >> (64 - self.width.min(64)));
        if used == 0 {
            row[last] = first;
            return;
        }
        let kept = row[last].map(|bits| bits & ((1 << used) - 1));
        row[last] = [0, 1, 2].map(|i| kept[i] | first[i] << used);
        row[last + 1] = first.map(|bits| bits >> (64 - used));
    }

    /// The stops of jumps along 64 lines through these rows, a word for each line, from a bit of each row on:
    /// these go on to those of the next lines.
    fn square<'r>(
        &self,
        rows: impl Iterator<Item = &'r [Stops]>,
        starts: &mut [usize; 64],
        squares: &mut [[u64; 64]; 3],
    ) {
        let mut used = 0;
        for (row, start) in rows.zip(starts) {
            let (word, shift) = (*start / 64, *start % 64);
            let (low, high) = (row[word], row[word + 1]);
            for (square, (low, high)) in squares.iter_mut().zip(low.into_iter().zip(high)) {
                square[used] = low >> shift | high << 1 << (63 - shift);
            }
            used += 1;
            *start += 64;
            if *start >= self.width {
                *start -= self.width;
            }
        }
        for square in squares {
            square[used..].fill(0);
            transpose(square);
        }
    }
}

/// The bits `start`, and those of the bits `through` that follow them without a break, from high to low bits
/// if `DOWN`.
pub(super) fn carried<const DOWN: bool>(start: u64, through: u64) -> u64 {
    if !DOWN {
        // An addition carries through all bits of a run from the first of those on.
        let first = start << 1 & through;
        return start | (first.wrapping_add(through) ^ through | first) & through;
    }
    let (mut start, mut through) = (start, through);
    for by in [1, 2, 4, 8, 16, 32] {
        start |= through & start >> by;
        through &= through >> by;
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

/// The vertices from which axial jumps in a direction come to a jump point that is none of the dead ends.
fn leads(
    ends: &EndRows,
    dead: &DeadEndRows,
    quarter: usize,
    interrupt: &Interrupt,
) -> Result<Vec<u64>, Interrupted> {
    let (ends, per_row) = (ends.of(quarter), ends.per_row);
    let (is_vertical, is_forward) = direction(quarter);
    let (height, mut leads) = (ends.len() / per_row, vec![0; ends.len()]);
    let no_dead = vec![0; per_row];
    // Which of the vertices of the row before answer a jump that arrives there.
    let mut arriving = vec![0; per_row];
    for i in 0..height {
        interrupt.check_every(16, i, DURING)?;
        // From the end of the jumps on.
        let y = if is_forward { height - 1 - i } else { i };
        let words = y * per_row..(y + 1) * per_row;
        let dead = dead.of(quarter).get(words.clone()).unwrap_or(&no_dead);
        let ends = ends[words.clone()].iter().zip(dead);
        let ends = ends.map(|(ends, dead)| JumpStops { jump: ends.jump & !dead, ..*ends });
        let row = &mut leads[words];
        if is_vertical {
            for ((to, arriving), ends) in row.iter_mut().zip(&mut arriving).zip(ends) {
                *to = *arriving;
                *arriving = !ends.dead & (ends.jump | *arriving);
            }
        } else if is_forward {
            row.iter_mut().zip(ends).rev().fold(0, |beyond, (to, ends)| {
                let here = answers::<true>(ends, beyond << 63);
                *to = here >> 1 | beyond << 63;
                here & 1
            });
        } else {
            row.iter_mut().zip(ends).fold(0, |beyond, (to, ends)| {
                let here = answers::<false>(ends, beyond);
                *to = here << 1 | beyond;
                here >> 63
            });
        }
    }
    Ok(leads)
}

/// From which of 64 vertices jumps that arrive there come to a jump point, or are at one; with `beyond` also
/// from that vertex from which they leave these. They go to high bits if `FORWARD`.
fn answers<const FORWARD: bool>(ends: JumpStops, beyond: u64) -> u64 {
    let start = (ends.jump | beyond) & !ends.dead;
    if start == 0 { 0 } else { carried::<FORWARD>(start, !ends.dead) }
}
