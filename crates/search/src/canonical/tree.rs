//! The rule for 4 ≤ k ≤ 8: for each incoming move a tree over all turns, by angle.
//!
//! A node of the tree stands for the turns of one cone. It is tested with words of the map, and its cone is dropped when
//! - a cell that *all* its moves sweep is blocked: none of them is legal; or
//! - every cell that the ways around *any* of its turns ask for is free: each of them is pruned.
//!
//! So walls end the cones that run into them, open ground the cones beside it, and what is left is the neighborhood of an obstacle's corner.
//! A leaf is one turn, with the cells of its move and up to [`WAYS`] ways around it. Cells that the two moves themselves
//! have swept are known to be free and not asked for again.

use mediant_grid::{BitIndex, BitMatrix, CellMask, CellOffset, Grid, Place, Vertex};

use super::{
    alternatives::{Asked, Moves},
    cells::Cells,
    clearance::Clearance,
};

/// How many ways around a turn are kept. On ArcticStation, k = 5, the nodes generated with 1, 2, 3 and 4 are in
/// `docs/architecture.md`.
const WAYS: usize = 3;

/// Masks on the map or on its transposed copy, whichever takes fewer.
#[derive(Clone, Copy, Debug, Default)]
struct Zone {
    begin: u32,
    end: u32,
    transposed: bool,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    /// Cells that all moves of the cone sweep, beyond those of the nodes above.
    shared: Zone,
    /// Cells that the best way around each turn asks for.
    around: Zone,
    /// Further ways, at a leaf.
    ways: (u32, u32),
    /// Two cells of which the move of a leaf needs one.
    either: Option<[CellOffset; 2]>,
    /// The next node that is not below this one.
    skip: u32,
    /// The turn of a leaf.
    turn: Option<u16>,
}

