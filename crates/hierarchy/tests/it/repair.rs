//! A repaired index equals a new one.

use std::sync::Arc;

use crate::common::{
    Setting, any_clustering, any_grid_graph, ask, chpa, clusters, grid_graph, hpa, k, map, random_queries,
    segments,
};
use mediant_grid::{AsciiMap, Change, CornerRule, Grid, Interrupt, Rectangle};
use mediant_hierarchy::Clustering;
use mediant_oracle::{Rng, caves, describe, maze, noise, on_all_cores, rooms, seeds};

/// How the cells of a rectangle change.
#[derive(Clone, Copy, Debug)]
enum Edit {
    Blocked,
    Freed,
    Scattered(u32),
    /// Not at all.
    None,
}

/// Rectangles of any size anywhere: one cell, none, the whole map, beyond the border, far outside.
fn any_rectangle(rng: &mut Rng, grid: &Grid) -> Rectangle {
    let (columns, rows) = (grid.width(), grid.height());
    let [x, y] = [columns, rows].map(|cells| rng.below(cells + 3));
    match rng.below(10) {
        0..=2 => Rectangle { x, y, width: 1, height: 1 },
        3..=5 => Rectangle { x, y, width: 1 + rng.below(8), height: 1 + rng.below(8) },
        6 => Rectangle { x, y, width: u32::MAX - rng.below(9), height: u32::MAX },
        7 => Rectangle { x: 0, y: 0, width: columns, height: rows },
        8 if rng.chance(50) => Rectangle { x, y, width: 0, height: 5 },
        8 => Rectangle { x, y, width: rng.below(columns + 1), height: 0 },
        _ if rng.chance(20) => Rectangle { x: u32::MAX, y: u32::MAX, width: u32::MAX, height: 1 },
        _ => Rectangle { x: rng.below(columns), y: rng.below(rows), width: columns, height: rows },
    }
}

fn any_edit(rng: &mut Rng) -> Edit {
    match rng.below(8) {
        0..=1 => Edit::Blocked,
        2..=3 => Edit::Freed,
        4..=6 => Edit::Scattered(rng.below(100)),
        _ => Edit::None,
    }
}

fn edited(rng: &mut Rng, change: Change, at: Rectangle, edit: Edit) -> Change {
    let grid = Arc::clone(change.after());
    change.edit(at, |x, y| match edit {
        Edit::Blocked => true,
        Edit::Freed => false,
        Edit::Scattered(percent) => rng.chance(percent),
        Edit::None => grid.is_blocked(x as i32, y as i32),
    })
}

/// Changes a map four times and repairs both indexes. Returns how often each of them changed.
fn check_sequence(seed: u64) -> [usize; 2] {
    let (mut grid, mut rng) = (Arc::new(map(seed)), Rng::new(seed ^ 0x4E9A));
    let first = any_grid_graph(&mut rng, &grid);
    let (k, rule) = (first.k(), first.rule());
    let (clustering, side) = (any_clustering(&mut rng), 1 + rng.below(9));
    let (mut of_clusters, mut of_segments) = (clusters(&first, clustering), segments(&first, side));
    let mut differing = [0; 2];
    for turn in 0..4 {
        // Several edits are one change; what it does not know is found by comparing the maps.
        let mut change = Change::new(Arc::clone(&grid));
        let mut places = Vec::new();
        for _ in 0..1 + turn {
            let (at, edit) = (any_rectangle(&mut rng, &grid), any_edit(&mut rng));
            change = edited(&mut rng, change, at, edit);
            places.push((at, edit));
        }
        grid = Arc::clone(change.after());
        if turn == 2 {
            change = Change::between(Arc::clone(change.before()), Arc::clone(&grid)).expect("the same size");
        }
        let before = (of_clusters.clone(), of_segments.clone());
        of_clusters.repair(&change).expect("its map");
        of_segments.repair(&change).expect("its map");
        let grid_graph = grid_graph(&grid, k, rule);
        let (new_clusters, new_segments) = (clusters(&grid_graph, clustering), segments(&grid_graph, side));
        let case = || {
            let map = describe(&grid, grid_graph.rules(), (-1, -1).into(), (-1, -1).into(), seed);
            format!("k = {k}, {clustering:?}, segments of {side}, change {turn}: {places:?}; {map}")
        };
        assert!(of_clusters == new_clusters, "clusters; {}", case());
        assert!(of_segments == new_segments, "segments; {}", case());
        assert_eq!(of_clusters.to_bytes(), new_clusters.to_bytes(), "{}", case());
        assert_eq!(of_segments.to_bytes(), new_segments.to_bytes(), "{}", case());
        differing[0] += usize::from(before.0 != of_clusters);
        differing[1] += usize::from(before.1 != of_segments);
        let setting = Setting::any(&mut rng);
        let mut pairs = [
            [hpa(&grid_graph, &of_clusters, true), hpa(&grid_graph, &new_clusters, true)],
            [chpa(&grid_graph, &of_segments, setting), chpa(&grid_graph, &new_segments, setting)],
        ];
        for query in random_queries(&mut rng, &grid, 2) {
            for [repaired, new] in &mut pairs {
                assert_eq!(ask(repaired, query), ask(new, query), "{query:?}, {setting:?}; {}", case());
            }
        }
    }
    differing
}

