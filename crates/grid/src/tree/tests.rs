use std::collections::BTreeSet;

use mediant_moves::Neighborhood;

use super::*;
use crate::{Centers, CornerRule, Corners, DiagonalGap, Grid, footprint::Footprint};

fn moves(k: u32) -> Vec<(Vector, Cost)> {
    let k = FiniteK::new(k).unwrap();
    Neighborhood::new(k).unwrap().iter().map(|v| (v, Cost::of_move(v))).collect()
}

fn octants<P: Placement>(rule: P::Rule, k: u32, grid: &Grid) -> Arc<[Octant]> {
    let bits_per_row = [grid.rows(), grid.columns()].map(BitMatrix::bits_per_row);
    Tree::new::<P>(rule, &moves(k)).octants::<P>(&moves(k), bits_per_row)
}

/// The footprint of a move, as (along, across) in the matrix of its octant.
fn in_matrix<P: Placement>(rule: P::Rule, v: Vector) -> Footprint {
    let mut footprint = Footprint::new::<P>(rule, v);
    if Frame::of(v).0.transposed {
        let swap = |(x, y)| (y, x);
        footprint.free.iter_mut().for_each(|cell| *cell = swap(*cell));
        footprint.free.sort_unstable();
        footprint.either.iter_mut().for_each(|cells| *cells = cells.map(swap));
    }
    footprint
}

/// A mask for each row of these cells, the nearest row first. In no row do they span more than 64 columns.
fn masks(cells: &[CellOffset], bits_per_row: i32) -> Vec<CellMask> {
    let mut cells = cells.to_vec();
    cells.sort_unstable_by_key(|&(along, across)| (across.abs(), across, along));
    let rows = cells.chunk_by(|a, b| a.1 == b.1);
    rows.map(|row| {
        let bits = row.iter().fold(0, |mask, &(along, _)| mask | 1 << (along - row[0].0));
        CellMask::new(row[0], bits, bits_per_row)
    })
    .collect()
}

/// The subtree over moves with these footprints by its definition, cell by cell. `tested` are the cells that
/// the nodes above test.
fn add(octant: &mut Octant, footprints: &[Footprint], first: u16, tested: &[CellOffset], bits_per_row: i32) {
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
    let begin = octant.masks.len() as u32;
    octant.masks.extend(masks(&new, bits_per_row));
    let between = octant.masks.len() as u32;
    octant.masks.extend(masks(&own, bits_per_row));
    assert!(footprints[middle].either.len() <= 1);
    let pair = footprints[middle].either.first().map(|&cells| {
        octant.pairs.push(cells.map(|cell| CellMask::new(cell, 1, bits_per_row)));
        octant.pairs.len() as u16 - 1
    });
    let (node, index) = (octant.nodes.len(), first + middle as u16);
    let places = Places { shared: (begin, between), own: octant.masks.len() as u32 };
    octant.nodes.push(Node { index, skip: 0, places, pair });
    add(octant, &footprints[..middle], first, &tested, bits_per_row);
    add(octant, &footprints[middle + 1..], index + 1, &tested, bits_per_row);
    octant.nodes[node].skip = octant.nodes.len() as u16;
}

/// The bits, by their offset from that of a vertex's own cell, that masks test.
fn bits(masks: &[CellMask]) -> Vec<i32> {
    let mut bits: Vec<i32> = masks.iter().flat_map(CellMask::bits).collect();
    bits.sort_unstable();
    bits
}

fn are_as_defined<P: Placement>(rule: P::Rule, ks: impl Iterator<Item = u32>) {
    let grid = Grid::from_fn(300, 70, |_, _| false).unwrap();
    let mut nodes = 0;
    for k in ks {
        let (moves, octants) = (moves(k), octants::<P>(rule, k, &grid));
        assert_eq!(octants.len(), 8);
        let of_octant = moves.chunks_exact(moves.len() / 8).zip((0..).step_by(moves.len() / 8));
        for ((moves, first), octant) in of_octant.zip(&*octants) {
            let matrix = if octant.transposed { grid.columns() } else { grid.rows() };
            let footprints: Vec<Footprint> =
                moves[1..].iter().map(|&(v, _)| in_matrix::<P>(rule, v)).collect();
            let mut expected = Octant { nodes: vec![], masks: vec![], pairs: vec![], ..octant.clone() };
            add(&mut expected, &footprints, first + 1, &[], matrix.bits_per_row());
            assert_eq!(octant.nodes, expected.nodes, "k = {k}, {rule:?}, from move {first} on");
            assert_eq!(octant.masks, expected.masks, "k = {k}, {rule:?}, from move {first} on");
            assert_eq!(octant.pairs, expected.pairs, "k = {k}, {rule:?}, from move {first} on");
            let cells = |swept: &Footprint| [&*swept.free, swept.either.as_flattened()].concat();
            let all: BTreeSet<CellOffset> = footprints.iter().flat_map(cells).collect();
            let mut all: Vec<i32> =
                all.iter().map(|&(along, across)| across * matrix.bits_per_row() + along).collect();
            all.sort_unstable();
            assert_eq!(bits(&octant.all), all, "k = {k}, {rule:?}, from move {first} on");
            nodes += octant.nodes.len();
        }
    }
    assert!(nodes > 0);
}

#[test]
fn octants_are_as_defined() {
    for rule in [CornerRule::Never, CornerRule::One, CornerRule::Always] {
        are_as_defined::<Centers>(rule, 4..=8);
    }
    for rule in [DiagonalGap::Open, DiagonalGap::Closed] {
        are_as_defined::<Corners>(rule, 4..=8);
    }
    // Some rows of these have more than 64 cells.
    are_as_defined::<Centers>(CornerRule::One, 12..=12);
}

#[test]
fn up_to_k_3_there_are_no_octants() {
    let grid = Grid::from_fn(3, 3, |_, _| false).unwrap();
    for k in [2, 3] {
        assert!(octants::<Centers>(CornerRule::Never, k, &grid).is_empty());
        assert!(octants::<Corners>(DiagonalGap::Open, k, &grid).is_empty());
    }
}

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
    let mut sums = [0; 3];
    for octant in &*octants::<P>(rule, 8, &grid) {
        let (matrix, swap) = if octant.transposed { (grid.columns(), true) } else { (grid.rows(), false) };
        for (x, y) in
            (0..100).flat_map(|y| (0..100).map(move |x| (x, y))).filter(|&(x, y)| grid.is_free(x, y))
        {
            let at = if swap { matrix.index(y, x) } else { matrix.index(x, y) };
            octant.for_each_legal(matrix, at, |_| sums[0] += 1);
            let mut i = 0;
            while let Some(node) = octant.nodes.get(i) {
                let masks = &octant.masks[node.places.shared.0 as usize..node.places.shared.1 as usize];
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
