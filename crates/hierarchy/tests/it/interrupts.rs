//! Making, repairing and reading indexes can be stopped anywhere.

use std::sync::Arc;

use mediant_grid::{Centers, Change, CornerRule, Grid, GridGraph, Interrupt, Rectangle, StoppedBy};
use mediant_hierarchy::{ClusterGraph, Clustering, HierarchyError, SegmentGraph};
use mediant_moves::FiniteK;
use mediant_oracle::check_interrupts;

const SIDE: u32 = 200;
const CLUSTERING: Clustering = Clustering { side: 10, levels: 2 };

fn graph(blocked: impl Fn(u32, u32) -> bool) -> GridGraph<Centers> {
    let grid = Arc::new(Grid::from_fn(SIDE, SIDE, blocked).expect("a map"));
    GridGraph::new(grid, FiniteK::N8, CornerRule::Never).expect("k = 3")
}

fn posts(x: u32, y: u32) -> bool {
    x % 7 == 3 && y % 5 != 2
}

fn by(error: &HierarchyError) -> Option<StoppedBy> {
    if let HierarchyError::Interrupted(error) = error { Some(error.by) } else { None }
}

#[test]
fn clusters_stop() {
    let graph = graph(posts);
    let make = |i: &Interrupt| ClusterGraph::interruptible(&graph, CLUSTERING, i);
    // A search from each node.
    let whole = ClusterGraph::new(&graph, CLUSTERING).expect("an index");
    check_interrupts("clusters", whole.nodes(), make, by);
    let bytes = whole.to_bytes();
    let read = |i: &Interrupt| ClusterGraph::from_bytes_interruptible(&graph, &bytes, i);
    check_interrupts("clusters' bytes", whole.clusters() / 64, read, by);
}

#[test]
fn segments_stop() {
    let graph = graph(posts);
    let make = |i: &Interrupt| SegmentGraph::interruptible(&graph, 3, i);
    check_interrupts("segments", SIDE as usize / 3, make, by);
}

/// The index stays that of the map before.
#[test]
fn repairs_stop() {
    let before = graph(posts);
    let at = Rectangle { x: 20, y: 30, width: 90, height: 80 };
    let after =
        graph(|x, y| if (20..110).contains(&x) && (30..110).contains(&y) { x == y } else { posts(x, y) });
    let change =
        Change::new(Arc::clone(before.grid())).edit(at, |x, y| after.grid().is_blocked(x as i32, y as i32));
    let clusters = ClusterGraph::new(&before, CLUSTERING).expect("an index");
    check_interrupts("repairing clusters", 300, |i| clusters.repaired(&change, i), by);
    let segments = SegmentGraph::new(&before, 3).expect("an index");
    check_interrupts("repairing segments", 4, |i| segments.repaired(&change, i), by);
    assert_eq!(Ok(clusters), ClusterGraph::new(&before, CLUSTERING));
    assert_eq!(Ok(segments.clone()), SegmentGraph::new(&before, 3));
    let repaired = segments.repaired(&change, &Interrupt::NEVER);
    assert_eq!(repaired, SegmentGraph::new(&after, 3));
}
