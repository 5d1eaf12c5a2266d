//! Building a seen index.

use std::{cmp::Reverse, collections::HashMap, ops::Range};

use mediant_grid::{FreeSpace, Interrupt, Interrupted, Placement, PlacementKind, Vertex};

use super::{
    Block, EMPTY, SIDE, SeenEntry, SeenIndex,
    cells::{CellIndex, CellSlot},
    links::{BlockLinks, Link, ListedLink},
};
use crate::{
    chunks::{Pool, in_chunks},
    placement::{BuildContext, CellRun, EdgeFinder, VertexRun},
};

/// The stage that an interrupted call names.
const DURING: &str = "finding what vertices see";

/// The mask of all vertices.
pub(super) const FULL: u64 = !0;

/// The part of the index that may be added for what is seen from the middle of cells.
const MOST_OF_CELLS: usize = 8;

/// The subgoals whose links are found at a time, before they are written to the lists of the blocks.
const PIECE: usize = 1 << 11;

impl SeenIndex {
    /// Finds what each vertex is joined to; `None` if the index would take more than `most` bytes. Meanwhile
    /// it takes about twice as much.
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
        let free = free_vertices(context.space, columns, count, interrupt)?;
        let fits = |links: usize| size_of::<SeenEntry>() * links + size_of::<Block>() * count <= most;
        let Some((links, cells)) = links(context, (columns, &free), fits, progress, interrupt)? else {
            return Ok(None);
        };
        drop(free);
        let index = Self::of_links(&links, columns, most_masks, interrupt)?;
        drop(links);
        let cells = (P::KIND == PlacementKind::Corner).then(|| CellIndex::new(cells, height - 1));
        let cells = cells.filter(|cells| cells.memory_bytes() <= index.memory_bytes() / MOST_OF_CELLS);
        Ok(Some(Self { cells, ..index }))
    }

    /// The index of these links.
    fn of_links(
        links: &BlockLinks,
        columns: u32,
        most_masks: usize,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let (masks, numbers) = dictionary(links.masks.counted(), most_masks);
        let (blocks, entries) = entries(links, &numbers, interrupt)?;
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

/// The blocks and their entries.
fn entries(
    links: &BlockLinks,
    numbers: &HashMap<u64, u16>,
    interrupt: &Interrupt,
) -> Result<(Vec<Block>, Vec<SeenEntry>), Interrupted> {
    // By the number that a mask had when it was met.
    let met: Vec<(u64, Option<u16>)> =
        links.masks.all().map(|mask| (mask, numbers.get(&mask).copied())).collect();
    let mut blocks = Vec::with_capacity(links.blocks() + 1);
    let mut entries = Vec::with_capacity(links.total);
    for block in 0..links.blocks() {
        interrupt.check_every(1 << 8, block, DURING)?;
        blocks.push(Block { first: entries.len() as u32, slot: links.first_slot(block) });
        for ListedLink { mut after, mask } in links.of(block) {
            let mut add = |mask: u16| entries.push(SeenEntry { after: std::mem::take(&mut after), mask });
            match met[mask as usize] {
                _ if mask == u32::from(EMPTY) => add(EMPTY),
                (_, Some(number)) => add(number),
                (mask, None) => {
                    rows_of(mask).filter_map(|row| numbers.get(&row)).for_each(|&number| add(number));
                }
            }
        }
    }
    blocks.push(Block { first: entries.len() as u32, slot: 0 });
    Ok((blocks, entries))
}

/// The links of all subgoals, and what is seen from cells alone; `None` if there are more links than fit.
fn links<P: EdgeFinder>(
    context: BuildContext<'_, P>,
    (columns, free): (u32, &[u64]),
    fits: impl Fn(usize) -> bool,
    progress: &(impl Fn(usize) + Sync),
    interrupt: &Interrupt,
) -> Result<Option<(BlockLinks, Vec<CellSlot>)>, Interrupted> {
    let (subgoals, count) = (context.subgoals.len(), free.len());
    let (mut all, mut all_cells) = (BlockLinks::new(count), Vec::new());
    let (pool, new) =
        (Pool::default(), || (P::Scratch::default(), [(); 2].map(|()| Marks::new(count)), Vec::new()));
    for first in (0..subgoals).step_by(PIECE) {
        let progress = |done| progress(first + done);
        let ids = PIECE.min(subgoals - first);
        let find = |scratch: &mut _, ids| find(context, (columns, free), scratch, (first, ids), interrupt);
        let found = in_chunks(ids, || (), &progress, |(), ids| pool.lend(new, |scratch| find(scratch, ids)))?;
        for (links, cells) in found {
            interrupt.check(DURING)?;
            links.into_iter().for_each(|link| all.add(link));
            all_cells.extend(cells);
        }
        if !fits(all.total) {
            return Ok(None);
        }
    }
    Ok(Some((all, all_cells)))
}

/// Scratch memory to find links: of the placement, the vertices of either side, and rows of cells.
type Finder<P> = (<P as EdgeFinder>::Scratch, [Marks; 2], Vec<CellRun>);

/// The links of some subgoals, by their numbers from `first` on, in the order of their slots; and what is
/// seen from cells alone.
fn find<P: EdgeFinder>(
    context: BuildContext<'_, P>,
    (columns, free): (u32, &[u64]),
    (scratch, sides, runs): &mut Finder<P>,
    (first, ids): (usize, Range<u32>),
    interrupt: &Interrupt,
) -> Result<(Vec<Link>, Vec<CellSlot>), Interrupted> {
    let (mut links, mut cells) = (Vec::new(), Vec::new());
    for id in ids.map(|id| first as u32 + id) {
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
            marks.take(|block, mask| {
                let free = free[block as usize];
                let mask = if mask & free == free { FULL } else { mask & free };
                links.push(Link { block, slot: id * P::SIDES + side, mask });
            });
        }
    }
    Ok((links, cells))
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

/// The masks of a map, of which those that are not full are counted, and their numbers: the full one, the
/// empty one, the others by frequency. If there are more than `most`, all that lie within one row come next,
/// and the rarest are left out.
fn dictionary(mut counted: Vec<(usize, u64)>, most: usize) -> (Vec<u64>, HashMap<u64, u16>) {
    counted.sort_unstable_by_key(|&(count, mask)| (std::cmp::Reverse(count), mask));
    let mut masks = vec![FULL, 0];
    if masks.len() + counted.len() > most {
        masks.extend((0..SIDE).flat_map(|row| (1..=0xFF).map(move |bits: u64| bits << (SIDE * row))));
    }
    let is_row = |mask: u64| masks.len() > 2 && rows_of(mask).count() == 1;
    let others: Vec<u64> = counted.iter().map(|&(_, mask)| mask).filter(|&mask| !is_row(mask)).collect();
    masks.extend(others.into_iter().take(most - masks.len()));
    let numbers = masks.iter().zip(0..=u16::MAX).map(|(&mask, number)| (mask, number)).collect();
    (masks, numbers)
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
