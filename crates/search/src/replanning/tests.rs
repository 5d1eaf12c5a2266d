//! The values of all nodes, against what they are to be.

use std::sync::Arc;

use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Placement, VertexId,
};
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::{Rng, random_change, random_free_vertex, seeds, suite_grid};

use super::{
    costs::Lengths,
    nodes::Node,
    search::{MOST_MOVED, Replanner, for_each_edge},
};

type Search<P> = Replanner<Arc<GridGraph<P>>, Lengths>;

/// Checks that each rhs is what the neighbors' g say, that the move is the one by which it comes, and that
/// those and only those nodes are in the open list whose values differ. Returns how many are.
fn check_values<P: Placement>(search: &Search<P>, message: &str) -> usize {
    let (graph, nodes) = (&*search.graph, &search.state.nodes);
    let mut open = 0;
    for id in (0..nodes.len() as u32).map(VertexId) {
        let node = nodes.get(id);
        let (mut least, mut by) = (Cost::MAX, Cost::MAX);
        for_each_edge(graph, &Lengths, id, |edge| {
            if let Some(g) = nodes.get(edge.to).settled() {
                least = least.min(g + edge.cost);
                if graph.step(node.by).vector() == -graph.step(edge.index).vector() {
                    by = g + edge.cost;
                }
            }
        });
        if search.state.root == Some(id) {
            assert_eq!(node.rhs, Cost::ZERO, "{message}");
        } else {
            assert_eq!(
                (node.rhs, node.rhs),
                (least, by),
                "node {} of {}, {message}",
                id.0,
                graph.vertex_count()
            );
        }
        let entry = search.state.open.get(node.slot);
        assert_eq!(entry.map(|entry| entry.id()), (node.g != node.rhs).then_some(id), "{message}");
        open += usize::from(node.slot != Node::CLOSED);
    }
    assert_eq!(search.state.open.len(), open, "{message}");
    open
}

/// Of one map, how many nodes were in open lists.
fn check_changes<P: Placement>(seed: u64, rule: P::Rule, k: u32) -> usize {
    let (mut rng, k) = (Rng::new(seed), FiniteK::new(k).expect("k is at least 2"));
    let mut grid = Arc::new(suite_grid(seed).0);
    let mut space = FreeSpace::<P>::for_k(Arc::clone(&grid), rule, k.into());
    let mut search =
        Replanner::new(Arc::new(GridGraph::in_space(&space, k).expect("k is small")), Lengths, 16);
    let Some(root) = random_free_vertex(&mut rng, &grid, P::KIND).and_then(|at| space.id(at)) else {
        return 0;
    };
    let mut open = 0;
    for round in 0..20 {
        let message = format!("k = {k}, {}, seed {seed}, round {round}", space.rules());
        if let Some(target) = random_free_vertex(&mut rng, &grid, P::KIND).and_then(|at| space.id(at)) {
            search.search(root, target, &mut ());
            open += check_values(&search, &message);
        }
        let change = random_change(&mut rng, &grid);
        (space, grid) = (space.after(&change), Arc::clone(change.after()));
        search.change(Arc::new(GridGraph::in_space(&space, k).expect("k is small")), &change);
        if search.state.root.is_some() {
            open += check_values(&search, &message);
        }
    }
    open
}

#[test]
fn values_are_what_the_neighbors_say_after_every_change() {
    let seeds = seeds(150);
    let count = seeds.end as usize;
    let open: usize = seeds
        .map(|seed| {
            let k = 2 + (seed % 5) as u32;
            let centers = [CornerRule::Never, CornerRule::One, CornerRule::Always];
            let corners = [DiagonalGap::Open, DiagonalGap::Closed];
            let open = centers.map(|rule| check_changes::<Centers>(seed, rule, k)).iter().sum::<usize>();
            open + corners.map(|rule| check_changes::<Corners>(seed, rule, k)).iter().sum::<usize>()
        })
        .sum();
    assert!(open > 500 * count, "{open} nodes");
}

#[test]
fn a_target_may_move_for_ever() {
    let grid = Arc::new(Grid::from_fn(9, 1, |_, _| false).expect("a valid size"));
    let graph = GridGraph::<Centers>::new(grid, FiniteK::N4, CornerRule::Never).expect("a valid k");
    let mut search = Replanner::new(&graph, Lengths, 16);
    let cells = |cells: u32| Cost::of_move((1, 0).into()) * cells;
    assert_eq!(search.search(VertexId(0), VertexId(3), &mut ()), Some(cells(3)));
    // Below the limit keys do not overflow, and beyond it all is searched anew.
    search.state.moved = Cost::from_bits(MOST_MOVED.to_bits() - 1);
    for target in [8, 2, 5] {
        assert_eq!(search.search(VertexId(0), VertexId(target), &mut ()), Some(cells(target)));
        assert_eq!(search.state.moved >= MOST_MOVED, target == 8);
    }
}
