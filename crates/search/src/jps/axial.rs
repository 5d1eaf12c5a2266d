//! Scans along the axes by words: 64 vertices a step (block-based jumps: Harabor & Grastien 2014, 'Improving
//! Jump Point Search').
//!
//! An axial jump ends at its first *jump point*, a vertex with a forced successor (see [`JumpPointRule`]), or
//! where its move is not legal. Both depend on the map alone, on the two or three rows of cells along the
//! jump. So they are computed once, by operations on words of these rows, and stored: for each of the four
//! directions a bit plane of the vertices that end a jump which enters them. The planes of the backward
//! directions are mirrored. So a scan loads one row, and one code serves all directions without a branch on
//! the direction. (Where directions vary, mispredicted branches would be most of a scan's time.)
//!
//! Rule variants: all five, k = 2 and k = 3. Under closed gaps a jump ends before a gap.
//!
//! The planes take one byte a vertex (two bits a direction). A scan takes 3 to 4 ns; combining the rows anew
//! at every scan takes 5 to 7.5 ns (`docs/measurements/search.md`).

use mediant_grid::{
    BitMatrix, CornerRule, DiagonalGap, GridGraph, Interrupt, Interrupted, Placement, Rules, Vector,
    Versioned, Vertex, load, room_for, room_in,
};
use mediant_moves::FiniteK;

use super::{
    DURING,
    cell_rows::{CellRows, cells_of_line},
    zone::Zone,
};

mod answers;

pub(super) use self::answers::Answers;

/// Where an axial jump ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Scan {
    /// The number of steps to the jump point; for a dead jump that of all legal steps.
    pub(crate) steps: u32,
    /// Whether the jump ends at a jump point; otherwise it is dead.
    pub(crate) found: bool,
    /// The number of vertices looked at, with the one that a dead jump cannot enter.
    pub(crate) scanned: u32,
}

/// Which vertices of an axial jump are jump points. *Beside* means in the row on either side of the jump.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JumpPointRule {
    /// The cell beside the vertex is free and the one beside its predecessor is blocked. For centers where no
    /// diagonal move passes a blocked cell: `Never`, and k = 2.
    Behind,
    /// The cell beside the vertex is blocked and the one beside its successor is free: a diagonal move leads
    /// past the blocked cell. With `one` (corner rule `One`) the next cell of the jump must be free as well.
    Ahead { one: bool },
    /// For corners: as [`Behind`](Self::Behind), with the jump between the two rows of cells.
    Edges { closed: bool },
}

/// Which of 64 vertices end a jump, one bit each, the lowest for the first vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct JumpStops {
    /// Jump points, if the jump reaches them.
    pub(super) jump: u64,
    /// Vertices that the jump cannot enter.
    pub(super) dead: u64,
}

impl JumpPointRule {
    /// The rule of a grid graph.
    pub(super) fn of<P: Placement>(graph: &GridGraph<P>) -> Self {
        match graph.rules() {
            // A grid graph has no vertices between centers by corners.
            Rules::Corner(gap) | Rules::CenterGap(gap) => Self::Edges { closed: gap == DiagonalGap::Closed },
            Rules::Center(rule) if rule == CornerRule::Never || graph.k() == FiniteK::N4 => Self::Behind,
            Rules::Center(rule) => Self::Ahead { one: rule == CornerRule::One },
        }
    }

    /// The ends among 64 vertices. `cells(ahead, row)` says which of the cells are blocked that lie `ahead`
    /// steps further on and `row` rows beside. At corners the cells of a vertex are the two beside the next
    /// step of the jump, in rows −1 and 0.
    #[inline(always)]
    pub(super) fn ends(self, cells: impl Fn(i32, i32) -> u64) -> JumpStops {
        match self {
            Self::Behind => {
                let opens = |row| cells(-1, row) & !cells(0, row);
                JumpStops { jump: opens(-1) | opens(1), dead: cells(0, 0) }
            }
            Self::Ahead { one } => {
                let opens = |row| cells(0, row) & !cells(1, row);
                let barred = if one { cells(1, 0) } else { 0 };
                JumpStops { jump: (opens(-1) | opens(1)) & !barred, dead: cells(0, 0) }
            }
            Self::Edges { closed } => {
                let [passed, next] = [-1, 0].map(|ahead| [-1, 0].map(|row| cells(ahead, row)));
                let jump = passed[0] & !next[0] | passed[1] & !next[1];
                let gap = (passed[0] ^ next[0]) & !(passed[0] ^ next[1]) & !(next[0] ^ passed[1]);
                JumpStops { jump, dead: passed[0] & passed[1] | if closed { gap } else { 0 } }
            }
        }
    }

