//! Fields: the cost of every vertex to the nearest of one or many sources, and all that follows from it.

mod buckets;
mod directions;
mod repair;
pub(crate) mod search;
#[cfg(not(target_family = "wasm"))]
mod threads;

use std::{num::NonZeroUsize, sync::Arc};

use mediant_grid::{Identity, Interrupt, Versioned, Vertex};
use mediant_moves::{Cost, Vector};
use mediant_search::{End, Path};

pub use self::directions::DirectionCode;
use self::search::{Labels, NONE, search};
use crate::{
    error::CostFieldError,
    graph::CostGraph,
    layout::{Layout, SIDE},
};

/// The sources of a field, its limit, and whether it tells the nearest source.
///
/// ```
/// use mediant_costs::CostFieldQuery;
/// let sources = [(0, 0), (7, 3)].map(Into::into);
/// let query = CostFieldQuery::new(&sources).within(60.0).with_allocation();
/// assert_eq!((query.limit, query.allocation), (60.0, true));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CostFieldQuery<'q> {
    /// The vertices of cost 0. Without one the field is empty.
    pub sources: &'q [Vertex],
    /// The greatest cost in the field: it holds exactly the vertices that cost as much or less, where costs
    /// that differ by a factor of at most 1 + 2⁻³¹ count as the same. Infinity is no limit.
    pub limit: f64,
    /// Whether the field tells which source is nearest ([`CostField::allocation`]): 4 bytes a vertex.
    pub allocation: bool,
}

impl<'q> CostFieldQuery<'q> {
    /// All that can be reached from the sources.
    #[must_use]
    pub const fn new(sources: &'q [Vertex]) -> Self {
        Self { sources, limit: f64::INFINITY, allocation: false }
    }

    /// The same within a cost.
    #[must_use]
    pub const fn within(self, limit: f64) -> Self {
        Self { limit, ..self }
    }

    /// The same with the nearest source of each vertex.
    #[must_use]
    pub const fn with_allocation(self) -> Self {
        Self { allocation: true, ..self }
    }
}

/// The cost of the cheapest path from every vertex to the nearest source: an accumulated cost surface, which
/// GIS calls cost distance.
///
/// It takes 8 bytes a vertex. Directions and paths are not stored: they follow from the costs, which are
/// exact. A move begins a cheapest path where the cost falls by that of the move. So they do not depend on
/// the order of the search. **Ties:** of the moves that begin a cheapest path it takes the one with the
/// lowest index in N(k); of equally near sources the allocation names the one with the least number.
///
/// ```
/// use std::sync::Arc;
/// use mediant_costs::{CostField, CostFieldQuery, CostGraph, CostSurface};
/// use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
/// use mediant_moves::FiniteK;
///
/// // The way along the road, at the bottom, is the cheapest.
/// let map = CostSurface::from_fn(5, 3, |x, y| Some(if y == 2 || x == 0 { 1.0 } else { 9.0 }))?;
/// let graph = Arc::new(CostGraph::new(Arc::new(map), Rules::Center(CornerRule::Never), FiniteK::N8)?);
/// let sources = [Vertex::new(0, 0)];
/// let field = CostField::new(graph, CostFieldQuery::new(&sources), &Interrupt::NEVER)?;
/// let expected = 4.0 + 2.0_f64.sqrt();
/// assert!(field.get(Vertex::new(4, 2)).is_some_and(|cost| (cost - expected).abs() < 1e-9));
/// let path = field.path_from(Vertex::new(4, 2)).expect("all cells are free");
/// assert_eq!(path.to_string(), "(4, 2) → (1, 2) → (0, 1) → (0, 0)");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CostField {
    graph: Arc<CostGraph>,
    /// By state.
    costs: Versioned<u64>,
    /// By state: the number of the nearest source.
    allocation: Option<Versioned<u32>>,
    sources: Box<[Vertex]>,
    limit: f64,
    queue_bytes: usize,
}

impl CostField {
    /// The field of a query. It tells its [progress](Interrupt::progress): the vertices that have their cost,
    /// of all that are not blocked, at corners of all. Vertices that no path reaches within the limit are not
    /// counted.
    ///
    /// ```
    /// use std::sync::{Arc, Mutex};
    /// use mediant_costs::{CostField, CostFieldQuery, CostGraph, CostSurface};
    /// use mediant_grid::{CornerRule, Interrupt, Rules};
    /// use mediant_moves::FiniteK;
    ///
    /// let map = Arc::new(CostSurface::from_fn(5, 3, |x, _| (x != 3).then_some(2.0))?);
    /// let graph = Arc::new(CostGraph::new(map, Rules::Center(CornerRule::Never), FiniteK::N8)?);
    /// let told = Arc::new(Mutex::new(Vec::new()));
    /// let listens = Arc::clone(&told);
    /// let interrupt = Interrupt::new().progress(move |done, total| listens.lock().unwrap().push((done, total)));
    /// CostField::new(graph, CostFieldQuery::new(&[(0, 0).into()]), &interrupt)?;
    /// // The last column lies behind a wall.
    /// assert_eq!(*told.lock().unwrap(), [(0, 12), (9, 12)]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`CostFieldError::Query`] for the first source that is blocked or outside the map;
    /// [`CostFieldError::Limit`]; [`CostFieldError::Interrupted`].
    pub fn new(
        graph: Arc<CostGraph>,
        query: CostFieldQuery<'_>,
        interrupt: &Interrupt,
    ) -> Result<Self, CostFieldError> {
        Self::on_threads(graph, query, NonZeroUsize::MIN, interrupt)
    }

