//! A graph that follows edits equals a new one.

use std::sync::Arc;

use mediant_grid::{Change, Corners, DiagonalGap, FreeSpace, Interrupt};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{Rng, caves, noise, on_all_cores, random_change, rooms, seeds, suite_grid};

use super::LevelRecord;
use crate::{graph::SubgoalGraph, hierarchy::Hierarchy};

fn new(space: &FreeSpace<Corners>, k: K, hierarchy: Hierarchy) -> (SubgoalGraph<Corners>, LevelRecord) {
    let made = SubgoalGraph::with_record(space, k, hierarchy, &|_| {}, &Interrupt::NEVER);
    let (graph, record) = made.expect("there is a graph for this k");
    (graph, record.expect("it has levels"))
}

/// A chain of edits. Returns how many of them the graph followed, and how many there were.
fn check(seed: u64, k: K, hierarchy: Hierarchy, gap: DiagonalGap) -> [usize; 2] {
    let mut rng = Rng::new(seed ^ 0x7E7A);
    let (grid, kind) = match seed % 4 {
        0 => (caves(&mut rng, 40, 40), "caves".to_owned()),
        1 => (noise(&mut rng, 45, 30, 12), "noise".to_owned()),
        2 => (rooms(&mut rng, 66, 30), "rooms".to_owned()),
        _ => suite_grid(seed),
    };
    let mut space = Arc::new(FreeSpace::<Corners>::new(Arc::new(grid), gap));
    let (mut graph, mut record) = new(&space, k, hierarchy);
    let mut followed = 0;
    const EDITS: usize = 6;
    for edit in 0..EDITS {
        let change = random_change(&mut rng, space.grid());
        let next = Arc::new(space.after(&change));
        let said = format!(
            "seed {seed}, {kind}, k = {k}, {gap:?}, {hierarchy:?}, edit {edit}, {:?}",
            change.cells()
        );
        let (expected, anew) = new(&next, k, hierarchy);
        let repaired = record.repaired(&graph, &next, &change, &Interrupt::NEVER);
        let repaired = repaired.unwrap_or_else(|error| panic!("{said}: {error}"));
        followed += usize::from(repaired.is_some());
        if let Some((found, kept)) = repaired {
            assert!(kept.edges == anew.edges, "{said}");
            assert!(kept.seen == anew.seen, "{said}");
            assert!(kept.level == anew.level, "{said}");
            assert!((&kept.first, &kept.shortcuts) == (&anew.first, &anew.shortcuts), "{said}");
            assert!(found.offsets == expected.offsets && found.arcs == expected.arcs, "{said}");
            assert!(found.to_bytes() == expected.to_bytes(), "{said}");
            (graph, record) = (found, kept);
        } else {
            (graph, record) = (expected, anew);
        }
        space = next;
    }
    [followed, EDITS]
}

#[test]
fn a_graph_that_follows_edits_equals_a_new_one() {
    let tallies = on_all_cores(seeds(28), |seed| {
        let k = FiniteK::new(2 + seed as u32 / 4 % 5).expect("k is at least 2").into();
        let levels = [2, 2, 1, 3][seed as usize / 5 % 4];
        let hierarchy = match seed % 7 {
            6 => Hierarchy::AllLevels,
            _ => Hierarchy::Levels(std::num::NonZeroU32::new(levels).expect("at least one")),
        };
        check(seed, k, hierarchy, [DiagonalGap::Open, DiagonalGap::Closed][seed as usize / 3 % 2])
    });
    let [followed, all] = tallies.into_iter().fold([0; 2], |[a, b], [c, d]| [a + c, b + d]);
    assert!(followed > all / 3, "{followed} of {all} edits were followed");
}

/// A list of cells is blocked or freed, first one of them, then two, and so on. Counts the changes that the
/// graph follows. After all others it is made anew, and is equal: only these counts show when a repair is
/// given up.
#[test]
fn the_number_of_repairs_is_pinned() {
    let mut rng = Rng::new(9);
    let grid = Arc::new(rooms(&mut rng, 90, 70));
    let cells: Vec<(u32, u32)> = (0..60).map(|_| (rng.below(90), rng.below(70))).collect();
    let space = FreeSpace::<Corners>::new(Arc::clone(&grid), DiagonalGap::Closed);
    let found = [1, 3].map(|levels| {
        let levels = Hierarchy::Levels(std::num::NonZeroU32::new(levels).expect("at least one"));
        let (graph, record) = new(&space, FiniteK::N8.into(), levels);
        [true, false].map(|is_blocked| {
            let is_repaired = |&count: &usize| {
                let cells = cells[..count].iter().map(|&(x, y)| (x, y, is_blocked));
                let change = Change::new(Arc::clone(&grid)).edit_cells(cells);
                let repaired = record.repaired(&graph, &space.after(&change), &change, &Interrupt::NEVER);
                repaired.expect("there is a graph for this k").is_some()
            };
            (1..=cells.len()).filter(is_repaired).count()
        })
    });
    assert_eq!(found, [[14, 10]; 2]);
}
