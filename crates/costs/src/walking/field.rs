//! Fields: the time of every vertex from the nearest of one or many sources, or to it.

use std::{num::NonZeroUsize, sync::Arc};

use mediant_grid::{Identity, Interrupt, Interrupted, Vertex, room_for};
use mediant_moves::{Cost, Vector};
use mediant_search::{End, Path};

use super::{
    WalkingError,
    graph::{OfWalking, ROOMS, WalkingGraph},
    map::BLOCKED,
};
use crate::{
    error::CostFieldError,
    field::{
        CostFieldQuery, DirectionCode, into_rows,
        search::{Labels, NONE, Search},
    },
};

/// Which way the paths of a field lead.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Heading {
    /// From the sources to every vertex: how long it takes to get there, as `r.walk` has it.
    FromSources,
    /// From every vertex to its nearest source: how long it takes to get back.
    ToSources,
}

/// The cost of the cheapest path from the nearest source to every vertex, or from every vertex to it, walking
/// over elevation. It takes 8 bytes a vertex, like a [`CostField`](crate::CostField), and is as exact.
///
/// **Ties:** of the moves that lead towards a source on a cheapest path it takes the one with the lowest
/// index in N(k); of equally near sources the allocation names the one with the least number.
///
/// ```
/// use std::sync::Arc;
/// use mediant_costs::{CostFieldQuery, Heading, Pace, WalkingField, WalkingGraph, WalkingMap};
/// use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
/// use mediant_moves::FiniteK;
///
/// let slope = |x: u32, _| Some(4.0 * f64::from(x));
/// let map = Arc::new(WalkingMap::new((6, 3), (20.0, 20.0), &Pace::Tobler, &Interrupt::NEVER, slope)?);
/// let graph = Arc::new(WalkingGraph::new(map, Rules::Center(CornerRule::Never), FiniteK::N16)?);
/// let foot = [Vertex::new(0, 1)];
/// let query = CostFieldQuery::new(&foot);
/// let [up, down] = [Heading::FromSources, Heading::ToSources]
///     .map(|heading| WalkingField::new(Arc::clone(&graph), heading, query, &Interrupt::NEVER));
/// let (up, down, top) = (up?, down?, Vertex::new(5, 1));
/// assert!(up.get(top) > down.get(top));
/// assert_eq!(up.path(top).map(|path| path.to_string()), Some("(0, 1) → (5, 1)".to_owned()));
/// assert_eq!(down.path(top).map(|path| path.to_string()), Some("(5, 1) → (0, 1)".to_owned()));
/// # Ok::<(), mediant_costs::WalkingError>(())
/// ```
#[derive(Clone, Debug)]
pub struct WalkingField {
    graph: Arc<WalkingGraph>,
    heading: Heading,
    /// By position. A blocked cell has cost 0.
    costs: Vec<u64>,
    /// By position: the number of the nearest source.
    allocation: Option<Vec<u32>>,
    sources: Box<[Vertex]>,
    limit: f64,
    queue_bytes: usize,
}

impl WalkingField {
    /// The field of a query, which tells its [progress](Interrupt::progress) as a
    /// [`CostField`](crate::CostField) does.
    ///
    /// # Errors
    /// [`WalkingError::Field`] for the first source that is blocked or outside the map, and for the limit;
    /// [`WalkingError::Costs`] when it is interrupted.
    pub fn new(
        graph: Arc<WalkingGraph>,
        heading: Heading,
        query: CostFieldQuery<'_>,
        interrupt: &Interrupt,
    ) -> Result<Self, WalkingError> {
        Self::on_threads(graph, heading, query, NonZeroUsize::MIN, interrupt)
    }

