//! A warm planner allocates nothing but the path that it returns.
#![allow(unsafe_code, reason = "a counting allocator implements an unsafe trait")]

use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
    sync::Arc,
};

use mediant_grid::{Centers, Corners, DiagonalGap, FreeSpace, GridGraph, Placement, Vertex};
use mediant_moves::FiniteK;
use mediant_search::{
    AStar, Anya, BlockJps, Canonical, Dijkstra, Hk, Jps, JpsPlus, JumpTable, LazyThetaStar, Outcome,
    PaperCanonical, Planner, Pruning, Query, ThetaStar, Wavefront, Zero, parts::StepwiseFinder,
};

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

struct Counting;

// SAFETY: every call goes to the system's allocator unchanged; the count touches no heap memory.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
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

/// Queries between vertices all over a map.
fn queries<P: Placement>(grid_graph: &FreeSpace<P>) -> Vec<Query> {
    let free: Vec<Vertex> = (0..50).flat_map(|y| (0..60).map(move |x| Vertex::new(x, y))).collect();
    let free: Vec<Vertex> = free.into_iter().filter(|&at| grid_graph.is_free(at)).step_by(197).collect();
    free.iter().flat_map(|&a| free.iter().map(move |&b| Query::new(a, b))).collect()
}

fn check(case: &str, mut planner: impl Planner, queries: &[Query]) {
    for &query in queries {
        planner.solve(query).expect("both ends are free");
    }
    let mut found = 0;
    for &query in queries {
        let before = ALLOCATIONS.get();
        let outcome = planner.solve(query).expect("both ends are free");
        let allocated = ALLOCATIONS.get() - before;
        let expected = usize::from(matches!(outcome, Outcome::Found(_)));
        assert_eq!(allocated, expected, "{case}, {query:?}");
        found += expected;
    }
    assert!(found > 30, "only {found} paths were found: {case}");
}

fn allocations_of<P: Placement>(k: u32) {
    let mut rng = mediant_oracle::Rng::new(7);
    let grid = mediant_oracle::caves(&mut rng, 60, 50);
    let k = FiniteK::new(k).expect("k is at least 2");
    let grid_graph = GridGraph::<P>::new(Arc::new(grid), k, P::Rule::default()).expect("k is in range");
    let (grid_graph, queries) = (&grid_graph, queries(&grid_graph));
    let (h, case) = (Hk, |name| format!("{name}, k = {k}"));
    check(&case("astar"), AStar::new(grid_graph, h), &queries);
    check(&case("dijkstra"), Dijkstra::new(grid_graph, Zero), &queries);
    check(&case("wavefront"), Wavefront::new(grid_graph), &queries);
    let pruning = Arc::new(Pruning::new(grid_graph));
    let pruning = || Arc::clone(&pruning);
    let jps = || Jps::with_finder(grid_graph, pruning(), StepwiseFinder, h);
    check(&case("canonical"), Canonical::with_pruning(grid_graph, pruning(), h), &queries);
    check(&case("canonical as published"), PaperCanonical::new(grid_graph, h), &queries);
    check(&case("jps"), jps(), &queries);
    check(&case("theta"), ThetaStar::new(grid_graph, h), &queries);
    check(&case("lazy-theta"), LazyThetaStar::new(grid_graph, h), &queries);
    check(&case("jps, bounded"), jps().with_jump_limit(Some(3)).with_intermediate(true), &queries);
    if k <= FiniteK::N8 {
        let table = Arc::new(JumpTable::new(grid_graph).expect("k is in range"));
        check(&case("jps-block"), BlockJps::new(grid_graph, h).expect("k is in range"), &queries);
        check(
            &case("jps-plus"),
            JpsPlus::new(grid_graph, table, h).expect("the table is this map's"),
            &queries,
        );
    }
}

#[test]
fn a_warm_query_allocates_its_path_and_nothing_else() {
    // One k for each way in which a canonical search finds its successors.
    for k in [2, 3, 5, 9] {
        allocations_of::<Centers>(k);
        allocations_of::<Corners>(k);
    }
}

#[test]
fn nor_does_anya() {
    for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
        let grid = Arc::new(mediant_oracle::caves(&mut mediant_oracle::Rng::new(7), 60, 50));
        let space = FreeSpace::<Corners>::new(grid, gap);
        check(&format!("anya, gap {gap}"), Anya::new(&space), &queries(&space));
    }
}
