//! A field over N(k).

use std::ops::Deref;

use mediant_grid::{GridGraph, Identity, Placement, Vector, Vertex, VertexId};
use mediant_moves::Cost;

use super::gaps::past_a_gap;
use crate::path::Path;

/// The distance from every vertex of a map to the nearest source, over N(k): what
/// [`Fields`](super::Fields) makes. From it follow the paths and directions to the nearest source, from
/// anywhere: a flow field.
///
/// It takes eight bytes a vertex. Directions are not stored. They follow from the distances, which are exact:
/// a move is the first of a shortest path where the distance falls by the cost of the move.
///
/// **Ties.** Of the moves that begin a shortest path it takes the one with the lowest index in N(k).
#[derive(Clone, Debug)]
pub struct Field<G> {
    graph: G,
    /// By vertex number; the greatest cost stands for 'not in the field'.
    costs: Vec<Cost>,
}

impl<G> Field<G> {
    pub(super) const fn new(graph: G, costs: Vec<Cost>) -> Self {
        Self { graph, costs }
    }

    pub(super) fn into_costs(self) -> Vec<Cost> {
        self.costs
    }

    /// The distances by vertex number, row by row; [`Cost::MAX`] where a vertex is not in the field: where it
    /// is blocked, cannot be reached, or is farther than the limit.
    #[must_use]
    pub fn costs(&self) -> &[Cost] {
        &self.costs
    }

    /// The same in cells; infinity where a vertex is not in the field.
    pub fn lengths(&self) -> impl Iterator<Item = f64> {
        self.costs.iter().map(|&cost| if cost == Cost::MAX { f64::INFINITY } else { cost.to_f64() })
    }

    /// The memory used, in bytes, without that of the grid graph.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.costs.capacity() * size_of::<Cost>()
    }
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>> Field<G> {
    /// The grid graph.
    #[must_use]
    pub fn graph(&self) -> &GridGraph<P> {
        &self.graph
    }

    /// The identity: its map, rules and k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        self.graph.identity()
    }

    /// The number of vertices in a row.
    #[must_use]
    pub fn width(&self) -> u32 {
        P::vertices(self.graph.grid()).0
    }

    /// The number of rows of vertices.
    #[must_use]
    pub fn height(&self) -> u32 {
        P::vertices(self.graph.grid()).1
    }

    /// The distance of a vertex, 0 at a source; `None` when it is not in the field, or outside the map.
    #[must_use]
    #[inline]
    pub fn get(&self, at: Vertex) -> Option<Cost> {
        let cost = *self.costs.get(self.graph.id(at)?.index())?;
        (cost != Cost::MAX).then_some(cost)
    }

    /// The vertices in the field, row by row, with their distances.
    pub fn iter(&self) -> impl Iterator<Item = (Vertex, Cost)> {
        let rows = self.costs.chunks_exact(self.width() as usize).zip(0..);
        rows.flat_map(|(row, y)| {
            let known = row.iter().zip(0..).filter(|&(&cost, _)| cost != Cost::MAX);
            known.map(move |(&cost, x)| (Vertex::new(x, y), cost))
        })
    }

    /// The first move of a shortest path from a vertex to its nearest source; `None` at a source, and where
    /// [`get`](Self::get) is `None`.
    ///
    /// (Where gaps are closed, the next direction is that of an agent that starts anew. It matters at k = 2
    /// alone, where a path may pass a gap: [`path_from`](Self::path_from) knows where it came from.)
    #[must_use]
    pub fn direction(&self, at: Vertex) -> Option<Vector> {
        self.first_move(at).map(|(v, _)| v)
    }

    /// The first move, and where the path ends if the move leads past a gap.
    fn first_move(&self, at: Vertex) -> Option<(Vector, Option<Vertex>)> {
        let cost = self.get(at).filter(|&cost| cost > Cost::ZERO)?;
        let (graph, id) = (&*self.graph, self.graph.id(at)?);
        let leads = |to: VertexId, by: Cost| {
            self.costs.get(to.index()).is_some_and(|&rest| rest < cost && rest + by == cost)
        };
        let mut best = usize::MAX;
        graph.for_each_legal_move(at, |index| {
            let step = graph.step(index);
            if index < best && leads(step.target(id), step.cost) && self.may_step(at, step.vector()) {
                best = index;
            }
        });
        if best < usize::MAX {
            return Some((graph.step(best).vector(), None));
        }
        let [past, to] = past_a_gap(graph, at, |to| self.is_source(to))?;
        Some((at.to(past), Some(to)))
    }

    /// Whether a path from a vertex may begin with a legal move as far as closed gaps go: it passes none.
    fn may_step(&self, at: Vertex, v: Vector) -> bool {
        let (graph, to) = (&*self.graph, at + v);
        !graph.has_closed_gaps()
            || graph.may_turn(None, at, Some(to))
                && (!graph.is_closed_gap(to) || self.is_source(to) && graph.may_turn(Some(at), to, None))
    }

    fn is_source(&self, at: Vertex) -> bool {
        self.get(at) == Some(Cost::ZERO)
    }

    /// The vertex to which [`direction`](Self::direction) leads.
    #[must_use]
    pub fn next(&self, at: Vertex) -> Option<Vertex> {
        Some(at + self.direction(at)?)
    }

    /// The path along the directions from a vertex to its nearest source, with waypoints where the move
    /// changes; `None` where [`get`](Self::get) is `None`. No path over N(k) to any source is shorter.
    #[must_use]
    pub fn path_from(&self, at: Vertex) -> Option<Path> {
        self.get(at)?;
        let (mut waypoints, mut at, mut last) = (vec![at], at, None);
        // The distance falls with each move.
        while let Some((v, end)) = self.first_move(at) {
            if let Some(end) = end {
                waypoints.extend([at + v, end]);
                break;
            }
            at = at + v;
            match waypoints.last_mut().filter(|_| last == Some(v)) {
                Some(end) => *end = at,
                None => waypoints.push(at),
            }
            last = Some(v);
        }
        Some(Path::new(waypoints))
    }

    /// The nearest source of a vertex: where [`path_from`](Self::path_from) ends.
    #[must_use]
    pub fn nearest_source(&self, at: Vertex) -> Option<Vertex> {
        self.path_from(at)?.waypoints().last().copied()
    }
}
