//! The index: subgoals, and the graph on them.

use std::num::NonZeroU32;

use mediant_grid::{FreeSpace, Vector, Vertex};
use mediant_moves::K;

use crate::{
    SubgoalError, SubgoalPlacement,
    contract::{Contraction, NONE, Rules},
    norm::Norm,
    placement::{BuildContext, EdgeKind, Edges},
    subgoals::Subgoals,
    taut::Bend,
};

/// Which subgoals a search can leave out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Hierarchy {
    /// A contraction hierarchy (Uras & Koenig 2018): all subgoals but those of a dense core are ordered, and shortcuts are added so that a search has
    /// only to go up from the start and from the goal.
    #[default]
    Contracted,
    /// So many levels (Uras, Koenig & Hernández 2013): 1 is the graph of all subgoals; on each further level those are left
    /// that distances need.
    Levels(NonZeroU32),
    /// As many levels as there are.
    AllLevels,
}

/// How far the making of an index is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// What is being done.
    pub stage: Stage,
    /// How much of it is done.
    pub done: usize,
    /// Out of how much.
    pub total: usize,
}

/// The stages of making an index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Finding the edges, subgoal by subgoal.
    Edges,
    /// Making the hierarchy, subgoal by subgoal.
    Hierarchy,
}

/// An arc of the graph, upward.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct UpwardArc {
    pub(crate) cost: u64,
    pub(crate) to: u32,
    /// The subgoal that a shortcut leads over; [`NONE`] for an edge.
    pub(crate) mid: u32,
    /// The first and the last step of the way, from subgoal to subgoal.
    pub(crate) first: Step,
    pub(crate) last: Step,
}

impl UpwardArc {
    /// A way whose costs are not known yet.
    pub(crate) const fn to(to: u32, mid: u32) -> Self {
        Self { cost: 0, to, mid, first: Step(0, 0), last: Step(0, 0) }
    }
}

/// A displacement in little space; zero where it does not fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Step(i16, i16);

/// How a search came to a subgoal: what the way from its parent leads over, and its last step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ParentEdge {
    pub(crate) mid: u32,
    pub(crate) step: Step,
}

impl Step {
    pub(crate) fn of(v: Vector) -> Self {
        let fits = v.x.abs().max(v.y.abs()) <= i32::from(i16::MAX);
        if fits { Self(v.x as i16, v.y as i16) } else { Self::default() }
    }

    /// The way back.
    pub(crate) const fn back(self) -> Self {
        // No component is the least `i16`: a side has at most 2¹⁵ cells, and 2¹⁵ does not fit.
        Self(self.0.wrapping_neg(), self.1.wrapping_neg())
    }

    /// The displacement, if it is known.
    #[inline]
    pub(crate) fn vector(self) -> Option<Vector> {
        (self != Self::default()).then(|| Vector::new(self.0.into(), self.1.into()))
    }
}

/// A subgoal graph: the index that planners search. Immutable, and shared by any number of them.
#[derive(Clone, Debug)]
pub struct SubgoalGraph<P: SubgoalPlacement> {
    pub(crate) subgoals: Subgoals<P::Prepared>,
    pub(crate) norm: Norm,
    pub(crate) k: K,
    pub(crate) edges: Edges,
    pub(crate) hierarchy: Hierarchy,
    /// Twice the number of the subgoal's first arc, plus 1 if it belongs to the core.
    pub(crate) offsets: Box<[u32]>,
    pub(crate) arcs: Box<[UpwardArc]>,
}

impl<P: SubgoalPlacement> SubgoalGraph<P> {
    /// The subgoal graph of a free space for paths over N(k), or at any angle.
    ///
    /// # Errors
    /// [`SubgoalError`] where the placement has none for this k and rule.
    pub fn new(space: &FreeSpace<P>, k: impl Into<K>, hierarchy: Hierarchy) -> Result<Self, SubgoalError> {
        Self::with_progress(space, k.into(), hierarchy, &|_| {})
    }