/// A vertex as a place in the map and in its transposed copy.
#[derive(Clone, Copy)]
pub(crate) struct Spot<'g> {
    rows: (&'g BitMatrix, BitIndex),
    columns: (&'g BitMatrix, BitIndex),
}

impl<'g> Spot<'g> {
    #[inline]
    pub(crate) fn new(grid: &'g Grid, at: Vertex) -> Self {
        let (rows, columns) = (grid.rows(), grid.columns());
        Self { rows: (rows, rows.index(at.x, at.y)), columns: (columns, columns.index(at.y, at.x)) }
    }

    #[inline]
    fn is_free(&self, (x, y): CellOffset) -> bool {
        CellMask { across: y, along: x, cells: 1 }.is_free(self.rows.0, self.rows.1)
    }
}

/// What a move asks of the map.
#[derive(Clone, Copy, Debug)]
struct StepTest {
    free: Zone,
    either: Option<[CellOffset; 2]>,
}

/// The trees of all incoming moves.
#[derive(Clone, Debug)]
pub(crate) struct TurnTrees {
    /// Where each incoming move's tree begins in `nodes`, and one end more.
    begins: Vec<u32>,
    nodes: Vec<Node>,
    ways: Vec<Zone>,
    masks: Vec<CellMask>,
    steps: Vec<StepTest>,
    /// The clearance from which on all natural successors of an incoming move are legal, and all turns pruned.
    pub(crate) needed: Vec<u32>,
}

/// A turn with the ways around it, the best one first.
struct Turn {
    index: usize,
    ways: Vec<Cells>,
}

impl TurnTrees {
    pub(crate) fn new<P: Place>(moves: &Moves<P>) -> Self {
        let count = moves.len();
        let mut trees = Self {
            begins: vec![0],
            nodes: Vec::new(),
            ways: Vec::new(),
            masks: Vec::new(),
            steps: Vec::new(),
            needed: Vec::new(),
        };
        for footprint in &moves.footprints {
            let free = trees.zone(&footprint.free.iter().copied().collect());
            trees.steps.push(StepTest { free, either: footprint.either.first().copied() });
        }
        for a in 0..count {
            let mut needed = 0;
            let mut need = |cell: CellOffset| needed = needed.max(Clearance::needed::<P>(cell));
            for b in super::natural(a, count) {
                moves.footprints[b].free.iter().for_each(|&cell| need(cell));
                moves.footprints[b].either.iter().for_each(|pair| need(pair[0]));
            }
            let mut turns = Vec::with_capacity(count);
            for b in (1..count).map(|turn| (a + turn) % count) {
                if super::natural(a, count).any(|natural| natural == b) {
                    continue;
                }
                let turn = Turn::new(moves, a, b);
                // A turn that nothing needs to be free for is never taken.
                if turn.ways.first().is_none_or(|way| !way.is_empty()) {
                    turn.ways.first().into_iter().flat_map(Cells::iter).for_each(&mut need);
                    turns.push(turn);
                }
            }
            trees.add(moves, &turns, &Cells::default());
            trees.begins.push(trees.nodes.len() as u32);
            trees.needed.push(needed);
        }
        trees
    }

    /// Adds the subtree of these turns. `tested` are the cells that the nodes above know to be swept by all.
    fn add<P: Place>(&mut self, moves: &Moves<P>, turns: &[Turn], tested: &Cells) {
        let [first, ..] = turns else { return };
        let swept = |turn: &Turn| moves.footprints[turn.index].free.iter().copied().collect::<Cells>();
        let shared = turns.iter().map(swept).fold(swept(first), |all, cells| all.common(&cells));
        let new = shared.without(tested);
        let around = turns
            .iter()
            .filter_map(|turn| turn.ways.first())
            .fold(Cells::default(), |all, way| all.with(way));
        // Without a way around one of the turns, the cone is never dropped for the ways around all.
        let has_ways = turns.iter().all(|turn| !turn.ways.is_empty());
        let leaf = (turns.len() == 1).then_some(first);
        let begin = self.ways.len() as u32;
        for way in leaf.into_iter().flat_map(|turn| turn.ways.iter().skip(1)) {
            let zone = self.zone(way);
            self.ways.push(zone);
        }
        let node = Node {
            shared: self.zone(&new),
            around: if has_ways { self.zone(&around) } else { Zone { begin: 1, end: 0, transposed: false } },
            ways: (begin, self.ways.len() as u32),
            either: leaf.and_then(|turn| moves.footprints[turn.index].either.first().copied()),
            skip: 0,
            turn: leaf.map(|turn| turn.index as u16),
        };
        let place = self.nodes.len();
        self.nodes.push(node);
        if leaf.is_none() {
            let (left, right) = turns.split_at(turns.len() / 2);
            self.add(moves, left, &shared);
            self.add(moves, right, &shared);
        }
        self.nodes[place].skip = self.nodes.len() as u32;
    }

    fn zone(&mut self, cells: &Cells) -> Zone {
        let rows = CellMask::cover(cells.iter());
        let columns = CellMask::cover(cells.iter().map(|(x, y)| (y, x)));
        let transposed = columns.len() < rows.len();
        let begin = self.masks.len() as u32;
        self.masks.extend(if transposed { columns } else { rows });
        Zone { begin, end: self.masks.len() as u32, transposed }
    }

    #[inline]
    fn is_free(&self, zone: Zone, spot: &Spot<'_>) -> bool {
        let (matrix, at) = if zone.transposed { spot.columns } else { spot.rows };
        // A zone that ends before it begins is never free.
        self.masks
            .get(zone.begin as usize..zone.end as usize)
            .is_some_and(|masks| masks.iter().all(|mask| mask.is_free(matrix, at)))
    }

    /// Whether the move is legal at a free vertex.
    #[inline]
    pub(crate) fn is_legal(&self, index: usize, spot: &Spot<'_>) -> bool {
        let step = &self.steps[index];
        self.is_free(step.free, spot)
            && step.either.is_none_or(|cells| cells.iter().any(|&cell| spot.is_free(cell)))
    }

    /// Calls `take` with each turn that a path may take after move `by`, until that returns false. Whether all were taken.
    #[inline]
    pub(crate) fn for_each_turn(
        &self,
        by: usize,
        spot: &Spot<'_>,
        mut take: impl FnMut(usize) -> bool,
    ) -> bool {
        let (mut i, end) = (self.begins[by] as usize, self.begins[by + 1] as usize);
        while i < end {
            let node = &self.nodes[i];
            if !self.is_free(node.shared, spot) || self.is_free(node.around, spot) {
                i = node.skip as usize;
                continue;
            }
            i += 1;
            let Some(turn) = node.turn else { continue };
            let legal = node.either.is_none_or(|cells| cells.iter().any(|&cell| spot.is_free(cell)));
            let mut ways = self.ways[node.ways.0 as usize..node.ways.1 as usize].iter();
            if legal && !ways.any(|&way| self.is_free(way, spot)) && !take(usize::from(turn)) {
                return false;
            }
        }
        true
    }

    pub(crate) fn bytes(&self) -> usize {
        let nodes = size_of_val(&*self.nodes) + size_of_val(&*self.ways) + size_of_val(&*self.masks);
        nodes + size_of_val(&*self.steps) + size_of_val(&*self.begins) + size_of_val(&*self.needed)
    }
}

impl Turn {
    fn new<P: Place>(moves: &Moves<P>, a: usize, b: usize) -> Self {
        let before = -moves.vectors[a];
        let mut known: Cells = moves.footprints[b].free.iter().copied().collect();
        known.extend(moves.footprints[a].free.iter().map(|&(x, y)| (x + before.x, y + before.y)));
        let mut ways: Vec<Cells> = Vec::new();
        moves.alternatives(a, b, |sequence| ways.push(beyond(&known, &moves.asked(before, sequence))));
        // Stable: of ways that ask for as much, the first found.
        ways.sort_by_key(Cells::count);
        let mut kept: Vec<Cells> = Vec::with_capacity(WAYS);
        for way in ways {
            // A way that asks for more than a kept one does is of no use.
            if kept.len() < WAYS && !kept.iter().any(|other| other.without(&way).is_empty()) {
                kept.push(way);
            }
        }
        Self { index: b, ways: kept }
    }
}

/// The cells that a way asks for and that are not known to be free. Of a pair of which one must be free, it asks for the one that is nearer to
/// the vertex, and so further inside the turn, unless one is asked for anyway: never too little.
fn beyond(known: &Cells, asked: &Asked) -> Cells {
    let mut cells: Cells = asked.free.iter().copied().collect();
    let has = |cells: &Cells, cell: CellOffset| cells.contains(cell) || known.contains(cell);
    let distance = |(x, y): CellOffset| (2 * x + 1).pow(2) + (2 * y + 1).pow(2);
    for pair in &asked.either {
        if !pair.iter().any(|&cell| has(&cells, cell)) {
            cells.extend(pair.iter().copied().min_by_key(|&cell| distance(cell)));
        }
    }
    for &at in &asked.passed {
        let missing = |pair: &[CellOffset; 2]| pair.iter().filter(|&&cell| !has(&cells, cell)).count();
        if let Some(pair) = Asked::beside(at).into_iter().min_by_key(|pair| missing(pair)) {
            cells.extend(pair);
        }
    }
    cells.without(known)
}
