//! One index for any number of planners, in any number of threads.

use std::{sync::Arc, thread};

use crate::common::{
    Bound, CountedAnswer, Setting, ask, chpa, clusters, grid_graph, hpa, k, number, random_queries, segments,
};
use mediant_grid::{Centers, CornerRule, GridGraph};
use mediant_hierarchy::{ChpaStar, ClusterGraph, Clustering, FallbackPolicy, HpaStar, SegmentGraph};
use mediant_oracle::{Rng, caves};
use mediant_search::{Ends, Hk, SquaredEuclidean};

#[derive(Clone)]
struct Shared {
    grid_graph: Arc<GridGraph<Centers>>,
    clusters: Arc<ClusterGraph>,
    segments: Arc<SegmentGraph>,
}

impl Shared {
    fn new(number: u32) -> Self {
        let grid_graph = grid_graph(&caves(&mut Rng::new(7), 60, 50), k(number), CornerRule::Never);
        let clusters = clusters(&grid_graph, Clustering { side: 7, levels: 2 });
        let segments = segments(&grid_graph, 3);
        Self { grid_graph: Arc::new(grid_graph), clusters: Arc::new(clusters), segments: Arc::new(segments) }
    }

    fn solve_all(&self, queries: &[Ends]) -> Vec<[CountedAnswer; 3]> {
        let (grid_graph, segments) = (|| Arc::clone(&self.grid_graph), || Arc::clone(&self.segments));
        let step = number(2);
        let complete =
            Setting { phases: [Some(Bound::GridGraph), None], step, fallback: FallbackPolicy::default() };
        let mut planners = [
            hpa(grid_graph(), Arc::clone(&self.clusters), true),
            chpa(grid_graph(), segments(), complete),
            chpa(grid_graph(), segments(), complete.of_the_paper()),
        ];
        queries.iter().map(|&query| planners.each_mut().map(|planner| ask(planner, query))).collect()
    }
}

#[test]
fn planners_in_many_threads_answer_as_one() {
    for number in [2, 3] {
        let shared = Shared::new(number);
        let queries = random_queries(&mut Rng::new(3), shared.grid_graph.grid(), 200);
        let expected = shared.solve_all(&queries);
        let found = expected
            .iter()
            .flatten()
            .filter(|(answer, _)| matches!(answer, Ok(found) if found.path().is_some()));
        let found = found.count();
        assert!(found > 200, "only {found} paths");
        // Each thread begins at another query, so that their scratch memory differs.
        let from = |first: usize| {
            let mut turned = queries.clone();
            turned.rotate_left(first);
            let mut found = shared.solve_all(&turned);
            found.rotate_right(first);
            found
        };
        thread::scope(|scope| {
            let from = &from;
            let threads: Vec<_> = (0..4).map(|part| scope.spawn(move || from(part * 31))).collect();
            for thread in threads {
                assert_eq!(thread.join().expect("a thread failed"), expected, "k = {number}");
            }
        });
    }
}

#[test]
fn indexes_are_shared_and_planners_sent() {
    const fn assert_send_sync<T: Send + Sync>() {}
    const fn assert_send<T: Send>() {}
    assert_send_sync::<ClusterGraph>();
    assert_send_sync::<SegmentGraph>();
    assert_send::<HpaStar<Arc<GridGraph<Centers>>, Arc<ClusterGraph>>>();
    assert_send::<ChpaStar<Arc<GridGraph<Centers>>, Arc<SegmentGraph>, Hk, SquaredEuclidean>>();
}
