//! Dijkstra's algorithm on the explicit graph of all legal moves.

use std::{cmp::Reverse, collections::BinaryHeap};

use mediant_grid::{DiagonalGap, Grid, PlacementKind, Rules, Vertex};
use mediant_moves::{FiniteK, Vector};

use crate::{
    legality::{Footprint, free_quadrants, is_gap, is_in_quadrant, vertex_is_free},
    neighborhood,
};

/// The graph of all legal moves of a neighborhood on a grid, with every free vertex and every move.
///
/// Under [`DiagonalGap::Closed`] a gap has two states, one for each free quadrant, so that a path can touch
/// the gap but not pass through it. Nothing is assumed about optimal paths.
///
/// Meant for maps up to about 40 × 40: a state has up to 2^k edges, and with any-angle moves one to every
/// vertex that it sees.
#[derive(Clone, Debug)]
pub struct Explicit {
    /// The number of columns and of rows of vertices.
    size: (usize, usize),
    /// For each vertex, the state in which a path may start or end there, if there is one.
    ends: Vec<Option<u32>>,
    is_free: Vec<bool>,
    /// The edges of each state. State 2v + slot belongs to vertex v.
    edges: Vec<Vec<Edge>>,
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    to: u32,
    length: f64,
}

impl Explicit {
    /// The graph for N(k). For k = `None`, the graph of all moves with gcd 1. Its shortest paths are the
    /// shortest any-angle paths, since a straight legal segment is a repeated move.
    #[must_use]
    pub fn new(grid: &Grid, rules: Rules, k: Option<FiniteK>) -> Self {
        let placement = rules.placement();
        let extra = u32::from(placement == PlacementKind::Corner);
        let (columns, rows) = (grid.width() + extra, grid.height() + extra);
        let at = |v: usize| Vertex::new((v % columns as usize) as i32, (v / columns as usize) as i32);
        let vertices = columns as usize * rows as usize;
        let is_free: Vec<bool> = (0..vertices).map(|v| vertex_is_free(grid, placement, at(v))).collect();
        let slots: Vec<Slots> = (0..vertices).map(|v| Slots::new(grid, rules, at(v))).collect();
        let end = |v: usize| slots[v].of_end().filter(|_| is_free[v]).map(|slot| state(v, slot));
        let mut graph = Self {
            size: (columns as usize, rows as usize),
            ends: (0..vertices).map(end).collect(),
            edges: vec![Vec::new(); 2 * vertices],
            is_free,
        };
        // Longer moves leave the map from every vertex.
        for d in neighborhood(k, columns - 1, rows - 1) {
            let footprint = Footprint::new(placement, d);
            for v in 0..vertices {
                let (from, to) = (at(v), at(v) + d);
                let Some(w) = graph.vertex(to).filter(|_| graph.is_free[v]) else { continue };
                if !graph.is_free[w] || !footprint.is_legal(grid, rules, from) {
                    continue;
                }
                if let (Some(a), Some(b)) = (slots[v].toward(from, to), slots[w].toward(to, from)) {
                    graph.edges[state(v, a) as usize].push(Edge { to: state(w, b), length: length(d) });
                }
            }
        }
        graph
    }

    /// The optimal costs from `start` to every vertex. If `start` is blocked or outside the map, no vertex is
    /// reached.
    #[must_use]
    pub fn costs_from(&self, start: Vertex) -> Costs<'_> {
        let mut costs = Costs {
            graph: self,
            start,
            cost: vec![f64::INFINITY; self.edges.len()],
            previous: vec![None; self.edges.len()],
        };
        let first = self.vertex(start).and_then(|v| self.ends[v]);
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
            for edge in &self.edges[from as usize] {
                let (to, next) = (edge.to as usize, cost + edge.length);
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
        (0..self.is_free.len()).filter(|&v| self.is_free[v]).map(|v| self.vertex_at(v))
    }

    /// The number of a vertex of the map.
    fn vertex(&self, at: Vertex) -> Option<usize> {
        let (x, y) = (usize::try_from(at.x).ok()?, usize::try_from(at.y).ok()?);
        (x < self.size.0 && y < self.size.1).then_some(y * self.size.0 + x)
    }

    fn vertex_at(&self, v: usize) -> Vertex {
        Vertex::new((v % self.size.0) as i32, (v / self.size.0) as i32)
    }
}

/// The optimal costs from one start.
#[derive(Clone, Debug)]
pub struct Costs<'a> {
    graph: &'a Explicit,
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

/// Fits in a `u32`: the largest map has 32,769² vertices.
const fn state(vertex: usize, slot: usize) -> u32 {
    (2 * vertex + slot) as u32
}

fn length(d: Vector) -> f64 {
    f64::from(d.x).hypot(f64::from(d.y))
}

/// The states of a vertex.
enum Slots {
    /// One state, slot 0.
    Whole,
    /// A closed gap: slots 0 and 1 are these free quadrants.
    Quadrants([(i64, i64); 2]),
}

impl Slots {
    fn new(grid: &Grid, rules: Rules, at: Vertex) -> Self {
        if rules != Rules::Corner(DiagonalGap::Closed) || !is_gap(grid, at) {
            return Self::Whole;
        }
        match free_quadrants(grid, at).collect::<Vec<_>>()[..] {
            [a, b] => Self::Quadrants([a, b]),
            _ => Self::Whole,
        }
    }

    /// The slot of a move from `at` to `other`, or back.
    fn toward(&self, at: Vertex, other: Vertex) -> Option<usize> {
        match self {
            Self::Whole => Some(0),
            Self::Quadrants(quadrants) => {
                quadrants.iter().position(|&signs| is_in_quadrant(at, other, signs))
            }
        }
    }

    /// The slot in which a path starts or ends: the quadrant of the vertex's own cell.
    fn of_end(&self) -> Option<usize> {
        match self {
            Self::Whole => Some(0),
            Self::Quadrants(quadrants) => quadrants.iter().position(|&signs| signs == (1, 1)),
        }
    }
}
