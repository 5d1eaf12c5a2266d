//! Straight runs by words: 63 vertices a step (block-based jumps: Harabor & Grastien 2014, 'Improving Jump Point Search').
//!
//! A straight run repeats an axis move until its first *jump point*, a vertex with a legal turn that no other path makes as
//! cheaply (see [`Turns`]), or until the move is illegal. Both are functions of the two or three rows of cells along the run,
//! hence of words of those rows, shifted against each other.
//!
//! Rule variants: all five, k = 2 and k = 3. Under closed gaps a run ends before a doubly blocked corner.
//!
//! One account of them serves all directions: runs down a column are runs along a row of the transposed map, and a run
//! backwards reads its words from the other end.
//!
//! A scan takes 5.0 to 7.5 ns (seven maps of the benchmark sets, the two scans of each step of diagonal runs; dao, sc1, random),
//! 9 to 15 ns where directions follow one another at random and their branches are mispredicted. Tried and left out: aligned
//! words instead of windows across two of them take as long, and a scan without branches on its direction 8 to 11 ns either
//! way. [`StopPlanes`](super::planes::StopPlanes) take less in both cases.

use mediant_grid::{
    BitIndex, BitMatrix, CornerRule, DiagonalGap, Lattice, Place, Rules, Vector, Vertex, load,
};
use mediant_moves::K;

/// Where a straight run ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Scan {
    /// The steps to the jump point or the goal, else all legal ones.
    pub(crate) steps: u32,
    /// Whether the run ends at a jump point or at the goal; else it is dead.
    pub(crate) found: bool,
    /// How many vertices were looked at, the one that a dead run cannot enter included.
    pub(crate) scanned: u32,
}

impl Scan {
    /// The end after `steps` legal steps, or the goal if the run comes to it before that.
    #[inline]
    pub(super) fn new(steps: u32, found: bool, goal_steps: Option<u32>) -> Self {
        match goal_steps {
            Some(goal) if goal <= steps => Self { steps: goal, found: true, scanned: goal },
            _ => Self { steps, found, scanned: steps + u32::from(!found) },
        }
    }
}

/// Which vertices of a straight run are jump points. *Beside* is in the row on either side of the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turns {
    /// The cell beside the vertex is free, the one beside its predecessor blocked. Centers where no diagonal move passes a
    /// blocked cell: `Never`, and k = 2.
    Behind,
    /// The cell beside the vertex is blocked, the next one beside the run free: a diagonal move leads past the blocked
    /// cell. With `one` (corner rule `One`) the next cell of the run must be free as well.
    Ahead { one: bool },
    /// Corners: as [`Behind`](Self::Behind), the run being between the two rows of cells.
    Edges { closed: bool },
}

/// What is after 1 to [`BLOCK`] steps of a run, one bit each: the lowest for the first step of a run forward, the highest for
/// that of a run backward. The one bit beyond means nothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ends {
    /// Jump points, if the run comes so far.
    pub(super) jump: u64,
    /// Vertices that the run cannot enter.
    pub(super) dead: u64,
}

/// How many steps one block decides: of the 64 cells in a window, the last has no successor there.
const BLOCK: i32 = 63;

/// The bits `n` steps further on in the direction of the run.
#[inline]
const fn ahead<const FORWARD: bool>(word: u64, n: u32) -> u64 {
    if FORWARD { word >> n } else { word << n }
}

impl Turns {
    #[inline]
    pub(super) fn of<P: Place>(lattice: &Lattice<P>) -> Self {
        match lattice.rules() {
            Rules::Corner(gap) => Self::Edges { closed: gap == DiagonalGap::Closed },
            Rules::Center(rule) if rule == CornerRule::Never || lattice.k() == K::FOUR_CONNECTED => {
                Self::Behind
            }
            Rules::Center(rule) => Self::Ahead { one: rule == CornerRule::One },
        }
    }