    /// The ends of a jump by `v`, along either axis, at vertex (x, y) and at the next 63 of its row.
    pub(super) fn ends_in_row<P: Placement>(
        self,
        rows: &BitMatrix,
        (x, y): (i32, i32),
        v: Vector,
    ) -> JumpStops {
        let at = rows.index(x, y);
        self.ends(|ahead, beside| {
            let along = P::cell(v.x + v.y, ahead);
            let (dx, dy) = if v.y == 0 { (along, beside) } else { (beside, along) };
            load(rows.words(), at.offset(dx + dy * rows.bits_per_row()))
        })
    }

    /// The ends at vertex `u` of line `v` of a matrix and at the next 63 vertices of the jump.
    fn ends_from<P: Placement>(self, matrix: &BitMatrix, (u, v): (i32, i32), forward: bool) -> JumpStops {
        let (at, row) = (matrix.index(u, v), matrix.bits_per_row());
        // Backward, the cell of the first vertex is the last of the 64; at corners it is the one before.
        let (first, sign) = if forward { (0, 1) } else { (P::cell(-1, 0) - 63, -1) };
        let ends =
            self.ends(|ahead, beside| load(matrix.words(), at.offset(first + sign * ahead + beside * row)));
        let turned = |word: u64| if forward { word } else { word.reverse_bits() };
        JumpStops { jump: turned(ends.jump), dead: turned(ends.dead) }
    }
}

/// The vertices where axial jumps in the four directions end, for k ≤ 3.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct AxialStops {
    planes: [BitPlane; 4],
    /// For 64 vertices of a line two bits each: both for a vertex that a jump cannot enter, the first for a
    /// jump point, the second for one that is a [dead end](super::dead_ends).
    words: Versioned<[u64; 2]>,
}

/// A vertex as jumps in one direction find it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Finding {
    /// They go on.
    Passed,
    JumpPoint,
    /// A jump point that is a [dead end](super::dead_ends).
    DeadEnd,
    /// They cannot enter it.
    Blocked,
}

/// A jump point of the axial jumps in one direction, and whether it is a dead end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct JumpPoint {
    pub(super) at: Vertex,
    pub(super) quarter: usize,
    pub(super) is_dead_end: bool,
}

/// Whether the jumps of a direction go along a column, and whether to larger coordinates.
pub(super) const fn direction(quarter: usize) -> (bool, bool) {
    (quarter.is_multiple_of(2), quarter < 2)
}

/// Where the bits of one direction are: the bit of vertex (x, y) is at `origin` + `per_x` · x + `per_y` · y,
/// and the bit of the next vertex of a jump follows it. (In 64 bits on every target: the number of bits is
/// eight times that of bytes.)
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct BitPlane {
    origin: i64,
    per_x: i64,
    per_y: i64,
    /// Its first word, and the first one after it.
    words: (usize, usize),
}

impl BitPlane {
    /// The place of the bit of a vertex of the map.
    #[inline]
    const fn place(&self, at: Vertex) -> u64 {
        (self.origin + self.per_x * at.x as i64 + self.per_y * at.y as i64) as u64
    }

    /// The vertex of a bit. (Lines are further apart than the vertices of a line.)
    fn vertex(&self, place: u64) -> Vertex {
        let is_vertical = self.per_x.abs() > self.per_y.abs();
        let (across, along) = if is_vertical { (self.per_x, self.per_y) } else { (self.per_y, self.per_x) };
        let bit = place as i64 - 64 * self.words.0 as i64;
        let from_start = bit % across;
        let start = self.origin - 64 * self.words.0 as i64;
        let (line, u) = ((bit / across) as i32, ((from_start - start) * along) as i32);
        vertex_of(is_vertical, (u, line))
    }

    /// Calls `visit` with the words that hold the bits of a zone, for jumps in direction `quarter`.
    #[inline]
    fn for_each_word(&self, quarter: usize, zone: Zone, mut visit: impl FnMut(LineWord)) {
        let Zone { first, last } = zone;
        let (is_vertical, is_forward) = direction(quarter);
        let (rows, columns) = ((first.y, last.y), (first.x, last.x));
        let (lines, (low, high)) = if is_vertical { (columns, rows) } else { (rows, columns) };
        let (from, to, sign) = if is_forward { (low, high, 1) } else { (high, low, -1) };
        let across = if is_vertical { self.per_x } else { self.per_y };
        let [mut first, mut last] = [from, to].map(|u| self.place(vertex_of(is_vertical, (u, lines.0))));
        for line in lines.0..=lines.1 {
            for word in first >> 6..=last >> 6 {
                let bits = !0 << first.saturating_sub(64 * word) & !0 >> (63 - (last - 64 * word).min(63));
                let u = from + sign * ((64 * word) as i64 - first as i64) as i32;
                visit(LineWord { quarter, word: word as usize, bits, place: (u, line) });
            }
            [first, last] = [first, last].map(|place| place.wrapping_add_signed(across));
        }
    }
}