#[test]
fn a_repaired_index_is_the_one_made_anew() {
    let checked = on_all_cores(seeds(400), check_sequence);
    let maps = seeds(400).end as usize;
    assert_eq!(checked.len(), maps);
    for index in 0..2 {
        let differing: usize = checked.iter().map(|differing| differing[index]).sum();
        assert!(2 * differing > maps, "only {differing} repairs of {maps} maps changed anything");
    }
}

/// Flips one cell of a drawing in clusters of 2 × 2 cells, where a cluster of 4 × 4 cells has as many nodes
/// as there can be: in the corners of small clusters, steps join ends of different transitions.
#[track_caller]
fn check_flip(drawing: &str, levels: u32, x: u32, y: u32) {
    let grid = Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid);
    let at = Rectangle { x, y, width: 1, height: 1 };
    let change = Change::new(Arc::clone(&grid)).edit(at, |x, y| grid.is_free(x as i32, y as i32));
    let flipped = Arc::clone(change.after());
    let clustering = Clustering { side: 2, levels };
    for number in [2, 3] {
        let [first, second] = [&grid, &flipped].map(|grid| grid_graph(grid, k(number), CornerRule::Never));
        let mut repaired = clusters(&first, clustering);
        repaired.repair(&change).expect("its map");
        assert!(
            repaired == clusters(&second, clustering),
            "k = {number}, {clustering:?}, {at:?} of {drawing}"
        );
    }
}

#[test]
fn crowded_clusters_are_repaired() {
    let first = "
        ........#.
        .#........
        ..........
        ..........
        ..........
        ..........
        ......#...
        .......#..
        ........#.
    ";
    let second = "
        ..##....#
        ...#.....
        #........
        ....#....
        .........
        ...##.#..
        .....#...
        #..#....#
        .........
    ";
    for levels in 1..=4 {
        check_flip(first, levels, 2, 2);
        check_flip(second, levels, 3, 1);
    }
}

/// Flips scattered cells of a map again and again, few and many at once, and repairs its index. Returns how
/// often it changed.
fn check_scattered(seed: u64) -> usize {
    let mut rng = Rng::new(seed ^ 0x5CA7);
    let (width, height) = (25 + rng.below(50), 25 + rng.below(50));
    let made = match seed % 5 {
        0 => noise(&mut rng, width, height, 20),
        1 => rooms(&mut rng, width, height),
        2 => maze(&mut rng, width, height),
        3 => caves(&mut rng, width, height),
        // Nearly all is free.
        _ => noise(&mut rng, width, height, 2),
    };
    let mut grid = Arc::new(made);
    let first = any_grid_graph(&mut rng, &grid);
    let (k, rule) = (first.k(), first.rule());
    // Small clusters are searched in another way than large ones.
    let clustering = Clustering { side: 6 + rng.below(8), levels: 1 + rng.below(3) };
    let mut repaired = clusters(&first, clustering);
    let mut differing = 0;
    for turn in 0..6 {
        let most = [1, 1, 3, 12, 40][rng.below(5) as usize];
        let cells: Vec<_> = (0..1 + rng.below(most))
            .map(|_| {
                let (x, y) = (rng.below(width), rng.below(height));
                (x, y, grid.is_free(x as i32, y as i32))
            })
            .collect();
        let change = Change::new(Arc::clone(&grid)).edit_cells(cells.iter().copied());
        grid = Arc::clone(change.after());
        let before = repaired.clone();
        if rng.chance(50) {
            repaired.repair(&change).expect("its map");
        } else {
            repaired = repaired.repaired(&change, &Interrupt::NEVER).expect("its map");
        }
        let grid_graph = grid_graph(&grid, k, rule);
        let new = clusters(&grid_graph, clustering);
        let case = || {
            let map = describe(&grid, grid_graph.rules(), (-1, -1).into(), (-1, -1).into(), seed);
            format!("k = {k}, {clustering:?}, change {turn}: {cells:?}; {map}")
        };
        assert!(repaired == new, "{}", case());
        assert_eq!(repaired.to_bytes(), new.to_bytes(), "{}", case());
        differing += usize::from(before != repaired);
    }
    differing
}

#[test]
fn scattered_cells_are_repaired() {
    let checked = on_all_cores(seeds(250), check_scattered);
    let (maps, differing) = (seeds(250).end as usize, checked.iter().sum::<usize>());
    assert_eq!(checked.len(), maps);
    assert!(differing > 3 * maps, "only {differing} repairs of {maps} maps changed anything");
}
