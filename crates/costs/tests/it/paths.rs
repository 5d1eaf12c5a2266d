//! A*, against Dijkstra's algorithm on the explicit graph with exact integrals.

use std::sync::Arc;

use mediant_costs::CostAStar;
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::{Rng, WeightedGraph, random_free_vertex, weighted_path_cost};
use mediant_search::{Counters, Ends, Planner};

use crate::common::{for_random_maps, graph, rounded, vertices};

#[test]
fn paths_are_the_cheapest() {
    let mut found = 0;
    for_random_maps(150, |map, surface, rules, k, about| {
        let graph = graph(surface, rules, k);
        let oracle = WeightedGraph::new(map, rules, FiniteK::new(k).ok());
        let mut rng = Rng::new(u64::from(k));
        let Some(start) = random_free_vertex(&mut rng, map.grid(), rules.placement()) else { return };
        let expected = oracle.costs(&[start], rounded(&graph));
        let mut planners = [CostAStar::new(Arc::clone(&graph)), CostAStar::dijkstra(Arc::clone(&graph))];
        let (mut guided, mut blind) = (Counters::default(), Counters::default());
        for (goal, expected) in vertices(&graph).zip(expected).filter(|_| rng.chance(12)) {
            if !graph.is_free(goal) {
                assert!(planners[0].solve(Ends::new(start, goal)).is_err());
                continue;
            }
            for (planner, counters) in planners.iter_mut().zip([&mut guided, &mut blind]) {
                let answer =
                    planner.solve_observed(Ends::new(start, goal), counters).expect("the ends are free");
                let path = answer.path();
                let cost = path.map(|path| graph.path_cost(path).map(Cost::to_bits));
                assert_eq!(cost, expected.map(Some), "{start} → {goal}: {about}");
                let Some(path) = path else { continue };
                found += 1;
                assert_eq!([path.waypoints()[0], path.waypoints()[path.len() - 1]], [start, goal], "{about}");
                let k = FiniteK::new(k).ok();
                let replayed = weighted_path_cost(map, rules, k, path.waypoints(), rounded(&graph));
                assert_eq!(replayed.ok(), expected, "{path}: {about}");
            }
        }
        assert!(guided.expanded <= blind.expanded, "{about}");
    });
    assert!(found > 4_000, "only {found}");
}
