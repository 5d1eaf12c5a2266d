//! Labels of vertices as bytes.

use mediant_grid::Interrupted;

use super::{BLOCK, NONE, Span, VertexLabels};
use crate::{
    labels::pack::{Packed, PathStep},
    parts::{Reader, Writer},
    subgoals::Subgoals,
};

impl VertexLabels {
    pub(in crate::labels) fn write(&self, out: &mut Writer<'_>) -> Result<(), Interrupted> {
        let Self { blocks, spans, words } = self;
        out.part32(blocks.iter().copied())?;
        out.pairs32(spans, |span| [span.word, span.leading])?;
        out.part64(words)
    }

    /// The labels that were written for a map with so many blocks of vertices, and these labels of these
    /// subgoals; `None` if they are none of such a map.
    pub(in crate::labels) fn read(
        reader: &mut Reader<'_>,
        count: usize,
        (packed, subgoals): (&Packed, &Subgoals),
    ) -> Option<Self> {
        let blocks: Box<[u32]> = reader.part32()?.collect();
        let spans = reader.pairs32(|[word, leading]| Span { word, leading })?;
        let read = Self { blocks, spans, words: reader.part64()? };
        let Self { blocks, spans, words } = &read;
        let vertices = spans.len().saturating_sub(1);
        let begins = |&block: &u32| {
            block == NONE || (block as usize).is_multiple_of(BLOCK) && (block as usize) < vertices
        };
        let is_label = |label: &u64| packed.may_hold(*label, subgoals.len());
        let is_step = |&word: &u64| subgoals.id(PathStep::from_word(word).at()).is_some();
        let holds = |ends: &[Span]| {
            let own = words.get(ends[0].word as usize..ends[1].word as usize)?;
            let (pairs, seen) = own.split_at_checked((ends[0].leading as usize).checked_mul(2)?)?;
            let (pairs, _) = pairs.as_chunks();
            let fits = pairs.iter().all(|[label, step]| is_label(label) && is_step(step));
            Some(fits && seen.iter().all(is_label))
        };
        let is_whole =
            if spans.is_empty() { blocks.is_empty() && words.is_empty() } else { blocks.len() == count };
        let fits = is_whole
            && vertices.is_multiple_of(BLOCK)
            && blocks.iter().all(begins)
            && spans.windows(2).all(|ends| holds(ends) == Some(true));
        fits.then_some(read)
    }
}
