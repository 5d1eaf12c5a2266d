//! Building a seen index.

use std::{cmp::Reverse, collections::HashMap};

use mediant_grid::{FreeSpace, Interrupt, Interrupted, Placement, PlacementKind, Vertex};

use super::{
    Block, EMPTY, SIDE, SeenEntry, SeenIndex,
    cells::{CellIndex, CellSlot},
};
use crate::{
    chunks::in_chunks,
    placement::{BuildContext, CellRun, EdgeFinder, VertexRun},
};

/// The stage that an interrupted call names.
const DURING: &str = "finding what vertices see";

/// The mask of all vertices.
const FULL: u64 = !0;

/// The part of the index that may be added for what is seen from the middle of cells.
const MOST_OF_CELLS: usize = 8;

/// Which vertices of a block are joined to a slot.
#[derive(Clone, Copy, Debug)]
struct Link {
    block: u32,
    slot: u32,
    mask: u64,
}

impl SeenIndex {
    /// Finds what each vertex is joined to; `None` if the index would take more than `most` bytes. Meanwhile
    /// it takes about four times as much.
    pub(crate) fn new<P: EdgeFinder>(
        context: BuildContext<'_, P>,
        most: usize,
        progress: &(impl Fn(usize) + Sync),
        interrupt: &Interrupt,
    ) -> Result<Option<Self>, Interrupted> {
        Self::with_masks(context, most, usize::from(u16::MAX) + 1, progress, interrupt)
    }

    /// [`new`](Self::new) with at most so many masks; those within one row, the full and the empty one must
    /// have room.
    fn with_masks<P: EdgeFinder>(
        context: BuildContext<'_, P>,
        most: usize,
        most_masks: usize,
        progress: &(impl Fn(usize) + Sync),
        interrupt: &Interrupt,
    ) -> Result<Option<Self>, Interrupted> {
        let (width, height) = P::vertices(context.space.grid());
        let [columns, rows] = [width, height].map(|side| side.div_ceil(SIDE as u32));
        let count = columns as usize * rows as usize;
        let (mut links, cells) = links(context, (columns, count), progress, interrupt)?;
        let free = free_vertices(context.space, columns, count, interrupt)?;
        for links in &mut links {
            interrupt.check(DURING)?;
            for link in links {
                let free = free[link.block as usize];
                link.mask = if link.mask & free == free { FULL } else { link.mask & free };
            }
        }
        let total: usize = links.iter().map(Vec::len).sum();
        if size_of::<SeenEntry>() * total + size_of::<Block>() * count > most {
            return Ok(None);
        }
        let index = Self::of_links(&links, columns, count, most_masks, interrupt)?;
        drop(links);
        let cells = (P::KIND == PlacementKind::Corner).then(|| CellIndex::new(cells, height - 1));
        let cells = cells.filter(|cells| cells.memory_bytes() <= index.memory_bytes() / MOST_OF_CELLS);
        Ok(Some(Self { cells, ..index }))
    }

    /// The index of links in the order of their slots.
    fn of_links(
        links: &[Vec<Link>],
        columns: u32,
        count: usize,
        most_masks: usize,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let (masks, numbers) = dictionary(links, most_masks, interrupt)?;
        let (blocks, entries) = entries(links, &numbers, count, interrupt)?;
        let most = blocks.windows(2).map(|ends| (ends[1].first - ends[0].first) as usize).max().unwrap_or(0);
        let (blocks, entries, masks) = (blocks.into(), entries.into(), masks.into());
        Ok(Self { columns, blocks, entries, masks, most, cells: None })
    }
}

impl SeenIndex {
    /// The blocks with free vertices, those first of which the fewest of the subgoals that are seen from
    /// them are seen from each of their vertices.
    pub(crate) fn blocks_by_scatter<P: Placement>(
        &self,
        space: &FreeSpace<P>,
        interrupt: &Interrupt,
    ) -> Result<Vec<u32>, Interrupted> {
        /// So that blocks from which little is seen at all do not come first.
        const FEW: u64 = 16;
        let free = free_vertices(space, self.columns, self.len(), interrupt)?;
        let vertices = |mask: u64| u64::from(mask.count_ones());
        let scatter = |(of_block, &free): (&[Block], &u64)| {
            let entries = &self.entries[of_block[0].first as usize..of_block[1].first as usize];
            let joined = entries.iter().map(|entry| vertices(self.masks[usize::from(entry.mask)] & free));
            let (seen, each) = (entries.len() as u64 + FEW, joined.sum::<u64>() + FEW * vertices(free));
            ((vertices(free) * seen) << 16).checked_div(each)
        };
        let blocks = self.blocks.windows(2).zip(&free).map(scatter).zip(0_u32..);
        let mut blocks: Vec<_> =
            blocks.filter_map(|(scatter, block)| Some((Reverse(scatter?), block))).collect();
        blocks.sort_unstable();
        Ok(blocks.into_iter().map(|(_, block)| block).collect())
    }
}

