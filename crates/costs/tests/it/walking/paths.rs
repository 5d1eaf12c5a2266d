//! A*, against fields.

use std::sync::Arc;

use mediant_costs::{CostFieldQuery, Heading, WalkingAStar, WalkingField};
use mediant_grid::Interrupt;
use mediant_oracle::Rng;
use mediant_search::{Counters, Ends, Planner};

use super::ground::{for_random_grounds, vertices};

#[test]
fn paths_are_the_cheapest() {
    let mut found = 0;
    for_random_grounds(120, |ground, graph, about| {
        let mut rng = Rng::new(11);
        let Some(start) = ground.source(&mut rng) else { return };
        let sources = [start];
        let query = CostFieldQuery::new(&sources);
        let field = WalkingField::new(Arc::clone(graph), Heading::FromSources, query, &Interrupt::NEVER);
        let field = field.expect("the source is free");
        let mut planners = [WalkingAStar::new(Arc::clone(graph)), WalkingAStar::dijkstra(Arc::clone(graph))];
        let (mut guided, mut blind) = (Counters::default(), Counters::default());
        for goal in vertices(graph) {
            if let Some(cost) = field.cost(goal) {
                assert!(graph.least_cost(start.to(goal)) <= cost, "{start} → {goal}: {about}");
            }
            if !rng.chance(12) {
                continue;
            }
            if !graph.is_free(goal) {
                assert!(planners[0].solve(Ends::new(start, goal)).is_err());
                continue;
            }
            for (planner, counters) in planners.iter_mut().zip([&mut guided, &mut blind]) {
                let answer =
                    planner.solve_observed(Ends::new(start, goal), counters).expect("the ends are free");
                let cost = answer.path().map(|path| graph.path_cost(path));
                assert_eq!(cost, field.cost(goal).map(Some), "{start} → {goal}: {about}");
                let Some(path) = answer.path() else { continue };
                let time = graph.path_cost(path).map(|cost| graph.to_f64(cost));
                assert_eq!(Some(path.cost()), time, "{path}: its cost is its time");
                let asked =
                    planner.distance(Ends::new(path.waypoints()[0], path.waypoints()[path.len() - 1]));
                assert_eq!(asked.ok().flatten(), time, "{path}: the distance is the time");
                assert_eq!([path.waypoints()[0], path.waypoints()[path.len() - 1]], [start, goal], "{about}");
                found += 1;
            }
        }
        assert!(guided.expanded <= blind.expanded, "{about}");
    });
    assert!(found > 1_500, "only {found}");
}
