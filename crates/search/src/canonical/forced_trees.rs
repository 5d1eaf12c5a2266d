//! The rule for 4 ≤ k ≤ 8: for each arriving move a binary tree over the candidates for forced successors,
//! ordered by angle.
//!
//! A node of the tree stands for the candidates of one sector of directions. It is tested on a window of the
//! map around the vertex, a word a row. The sector is dropped when
//! - a cell that *all* its moves sweep is blocked, so that none of them is legal; or
//! - every cell is free that the best alternatives to *all* of its candidates require, so that each of them
//!   is pruned.
//!
//! So walls end the sectors that run into them, open ground ends the sectors beside it, and what remains is
//! the neighborhood of an obstacle's corner. A leaf is one candidate, with the cells of its move and up to
//! [`MAX_ALTERNATIVES`] alternatives. The cells that the arriving move and the candidate itself sweep are
//! known to be free and not tested again.

use mediant_grid::{CellOffset, Grid, Interrupt, Interrupted, Placement, Vertex, load};

use super::{
    alternatives::{MoveTable, Requirements},
    cells::Cells,
    clearance::Clearance,
    order::natural,
};

/// How many alternatives to a candidate are kept.
const MAX_ALTERNATIVES: usize = 3;

/// A set of cells in consecutive rows of a [`Window`].
#[derive(Clone, Copy, Debug, Default)]
struct Zone {
    /// The first row's word in [`ForcedTrees::masks`].
    begin: u32,
    first: u8,
    rows: u8,
    /// Whether it counts as blocked whatever is there.
    never: bool,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    /// Cells that all moves of the sector sweep, without those that the nodes above have tested.
    shared: Zone,
    /// The cells that the best alternatives to all candidates of the sector require.
    best_alternatives: Zone,
    /// At a leaf, the range of its further alternatives in [`ForcedTrees::alternatives`].
    alternatives: (u32, u32),
    /// Two cells of which the move of a leaf requires one.
    either: Option<[CellOffset; 2]>,
    /// The first node after this one that is not below it.
    skip: u32,
    /// The candidate of a leaf.
    candidate: Option<u16>,
}

/// The cells around a vertex, as in [`Cells`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window([u64; Cells::SIDE]);

impl Window {
    /// Loads the rows up to `reach` away; the others are left free.
    #[inline]
    fn new(grid: &Grid, at: Vertex, reach: i32) -> Self {
        let mut window = Self([0; Cells::SIDE]);
        for row in (Cells::HALF - reach).max(0)..=(Cells::HALF + reach).min(Cells::SIDE as i32 - 1) {
            window.0[row as usize] = row_of(grid, at, row);
        }
        window
    }
}

/// One row of a window.
#[inline]
fn row_of(grid: &Grid, at: Vertex, row: i32) -> u64 {
    let rows = grid.rows();
    load(rows.words(), rows.index(at.x - Cells::HALF, at.y + row - Cells::HALF))
}

/// The footprint of a move, as a mask.
#[derive(Clone, Copy, Debug)]
struct StepTest {
    free: Zone,
    either: Option<[CellOffset; 2]>,
}

/// The trees of all arriving moves.
#[derive(Clone, Debug)]
pub(crate) struct ForcedTrees {
    /// Where the tree of each arriving move begins in `nodes`, and where the last one ends.
    begins: Vec<u32>,
    nodes: Vec<Node>,
    alternatives: Vec<Zone>,
    masks: Vec<u64>,
    steps: Vec<StepTest>,
    /// For each arriving move, the least side of a free square in which all its natural successors are legal.
    pub(crate) needed: Vec<u32>,
    /// The rows up and down from the vertex at which the trees look.
    reach: i32,
    /// The columns to the left and to the right.
    reach_aside: i32,
}

/// A move that may be a forced successor, with the alternatives to it, the best one first.
struct Candidate {
    index: usize,
    alternatives: Vec<Cells>,
}

