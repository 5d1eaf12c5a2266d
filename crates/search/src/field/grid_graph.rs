//! The search on a grid graph behind a field over N(k).

use std::{ops::Deref, sync::Arc};

use mediant_grid::{
    Centers, GridGraph, Identity, Interrupt, Interrupted, Mismatch, Placement, Step, Vector, VersionEdit,
    Vertex, VertexId, uninterrupted,
};
use mediant_moves::Cost;

use super::{
    buckets::Buckets, costs::Field, gaps, open_ground::OpenGround, query::FieldError, query::FieldQuery,
};
use crate::{
    canonical::{PatternTable, Pruning, pattern_at, prunes, rank},
    filled::{filled, refill},
    limit::at_most,
    successors::ExpandedNode,
};

/// Makes distance fields over N(k), one after another: from one or many sources, with a limit or without.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph, Vector, Vertex};
/// use mediant_moves::FiniteK;
/// use mediant_search::{FieldQuery, Fields};
///
/// let map = AsciiMap::parse("
///     ......
///     .####.
///     ......
/// ")?;
/// let graph = GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::new(3)?, CornerRule::Never)?;
/// let mut fields = Fields::new(&graph);
/// let goals = [(0, 0), (5, 2)].map(Vertex::from);
/// let field = fields.field(FieldQuery::new(&goals))?;
/// assert_eq!(field.get(Vertex::new(3, 0)).map(|cost| cost.to_f64()), Some(3.0));
/// assert_eq!(field.direction(Vertex::new(3, 2)), Some(Vector::new(1, 0)));
/// // A movement range: the vertices within two and a half cells.
/// let range = fields.field(FieldQuery::new(&goals[..1]).within(2.5))?;
/// assert_eq!(range.iter().count(), 5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// `G` is how it holds its grid graph: by reference, or by `Arc`. The fields hold it too.
#[derive(Debug)]
pub struct Fields<G, P: Placement> {
    graph: G,
    /// Where it applies: not where paths may pass closed gaps.
    pruning: Option<Arc<Pruning<P>>>,
    /// For k ≤ 3.
    open: Option<OpenGround>,
    scratch: Scratch,
}

#[derive(Debug)]
struct Scratch {
    buckets: Buckets,
    /// For each vertex that a search has reached, the move by which the known path arrives, and whether the
    /// vertex still is to be expanded.
    arrived: Box<[u16]>,
}

/// The number of expansions between two questions of an interrupt.
const LOOK: usize = crate::Limits::EXPANSIONS_PER_LOOK as usize;

/// The vertex is to be expanded.
const OPEN: u16 = 1 << 15;
/// No move: a source.
const SOURCE: u16 = OPEN - 1;

impl<P: Placement, G: Deref<Target = GridGraph<P>> + Clone> Fields<G, P> {
    /// Prepares what fields on a grid graph need: its own [`Pruning`], and two bytes a vertex.
    #[must_use]
    pub fn new(graph: G) -> Self {
        let pruning = prunes(&graph).then(|| Arc::new(Pruning::new(&*graph)));
        uninterrupted(|never| Self::of(graph, pruning, never))
    }

    /// The same with a pruning rule that is shared with planners.
    ///
    /// # Errors
    /// [`Mismatch`] for a rule that was prepared for another map, k or rule of motion.
    pub fn with_pruning(graph: G, pruning: Arc<Pruning<P>>) -> Result<Self, Mismatch> {
        uninterrupted(|never| Self::with_pruning_interruptible(graph, pruning, never))
    }

    /// [`with_pruning`](Self::with_pruning), which an interrupt can stop.
    ///
    /// # Errors
    /// [`Interrupted`]; within, those of [`with_pruning`](Self::with_pruning).
    pub fn with_pruning_interruptible(
        graph: G,
        pruning: Arc<Pruning<P>>,
        interrupt: &Interrupt,
    ) -> Result<Result<Self, Mismatch>, Interrupted> {
        if let Err(mismatch) = pruning.check(&graph) {
            return Ok(Err(mismatch));
        }
        let pruning = prunes(&graph).then_some(pruning);
        Self::of(graph, pruning, interrupt).map(Ok)
    }

