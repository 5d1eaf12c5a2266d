//! A warm planner allocates nothing but the path that it returns.
#![allow(unsafe_code, reason = "a counting allocator implements an unsafe trait")]

use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
    sync::Arc,
};

use mediant_grid::{Centers, Corners, Lattice, Place, Vertex};
use mediant_moves::K;
use mediant_search::{AStar, LatticeDistance, Outcome, Planner, Query};

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

fn allocations_of<P: Place>(k: u32) {
    let mut rng = mediant_oracle::Rng::new(7);
    let grid = mediant_oracle::caves(&mut rng, 60, 50);
    let lattice = Lattice::<P>::new(Arc::new(grid), K::new(k).expect("k is at least 2"), P::Rule::default())
        .expect("k is in range");
    let mut planner = AStar::new(&lattice, LatticeDistance);
    let free: Vec<Vertex> = (0..50).flat_map(|y| (0..60).map(move |x| Vertex::new(x, y))).collect();
    let free: Vec<Vertex> = free.into_iter().filter(|&at| lattice.is_free(at)).step_by(97).collect();
    let queries: Vec<Query> =
        free.iter().flat_map(|&a| free.iter().map(move |&b| Query::new(a, b))).collect();
    for &query in &queries {
        planner.solve(query).expect("both ends are free");
    }
    let mut found = 0;
    for &query in &queries {
        let before = ALLOCATIONS.get();
        let outcome = planner.solve(query).expect("both ends are free");
        let allocated = ALLOCATIONS.get() - before;
        let expected = usize::from(matches!(outcome, Outcome::Found(_)));
        assert_eq!(allocated, expected, "k = {k}, {query:?}");
        found += expected;
    }
    assert!(found > 100, "only {found} paths were found");
}

#[test]
fn a_warm_query_allocates_its_path_and_nothing_else() {
    for k in [2, 3, 5, 8] {
        allocations_of::<Centers>(k);
        allocations_of::<Corners>(k);
    }
}