impl ForcedTrees {
    pub(crate) fn new<P: Placement>(
        moves: &MoveTable<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let count = moves.len();
        let mut trees = Self {
            begins: vec![0],
            nodes: Vec::new(),
            alternatives: Vec::new(),
            masks: Vec::new(),
            steps: Vec::new(),
            needed: Vec::new(),
            reach: 0,
            reach_aside: 0,
        };
        for footprint in &moves.footprints {
            let free = trees.zone(&footprint.free.iter().copied().collect());
            trees.steps.push(StepTest { free, either: footprint.either.first().copied() });
        }
        for a in 0..count {
            let mut needed = 0;
            let mut need = |cell: CellOffset| needed = needed.max(Clearance::needed::<P>(cell));
            for b in natural(a, count) {
                moves.footprints[b].free.iter().for_each(|&cell| need(cell));
                moves.footprints[b].either.iter().for_each(|pair| need(pair[0]));
            }
            let mut candidates = Vec::with_capacity(count);
            for b in (1..count).map(|offset| (a + offset) % count) {
                if natural(a, count).any(|natural| natural == b) {
                    continue;
                }
                interrupt.check("computing a pruning rule")?;
                let candidate = Candidate::new(moves, a, b);
                // A candidate with an alternative that requires nothing is never forced.
                if candidate.alternatives.first().is_none_or(|first| !first.is_empty()) {
                    candidates.push(candidate);
                }
            }
            trees.add(moves, &candidates, &Cells::default());
            trees.begins.push(trees.nodes.len() as u32);
            trees.needed.push(needed);
        }
        Ok(trees)
    }

    /// Adds the subtree of these candidates. `tested` are the cells that the nodes above test because all
    /// their moves sweep them.
    fn add<P: Placement>(&mut self, moves: &MoveTable<P>, candidates: &[Candidate], tested: &Cells) {
        let [first, ..] = candidates else { return };
        let swept =
            |candidate: &Candidate| moves.footprints[candidate.index].free.iter().copied().collect::<Cells>();
        let shared = candidates.iter().map(swept).fold(swept(first), |all, cells| all.common(&cells));
        let new = shared.without(tested);
        let best_alternatives = candidates
            .iter()
            .filter_map(|candidate| candidate.alternatives.first())
            .fold(Cells::default(), |all, cells| all.with(cells));
        // If one of the candidates has no alternative, the sector is never dropped because of the
        // alternatives.
        let has_alternatives = candidates.iter().all(|candidate| !candidate.alternatives.is_empty());
        let leaf = (candidates.len() == 1).then_some(first);
        let begin = self.alternatives.len() as u32;
        for alternative in leaf.into_iter().flat_map(|candidate| candidate.alternatives.iter().skip(1)) {
            let zone = self.zone(alternative);
            self.alternatives.push(zone);
        }
        let node = Node {
            shared: self.zone(&new),
            best_alternatives: Zone { never: !has_alternatives, ..self.zone(&best_alternatives) },
            alternatives: (begin, self.alternatives.len() as u32),
            either: leaf.and_then(|candidate| moves.footprints[candidate.index].either.first().copied()),
            skip: 0,
            candidate: leaf.map(|candidate| candidate.index as u16),
        };
        let place = self.nodes.len();
        self.nodes.push(node);
        if leaf.is_none() {
            let (left, right) = candidates.split_at(candidates.len() / 2);
            self.add(moves, left, &shared);
            self.add(moves, right, &shared);
        }
        self.nodes[place].skip = self.nodes.len() as u32;
    }

    fn zone(&mut self, cells: &Cells) -> Zone {
        let begin = self.masks.len() as u32;
        let (first, rows) = cells.rows();
        self.masks.extend(rows);
        for (x, y) in cells.iter() {
            self.reach = self.reach.max(y.abs());
            self.reach_aside = self.reach_aside.max(x.abs());
        }
        Zone { begin, first: first as u8, rows: rows.len() as u8, never: false }
    }

    #[inline]
    fn masks(&self, zone: Zone) -> &[u64] {
        let begin = zone.begin as usize;
        self.masks.get(begin..begin + usize::from(zone.rows)).unwrap_or(&[])
    }

    #[inline]
    fn is_free(&self, zone: Zone, window: &Window) -> bool {
        let rows = window.0.get(usize::from(zone.first)..).unwrap_or(&[]);
        !zone.never && self.masks(zone).iter().zip(rows).fold(0, |met, (mask, row)| met | mask & row) == 0
    }

    /// Whether the move is legal at a free vertex.
    #[inline]
    pub(crate) fn is_legal(&self, index: usize, grid: &Grid, at: Vertex) -> bool {
        let step = &self.steps[index];
        let rows = i32::from(step.free.first)..;
        self.masks(step.free).iter().zip(rows).all(|(mask, row)| mask & row_of(grid, at, row) == 0)
            && is_either_free(step.either, grid, at)
    }

