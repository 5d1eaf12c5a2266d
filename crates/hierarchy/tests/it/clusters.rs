//! The abstract graph of HPA* has the nodes and costs of the definitions (Botea, Müller & Schaeffer 2004,
//! Sections 3.1 and 3.2): transitions in the entrances between clusters, and the costs of shortest paths
//! between them within a cluster.

use std::collections::{BTreeMap, BTreeSet};

use crate::common::{any_clustering, any_grid_graph, clusters, grid_graph, k, map};
use mediant_grid::{AsciiMap, Centers, CornerRule, Grid, GridGraph, Identity, Vertex};
use mediant_hierarchy::{Clustering, HierarchyError};
use mediant_oracle::{Explicit, Rng, describe, on_all_cores, seeds};

type Cells = BTreeSet<(i32, i32)>;

/// Adds the cells of the transitions across the border between two rows of `length` cells: cells i are
/// `here(i)` and `there(i)`.
fn transitions(
    grid: &Grid,
    length: i32,
    here: impl Fn(i32) -> (i32, i32),
    there: impl Fn(i32) -> (i32, i32),
    cells: &mut Cells,
) {
    let is_open = |i: i32| [here(i), there(i)].iter().all(|&(x, y)| grid.is_free(x, y));
    let mut first = 0;
    while first < length {
        let last = (first..length).take_while(|&i| is_open(i)).last();
        let Some(last) = last else {
            first += 1;
            continue;
        };
        let ends = if last - first + 1 < 6 { vec![(first + last) / 2] } else { vec![first, last] };
        cells.extend(ends.into_iter().flat_map(|i| [here(i), there(i)]));
        first = last + 1;
    }
}

/// The cells of the transitions between clusters of this side.
fn lowest_cells(grid: &Grid, side: i32) -> Cells {
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    let mut cells = Cells::new();
    for top in (0..height).step_by(side as usize) {
        for left in (0..width).step_by(side as usize) {
            let (columns, rows) = (side.min(width - left), side.min(height - top));
            if left > 0 {
                transitions(grid, rows, |i| (left - 1, top + i), |i| (left, top + i), &mut cells);
            }
            if top > 0 {
                transitions(grid, columns, |i| (left + i, top - 1), |i| (left + i, top), &mut cells);
            }
        }
    }
    cells
}

/// The cells of the level below from which a step leads to another of them in another cluster of this side.
fn upper_cells(below: &Cells, side: i32) -> Cells {
    let cluster = |(x, y): (i32, i32)| (x / side, y / side);
    let leads_out = |&&(x, y): &&(i32, i32)| {
        let beside = [(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)];
        beside.iter().any(|&other| below.contains(&other) && cluster(other) != cluster((x, y)))
    };
    below.iter().filter(leads_out).copied().collect()
}

/// The cells of each cluster of a level, the clusters row by row. Within a cluster of the lowest level the
/// cells are row by row, within others by clusters of the level below.
fn by_cluster(grid: &Grid, cells: &Cells, lowest: i32, level: usize) -> Vec<Vec<(i32, i32)>> {
    let side = lowest << level;
    let [columns, rows] = [grid.width(), grid.height()].map(|cells| (cells as i32 + side - 1) / side);
    let places = (0..rows).flat_map(|y| (0..columns).map(move |x| (y, x)));
    let mut clusters: BTreeMap<_, Vec<_>> = places.map(|place| (place, Vec::new())).collect();
    for &(x, y) in cells {
        clusters.entry((y / side, x / side)).or_default().push((x, y));
    }
    let within = |&(x, y): &(i32, i32)| -> Vec<(i32, i32)> {
        let sides = (0..level).rev().map(|level| lowest << level).chain([1]);
        sides.map(|side| (y / side, x / side)).collect()
    };
    clusters.values_mut().for_each(|cells| cells.sort_by_key(within));
    clusters.into_values().collect()
}

/// A map of one cluster alone.
fn cluster_alone(grid: &Grid, at: (i32, i32), side: i32) -> Grid {
    let (left, top) = (at.0 / side * side, at.1 / side * side);
    let is_blocked = |x: u32, y: u32| grid.is_blocked(left + x as i32, top + y as i32);
    Grid::from_fn(side as u32, side as u32, is_blocked).expect("a valid size")
}

/// The numbers of an index, in the order of clusters and nodes.
struct Numbers(std::vec::IntoIter<u32>);

impl Numbers {
    fn next(&mut self) -> u32 {
        self.0.next().expect("the index has a number for each cost")
    }
}

/// Compares a stored cost, in units of 2⁻¹⁶ cells and rounded up on each level, with the cost that Dijkstra's
/// algorithm finds within the cluster. On upper levels it may be higher, since paths lead over transitions.
fn check_cost(found: u32, best: Option<f64>, level: usize, case: impl Fn() -> String) {
    let Some(best) = best else {
        assert_eq!(found, u32::MAX, "{}", case());
        return;
    };
    let (found, step) = (f64::from(found) / 65536.0, 1.0 / 65536.0);
    assert!(found >= best * (1.0 - 1e-9), "{found}, not {best}; {}", case());
    assert!(level > 0 || found < best + step + 1e-9 * best, "{found}, not {best}; {}", case());
}

