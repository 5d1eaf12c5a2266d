//! The moves of one octant as a tree of mediants, with the words of cells that each one tests.
//!
//! The move of a node is the mediant of the two moves that bound its subtree, so a subtree holds the moves of
//! one cone. The cells that *all of them* sweep are tested first: if one is blocked, the whole subtree is
//! skipped.
//!
//! - At corners, these are all the cells that the node's own move sweeps: by Kramm 2018, Lemma 11, a mediant
//!   sweeps every cell that its parents sweep, and so do all moves below it. An illegal move ends its
//!   subtree, so that the work is about proportional to the number of legal moves.
//! - At centers, Lemma 11 fails. Of a mediant and its two parents, exactly one has two odd coordinates, and
//!   this one passes through a corner of cells at its middle. If it is a parent, rule `Never` requires both
//!   cells beside that corner to be free for this parent, but only one of them for the mediant: (2, 1) can be
//!   legal where (1, 1) is not. If it is the mediant, rules `One` and `Always` require fewer free cells there
//!   than for a parent: (3, 1) can be legal where (2, 1) is not. One thing holds without any lemma: a cell
//!   that all moves of a cone sweep must be free for each of them. Such cells prune subtrees as at corners;
//!   the other cells of a move decide about that move alone.

use std::collections::BTreeSet;

use mediant_moves::Vector;

use crate::{
    BitMatrix, Grid, Placement,
    bits::BitIndex,
    footprint::{CellMask, Footprint, sort_cells},
    frame::{CellOffset, Frame},
};

/// A move with the masks of its cells. Nodes are stored in depth-first order.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// The index of the move in N(k).
    index: u16,
    /// The next node that is not in this one's subtree.
    skip: u16,
    /// Where the masks of the cells that the whole subtree sweeps begin and end in [`Octant::masks`].
    shared: (u32, u32),
    /// Where the masks of the other cells that the move sweeps end; they begin where the shared ones end.
    own: u32,
    /// The index of its pair in [`Octant::pairs`], if it has one.
    pair: Option<u16>,
}

/// The moves strictly between two neighboring moves of N(3).
#[derive(Clone, Debug)]
pub(crate) struct Octant {
    /// Whether the masks are for the transposed map.
    pub(crate) transposed: bool,
    nodes: Vec<Node>,
    masks: Vec<CellMask>,
    /// All cells that any of the moves sweeps: if they are free, all moves are legal. Open ground is
    /// common, and there this takes one load a row instead of several a move.
    all: Vec<CellMask>,
    /// Pairs of cells of which one must be free: corner rule `One`.
    pairs: Vec<[CellMask; 2]>,
}

impl Octant {
    /// The tree over `moves`: 2^n − 1 moves of one octant in angular order, the first of which has index
    /// `first` in N(k).
    pub(crate) fn new<P: Placement>(rule: P::Rule, moves: &[Vector], first: u16, grid: &Grid) -> Self {
        let frame = Frame::of(moves[moves.len() / 2]).0;
        let mut octant = Self {
            transposed: frame.transposed,
            nodes: Vec::new(),
            masks: Vec::new(),
            all: Vec::new(),
            pairs: Vec::new(),
        };
        let footprints: Vec<Footprint> =
            moves.iter().map(|&v| in_matrix::<P>(rule, v, frame.transposed)).collect();
        let cells = |swept: &Footprint| [&*swept.free, swept.either.as_flattened()].concat();
        let all: BTreeSet<CellOffset> = footprints.iter().flat_map(cells).collect();
        let matrix = if frame.transposed { grid.columns() } else { grid.rows() };
        octant.all = CellMask::holding(all.into_iter().collect(), matrix);
        octant.add(&footprints, first, &[], matrix);
        octant
    }

    /// Adds the subtree over moves with these footprints. `tested` are the cells that the nodes above test.
    fn add(&mut self, footprints: &[Footprint], first: u16, tested: &[CellOffset], matrix: &BitMatrix) {
        if footprints.is_empty() {
            return;
        }
        let middle = footprints.len() / 2;
        let mut shared = footprints[middle].free.clone();
        for footprint in footprints {
            shared.retain(|cell| footprint.free.binary_search(cell).is_ok());
        }
        let beyond = |cells: &[CellOffset], tested: &[CellOffset]| -> Vec<CellOffset> {
            cells.iter().filter(|cell| !tested.contains(cell)).copied().collect()
        };
        let new = beyond(&shared, tested);
        let tested = [tested, &new].concat();
        let own = beyond(&footprints[middle].free, &tested);
        let begin = self.masks.len() as u32;
        self.masks.extend(CellMask::holding(new, matrix));
        let between = self.masks.len() as u32;
        self.masks.extend(CellMask::holding(own, matrix));
        // The coordinates of a move have no common divisor, so it passes through at most one corner of cells:
        // at its middle.
        let pair = footprints[middle].either.first().map(|&cells| {
            self.pairs.push(cells.map(|cell| CellMask::cell(cell, matrix)));
            self.pairs.len() as u16 - 1
        });
        let node = self.nodes.len();
        let index = first + middle as u16;
        self.nodes.push(Node {
            index,
            skip: 0,
            shared: (begin, between),
            own: self.masks.len() as u32,
            pair,
        });
        self.add(&footprints[..middle], first, &tested, matrix);
        self.add(&footprints[middle + 1..], index + 1, &tested, matrix);
        self.nodes[node].skip = self.nodes.len() as u16;
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        let masks = size_of_val(&*self.masks) + size_of_val(&*self.all);
        size_of_val(&*self.nodes) + masks + size_of_val(&*self.pairs)
    }

