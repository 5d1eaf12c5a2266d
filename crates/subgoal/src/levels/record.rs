//! Making a graph with its record.

use mediant_grid::{Corners, FreeSpace, Interrupt};
use mediant_moves::K;

use super::{Bounds, Edges, LevelRecord, NONE};
use crate::{
    build::Ground,
    chunks::in_chunks,
    corners::{CornerScratch, edge_bounds},
    error::SubgoalError,
    graph::SubgoalGraph,
    hierarchy::Hierarchy,
    placement::EdgeCriterion,
    progress::Progress,
};

impl SubgoalGraph<Corners> {
    /// [`with_progress`](Self::with_progress), and the record by which the graph can follow edits of the map;
    /// `None` for a contraction hierarchy and at any angle.
    ///
    /// # Errors
    /// As for [`with_progress`](Self::with_progress).
    pub fn with_record(
        space: &FreeSpace<Corners>,
        k: K,
        hierarchy: Hierarchy,
        progress: &(impl Fn(Progress) + Sync),
        interrupt: &Interrupt,
    ) -> Result<(Self, Option<LevelRecord>), SubgoalError> {
        let hierarchy = hierarchy.with_a_code();
        let ground = Ground::new(space, k, hierarchy, interrupt)?;
        let (context, count) = (ground.context(space), ground.subgoals.len());
        let edges = ground.edges(space, progress, interrupt)?;
        let mut read = vec![Bounds::EMPTY; count];
        let mut level = vec![NONE; count];
        let mut made = vec![Vec::new(); count];
        let mut decided = |(number, id, bounds, shortcuts): crate::contract::Decision<'_>| {
            read[id as usize].join(bounds);
            if let Some(shortcuts) = shortcuts {
                level[id as usize] = number;
                made[id as usize].clone_from(shortcuts);
            }
        };
        let contracted =
            ground.contracted_from(&edges, (space, hierarchy), &mut decided, progress, interrupt)?;
        let is_recorded = ground.criterion == EdgeCriterion::Direct && hierarchy.levels().is_some();
        let record = if is_recorded {
            let chunks = in_chunks(count, CornerScratch::default, &|_| {}, |scratch, ids| {
                interrupt.check("finding the edges of subgoals")?;
                Ok(ids.map(|id| edge_bounds(context, scratch, context.subgoals.vertex(id))).collect())
            })?;
            let chunks: Vec<Vec<Bounds>> = chunks;
            let part = |from: u32| {
                let [first, end] = [from, from + 1].map(|id| edges.partition_point(|edge| edge.0 < id));
                edges[first..end].iter().map(|edge| edge.1)
            };
            let (first, shortcuts) = pack(&made);
            Some(LevelRecord {
                edges: Edges::new(count, part),
                seen: chunks.concat().into(),
                read: read.into(),
                level: level.into(),
                first,
                shortcuts,
            })
        } else {
            None
        };
        let graph = ground.into_graph(space, hierarchy, &contracted, interrupt)?;
        Ok((graph, record))
    }
}

/// The first shortcut of each subgoal, and the shortcuts of all.
type PackedShortcuts = (Box<[u32]>, Box<[(u32, u32)]>);

/// The shortcuts of all subgoals in one array, with the number of the first one of each.
pub(super) fn pack(shortcuts: &[impl AsRef<[(u32, u32)]>]) -> PackedShortcuts {
    let mut first = Vec::with_capacity(shortcuts.len() + 1);
    let mut all = Vec::new();
    for made in shortcuts {
        first.push(all.len() as u32);
        all.extend_from_slice(made.as_ref());
    }
    first.push(all.len() as u32);
    (first.into(), all.into())
}