    /// [`new`](Self::new) on so many threads, which are there for as long as it takes; the same field. A
    /// query for the allocation is answered on one. Two threads took 0.55 to 0.70 of the time of one
    /// (`docs/measurements/costs.md`).
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn on_threads(
        graph: Arc<CostGraph>,
        query: CostFieldQuery<'_>,
        threads: NonZeroUsize,
        interrupt: &Interrupt,
    ) -> Result<Self, CostFieldError> {
        if query.limit.is_nan() || query.limit < 0.0 {
            return Err(CostFieldError::Limit { limit: query.limit });
        }
        query.sources.iter().try_for_each(|&at| graph.check(End::Start, at))?;
        let starts: Vec<(usize, u32)> = starts(&graph, query.sources).collect();
        let greatest = graph.greatest_cost(query.limit);
        let Labels { costs, sources, queue_bytes } =
            search(&graph, &starts, (greatest, query.allocation), threads, interrupt)?;
        let (costs, allocation) = (costs.into(), sources.map(Into::into));
        Ok(Self { graph, costs, allocation, sources: query.sources.into(), limit: query.limit, queue_bytes })
    }

    /// The memory that a field of a graph takes, in bytes, without the queue of its search, which takes a few
    /// bytes for each vertex on its front.
    #[must_use]
    pub fn bytes(graph: &CostGraph, allocation: bool) -> usize {
        let each = size_of::<u64>() + if allocation { size_of::<u32>() } else { 0 };
        graph.states().saturating_mul(each)
    }

    /// The memory of the search's queue, in bytes, beside that of the field.
    #[must_use]
    pub const fn queue_bytes(&self) -> usize {
        self.queue_bytes
    }

    /// The search graph.
    #[must_use]
    pub const fn graph(&self) -> &Arc<CostGraph> {
        &self.graph
    }

