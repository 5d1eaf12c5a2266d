//! The cells that a segment meets, and the first thing that blocks it, against brute force.

use std::sync::Arc;

use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, Obstruction, Placement, PlacementKind, Rules,
    Vertex, sight::segment_cells,
};
use mediant_oracle::{Rng, describe, random_vertex, seeds, segment_is_legal, suite_grid};

/// How far along a segment its first point in a closed cell is: from 0 to 1, `None` if it misses the cell.
/// Equal fractions of small numbers are equal floating point numbers.
fn entry(kind: PlacementKind, from: Vertex, to: Vertex, cell: (i32, i32)) -> Option<f64> {
    let shift = if kind == PlacementKind::Center { 0.5 } else { 0.0 };
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (from, to, low) in [(from.x, to.x, cell.0), (from.y, to.y, cell.1)] {
        let (at, by) = (f64::from(from) + shift, f64::from(to - from));
        let [low, high] = [f64::from(low), f64::from(low + 1)];
        if by == 0.0 {
            if at < low || at > high {
                return None;
            }
            continue;
        }
        let (a, b) = ((low - at) / by, (high - at) / by);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    (enter <= leave).then_some(enter)
}

#[test]
fn a_segment_meets_the_cells_that_block_it_alone() {
    const SIDE: u32 = 9;
    let vertices = || (1..8).flat_map(|y| (1..8).map(move |x| Vertex::new(x, y)));
    let from = [(1, 1), (3, 4), (7, 2), (4, 7)].map(Vertex::from);
    for rules in [Rules::Center(CornerRule::Never), Rules::Corner(DiagonalGap::Open)] {
        let kind = rules.placement();
        for (from, to) in from.into_iter().flat_map(|from| vertices().map(move |to| (from, to))) {
            let cells: Vec<_> = segment_cells(kind, from, to).collect();
            for cell in (0..9).flat_map(|y| (0..9).map(move |x| (x, y))) {
                let blocked = |x: u32, y: u32| (x as i32, y as i32) == cell;
                let alone = Grid::from_fn(SIDE, SIDE, blocked).expect("it is small");
                let found = cells.iter().filter(|&&other| other == cell).count();
                let expected = usize::from(!segment_is_legal(&alone, rules, from, to));
                assert_eq!(found, expected, "{rules}, {from} to {to}, cell {cell:?}");
            }
            let entries: Vec<_> = cells.iter().map(|&cell| entry(kind, from, to, cell)).collect();
            assert!(entries.is_sorted(), "{rules}, {from} to {to}: {cells:?} are entered at {entries:?}");
        }
    }
}

fn reported(found: Obstruction) -> Vec<(i32, i32)> {
    match found {
        Obstruction::Cell { x, y } => vec![(x, y)],
        Obstruction::Between { cells } => cells.to_vec(),
        _ => Vec::new(),
    }
}

/// A map of the same size on which only these cells are blocked.
fn only(grid: &Grid, cells: &[(i32, i32)]) -> Grid {
    Grid::from_fn(grid.width(), grid.height(), |x, y| cells.contains(&(x as i32, y as i32)))
        .expect("the map had this size")
}

/// Counts cells, pairs of cells and ends.
fn check<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, seed: u64, counts: &mut [u32; 3]) {
    let (space, rules) = (FreeSpace::<P>::new(Arc::clone(grid), rule), P::rules(rule));
    let mut rng = Rng::new(seed);
    for _ in 0..60 {
        let [from, to] = [(); 2].map(|()| random_vertex(&mut rng, grid, P::KIND));
        let found = space.obstruction(from, to);
        let message = || format!("{found:?}: {}", describe(grid, rules, from, to, seed));
        assert_eq!(found.is_none(), segment_is_legal(grid, rules, from, to), "{}", message());
        let Some(found) = found else { continue };
        let cells = reported(found);
        if let Obstruction::End { at } = found {
            let at = at.vertex().expect("both ends are vertices");
            assert!(at == from && !space.is_free(at), "{}", message());
            counts[2] += 1;
            continue;
        }
        counts[cells.len() - 1] += 1;
        let entries = cells.iter().map(|&cell| entry(P::KIND, from, to, cell).expect("it meets them"));
        let at = entries.fold(0.0, f64::max);
        assert!(cells.iter().all(|&(x, y)| grid.is_blocked(x, y)), "{}", message());
        assert!(!segment_is_legal(&only(grid, &cells), rules, from, to), "{}", message());
        let all = (0..grid.height() as i32).flat_map(|y| (0..grid.width() as i32).map(move |x| (x, y)));
        let is_before = |&(x, y): &(i32, i32)| {
            grid.is_blocked(x, y) && entry(P::KIND, from, to, (x, y)).is_some_and(|other| other < at)
        };
        let before: Vec<_> = all.filter(is_before).collect();
        assert!(segment_is_legal(&only(grid, &before), rules, from, to), "{}", message());
    }
}

#[test]
fn what_blocks_a_segment_is_the_first_that_does() {
    let mut counts = [[0; 3]; 5];
    for seed in seeds(60) {
        let grid = Arc::new(suite_grid(seed).0);
        for (rules, counts) in Rules::ALL.into_iter().zip(&mut counts) {
            match rules {
                Rules::Center(rule) => check::<Centers>(&grid, rule, seed, counts),
                Rules::Corner(rule) | Rules::CenterGap(rule) => check::<Corners>(&grid, rule, seed, counts),
            }
        }
    }
    // Pairs are found where the rule knows them.
    let [never, one, always, open, closed] = counts;
    assert!(never[1] == 0 && always[1] == 0, "{counts:?}");
    assert!([one, open, closed].iter().all(|found| found.iter().all(|&n| n > 0)), "{counts:?}");
}

#[test]
fn gaps_on_a_grid_line_block_it() {
    let grid = Grid::from_fn(6, 4, |x, y| matches!((x, y), (2, 1) | (3, 2))).expect("it is small");
    let grid = Arc::new(grid);
    let [closed, open] = [DiagonalGap::Closed, DiagonalGap::Open]
        .map(|rule| FreeSpace::<Corners>::new(Arc::clone(&grid), rule));
    for (from, to) in
        [((0, 2), (6, 2)), ((6, 2), (0, 2)), ((3, 0), (3, 4)), ((3, 4), (3, 0)), ((1, 4), (5, 0))]
    {
        let (from, to) = (from.into(), to.into());
        let Some(Obstruction::Between { mut cells }) = closed.obstruction(from, to) else {
            panic!("from {from} to {to} passes a closed gap");
        };
        cells.sort_unstable();
        assert_eq!(cells, [(2, 1), (3, 2)]);
        assert_eq!(open.obstruction(from, to), None);
    }
    // Outside, wherever it is.
    for to in [(7, 0), (i32::MIN, i32::MIN), (i32::MAX, 4), (0, -1)].map(Vertex::from) {
        assert_eq!(open.obstruction((6, 4).into(), to), Some(Obstruction::End { at: to.into() }));
        assert_eq!(open.obstruction(to, (6, 4).into()), Some(Obstruction::End { at: to.into() }));
    }
}
