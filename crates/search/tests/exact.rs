//! Every engine against Dijkstra on the explicit graph, on seeded random maps.

mod common;

use std::sync::Arc;

use common::with_engines;
use mediant_grid::{CornerRule, Grid, Rules, Vertex};
use mediant_moves::K;
use mediant_oracle::{Explicit, Rng, describe, random_free_vertex, suite_grid, validate};
use mediant_search::{Counters, Guarantee, Outcome, Query};

fn seeds() -> std::ops::Range<u64> {
    mediant_oracle::seeds(120)
}

/// Six queries of a map: one long chain of goals from each of two starts.
fn queries(grid: &Grid, rules: Rules, seed: u64) -> Vec<(Vertex, Vec<Vertex>)> {
    let mut rng = Rng::new(seed ^ 0x5EED);
    let mut free = || random_free_vertex(&mut rng, grid, rules.placement());
    (0..2).filter_map(|_| Some((free()?, (0..3).filter_map(|_| free()).collect()))).collect()
}

#[test]
fn engines_cost_what_dijkstra_on_the_explicit_graph_costs() {
    let (mut found, mut unreachable) = (0, 0);
    for seed in seeds() {
        let grid = Arc::new(suite_grid(seed).0);
        for rules in Rules::ALL {
            for k in 2..=8 {
                let graph = Explicit::new(&grid, rules, K::new(k).ok());
                with_engines(&grid, rules, k, |mut engines| {
                    for (start, goals) in queries(&grid, rules, seed) {
                        let costs = graph.costs_from(start);
                        for goal in goals {
                            let expected = costs.to(goal);
                            let case = || format!("k = {k}; {}", describe(&grid, rules, start, goal, seed));
                            for engine in &mut engines {
                                let (outcome, counters) =
                                    engine.solve(Query::new(start, goal)).expect("both ends are free");
                                check(&outcome, expected, engine.guarantee, &|| {
                                    format!("{}; {}", engine.name, case())
                                });
                                let Outcome::Found(path) = outcome else {
                                    // The components know without a search.
                                    assert_eq!(counters, Counters::default(), "{}; {}", engine.name, case());
                                    continue;
                                };
                                let k = K::new(k).ok();
                                let fault =
                                    validate(&grid, rules, k, start, goal, path.waypoints(), path.cost());
                                assert_eq!(fault, Ok(()), "{}; {}", engine.name, case());
                            }
                            found += usize::from(expected.is_some());
                            unreachable += usize::from(expected.is_none());
                        }
                    }
                });
            }
        }
    }
    // A generator that went wrong must not make the suite empty.
    let maps = seeds().end as usize;
    assert!(found > 100 * maps && unreachable > 10 * maps, "{found} found, {unreachable} unreachable");
}

/// Every map of 3 × 3 cells, from every vertex to every other: the smallest maps hold the oddest cases.
#[test]
fn engines_are_exact_on_every_map_of_nine_cells() {
    let mut queries = 0;
    for cells in 0..1_u32 << 9 {
        let grid = Arc::new(Grid::from_fn(3, 3, |x, y| cells >> (3 * y + x) & 1 == 1).expect("a valid size"));
        for rules in Rules::ALL {
            for k in 2..=4 {
                let graph = Explicit::new(&grid, rules, K::new(k).ok());
                with_engines(&grid, rules, k, |mut engines| {
                    for start in graph.free_vertices() {
                        let costs = graph.costs_from(start);
                        for goal in graph.free_vertices() {
                            // The first engine on all pairs, the others in turn.
                            let turn = 1 + queries % (engines.len() - 1);
                            for i in [0, turn] {
                                let engine = &mut engines[i];
                                let (outcome, _) =
                                    engine.solve(Query::new(start, goal)).expect("both ends are free");
                                check(&outcome, costs.to(goal), engine.guarantee, &|| {
                                    format!(
                                        "{}; k = {k}; {}",
                                        engine.name,
                                        describe(&grid, rules, start, goal, 0)
                                    )
                                });
                            }
                            queries += 1;
                        }
                    }
                });
            }
        }
    }
    assert_eq!(queries, 549_600);
}

/// What a path over N(k) may cost at most, as a multiple of the any-angle optimum under the same rules: Kramm 2018, Theorem 2
/// at corners, Theorem 3 at centers. Theorem 3 lets moves touch corners: it fails under `Never`, where (2, 1) can be legal and
/// (1, 1) not, and at k = 2 under `Always`, since no axis moves lead between two blocked cells.
fn bound(rules: Rules, k: u32) -> f64 {
    let number = K::new(k).expect("k is at least 2");
    match rules {
        Rules::Corner(_) => mediant_moves::bound_at_corners(number),
        Rules::Center(CornerRule::Never) => mediant_moves::BOUND_WITHOUT_CORNER_CUTTING,
        Rules::Center(CornerRule::Always) if k == 2 => f64::INFINITY,
        Rules::Center(_) => mediant_moves::bound_at_centers(number),
    }
}

/// Any-angle ≤ k + 1 ≤ k ≤ bound · any-angle, among obstacles. (At centers the papers' any-angle paths may also bend at cell
/// corners; the reference here bends at centers only.)
#[test]
fn costs_fall_with_k_and_stay_within_the_bound() {
    let mut tight = [0, 0];
    for seed in 0..seeds().end.min(300) {
        let grid = Arc::new(suite_grid(seed).0);
        for rules in Rules::ALL {
            let any_angle = Explicit::new(&grid, rules, None);
            for (start, goals) in queries(&grid, rules, seed) {
                let costs = any_angle.costs_from(start);
                for goal in goals {
                    let Some(best) = costs.to(goal) else { continue };
                    let mut last = f64::INFINITY;
                    for k in 2..=8 {
                        let cost = with_engines(&grid, rules, k, |mut engines| {
                            let (outcome, _) =
                                engines[0].solve(Query::new(start, goal)).expect("both ends are free");
                            outcome.path().map_or(f64::INFINITY, |path| path.cost())
                        });
                        // Not as a product where there is no bound: the optimum may be 0.
                        let limit =
                            if bound(rules, k).is_finite() { best * bound(rules, k) } else { f64::INFINITY };
                        let slack = 1.0 + 1e-9;
                        assert!(
                            best <= cost * slack && cost <= last * slack && cost <= limit * slack,
                            "k = {k}: any-angle {best}, k - 1 {last}, k {cost}, bound {limit}; {}",
                            describe(&grid, rules, start, goal, seed)
                        );
                        tight[usize::from(cost > best * slack)] += 1;
                        last = cost;
                    }
                }
            }
        }
    }
    assert!(tight.iter().all(|&cases| cases > 1_000), "too few cases: {tight:?}");
}

fn check(outcome: &Outcome, expected: Option<f64>, guarantee: Guarantee, case: &dyn Fn() -> String) {
    let cost = outcome.path().map(|path| path.cost());
    assert!(!cost.is_some_and(f64::is_sign_negative), "cost {cost:?}: {}", case());
    let as_good = |cost: f64, best: f64| match guarantee {
        Guarantee::Suboptimal => cost >= best * (1.0 - 1e-9),
        _ => (cost - best).abs() <= best * 1e-9,
    };
    let agrees = match (cost, expected) {
        (Some(cost), Some(best)) => as_good(cost, best),
        (None, None) => true,
        _ => false,
    };
    assert!(agrees, "cost {cost:?}, Dijkstra {expected:?}: {}", case());
}