    /// Calls `legal` with the index of each legal move of the octant. `matrix` is the map, or the transposed
    /// map if the octant says so, and `at` the bit of the vertex's own cell in it.
    #[inline]
    pub(crate) fn for_each_legal(&self, matrix: &BitMatrix, at: BitIndex, mut legal: impl FnMut(usize)) {
        let words = matrix.words();
        let all_free = |masks: &[CellMask]| masks.iter().all(|mask| mask.is_free(words, at));
        if all_free(&self.all) {
            // In the order of the tree, so that open ground changes the time alone.
            return self.nodes.iter().for_each(|node| legal(usize::from(node.index)));
        }
        let free = |begin: u32, end: u32| all_free(&self.masks[begin as usize..end as usize]);
        let mut i = 0;
        while let Some(node) = self.nodes.get(i) {
            if !free(node.shared.0, node.shared.1) {
                i = usize::from(node.skip);
                continue;
            }
            let pair = node.pair.map(|pair| self.pairs[usize::from(pair)]);
            if free(node.shared.1, node.own)
                && pair.is_none_or(|cells| cells.iter().any(|cell| cell.is_free(words, at)))
            {
                legal(usize::from(node.index));
            }
            i += 1;
        }
    }
}

/// The footprint of a move, as (along, across) in the matrix of its octant.
fn in_matrix<P: Placement>(rule: P::Rule, v: Vector, transposed: bool) -> Footprint {
    let mut footprint = Footprint::new::<P>(rule, v);
    if transposed {
        let swap = |(x, y)| (y, x);
        footprint.free.iter_mut().for_each(|cell| *cell = swap(*cell));
        sort_cells(&mut footprint.free);
        footprint.either.iter_mut().for_each(|cells| *cells = cells.map(swap));
    }
    footprint
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Centers, CornerRule, Corners, DiagonalGap, Grid};
    use mediant_moves::{FiniteK, Neighborhood};

    /// The number of moves of N(8) beyond N(3) that are legal, the number of nodes visited to find them, and
    /// the number of all these moves, summed over the free vertices of a map on which one cell in n is
    /// blocked at random.
    fn work<P: Placement>(rule: P::Rule, one_in: u64) -> [usize; 3] {
        let mut state = 1_u64;
        let grid = Grid::from_fn(100, 100, |_, _| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33).is_multiple_of(one_in)
        })
        .unwrap();
        let moves: Vec<Vector> = Neighborhood::new(FiniteK::new(8).unwrap()).unwrap().iter().collect();
        let mut sums = [0; 3];
        for (moves, first) in moves.chunks_exact(32).zip((0..).step_by(32)) {
            let octant = Octant::new::<P>(rule, &moves[1..], first + 1, &grid);
            let (matrix, swap) =
                if octant.transposed { (grid.columns(), true) } else { (grid.rows(), false) };
            for (x, y) in
                (0..100).flat_map(|y| (0..100).map(move |x| (x, y))).filter(|&(x, y)| grid.is_free(x, y))
            {
                let at = if swap { matrix.index(y, x) } else { matrix.index(x, y) };
                octant.for_each_legal(matrix, at, |_| sums[0] += 1);
                let mut i = 0;
                while let Some(node) = octant.nodes.get(i) {
                    let masks = &octant.masks[node.shared.0 as usize..node.shared.1 as usize];
                    let blocked = masks.iter().any(|mask| !mask.is_free(matrix.words(), at));
                    i = if blocked { usize::from(node.skip) } else { i + 1 };
                    sums[1] += 1;
                }
                sums[2] += octant.nodes.len();
            }
        }
        sums
    }

    /// The work follows the number of legal moves rather than 2^k. `docs/architecture.md` quotes these
    /// percentages.
    #[test]
    fn blocked_cones_are_skipped() {
        let share = |[legal, visited, all]: [usize; 3]| [100 * legal / all, 100 * visited / all];
        let corners = [2, 5, 20, 100].map(|n| share(work::<Corners>(DiagonalGap::Open, n)));
        let centers = [2, 5, 20, 100].map(|n| share(work::<Centers>(CornerRule::Never, n)));
        assert_eq!(corners, [[2, 7], [14, 27], [55, 68], [80, 86]]);
        assert_eq!(centers, [[0, 9], [10, 27], [50, 66], [77, 85]]);
    }
}
