//! Rows of cells by words: those around 64 vertices of a row, and where axial jumps end among these.

use mediant_grid::{BitMatrix, Grid, GridGraph, Interrupt, Interrupted, Placement, load, room_for};

use super::{
    DURING,
    axial::{JumpPointRule, JumpStops},
};

/// The rows of cells around a row of vertices: the row above it, its own, and the one below. Each has a word
/// more before its first one and after its last one.
#[derive(Clone, Copy)]
pub(super) struct CellRows<'m>([&'m [u64]; 3]);

/// The cells around 64 vertices: of each row the words before, at and after them.
#[derive(Clone, Copy)]
pub(super) struct Around([[u64; 3]; 3]);

impl<'m> CellRows<'m> {
    /// The rows around row y of the vertices, which has so many words.
    pub(super) fn new(matrix: &'m BitMatrix, y: i32, words: usize) -> Self {
        Self([y - 1, y, y + 1].map(|y| {
            // No row follows the frame, below which there are no cells of vertices.
            let first = matrix.index(0, y.min(matrix.height() as i32)).0 as usize / 64;
            &matrix.words()[first - 1..=first + words]
        }))
    }

    /// Three rows of words.
    pub(super) const fn of(rows: [&'m [u64]; 3]) -> Self {
        Self(rows)
    }

    /// The cells around each word of vertices.
    pub(super) fn words(self) -> impl Iterator<Item = Around> + 'm {
        let of = |words: &[u64]| words.first_chunk().copied().unwrap_or([!0; 3]);
        let [above, here, below] = self.0.map(|row| row.windows(3).map(of));
        above.zip(here).zip(below).map(|((above, here), below)| Around([above, here, below]))
    }

    /// For each word of vertices, which of the cells are blocked at an offset of at most one.
    pub(super) fn at(self, (dx, dy): (i32, i32)) -> impl Iterator<Item = u64> + 'm {
        let first = (64 + dx) as usize;
        let (row, shift) = (&self.0[(dy + 1) as usize][first / 64..], first % 64);
        row.iter().zip(&row[1..]).map(move |(low, high)| low >> shift | high << 1 << (63 - shift))
    }
}

impl Around {
    /// Which of the cells are blocked at an offset of at most one.
    #[inline(always)]
    pub(super) const fn at(&self, (dx, dy): (i32, i32)) -> u64 {
        let [before, at, after] = self.0[(dy + 1) as usize];
        match dx {
            0 => at,
            1 => at >> 1 | after << 63,
            _ => at << 1 | before >> 63,
        }
    }
}

/// The cells of the vertices of a line in the order of a jump, with those of one word before and one after.
pub(super) fn cells_of_line<P: Placement>(
    matrix: &BitMatrix,
    line: i32,
    (length, forward): (u32, bool),
    cells: &mut Vec<u64>,
) {
    cells.clear();
    // No line follows the frame, and no jump asks for one.
    let (line, last_word) = (line.min(matrix.height() as i32), length as i32 / 64 + 1);
    if forward {
        let before = matrix.index(-64, line).0 as usize / 64;
        cells.extend(matrix.words()[before..].iter().take(last_word as usize + 2));
        // The last word may hold no vertex.
        cells.resize(last_word as usize + 2, !0);
    } else {
        // The cell of the first vertex is the last one of 64.
        let first = matrix.index(length as i32 - 1 + P::cell(-1, 0) - 63, line);
        let word = |word: i32| load(matrix.words(), first.offset(-64 * word)).reverse_bits();
        cells.extend((-1..=last_word).map(word));
    }
}

/// For axial jumps in each direction, where they end, in rows.
pub(super) struct EndRows {
    rows: [Vec<JumpStops>; 4],
    pub(super) per_row: usize,
}

impl EndRows {
    /// The ends on a grid graph with k ≤ 3.
    pub(super) fn new<P: Placement>(
        graph: &GridGraph<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        Self::on(graph.grid(), graph, interrupt)
    }

    /// The ends on another map, under the rule of motion and with the k of a grid graph.
    pub(super) fn on<P: Placement>(
        grid: &Grid,
        graph: &GridGraph<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let (width, height) = P::vertices(grid);
        let (rule, per_row) = (JumpPointRule::of(graph), width.div_ceil(64) as usize);
        let (mut rows, between) = ([const { Vec::new() }; 4], 8 / graph.steps().len());
        let words = per_row * height as usize;
        room_for::<JumpStops>(words * graph.steps().len() / 2, DURING)?;
        rows.iter_mut().step_by(between).for_each(|rows| rows.reserve_exact(words));
        for y in 0..height as i32 {
            interrupt.check(DURING)?;
            for around in CellRows::new(grid.rows(), y, per_row).words() {
                let down = |sign| rule.ends(|ahead, beside| around.at((beside, P::cell(sign, ahead))));
                let right = |sign| rule.ends(|ahead, beside| around.at((P::cell(sign, ahead), beside)));
                rows[0].push(down(1));
                rows[2].push(down(-1));
                if between == 1 {
                    rows[1].push(right(1));
                    rows[3].push(right(-1));
                }
            }
        }
        Ok(Self { rows, per_row })
    }

    /// The words for a direction; none if no axial jumps go there.
    pub(super) fn of(&self, quarter: usize) -> &[JumpStops] {
        &self.rows[quarter]
    }
}
