//! An index is used on no other grid graph than its own, read for no other, and repaired from no other map:
//! all else is refused with an error that names both, and changes nothing.

use std::sync::Arc;

use mediant_grid::{Centers, Change, CornerRule, Grid, GridGraph, Identity, Mismatch, Rectangle};
use mediant_hierarchy::{ChpaStar, ClusterGraph, Clustering, HierarchyError, HpaStar, SegmentGraph};
use mediant_oracle::{Rng, noise};
use mediant_search::{Ends, Hk, Planner, Zero};

use crate::common::{clusters, grid_graph, k, segments};

fn map(seed: u64, width: u32, height: u32) -> Grid {
    noise(&mut Rng::new(seed), width, height, 20)
}

/// A grid graph with its indexes.
struct Prepared {
    grid_graph: GridGraph<Centers>,
    clusters: ClusterGraph,
    segments: SegmentGraph,
}

impl Prepared {
    fn new(grid: &Grid, number: u32, rule: CornerRule) -> Self {
        let grid_graph = grid_graph(grid, k(number), rule);
        let clusters = clusters(&grid_graph, Clustering { side: 4, levels: 2 });
        Self { clusters, segments: segments(&grid_graph, 3), grid_graph }
    }

    fn identity(&self) -> Identity {
        self.grid_graph.identity()
    }

    fn grid(&self) -> &Grid {
        self.grid_graph.grid()
    }
}

/// Two that are equal, and others of another map, size, k and rule.
fn all() -> Vec<Prepared> {
    let never = CornerRule::Never;
    vec![
        Prepared::new(&map(1, 20, 14), 3, never),
        Prepared::new(&map(1, 20, 14), 3, never),
        Prepared::new(&map(2, 20, 14), 3, never),
        Prepared::new(&map(1, 14, 20), 3, never),
        Prepared::new(&map(1, 60, 40), 3, never),
        Prepared::new(&map(1, 20, 14), 2, never),
        Prepared::new(&map(1, 20, 14), 2, CornerRule::Always),
    ]
}

/// Checks that a join succeeds for what belongs together, and otherwise says what each of the two is for.
fn check(result: Result<Identity, HierarchyError>, index: Identity, grid_graph: Identity) {
    match result {
        Ok(identity) => assert!(identity == index && index == grid_graph, "{index} with {grid_graph}"),
        Err(HierarchyError::Mismatch(wrong)) => {
            let expected = ("the index", index, "the grid graph", grid_graph);
            let Mismatch { prepared, belongs_to, other, other_belongs_to: found } = wrong;
            assert_eq!((prepared, belongs_to, other, found), expected);
            assert_ne!(index, grid_graph);
        }
        Err(error) => panic!("{error}: {index} with {grid_graph}"),
    }
}

#[test]
fn an_index_of_something_else_is_refused() {
    let all = all();
    let mut accepted = 0;
    for own in &all {
        assert_eq!((own.clusters.identity(), own.segments.identity()), (own.identity(), own.identity()));
        for other in &all {
            let (grid_graph, index, found) = (&other.grid_graph, own.identity(), other.identity());
            let planner = HpaStar::new(grid_graph, &own.clusters);
            check(planner.map(|planner| planner.identity()), index, found);
            let planner = ChpaStar::new(grid_graph, &own.segments, Hk, Zero);
            check(planner.map(|planner| planner.identity()), index, found);
            let read = ClusterGraph::from_bytes(grid_graph, &own.clusters.to_bytes());
            check(read.map(|graph| graph.identity()), index, found);
            let read = SegmentGraph::from_bytes(grid_graph, &own.segments.to_bytes());
            check(read.map(|graph| graph.identity()), index, found);
            let equal = [own.clusters == other.clusters, own.segments == other.segments];
            assert_eq!(equal, [index == found; 2], "{index}, {found}");
            accepted += usize::from(index == found);
        }
    }
    assert_eq!(accepted, all.len() + 2);
    // Moves that there are no hierarchies for are another identity, too.
    for (number, rule) in [(3, CornerRule::One), (3, CornerRule::Always), (4, CornerRule::Never)] {
        let own = &all[0];
        let other = grid_graph(own.grid(), k(number), rule);
        let (index, found) = (own.identity(), other.identity());
        check(HpaStar::new(&other, &own.clusters).map(|planner| planner.identity()), index, found);
        let read = SegmentGraph::from_bytes(&other, &own.segments.to_bytes());
        check(read.map(|graph| graph.identity()), index, found);
    }
}

