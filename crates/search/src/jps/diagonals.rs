//! What is known of each vertex for a diagonal jump, a bit each: whether the jump's move is legal there, and
//! whether either axial jump beside it comes to a jump point.
//!
//! So a step of a diagonal jump loads one word, and scans along an axis only where there is something to
//! find. (Where the goal lies beside the jump is known from its coordinates.) The bits are computed 64
//! vertices at a time. Which vertices are jump points follows from the definition: the moves that may be
//! forced, and the alternatives to them. Which axial jumps come to one is carried from row to row, or along a
//! row from bit to bit.
//!
//! The bits take one byte a vertex, on top of the byte of [`AxialStops`](super::axial::AxialStops).

use mediant_grid::{BitMatrix, CellOffset, Footprint, GridGraph, Placement, Vector, Vertex, load};
use mediant_moves::Neighborhood;

use crate::canonical::{MoveTable, Pruning, Requirements, natural};

/// What is known of each vertex of a grid graph with k ≤ 3 for diagonal jumps.
#[derive(Clone, Debug)]
pub(crate) struct DiagonalBits {
    /// For 64 vertices of a row and each odd move: where the move is legal, and where an axial jump beside it
    /// comes to a jump point.
    words: Vec<[[u64; 4]; 2]>,
    per_row: usize,
}

impl DiagonalBits {
    pub(crate) fn new<P: Placement>(graph: &GridGraph<P>, pruning: &Pruning<P>) -> Self {
        let (width, height) = P::vertices(graph.grid());
        let per_row = width.div_ceil(64) as usize;
        let mut words = vec![[[0; 4]; 2]; per_row * height as usize];
        let Ok(all) = Neighborhood::new(graph.k()) else { return Self { words, per_row } };
        let moves = MoveTable::<P>::new(graph.rule(), all);
        let count = moves.len();
        let rows = graph.grid().rows();
        let place = |word: usize| ((word % per_row) as i32 * 64, (word / per_row) as i32);
        for (word, [legal, found]) in words.iter_mut().enumerate() {
            let (x, y) = place(word);
            for (legal, asked) in legal.iter_mut().zip(moves.footprints.iter().skip(1).step_by(2)) {
                *legal = holds(rows, (x, y), &asked.free, &asked.either);
            }
            // With closed gaps, scan from every vertex.
            *found = if graph.has_closed_gaps() { [!0; 4] } else { [0; 4] };
        }
        if graph.has_closed_gaps() {
            return Self { words, per_row };
        }
        for axial in (0..count).step_by(2) {
            let jump = AxialJump::new(&moves, pruning, axial);
            let ends = |word: usize| jump.ends(rows, place(word));
            let leads = jump.leads(&ends, per_row, height as usize);
            for (odd, index) in (1..count).step_by(2).enumerate() {
                if natural(index, count).any(|beside| beside == axial) {
                    words.iter_mut().zip(&leads).for_each(|(word, leads)| word[1][odd] |= leads);
                }
            }
        }
        Self { words, per_row }
    }

    /// Whether the odd move `index` is legal at a free vertex, and whether an axial jump beside it comes to a
    /// jump point.
    #[inline]
    pub(crate) fn at(&self, at: Vertex, index: usize) -> (bool, bool) {
        let (x, y) = (at.x as usize, at.y as usize);
        let Some(words) = self.words.get(y * self.per_row + (x >> 6)) else { return (false, false) };
        let bit = |words: &[u64; 4]| words[index >> 1 & 3] >> (x & 63) & 1 == 1;
        (bit(&words[0]), bit(&words[1]))
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        size_of_val(&*self.words)
    }
}

/// The move of an axial jump, and what makes a vertex one of its jump points.
struct AxialJump {
    v: Vector,
    step: Footprint,
    /// The moves that may be forced, each with those alternatives that depend on the pattern of cells around
    /// the vertex alone.
    forced: Vec<(Footprint, Vec<Requirements>)>,
}

