//! Straight runs by words: 64 vertices a step (block-based jumps: Harabor & Grastien 2014, 'Improving Jump Point Search').
//!
//! A straight run repeats an even move until its first *jump point*, a vertex with a legal turn that no other path makes as
//! cheaply (see [`JumpPointRule`]), or until the move is illegal. Both depend on the map alone, on the two or three rows of cells along
//! the run: so they are found once, by operations on words of those rows, and kept. For each direction there is a matrix of the
//! vertices that end a run which enters them; those of the backward directions are mirrored. So a scan loads one row,
//! and all directions are one code without a branch on the direction, which is what most of a scan's time is where directions
//! vary.
//!
//! Rule variants: all five, k = 2 and k = 3. Under closed gaps a run ends before a gap.
//!
//! A byte a vertex (two bits a direction), made in 0.14 ms for 512 × 512 cells. A scan takes 3.0 to 4.0 ns (seven maps of the
//! benchmark sets, the two scans of each step of diagonal runs; dao, sc1, random), and 3.0 to 7.9 ns where directions follow one
//! another at random and their branches are mispredicted. Tried and left out: combining the rows anew at every scan, 63 vertices
//! a step, takes 5.0 to 7.5 ns, and 9 to 15 ns.

use mediant_grid::{BitMatrix, CornerRule, DiagonalGap, GridGraph, Placement, Rules, Vertex, load};
use mediant_moves::FiniteK;

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
    fn new(steps: u32, found: bool, goal_steps: Option<u32>) -> Self {
        match goal_steps {
            Some(goal) if goal <= steps => Self { steps: goal, found: true, scanned: goal },
            _ => Self { steps, found, scanned: steps + u32::from(!found) },
        }
    }
}

/// Which vertices of a straight run are jump points. *Beside* is in the row on either side of the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum JumpPointRule {
    /// The cell beside the vertex is free, the one beside its predecessor blocked. Centers where no diagonal move passes a
    /// blocked cell: `Never`, and k = 2.
    Behind,
    /// The cell beside the vertex is blocked, the next one beside the run free: a diagonal move leads past the blocked
    /// cell. With `one` (corner rule `One`) the next cell of the run must be free as well.
    Ahead { one: bool },
    /// Corners: as [`Behind`](Self::Behind), the run being between the two rows of cells.
    Edges { closed: bool },
}

/// What is at 64 vertices of a run, one bit each, the first one's the lowest.
#[derive(Clone, Copy, Debug)]
struct Ends {
    /// Jump points, if the run comes so far.
    jump: u64,
    /// Vertices that the run cannot enter.
    dead: u64,
}

impl JumpPointRule {
    fn of<P: Placement>(graph: &GridGraph<P>) -> Self {
        match graph.rules() {
            Rules::Corner(gap) => Self::Edges { closed: gap == DiagonalGap::Closed },
            Rules::Center(rule) if rule == CornerRule::Never || graph.k() == FiniteK::N4 => Self::Behind,
            Rules::Center(rule) => Self::Ahead { one: rule == CornerRule::One },
        }
    }

    /// The ends at 64 vertices. `cells(ahead, row)` tells which of their cells are blocked, those `ahead` steps further on and `row`
    /// rows beside. At corners a vertex's cells are the two beside the run's next step, in rows −1 and 0.
    fn ends(self, cells: impl Fn(i32, i32) -> u64) -> Ends {
        match self {
            Self::Behind => {
                let opens = |row| cells(-1, row) & !cells(0, row);
                Ends { jump: opens(-1) | opens(1), dead: cells(0, 0) }
            }
            Self::Ahead { one } => {
                let opens = |row| cells(0, row) & !cells(1, row);
                let barred = if one { cells(1, 0) } else { 0 };
                Ends { jump: (opens(-1) | opens(1)) & !barred, dead: cells(0, 0) }
            }
            Self::Edges { closed } => {
                let [passed, next] = [-1, 0].map(|ahead| [-1, 0].map(|row| cells(ahead, row)));
                let jump = passed[0] & !next[0] | passed[1] & !next[1];
                let gap = (passed[0] ^ next[0]) & !(passed[0] ^ next[1]) & !(next[0] ^ passed[1]);
                Ends { jump, dead: passed[0] & passed[1] | if closed { gap } else { 0 } }
            }
        }
    }

