//! Dijkstra's algorithm on the explicit graph of all legal moves.

use std::{cmp::Reverse, collections::BinaryHeap};

use mediant_grid::{Grid, Rules, Vertex};
use mediant_moves::{FiniteK, Vector};

use crate::graph::Graph;

/// The graph of all legal moves of a neighborhood on a grid, with every free vertex and every move.
///
/// Under [`DiagonalGap::Closed`](mediant_grid::DiagonalGap::Closed) a gap has two states, one for each
/// free quadrant, so that a path can touch the gap but not pass through it. Nothing is assumed about optimal
/// paths.
///
/// Meant for maps up to about 40 × 40: a state has up to 2^k edges, and with any-angle moves one to every
/// vertex that it sees.
#[derive(Clone, Debug)]
pub struct Explicit(Graph<f64>);

impl Explicit {
    /// The graph for N(k). For k = `None`, the graph of all moves with gcd 1. Its shortest paths are the
    /// shortest any-angle paths, since a straight legal segment is a repeated move.
    #[must_use]
    pub fn new(grid: &Grid, rules: Rules, k: Option<FiniteK>) -> Self {
        Self(Graph::new(grid, rules, k, |_, d| length(d)))
    }

    /// The optimal costs from `start` to every vertex. If `start` is blocked or outside the map, no vertex is
    /// reached.
    #[must_use]
    pub fn costs_from(&self, start: Vertex) -> Costs<'_> {
        let graph = &self.0;
        let mut costs = Costs {
            graph,
            start,
            cost: vec![f64::INFINITY; graph.edges.len()],
            previous: vec![None; graph.edges.len()],
        };
        let first = graph.vertex(start).and_then(|v| graph.ends[v]);
        // Floats that are not negative have the same order as their bits.
        let mut open = BinaryHeap::new();
        if let Some(first) = first {
            costs.cost[first as usize] = 0.0;
            open.push(Reverse((0.0_f64.to_bits(), first)));
        }
        while let Some(Reverse((bits, from))) = open.pop() {
            let cost = f64::from_bits(bits);
            if cost > costs.cost[from as usize] {
                continue;
            }
            for edge in &graph.edges[from as usize] {
                let (to, next) = (edge.to as usize, cost + edge.label);
                if next < costs.cost[to] {
                    costs.cost[to] = next;
                    costs.previous[to] = Some(from);
                    open.push(Reverse((next.to_bits(), edge.to)));
                }
            }
        }
        costs
    }

    /// All free vertices, row by row.
    pub fn free_vertices(&self) -> impl Iterator<Item = Vertex> {
        self.0.free_vertices()
    }
}

/// The optimal costs from one start.
#[derive(Clone, Debug)]
pub struct Costs<'a> {
    graph: &'a Graph<f64>,
    start: Vertex,
    cost: Vec<f64>,
    previous: Vec<Option<u32>>,
}

impl Costs<'_> {
    /// The cost of an optimal path to `goal`, 0 for the start itself; `None` if there is no path, or if start
    /// or goal is blocked or outside the map.
    #[must_use]
    pub fn to(&self, goal: Vertex) -> Option<f64> {
        let v = self.graph.vertex(goal).filter(|&v| self.graph.is_free[v])?;
        if goal == self.start {
            return Some(0.0);
        }
        self.graph.ends[v].map(|end| self.cost[end as usize]).filter(|cost| cost.is_finite())
    }

    /// An optimal path to `goal`, with one waypoint a move; `None` as for [`to`](Self::to).
    #[must_use]
    pub fn path_to(&self, goal: Vertex) -> Option<Vec<Vertex>> {
        self.to(goal)?;
        let mut path = vec![goal];
        if goal != self.start {
            let mut state = self.graph.ends[self.graph.vertex(goal)?];
            while let Some(previous) = state.and_then(|state| self.previous[state as usize]) {
                path.push(self.graph.vertex_at(previous as usize / 2));
                state = Some(previous);
            }
        }
        path.reverse();
        Some(path)
    }
}

fn length(d: Vector) -> f64 {
    f64::from(d.x).hypot(f64::from(d.y))
}