    fn of(graph: G, pruning: Option<Arc<Pruning<P>>>, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        let has_table = pruning.as_ref().is_some_and(|pruning| pruning.table().is_some());
        let open = if has_table { Some(OpenGround::new(&graph, interrupt)?) } else { None };
        let longest = graph.steps().iter().map(|step| step.cost).max().unwrap_or(Cost::ZERO);
        let width = open.as_ref().map_or(0, |open| bucket_width(&graph, open));
        let arrived = filled(SOURCE, graph.vertex_count(), interrupt)?.into_boxed_slice();
        let scratch = Scratch { buckets: Buckets::new(width, longest), arrived };
        Ok(Self { graph, pruning, open, scratch })
    }

    /// The identity: its map, rules and k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        self.graph.identity()
    }

    /// The memory used beyond the grid graph, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let pruning = self.pruning.as_ref().map_or(0, |pruning| pruning.memory_bytes());
        let open = self.open.as_ref().map_or(0, OpenGround::memory_bytes);
        pruning + open + self.scratch.buckets.memory_bytes() + size_of_val(&*self.scratch.arrived)
    }

    /// The distance from every vertex to the nearest source.
    ///
    /// # Errors
    /// [`FieldError`] for a source that is blocked or outside the map, or a limit that is none.
    pub fn field(&mut self, query: FieldQuery<'_>) -> Result<Field<G>, FieldError> {
        self.field_interruptible(query, &Interrupt::NEVER)
    }

    /// [`field`](Self::field), which an interrupt can stop: it asks every [`EXPANSIONS_PER_LOOK`] expansions.
    /// These fields can be used on.
    ///
    /// [`EXPANSIONS_PER_LOOK`]: crate::Limits::EXPANSIONS_PER_LOOK
    ///
    /// # Errors
    /// As for [`field`](Self::field), and [`FieldError::Interrupted`].
    pub fn field_interruptible(
        &mut self,
        query: FieldQuery<'_>,
        interrupt: &Interrupt,
    ) -> Result<Field<G>, FieldError> {
        let sources = query.check(&self.graph)?;
        let mut costs = filled(Cost::MAX, self.graph.vertex_count(), interrupt)?;
        self.fill(query, &sources, &mut costs, interrupt)?;
        Ok(Field::new(self.graph.clone(), costs.into(), query))
    }

    /// The field of an old one's query on the map of these fields, as if it were made anew: where
    /// [`Field::repaired`] says that this takes less work. The old one may be of another map; it stays as it
    /// is.
    ///
    /// # Errors
    /// [`FieldError::Mismatch`] for a field under other rules or of another k; those of
    /// [`field`](Self::field), and [`FieldError::Interrupted`].
    pub fn again(&mut self, old: &Field<G>, interrupt: &Interrupt) -> Result<Field<G>, FieldError> {
        let on_any_map = Identity { map: None, ..old.identity() };
        on_any_map.check("the field", ("the fields", self.identity()))?;
        let query = old.query();
        if old.costs().len() != self.graph.vertex_count() {
            return self.field_interruptible(query, interrupt);
        }
        let sources = query.check(&self.graph)?;
        self.fill_edit(query, &sources, old.versioned().edit_if_room("filling memory")?, interrupt)
    }

    /// The same in the memory of a field that is not needed any more.
    ///
    /// # Errors
    /// As for [`field`](Self::field); the field is lost.
    pub fn field_in(&mut self, query: FieldQuery<'_>, old: Field<G>) -> Result<Field<G>, FieldError> {
        let sources = query.check(&self.graph)?;
        if old.costs().len() != self.graph.vertex_count() {
            return self.field(query);
        }
        self.fill_edit(query, &sources, old.into_costs().into_edit(), &Interrupt::NEVER)
    }

    fn fill_edit(
        &mut self,
        query: FieldQuery<'_>,
        sources: &[VertexId],
        mut costs: VersionEdit<Cost>,
        interrupt: &Interrupt,
    ) -> Result<Field<G>, FieldError> {
        refill(costs.all_mut(), Cost::MAX, interrupt)?;
        self.fill(query, sources, costs.all_mut(), interrupt)?;
        Ok(Field::new(self.graph.clone(), costs.finish(), query))
    }

    fn fill(
        &mut self,
        query: FieldQuery<'_>,
        sources: &[VertexId],
        costs: &mut [Cost],
        interrupt: &Interrupt,
    ) -> Result<(), Interrupted> {
        let graph: &GridGraph<P> = &self.graph;
        let Scratch { buckets, arrived } = &mut self.scratch;
        buckets.clear();
        let limit = query.fixed_limit();
        for &id in sources {
            if let (Some(cost), Some(by)) = (costs.get_mut(id.index()), arrived.get_mut(id.index())) {
                if *cost != Cost::ZERO {
                    buckets.push(Cost::ZERO, graph.vertex(id));
                }
                (*cost, *by) = (Cost::ZERO, SOURCE | OPEN);
            }
        }
        let targets: Vec<usize> =
            query.until.iter().filter_map(|&at| graph.id(at)).map(VertexId::index).collect();
        let mut search = FieldSearch {
            graph,
            table: self.pruning.as_ref().and_then(|pruning| pruning.table()),
            pruning: self.pruning.as_deref(),
            open: self.open.as_ref(),
            costs: &mut *costs,
            arrived,
            buckets,
            limit,
            end: Cost::ZERO,
        };
        search.run(&targets, interrupt)?;
        gaps::end_at_gaps(graph, sources, limit, costs, interrupt)?;
        if !targets.is_empty() {
            let reach = query.reach(graph, costs);
            costs.iter_mut().filter(|cost| **cost > reach).for_each(|cost| *cost = Cost::MAX);
        }
        Ok(())
    }
}