    /// The ends at vertex `u` of line `v` of a matrix and at the 63 next ones of the run.
    fn ends_from<P: Placement>(self, matrix: &BitMatrix, (u, v): (i32, i32), forward: bool) -> Ends {
        let (at, row) = (matrix.index(u, v), matrix.bits_per_row());
        self.ends(|ahead, beside| {
            // Backward, the cell of the first vertex is the last of the 64, at corners the one before it.
            let first = if forward { ahead } else { P::cell(-1, 0) - ahead - 63 };
            let word = load(matrix.words(), at.offset(first + beside * row));
            if forward { word } else { word.reverse_bits() }
        })
    }
}

/// Where the straight runs of all four directions end, for k ≤ 3.
#[derive(Clone, Debug)]
pub(crate) struct AxialStops {
    planes: [Plane; 4],
    /// For 64 vertices of a line: which of them end a run, and which of those do because it cannot enter them.
    words: Vec<[u64; 2]>,
}

/// Where one direction's bits are: that of vertex (x, y) at `origin` + `per_x` · x + `per_y` · y, and the next one on the run follows.
#[derive(Clone, Copy, Debug)]
struct Plane {
    origin: isize,
    per_x: isize,
    per_y: isize,
}

impl AxialStops {
    /// The planes of a grid graph.
    pub(crate) fn new<P: Placement>(graph: &GridGraph<P>) -> Self {
        let grid = graph.grid();
        let (width, height) = P::vertices(grid);
        let rule = JumpPointRule::of(graph);
        let mut words = Vec::new();
        let planes = [0, 1, 2, 3].map(|quarter| {
            let (vertical, forward) = (quarter % 2 == 0, quarter < 2);
            let (matrix, length, lines) =
                if vertical { (grid.columns(), height, width) } else { (grid.rows(), width, height) };
            let first = 64 * words.len() as isize;
            let per_line = length / 64 + 1;
            for line in 0..lines as i32 {
                words.extend((0..per_line as i32).map(|word| {
                    let u = if forward { 64 * word } else { length as i32 - 1 - 64 * word };
                    let Ends { jump, dead } = rule.ends_from::<P>(matrix, (u, line), forward);
                    [jump | dead, dead]
                }));
            }
            let along = if forward { 1 } else { -1 };
            let across = 64 * per_line as isize;
            let origin = if forward { first } else { first + length as isize - 1 };
            let (per_x, per_y) = if vertical { (across, along) } else { (along, across) };
            Plane { origin, per_x, per_y }
        });
        // A scan reads two words.
        words.push([!0; 2]);
        Self { planes, words }
    }

    /// The straight run from a vertex of the map in direction (0, 1), turned by `quarter` < 4 quarter turns: (0, 1), (1, 0),
    /// (0, −1), (−1, 0).
    ///
    /// `goal_steps`: after how many steps, at least 1, the run would come to the goal, if that lies ahead of it.
    #[inline]
    pub(crate) fn scan(&self, from: Vertex, quarter: usize, goal_steps: Option<u32>) -> Scan {
        let plane = self.planes[quarter & 3];
        let mut at =
            (plane.origin + plane.per_x * from.x as isize + plane.per_y * from.y as isize + 1) as usize;
        let mut steps = 0;
        loop {
            let (word, shift) = (at >> 6, at & 63);
            let Some(&[[low, low_dead], [high, high_dead]]) = self.words.get(word..word + 2) else {
                return Scan::new(steps, false, goal_steps);
            };
            // The two-step shift keeps a shift of 64 out of the case shift = 0.
            let stop = low >> shift | high << 1 << (63 - shift);
            if stop != 0 {
                let n = stop.trailing_zeros();
                let dead = low_dead >> shift | high_dead << 1 << (63 - shift);
                let dead = (dead >> n & 1) as u32;
                return Scan::new(steps + n + 1 - dead, dead == 0, goal_steps);
            }
            steps += 64;
            at += 64;
        }
    }

    /// The memory that the planes take, in bytes.
    pub(crate) fn memory_bytes(&self) -> usize {
        size_of_val(&*self.words)
    }
}