    /// [`new`](Self::new) on so many threads, which are there for as long as it takes; the same field. A
    /// query for the allocation is answered on one.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn on_threads(
        graph: Arc<WalkingGraph>,
        heading: Heading,
        query: CostFieldQuery<'_>,
        threads: NonZeroUsize,
        interrupt: &Interrupt,
    ) -> Result<Self, WalkingError> {
        if query.limit.is_nan() || query.limit < 0.0 {
            return Err(CostFieldError::Limit { limit: query.limit }.into());
        }
        let end = match heading {
            Heading::FromSources => End::Start,
            Heading::ToSources => End::Goal,
        };
        query.sources.iter().try_for_each(|&at| graph.check(end, at)).map_err(CostFieldError::Query)?;
        let starts = query.sources.iter().zip(0..);
        let starts: Vec<(usize, u32)> =
            starts.filter_map(|(&at, number)| Some((graph.position(at)?, number))).collect();
        let search = Search {
            sources: &starts,
            limit: graph.greatest_cost(query.limit),
            with_sources: query.allocation,
            threads,
            across: graph.map().layout().tiles_across(),
            size: graph.size(),
            interrupt,
        };
        let Labels { mut costs, sources: allocation, queue_bytes } = run(&graph, heading, search)?;
        costs.shrink_to_fit();
        Ok(Self {
            graph,
            heading,
            costs,
            allocation,
            sources: query.sources.into(),
            limit: query.limit,
            queue_bytes,
        })
    }

    /// The memory that a field of a graph takes, in bytes, without the queue of its search.
    #[must_use]
    pub fn bytes(graph: &WalkingGraph, allocation: bool) -> usize {
        let each = size_of::<u64>() + if allocation { size_of::<u32>() } else { 0 };
        graph.map().layout().len().saturating_mul(each)
    }

    /// The memory of the search's queue, in bytes, beside that of the field.
    #[must_use]
    pub const fn queue_bytes(&self) -> usize {
        self.queue_bytes
    }

    /// The search graph.
    #[must_use]
    pub const fn graph(&self) -> &Arc<WalkingGraph> {
        &self.graph
    }

    /// Which way its paths lead.
    #[must_use]
    pub const fn heading(&self) -> Heading {
        self.heading
    }

    /// The identity: its map, rules and k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        self.graph.identity()
    }

    /// The sources of its query.
    #[must_use]
    pub const fn sources(&self) -> &[Vertex] {
        &self.sources
    }

    /// Its query: the same field can be made on another map.
    #[must_use]
    pub fn query(&self) -> CostFieldQuery<'_> {
        let Self { sources, limit, allocation, .. } = self;
        let query = CostFieldQuery::new(sources).within(*limit);
        if allocation.is_some() { query.with_allocation() } else { query }
    }

    /// The number of vertices in a row.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.graph.size().0
    }

    /// The number of rows of vertices.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.graph.size().1
    }

    /// The vertices in the field, row by row, with their costs as numbers.
    pub fn iter(&self) -> impl Iterator<Item = (Vertex, f64)> {
        self.vertices().filter_map(|at| Some((at, self.get(at)?)))
    }

    /// The costs of all vertices as numbers, row by row; infinity where a vertex is not in the field.
    /// [`into_rows`](Self::into_rows) has them without a second array.
    pub fn rows(&self) -> impl Iterator<Item = f64> {
        self.vertices().map(|at| self.get(at).unwrap_or(f64::INFINITY))
    }

    /// The position of a vertex that is in the field.
    fn place(&self, at: Vertex) -> Option<usize> {
        self.graph.position(at).filter(|&at| self.is_in(at))
    }

    fn is_in(&self, at: usize) -> bool {
        self.costs[at] != NONE && self.graph.map().heights()[at] != BLOCKED
    }

    /// The cost of a vertex in units of the map, 0 at a source; `None` where it is not in the field: where it
    /// is blocked, cannot be reached or left, costs more than the limit, or is outside the map.
    #[must_use]
    pub fn cost(&self, at: Vertex) -> Option<Cost> {
        Some(Cost::from_bits(self.costs[self.place(at)?]))
    }

    /// The same as a number, in the unit of time of the pace.
    #[must_use]
    pub fn get(&self, at: Vertex) -> Option<f64> {
        Some(self.graph.to_f64(self.cost(at)?))
    }

    /// The number of the nearest source of a vertex, by the order of the query; of equally near ones the
    /// least. `None` where the vertex is not in the field, or the query did not ask for it.
    #[must_use]
    pub fn allocation(&self, at: Vertex) -> Option<u32> {
        self.allocation.as_ref()?.get(self.place(at)?).copied()
    }

    /// The move from a vertex towards its nearest source on a cheapest path: its first one of a field to the
    /// sources, its last one, turned around, of a field from them. `None` at a source, and where the vertex
    /// is not in the field.
    #[must_use]
    pub fn direction(&self, at: Vertex) -> Option<Vector> {
        self.towards(self.place(at)?).map(|(v, _)| v)
    }

    /// The vertex to which [`direction`](Self::direction) leads.
    #[must_use]
    pub fn next(&self, at: Vertex) -> Option<Vertex> {
        Some(at + self.direction(at)?)
    }

    /// The move from a position towards its source, and the position to which it leads.
    fn towards(&self, at: usize) -> Option<(Vector, usize)> {
        let cost = self.costs[at];
        self.graph.moves().all.iter().find_map(|of| {
            let to = self.graph.target(at, of.vector);
            let rest = self.costs[to];
            // A path from the source comes by the move against this one.
            let heading = match self.heading {
                Heading::FromSources => Heading::ToSources,
                Heading::ToSources => Heading::FromSources,
            };
            let between = || self.graph.cost_of(of, heading, at);
            (rest < cost && between()? == cost - rest).then_some((of.vector, to))
        })
    }

    /// The cheapest path between a vertex and its nearest source, in its direction: of a field from the
    /// sources it begins at the source and ends at the vertex, of a field to them it begins at the vertex.
    /// Its waypoints are where the move changes, its [cost](Path::cost) is its time. `None` where the vertex
    /// is not in the field.
    #[must_use]
    pub fn path(&self, at: Vertex) -> Option<Path> {
        let (time, mut place) = (self.get(at)?, self.place(at)?);
        let (mut waypoints, mut last) = (vec![at], None);
        // The cost falls with each move.
        while let Some((v, to)) = self.towards(place) {
            place = to;
            let at = self.graph.vertex(to);
            match waypoints.last_mut().filter(|_| last == Some(v)) {
                Some(end) => *end = at,
                None => waypoints.push(at),
            }
            last = Some(v);
        }
        if self.heading == Heading::FromSources {
            waypoints.reverse();
        }
        Some(Path::with_cost(waypoints, time))
    }

    /// The directions of all vertices towards their nearest source, row by row, by a code; `None` where a
    /// vertex is not in the field, or the code has no number.
    pub fn directions(&self, code: DirectionCode) -> impl Iterator<Item = Option<f64>> {
        self.vertices().map(move |at| match self.direction(at) {
            Some(v) => code.of(v),
            None => self.cost(at).and_then(|_| code.of_source()),
        })
    }

    /// The costs of all vertices, row by row; infinity where a vertex is not in the field. No second array is
    /// made.
    #[must_use]
    pub fn into_rows(self) -> Vec<f64> {
        let Self { graph, costs, .. } = self;
        let (heights, unit) = (graph.map().heights(), graph.map().unit());
        into_rows(costs, graph.map().layout(), graph.size(), |at, cost| {
            if cost != NONE && heights[at] != BLOCKED { cost as f64 * unit } else { f64::INFINITY }
        })
    }

    /// For each vertex, row by row, the cost of the cheapest path over it from a source of one field to a
    /// source of the other. Those of little more than the least are a *corridor*. Infinity where a vertex is
    /// not in both fields.
    ///
    /// # Errors
    /// [`WalkingError::Heading`] unless one field is from its sources and the other to them;
    /// [`WalkingError::Field`] for fields of other maps, rules or k.
    pub fn corridor(&self, other: &Self) -> Result<Vec<f64>, WalkingError> {
        let mismatch = self.identity().check("the field", ("the other field", other.identity()));
        mismatch.map_err(CostFieldError::Mismatch)?;
        if self.heading == other.heading {
            return Err(WalkingError::Heading);
        }
        let sum = |at| Some(self.graph.to_f64(self.cost(at)? + other.cost(at)?));
        Ok(self.vertices().map(|at| sum(at).unwrap_or(f64::INFINITY)).collect())
    }

    /// All vertices, row by row.
    fn vertices(&self) -> impl Iterator<Item = Vertex> + use<> {
        let (width, height) = self.graph.size();
        (0..height as i32).flat_map(move |y| (0..width as i32).map(move |x| Vertex::new(x, y)))
    }
}

fn run(graph: &WalkingGraph, heading: Heading, search: Search<'_>) -> Result<Labels, Interrupted> {
    let count = graph.map().heights().len();
    room_for::<u64>(count, "filling memory")?;
    let mut costs = Vec::with_capacity(count);
    for piece in graph.map().heights().chunks(1 << 18) {
        search.interrupt.check("filling memory")?;
        // No path beats the 0 of a blocked cell.
        costs.extend(piece.iter().map(|&height| if height == BLOCKED { 0 } else { NONE }));
    }
    match graph.k().get() {
        0..=5 => search.run(costs, OfWalking::<{ ROOMS[0] }>::new(graph, heading)),
        _ => search.run(costs, OfWalking::<{ ROOMS[1] }>::new(graph, heading)),
    }
}
