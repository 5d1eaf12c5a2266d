//! The rule for k ≤ 3 as a table: incoming move × pattern of cells around the vertex → successors.

use mediant_grid::{CellOffset, Place};

use super::alternatives::{Asked, Moves};

/// For each incoming move and each pattern, the moves that a path goes on by, a bit each.
#[derive(Clone, Debug)]
pub(crate) struct NearTable {
    successors: Box<[u8]>,
    patterns: usize,
    /// For each incoming move, those that follow it on open ground.
    natural: [u8; 8],
    slanted_runs_turn: bool,
}

impl NearTable {
    pub(crate) fn new<P: Place>(moves: &Moves<P>) -> Self {
        let count = moves.len();
        let mut natural = [0; 8];
        let mut successors = Vec::with_capacity(count * P::PATTERNS);
        for a in 0..count {
            for b in super::natural(a, count) {
                natural[a] |= 1 << b;
            }
            let ways: Vec<Vec<Asked>> = (0..count).map(|b| ways_around(moves, a, b)).collect();
            successors.extend((0..P::PATTERNS).map(|pattern| {
                let blocked = |&(x, y): &CellOffset| {
                    // Of cells farther away nothing is known, so nothing is pruned for their sake.
                    !P::pattern_holds(x, y) || P::pattern_is_blocked(pattern, x, y)
                };
                (0..count).fold(0, |set, b| {
                    let is_kept = natural[a] >> b & 1 == 1 || !ways[b].iter().any(|way| holds(way, blocked));
                    let step = Asked {
                        free: moves.footprints[b].free.clone(),
                        either: moves.footprints[b].either.clone(),
                        passed: Vec::new(),
                    };
                    set | u8::from(is_kept && holds(&step, blocked)) << b
                })
            }));
        }
        let mut table = Self {
            successors: successors.into_boxed_slice(),
            patterns: P::PATTERNS,
            natural,
            slanted_runs_turn: false,
        };
        table.slanted_runs_turn = (1..count)
            .step_by(2)
            .any(|by| (0..P::PATTERNS).any(|pattern| table.turns(by, table.successors(by, pattern)) != 0));
        table
    }

    /// The moves by which a path goes on that arrived by move `by` where the cells form `pattern`.
    #[inline]
    pub(crate) fn successors(&self, by: usize, pattern: usize) -> u8 {
        self.successors.get(by * self.patterns + pattern).copied().unwrap_or(0)
    }

    /// Those of them that are turns.
    #[inline]
    pub(crate) fn turns(&self, by: usize, successors: u8) -> u8 {
        successors & !self.natural[by & 7]
    }

    #[inline]
    pub(crate) const fn slanted_runs_turn(&self) -> bool {
        self.slanted_runs_turn
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.successors)
    }
}

fn ways_around<P: Place>(moves: &Moves<P>, a: usize, b: usize) -> Vec<Asked> {
    let mut ways = Vec::new();
    moves.alternatives(a, b, |sequence| ways.push(moves.asked(-moves.vectors[a], sequence)));
    ways
}

fn holds(asked: &Asked, blocked: impl Fn(&CellOffset) -> bool) -> bool {
    let free = |cell: &CellOffset| !blocked(cell);
    asked.free.iter().all(free)
        && asked.either.iter().all(|pair| pair.iter().any(free))
        && asked.passed.iter().all(|&at| Asked::beside(at).iter().any(|pair| pair.iter().all(free)))
}
