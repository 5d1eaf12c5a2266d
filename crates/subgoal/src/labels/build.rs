//! Building hub labels within a budget of memory.

use std::{marker::PhantomData, sync::Arc};

use mediant_grid::{FreeSpace, Identity, Interrupt};
use mediant_moves::K;

use super::{
    Geometry, HubLabels,
    chain::pack,
    lists::LabelLists,
    merge::merge,
    pack::{Packed, form},
    vertices::VertexLabels,
    whole::keep_whole,
};
use crate::{
    build::Ground,
    contract::{ContractedGraph, SubgoalGeometry},
    error::SubgoalError,
    hierarchy::Hierarchy,
    placement::{BuildContext, SubgoalPlacement},
    progress::{Progress, Stage},
    seen::SeenIndex,
};

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
        beside.map_or(Ok(()), |labels| labels.check(space))?;
        let ground = Ground::new(space, k, Hierarchy::Contracted, interrupt)?;
        let contracted = ground.contracted(space, Hierarchy::Contracted, progress, interrupt)?;
        Self::of_contraction(space, &ground, &contracted, beside, most, (progress, interrupt))
    }

    /// The hub labels of a contraction, beside those of the same free space for another k.
    pub(crate) fn of_contraction(
        space: &FreeSpace<P>,
        ground: &Ground<P>,
        contracted: &ContractedGraph,
        beside: Option<&Self>,
        most: usize,
        (progress, interrupt): (&(impl Fn(Progress) + Sync), &Interrupt),
    ) -> Result<Self, SubgoalError> {
        let shared = beside.filter(|_| P::SHARES_SIGHT).map(|labels| &labels.geometry);
        let (geometry, packed) = parts(space, ground, shared, contracted, most, (progress, interrupt))?;
        let Ground { metric, criterion, k, .. } = *ground;
        let identity = Identity { k: Some(k), ..space.identity() };
        let vertices = VertexLabels::default();
        Ok(Self { identity, geometry, metric, k, criterion, packed, vertices, placement: PhantomData })
    }
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
    let packed = pack(context, labels, interrupt)?.ok_or(SubgoalError::Labels)?;
    if packed.memory_bytes() <= rest { Ok((geometry, packed)) } else { Err(more()) }
}

/// The labels of all subgoals; `None` if there are more than `most`.
pub(super) fn whole_labels<P: SubgoalPlacement>(
    context: BuildContext<'_, P>,
    contracted: &ContractedGraph,
    most: usize,
    progress: &mut dyn FnMut(usize),
    interrupt: &Interrupt,
) -> Result<Option<LabelLists>, SubgoalError> {
    let labels = merge(contracted, &context, form(context), most, progress, interrupt)?;
    let Some(mut labels) = labels else { return Ok(None) };
    keep_whole(&mut labels, interrupt, |from, to| context.distance(from, to))?;
    Ok(Some(labels))
}
