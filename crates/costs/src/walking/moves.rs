//! The moves between centers, cut into pieces.
//!
//! A move from center to center passes the lines that join the centers of neighboring cells: those along y at
//! multiples of 1 / |dx| of its length, those along x at multiples of 1 / |dy|. All are multiples of
//! 1 / (|dx| |dy|), a *share*. Where it passes a line between two cells, its height is that between their
//! heights, a multiple of 1 / (|dx| |dy|) of a unit. So heights where it is cut are exact.
//!
//! A line is there if both of its cells are free. Where one is blocked, the move is not cut.

use mediant_grid::PlacementKind;
use mediant_moves::{Cost, FiniteK, KError, Neighborhood, Vector};

use super::{
    Heading,
    map::{BLOCKED, WalkingMap},
    table::SLOPE_DIGITS,
};
use crate::{
    moves::{Factor, Part, parts, touched},
    scale::{exp2, floor_log2, length},
};

/// A move.
#[derive(Clone, Debug)]
pub(super) struct Move {
    pub(super) vector: Vector,
    pub(super) factor: Factor,
    /// The cost where a unit of length takes the least time.
    pub(super) least: u64,
    /// The cuts, the last of which is its end.
    cuts: Box<[Cut]>,
    /// The cells that it crosses.
    parts: Box<[CellPart]>,
    /// The two cells that it touches in the corner through which it passes; where there are none, the cell
    /// where it begins.
    touched: [u16; 2],
    /// By the shares of a piece: the slope for a difference of 1 of its heights at the cuts, in fixed point.
    slopes: Box<[u64]>,
    /// The number of shares.
    shares: i64,
}

/// A place where a move is cut.
#[derive(Clone, Copy, Debug)]
struct Cut {
    /// The cells whose centers the line joins, the nearer one first.
    cells: [u16; 2],
    /// The parts of their heights, in shares.
    weights: [i64; 2],
    /// The shares from the cut before.
    length: u16,
}

/// A cell that a move crosses, by its number, with its part of the length, in halves of shares.
#[derive(Clone, Copy, Debug)]
struct CellPart {
    cell: u16,
    halves: u16,
}

/// The moves of N(k), in the order of [`Neighborhood`], and the cells that they read.
#[derive(Clone, Debug)]
pub(super) struct Moves {
    pub(super) all: Box<[Move]>,
    /// From the vertex, which is the first.
    pub(super) cells: Box<[(i8, i8)]>,
    /// The binary digits of the slopes' fixed point.
    shift: u32,
}

impl Moves {
    pub(super) fn new(k: FiniteK, map: &WalkingMap) -> Result<Self, KError> {
        let mut cells: Vec<(i8, i8)> = vec![(0, 0)];
        let mut number = |cell: (i8, i8)| {
            cells.iter().position(|&known| known == cell).unwrap_or_else(|| {
                cells.push(cell);
                cells.len() - 1
            }) as u16
        };
        let (width, height) = map.cell_size();
        let steep = map.height_unit() / width.min(height) * exp2(SLOPE_DIGITS as i32);
        // The slope of one unit of height on the shortest way is below 2⁶².
        let shift = (61 - floor_log2(steep)).clamp(1, 120) as u32;
        let moves = Neighborhood::new(k)?.iter().map(|vector| {
            let length = length(map.cell_size(), vector);
            let cuts = cuts(vector, &mut number);
            let shares = cuts.iter().map(|cut| u32::from(cut.length)).sum::<u32>();
            let halves = |part: Part| CellPart { cell: number((part.dx, part.dy)), halves: part.share };
            let parts = parts(PlacementKind::Center, vector).0.into_iter().map(halves).collect();
            let touched = touched(PlacementKind::Center, vector).unwrap_or([(0, 0); 2]).map(&mut number);
            let (least, greatest) = map.times();
            let factor = Factor::new(map.units(length), 2 * shares, (least, greatest));
            let slope = |shares: u32| {
                // A difference of heights in shares, over a part of the length in shares.
                (map.height_unit() / (length * f64::from(shares)) * exp2((SLOPE_DIGITS + shift) as i32))
                    .round()
            };
            Move {
                vector,
                factor,
                least: factor.cost(2 * u64::from(shares) * least),
                cuts,
                parts,
                touched,
                slopes: (1..=shares).map(|shares| slope(shares) as u64).collect(),
                shares: shares.into(),
            }
        });
        let all = moves.collect();
        Ok(Self { all, cells: cells.into(), shift })
    }

    /// The least cost of a move with these sizes of coordinates.
    pub(super) fn least(&self, v: Vector) -> Cost {
        let known = self.all.iter().find(|known| known.vector.abs() == v.abs());
        Cost::from_bits(known.map_or(0, |known| known.least))
    }

