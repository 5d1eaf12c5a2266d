//! The moves beyond N(5), which are read from a table.

use mediant_moves::Vector;

use super::{Scanner, Visit};
use crate::{
    gaps::is_lower,
    moves::{Factor, Moves},
};

/// The moves that are read from a table, and the cells that they read.
#[derive(Clone, Debug)]
pub(super) struct Far {
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
    pub(super) fn new(moves: &Moves, is_far: impl Fn(Vector) -> bool) -> Self {
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
    /// The moves beyond N(5).
    pub(super) fn scan_far(&self, weights: &[u32], (state, cost): (usize, u64), visit: &mut impl Visit) {
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
}
