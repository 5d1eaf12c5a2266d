//! Building a graph: its edges, then its hierarchy.

use mediant_grid::{FreeSpace, Identity, Interrupt, Interrupted, Vertex, room_for};
use mediant_moves::K;

use crate::{
    arc::UpwardArc,
    bends::BendRule,
    chunks::in_chunks,
    contract::{ContractedGraph, Contraction, Decision, SubgoalGeometry},
    error::SubgoalError,
    graph::{MAX_ARCS, SubgoalGraph},
    hierarchy::Hierarchy,
    placement::{BuildContext, EdgeCriterion, EdgeFinder, EdgeKind, SubgoalPlacement},
    progress::{Progress, Stage},
    subgoals::Subgoals,
};
use mediant_search::parts::Metric;

/// The stage that an interrupted call names.
const DURING: &str = "finding the edges of subgoals";

impl<P: SubgoalPlacement> SubgoalGraph<P> {
    /// The subgoal graph of a free space for paths over N(k), or at any angle.
    ///
    /// # Errors
    /// [`SubgoalError`] if the placement has no subgoal graph for this k and rule, or if the graph would be
    /// too large.
    pub fn new(space: &FreeSpace<P>, k: impl Into<K>, hierarchy: Hierarchy) -> Result<Self, SubgoalError> {
        Self::with_progress(space, k.into(), hierarchy, &|_| {}, &Interrupt::NEVER)
    }

    /// [`new`](Self::new) with reports to `progress`, which is called from any thread. The interrupt is asked
    /// for each row of the map and each subgoal.
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`SubgoalError::Interrupted`].
    pub fn with_progress(
        space: &FreeSpace<P>,
        k: K,
        hierarchy: Hierarchy,
        progress: &(impl Fn(Progress) + Sync),
        interrupt: &Interrupt,
    ) -> Result<Self, SubgoalError> {
        let hierarchy = hierarchy.with_a_code();
        let ground = Ground::new(space, k, hierarchy, interrupt)?;
        let contracted = ground.contracted(space, hierarchy, progress, interrupt)?;
        ground.into_graph(space, hierarchy, &contracted, interrupt)
    }
}

/// The subgoals, metric and tables from which a subgoal graph is built.
pub(crate) struct Ground<P: SubgoalPlacement> {
    pub(crate) subgoals: Subgoals,
    pub(crate) metric: Metric,
    tables: P::Tables,
    pub(crate) k: K,
    pub(crate) criterion: EdgeCriterion,
}

impl<P: SubgoalPlacement> Ground<P> {
    pub(crate) fn new(
        space: &FreeSpace<P>,
        k: K,
        hierarchy: Hierarchy,
        interrupt: &Interrupt,
    ) -> Result<Self, SubgoalError> {
        P::check(space, k)?;
        let metric = Metric::new(k)?;
        let marks = P::subgoals(space, interrupt)?;
        let tables = P::tables(space, &marks, interrupt)?;
        Ok(Self {
            subgoals: Subgoals::new(marks, interrupt)?,
            metric,
            tables,
            k,
            criterion: P::edge_criterion(k, hierarchy),
        })
    }

    pub(crate) fn context<'m>(&'m self, space: &'m FreeSpace<P>) -> BuildContext<'m, P> {
        let Self { subgoals, metric, tables, k, criterion } = self;
        BuildContext { space, subgoals, tables, metric: *metric, k: *k, criterion: *criterion }
    }

    /// Finds the edges, and builds a hierarchy on them.
    pub(crate) fn contracted(
        &self,
        space: &FreeSpace<P>,
        hierarchy: Hierarchy,
        progress: &(impl Fn(Progress) + Sync),
        interrupt: &Interrupt,
    ) -> Result<ContractedGraph, Interrupted> {
        let edges = self.edges(space, progress, interrupt)?;
        self.contracted_from(&edges, (space, hierarchy), &mut |_| {}, progress, interrupt)
    }

    /// Every edge, from one of its ends.
    pub(crate) fn edges(
        &self,
        space: &FreeSpace<P>,
        progress: &(impl Fn(Progress) + Sync),
        interrupt: &Interrupt,
    ) -> Result<Vec<(u32, u32)>, Interrupted> {
        let report = |done| progress(Progress { stage: Stage::Edges, done, total: self.subgoals.len() });
        find_edges(self.context(space), &report, interrupt)
    }

