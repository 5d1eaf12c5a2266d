//! A field over N(k).

use std::{ops::Deref, sync::Arc};

use mediant_grid::{Change, GridGraph, Identity, Interrupt, Placement, Vector, Versioned, Vertex, VertexId};
use mediant_moves::Cost;

use super::{
    gaps::past_a_gap,
    query::{Asked, FieldError, FieldQuery},
    repair::repaired,
};
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
    costs: Versioned<Cost>,
    asked: Arc<Asked>,
}

impl<G> Field<G> {
    pub(super) fn new(graph: G, costs: Versioned<Cost>, query: FieldQuery<'_>) -> Self {
        Self { graph, costs, asked: Arc::new(Asked::of_vertices(query)) }
    }

    pub(super) fn into_costs(self) -> Versioned<Cost> {
        self.costs
    }

    pub(super) const fn versioned(&self) -> &Versioned<Cost> {
        &self.costs
    }

    /// The query that it answers.
    #[must_use]
    pub fn query(&self) -> FieldQuery<'_> {
        self.asked.query()
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
        size_of_val(&*self.costs)
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

    /// The field of the same query after a change of the map, to the last bit the one that would be made
    /// anew. The work follows the vertices whose distances change. `graph` is that of the map after the
    /// change. This field stays as it is; the next repair takes its memory, if it is given up by then.
    ///
    /// `None` where so much changes that a new field may take less work: [`Fields::again`] makes it. Finding
    /// that out mostly takes less than half as long.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use mediant_grid::{Centers, Change, CornerRule, Grid, GridGraph, Interrupt, Vertex};
    /// use mediant_moves::FiniteK;
    /// use mediant_search::{FieldQuery, Fields};
    ///
    /// let wall = Arc::new(Grid::from_fn(30, 20, |x, y| x == 15 && y > 0)?);
    /// let graph = GridGraph::<Centers>::new(Arc::clone(&wall), FiniteK::N8, CornerRule::Never)?;
    /// let graph = Arc::new(graph);
    /// let field = Fields::new(Arc::clone(&graph)).field(FieldQuery::new(&[Vertex::new(0, 9)]))?;
    ///
    /// let change = Change::new(wall).edit_cells([(15, 9, false)]);
    /// let graph = Arc::new(GridGraph::in_space(&graph.after(&change), FiniteK::N8)?);
    /// let field = match field.repaired(Arc::clone(&graph), &change, &Interrupt::NEVER)? {
    ///     Some(field) => field,
    ///     None => Fields::new(graph).again(&field, &Interrupt::NEVER)?,
    /// };
    /// assert_eq!(field.get(Vertex::new(29, 9)).map(|cost| cost.to_f64()), Some(29.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// [`Fields::again`]: super::Fields::again
    ///
    /// # Errors
    /// [`FieldError::Mismatch`] for a change of another map, or another grid graph than the one after it;
    /// [`FieldError::Query`] for the first source that is now blocked; [`FieldError::Interrupted`].
    pub fn repaired(
        &self,
        graph: G,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<Self>, FieldError> {
        let mine = self.identity();
        let [before, after] =
            [change.before(), change.after()].map(|map| Identity { map: Some(map.id()), ..mine });
        mine.check("the field", ("the map before the change", before))?;
        after.check("the field after the change", ("the grid graph", graph.identity()))?;
        let query = self.query();
        query.check(&graph)?;
        let reach = query.reach(&graph, &self.costs);
        let costs = repaired(&graph, (&self.costs, reach), query.sources, change.cells(), interrupt)?;
        // Where the field ends at some vertices, it may now end elsewhere.
        let costs = costs.filter(|costs| query.reach(&graph, costs) == reach);
        Ok(costs.map(|costs| Self { graph, costs, asked: Arc::clone(&self.asked) }))
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
