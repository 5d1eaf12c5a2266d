//! Scratch memory: earlier queries do not change answers, a warm planner allocates only the path that it
//! returns, and crafted bytes allocate no more than an index of the map.
#![allow(unsafe_code, reason = "a counting allocator implements an unsafe trait")]

#[path = "it/common.rs"]
mod common;

use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
    sync::Arc,
};

use common::{
    Bound, Setting, Solve, any_clustering, any_grid_graph, ask, chpa, clusters, describe_query, grid_graph,
    hpa, k, map, number, random_queries, segments,
};
use mediant_grid::{Centers, Change, CornerRule, Grid, GridGraph, Identity, Rectangle};
use mediant_hierarchy::{ChpaStar, ClusterGraph, Clustering, FallbackPolicy, HpaStar, SegmentGraph};
use mediant_oracle::{Rng, caves, on_all_cores, seeds};
use mediant_search::{Answer, Counters, Ends, Planner};

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
    static BYTES: Cell<usize> = const { Cell::new(0) };
}

struct Counting;

// SAFETY: every call goes to the system's allocator unchanged; the counts touch no heap memory.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        BYTES.set(BYTES.get() + layout.size());
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `dealloc`, and `at` came from `System`.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

#[test]
fn a_used_planner_answers_as_a_new_one() {
    let check = |seed: u64| {
        let (grid, mut rng) = (map(seed), Rng::new(seed ^ 0x5C4A));
        let grid_graph = any_grid_graph(&mut rng, &grid);
        let (of_clusters, of_segments) =
            (clusters(&grid_graph, any_clustering(&mut rng)), segments(&grid_graph, 1 + rng.below(9)));
        let setting = Setting::any(&mut rng);
        let make = |which: usize| -> Solve<'_> {
            match which {
                0 | 1 => hpa(&grid_graph, &of_clusters, which == 0),
                2 => chpa(&grid_graph, &of_segments, setting),
                _ => chpa(&grid_graph, &of_segments, setting.of_the_paper()),
            }
        };
        let mut used = [0, 1, 2, 3].map(make);
        let mut searched = 0;
        for query in random_queries(&mut rng, &grid, 10) {
            for (which, used) in used.iter_mut().enumerate() {
                let case = || format!("{which}, {setting:?}; {}", describe_query(&grid_graph, query, seed));
                let answer = ask(used, query);
                assert_eq!(answer, ask(&mut make(which), query), "a new planner; {}", case());
                assert_eq!(answer, ask(used, query), "asked again; {}", case());
                searched += usize::from(answer.1 != Counters::default());
            }
        }
        searched
    };
    let searched: usize = on_all_cores(seeds(200), check).into_iter().sum();
    assert!(searched > 10 * seeds(200).end as usize, "only {searched} searches");
}

