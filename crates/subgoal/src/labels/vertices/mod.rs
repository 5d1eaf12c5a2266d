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
    /// The labels, as those of subgoals, from the nearest hub on: first those whose paths lead on over
    /// another subgoal, each with the [word](PathStep::to_word) of its first step, then the subgoals that
    /// the vertex sees. What a query reads lies together.
    words: Box<[u64]>,
}

/// The number of a block without labels.
const NONE: u32 = u32::MAX;

/// The place of a vertex's labels, which ends where that of the next vertex begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Span {
    word: u32,
    /// The number of labels with a first step.
    leading: u32,
}

/// The labels of one vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfVertex<'l> {
    /// The labels with a first step.
    leading: &'l [[u64; 2]],
    seen: &'l [u64],
}

impl<'l> OfVertex<'l> {
    /// The labels; their order numbers them.
    #[inline]
    pub(super) fn labels(self) -> impl Iterator<Item = u64> + 'l {
        self.leading.iter().map(|[label, _]| *label).chain(self.seen.iter().copied())
    }

    /// Reads a word of each line of memory.
    #[inline]
    pub(super) fn touch(self) -> u64 {
        let [of_leading, of_seen] = [self.leading.as_flattened(), self.seen];
        of_leading.iter().step_by(8).chain(of_seen.iter().step_by(8)).fold(0, |sum, word| sum ^ word)
    }

    /// The first step of the path of a label, by its number; `None` if the vertex sees the hub.
    #[inline]
    pub(super) fn step(self, number: u32) -> Option<PathStep> {
        self.leading.get(number as usize).map(|[_, step]| PathStep::from_word(*step))
    }
}

impl VertexLabels {
    /// The labels of a vertex, if it has any. `columns` are the blocks of a row.
    #[inline]
    pub(super) fn of(&self, columns: u32, at: Vertex) -> Option<OfVertex<'_>> {
        let block = (at.y / SIDE) as u32 * columns + (at.x / SIDE) as u32;
        let first = *self.blocks.get(block as usize)?;
        let vertex = first as usize + ((at.y % SIDE) * SIDE + at.x % SIDE) as usize;
        let &[Span { word, leading }, end] = self.spans.get(vertex..)?.first_chunk()?;
        let words = self.words.get(word as usize..end.word as usize)?;
        let (pairs, seen) = words.split_at_checked(2 * leading as usize)?;
        Some(OfVertex { leading: pairs.as_chunks().0, seen })
    }

    /// The number of labels.
    pub(super) fn len(&self) -> usize {
        let leading = self.spans.iter().map(|span| span.leading as usize);
        self.words.len() - leading.sum::<usize>()
    }

    /// The memory used, in bytes.
    pub(super) const fn memory_bytes(&self) -> usize {
        let Self { blocks, spans, words } = self;
        size_of_val(&**blocks) + size_of_val(&**spans) + size_of_val(&**words)
    }
}
