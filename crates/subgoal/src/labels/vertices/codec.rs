//! Labels of vertices as bytes.

use mediant_grid::Interrupted;

use super::{BLOCK, NONE, Span, VertexLabels};
use crate::{
    labels::pack::{Packed, PathStep},
    parts::{Reader, Writer},
};

impl VertexLabels {
    pub(in crate::labels) fn write(&self, out: &mut Writer<'_>) -> Result<(), Interrupted> {
        let Self { blocks, spans, labels, steps } = self;
        out.part32(blocks.iter().copied())?;
        out.pairs32(spans, |span| [span.label, span.step])?;
        out.part64(labels)?;
        out.pairs32(steps, |step| step.to_words())
    }

    /// The labels that were written for a map with so many blocks of vertices, these labels of subgoals, and
    /// so many of these; `None` if they are none of such a map.
    pub(in crate::labels) fn read(
        reader: &mut Reader<'_>,
        count: usize,
        (packed, subgoals): (&Packed, usize),
    ) -> Option<Self> {
        let blocks: Box<[u32]> = reader.part32()?.collect();
        let spans = reader.pairs32(|[label, step]| Span { label, step })?;
        let labels = reader.part64()?;
        let steps = reader.pairs32(PathStep::from_words)?;
        let vertices = spans.len().saturating_sub(1);
        let fits = if blocks.is_empty() {
            spans.is_empty() && labels.is_empty() && steps.is_empty()
        } else {
            let begins = |&block: &u32| {
                block == NONE || (block as usize).is_multiple_of(BLOCK) && (block as usize) < vertices
            };
            let (first, last) = (spans.first()?, spans.last()?);
            blocks.len() == count
                && vertices.is_multiple_of(BLOCK)
                && blocks.iter().all(begins)
                && *first == Span::default()
                && [last.label as usize, last.step as usize] == [labels.len(), steps.len()]
                && spans.is_sorted_by(|a, b| a.label <= b.label && a.step <= b.step)
                && labels.iter().all(|&label| packed.may_hold(label, subgoals))
        };
        fits.then_some(Self { blocks, spans, labels, steps })
    }
}
