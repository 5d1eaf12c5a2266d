//! Building hub labels within a budget of memory.

use std::{marker::PhantomData, sync::Arc};

use mediant_grid::{FreeSpace, Identity, Interrupt, Interrupted};
use mediant_moves::K;

use super::{
    Geometry, HubLabels,
    chain::pack,
    merge::{Label, merge},
    pack::{Packed, in_cells},
    whole::keep_whole,
};
use crate::{
    build::Ground,
    contract::{ContractedGraph, SubgoalGeometry},
    error::SubgoalError,
    graph::SubgoalGraph,
    hierarchy::Hierarchy,
    placement::{BuildContext, SubgoalPlacement},
    progress::{Progress, Stage},
    seen::SeenIndex,
    worth::{Counted, is_outdone},
};

/// Subgoals prepared within a budget of memory: hub labels where they fit, a contraction hierarchy where they
/// do not. Both give optimal paths.
#[derive(Clone, Debug)]
pub enum PreparedSubgoals<P: SubgoalPlacement> {
    /// Hub labels.
    Labels(HubLabels<P>),
    /// A contraction hierarchy.
    Contracted(SubgoalGraph<P>),
    /// Neither, and what they would belong to: the contraction left a large core, an engine that prepares
    /// nothing is faster, and nothing was kept.
    Nothing(Identity),
}

impl<P: SubgoalPlacement> PreparedSubgoals<P> {
    /// Prepares a free space for paths over N(k), or at any angle. `most` is the memory that labels may take,
    /// in bytes; a contraction hierarchy takes what it needs. Beside the `labels` of the same free space for
    /// another k it shares with them, at corners, all but the labels. The interrupt is asked for each row of
    /// the map and each subgoal.
    ///
    /// `unprepared` is the engine that prepares nothing. It is asked only where labels do not fit; if it takes
    /// less work than a contraction hierarchy with a large core, nothing is kept. It should be
    /// [`BlockJps`](mediant_search::BlockJps) up to k = 3, at corners [`Anya`](mediant_search::Anya) beyond: by
    /// how long these take, works are compared. Without such an engine it is `&mut |_| Ok(None)`.
    ///
    /// # Errors
    /// [`SubgoalError`] if the placement has no subgoal graph for this k and rule, if it would be too large,
    /// or if it was stopped; [`SubgoalError::Mismatch`] for labels of another free space.
    pub fn within(
        space: &FreeSpace<P>,
        k: impl Into<K>,
        labels: Option<&HubLabels<P>>,
        most: usize,
        (progress, interrupt): (&(impl Fn(Progress) + Sync), &Interrupt),
        unprepared: &mut Counted<'_>,
    ) -> Result<Self, SubgoalError> {
        let shared = shared(space, labels)?;
        let ground = Ground::new(space, k.into(), Hierarchy::Contracted, interrupt)?;
        let contracted = ground.contracted(space, Hierarchy::Contracted, progress, interrupt)?;
        match parts(space, &ground, shared, &contracted, most, (progress, interrupt)) {
            Ok(parts) => return Ok(Self::Labels(HubLabels::from_parts(space, ground, parts))),
            Err(error @ SubgoalError::Interrupted(_)) => return Err(error),
            // There is no room for labels.
            Err(_) => {}
        }
        let graph = ground.into_graph(space, Hierarchy::Contracted, &contracted, interrupt)?;
        let is_outdone = is_outdone(space, &graph, unprepared, interrupt)?;
        Ok(if is_outdone { Self::Nothing(graph.identity()) } else { Self::Contracted(graph) })
    }
}

impl<P: SubgoalPlacement> HubLabels<P> {
    /// The hub labels of a free space for paths over N(k), or at any angle. `most` is the memory that they
    /// may take, in bytes.
    ///
    /// # Errors
    /// [`SubgoalError`] if the placement has no subgoal graph for this k and rule; [`SubgoalError::Core`] if
    /// the contraction leaves a core, [`SubgoalError::Memory`] if the labels take more than `most` bytes.
    pub fn within(
        space: &FreeSpace<P>,
        k: impl Into<K>,
        most: usize,
        progress: &(impl Fn(Progress) + Sync),
        interrupt: &Interrupt,
    ) -> Result<Self, SubgoalError> {
        Self::new(space, k.into(), None, most, (progress, interrupt))
    }