    /// [`new`](Self::new), telling `progress` how far it is, from any thread.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_progress(
        space: &FreeSpace<P>,
        k: K,
        hierarchy: Hierarchy,
        progress: &(impl Fn(Progress) + Sync),
    ) -> Result<Self, SubgoalError> {
        P::check(space, k)?;
        let hierarchy = match hierarchy {
            Hierarchy::Levels(NonZeroU32::MAX) => Hierarchy::AllLevels,
            other => other,
        };
        let norm = Norm::new(k)?;
        let subgoals = Subgoals::new(P::prepare(space));
        let total = subgoals.len();
        let edges = P::edges(k, hierarchy);
        let map = BuildContext { space, subgoals: &subgoals, norm: &norm, k, edges };
        let found = find_edges(map, &|done| progress(Progress { stage: Stage::Edges, done, total }));
        let mut contraction = Contraction::new(total, &found, map);
        let mut step = |done| progress(Progress { stage: Stage::Hierarchy, done, total });
        match hierarchy {
            Hierarchy::Contracted => contraction.take_out_most(&mut step),
            Hierarchy::AllLevels => while contraction.take_out_a_level(&mut step) {},
            Hierarchy::Levels(levels) => {
                for _ in 1..levels.get() {
                    if !contraction.take_out_a_level(&mut step) {
                        break;
                    }
                }
            }
        }
        let contracted = contraction.finish();
        let (mut offsets, mut arcs) = (Vec::with_capacity(total + 1), Vec::new());
        for (around, taken) in contracted.arcs.iter().zip(&contracted.taken) {
            offsets.push(2 * arcs.len() as u32 + u32::from(!taken));
            arcs.extend(around.iter().map(|arc| UpwardArc::to(arc.to, arc.mid)));
        }
        offsets.push(2 * arcs.len() as u32);
        let (offsets, arcs) = (offsets.into_boxed_slice(), arcs.into_boxed_slice());
        let graph = Self { subgoals, norm, k, edges, hierarchy, offsets, arcs };
        graph.with_costs(space)
    }
}

impl<P: SubgoalPlacement> SubgoalGraph<P> {
    /// The number of subgoals.
    #[must_use]
    pub const fn subgoals(&self) -> usize {
        self.subgoals.len()
    }

    /// The subgoals, row by row.
    pub fn vertices(&self) -> impl Iterator<Item = Vertex> {
        (0..self.subgoals() as u32).map(|id| self.subgoals.vertex(id))
    }

    /// The arcs that are stored and are no shortcuts, each once.
    pub fn edges(&self) -> impl Iterator<Item = (Vertex, Vertex)> {
        (0..self.subgoals() as u32).flat_map(move |id| {
            // Those of the core are stored at both ends.
            let is_edge = move |arc: &&UpwardArc| arc.mid == NONE && (id < arc.to || !self.is_core(id));
            let ends = move |arc: &UpwardArc| (self.subgoals.vertex(id), self.subgoals.vertex(arc.to));
            self.up(id).iter().filter(is_edge).map(ends)
        })
    }

    /// The number of arcs that are stored: those of a subgoal of the core to others of the core, and of another subgoal to those
    /// above it.
    #[must_use]
    pub const fn arcs(&self) -> usize {
        self.arcs.len()
    }

    /// How many subgoals belong to the core, or to the highest level.
    #[must_use]
    pub fn core(&self) -> usize {
        (0..self.subgoals() as u32).filter(|&id| self.is_core(id)).count()
    }

    /// How many arcs lead from subgoals of the core to others of it; over their number, the branching factor of the highest level.
    #[must_use]
    pub fn core_arcs(&self) -> usize {
        (0..self.subgoals() as u32).filter(|&id| self.is_core(id)).map(|id| self.up(id).len()).sum()
    }

    /// The directions.
    #[must_use]
    pub const fn k(&self) -> K {
        self.k
    }

