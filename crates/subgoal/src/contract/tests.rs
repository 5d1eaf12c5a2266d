//! Contraction keeps the distances of graphs in which most shortest paths have equals.

use mediant_grid::{Vector, Vertex, uninterrupted};
use mediant_oracle::{Rng, on_all_cores, seeds};

use super::{ContractedGraph, Contraction, SubgoalGeometry};
use crate::bends::BendRule;

/// Points joined by edges that cost what a king needs, so many paths cost the same.
struct Points(Vec<Vertex>);

impl SubgoalGeometry for Points {
    fn vertex(&self, id: u32) -> Vertex {
        self.0[id as usize]
    }

    fn bends(&self, _: u32) -> Option<BendRule> {
        None
    }

    fn distance(&self, from: u32, to: u32) -> u128 {
        let Vector { x, y } = self.vertex(from).to(self.vertex(to));
        x.abs().max(y.abs()).unsigned_abs().into()
    }
}

/// Points of a square, near ones joined, and the edges.
fn random_points(seed: u64) -> (Points, Vec<(u32, u32)>) {
    let mut rng = Rng::new(seed);
    let side = 4 + rng.below(9) as i32;
    let mut points: Vec<Vertex> =
        (0..side * side).map(|number| Vertex::new(number % side, number / side)).collect();
    points.retain(|_| rng.below(10) < 6);
    let points = Points(points);
    let count = points.0.len() as u32;
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
    let edges = pairs.filter(|&(a, b)| points.distance(a, b) <= 2 && rng.below(10) < 4).collect();
    (points, edges)
}

const FAR: u128 = 1 << 64;

/// The distances between all pairs, by Floyd and Warshall.
fn distances(points: &Points, edges: &[(u32, u32)]) -> Vec<Vec<u128>> {
    let count = points.0.len();
    let mut all = vec![vec![FAR; count]; count];
    for (at, row) in all.iter_mut().enumerate() {
        row[at] = 0;
    }
    for &(a, b) in edges {
        let cost = points.distance(a, b);
        (all[a as usize][b as usize], all[b as usize][a as usize]) = (cost, cost);
    }
    for over in 0..count {
        let from_there = all[over].clone();
        for row in &mut all {
            let first = row[over];
            for (known, rest) in row.iter_mut().zip(&from_there) {
                *known = (*known).min(first + rest);
            }
        }
    }
    all
}

/// The costs of the paths up the hierarchy, and within the core.
fn upward(graph: &ContractedGraph, from: usize) -> Vec<u128> {
    let mut costs = vec![FAR; graph.arcs.len()];
    costs[from] = 0;
    let mut changed = vec![from];
    while let Some(at) = changed.pop() {
        for arc in &graph.arcs[at] {
            let cost = costs[at] + arc.cost;
            if cost < costs[arc.to as usize] {
                costs[arc.to as usize] = cost;
                changed.push(arc.to as usize);
            }
        }
    }
    costs
}

fn check_order(graph: &ContractedGraph, seed: u64) {
    let mut rank = vec![u32::MAX; graph.arcs.len()];
    for (&id, number) in graph.order.iter().zip(0..) {
        assert_eq!(rank[id as usize], u32::MAX, "{id} is contracted twice, seed {seed}");
        rank[id as usize] = number;
    }
    for (id, around) in graph.arcs.iter().enumerate() {
        assert_eq!(graph.contracted[id], rank[id] != u32::MAX, "{id}, seed {seed}");
        let is_up = |to: u32| rank[id] < rank[to as usize] || !graph.contracted[id];
        assert!(around.iter().all(|arc| is_up(arc.to)), "from {id}: {around:?}, seed {seed}");
    }
}

#[test]
fn distances_stay_however_early_the_budget_ends() {
    let check = |seed: u64| {
        let mut cores = [0; 2];
        for budget in [0, 1 << 11, 1 << 12, 1 << 13, u64::MAX] {
            let (points, edges) = random_points(seed);
            let expected = distances(&points, &edges);
            let count = points.0.len();
            let mut contraction =
                uninterrupted(|never| Contraction::new(count, &edges, points, never.clone()));
            let mut last = 0;
            let contracted = contraction.contract_within([u64::MAX, budget], &mut |done| {
                assert!(last <= done, "{last}, {done}");
                last = done;
            });
            assert!(contracted.is_ok());
            let graph = contraction.finish();
            check_order(&graph, seed);
            assert_eq!(last, graph.order.len(), "seed {seed}");
            let up: Vec<_> = (0..graph.arcs.len()).map(|from| upward(&graph, from)).collect();
            for (from, row) in expected.iter().enumerate() {
                for (to, &expected) in row.iter().enumerate() {
                    let costs = up[from].iter().zip(&up[to]).map(|(a, b)| a + b);
                    let found = costs.min().unwrap_or(FAR).min(FAR);
                    assert_eq!(found, expected, "from {from} to {to}, budget {budget}, seed {seed}");
                }
            }
            let core = graph.arcs.len() - graph.order.len();
            assert!(budget < u64::MAX || core == 0, "{core} are left, seed {seed}");
            cores[usize::from(core > 0 && core < graph.arcs.len())] += 1;
        }
        cores[1]
    };
    let parts = on_all_cores(seeds(150), check);
    let parts: usize = parts.iter().sum();
    assert!(parts > 50, "{parts}: too few are contracted in part");
}