/// A planner that repairs its index and goes on answers as a new one on a new index.
#[test]
fn a_planner_that_repaired_its_index_answers_as_a_new_one() {
    let check = |seed: u64| {
        let (mut grid, mut rng) = (Arc::new(map(seed)), Rng::new(seed ^ 0x6035));
        let first = any_grid_graph(&mut rng, &grid);
        let (k, rule) = (first.k(), first.rule());
        let (clustering, side) = (any_clustering(&mut rng), 1 + rng.below(9));
        let mut grid_graphs = vec![first];
        let mut changes = Vec::new();
        for _ in 0..3 {
            let at = Rectangle { x: rng.below(20), y: rng.below(20), width: 1 + rng.below(9), height: 5 };
            let percent = [0, 50, 100][rng.below(3) as usize];
            let change = Change::new(grid).edit(at, |_, _| rng.chance(percent));
            grid = Arc::clone(change.after());
            grid_graphs.push(grid_graph(&grid, k, rule));
            changes.push(change);
        }
        let mut boxed = (
            HpaStar::new(&grid_graphs[0], Box::new(clusters(&grid_graphs[0], clustering))).expect("it fits"),
            ChpaStar::new(
                &grid_graphs[0],
                Box::new(segments(&grid_graphs[0], side)),
                Bound::GridGraph,
                Bound::GridGraph,
            )
            .expect("it fits"),
        );
        let setting = Setting {
            phases: [Some(Bound::GridGraph); 2],
            step: number(2),
            fallback: FallbackPolicy::default(),
        };
        let mut asked = 0;
        for (grid_graph, change) in grid_graphs[1..].iter().zip(&changes) {
            for query in random_queries(&mut rng, grid_graph.grid(), 2) {
                // Answers on the index before its repair must leave no trace either.
                _ = (boxed.0.solve(query), boxed.1.solve(query));
            }
            boxed.0.repair(grid_graph, change).expect("it fits");
            boxed.1.repair(grid_graph, change).expect("it fits");
            let (of_clusters, of_segments) = (clusters(grid_graph, clustering), segments(grid_graph, side));
            let mut new = [hpa(grid_graph, &of_clusters, true), chpa(grid_graph, &of_segments, setting)];
            for query in random_queries(&mut rng, grid_graph.grid(), 4) {
                let case = || {
                    format!("{clustering:?}, segments of {side}; {}", describe_query(grid_graph, query, seed))
                };
                let mut counters = [Counters::default(); 2];
                let first = boxed.0.solve_observed(query, &mut counters[0]);
                let second = boxed.1.solve_observed(query, &mut counters[1]);
                assert_eq!((first, counters[0]), ask(&mut new[0], query), "{}", case());
                assert_eq!((second, counters[1]), ask(&mut new[1], query), "{}", case());
                asked += 1;
            }
        }
        asked
    };
    let asked: usize = on_all_cores(seeds(200), check).into_iter().sum();
    assert!(asked > 8 * seeds(200).end as usize, "only {asked} queries");
}

fn cave() -> Grid {
    caves(&mut Rng::new(7), 60, 50)
}

/// The most allocations of a query on a warm planner, without that of its path.
fn most_allocations(planner: &mut Solve<'_>, queries: &[Ends], case: &str) -> usize {
    for _ in 0..2 {
        for &query in queries {
            _ = ask(planner, query);
        }
    }
    let (mut found, mut most) = (0, 0);
    for &query in queries {
        let before = ALLOCATIONS.get();
        let (answer, _) = ask(planner, query);
        let path = usize::from(matches!(answer, Ok(Answer::Found(_))));
        most = most.max(ALLOCATIONS.get() - before - path);
        found += path;
    }
    assert!(found > 25, "only {found} paths were found: {case}");
    most
}

#[test]
fn a_warm_query_allocates_its_path_and_nothing_else() {
    let grid = cave();
    let queries = random_queries(&mut Rng::new(1), &grid, 60);
    for number in [2, 3] {
        let grid_graph = grid_graph(&grid, k(number), CornerRule::Never);
        for (side, levels) in [(10, 1), (6, 3), (2, 4), (64, 1)] {
            let graph = clusters(&grid_graph, Clustering { side, levels });
            for straightens in [true, false] {
                let case = format!("side {side}, {levels} levels, {straightens}, k = {number}");
                let most = most_allocations(&mut hpa(&grid_graph, &graph, straightens), &queries, &case);
                assert_eq!(most, 0, "{case}");
            }
        }
        for side in [1, 3, 8] {
            let graph = segments(&grid_graph, side);
            for seed in 0..5 {
                let setting = Setting::any(&mut Rng::new(seed));
                for setting in [setting, setting.of_the_paper()] {
                    let case = format!("segments of {side}, {setting:?}, k = {number}");
                    let most = most_allocations(&mut chpa(&grid_graph, &graph, setting), &queries, &case);
                    assert_eq!(most, 0, "{case}");
                }
            }
        }
    }
}

