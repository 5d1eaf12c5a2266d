//! Labels of vertices: what memory to spare buys.
//!
//! An end of a query looks up the subgoals that it sees, 20 to 130 of them, finds out over which of them
//! shortest paths lead on, and reads the labels of these. A vertex can have labels of its own instead: its
//! hubs, and the subgoals that it sees, with the costs from the vertex. Such an end reads 30 to 150 numbers
//! in a row. They take 30 to 100 times the memory of the labels of subgoals: so there are as many as fit, by
//! blocks of 8 × 8 vertices ([`find`]). A query whose ends have some, or one of them, or none, is answered
//! alike.
//!
//! **Fewer.** A hub is dropped if the way to it over another hub of the vertex costs less: then no shortest
//! path from there leads over the first. What costs as much stays: the least cost over N(k) does not tell the
//! shortest line.

mod codec;
mod find;

use mediant_grid::Vertex;

use super::pack::PathStep;
use crate::seen::SIDE;

/// The vertices of a block.
const BLOCK: usize = (SIDE * SIDE) as usize;

/// The labels of the vertices of some blocks.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct VertexLabels {
    /// By block, the number of its first vertex among those that have labels; [`NONE`] if it has none. Empty
    /// if no block has labels.
    blocks: Box<[u32]>,
    /// By vertex of the blocks that have labels, and one more that ends the last.
    spans: Box<[Span]>,
    /// The hub, and in the lowest bits the cost, as those of subgoals. First those whose paths lead on over
    /// another subgoal, then the subgoals that the vertex sees; both from the nearest hub on.
    labels: Box<[u64]>,
    /// The first steps of the paths of the first ones.
    steps: Box<[PathStep]>,
}

/// The number of a block without labels.
const NONE: u32 = u32::MAX;

/// Where the labels of a vertex begin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Span {
    label: u32,
    step: u32,
}

impl Span {
    /// The span of labels that are moved behind others.
    const fn after(self, begin: Self) -> Self {
        Self { label: self.label + begin.label, step: self.step + begin.step }
    }
}

/// The labels of one vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfVertex<'l> {
    pub(super) labels: &'l [u64],
    steps: &'l [PathStep],
}

impl OfVertex<'_> {
    /// The first step of the path of a label, by its number; `None` if the vertex sees the hub.
    pub(super) fn step(self, label: u32) -> Option<PathStep> {
        self.steps.get(label as usize).copied()
    }
}

impl VertexLabels {
    /// The labels of a vertex, if it has any. `columns` are the blocks of a row.
    #[inline]
    pub(super) fn of(&self, columns: u32, at: Vertex) -> Option<OfVertex<'_>> {
        let block = (at.y / SIDE) as u32 * columns + (at.x / SIDE) as u32;
        let first = *self.blocks.get(block as usize)?;
        let vertex = first as usize + ((at.y % SIDE) * SIDE + at.x % SIDE) as usize;
        let &[span, end] = self.spans.get(vertex..)?.first_chunk()?;
        let labels = self.labels.get(span.label as usize..end.label as usize)?;
        Some(OfVertex { labels, steps: self.steps.get(span.step as usize..end.step as usize)? })
    }

    /// The number of labels.
    pub(super) const fn len(&self) -> usize {
        self.labels.len()
    }

    /// The memory used, in bytes.
    pub(super) const fn memory_bytes(&self) -> usize {
        let Self { blocks, spans, labels, steps } = self;
        size_of_val(&**blocks) + size_of_val(&**spans) + size_of_val(&**labels) + size_of_val(&**steps)
    }
}