    /// [`within`](Self::within) for another k of the same free space: at corners it shares with these all but
    /// the labels.
    ///
    /// # Errors
    /// As for [`within`](Self::within), and [`SubgoalError::Mismatch`] for another free space.
    pub fn for_k(
        &self,
        space: &FreeSpace<P>,
        k: impl Into<K>,
        most: usize,
        progress: &(impl Fn(Progress) + Sync),
        interrupt: &Interrupt,
    ) -> Result<Self, SubgoalError> {
        Self::new(space, k.into(), Some(self), most, (progress, interrupt))
    }

    fn new(
        space: &FreeSpace<P>,
        k: K,
        beside: Option<&Self>,
        most: usize,
        (progress, interrupt): (&(impl Fn(Progress) + Sync), &Interrupt),
    ) -> Result<Self, SubgoalError> {
        let shared = shared(space, beside)?;
        let ground = Ground::new(space, k, Hierarchy::Contracted, interrupt)?;
        let contracted = ground.contracted(space, Hierarchy::Contracted, progress, interrupt)?;
        let parts = parts(space, &ground, shared, &contracted, most, (progress, interrupt))?;
        Ok(Self::from_parts(space, ground, parts))
    }

    fn from_parts(
        space: &FreeSpace<P>,
        ground: Ground<P>,
        (geometry, packed): (Arc<Geometry>, Packed),
    ) -> Self {
        let Ground { metric, criterion, k, .. } = ground;
        let identity = Identity { k: Some(k), ..space.identity() };
        Self { identity, geometry, metric, k, criterion, packed, placement: PhantomData }
    }
}

/// The geometry that labels for another k share with these, if these belong to the free space.
fn shared<'s, P: SubgoalPlacement>(
    space: &FreeSpace<P>,
    beside: Option<&'s HubLabels<P>>,
) -> Result<Option<&'s Arc<Geometry>>, SubgoalError> {
    beside.map_or(Ok(()), |labels| labels.check(space))?;
    Ok(beside.filter(|_| P::SHARES_SIGHT).map(|labels| &labels.geometry))
}

/// The geometry, which is that of the map, and the labels.
fn parts<P: SubgoalPlacement>(
    space: &FreeSpace<P>,
    ground: &Ground<P>,
    shared: Option<&Arc<Geometry>>,
    contracted: &ContractedGraph,
    most: usize,
    (progress, interrupt): (&(impl Fn(Progress) + Sync), &Interrupt),
) -> Result<(Arc<Geometry>, Packed), SubgoalError> {
    let core = contracted.contracted.iter().filter(|&is_contracted| !is_contracted).count();
    if core > 0 {
        return Err(SubgoalError::Core { core, subgoals: contracted.contracted.len() });
    }
    let (context, total) = (ground.context(space), ground.subgoals.len());
    let report = |stage| move |done| progress(Progress { stage, done, total });
    let more = || SubgoalError::Memory { most };
    let geometry = match shared {
        Some(geometry) => Arc::clone(geometry),
        None => {
            let rest = most.checked_sub(ground.subgoals.memory_bytes()).ok_or_else(more)?;
            let seen = SeenIndex::new(context, rest, &report(Stage::Sight), interrupt)?.ok_or_else(more)?;
            Arc::new(Geometry { subgoals: ground.subgoals.clone(), seen })
        }
    };
    let rest = most.checked_sub(geometry.memory_bytes()).ok_or_else(more)?;
    let most_labels = rest / size_of::<u64>();
    let labels = whole_labels(context, contracted, most_labels, &mut report(Stage::Labels), interrupt)?;
    let labels = labels.ok_or_else(more)?;
    let packed = pack(context, &labels, interrupt)?.ok_or(SubgoalError::Labels)?;
    if packed.memory_bytes() <= rest { Ok((geometry, packed)) } else { Err(more()) }
}

/// The labels of all subgoals; `None` if there are more than `most`.
pub(super) fn whole_labels<P: SubgoalPlacement>(
    context: BuildContext<'_, P>,
    contracted: &ContractedGraph,
    most: usize,
    progress: &mut dyn FnMut(usize),
    interrupt: &Interrupt,
) -> Result<Option<Vec<Vec<Label>>>, Interrupted> {
    let cut_off = in_cells(context);
    let Some(mut labels) = merge(contracted, &context, cut_off, most, progress, interrupt)? else {
        return Ok(None);
    };
    keep_whole(&mut labels, interrupt, |from, to| context.distance(from, to))?;
    Ok(Some(labels))
}