/// A vertex by its place in its line, and its line.
const fn vertex_of(is_vertical: bool, (u, line): (i32, i32)) -> Vertex {
    if is_vertical { Vertex::new(line, u) } else { Vertex::new(u, line) }
}

/// A word of a line of a plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineWord {
    pub(super) quarter: usize,
    word: usize,
    /// The bits that are looked at.
    bits: u64,
    /// The vertex of the lowest bit, which may lie outside of the map: its place in the line, and the line.
    place: (i32, i32),
}

impl LineWord {
    /// Of its bits those of vertices of a map.
    pub(super) fn within(self, map: Zone) -> u64 {
        let ((is_vertical, is_forward), (u, _)) = (direction(self.quarter), self.place);
        let last = if is_vertical { map.last.y } else { map.last.x };
        // As many lie before the first vertex of the line, and as many from the first to the last one.
        let (before, up_to) = if is_forward { (-u, last - u + 1) } else { (u - last, u + 1) };
        let below = |count: i32| !u64::MAX.checked_shl(count.max(0) as u32).unwrap_or(0);
        below(up_to) & !below(before)
    }

    /// Calls `visit` with the vertices of some of its bits, and with the bits.
    #[inline]
    pub(super) fn for_each(self, bits: u64, mut visit: impl FnMut(Vertex, u64)) {
        let ((is_vertical, is_forward), (u, line)) = (direction(self.quarter), self.place);
        let mut left = bits & self.bits;
        while left != 0 {
            let bit = left.trailing_zeros() as i32;
            let u = if is_forward { u + bit } else { u - bit };
            visit(vertex_of(is_vertical, (u, line)), 1 << bit);
            left &= left - 1;
        }
    }
}

impl AxialStops {
    /// The number of pairs of words: two of each line lie across the map, two along it. A scan reads two.
    fn words<P: Placement>(graph: &GridGraph<P>) -> usize {
        let (width, height) = P::vertices(graph.grid());
        let words_of = |length: u32, lines: u32| (length as usize / 64 + 1) * lines as usize;
        2 * (words_of(height, width) + words_of(width, height)) + 1
    }

    /// The memory that the planes of a grid graph use, in bytes.
    pub(crate) fn bytes<P: Placement>(graph: &GridGraph<P>) -> usize {
        Self::words(graph).saturating_mul(size_of::<[u64; 2]>())
    }

    /// Computes the planes of a grid graph.
    pub(crate) fn new<P: Placement>(
        graph: &GridGraph<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let grid = graph.grid();
        let (width, height) = P::vertices(grid);
        let rule = JumpPointRule::of(graph);
        room_for::<[u64; 2]>(Self::words(graph), DURING)?;
        let mut words = Vec::with_capacity(Self::words(graph));
        let mut plane = |quarter: usize| {
            let (vertical, forward) = direction(quarter);
            let (matrix, length, lines) =
                if vertical { (grid.columns(), height, width) } else { (grid.rows(), width, height) };
            let first = 64 * words.len() as i64;
            let per_line = length / 64 + 1;
            let mut cells = [const { Vec::new() }; 3];
            for line in -2..lines as i32 {
                cells.rotate_left(1);
                cells_of_line::<P>(matrix, line + 1, (length, forward), &mut cells[2]);
                if line < 0 {
                    continue;
                }
                interrupt.check(DURING)?;
                let around = CellRows::of([0, 1, 2].map(|i| &*cells[i])).words();
                words.extend((0..per_line).zip(around).map(|(word, around)| {
                    let JumpStops { jump, dead } = rule.ends(|ahead, row| around.at((ahead, row)));
                    // Bits beyond the end of the line are no part of it.
                    let dead = dead | u64::MAX.checked_shl(length - 64 * word).unwrap_or(0);
                    [jump | dead, dead]
                }));
            }
            let along = if forward { 1 } else { -1 };
            let across = 64 * i64::from(per_line);
            let origin = if forward { first } else { first + i64::from(length) - 1 };
            let (per_x, per_y) = if vertical { (across, along) } else { (along, across) };
            Ok(BitPlane { origin, per_x, per_y, words: (first as usize / 64, words.len()) })
        };
        let planes = [plane(0)?, plane(1)?, plane(2)?, plane(3)?];
        words.push([!0; 2]);
        Ok(Self { planes, words: words.into() })
    }

