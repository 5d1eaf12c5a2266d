//! The words of jump lists.

use mediant_grid::{GridGraph, Placement};
use mediant_moves::Cost;

/// The most steps that a word can say.
pub(super) const MOST_STEPS: u32 = (1 << 13) - 1;

/// The head of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Head {
    /// The moves by which a path goes on, a bit each.
    pub(super) moves: u8,
    /// The number of words before its jumps.
    pub(super) words: u32,
    /// The number of jumps.
    pub(super) jumps: u32,
}

impl Head {
    pub(super) const fn new(moves: u8) -> Self {
        Self { moves, words: 1 + moves.count_ones().div_ceil(2), jumps: 0 }
    }

    pub(super) fn word(self) -> Option<u32> {
        (self.jumps < 1 << 21).then_some(u32::from(self.moves) | self.words << 8 | self.jumps << 11)
    }

    #[inline]
    pub(super) const fn of(word: u32) -> Self {
        Self { moves: word as u8, words: word >> 8 & 7, jumps: word >> 11 }
    }

    /// Which of the moves a move is, in the order of their indices.
    #[inline]
    pub(super) const fn rank(self, index: usize) -> usize {
        BITS[(self.moves & ((1 << (index & 7)) - 1)) as usize] as usize
    }

    /// The words of the list.
    #[inline]
    pub(super) const fn length(self) -> usize {
        (self.words + self.jumps) as usize
    }
}

/// The number of bits of a byte: many processors count them by an instruction that not all have.
const BITS: [u8; 256] = {
    let (mut bits, mut byte) = ([0; 256], 0);
    while byte < 256 {
        bits[byte] = (byte as u32).count_ones() as u8;
        byte += 1;
    }
    bits
};

/// A jump point to which a jump leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Jump {
    /// The number of its [`Route`].
    pub(super) route: u32,
    /// The number of times that the first move is repeated.
    pub(super) steps: u32,
    /// The same of the second one.
    pub(super) then_steps: u32,
    /// Whether it leads there [near the goal](Self::NEAR_GOAL), [elsewhere](Self::ELSEWHERE), or both.
    pub(super) holds: u32,
}

impl Jump {
    /// Near the goal, where dead ends count as jump points.
    pub(super) const NEAR_GOAL: u32 = 1;
    /// Elsewhere: there they do not.
    pub(super) const ELSEWHERE: u32 = 2;

    pub(super) fn word(self) -> Option<u32> {
        let fits = self.steps <= MOST_STEPS && self.then_steps <= MOST_STEPS;
        fits.then_some(self.steps | self.then_steps << 13 | self.route << 26 | self.holds << 30)
    }

    #[inline]
    pub(super) const fn of(word: u32) -> Self {
        let (steps, then_steps) = (word & MOST_STEPS, word >> 13 & MOST_STEPS);
        Self { route: word >> 26 & 15, steps, then_steps, holds: word >> 30 }
    }
}

/// The moves of a jump: an even one, an odd one and one of the two even ones beside it, or an odd one alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Route {
    /// The two moves: their vectors as [`packed`] ones, 0 for none, and their costs.
    pub(super) vectors: [i64; 2],
    pub(super) costs: [Cost; 2],
    /// The first move.
    pub(super) first: u8,
    /// The last move.
    pub(super) by: u8,
    /// Whether these are two.
    pub(super) turns: bool,
    /// Whether the last move is along a row (0) or a column (1), and where in a [`packed`] vertex the number
    /// of that is.
    pub(super) line: u8,
    pub(super) shift: u8,
}

impl Route {
    /// The number of the route by a move and the first or second one of the moves beside it.
    pub(super) const fn number(index: usize, turn: Option<usize>) -> u32 {
        (match turn {
            _ if index & 1 == 0 => index / 2,
            Some(turn) => 4 + (index & !1) + turn,
            None => 12 + index / 2,
        }) as u32
    }

    /// All routes, by their numbers.
    pub(super) fn all<P: Placement>(graph: &GridGraph<P>) -> [Self; 16] {
        let mut routes = [Self::default(); 16];
        let moves = graph.steps().len();
        for (first, step) in graph.steps().iter().enumerate() {
            let (v, cost) = (step.vector(), step.cost);
            let alone = Self {
                vectors: [packed(v.x, v.y), 0],
                costs: [cost, Cost::ZERO],
                first: first as u8,
                by: first as u8,
                turns: false,
                line: u8::from(v.x == 0),
                shift: if v.x == 0 { 0 } else { 32 },
            };
            routes[Self::number(first, None) as usize] = alone;
            for turn in [0, 1].into_iter().filter(|_| first & 1 == 1) {
                let by = (first + moves - 1 + 2 * turn) % moves;
                let (last, vectors) = (graph.step(by), alone.vectors);
                let v = last.vector();
                routes[Self::number(first, Some(turn)) as usize] = Self {
                    vectors: [vectors[0], packed(v.x, v.y)],
                    costs: [cost, last.cost],
                    by: by as u8,
                    turns: true,
                    line: u8::from(v.x == 0),
                    shift: if v.x == 0 { 0 } else { 32 },
                    ..alone
                };
            }
        }
        routes
    }
}

/// Two coordinates in one number. Sums and multiples of such numbers are those of sums and multiples of the
/// vectors, and where x is not negative, its bits are the lower half.
#[inline]
pub(super) const fn packed(x: i32, y: i32) -> i64 {
    ((y as i64) << 32) + x as i64
}
