//! Planners that follow to another map know nothing of the one before, and answer as new ones.

use std::sync::Arc;

use mediant_grid::{Centers, CornerRule, GridGraph, Vertex};
use mediant_hierarchy::{ChpaStar, ClusterGraph, HpaStar, SegmentGraph};
use mediant_moves::Cost;
use mediant_oracle::{Rng, seeds};
use mediant_search::{Counters, Hk, Observer, Planner, SearchStatus};

use super::common::{any_clustering, clusters, describe_query, grid_graph, k, map, random_queries, segments};

/// Pauses a search after some expansions.
struct Pause(u32);

impl Observer for Pause {
    fn pauses(&mut self, _: Cost) -> bool {
        self.0 = self.0.saturating_sub(1);
        self.0 == 0
    }
}

/// A grid graph with both indexes.
struct Prepared(Arc<GridGraph<Centers>>, Arc<ClusterGraph>, Arc<SegmentGraph>);

/// The vertices of all maps, and some beyond.
fn vertices() -> impl Iterator<Item = Vertex> {
    (0..60).flat_map(|y| (0..60).map(move |x| Vertex::new(x, y)))
}

/// Follows to each map in turn, from a search that is paused. Returns the number of searches compared.
fn check<S: Planner>(
    maps: &[Prepared],
    rng: &mut Rng,
    new: impl Fn(&Prepared) -> S,
    follow: impl Fn(&mut S, &Prepared),
    seed: u64,
) -> usize {
    let (mut planner, mut searched) = (new(&maps[0]), 0);
    for (map, next) in maps.iter().zip(&maps[1..]) {
        for query in random_queries(rng, map.0.grid(), 2) {
            _ = planner.solve(query);
            if planner.begin(query, &mut ()).is_ok() {
                _ = planner.proceed(&mut Pause(2 + rng.below(9)));
                // Paths of an unfinished search take scratch memory of their own.
                vertices().for_each(|at| _ = planner.path_to(at));
                // Outside the map nothing is reached.
                assert_eq!(planner.path_to(Vertex::new(-1, -9)), None, "seed {seed}");
                assert_eq!(planner.path_to(Vertex::new(1 << 20, 3)), None, "seed {seed}");
            }
        }
        follow(&mut planner, next);
        let mut fresh = new(next);
        assert_eq!(planner.identity(), fresh.identity());
        for at in vertices() {
            assert!(planner.path_to(at).is_none(), "{at}, seed {seed}");
        }
        assert_eq!(planner.proceed(&mut ()), Ok(SearchStatus::Unreachable), "seed {seed}");
        for query in random_queries(rng, next.0.grid(), 4) {
            let mut counters = [Counters::default(); 2];
            let answer = planner.solve_observed(query, &mut counters[0]);
            let expected = fresh.solve_observed(query, &mut counters[1]);
            let said = || describe_query(&next.0, query, seed);
            assert_eq!((answer, counters[0]), (expected, counters[1]), "{}", said());
            searched += usize::from(counters[0].expanded > 0);
            assert_eq!(planner.begin(query, &mut ()), fresh.begin(query, &mut ()), "{}", said());
            let paused = [&mut planner, &mut fresh].map(|planner| planner.proceed(&mut Pause(4)));
            assert_eq!(paused[0], paused[1], "{}", said());
            vertices().for_each(|at| assert_eq!(planner.path_to(at), fresh.path_to(at), "{at}, {}", said()));
        }
    }
    searched
}

#[test]
fn a_planner_that_followed_knows_nothing_of_the_map_before() {
    let mut searched = 0;
    for seed in seeds(60) {
        let rng = &mut Rng::new(seed ^ 0xF0);
        // Two maps of one size in turn, then others; of other moves and clusterings, too.
        let maps = [seed, seed + 1, seed, seed + 2, seed + 3].map(|seed| {
            let graph = Arc::new(grid_graph(&map(seed), k(2 + rng.below(2)), CornerRule::Never));
            let (clusters, segments) =
                (clusters(&graph, any_clustering(rng)), segments(&graph, 1 + rng.below(6)));
            Prepared(graph, Arc::new(clusters), Arc::new(segments))
        });
        for straightens in [true, false] {
            let new = |map: &Prepared| hpa(map).with_straightening(straightens);
            let follow = |planner: &mut HpaStar<_, _>, Prepared(graph, index, _): &Prepared| {
                planner.follow(Arc::clone(graph), Arc::clone(index)).expect("it fits");
            };
            searched += check(&maps, rng, new, follow, seed);
        }
        let new = |Prepared(graph, _, index): &Prepared| {
            ChpaStar::new(Arc::clone(graph), Arc::clone(index), Hk, Hk).expect("it fits")
        };
        let follow = |planner: &mut ChpaStar<_, _, Hk, Hk>, Prepared(graph, _, index): &Prepared| {
            planner.follow(Arc::clone(graph), Arc::clone(index)).expect("it fits");
        };
        searched += check(&maps, rng, new, follow, seed);
        let [Prepared(graph, ..), Prepared(_, clusters, segments), ..] = &maps;
        if graph.identity() != clusters.identity() {
            let (mut clustered, mut segmented) = (hpa(&maps[0]), new(&maps[0]));
            assert!(clustered.follow(Arc::clone(graph), Arc::clone(clusters)).is_err());
            assert!(segmented.follow(Arc::clone(graph), Arc::clone(segments)).is_err());
        }
    }
    assert!(searched > 10 * seeds(60).end as usize, "only {searched} searches");
}

fn hpa(Prepared(graph, index, _): &Prepared) -> HpaStar<Arc<GridGraph<Centers>>, Arc<ClusterGraph>> {
    HpaStar::new(Arc::clone(graph), Arc::clone(index)).expect("it fits")
}