/// Checks an index. Returns how many nodes it has on all levels, and how many costs were compared.
fn check(grid_graph: &GridGraph<Centers>, clustering: Clustering, seed: u64) -> [usize; 2] {
    let grid = grid_graph.grid();
    let graph = clusters(grid_graph, clustering);
    let case = || {
        let map = describe(grid, grid_graph.rules(), Vertex::new(-1, -1), Vertex::new(-1, -1), seed);
        format!("k = {}, {clustering:?}; {map}", grid_graph.k())
    };
    let words = graph.to_bytes().split_off(Identity::BYTES);
    let words = words.chunks_exact(4).map(|word| u32::from_le_bytes(word.try_into().expect("four bytes")));
    let mut numbers = Numbers(words.collect::<Vec<u32>>().into_iter());
    let header = [(); 2].map(|()| numbers.next());
    assert_eq!(header, [clustering.side, clustering.levels]);
    let mut counts = [0; 2];
    let mut cells = lowest_cells(grid, clustering.side as i32);
    assert_eq!(graph.nodes(), cells.len(), "{}", case());
    for level in 0..clustering.levels as usize {
        let side = (clustering.side as i32) << level;
        if level > 0 {
            cells = upper_cells(&cells, side);
        }
        let by_cluster = by_cluster(grid, &cells, clustering.side as i32, level);
        assert!(level > 0 || graph.clusters() == by_cluster.len(), "{}", case());
        for nodes in by_cluster {
            let case = || format!("nodes {nodes:?} of a cluster on level {level}, {}", case());
            assert_eq!(numbers.next() as usize, nodes.len(), "{}", case());
            counts[0] += nodes.len();
            let Some(&first) = nodes.first() else { continue };
            let alone = cluster_alone(grid, first, side);
            let explicit = Explicit::new(&alone, grid_graph.rules(), Some(grid_graph.k()));
            let local = |(x, y): (i32, i32)| Vertex::new(x % side, y % side);
            for (number, &from) in nodes.iter().enumerate() {
                let costs = explicit.costs_from(local(from));
                for &to in &nodes[number + 1..] {
                    let case = || format!("from {from:?} to {to:?}, {}", case());
                    check_cost(numbers.next(), costs.to(local(to)), level, case);
                    counts[1] += 1;
                }
            }
        }
    }
    assert_eq!(numbers.0.len(), 0, "{}", case());
    counts
}

#[test]
fn nodes_and_lengths_are_those_of_the_definition() {
    let check = |seed: u64| {
        let (grid, mut rng) = (map(seed), Rng::new(seed ^ 0xC157));
        let grid_graph = any_grid_graph(&mut rng, &grid);
        check(&grid_graph, any_clustering(&mut rng), seed)
    };
    let checked = on_all_cores(seeds(200), check);
    let maps = seeds(200).end as usize;
    for index in 0..2 {
        let count: usize = checked.iter().map(|counts| counts[index]).sum();
        assert!(count > 20 * maps, "{count} on {maps} maps");
    }
}

/// Checks the number of nodes of a drawing in clusters of 8 × 8 cells.
#[track_caller]
fn check_drawing(drawing: &str, expected: usize) {
    let grid = AsciiMap::parse(drawing).expect("the drawing is a map").grid;
    let grid_graph = grid_graph(&grid, k(3), CornerRule::Never);
    let graph = clusters(&grid_graph, Clustering { side: 8, levels: 1 });
    assert_eq!(graph.nodes(), expected, "of {drawing}");
}

#[test]
fn known_entrances() {
    let rows = |row: &str, times: usize| format!("{row}\n").repeat(times);
    // Five cells have one transition, in the middle; six have two, at either end.
    check_drawing(&rows("................", 5), 2);
    check_drawing(&rows("................", 6), 4);
    check_drawing(&rows("................", 8), 4);
    // Two entrances, of two cells and of one.
    check_drawing(
        &(rows("................", 2) + &rows(".......#........", 1) + &rows("................", 1)),
        4,
    );
    // Free here and blocked there.
    check_drawing(&(rows(".......#........", 2) + &rows("........#.......", 2)), 0);
    // One cell ends the transitions into two clusters.
    check_drawing(&(rows("#######.........", 8) + &rows("#######.########", 1)), 5);
    check_drawing(&rows("........", 8), 0);
}

#[test]
fn clusterings_out_of_range_are_refused() {
    let grid = Grid::from_fn(30, 20, |_, _| false).expect("a valid size");
    let grid_graph = grid_graph(&grid, k(2), CornerRule::Never);
    let new = |side, levels| {
        mediant_hierarchy::ClusterGraph::new(&grid_graph, Clustering { side, levels })
            .map(|graph| graph.clustering())
    };
    for side in [0, 1, 65, 100, u32::MAX] {
        assert_eq!(new(side, 1), Err(HierarchyError::Side { found: side, min: 2, max: 64 }));
    }
    for (side, levels) in [(2, 0), (2, 9), (3, 8), (10, 6), (64, 4), (64, u32::MAX), (10, 33)] {
        assert_eq!(new(side, levels), Err(HierarchyError::Levels { found: levels, side, max: 256 }));
    }
    for (side, levels) in [(2, 1), (2, 8), (3, 7), (10, 5), (64, 3)] {
        assert_eq!(new(side, levels), Ok(Clustering { side, levels }));
    }
}
