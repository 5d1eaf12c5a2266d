//! The explicit graph of all legal moves.

use mediant_grid::{DiagonalGap, Grid, PlacementKind, Rules, Vertex};
use mediant_moves::{FiniteK, Vector};

use crate::{
    legality::{Footprint, free_quadrants, is_gap, is_in_quadrant, vertex_is_free},
    neighborhood,
};

/// Every free vertex, and every legal move with a label, such as its length.
///
/// Under [`DiagonalGap::Closed`] a gap has two states, one for each free quadrant.
#[derive(Clone, Debug)]
pub(crate) struct Graph<L> {
    /// The number of columns and of rows of vertices.
    size: (usize, usize),
    /// For each vertex, the state in which a path may start or end there, if there is one.
    pub(crate) ends: Vec<Option<u32>>,
    pub(crate) is_free: Vec<bool>,
    /// The edges of each state. State 2v + slot belongs to vertex v.
    pub(crate) edges: Vec<Vec<Edge<L>>>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge<L> {
    pub(crate) to: u32,
    pub(crate) label: L,
}

impl<L> Graph<L> {
    /// The graph for N(k), or of all moves with gcd 1 for k = `None`. `label` is called with the first vertex
    /// of a legal move and with the move.
    pub(crate) fn new(
        grid: &Grid,
        rules: Rules,
        k: Option<FiniteK>,
        mut label: impl FnMut(Vertex, Vector) -> L,
    ) -> Self {
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
            edges: (0..2 * vertices).map(|_| Vec::new()).collect(),
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
                    graph.edges[state(v, a) as usize].push(Edge { to: state(w, b), label: label(from, d) });
                }
            }
        }
        graph
    }

    /// All free vertices, row by row.
    pub(crate) fn free_vertices(&self) -> impl Iterator<Item = Vertex> {
        (0..self.is_free.len()).filter(|&v| self.is_free[v]).map(|v| self.vertex_at(v))
    }

    /// The number of a vertex of the map.
    pub(crate) fn vertex(&self, at: Vertex) -> Option<usize> {
        let (x, y) = (usize::try_from(at.x).ok()?, usize::try_from(at.y).ok()?);
        (x < self.size.0 && y < self.size.1).then_some(y * self.size.0 + x)
    }

    pub(crate) fn vertex_at(&self, v: usize) -> Vertex {
        Vertex::new((v % self.size.0) as i32, (v / self.size.0) as i32)
    }
}

/// Fits in a `u32`: the largest map has 32,769² vertices.
const fn state(vertex: usize, slot: usize) -> u32 {
    (2 * vertex + slot) as u32
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