impl AxialJump {
    fn new<P: Placement>(moves: &MoveTable<P>, pruning: &Pruning<P>, index: usize) -> Self {
        let v = moves.vectors[index];
        let forced = (0..moves.len()).filter(|&next| next != index && pruning.may_be_forced(index, next));
        let forced = forced.map(|next| {
            let mut alternatives = Vec::new();
            moves.alternatives(index, next, |sequence| {
                let required = moves.requirements(-v, sequence);
                let cells = required.free.iter().chain(required.either.as_flattened());
                if cells.copied().all(|(x, y)| P::pattern_holds(x, y)) {
                    alternatives.push(required);
                }
            });
            (moves.footprints[next].clone(), alternatives)
        });
        Self { v, step: moves.footprints[index].clone(), forced: forced.collect() }
    }

    /// Of 64 vertices, those that are jump points when the jump enters them, and those that it can enter.
    fn ends(&self, rows: &BitMatrix, (x, y): (i32, i32)) -> [u64; 2] {
        let jump = self.forced.iter().fold(0, |jump, (next, alternatives)| {
            let holds_around =
                |required: &Requirements| holds(rows, (x, y), &required.free, &required.either);
            let pruned = alternatives.iter().fold(0, |pruned, required| pruned | holds_around(required));
            jump | holds(rows, (x, y), &next.free, &next.either) & !pruned
        });
        [jump, holds(rows, (x - self.v.x, y - self.v.y), &self.step.free, &self.step.either)]
    }

    /// Of all vertices, those from which the jump comes to a jump point.
    fn leads(&self, ends: &impl Fn(usize) -> [u64; 2], per_row: usize, height: usize) -> Vec<u64> {
        let mut leads = vec![0; per_row * height];
        let ascending = self.v.x + self.v.y > 0;
        // Each word after the one that the jump enters next.
        for i in 0..leads.len() {
            let word = if ascending { leads.len() - 1 - i } else { i };
            leads[word] = if self.v.x == 0 {
                let next = word as isize + self.v.y as isize * per_row as isize;
                let Some(&beyond) = usize::try_from(next).ok().and_then(|next| leads.get(next)) else {
                    continue;
                };
                let [jump, enters] = ends(next as usize);
                enters & (jump | beyond)
            } else {
                // The jump from vertex x comes to a jump point if it can enter x + 1, and that is one or
                // leads to one.
                let next = (word % per_row) as isize + self.v.x as isize;
                let inside = (0..per_row as isize).contains(&next);
                let next = word.wrapping_add_signed(self.v.x as isize);
                let ([jump, enters], beyond) = (ends(word), if inside { leads[next] } else { 0 });
                let [next_jump, next_enters] = if inside { ends(next) } else { [0, 0] };
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
        leads
    }
}

/// The bits `start`, and those of the bits `through` that follow them without a break, from high to low bits
/// if `DOWN`.
fn carried<const DOWN: bool>(start: u64, through: u64) -> u64 {
    let (mut start, mut through) = (start, through);
    for by in [1, 2, 4, 8, 16, 32] {
        let shifted = |word: u64| if DOWN { word >> by } else { word << by };
        start |= through & shifted(start);
        through &= shifted(through);
    }
    start
}

/// Of 64 vertices from (x, y) on, those where the cells `free`, and one of each pair `either`, are free.
fn holds(rows: &BitMatrix, (x, y): (i32, i32), free: &[CellOffset], either: &[[CellOffset; 2]]) -> u64 {
    let at = rows.index(x, y);
    let cell = |&(dx, dy): &CellOffset| !load(rows.words(), at.offset(dy * rows.bits_per_row() + dx));
    let all = free.iter().fold(!0, |all, offset| all & cell(offset));
    either.iter().fold(all, |all, [a, b]| all & (cell(a) | cell(b)))
}
