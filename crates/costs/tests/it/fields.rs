//! Fields, against Dijkstra's algorithm on the explicit graph with exact integrals.

use std::{num::NonZeroUsize, sync::Arc};

use mediant_costs::{CostField, CostFieldQuery, CostGraph, CostSurface};
use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::{
    Rng, WeightedGraph, random_free_vertex, random_weighted, seeds, suite_grid, weighted_path_cost,
};
use mediant_search::{FieldQuery, Fields, Path};

use crate::common::{for_random_maps, graph, rounded, surface, vertices};

fn field(graph: &Arc<CostGraph>, query: CostFieldQuery<'_>) -> CostField {
    CostField::new(Arc::clone(graph), query, &Interrupt::NEVER).expect("the sources are free")
}

#[test]
fn costs_allocation_and_paths_are_those_of_the_oracle() {
    let mut reached = 0;
    for_random_maps(150, |map, surface, rules, k, about| {
        let graph = graph(surface, rules, k);
        let oracle = WeightedGraph::new(map, rules, FiniteK::new(k).ok());
        let mut rng = Rng::new(u64::from(k));
        let sources: Vec<Vertex> = (0..1 + rng.below(4))
            .filter_map(|_| random_free_vertex(&mut rng, map.grid(), rules.placement()))
            .collect();
        let expected = oracle.nearest(&sources, rounded(&graph));
        let field = field(&graph, CostFieldQuery::new(&sources).with_allocation());
        for (at, expected) in vertices(&graph).zip(expected) {
            let cost = field.cost(at).map(Cost::to_bits);
            let found = cost.map(|cost| (cost, field.allocation(at).map(|source| source as usize)));
            assert_eq!(
                found,
                expected.map(|(cost, source)| (cost, Some(source))),
                "{at} from {sources:?}: {about}"
            );
            let Some((cost, _)) = expected else { continue };
            reached += 1;
            let path = field.path_from(at).expect("it is in the field");
            assert_eq!(graph.path_cost(&path), Some(Cost::from_bits(cost)), "{path}: {about}");
            assert!(path.waypoints().last().is_some_and(|end| sources.contains(end)), "{path}: {about}");
            let replayed =
                weighted_path_cost(map, rules, FiniteK::new(k).ok(), path.waypoints(), rounded(&graph));
            assert!(matches!(replayed, Ok(found) if found == cost), "{path}: {replayed:?}: {about}");
            let along: f64 = graph
                .crossings(&path)
                .iter()
                .map(|&((x, y), length)| length * surface.cost(x, y).unwrap_or(f64::NAN))
                .sum();
            let told = field.get(at).unwrap_or(f64::NAN);
            assert!(
                (along - told).abs() <= 1e-4 * told,
                "{path} costs {along} along its cells, {told} in the field: {about}"
            );
        }
        assert_eq!(rows_of(&field), field.clone().into_rows(), "{about}");
    });
    assert!(reached > 20_000, "only {reached}");
}

fn rows_of(field: &CostField) -> Vec<f64> {
    vertices(field.graph()).map(|at| field.get(at).unwrap_or(f64::INFINITY)).collect()
}

#[test]
fn a_limit_holds_exactly_what_is_as_near() {
    for_random_maps(40, |map, surface, rules, k, about| {
        let graph = graph(surface, rules, k);
        let Some(source) = random_free_vertex(&mut Rng::new(5), map.grid(), rules.placement()) else {
            return;
        };
        let sources = [source];
        let whole = field(&graph, CostFieldQuery::new(&sources));
        let costs: Vec<f64> = vertices(&graph).filter_map(|at| whole.get(at)).collect();
        for limit in [0.0, costs[costs.len() / 2], costs[costs.len() / 3] * 0.9] {
            let within = field(&graph, CostFieldQuery::new(&sources).within(limit));
            for at in vertices(&graph) {
                let expected = whole.get(at).filter(|&cost| cost <= limit * (1.0 + 1e-9));
                assert_eq!(within.get(at), expected, "{at} within {limit} of {source}: {about}");
            }
        }
    });
}

#[test]
fn several_threads_find_the_same_field() {
    for_random_maps(12, |map, surface, rules, k, about| {
        let graph = graph(surface, rules, k);
        let Some(source) = random_free_vertex(&mut Rng::new(7), map.grid(), rules.placement()) else {
            return;
        };
        let query = CostFieldQuery::new(std::slice::from_ref(&source));
        let alone = field(&graph, query);
        for threads in [2, 3] {
            let threads = NonZeroUsize::new(threads).expect("not 0");
            let together = CostField::on_threads(Arc::clone(&graph), query, threads, &Interrupt::NEVER);
            let together = together.expect("the source is free");
            assert!(
                vertices(&graph).all(|at| together.cost(at) == alone.cost(at)),
                "{threads} threads: {about}"
            );
        }
    });
}

#[test]
fn costs_of_1_are_the_distances_of_the_engines_without_costs() {
    for seed in seeds(30) {
        let (grid, about) = suite_grid(seed);
        let grid = Arc::new(grid);
        let surface = Arc::new(CostSurface::uniform(&grid, &Interrupt::NEVER).expect("costs of 1"));
        for (rule, k) in [(CornerRule::Never, 3), (CornerRule::One, 4), (CornerRule::Always, 6)] {
            let k = FiniteK::new(k).expect("a small k");
            let uniform = mediant_grid::GridGraph::<mediant_grid::Centers>::new(Arc::clone(&grid), k, rule);
            let uniform = uniform.expect("a small k");
            let graph = graph(&surface, Rules::Center(rule), k.get());
            let placement = graph.rules().placement();
            let Some(source) = random_free_vertex(&mut Rng::new(seed), &grid, placement) else { continue };
            let expected = Fields::new(&uniform).field(FieldQuery::new(&[source])).expect("it is free");
            let found = field(&graph, CostFieldQuery::new(&[source]));
            for at in vertices(&graph) {
                assert_eq!(found.cost(at), expected.get(at), "seed {seed}: {at} from {source}: {about}");
                assert_eq!(
                    found.direction(at),
                    expected.direction(at),
                    "seed {seed}: {at} from {source}: {about}"
                );
            }
        }
    }
}

#[test]
fn a_corridor_is_as_cheap_as_the_path_along_its_bottom() {
    let (map, about) = random_weighted(12);
    let graph = graph(&surface(&map, &about), Rules::Center(CornerRule::Always), 3);
    let free: Vec<Vertex> = vertices(&graph).filter(|&at| graph.is_free(at)).collect();
    let (from, to) = ([free[0]], [free[free.len() - 1]]);
    let [a, b] = [&from, &to].map(|sources| field(&graph, CostFieldQuery::new(sources)));
    let corridor = a.corridor(&b).expect("the same graph");
    let least = corridor.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(Some(least), a.get(to[0]).or(Some(f64::INFINITY)));
    let path = a.path_from(to[0]).unwrap_or_else(|| Path::new(Vec::new()));
    for at in path.vertices() {
        let place = at.y as usize * graph.size().0 as usize + at.x as usize;
        assert_eq!(corridor[place], least, "{at}");
    }
}