/// The blocks and their entries: counted, then written.
fn entries(
    links: &[Vec<Link>],
    numbers: &HashMap<u64, u16>,
    count: usize,
    interrupt: &Interrupt,
) -> Result<(Vec<Block>, Vec<SeenEntry>), Interrupted> {
    let mut blocks = vec![Block::default(); count + 1];
    // By block, one more than the last slot; 0 for none.
    let mut last = vec![0; count];
    for links in links {
        interrupt.check(DURING)?;
        for link in links {
            let block = link.block as usize;
            if last[block] == 0 {
                blocks[block].slot = link.slot;
            }
            for_entries(link, &mut last[block], numbers, |_| blocks[block + 1].first += 1);
        }
    }
    for block in 0..count {
        blocks[block + 1].first += blocks[block].first;
    }
    last.fill(0);
    let mut next: Vec<u32> = blocks.iter().map(|block| block.first).collect();
    let mut entries = vec![SeenEntry { after: 0, mask: 0 }; next[count] as usize];
    for links in links {
        interrupt.check(DURING)?;
        for link in links {
            let block = link.block as usize;
            for_entries(link, &mut last[block], numbers, |entry| {
                entries[next[block] as usize] = entry;
                next[block] += 1;
            });
        }
    }
    Ok((blocks, entries))
}

/// Visits the entries of a link. `last` is one more than the slot before it in its block; 0 for none.
fn for_entries(link: &Link, last: &mut u32, numbers: &HashMap<u64, u16>, mut visit: impl FnMut(SeenEntry)) {
    let mut after = if *last == 0 { 0 } else { link.slot + 1 - *last };
    *last = link.slot + 1;
    while after > u32::from(u16::MAX) {
        visit(SeenEntry { after: u16::MAX, mask: EMPTY });
        after -= u32::from(u16::MAX);
    }
    let mut add = |mask: u16| visit(SeenEntry { after: std::mem::take(&mut after) as u16, mask });
    match numbers.get(&link.mask) {
        Some(&number) => add(number),
        None => rows_of(link.mask).filter_map(|row| numbers.get(&row)).for_each(|&number| add(number)),
    }
}

/// The links of all subgoals, in the order of their slots, and what is seen from cells alone.
fn links<P: EdgeFinder>(
    context: BuildContext<'_, P>,
    (columns, count): (u32, usize),
    progress: &(impl Fn(usize) + Sync),
    interrupt: &Interrupt,
) -> Result<(Vec<Vec<Link>>, Vec<CellSlot>), Interrupted> {
    let scratch = || (P::Scratch::default(), [Marks::new(count), Marks::new(count)], Vec::new());
    let found = in_chunks(context.subgoals.len(), scratch, progress, |(scratch, sides, runs), ids| {
        let (mut links, mut cells) = (Vec::new(), Vec::new());
        for id in ids {
            interrupt.check(DURING)?;
            let subgoal = context.subgoals.vertex(id);
            runs.clear();
            let add = |run: VertexRun| sides[usize::from(run.is_right)].add(columns, run);
            P::runs_to(context, scratch, subgoal, add, |run| runs.push(run));
            for &CellRun { row, first, end, is_right } in &*runs {
                let (side, marks) = (u32::from(is_right), &sides[usize::from(is_right)]);
                let alone = (first..end).filter(|&column| !marks.touch(columns, column, row));
                let (row, slot) = (row as u32, id * P::SIDES + side);
                cells.extend(alone.map(|column| CellSlot { row, column: column as u32, slot }));
            }
            for (side, marks) in (0..).zip(&mut *sides) {
                marks.take(|block, mask| links.push(Link { block, slot: id * P::SIDES + side, mask }));
            }
        }
        Ok((links, cells))
    })?;
    let (links, cells): (Vec<_>, Vec<_>) = found.into_iter().unzip();
    Ok((links, cells.concat()))
}

/// The free vertices of each block.
fn free_vertices<P: Placement>(
    space: &FreeSpace<P>,
    columns: u32,
    count: usize,
    interrupt: &Interrupt,
) -> Result<Vec<u64>, Interrupted> {
    let (width, height) = P::vertices(space.grid());
    let mut free = vec![0; count];
    for y in 0..height as i32 {
        interrupt.check(DURING)?;
        for x in (0..width as i32).filter(|&x| space.is_free(Vertex::new(x, y))) {
            free[((y / SIDE) as u32 * columns + (x / SIDE) as u32) as usize] |=
                1_u64 << (SIDE * (y % SIDE) + x % SIDE);
        }
    }
    Ok(free)
}

