//! The subgoals that are seen from the middle of a cell, but from none of its vertices.
//!
//! A point in the middle of a cell sees a subgoal from which a part of the cell's inside is seen. Nearly
//! always a vertex of the cell is seen from there, too; what remains is listed here: on the maps of
//! `docs/measurements/subgoal.md` it is one subgoal for 14 to 170 cells. On maps of noise there are several
//! for each cell, and no list is kept.

use mediant_grid::Vertex;

/// The slots of which a part of a cell is seen, but none of its vertices; by cells, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct CellIndex {
    /// By row, the number of its first entry, and one more that ends the last.
    pub(super) rows: Box<[u32]>,
    /// The column in the upper half, the slot in the lower one.
    pub(super) entries: Box<[u64]>,
}

/// A cell, and a slot for which it is listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct CellSlot {
    pub(super) row: u32,
    pub(super) column: u32,
    pub(super) slot: u32,
}

impl CellIndex {
    /// The index of entries in any order, on a map with so many rows.
    pub(super) fn new(mut found: Vec<CellSlot>, rows: u32) -> Self {
        found.sort_unstable();
        found.dedup();
        let mut first = vec![0_u32; rows as usize + 1];
        for entry in &found {
            first[entry.row as usize + 1] += 1;
        }
        for row in 0..rows as usize {
            first[row + 1] += first[row];
        }
        let entries = found.iter().map(|entry| u64::from(entry.column) << 32 | u64::from(entry.slot));
        Self { rows: first.into(), entries: entries.collect() }
    }

    /// The slots that are listed for a cell; none outside of the map.
    #[inline]
    pub(crate) fn slots(&self, cell: Vertex) -> impl Iterator<Item = u32> + Clone + '_ {
        let column = |entry: &u64| (entry >> 32) as i64;
        let x = i64::from(cell.x);
        let bounds = usize::try_from(cell.y).ok().and_then(|y| self.rows.get(y..)?.first_chunk());
        let row = bounds.and_then(|&[first, end]| self.entries.get(first as usize..end as usize));
        let row = row.unwrap_or_default();
        let row = &row[row.partition_point(|entry| column(entry) < x)..];
        row.iter().take_while(move |entry| column(entry) == x).map(|&entry| entry as u32)
    }

    /// The memory used, in bytes.
    pub(crate) const fn memory_bytes(&self) -> usize {
        size_of_val(&*self.rows) + size_of_val(&*self.entries)
    }
}