    /// The planes of a grid graph of the same size, on which jumps may find the vertices of these zones
    /// otherwise, and no others. No jump point of a zone is a dead end. With those that they find otherwise,
    /// each with the direction of the jumps.
    pub(super) fn with_zones<P: Placement>(
        &self,
        graph: &GridGraph<P>,
        zones: &[Zone],
        interrupt: &Interrupt,
    ) -> Result<(Self, Vec<(Vertex, usize)>), Interrupted> {
        let (grid, rule) = (graph.grid(), JumpPointRule::of(graph));
        let (mut edit, mut differences) = (self.words.edit_if_room(DURING)?, Vec::new());
        for &zone in zones {
            interrupt.check(DURING)?;
            room_in(&mut differences, 1 << 10, DURING)?;
            for quarter in 0..4 {
                let (vertical, forward) = direction(quarter);
                let matrix = if vertical { grid.columns() } else { grid.rows() };
                self.planes[quarter].for_each_word(quarter, zone, |line| {
                    let JumpStops { jump, dead } = rule.ends_from::<P>(matrix, line.place, forward);
                    let [one, other] = edit.words()[line.word];
                    let with = |was: u64, is: u64| was & !line.bits | is & line.bits;
                    let (is, was) = ([with(one, jump | dead), with(other, dead)], self.words[line.word]);
                    edit.set(line.word, is);
                    line.for_each(was[0] ^ is[0] | was[1] ^ is[1], |at, _| differences.push((at, quarter)));
                });
            }
        }
        Ok((Self { planes: self.planes, words: edit.finish() }, differences))
    }

    /// Makes those jump points dead ends that are dead ends in planes of the same size.
    pub(super) fn take_dead_ends(&mut self, before: &Self) {
        for ([one, other], [was_one, was_other]) in self.words.make_mut().iter_mut().zip(before.words.iter())
        {
            let dead_ends = was_other & !was_one & *one & !*other;
            (*one, *other) = (*one & !dead_ends, *other | dead_ends);
        }
    }

    /// These planes, where jump points may be dead ends or not.
    pub(super) fn with_jump_points(self, points: &[JumpPoint]) -> Self {
        let mut edit = self.words.into_edit();
        for &JumpPoint { at, quarter, is_dead_end } in points {
            let place = self.planes[quarter].place(at);
            let (word, bit) = ((place >> 6) as usize, 1 << (place & 63));
            let [one, other] = edit.words()[word];
            edit.set(word, if is_dead_end { [one & !bit, other | bit] } else { [one | bit, other & !bit] });
        }
        Self { planes: self.planes, words: edit.finish() }
    }

    /// Calls `visit` with the jump points of a direction in a zone, or with the dead ends alone.
    pub(super) fn for_each_jump_point(
        &self,
        (zone, quarter): (Zone, usize),
        dead_ends_alone: bool,
        mut visit: impl FnMut(JumpPoint),
    ) {
        self.planes[quarter].for_each_word(quarter, zone, |line| {
            let [one, other] = self.words[line.word];
            let bits = if dead_ends_alone { other & !one } else { one ^ other };
            line.for_each(bits, |at, bit| visit(JumpPoint { at, quarter, is_dead_end: other & bit != 0 }));
        });
    }

    /// Calls `visit` with the jump points of a direction.
    pub(super) fn for_each_jump_point_of_map(&self, quarter: usize, mut visit: impl FnMut(JumpPoint)) {
        let (plane, (is_vertical, is_forward)) = (&self.planes[quarter], direction(quarter));
        let per_line = if is_vertical { plane.per_x } else { plane.per_y } as usize / 64;
        let length = plane.origin - 64 * plane.words.0 as i64;
        let (start, sign) = if is_forward { (0, 1) } else { (length as i32, -1) };
        let lines = self.words[plane.words.0..plane.words.1].chunks_exact(per_line);
        for (line, words) in (0..).zip(lines) {
            for (&[one, other], first) in words.iter().zip((0..).step_by(64)) {
                // Beyond the end of the line there are none.
                let mut left = one ^ other;
                while left != 0 {
                    let bit = left.trailing_zeros();
                    let at = vertex_of(is_vertical, (start + sign * (first + bit as i32), line));
                    visit(JumpPoint { at, quarter, is_dead_end: other >> bit & 1 == 1 });
                    left &= left - 1;
                }
            }
        }
    }

