//! The rule for k ≤ 3 as a table: arriving move × pattern of cells around the vertex → successors.
//!
//! The table is computed by operations on sets of patterns: a move or an alternative is legal in the patterns
//! in which all cells that it requires are free.

use std::ops::{BitAnd, BitOr, Not};

use mediant_grid::{CellOffset, Centers, Corners, GridGraph, Placement, Vertex};
use mediant_moves::Vector;

use super::{
    alternatives::{MoveTable, Requirements},
    order::natural,
};

const _: () = assert!(Centers::PATTERNS == 512 && Corners::PATTERNS <= 512);

/// For each arriving move and each pattern, the moves by which a path goes on, a bit each.
#[derive(Clone, Debug)]
pub(crate) struct PatternTable {
    successors: Box<[u8]>,
    /// For each pattern the legal moves.
    legal: Box<[u8]>,
    patterns: usize,
    /// For each arriving move, those that follow it on open ground.
    natural: [u8; 8],
    diagonals_may_force: bool,
}

impl PatternTable {
    pub(crate) fn new<P: Placement>(moves: &MoveTable<P>) -> Self {
        let (cells, count) = (CellPatterns::new::<P>(), moves.len());
        let legal: Vec<Patterns> = (0..count)
            .map(|b| cells.satisfied(&moves.requirements(Vector::default(), &[b]), Patterns::NONE))
            .collect();
        let mut table = Self {
            successors: vec![0; count * P::PATTERNS].into_boxed_slice(),
            legal: vec![0; P::PATTERNS].into_boxed_slice(),
            patterns: P::PATTERNS,
            natural: [0; 8],
            diagonals_may_force: false,
        };
        for (b, legal) in legal.iter().enumerate() {
            legal.for_each(|pattern| table.legal[pattern] |= 1 << b);
        }
        for (a, successors) in table.successors.chunks_exact_mut(P::PATTERNS).enumerate() {
            for b in natural(a, count) {
                table.natural[a] |= 1 << b;
            }
            // Where no path arrives by move a, there are no forced successors.
            let arrives = cells.satisfied(&moves.requirements(-moves.vectors[a], &[a]), Patterns::ALL);
            for (b, &legal) in legal.iter().enumerate() {
                let mut kept = legal;
                if table.natural[a] >> b & 1 == 0 {
                    kept = kept & arrives;
                    moves.alternatives(a, b, |sequence| {
                        let mut alternative = moves.requirements(-moves.vectors[a], sequence);
                        if count == 4 {
                            // At k = 2 nothing is pruned on a map with gaps: this is for maps without.
                            alternative.passed.clear();
                        }
                        // Cells outside the pattern are unknown: no alternative may rely on them.
                        kept = kept & !cells.satisfied(&alternative, Patterns::NONE);
                    });
                    table.diagonals_may_force |= a % 2 == 1 && kept != Patterns::NONE;
                }
                kept.for_each(|pattern| successors[pattern] |= 1 << b);
            }
        }
        table
    }

    /// The moves by which a path goes on that arrived by move `by` where the cells form `pattern`.
    #[inline]
    pub(crate) fn successors(&self, by: usize, pattern: usize) -> u8 {
        self.successors.get(by * self.patterns + pattern).copied().unwrap_or(0)
    }

    /// The legal moves where the cells form `pattern`.
    #[inline]
    pub(crate) fn legal(&self, pattern: usize) -> u8 {
        self.legal.get(pattern).copied().unwrap_or(0)
    }

    /// The forced ones of these successors.
    #[inline]
    pub(crate) fn forced(&self, by: usize, successors: u8) -> u8 {
        successors & !self.natural[by & 7]
    }

    #[inline]
    pub(crate) const fn diagonals_may_force(&self) -> bool {
        self.diagonals_may_force
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        size_of_val(&*self.successors) + size_of_val(&*self.legal)
    }
}

/// The pattern of cells around a vertex of the map.
#[inline]
pub(crate) fn pattern_at<P: Placement>(graph: &GridGraph<P>, at: Vertex) -> usize {
    let rows = graph.grid().rows();
    P::pattern(rows.words(), rows.index(at.x, at.y), rows.bits_per_row())
}

/// A set of patterns, a bit each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Patterns([u64; 8]);

impl Patterns {
    const NONE: Self = Self([0; 8]);
    const ALL: Self = Self([!0; 8]);

    fn for_each(self, mut each: impl FnMut(usize)) {
        for (mut word, base) in self.0.into_iter().zip((0..).step_by(64)) {
            while word != 0 {
                each(base + word.trailing_zeros() as usize);
                word &= word - 1;
            }
        }
    }
}

impl BitAnd for Patterns {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] & other.0[i]))
    }
}

impl BitOr for Patterns {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] | other.0[i]))
    }
}

impl Not for Patterns {
    type Output = Self;
    fn not(self) -> Self {
        Self(self.0.map(|word| !word))
    }
}

/// For each of the 3 × 3 cells around a vertex, the patterns in which it is free; `None` for a cell that
/// patterns do not hold.
struct CellPatterns([[Option<Patterns>; 3]; 3]);

impl CellPatterns {
    fn new<P: Placement>() -> Self {
        let free = |(x, y): CellOffset| {
            P::pattern_holds(x, y).then(|| {
                let mut patterns = Patterns::NONE;
                for pattern in (0..P::PATTERNS).filter(|&pattern| !P::pattern_is_blocked(pattern, x, y)) {
                    patterns.0[pattern / 64] |= 1 << (pattern % 64);
                }
                patterns
            })
        };
        Self([-1, 0, 1].map(|y| [-1, 0, 1].map(|x| free((x, y)))))
    }

    /// The patterns in which the requirements are satisfied, when each cell that patterns do not hold counts
    /// as free in the patterns `unknown`.
    fn satisfied(&self, required: &Requirements, unknown: Patterns) -> Patterns {
        let free = |(x, y): CellOffset| {
            let row = self.0.get((y + 1) as usize).and_then(|row| row.get((x + 1) as usize));
            row.copied().flatten().unwrap_or(unknown)
        };
        let all = required.free.iter().fold(Patterns::ALL, |all, &cell| all & free(cell));
        let all = required.either.iter().fold(all, |all, &[a, b]| all & (free(a) | free(b)));
        required.passed.iter().fold(all, |all, &at| {
            let beside = Requirements::beside(at).map(|[a, b]| free(a) & free(b));
            all & beside.into_iter().fold(Patterns::NONE, BitOr::bitor)
        })
    }
}
