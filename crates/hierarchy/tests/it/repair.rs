//! A repaired index equals a new one.

use crate::common::{
    CORNER_RULES, Setting, any_clustering, any_grid_graph, ask, chpa, clusters, grid_graph, hpa, k, map,
    random_queries, segments,
};
use mediant_grid::{AsciiMap, CornerRule, Grid, Rectangle};
use mediant_hierarchy::{Clustering, HierarchyError};
use mediant_oracle::{Rng, describe, on_all_cores, seeds};

/// How the cells of a rectangle change.
#[derive(Clone, Copy, Debug)]
enum Change {
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

fn any_change(rng: &mut Rng) -> Change {
    match rng.below(8) {
        0..=1 => Change::Blocked,
        2..=3 => Change::Freed,
        4..=6 => Change::Scattered(rng.below(100)),
        _ => Change::None,
    }
}

fn changed(rng: &mut Rng, grid: &Grid, at: Rectangle, change: Change) -> Grid {
    grid.with_rectangle(at, |x, y| match change {
        Change::Blocked => true,
        Change::Freed => false,
        Change::Scattered(percent) => rng.chance(percent),
        Change::None => grid.is_blocked(x as i32, y as i32),
    })
}

/// Changes a map four times and repairs both indexes. Returns how often each of them changed.
fn check_sequence(seed: u64) -> [usize; 2] {
    let (mut grid, mut rng) = (map(seed), Rng::new(seed ^ 0x4E9A));
    let first = any_grid_graph(&mut rng, &grid);
    let (k, rule) = (first.k(), first.rule());
    let (clustering, side) = (any_clustering(&mut rng), 1 + rng.below(9));
    let (mut of_clusters, mut of_segments) = (clusters(&first, clustering), segments(&first, side));
    let mut differing = [0; 2];
    for turn in 0..4 {
        // Several changes are made to a map before the first of them is repaired.
        let count = if turn == 3 { 2 } else { 1 };
        let mut places = Vec::new();
        for _ in 0..count {
            let (at, change) = (any_rectangle(&mut rng, &grid), any_change(&mut rng));
            let after = changed(&mut rng, &grid, at, change);
            places.push((at, change, std::mem::replace(&mut grid, after.clone()), after));
        }
        let before = (of_clusters.clone(), of_segments.clone());
        for (at, _, before, after) in &places {
            of_clusters.repair(before, after, *at).expect("only these cells changed");
            of_segments.repair(before, after, *at).expect("only these cells changed");
        }
        let places: Vec<_> = places.into_iter().map(|(at, change, ..)| (at, change)).collect();
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
    let grid = AsciiMap::parse(drawing).expect("the drawing is a map").grid;
    let at = Rectangle { x, y, width: 1, height: 1 };
    let flipped = grid.with_rectangle(at, |x, y| grid.is_free(x as i32, y as i32));
    let clustering = Clustering { side: 2, levels };
    for number in [2, 3] {
        let [first, second] = [&grid, &flipped].map(|grid| grid_graph(grid, k(number), CornerRule::Never));
        let mut repaired = clusters(&first, clustering);
        repaired.repair(&grid, &flipped, at).expect("only this cell changed");
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

#[test]
fn a_map_of_another_size_is_refused() {
    let dotted = |width: u32, height: u32| {
        Grid::from_fn(width, height, |x, y| (x * y) % 5 == 4).expect("a valid size")
    };
    let grid = dotted(20, 13);
    let grid_graphs = CORNER_RULES.map(|rule| grid_graph(&grid, k(2), rule)).into_iter();
    for first in grid_graphs.chain([grid_graph(&grid, k(3), CornerRule::Never)]) {
        let (of_clusters, of_segments) =
            (clusters(&first, Clustering { side: 4, levels: 2 }), segments(&first, 3));
        for (width, height) in [(19, 13), (21, 13), (20, 12), (20, 14), (13, 20), (1, 1), (260, 1)] {
            let (mut clusters, mut segments) = (of_clusters.clone(), of_segments.clone());
            let all = Rectangle { x: 0, y: 0, width: 99, height: 99 };
            for at in [all, Rectangle { width: 0, ..all }] {
                let error = HierarchyError::Size { expected: (20, 13), found: (width, height) };
                assert_eq!(clusters.repair(&grid, &dotted(width, height), at), Err(error.clone()));
                assert_eq!(segments.repair(&grid, &dotted(width, height), at), Err(error));
            }
            assert!(clusters == of_clusters && segments == of_segments, "a refused repair changed the index");
        }
    }
}