    /// The hierarchy.
    #[must_use]
    pub const fn hierarchy(&self) -> Hierarchy {
        self.hierarchy
    }

    /// The memory that it takes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.subgoals.memory_bytes() + size_of_val(&*self.offsets) + size_of_val(&*self.arcs)
    }

    /// Whether a subgoal belongs to the core.
    #[inline]
    pub(crate) fn is_core(&self, id: u32) -> bool {
        self.offsets[id as usize] & 1 == 1
    }

    /// The arcs of a subgoal, upward or in the core.
    #[inline]
    pub(crate) fn up(&self, id: u32) -> &[UpwardArc] {
        let [first, end] = [id, id + 1].map(|id| (self.offsets[id as usize] / 2) as usize);
        &self.arcs[first..end]
    }

    /// The arc from one subgoal to another.
    pub(crate) fn arc(&self, from: u32, to: u32) -> Option<UpwardArc> {
        self.up(from).iter().copied().find(|arc| arc.to == to)
    }
}

impl<P: SubgoalPlacement> Rules for BuildContext<'_, P> {
    fn vertex(&self, id: u32) -> Vertex {
        self.subgoals.vertex(id)
    }

    fn bend(&self, id: u32) -> Option<Bend> {
        Bend::of_lightest(self.space, self.k, self.edges, self.subgoals.vertex(id))
    }

    fn weight(&self, from: u32, to: u32) -> u128 {
        let way = self.subgoals.vertex(from).to(self.subgoals.vertex(to));
        match self.edges {
            // A level leaves out what h_k alone does not need.
            Edges::Direct => self.norm.length(way).to_bits().into(),
            Edges::Taut => self.norm.weight(way),
        }
    }
}

/// Every edge of the graph, from one of its ends.
fn find_edges<P: SubgoalPlacement>(
    map: BuildContext<'_, P>,
    progress: &(impl Fn(usize) + Sync),
) -> Vec<(u32, u32)> {
    const CHUNK: usize = 64;
    let count = map.subgoals.len();
    let done = std::sync::atomic::AtomicUsize::new(0);
    let chunk = |scratch: &mut P::Scratch, chunk: usize| {
        let ids = chunk * CHUNK..count.min((chunk + 1) * CHUNK);
        let mut edges = Vec::new();
        for id in ids.clone() {
            let from = id as u32;
            P::links(map, scratch, map.subgoals.vertex(from), EdgeKind::Edges, |to, _| {
                edges.push((from, to))
            });
        }
        let done = done.fetch_add(ids.len(), std::sync::atomic::Ordering::Relaxed) + ids.len();
        progress(done);
        edges
    };
    let chunks = 0..count.div_ceil(CHUNK);
    #[cfg(feature = "parallel")]
    let edges: Vec<_> = {
        use rayon::prelude::*;
        chunks.into_par_iter().map_init(P::Scratch::default, chunk).collect()
    };
    #[cfg(not(feature = "parallel"))]
    let edges: Vec<_> = {
        let mut scratch = P::Scratch::default();
        chunks.map(|number| chunk(&mut scratch, number)).collect()
    };
    edges.concat()
}

impl<P: SubgoalPlacement> SubgoalGraph<P> {
    /// Tells the vertices of the subgoals on a way (from, to, over), without the first. `pending` is scratch memory.
    pub(crate) fn unpack(
        &self,
        way: (u32, u32, u32),
        pending: &mut Vec<(u32, u32, u32)>,
        tell: &mut impl FnMut(Vertex),
    ) {
        // The ways that remain to be told, the next one last.
        pending.clear();
        pending.push(way);
        while let Some((from, to, mid)) = pending.pop() {
            let halves = (mid != NONE).then(|| self.arc(mid, from).zip(self.arc(mid, to))).flatten();
            match halves {
                None => tell(self.subgoals.vertex(to)),
                Some((first, second)) => {
                    pending.push((mid, to, second.mid));
                    pending.push((from, mid, first.mid));
                }
            }
        }
    }
}