    /// A vertex of the map as jumps in a direction find it in these planes, and in others of the same size.
    #[inline]
    pub(super) fn findings(&self, other: &Self, at: Vertex, quarter: usize) -> [Finding; 2] {
        let place = self.planes[quarter & 3].place(at);
        let (word, bit) = ((place >> 6) as usize, place & 63);
        [self, other].map(|stops| match stops.words[word].map(|word| word >> bit & 1 == 1) {
            [false, false] => Finding::Passed,
            [true, false] => Finding::JumpPoint,
            [false, true] => Finding::DeadEnd,
            [true, true] => Finding::Blocked,
        })
    }

    /// The axial jump from a vertex of the map in direction number `quarter` < 4: (0, 1), (1, 0), (0, −1),
    /// (−1, 0). It passes dead ends, unless these count as jump points.
    #[inline]
    pub(crate) fn scan(&self, from: Vertex, quarter: usize, with_dead_ends: bool) -> Scan {
        let mask = if with_dead_ends { !0 } else { 0 };
        let (scanned, is_blocked) = self.first(from, quarter, |one, other| one | other & mask);
        Scan { steps: scanned - u32::from(is_blocked), found: !is_blocked, scanned }
    }

    /// The number of legal steps from a vertex in a direction.
    pub(super) fn legal_steps(&self, from: Vertex, quarter: usize) -> u32 {
        self.first(from, quarter, |one, other| one & other).0 - 1
    }

    /// After how many steps a jump enters a vertex that stops it, and whether it cannot enter it.
    /// `stops` says by their two bits which of 64 vertices stop it.
    #[inline]
    fn first(&self, from: Vertex, quarter: usize, stops: impl Fn(u64, u64) -> u64) -> (u32, bool) {
        let at = self.planes[quarter & 3].place(from) + 1;
        let (mut word, shift) = ((at >> 6) as usize, at & 63);
        let Some(&[low, high]) = self.words.get(word..word + 2) else { return (1, true) };
        // Shifting in two steps avoids a shift by 64 where `shift` is 0.
        let [mut one, mut other] = [0, 1].map(|i| low[i] >> shift | high[i] << 1 << (63 - shift));
        let mut steps = 1;
        loop {
            let stop = stops(one, other);
            if stop != 0 {
                let n = stop.trailing_zeros();
                return (steps + n, (one & other) >> n & 1 == 1);
            }
            // From here on whole words, of the first of which some vertices are known.
            steps = if steps == 1 { 65 - shift as u32 } else { steps + 64 };
            word += 1;
            let Some(&next) = self.words.get(word) else { return (steps, true) };
            [one, other] = next;
        }
    }

    /// Makes those jump points of a direction dead ends for which `is_dead_end` says so.
    pub(super) fn mark(
        &mut self,
        quarter: usize,
        interrupt: &Interrupt,
        mut is_dead_end: impl FnMut(&Self, Vertex) -> bool,
    ) -> Result<(), Interrupted> {
        let plane = self.planes[quarter];
        for word in plane.words.0..plane.words.1 {
            interrupt.check_every(64, word, DURING)?;
            let [one, other] = self.words[word];
            let (mut jump_points, mut dead_ends) = (one & !other, 0);
            while jump_points != 0 {
                let bit = jump_points.trailing_zeros();
                let at = plane.vertex(64 * word as u64 + u64::from(bit));
                dead_ends |= u64::from(is_dead_end(self, at)) << bit;
                jump_points &= jump_points - 1;
            }
            if dead_ends != 0 {
                self.words.make_mut()[word] = [one & !dead_ends, other | dead_ends];
            }
        }
        Ok(())
    }

    /// Whether a vertex is a dead end for jumps in a direction.
    #[cfg(test)]
    pub(super) fn is_dead_end(&self, at: Vertex, quarter: usize) -> bool {
        self.findings(self, at, quarter) == [Finding::DeadEnd; 2]
    }

    /// The number of jump points of all directions.
    pub(super) fn jump_points(&self) -> u64 {
        self.words.iter().map(|[one, other]| u64::from((one ^ other).count_ones())).sum()
    }

    /// The memory used, in bytes.
    pub(crate) fn memory_bytes(&self) -> usize {
        size_of_val(&*self.words)
    }
}