    /// Builds a hierarchy on the edges. Of levels it tells what was decided.
    pub(crate) fn contracted_from(
        &self,
        edges: &[(u32, u32)],
        (space, hierarchy): (&FreeSpace<P>, Hierarchy),
        decided: &mut dyn FnMut(Decision<'_>),
        progress: &(impl Fn(Progress) + Sync),
        interrupt: &Interrupt,
    ) -> Result<ContractedGraph, Interrupted> {
        let (context, total) = (self.context(space), self.subgoals.len());
        let mut contraction = Contraction::new(total, edges, context, interrupt.clone())?;
        let mut report = |done| progress(Progress { stage: Stage::Hierarchy, done, total });
        match hierarchy.levels() {
            None => contraction.contract_by_priority(&mut report)?,
            Some(levels) => contraction.contract_levels(levels - 1, &mut report, decided)?,
        }
        Ok(contraction.finish())
    }

    pub(crate) fn into_graph(
        self,
        space: &FreeSpace<P>,
        hierarchy: Hierarchy,
        contracted: &ContractedGraph,
        interrupt: &Interrupt,
    ) -> Result<SubgoalGraph<P>, SubgoalError> {
        let count = contracted.arcs.total();
        if count > MAX_ARCS as usize {
            return Err(SubgoalError::Arcs { count, most: MAX_ARCS });
        }
        room_for::<UpwardArc>(count, "packing the graph of subgoals")?;
        let packed = pack(contracted);
        self.graph(space, hierarchy, packed).with_costs(space, interrupt)
    }

    /// The graph with these offsets and arcs.
    pub(crate) fn graph(
        self,
        space: &FreeSpace<P>,
        hierarchy: Hierarchy,
        (offsets, arcs): (Box<[u32]>, Box<[UpwardArc]>),
    ) -> SubgoalGraph<P> {
        let Self { subgoals, metric, tables, k, criterion } = self;
        let identity = Identity { k: Some(k), ..space.identity() };
        SubgoalGraph { identity, subgoals, tables, metric, k, criterion, hierarchy, offsets, arcs }
    }
}

/// The offsets and arcs of a graph, without costs.
fn pack(graph: &ContractedGraph) -> (Box<[u32]>, Box<[UpwardArc]>) {
    let (mut offsets, mut arcs) = (Vec::with_capacity(graph.arcs.len() + 1), Vec::new());
    for (around, is_contracted) in graph.arcs.iter().zip(&graph.contracted) {
        offsets.push(2 * arcs.len() as u32 + u32::from(!is_contracted));
        arcs.extend(around.iter().map(|arc| UpwardArc::without_cost(arc.to, arc.middle)));
    }
    offsets.push(2 * arcs.len() as u32);
    (offsets.into_boxed_slice(), arcs.into_boxed_slice())
}

impl<P: EdgeFinder> SubgoalGeometry for BuildContext<'_, P> {
    fn vertex(&self, id: u32) -> Vertex {
        self.subgoals.vertex(id)
    }

    fn bends(&self, id: u32) -> Option<BendRule> {
        let at = self.subgoals.vertex(id);
        match self.criterion {
            EdgeCriterion::Direct => BendRule::of_shortest(self.space, self.k, at),
            EdgeCriterion::Taut => Some(BendRule::taut(self.space.grid(), at)),
        }
    }

    fn distance(&self, from: u32, to: u32) -> u128 {
        let v = self.subgoals.vertex(from).to(self.subgoals.vertex(to));
        match self.criterion {
            // The levels of the papers keep distances by h_k alone.
            EdgeCriterion::Direct => self.metric.distance(v).to_bits().into(),
            EdgeCriterion::Taut => self.metric.lexicographic_length(v),
        }
    }
}

/// Every edge of the graph, from one of its ends.
fn find_edges<P: EdgeFinder>(
    context: BuildContext<'_, P>,
    progress: &(impl Fn(usize) + Sync),
    interrupt: &Interrupt,
) -> Result<Vec<(u32, u32)>, Interrupted> {
    let chunks = in_chunks(context.subgoals.len(), P::Scratch::default, progress, |scratch, ids| {
        let mut edges = Vec::new();
        for from in ids {
            interrupt.check(DURING)?;
            P::edges_from(context, scratch, context.subgoals.vertex(from), EdgeKind::Graph, |to, _| {
                edges.push((from, to));
            });
        }
        Ok(edges)
    })?;
    room_for::<(u32, u32)>(chunks.iter().map(Vec::len).sum(), DURING)?;
    Ok(chunks.concat())
}