    /// The identity: its surface, rules and k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        self.graph.identity()
    }

    /// The sources of its query.
    #[must_use]
    pub const fn sources(&self) -> &[Vertex] {
        &self.sources
    }

    /// Its query: the same field can be made on another surface.
    #[must_use]
    pub fn query(&self) -> CostFieldQuery<'_> {
        let Self { sources, limit, allocation, .. } = self;
        CostFieldQuery { sources, limit: *limit, allocation: allocation.is_some() }
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

    /// The state of a path that ends at a vertex.
    fn state(&self, at: Vertex) -> Option<usize> {
        if self.graph.is_free(at) { self.graph.end(at) } else { None }
    }

    /// The cost of a state that is in the field.
    pub(crate) fn known(&self, state: usize) -> Option<u64> {
        self.costs.get(state).copied().filter(|&cost| cost != NONE)
    }

    /// The cost of a vertex in units of the map, 0 at a source; `None` where it is not in the field: where it
    /// is blocked, cannot be reached, costs more than the limit, or is outside the map.
    #[must_use]
    pub fn cost(&self, at: Vertex) -> Option<Cost> {
        match self.state(at) {
            Some(state) => self.known(state).map(Cost::from_bits),
            // A closed gap that no path leaves or enters.
            None => self.sources.contains(&at).then_some(Cost::ZERO),
        }
    }

    /// The same as a number.
    #[must_use]
    pub fn get(&self, at: Vertex) -> Option<f64> {
        Some(self.graph.to_f64(self.cost(at)?))
    }

    /// The number of the nearest source of a vertex, by the order of the query; of equally near ones the
    /// least. `None` where the vertex is not in the field, or the query did not ask for it.
    #[must_use]
    pub fn allocation(&self, at: Vertex) -> Option<u32> {
        let numbers = self.allocation.as_ref()?;
        match self.state(at) {
            Some(state) => self.known(state).and_then(|_| numbers.get(state).copied()),
            None => self.sources.iter().zip(0..).find(|&(&source, _)| source == at).map(|(_, number)| number),
        }
    }

    /// The first move of a cheapest path from a vertex to its nearest source; `None` at a source, and where
    /// the vertex is not in the field.
    #[must_use]
    pub fn direction(&self, at: Vertex) -> Option<Vector> {
        self.first_move(self.state(at)?).map(|(v, _)| v)
    }

    /// The first move from a state, and the state to which it leads.
    fn first_move(&self, state: usize) -> Option<(Vector, usize)> {
        let cost = self.known(state).filter(|&cost| cost > 0)?;
        self.graph.moves_from(state).find_map(|(of, to)| {
            let rest = self.known(to).filter(|&rest| rest < cost)?;
            (self.graph.cost_of(of, state)? == cost - rest).then_some((of.vector, to))
        })
    }

    /// The vertex to which [`direction`](Self::direction) leads.
    #[must_use]
    pub fn next(&self, at: Vertex) -> Option<Vertex> {
        Some(at + self.direction(at)?)
    }

    /// The path along the directions from a vertex to its nearest source, with waypoints where the move
    /// changes; `None` where the vertex is not in the field. No path over N(k) to any source is cheaper.
    /// [`CostGraph::crossings`] has every cell that it crosses.
    #[must_use]
    pub fn path_from(&self, at: Vertex) -> Option<Path> {
        let cost = self.get(at)?;
        let mut waypoints = vec![at];
        let mut next = self.state(at);
        let (mut at, mut last) = (at, None);
        // The cost falls with each move.
        while let Some((v, state)) = next.and_then(|state| self.first_move(state)) {
            at = at + v;
            match waypoints.last_mut().filter(|_| last == Some(v)) {
                Some(end) => *end = at,
                None => waypoints.push(at),
            }
            (last, next) = (Some(v), Some(state));
        }
        Some(Path::with_cost(waypoints, cost))
    }

    /// The costs of all vertices, row by row; infinity where a vertex is not in the field. No second array is
    /// made: the field's own memory is put in order, a row of tiles at a time.
    #[must_use]
    pub fn into_rows(mut self) -> Vec<f64> {
        self.forget_gaps();
        let Self { graph, costs, .. } = self;
        let (layout, size, unit) = (graph.layout(), graph.size(), graph.map().unit());
        let is_blocked = |at: usize| graph.is_center() && graph.map().weights()[at] == 0;
        into_rows(costs.into_words(), layout, size, |at, cost| {
            if cost != NONE && !is_blocked(at) { cost as f64 * unit } else { f64::INFINITY }
        })
    }

    /// Takes the gaps at which no path ends out of the field.
    fn forget_gaps(&mut self) {
        for at in self.graph.scanner().gaps.positions() {
            if self.graph.map().weights()[at] == 0 {
                self.costs.make_mut()[at] =
                    if self.sources.contains(&self.graph.vertex(at)) { 0 } else { NONE };
            }
        }
    }

    /// For each vertex, row by row, the sum of its costs in two fields: what the cheapest path from a source
    /// of one to a source of the other costs that leads over it. Those of little more than the least are a
    /// *corridor*. Infinity where a vertex is not in both fields.
    ///
    /// # Errors
    /// [`CostFieldError::Mismatch`] for fields of other surfaces, rules or k.
    pub fn corridor(&self, other: &Self) -> Result<Vec<f64>, CostFieldError> {
        self.identity().check("the field", ("the other field", other.identity()))?;
        let sum = |at| Some(self.graph.to_f64(self.cost(at)? + other.cost(at)?));
        Ok(self.vertices().map(|at| sum(at).unwrap_or(f64::INFINITY)).collect())
    }

    /// All vertices, row by row.
    fn vertices(&self) -> impl Iterator<Item = Vertex> + use<> {
        let (width, height) = self.graph.size();
        (0..height as i32).flat_map(move |y| (0..width as i32).map(move |x| Vertex::new(x, y)))
    }
}

/// The states of sources, each with its number.
fn starts(graph: &CostGraph, sources: &[Vertex]) -> impl Iterator<Item = (usize, u32)> {
    sources.iter().zip(0..).filter_map(|(&at, number)| Some((graph.end(at)?, number)))
}

/// Numbers of all vertices, row by row, from their costs by position, in the same memory.
pub(crate) fn into_rows(
    mut costs: Vec<u64>,
    layout: Layout,
    (width, height): (u32, u32),
    number: impl Fn(usize, u64) -> f64,
) -> Vec<f64> {
    let mut rows = Vec::new();
    for band in 0..height.div_ceil(SIDE) {
        let range = layout.band(band);
        rows.clear();
        rows.extend_from_slice(&costs[range.clone()]);
        for y in band * SIDE..height.min((band + 1) * SIDE) {
            // Rows have no frame, so they are written before this row of tiles.
            let first = y as usize * width as usize;
            for (x, to) in (0..width as i32).zip(&mut costs[first..first + width as usize]) {
                let at = layout.position(x, y as i32);
                *to = number(at, rows[at - range.start]).to_bits();
            }
        }
    }
    costs.truncate(width as usize * height as usize);
    // The standard library keeps the memory here.
    costs.into_iter().map(f64::from_bits).collect()
}