    /// Calls `take` with each forced successor of a path that arrives by move `by`, until that returns false.
    /// Whether it always returned true.
    #[inline]
    pub(crate) fn for_each_forced(
        &self,
        by: usize,
        grid: &Grid,
        at: Vertex,
        mut take: impl FnMut(usize) -> bool,
    ) -> bool {
        let window = &Window::new(grid, at, self.reach);
        let (mut i, end) = (self.begins[by] as usize, self.begins[by + 1] as usize);
        while i < end {
            let node = &self.nodes[i];
            if !self.is_free(node.shared, window) || self.is_free(node.best_alternatives, window) {
                i = node.skip as usize;
                continue;
            }
            i += 1;
            let Some(candidate) = node.candidate else { continue };
            let legal = is_either_free(node.either, grid, at);
            let mut alternatives =
                self.alternatives[node.alternatives.0 as usize..node.alternatives.1 as usize].iter();
            if legal && !alternatives.any(|&zone| self.is_free(zone, window)) && !take(usize::from(candidate))
            {
                return false;
            }
        }
        true
    }

    /// The distance from a vertex, along either axis, up to which a cell can decide about a forced successor.
    /// (Of a pair of which a move requires one, both are next to cells that it sweeps.)
    pub(crate) fn reach(&self) -> u32 {
        (self.reach.max(self.reach_aside) + 1).unsigned_abs()
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        let nodes = size_of_val(&*self.nodes) + size_of_val(&*self.alternatives) + size_of_val(&*self.masks);
        nodes + size_of_val(&*self.steps) + size_of_val(&*self.begins) + size_of_val(&*self.needed)
    }
}

#[inline]
fn is_either_free(cells: Option<[CellOffset; 2]>, grid: &Grid, at: Vertex) -> bool {
    cells.is_none_or(|cells| cells.iter().any(|&(x, y)| grid.is_free(at.x + x, at.y + y)))
}

impl Candidate {
    fn new<P: Placement>(moves: &MoveTable<P>, a: usize, b: usize) -> Self {
        let before = -moves.vectors[a];
        let mut known: Cells = moves.footprints[b].free.iter().copied().collect();
        known.extend(moves.footprints[a].free.iter().map(|&(x, y)| (x + before.x, y + before.y)));
        let mut alternatives: Vec<Cells> = Vec::new();
        moves.alternatives(a, b, |sequence| {
            alternatives.push(beyond(&known, &moves.requirements(before, sequence)));
        });
        // A stable sort: of alternatives that require as many cells, the one found first comes first.
        alternatives.sort_by_key(Cells::count);
        let mut kept: Vec<Cells> = Vec::with_capacity(MAX_ALTERNATIVES);
        for alternative in alternatives {
            // An alternative that requires all that a kept one requires adds nothing.
            if kept.len() < MAX_ALTERNATIVES
                && !kept.iter().any(|other| other.without(&alternative).is_empty())
            {
                kept.push(alternative);
            }
        }
        Self { index: b, alternatives: kept }
    }
}

/// A set of cells that, if free, satisfies the requirements, without those that are known to be free. Of a
/// pair of which one must be free it takes the cell nearer to the vertex, and so further inside the bend of
/// the path, unless the set has one of them anyway. So the set may require too much, never too little.
fn beyond(known: &Cells, required: &Requirements) -> Cells {
    let mut cells: Cells = required.free.iter().copied().collect();
    let has = |cells: &Cells, cell: CellOffset| cells.contains(cell) || known.contains(cell);
    let distance = |(x, y): CellOffset| (2 * x + 1).pow(2) + (2 * y + 1).pow(2);
    for pair in &required.either {
        if !pair.iter().any(|&cell| has(&cells, cell)) {
            cells.extend(pair.iter().copied().min_by_key(|&cell| distance(cell)));
        }
    }
    for &at in &required.passed {
        let missing = |pair: &[CellOffset; 2]| pair.iter().filter(|&&cell| !has(&cells, cell)).count();
        if let Some(pair) = Requirements::beside(at).into_iter().min_by_key(|pair| missing(pair)) {
            cells.extend(pair);
        }
    }
    cells.without(known)
}
