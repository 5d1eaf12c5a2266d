//! Dijkstra's algorithm on the explicit graph of all legal moves of a weighted map.

use std::collections::{BTreeMap, BTreeSet};

use mediant_grid::{Rules, Vertex};
use mediant_moves::{FiniteK, Vector};

use super::{Integral, Shares, WeightedMap};
use crate::graph::Graph;

/// The graph of all legal moves of a neighborhood on a weighted map, with the integral along each.
///
/// As in [`Explicit`](crate::Explicit), a closed gap has two states, one for each free quadrant, and nothing
/// is assumed about optimal paths. Answers for all vertices are listed row by row; under corner placement a
/// row has one vertex more than the map has columns.
///
/// Meant for maps up to about 40 × 40.
#[derive(Clone, Debug)]
pub struct WeightedGraph {
    graph: Graph<Integral>,
    cell_size: (f64, f64),
}

impl WeightedGraph {
    /// The graph for N(k) or, for k = `None`, of all moves with gcd 1.
    #[must_use]
    pub fn new(map: &WeightedMap, rules: Rules, k: Option<FiniteK>) -> Self {
        let mut shares: BTreeMap<Vector, Shares> = BTreeMap::new();
        let graph = Graph::new(map.grid(), rules, k, |from, d| {
            let shares = shares.entry(d).or_insert_with(|| Shares::new(rules.placement(), d));
            shares.integral(map, from).expect("a legal move has a free cell everywhere")
        });
        Self { graph, cell_size: map.cell_size() }
    }

    /// For each vertex the cost of an optimal path from the nearest of the sources, and the index of this
    /// source: the least of those that are equally near. `None` if no source reaches the vertex. Sources that
    /// are blocked or outside the map reach none.
    ///
    /// `move_cost` makes the cost of a move in integers from its integral.
    ///
    /// # Panics
    /// If a cost exceeds 64 bits.
    #[must_use]
    pub fn nearest(
        &self,
        sources: &[Vertex],
        move_cost: impl Fn(&Integral) -> u64,
    ) -> Vec<Option<(u64, usize)>> {
        self.search(sources, |cost, integral| {
            cost.checked_add(move_cost(integral)).expect("costs fit in 64 bits")
        })
    }

    /// For each vertex the cost of an optimal path from the nearest of the sources, as in
    /// [`nearest`](Self::nearest).
    #[must_use]
    pub fn costs(&self, sources: &[Vertex], move_cost: impl Fn(&Integral) -> u64) -> Vec<Option<u64>> {
        self.nearest(sources, move_cost).into_iter().map(|found| found.map(|(cost, _)| cost)).collect()
    }

    /// For each vertex the cost of an optimal path from the nearest of the sources, where a move costs its
    /// integral times its length on the map's cells, in floating point.
    #[must_use]
    pub fn lengths(&self, sources: &[Vertex]) -> Vec<Option<f64>> {
        // Floats that are not negative have the same order as their bits.
        let add =
            |bits, integral: &Integral| (f64::from_bits(bits) + integral.length(self.cell_size)).to_bits();
        let found = self.search(sources, add);
        found.into_iter().map(|found| found.map(|(bits, _)| f64::from_bits(bits))).collect()
    }

    /// The index of a vertex in the answers; `None` outside the map.
    #[must_use]
    pub fn index(&self, at: Vertex) -> Option<usize> {
        self.graph.vertex(at)
    }

    /// All free vertices, row by row.
    pub fn free_vertices(&self) -> impl Iterator<Item = Vertex> {
        self.graph.free_vertices()
    }

    /// The least pairs of cost and source, where `add` makes the cost after a move. Costs start at 0, which
    /// are also the bits of 0.0.
    fn search(&self, sources: &[Vertex], add: impl Fn(u64, &Integral) -> u64) -> Vec<Option<(u64, usize)>> {
        let graph = &self.graph;
        let mut best: Vec<Option<(u64, usize)>> = vec![None; graph.edges.len()];
        // A source is reached from itself, also where no path can leave or arrive.
        let mut found: Vec<Option<(u64, usize)>> = vec![None; graph.is_free.len()];
        let mut open = BTreeSet::new();
        for (index, &source) in sources.iter().enumerate() {
            let Some(v) = graph.vertex(source).filter(|&v| graph.is_free[v] && found[v].is_none()) else {
                continue;
            };
            found[v] = Some((0, index));
            if let Some(state) = graph.ends[v] {
                best[state as usize] = Some((0, index));
                open.insert((0, index, state));
            }
        }
        while let Some((cost, source, from)) = open.pop_first() {
            for edge in &graph.edges[from as usize] {
                let (next, to) = ((add(cost, &edge.label), source), edge.to as usize);
                if best[to].is_none_or(|old| next < old) {
                    if let Some((cost, source)) = best[to].replace(next) {
                        open.remove(&(cost, source, edge.to));
                    }
                    open.insert((next.0, next.1, edge.to));
                }
            }
        }
        for (found, end) in found.iter_mut().zip(&graph.ends) {
            *found = found.or_else(|| end.and_then(|end| best[end as usize]));
        }
        found
    }
}

/// [`WeightedGraph::costs`] on a graph that is used once.
#[must_use]
pub fn weighted_costs(
    map: &WeightedMap,
    rules: Rules,
    k: Option<FiniteK>,
    sources: &[Vertex],
    move_cost: impl Fn(&Integral) -> u64,
) -> Vec<Option<u64>> {
    WeightedGraph::new(map, rules, k).costs(sources, move_cost)
}

/// [`WeightedGraph::lengths`] on a graph that is used once.
#[must_use]
pub fn weighted_lengths(
    map: &WeightedMap,
    rules: Rules,
    k: Option<FiniteK>,
    sources: &[Vertex],
) -> Vec<Option<f64>> {
    WeightedGraph::new(map, rules, k).lengths(sources)
}