/// The binary logarithm of the width of buckets for k ≤ 3, in cells: eight cells where most of the ground is
/// open, two in noise, where paths that are followed far ahead are often given up
/// (`docs/measurements/search.md`).
fn bucket_width<P: Placement>(graph: &GridGraph<P>, open: &OpenGround) -> u32 {
    let free = graph.grid().rows().words().iter().map(|word| word.count_zeros() as usize).sum::<usize>();
    if 2 * open.count() >= free { 3 } else { 1 }
}

/// A search of all vertices from the sources, without a goal.
struct FieldSearch<'s, P: Placement> {
    graph: &'s GridGraph<P>,
    pruning: Option<&'s Pruning<P>>,
    /// The pruning rule and the open ground, for k ≤ 3.
    table: Option<&'s PatternTable>,
    open: Option<&'s OpenGround>,
    costs: &'s mut [Cost],
    arrived: &'s mut [u16],
    buckets: &'s mut Buckets,
    limit: Cost,
    /// The end of the current bucket.
    end: Cost,
}

/// A vertex that is being expanded.
#[derive(Clone, Copy)]
struct Head {
    id: VertexId,
    at: Vertex,
    cost: Cost,
    by: u16,
}

impl<P: Placement> FieldSearch<'_, P> {
    /// Expands bucket after bucket, until all targets are final or nothing is queued.
    fn run(&mut self, targets: &[usize], interrupt: &Interrupt) -> Result<(), Interrupted> {
        let mut expansions = 0_usize;
        loop {
            self.end = self.buckets.end();
            while let Some(at) = self.buckets.pop() {
                interrupt.check_every(LOOK, expansions, "finding the distances of a field")?;
                expansions += 1;
                if let Some(head) = self.take(at) {
                    match (self.table, self.open) {
                        (Some(table), Some(open)) => self.follow(head, table, open),
                        _ => self.expand(head),
                    }
                }
            }
            let is_final = |&id: &usize| self.costs.get(id).is_some_and(|&cost| at_most(cost) < self.end);
            let done = !targets.is_empty() && targets.iter().all(is_final);
            if done || !self.buckets.advance() {
                return Ok(());
            }
        }
    }

    /// A vertex from the queue, if it is still to be expanded.
    #[inline]
    fn take(&mut self, at: Vertex) -> Option<Head> {
        let id = self.graph.id(at)?;
        let (&cost, by) = (self.costs.get(id.index())?, self.arrived.get_mut(id.index())?);
        let is_open = *by & OPEN != 0;
        *by &= !OPEN;
        is_open.then_some(Head { id, at, cost, by: *by })
    }

    /// Whether pruning does not apply, because the path comes from a closed gap: a source.
    #[inline]
    fn is_exempt(&self, head: Head) -> bool {
        head.by == SOURCE
            || self.graph.has_closed_gaps()
                && self.graph.is_closed_gap(head.at + -self.graph.step(head.by.into()).vector())
    }

    /// All successors of a vertex.
    fn expand(&mut self, head: Head) {
        let graph = self.graph;
        match self.pruning.filter(|_| !self.is_exempt(head)) {
            Some(pruning) => {
                let by = usize::from(head.by);
                let node = ExpandedNode { id: head.id, at: head.at, by: Some(by) };
                if pruning.takes_all_moves(graph, &node, by) {
                    return graph.for_each_legal_move(head.at, |next| self.queue(head, next));
                }
                pruning.for_each(graph, &node, by, |next| self.queue(head, next));
            }
            None => graph.for_each_legal_move(head.at, |next| self.queue(head, next)),
        }
    }

    /// Takes a step, and queues the vertex to which it leads if no path to that is earlier.
    #[inline]
    fn queue(&mut self, head: Head, next: usize) {
        if let Some((to, cost)) = self.step(head, next) {
            self.buckets.push(cost, to);
        }
    }

    /// Takes a step. Returns where it leads if no path to there is earlier: that vertex is to be expanded.
    #[inline]
    fn step(&mut self, head: Head, next: usize) -> Option<(Vertex, Cost)> {
        let step = self.graph.step(next);
        let (id, cost) = (step.target(head.id).index(), head.cost + step.cost);
        let to = head.at + step.vector();
        if self.graph.has_closed_gaps() && self.is_forbidden(head, to) {
            return None;
        }
        let (known, by) = (self.costs.get_mut(id)?, self.arrived.get_mut(id)?);
        let is_later = cost > *known || cost == *known && rank(next) >= rank((*by & !OPEN).into());
        if is_later || cost > self.limit {
            return None;
        }
        *known = cost;
        *by = next as u16 | OPEN;
        Some((to, cost))
    }

    /// Whether closed gaps forbid a step: a path enters none, and leaves a source at one by the quadrant of
    /// the vertex's own cell.
    #[cold]
    fn is_forbidden(&self, head: Head, to: Vertex) -> bool {
        self.graph.is_closed_gap(to) || head.by == SOURCE && !self.graph.may_turn(None, head.at, Some(to))
    }

    /// Follows a path straight on to the end of the current bucket, and queues what leaves it.
    fn follow(&mut self, mut head: Head, table: &PatternTable, open: &OpenGround) {
        if self.is_exempt(head) {
            return self.expand(head);
        }
        let by = usize::from(head.by);
        let step = *self.graph.step(by);
        let on_open = table.successors(by, 0);
        let keeps_to_line = on_open == 1 << by;
        loop {
            let is_open = open.is_open(head.at);
            let all = if is_open { on_open } else { table.successors(by, pattern_at(self.graph, head.at)) };
            let mut aside = all & !(1 << by);
            while aside != 0 {
                self.queue(head, aside.trailing_zeros() as usize);
                aside &= aside - 1;
            }
            if all >> by & 1 == 0 {
                return;
            }
            if keeps_to_line && is_open {
                let bucket = (self.end.to_bits() - 1 - head.cost.to_bits()) >> Cost::FRACTION_BITS;
                let steps = open.ahead(head.at, step.vector()).min(bucket as u32);
                match self.run_along(head, &step, steps) {
                    Some(last) => head = last,
                    None => return,
                }
            }
            let Some((at, cost)) = self.step(head, by) else { return };
            if cost >= self.end {
                return self.buckets.push(cost, at);
            }
            let id = step.target(head.id);
            if let Some(arrived) = self.arrived.get_mut(id.index()) {
                *arrived = head.by;
            }
            head = Head { id, at, cost, ..head };
        }
    }

    /// Takes a number of steps over open ground, of which nothing leaves. Returns the last vertex, if no path
    /// to any of them is earlier.
    #[inline]
    fn run_along(&mut self, head: Head, step: &Step, steps: u32) -> Option<Head> {
        let (mut id, mut cost, v) = (head.id, head.cost, step.vector());
        let my_rank = rank(head.by.into());
        for _ in 0..steps {
            id = step.target(id);
            cost += step.cost;
            let (known, by) = (self.costs.get_mut(id.index())?, self.arrived.get_mut(id.index())?);
            let is_later = cost > *known || cost == *known && my_rank >= rank((*by & !OPEN).into());
            if is_later || cost > self.limit {
                return None;
            }
            *known = cost;
            *by = head.by;
        }
        let steps = steps as i32;
        Some(Head { id, cost, at: head.at + Vector::new(v.x * steps, v.y * steps), ..head })
    }
}

const _: () = assert!(1 << GridGraph::<Centers>::MAX_K < SOURCE);
