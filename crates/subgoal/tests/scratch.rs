//! A warm planner allocates nothing but the path that it returns, and reading a graph little more than its
//! bytes.
#![allow(unsafe_code, reason = "a counting allocator implements an unsafe trait")]

#[path = "it/common.rs"]
mod common;

use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
};

use common::{GAPS, HIERARCHIES, graph, k, labels, levels, space};
use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Identity, Vertex};
use mediant_moves::K;
use mediant_oracle::{Rng, caves};
use mediant_search::{Answer, Ends, Planner};
use mediant_subgoal::{
    Hierarchy, HubLabelSearch, HubLabels, SubgoalAStar, SubgoalGraph, SubgoalPlacement, SubgoalTheta,
};

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

fn queries<P: SubgoalPlacement>(space: &FreeSpace<P>) -> Vec<Ends> {
    let vertices = (0..50).flat_map(|y| (0..60).map(move |x| Vertex::new(x, y)));
    let free: Vec<Vertex> = vertices.filter(|&at| space.is_free(at)).step_by(97).collect();
    free.iter().flat_map(|&a| free.iter().map(move |&b| Ends::new(a, b))).collect()
}

/// The most allocations of a query on a warm planner, without that of the path.
fn most_allocations(case: &str, mut planner: impl Planner, queries: &[Ends]) -> usize {
    for &query in queries {
        planner.solve(query).expect("both ends are free");
    }
    let (mut found, mut most) = (0, 0);
    for &query in queries {
        let before = ALLOCATIONS.get();
        let answer = planner.solve(query).expect("both ends are free");
        let path = usize::from(matches!(answer, Answer::Found(_)));
        most = most.max(ALLOCATIONS.get() - before - path);
        found += path;
    }
    assert!(found > 100, "only {found} paths were found: {case}");
    most
}

fn check<P: SubgoalPlacement>(rule: P::Rule, k: K) {
    let space = space::<P>(&caves(&mut Rng::new(7), 60, 50), rule);
    let queries = queries(&space);
    for hierarchy in HIERARCHIES {
        let (graph, case) = (graph(&space, k, hierarchy), format!("{hierarchy:?}, k = {k}, {rule:?}"));
        assert_eq!(
            most_allocations(
                &case,
                SubgoalTheta::new(&space, &graph).expect("the graph is for this space"),
                &queries
            ),
            0,
            "Theta, {case}"
        );
        assert_eq!(
            most_allocations(
                &case,
                SubgoalAStar::new(&space, &graph).expect("the graph is for this space"),
                &queries
            ),
            0,
            "A*, {case}"
        );
    }
    let (labels, case) = (labels(&space, k), format!("labels, k = {k}, {rule:?}"));
    let planner = || HubLabelSearch::new(&space, &labels).expect("the labels are for this space");
    assert_eq!(most_allocations(&case, planner(), &queries), 0, "{case}");
    let mut planner = planner();
    let goals = labels.goals(&space, queries.iter().map(|query| query.goal).take(50)).expect("they are free");
    let mut distances = Vec::new();
    let mut ask = || {
        let before = ALLOCATIONS.get();
        for query in &queries {
            let distance = planner.cost(*query).expect("both ends are free");
            planner.distances(query.start, &goals, &mut distances).expect("the start is free");
            let nearest = planner.nearest(query.start, &goals).expect("the start is free");
            assert!(distance.is_none() || nearest.is_some() || !goals.vertices().contains(&query.goal));
        }
        ALLOCATIONS.get() - before
    };
    ask();
    assert_eq!(ask(), 0, "distances, {case}");
}

#[test]
fn a_warm_query_allocates_its_path_and_nothing_else() {
    for (gap, k) in GAPS.into_iter().flat_map(|gap| [k(3), k(6), K::Any].map(|k| (gap, k))) {
        check::<Corners>(gap, k);
    }
    for k in [k(2), k(3)] {
        check::<Centers>(CornerRule::Never, k);
    }
}

/// Counts in crafted bytes are checked before memory is allocated for them.
#[test]
fn huge_counts_allocate_nothing_huge() {
    let space = space::<Corners>(&caves(&mut Rng::new(7), 60, 50), DiagonalGap::Open);
    let bytes = graph(&space, k(3), levels(2)).to_bytes();
    let allocated = |bytes: &[u8]| {
        let before = BYTES.get();
        let result = SubgoalGraph::from_bytes(&space, k(3), bytes);
        (result.is_ok(), BYTES.get() - before)
    };
    let (is_ok, most) = allocated(&bytes);
    assert!(is_ok && most > bytes.len(), "{most}");
    for count in [1 << 20, 1 << 30, (1 << 31) - 1, 1 << 31, u32::MAX - 1, u32::MAX] {
        // The counts of subgoals and of arcs, the first number of arcs of one subgoal.
        for place in [4, 8, 12].map(|place| Identity::BYTES + place) {
            let mut huge = bytes.clone();
            huge[place..place + 4].copy_from_slice(&u32::to_le_bytes(count));
            let (is_ok, taken) = allocated(&huge);
            assert!(!is_ok && taken <= most, "{count} at {place}: {taken} bytes, {most} for the graph");
        }
    }
    for hierarchy in [Hierarchy::Contracted, Hierarchy::AllLevels] {
        let bytes = graph(&space, k(3), hierarchy).to_bytes();
        let (is_ok, taken) = allocated(&bytes);
        assert!(is_ok && taken < most + 4 * bytes.len(), "{taken} bytes for {}", bytes.len());
    }
}

/// The same of hub labels: the counts of their parts, and of the labels of each group.
#[test]
fn huge_counts_of_labels_allocate_nothing_huge() {
    let space = space::<Corners>(&caves(&mut Rng::new(7), 60, 50), DiagonalGap::Open);
    let bytes = labels(&space, k(3)).to_bytes();
    let allocated = |bytes: &[u8]| {
        let before = BYTES.get();
        let result = HubLabels::from_bytes(&space, k(3), bytes);
        (result.is_ok(), BYTES.get() - before)
    };
    let (is_ok, most) = allocated(&bytes);
    assert!(is_ok && most > bytes.len() && most < 20 * bytes.len(), "{most} for {}", bytes.len());
    for count in
        [1 << 20, 1 << 30, 1 << 32, 1 << 61, 1 << 62, u64::MAX / 4, u64::MAX / 8, u64::MAX - 1, u64::MAX]
    {
        let mut at = Identity::BYTES + 8;
        for width in [4, 4, 8, 4, 8, 4, 4, 4, 8] {
            let mut huge = bytes[..bytes.len() - 8].to_vec();
            let known = u64::from_le_bytes(huge[at..at + 8].try_into().expect("eight bytes"));
            huge[at..at + 8].copy_from_slice(&count.to_le_bytes());
            let (is_ok, taken) = allocated(&common::with_checksum(huge));
            assert!(!is_ok && taken <= most, "{count} at {at}: {taken} bytes, {most} for the labels");
            at += 8 + (width * known as usize).next_multiple_of(8);
        }
    }
}