    /// The ends of the run that stands after `done` steps, a multiple of its blocks, from the vertex with bit `at`.
    #[inline]
    pub(super) fn ends<const FORWARD: bool>(self, matrix: &BitMatrix, at: BitIndex) -> Ends {
        let row = matrix.bits_per_row();
        // A window begins with a cell of the run's first vertex or first step, in the direction of the run.
        let window = |skip: i32, offset: i32| {
            let first = if FORWARD { skip } else { -63 - skip };
            load(matrix.words(), at.offset(first + offset))
        };
        let one_ahead = ahead::<FORWARD>;
        match self {
            Self::Behind => {
                let [left, here, right] = [-row, 0, row].map(|offset| window(0, offset));
                let opens = |beside: u64| beside & !one_ahead(beside, 1);
                Ends { jump: opens(left) | opens(right), dead: one_ahead(here, 1) }
            }
            Self::Ahead { one } => {
                let [left, here, right] = [-row, 0, row].map(|offset| window(1, offset));
                let opens = |beside: u64| beside & !one_ahead(beside, 1);
                let barred = if one { one_ahead(here, 1) } else { 0 };
                Ends { jump: (opens(left) | opens(right)) & !barred, dead: here }
            }
            Self::Edges { closed } => {
                // Backward, the first step passes the cell before the vertex.
                let [left, right] = [-row, 0].map(|offset| window(i32::from(!FORWARD), offset));
                let [left_next, right_next] = [left, right].map(|beside| one_ahead(beside, 1));
                let jump = left & !left_next | right & !right_next;
                let gap = (left ^ left_next) & !(left ^ right_next) & !(left_next ^ right);
                Ends { jump, dead: left & right | if closed { gap } else { 0 } }
            }
        }
    }

    /// The run along row `v` of a matrix from column `u`: its steps, and whether it ends at a jump point.
    #[inline]
    fn run<const FORWARD: bool>(self, matrix: &BitMatrix, u: i32, v: i32) -> (u32, bool) {
        // A loop for each variant: 1.5 ns less than a choice in the loop.
        match self {
            Self::Behind => Self::Behind.follow::<FORWARD>(matrix, u, v),
            Self::Ahead { one } => Self::Ahead { one }.follow::<FORWARD>(matrix, u, v),
            Self::Edges { closed } => Self::Edges { closed }.follow::<FORWARD>(matrix, u, v),
        }
    }

    #[inline(always)]
    fn follow<const FORWARD: bool>(self, matrix: &BitMatrix, u: i32, v: i32) -> (u32, bool) {
        let decided = if FORWARD { !0 >> 1 } else { !0 << 1 };
        let mut at = matrix.index(u, v);
        let mut steps = 0;
        loop {
            let Ends { jump, dead } = self.ends::<FORWARD>(matrix, at);
            let stop = (jump | dead) & decided;
            if stop != 0 {
                let n = if FORWARD { stop.trailing_zeros() } else { stop.leading_zeros() };
                let found = if FORWARD { dead >> n & 1 == 0 } else { dead << n >> 63 == 0 };
                return (steps + n + u32::from(found), found);
            }
            // The frame is blocked, so every run ends; where `u` or `v` is beyond it, at the end of the words at last.
            steps += BLOCK as u32;
            at = at.offset(if FORWARD { BLOCK } else { -BLOCK });
        }
    }
}

/// The straight run from a vertex of the map in direction `towards`, an axis unit vector, for k ≤ 3.
///
/// `goal_steps`: after how many steps, at least 1, the run would come to the goal, if that lies ahead of it.
#[inline]
pub(crate) fn scan<P: Place>(
    lattice: &Lattice<P>,
    from: Vertex,
    towards: Vector,
    goal_steps: Option<u32>,
) -> Scan {
    debug_assert!(towards.norm_squared() == 1 && lattice.id(from).is_some(), "{towards:?} from {from}");
    let turns = Turns::of(lattice);
    let (rows, columns) = (lattice.grid().rows(), lattice.grid().columns());
    let (steps, found) = match (towards.x, towards.y) {
        (1.., _) => turns.run::<true>(rows, from.x, from.y),
        (..=-1, _) => turns.run::<false>(rows, from.x, from.y),
        (0, 1..) => turns.run::<true>(columns, from.y, from.x),
        _ => turns.run::<false>(columns, from.y, from.x),
    };
    Scan::new(steps, found, goal_steps)
}
