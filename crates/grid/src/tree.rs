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
//!
//! The tree is computed once, for the first octant ([`Tree`]): the eight octants are its reflections. For a
//! map, its cells become masks at offsets that depend on the words of a row ([`Octant`]).

use std::{ops::Range, sync::Arc};

use mediant_moves::{Cost, FiniteK, Vector};

use crate::{
    BitMatrix, Placement, SweptCells,
    bits::BitIndex,
    footprint::CellMask,
    frame::{CellOffset, Frame},
    per_motion::MAX_K,
};

// The cells of a row of the first octant fit in 128 bits.
const _: () = {
    let Ok(k) = FiniteK::new(MAX_K) else { panic!() };
    assert!(matches!(k.radius(), Ok(0..127)));
};

/// Up to 64 cells of a row of the first octant: the lowest bit is column `first`.
#[derive(Clone, Copy, Debug)]
struct RowCells {
    row: i16,
    first: i16,
    cells: u64,
}

/// Adds the cells of rows, given as sets of columns; the first rows first.
fn extend(cells: &mut Vec<RowCells>, rows: impl Iterator<Item = u128>) {
    for (mut columns, row) in rows.zip(0..) {
        while columns != 0 {
            let first = columns.trailing_zeros();
            cells.push(RowCells { row, first: first as i16, cells: (columns >> first) as u64 });
            columns &= !(u128::from(u64::MAX) << first);
        }
    }
}

/// The cells that a move of the first octant sweeps.
#[derive(Clone, Debug, Default)]
struct Swept {
    /// For each row, the columns of cells that must all be free, a bit each.
    rows: Vec<u128>,
    /// The pair of cells of which one must be free. The coordinates of a move have no common divisor, so it
    /// passes through at most one corner of cells: at its middle.
    pair: Option<[CellOffset; 2]>,
}

impl Swept {
    fn by<P: Placement>(rule: P::Rule, d: Vector) -> Self {
        let mut swept = Self::default();
        P::sweep(rule, d, |cells| {
            match cells {
                SweptCells::AllFree { row, first, last } => swept.add(row, first, last),
                SweptCells::EitherFree(pair) => swept.pair = Some(pair),
            }
            true
        });
        swept
    }

    fn add(&mut self, row: i32, first: i32, last: i32) {
        let row = row as usize;
        if self.rows.len() <= row {
            self.rows.resize(row + 1, 0);
        }
        self.rows[row] |= !0 >> (127 - (last - first)) << first;
    }

    fn add_all(&mut self, other: &Self) {
        for (row, &columns) in other.rows.iter().enumerate() {
            self.rows.resize(self.rows.len().max(row + 1), 0);
            self.rows[row] |= columns;
        }
        for (column, row) in other.pair.into_iter().flatten() {
            self.add(row, column, column);
        }
    }
}

/// The cells that all of some moves sweep.
fn shared(swept: &[Swept]) -> Vec<u128> {
    let Some((first, others)) = swept.split_first() else { return Vec::new() };
    let mut shared = first.rows.clone();
    for other in others {
        shared.truncate(other.rows.len());
        shared.iter_mut().zip(&other.rows).for_each(|(shared, columns)| *shared &= columns);
    }
    shared
}

/// Where the cells of a move begin and end in the list that holds those of all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Places {
    /// The cells that its whole subtree sweeps, and no larger one.
    shared: (u32, u32),
    /// The end of the other cells that the move sweeps; they begin where the shared ones end.
    own: u32,
}

/// The moves strictly between two neighboring moves of N(3), as a tree in the frame of the first octant: for
/// every octant, and for every map.
#[derive(Debug, Default)]
pub(crate) struct Tree {
    /// By the angle of the move in the first octant, with the pairs of cells.
    moves: Vec<(Places, Option<[CellOffset; 2]>)>,
    cells: Vec<RowCells>,
    /// All cells that any of the moves sweeps.
    all: Vec<RowCells>,
}

impl Tree {
    /// The tree over the moves beyond N(3) among those of N(k), in angular order.
    pub(crate) fn new<P: Placement>(rule: P::Rule, moves: &[(Vector, Cost)]) -> Self {
        let beyond = moves.get(1..moves.len() / 8).unwrap_or_default();
        let swept: Vec<Swept> = beyond.iter().map(|&(v, _)| Swept::by::<P>(rule, Frame::of(v).1)).collect();
        let mut all = Swept::default();
        swept.iter().for_each(|swept| all.add_all(swept));
        let moves = swept.iter().map(|swept| (Places::default(), swept.pair)).collect();
        let mut tree = Self { moves, ..Self::default() };
        extend(&mut tree.all, all.rows.into_iter());
        tree.add(&swept, 0, &[]);
        tree
    }