/// Only its own identity is good enough for bytes.
#[test]
fn bytes_are_those_of_one_map_and_one_k() {
    let own = &all()[0];
    for other in [Identity { map: None, ..own.identity() }, Identity { k: None, ..own.identity() }] {
        let [clusters, segments] = [own.clusters.to_bytes(), own.segments.to_bytes()].map(|mut bytes| {
            bytes[..Identity::BYTES].copy_from_slice(&other.to_bytes());
            bytes
        });
        let errors = [
            ClusterGraph::from_bytes(&own.grid_graph, &clusters).map(|_| ()),
            SegmentGraph::from_bytes(&own.grid_graph, &segments).map(|_| ()),
            // Nor does it matter what else is wrong.
            ClusterGraph::from_bytes(&own.grid_graph, &clusters[..Identity::BYTES]).map(|_| ()),
        ];
        for error in errors {
            assert!(matches!(error, Err(HierarchyError::Mismatch(_))), "{error:?}");
        }
    }
    let refused = ClusterGraph::from_bytes(&own.grid_graph, &[0xff; 100]);
    assert_eq!(refused, Err(HierarchyError::Bytes("they do not begin with what they belong to")));
}

#[test]
fn planners_repair_for_no_other_moves() {
    let all = all();
    let query = Ends::new((0, 0), (19, 13));
    for own in &all[..1] {
        for other in &all {
            let mut hpa = HpaStar::new(&own.grid_graph, Box::new(own.clusters.clone())).expect("its own");
            let segments = Box::new(own.segments.clone());
            let mut chpa = ChpaStar::new(&own.grid_graph, segments, Hk, Zero).expect("its own");
            let before = (hpa.solve(query), chpa.solve(query));
            let (index, found) = (own.identity(), other.identity());
            let [old, new] = [own, other].map(|of| Arc::clone(of.grid_graph.grid()));
            let Some(change) = Change::between(old, new) else { continue };
            let results = [hpa.repair(&other.grid_graph, &change), chpa.repair(&other.grid_graph, &change)];
            for result in results {
                match result {
                    Ok(()) => assert_eq!((index.rules, index.k), (found.rules, found.k)),
                    Err(error) => {
                        assert_ne!((index.rules, index.k), (found.rules, found.k), "{error}");
                        check(Err(error), index, found);
                    }
                }
            }
            let is_repaired = hpa.identity() != index;
            assert_eq!(is_repaired, found.map == all[2].identity().map, "{found}");
            assert_eq!(hpa.identity(), chpa.identity());
            if !is_repaired {
                assert_eq!((hpa.solve(query), chpa.solve(query)), before, "{found}");
            }
        }
    }
}

/// Repairs both indexes of one. Returns the error, after which nothing is changed.
fn refused(own: &Prepared, change: &Change) -> HierarchyError {
    let (mut clusters, mut segments) = (own.clusters.clone(), own.segments.clone());
    let error = clusters.repair(change).expect_err("to be refused");
    assert_eq!(segments.repair(change), Err(error.clone()));
    assert!(clusters == own.clusters && segments == own.segments, "a refused repair changed the index");
    error
}

#[test]
fn an_index_is_repaired_from_its_own_map() {
    let all = all();
    let own = &all[0];
    for other in &all[2..5] {
        let [own_grid, other_grid] = [own, other].map(|of| Arc::clone(of.grid_graph.grid()));
        let same_size = Change::between(Arc::clone(&other_grid), own_grid);
        for change in [Change::new(other_grid)].into_iter().chain(same_size) {
            let error = refused(own, &change);
            let HierarchyError::Mismatch(wrong) = &error else { panic!("{error}") };
            assert_eq!((wrong.belongs_to, wrong.other_belongs_to), (own.identity(), other.identity()));
            assert!(error.to_string().contains("the map before the change"), "{error}");
        }
    }
}

#[test]
fn a_planner_is_repaired_for_the_map_after_the_change() {
    let own = &all()[0];
    let at = Rectangle::new(5, 6, 3, 2);
    let grid = Arc::clone(own.grid_graph.grid());
    let change = Change::new(Arc::clone(&grid)).edit(at, |x, y| grid.is_free(x as i32, y as i32));
    let [before, after] = [change.before(), change.after()];
    let mut planner = HpaStar::new(&own.grid_graph, Box::new(own.clusters.clone())).expect("its own");
    let error = planner.repair(&own.grid_graph, &change).expect_err("the map before");
    assert!(error.to_string().contains("the map after the change"), "{error}");
    assert_eq!(planner.identity(), own.identity());
    // Equal maps made independently are the same.
    let equal = Change::between(Arc::new(map(1, 20, 14)), Arc::clone(after)).expect("the same size");
    assert_eq!(equal.before(), before);
    for change in [&change, &equal] {
        let mut repaired = (own.clusters.clone(), own.segments.clone());
        repaired.0.repair(change).expect("its map");
        repaired.1.repair(change).expect("its map");
        let new = Prepared::new(after, 3, CornerRule::Never);
        assert!(repaired.0 == new.clusters && repaired.1 == new.segments);
        assert_eq!((repaired.0.identity(), repaired.1.identity()), (new.identity(), new.identity()));
        assert!(HpaStar::new(&own.grid_graph, &repaired.0).is_err(), "it is not that of the map before");
    }
}