/// Whether bytes were read, and how many bytes of memory were allocated.
fn allocated<T, E>(read: impl FnOnce() -> Result<T, E>) -> (bool, usize) {
    let before = BYTES.get();
    let result = read();
    (result.is_ok(), BYTES.get() - before)
}

/// Reads an index with wrong words among its first ones: all must be refused, without allocating more than
/// `may_take` bytes.
fn check_headers<T, E>(words: usize, bytes: &[u8], read: impl Fn(&[u8]) -> Result<T, E>, may_take: usize) {
    let (is_ok, most) = allocated(|| read(bytes));
    assert!(is_ok && most > bytes.len() / 2, "{most} bytes for {}", bytes.len());
    let numbers = [0, 1, 2, 3, 8, 9, 64, 65, 1 << 15, 1 << 16, 1 << 30, 1 << 31, u32::MAX - 1, u32::MAX];
    for place in 0..words {
        for number in numbers {
            let mut crafted = bytes.to_vec();
            if crafted[4 * place..4 * place + 4] == number.to_le_bytes() {
                continue;
            }
            crafted[4 * place..4 * place + 4].copy_from_slice(&number.to_le_bytes());
            let (is_ok, taken) = allocated(|| read(&crafted));
            assert!(!is_ok && taken <= may_take, "{number} at {place}: {taken} bytes, {most} for the index");
        }
    }
}

/// The first words are the identity, the next say how the map is cut. In an index of clusters the number of
/// the first one's nodes comes next.
#[test]
fn no_header_allocates_more_than_an_index_of_the_map() {
    let grid = cave();
    let grid_graph: GridGraph<Centers> = grid_graph(&grid, k(3), CornerRule::Never);
    // An index of the smallest clusters in all levels that fit is the largest.
    const WORDS: usize = Identity::BYTES / 4;
    let most = allocated(|| Ok::<_, ()>(clusters(&grid_graph, Clustering { side: 2, levels: 8 }))).1;
    assert!(most < 10_000_000, "{most} bytes for a map of 60 × 50 cells");
    let bytes = clusters(&grid_graph, Clustering { side: 6, levels: 2 }).to_bytes();
    check_headers(WORDS + 3, &bytes, |bytes| ClusterGraph::from_bytes(&grid_graph, bytes), most);
    let bytes = segments(&grid_graph, 3).to_bytes();
    check_headers(WORDS + 1, &bytes, |bytes| SegmentGraph::from_bytes(&grid_graph, bytes), 60 * 50 + 100);
    // A header alone, of the largest indexes, allocates nothing.
    let bytes_of = |grid_graph: &GridGraph<Centers>, words: &[u32]| -> Vec<u8> {
        let words = words.iter().flat_map(|word| word.to_le_bytes());
        grid_graph.identity().to_bytes().into_iter().chain(words).collect()
    };
    for header in [[2, 8], [2, 1], [64, 3]] {
        let bytes = bytes_of(&grid_graph, &header);
        let (is_ok, taken) = allocated(|| ClusterGraph::from_bytes(&grid_graph, &bytes));
        assert!(!is_ok && taken < 200, "{header:?}: {taken} bytes");
    }
    let header = bytes_of(&grid_graph, &[1]);
    let (is_ok, taken) = allocated(|| SegmentGraph::from_bytes(&grid_graph, &header));
    assert!(!is_ok && taken == 0, "{taken} bytes");
    // One cell, and the largest clusters.
    let one = Grid::from_fn(1, 1, |_, _| false).expect("a valid size");
    let grid_graph = common::grid_graph(&one, k(3), CornerRule::Never);
    let numbers = bytes_of(&grid_graph, &[64, 3, 0, 0, 0]);
    let (is_ok, taken) = allocated(|| ClusterGraph::from_bytes(&grid_graph, &numbers));
    assert!(is_ok && taken < 200_000, "{taken} bytes");
}
