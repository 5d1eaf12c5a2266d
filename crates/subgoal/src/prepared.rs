//! Subgoals as the map decides: hub labels, a graph, or nothing.

use mediant_grid::{FreeSpace, Identity, Interrupt};
use mediant_moves::K;

use crate::{
    build::Ground,
    codec::{LABELS, NOTHING, after_identity},
    error::SubgoalError,
    graph::SubgoalGraph,
    hierarchy::Hierarchy,
    labels::HubLabels,
    placement::SubgoalPlacement,
    progress::Progress,
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
    /// `unprepared` is the engine that prepares nothing. It is asked only where labels do not fit; if it
    /// takes less work than a contraction hierarchy with a large core, nothing is kept. It should be
    /// [`BlockJps`](mediant_search::BlockJps) up to k = 3, at corners [`Anya`](mediant_search::Anya) beyond:
    /// their times are known. Without such an engine it is `&mut |_| Ok(None)`.
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
        labels.map_or(Ok(()), |labels| labels.check(space))?;
        let ground = Ground::new(space, k.into(), Hierarchy::Contracted, interrupt)?;
        let contracted = ground.contracted(space, Hierarchy::Contracted, progress, interrupt)?;
        match HubLabels::of_contraction(space, &ground, &contracted, labels, most, (progress, interrupt)) {
            Ok(labels) => return Ok(Self::Labels(labels)),
            Err(error @ SubgoalError::Interrupted(_)) => return Err(error),
            // There is no room for labels.
            Err(_) => {}
        }
        let graph = ground.into_graph(space, Hierarchy::Contracted, &contracted, interrupt)?;
        let is_outdone = is_outdone(space, &graph, unprepared, interrupt)?;
        Ok(if is_outdone { Self::Nothing(graph.identity()) } else { Self::Contracted(graph) })
    }

    /// The bytes of the labels or of the graph, for [`from_bytes`](Self::from_bytes); where neither is kept,
    /// an identity and a code.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        match self {
            Self::Labels(labels) => labels.to_bytes(),
            Self::Contracted(graph) => graph.to_bytes(),
            Self::Nothing(identity) => [&identity.to_bytes()[..], &NOTHING.to_le_bytes()].concat(),
        }
    }

    /// Reads the bytes of [`to_bytes`](Self::to_bytes) for the same free space and k. A graph may have
    /// levels.
    ///
    /// # Errors
    /// As for [`HubLabels::from_bytes`] and [`SubgoalGraph::from_bytes`].
    pub fn from_bytes(space: &FreeSpace<P>, k: impl Into<K>, bytes: &[u8]) -> Result<Self, SubgoalError> {
        Self::from_bytes_interruptible(space, k, bytes, &Interrupt::NEVER)
    }

    /// [`from_bytes`](Self::from_bytes), which an interrupt can stop.
    ///
    /// # Errors
    /// As for [`from_bytes`](Self::from_bytes), and [`SubgoalError::Interrupted`].
    pub fn from_bytes_interruptible(
        space: &FreeSpace<P>,
        k: impl Into<K>,
        bytes: &[u8],
        interrupt: &Interrupt,
    ) -> Result<Self, SubgoalError> {
        let k = k.into();
        let identity = Identity { k: Some(k), ..space.identity() };
        let rest = after_identity(bytes, identity)?;
        match rest.split_first_chunk().map(|(&code, rest)| (u32::from_le_bytes(code), rest)) {
            Some((LABELS, _)) => {
                HubLabels::from_bytes_interruptible(space, k, bytes, interrupt).map(Self::Labels)
            }
            Some((NOTHING, [])) => P::check(space, k).map(|()| Self::Nothing(identity)),
            _ => SubgoalGraph::from_bytes_interruptible(space, k, bytes, interrupt).map(Self::Contracted),
        }
    }
}
