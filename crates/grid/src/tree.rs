//! The moves of one octant as a tree of mediants, with the words that each one tests.
//!
//! A node's move is the mediant of the two moves that bound its subtree, so a subtree holds the moves of one
//! cone. *What all of them sweep* is tested first: when it is blocked, the whole subtree is skipped.
//!
//! - At corners, that is all that the node's own move sweeps: by Kramm 2018, Lemma 11, a mediant sweeps every
//!   cell that its parents sweep, hence so does everything below it. An illegal move ends its subtree, and
//!   the work is about that for the legal moves alone.
//! - At centers Lemma 11 fails. Of a mediant and its two parents exactly one has two odd coordinates, and
//!   that one passes through a corner point at its middle. Where it is a parent, rule `Never` asks it for
//!   both cells beside that point and the mediant for one: (2, 1) can be legal where (1, 1) is not. Where it
//!   is the mediant, rules `One` and `Always` ask it for fewer cells there than a parent: (3, 1) can be legal
//!   where (2, 1) is not. What does hold needs no lemma: a cell that all moves of a cone sweep must be free
//!   for each of them. Such cells prune subtrees as before; the rest of a move's cells decides on that move
//!   alone.

use std::collections::BTreeSet;

use mediant_moves::Vector;

use crate::{
    BitMatrix, Grid, Placement,
    bits::BitIndex,
    footprint::{CellMask, CellOffset, Footprint},
    frame::Frame,
};

#[derive(Clone, Copy, Debug)]
struct Node {
    /// The move's index in N(k).
    index: u16,
    /// The next node that is not below this one.
    skip: u16,
    /// The node's masks in [`Octant::masks`]: those shared by its subtree, then its own.
    shared: (u32, u32),
    own: u32,
    /// Its pair in [`Octant::pairs`], if any.
    pair: Option<u16>,
}

/// The moves strictly between two neighboring moves of N(3).
#[derive(Clone, Debug)]
pub(crate) struct Octant {
    /// Whether its masks are for the transposed map.
    pub(crate) transposed: bool,
    nodes: Vec<Node>,
    masks: Vec<CellMask>,
    /// All that any of its moves asks of the map: when that is free, all of them are legal. Open ground is
    /// common, and on it this is a load a row instead of several a move.
    all: Vec<CellMask>,
    /// Two cells of which one must be free: corner rule `One`.
    pairs: Vec<[CellMask; 2]>,
}

impl Octant {
    /// The tree over `moves`, which has 2^n − 1 moves of one octant in angular order, the first of index
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
        let sweeps: Vec<Footprint> =
            moves.iter().map(|&v| in_matrix::<P>(rule, v, frame.transposed)).collect();
        let asked = |sweep: &Footprint| [&*sweep.free, sweep.either.as_flattened()].concat();
        let asked: BTreeSet<CellOffset> = sweeps.iter().flat_map(asked).collect();
        let matrix = if frame.transposed { grid.columns() } else { grid.rows() };
        octant.all = CellMask::holding(asked, matrix);
        octant.add(&sweeps, first, &[], matrix);
        octant
    }

    /// Adds the subtree of these moves. `tested` are the cells that the nodes above have tested.
    fn add(&mut self, sweeps: &[Footprint], first: u16, tested: &[CellOffset], matrix: &BitMatrix) {
        if sweeps.is_empty() {
            return;
        }
        let middle = sweeps.len() / 2;
        let mut shared = sweeps[middle].free.clone();
        for sweep in sweeps {
            shared.retain(|cell| sweep.free.binary_search(cell).is_ok());
        }
        let beyond = |cells: &[CellOffset], tested: &[CellOffset]| -> Vec<CellOffset> {
            cells.iter().filter(|cell| !tested.contains(cell)).copied().collect()
        };
        let new = beyond(&shared, tested);
        let tested = [tested, &new].concat();
        let own = beyond(&sweeps[middle].free, &tested);
        let begin = self.masks.len() as u32;
        self.masks.extend(CellMask::holding(new, matrix));
        let between = self.masks.len() as u32;
        self.masks.extend(CellMask::holding(own, matrix));
        // A move has no common divisor, so it meets at most one corner point: its middle.
        let pair = sweeps[middle].either.first().map(|&cells| {
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
        self.add(&sweeps[..middle], first, &tested, matrix);
        self.add(&sweeps[middle + 1..], index + 1, &tested, matrix);
        self.nodes[node].skip = self.nodes.len() as u16;
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        let masks = size_of_val(&*self.masks) + size_of_val(&*self.all);
        size_of_val(&*self.nodes) + masks + size_of_val(&*self.pairs)
    }

    /// Calls `legal` with the index of each legal move of the octant. `matrix` is the octant's, `at` the bit
    /// of the vertex's own cell there.
    #[inline]
    pub(crate) fn for_each_legal(&self, matrix: &BitMatrix, at: BitIndex, mut legal: impl FnMut(usize)) {
        let words = matrix.words();
        let all_free = |masks: &[CellMask]| masks.iter().all(|mask| mask.is_free(words, at));
        if all_free(&self.all) {
            // In the order of the tree, so that open ground changes nothing but the time.
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

/// The footprint of a move, as (along, across) in its octant's matrix.
fn in_matrix<P: Placement>(rule: P::Rule, v: Vector, transposed: bool) -> Footprint {
    let mut footprint = Footprint::new::<P>(rule, v);
    if transposed {
        let swap = |(x, y)| (y, x);
        footprint.free.iter_mut().for_each(|cell| *cell = swap(*cell));
        footprint.free.sort_unstable();
        footprint.either.iter_mut().for_each(|cells| *cells = cells.map(swap));
    }
    footprint
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Centers, CornerRule, Corners, DiagonalGap, Grid};
    use mediant_moves::{FiniteK, Neighborhood};

    /// How many moves of N(8) beyond N(3) are legal, how many nodes are visited to find them, and how many
    /// moves there are, over all free vertices of a map with every n-th cell blocked at random.
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

    /// The work follows the legal moves rather than 2^k. `docs/architecture.md` quotes these numbers.
    #[test]
    fn blocked_cones_are_skipped() {
        let share = |[legal, visited, all]: [usize; 3]| [100 * legal / all, 100 * visited / all];
        let corners = [2, 5, 20, 100].map(|n| share(work::<Corners>(DiagonalGap::Open, n)));
        let centers = [2, 5, 20, 100].map(|n| share(work::<Centers>(CornerRule::Never, n)));
        assert_eq!(corners, [[2, 7], [14, 27], [55, 68], [80, 86]]);
        assert_eq!(centers, [[0, 9], [10, 27], [50, 66], [77, 85]]);
    }
}