    /// Adds the subtree over moves that sweep these cells. `tested` are the cells that the nodes above test:
    /// part of those that the subtree shares.
    fn add(&mut self, swept: &[Swept], first: usize, tested: &[u128]) {
        if swept.is_empty() {
            return;
        }
        let (middle, shared) = (swept.len() / 2, shared(swept));
        let beyond = |rows: &[u128], tested: &[u128]| -> Vec<u128> {
            let tested = tested.iter().copied().chain(std::iter::repeat(0));
            rows.iter().zip(tested).map(|(columns, tested)| columns & !tested).collect()
        };
        let begin = self.cells.len() as u32;
        extend(&mut self.cells, beyond(&shared, tested).into_iter());
        let between = self.cells.len() as u32;
        extend(&mut self.cells, beyond(&swept[middle].rows, &shared).into_iter());
        self.moves[first + middle].0 = Places { shared: (begin, between), own: self.cells.len() as u32 };
        self.add(&swept[..middle], first, &shared);
        self.add(&swept[middle + 1..], first + middle + 1, &shared);
    }

    /// Whether there are no moves beyond N(3).
    pub(crate) const fn is_empty(&self) -> bool {
        self.moves.is_empty()
    }

    /// The octants of the moves of N(k) in angular order, as they lie in a map and in a transposed map with
    /// so many bits a row.
    pub(crate) fn octants<P: Placement>(
        &self,
        moves: &[(Vector, Cost)],
        bits_per_row: [i32; 2],
    ) -> Arc<[Octant]> {
        let octants = moves.chunks_exact(self.moves.len() + 1).zip(0..).filter(|_| !self.is_empty());
        let octants = octants.map(|(moves, octant)| {
            let frame = Frame::of(moves[moves.len() / 2].0).0;
            // Angles grow against those of the first octant in every second one.
            let mirrored = octant % 2 == 1;
            let bits_per_row = bits_per_row[usize::from(frame.transposed)];
            let placing = Placing { tree: self, frame, mirrored, bits_per_row };
            placing.octant::<P>(octant * moves.len() as u16 + 1)
        });
        octants.collect()
    }
}

/// The place of an octant in a matrix of bits: its reflection from the first octant, and the bits a row.
struct Placing<'a> {
    tree: &'a Tree,
    frame: Frame,
    mirrored: bool,
    bits_per_row: i32,
}

impl Placing<'_> {
    /// The octant whose first move has index `first` in N(k).
    fn octant<P: Placement>(&self, first: u16) -> Octant {
        let Tree { moves, cells, all } = self.tree;
        let mut octant = Octant {
            transposed: self.frame.transposed,
            nodes: Vec::with_capacity(moves.len()),
            masks: Vec::with_capacity(cells.len()),
            all: all.iter().map(|&cells| self.mask::<P>(cells)).collect(),
            pairs: Vec::new(),
        };
        self.add::<P>(&mut octant, 0..moves.len(), first);
        octant
    }

    /// Adds the subtree over moves of the octant, in angular order.
    fn add<P: Placement>(&self, octant: &mut Octant, cone: Range<usize>, first: u16) {
        if cone.is_empty() {
            return;
        }
        let middle = cone.start + cone.len() / 2;
        let in_tree = if self.mirrored { self.tree.moves.len() - 1 - middle } else { middle };
        let (Places { shared, own }, pair) = self.tree.moves[in_tree];
        let begin = octant.masks.len() as u32;
        let cells = &self.tree.cells[shared.0 as usize..own as usize];
        octant.masks.extend(cells.iter().map(|&cells| self.mask::<P>(cells)));
        let between = begin + shared.1 - shared.0;
        let places = Places { shared: (begin, between), own: octant.masks.len() as u32 };
        let pair = pair.map(|cells| {
            let cell = |cell| CellMask::new(self.frame.cell::<P>(cell), 1, self.bits_per_row);
            octant.pairs.push(cells.map(cell));
            octant.pairs.len() as u16 - 1
        });
        let node = octant.nodes.len();
        octant.nodes.push(Node { index: first + middle as u16, skip: 0, places, pair });
        self.add::<P>(octant, cone.start..middle, first);
        self.add::<P>(octant, middle + 1..cone.end, first);
        octant.nodes[node].skip = octant.nodes.len() as u16;
    }

    /// Cells of a row, with the first of them along the row in the lowest bit.
    fn mask<P: Placement>(&self, RowCells { row, first, cells }: RowCells) -> CellMask {
        let (row, first) = (i32::from(row), i32::from(first));
        let (first, cells) = if self.frame.long > 0 {
            (first, cells)
        } else {
            let beyond = cells.leading_zeros();
            (first + 63 - beyond as i32, cells.reverse_bits() >> beyond)
        };
        CellMask::new(self.frame.cell::<P>((first, row)), cells, self.bits_per_row)
    }
}

/// A move with the masks of its cells. Nodes are stored in depth-first order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Node {
    /// The index of the move in N(k).
    index: u16,
    /// The next node that is not in this one's subtree.
    skip: u16,
    /// The masks of its cells in [`Octant::masks`].
    places: Places,
    /// The index of its pair in [`Octant::pairs`], if it has one.
    pair: Option<u16>,
}

/// The moves strictly between two neighboring moves of N(3), for maps with as many words a row.
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
            if !free(node.places.shared.0, node.places.shared.1) {
                i = usize::from(node.skip);
                continue;
            }
            let pair = node.pair.map(|pair| self.pairs[usize::from(pair)]);
            if free(node.places.shared.1, node.places.own)
                && pair.is_none_or(|cells| cells.iter().any(|cell| cell.is_free(words, at)))
            {
                legal(usize::from(node.index));
            }
            i += 1;
        }
    }
}

#[cfg(test)]
mod tests;
