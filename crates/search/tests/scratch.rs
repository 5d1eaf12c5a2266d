//! A warm planner allocates nothing but the path that it returns.
#![allow(unsafe_code, reason = "a counting allocator implements an unsafe trait")]

use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
    sync::Arc,
};

use mediant::{Engine, Map, Motion, Planner, Setup};
use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, Grid, Placement, PlacementKind, Rules, Vertex,
};
use mediant_moves::{FiniteK, K};
use mediant_search::{Answer, Ends};

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
fn queries(grid: &Grid, placement: PlacementKind) -> Vec<Ends> {
    let is_free = |at: Vertex| match placement {
        PlacementKind::Center => Centers::is_free(grid, at),
        PlacementKind::Corner => Corners::is_free(grid, at),
    };
    let all = (0..50).flat_map(|y| (0..60).map(move |x| Vertex::new(x, y)));
    let free: Vec<Vertex> = all.filter(|&at| is_free(at)).step_by(311).collect();
    free.iter().flat_map(|&a| free.iter().map(move |&b| Ends::new(a, b))).collect()
}

fn check(setup: Setup, planner: &mut Planner, queries: &[Ends]) {
    for &query in queries {
        planner.find(query).expect("both ends are free");
    }
    let mut found = 0;
    for &query in queries {
        let before = ALLOCATIONS.get();
        let answer = planner.find(query).expect("both ends are free");
        let allocated = ALLOCATIONS.get() - before;
        let expected = usize::from(matches!(answer, Answer::Found(_)));
        assert_eq!(allocated, expected, "{setup}, {query:?}");
        found += expected;
    }
    assert!(found > 30, "only {found} paths were found: {setup}");
}

/// Checks every setup of the catalog whose engine is in this crate, but for those that smooth their paths:
/// smoothing allocates. How many there were.
fn check_all(k: K, rules: Rules) -> usize {
    use Engine::{Chpa, Hpa, Landmarks, Subgoal, SubgoalTheta};
    let grid = Arc::new(mediant_oracle::caves(&mut mediant_oracle::Rng::new(7), 60, 50));
    let queries = queries(&grid, rules.placement());
    let is_here =
        |setup: &Setup| !matches!(setup.engine.kind(), Subgoal | SubgoalTheta | Hpa | Chpa | Landmarks);
    let setups = Setup::all(Motion::new(k, rules)).filter(is_here).filter(|setup| setup.smoothing.is_none());
    setups
        .inspect(|&setup| {
            let planner = setup.planner(&Map::from(Arc::clone(&grid)));
            check(setup, &mut planner.unwrap_or_else(|error| panic!("{setup}: {error}")), &queries);
        })
        .count()
}

#[test]
fn a_warm_query_allocates_its_path_and_nothing_else() {
    let mut setups = 0;
    // One k for each way in which a canonical search finds its successors.
    for k in [2, 3, 5, 9].map(|k| K::Finite(FiniteK::new(k).expect("k is at least 2"))) {
        for rules in [Rules::Center(CornerRule::Never), Rules::Corner(DiagonalGap::Open)] {
            setups += check_all(k, rules);
        }
    }
    // 4 of A*, Dijkstra, wavefront, 4 of canonical, 5 of jps, 3 each of theta and lazy-theta; for k ≤ 3 also
    // 5 of jps-block and 4 of jps-plus. At corners also anya.
    assert_eq!(setups, 2 * (4 * (4 + 1 + 1 + 4 + 5 + 3 + 3) + 2 * (5 + 4)) + 4);
}

#[test]
fn nor_does_anya_at_any_angle() {
    for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
        assert_eq!(check_all(K::ANY, Rules::Corner(gap)), 1);
    }
}
