//! A seen index as bytes.

use mediant_grid::Interrupted;

use super::{Block, CellIndex, SIDE, SeenEntry, SeenIndex};
use crate::parts::{Reader, Writer};

impl SeenIndex {
    pub(crate) fn write(&self, out: &mut Writer<'_>) -> Result<(), Interrupted> {
        let halves = |index: usize| {
            let Block { first, slot } = self.blocks[index / 2];
            if index.is_multiple_of(2) { first } else { slot }
        };
        out.part32((0..2 * self.blocks.len()).map(halves))?;
        out.part32(self.entries.iter().map(|entry| u32::from(entry.after) << 16 | u32::from(entry.mask)))?;
        out.part64(&self.masks)?;
        let (rows, entries) =
            self.cells.as_ref().map_or((&[][..], &[][..]), |cells| (&cells.rows, &cells.entries));
        out.part32(rows.iter().copied())?;
        out.part64(entries)
    }

    /// The index that was written, for a map with so many vertices and slots; `None` if it is none of such a
    /// map.
    pub(crate) fn read(reader: &mut Reader<'_>, (width, height): (u32, u32), slots: u32) -> Option<Self> {
        let [columns, rows] = [width, height].map(|side| side.div_ceil(SIDE as u32));
        let mut words = reader.part32()?;
        let mut blocks = Vec::with_capacity(words.len() / 2);
        while let Some((first, slot)) = words.next().zip(words.next()) {
            blocks.push(Block { first, slot });
        }
        let entry = |word: u32| SeenEntry { after: (word >> 16) as u16, mask: word as u16 };
        let entries: Box<[SeenEntry]> = reader.part32()?.map(entry).collect();
        let masks = reader.part64()?;
        let cells = CellIndex { rows: reader.part32()?.collect(), entries: reader.part64()? };
        let cells = cells.check(height.saturating_sub(1), slots)?;
        let index = Self { columns, blocks: blocks.into(), entries, masks, most: 0, cells };
        if index.blocks.len() != columns as usize * rows as usize + 1 {
            return None;
        }
        let most = index.most_of_a_block(slots)?;
        Some(Self { most, ..index })
    }

    /// The most entries of a block; `None` if a number is out of its range.
    fn most_of_a_block(&self, slots: u32) -> Option<usize> {
        let masks = self.entries.iter().map(|entry| entry.mask).max().map_or(0, |mask| usize::from(mask) + 1);
        if masks > self.masks.len() || self.blocks.last()?.first as usize != self.entries.len() {
            return None;
        }
        let mut most = 0;
        for ends in self.blocks.windows(2) {
            let entries = self.entries.get(ends[0].first as usize..ends[1].first as usize)?;
            let come: u64 = entries.iter().map(|entry| u64::from(entry.after)).sum();
            if !entries.is_empty() && u64::from(ends[0].slot) + come >= u64::from(slots) {
                return None;
            }
            most = most.max(entries.len());
        }
        Some(most)
    }
}

impl CellIndex {
    /// The list that was read, on a map with so many rows and slots, if there is any; `None` if it is none of
    /// such a map.
    fn check(self, rows: u32, slots: u32) -> Option<Option<Self>> {
        let Self { rows: first, entries } = &self;
        if first.is_empty() {
            return entries.is_empty().then_some(None);
        }
        let fits = first.len() == rows as usize + 1
            && first.is_sorted()
            && first.last().is_some_and(|&end| end as usize == entries.len())
            && entries.iter().all(|&entry| (entry as u32) < slots);
        fits.then_some(Some(self))
    }
}