    /// The cost of a move, by the heights of the cells around its beginning, or, towards sources, of the move
    /// against it; `None` if it is not legal. `allowed` is the rule of corners, `friction` that of a cell.
    #[inline]
    pub(super) fn cost(
        &self,
        (of, heading): (&Move, Heading),
        map: &WalkingMap,
        allowed: u8,
        height: impl Fn(u16) -> i32,
        friction: Option<impl Fn(u16) -> u64>,
    ) -> Option<u64> {
        let is_free = |cell: u16| height(cell) != BLOCKED;
        let [one, other] = of.touched.map(is_free);
        if allowed >> (u8::from(one) | u8::from(other) << 1) & 1 == 0
            || !of.parts.iter().all(|part| is_free(part.cell))
        {
            return None;
        }
        let at = |cell: u16| i64::from(height(cell));
        let mut sum = match friction {
            Some(friction) => of.parts.iter().map(|part| u64::from(part.halves) * friction(part.cell)).sum(),
            None => 0,
        };
        let (pace, is_reversed) = (map.pace(), heading == Heading::ToSources);
        let (mut before, mut length) = (of.shares * at(0), 0);
        for cut in &of.cuts {
            length += cut.length;
            let [near, far] = cut.cells;
            if !is_free(far) {
                continue;
            }
            let here = cut.weights[0] * at(near) + cut.weights[1] * at(far);
            let rise = if is_reversed { before - here } else { here - before };
            let product = u128::from(rise.unsigned_abs()) * u128::from(of.slopes[usize::from(length) - 1]);
            // As odd as the rise: a move costs the same from both of its ends.
            let steep = (((product >> (self.shift - 1)) + 1) >> 1).min(u128::from(pace.steepest())) as i64;
            let time = pace.time(if rise < 0 { -steep } else { steep });
            sum += 2 * u64::from(length) * time as u64;
            (before, length) = (here, 0);
        }
        Some(of.factor.cost(sum))
    }

    /// An upper bound of the costs of moves.
    pub(super) fn greatest(&self, map: &WalkingMap) -> u64 {
        let (_, greatest) = map.times();
        self.all.iter().map(|of| of.factor.cost(2 * of.shares as u64 * greatest)).max().unwrap_or(1)
    }

    pub(super) fn memory_bytes(&self) -> usize {
        let of_move = |of: &Move| {
            size_of::<Move>() + size_of_val(&*of.cuts) + size_of_val(&*of.parts) + size_of_val(&*of.slopes)
        };
        self.all.iter().map(of_move).sum::<usize>() + size_of_val(&*self.cells)
    }
}

/// The cuts of a move, in their order on the way.
fn cuts(v: Vector, number: &mut impl FnMut((i8, i8)) -> u16) -> Box<[Cut]> {
    let (a, b) = (v.x.abs(), v.y.abs());
    let shares = a.max(1) * b.max(1);
    let mut cell = |x: i32, y: i32| number(((x * v.x.signum()) as i8, (y * v.y.signum()) as i8));
    // The lines along y, then those along x; of each the share, the cells on both sides, and the part that
    // belongs to the second.
    let along_y = (1..a).map(|x| (x * b, (x, x * b / a), (x, x * b / a + 1), x * b % a * b));
    let along_x = (1..b).map(|y| (y * a, (y * a / b, y), (y * a / b + 1, y), y * a % b * a));
    let mut cuts: Vec<_> = along_y.chain(along_x).chain([(shares, (a, b), (a, b), 0)]).collect();
    cuts.sort_unstable();
    let mut last = 0;
    let cut = |(at, first, second, part): (i32, (i32, i32), (i32, i32), i32)| {
        let [(near, nearer), (far, farther)] = if 2 * part > shares {
            [(second, part), (first, shares - part)]
        } else {
            [(first, shares - part), (second, part)]
        };
        let length = (at - std::mem::replace(&mut last, at)) as u16;
        Cut {
            cells: [cell(near.0, near.1), cell(far.0, far.1)],
            weights: [nearer, farther].map(i64::from),
            length,
        }
    };
    cuts.into_iter().map(cut).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cell with its part of a height.
    type Weighed = ((i8, i8), i64);

    /// For each cut its share of the way, and the cells with their parts.
    fn of(x: i32, y: i32) -> Vec<(u16, [Weighed; 2])> {
        let mut cells = vec![(0, 0)];
        let mut number = |cell: (i8, i8)| {
            cells.push(cell);
            cells.len() as u16 - 1
        };
        let cuts = cuts(Vector::new(x, y), &mut number);
        let of =
            |cut: &Cut| (cut.length, [0, 1].map(|at| (cells[usize::from(cut.cells[at])], cut.weights[at])));
        cuts.iter().map(of).collect()
    }

    #[test]
    fn cuts_are_those_worked_by_hand() {
        assert_eq!(of(-1, 0), [(1, [((-1, 0), 1), ((-1, 0), 0)])]);
        assert_eq!(of(1, 1), [(1, [((1, 1), 1), ((1, 1), 0)])]);
        assert_eq!(of(1, -2), [(1, [((0, -1), 1), ((1, -1), 1)]), (1, [((1, -2), 2), ((1, -2), 0)])]);
        assert_eq!(
            of(3, 2),
            [
                (2, [((1, 1), 4), ((1, 0), 2)]),
                (1, [((1, 1), 3), ((2, 1), 3)]),
                (1, [((2, 1), 4), ((2, 2), 2)]),
                (2, [((3, 2), 6), ((3, 2), 0)]),
            ]
        );
    }
}