/// The parts of a mask in each row.
fn rows_of(mask: u64) -> impl Iterator<Item = u64> {
    (0..SIDE).map(move |row| mask & 0xFF << (SIDE * row)).filter(|&row| row != 0)
}

/// The masks of a map, and their numbers: the full one, the empty one, the others by frequency. If there are
/// more than `most`, all that lie within one row come next, and the rarest are left out.
fn dictionary(
    links: &[Vec<Link>],
    most: usize,
    interrupt: &Interrupt,
) -> Result<(Vec<u64>, HashMap<u64, u16>), Interrupted> {
    let mut counted = counted_masks(links, interrupt)?;
    counted.sort_unstable_by_key(|&(count, mask)| (std::cmp::Reverse(count), mask));
    let mut masks = vec![FULL, 0];
    if masks.len() + counted.len() > most {
        masks.extend((0..SIDE).flat_map(|row| (1..=0xFF).map(move |bits: u64| bits << (SIDE * row))));
    }
    let is_row = |mask: u64| masks.len() > 2 && rows_of(mask).count() == 1;
    let others: Vec<u64> = counted.iter().map(|&(_, mask)| mask).filter(|&mask| !is_row(mask)).collect();
    masks.extend(others.into_iter().take(most - masks.len()));
    let numbers = masks.iter().zip(0..=u16::MAX).map(|(&mask, number)| (mask, number)).collect();
    Ok((masks, numbers))
}

/// The masks that are not full, each with how often it occurs.
fn counted_masks(links: &[Vec<Link>], interrupt: &Interrupt) -> Result<Vec<(usize, u64)>, Interrupted> {
    /// The masks that are sorted between two questions of the interrupt.
    const PIECE: usize = 1 << 16;
    // In pieces, since most masks occur often.
    let mut counted: Vec<(u64, usize)> = Vec::new();
    let mut piece: Vec<u64> = Vec::with_capacity(PIECE);
    let mut count = |piece: &mut Vec<u64>| {
        piece.sort_unstable();
        counted.extend(piece.chunk_by(|a, b| a == b).map(|same| (same[0], same.len())));
        piece.clear();
        interrupt.check(DURING)
    };
    for mask in links.iter().flatten().map(|link| link.mask).filter(|&mask| mask != FULL) {
        piece.push(mask);
        if piece.len() == PIECE {
            count(&mut piece)?;
        }
    }
    count(&mut piece)?;
    counted.sort_unstable();
    let same = counted.chunk_by(|(a, _), (b, _)| a == b);
    Ok(same.map(|same| (same.iter().map(|(_, count)| count).sum(), same[0].0)).collect())
}

/// The vertices that are joined to one side of a subgoal, by block.
#[derive(Debug)]
struct Marks {
    masks: Vec<u64>,
    touched: Vec<u32>,
}

impl Marks {
    fn new(count: usize) -> Self {
        Self { masks: vec![0; count], touched: Vec::new() }
    }

    fn add(&mut self, columns: u32, run: VertexRun) {
        let VertexRun { first: Vertex { x, y }, length, is_column, .. } = run;
        let (mut at, end) = if is_column { (y, y + length) } else { (x, x + length) };
        while at < end {
            let next = end.min((at / SIDE + 1) * SIDE);
            let (low, count) = (at % SIDE, next - at);
            let (x, y, mask) = if is_column {
                let column = 0x0101_0101_0101_0101 >> (64 - SIDE * count);
                (x, at, column << (SIDE * low + x % SIDE))
            } else {
                (at, y, (0xFF_u64 >> (SIDE - count)) << (SIDE * (y % SIDE) + low))
            };
            let block = (y / SIDE) as u32 * columns + (x / SIDE) as u32;
            let known = &mut self.masks[block as usize];
            if *known == 0 {
                self.touched.push(block);
            }
            *known |= mask;
            at = next;
        }
    }

    /// Whether a vertex of a cell is joined.
    fn touch(&self, columns: u32, x: i32, y: i32) -> bool {
        [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].into_iter().any(|(x, y)| {
            let block = (y / SIDE) as u32 * columns + (x / SIDE) as u32;
            self.masks[block as usize] >> (SIDE * (y % SIDE) + x % SIDE) & 1 == 1
        })
    }

    /// Gives the masks, and forgets them.
    fn take(&mut self, mut visit: impl FnMut(u32, u64)) {
        for block in self.touched.drain(..) {
            visit(block, std::mem::take(&mut self.masks[block as usize]));
        }
    }
}

#[cfg(test)]
mod tests;
