//! Landmarks after an edit.

use std::{cmp::Reverse, collections::BinaryHeap, sync::Arc};

use mediant_grid::{Identity, Interrupt, Interrupted};

use super::{
    Landmarks, NONE,
    error::LandmarksError,
    lines::{Lines, LinesEdit},
};
use crate::{graph::CostGraph, near::ends_near, scan::Visit};

/// A number is lowered in so many times the time that it takes to make it.
const SLOWNESS: usize = 8;

impl Landmarks {
    /// The landmarks of a graph after an edit of its surface; `cells` are the cells that changed, and others
    /// as one likes.
    ///
    /// - Where costs rose and cells were closed, the old numbers remain: no work beyond the cells. The bounds
    ///   are then less close than new ones would be, the more so the more has changed.
    /// - Where costs fell and cells were opened, numbers are lowered as far as the edit makes paths cheaper.
    /// - Where that would take longer, or the surface has other units, the landmarks are made anew.
    ///
    /// The bounds are consistent in each case, and paths the cheapest.
    ///
    /// # Errors
    /// [`LandmarksError::Mismatch`] if `before` is not the landmarks' graph, `after` has other rules or
    /// another k, or other cells changed than these; [`LandmarksError::Interrupted`].
    pub fn repaired(
        &self,
        before: &CostGraph,
        after: &Arc<CostGraph>,
        cells: &[(u32, u32)],
        interrupt: &Interrupt,
    ) -> Result<Self, LandmarksError> {
        match self.repaired_if_quicker(before, after, cells, interrupt)? {
            Some(repaired) => Ok(repaired),
            None => Self::new(after, self.count(), interrupt),
        }
    }

    /// [`repaired`](Self::repaired), but `None` where the landmarks have to be made anew.
    ///
    /// # Errors
    /// As for [`repaired`](Self::repaired).
    pub fn repaired_if_quicker(
        &self,
        before: &CostGraph,
        after: &Arc<CostGraph>,
        cells: &[(u32, u32)],
        interrupt: &Interrupt,
    ) -> Result<Option<Self>, LandmarksError> {
        self.identity.check_equal("the landmarks", ("the graph before", before.identity()))?;
        let every_map = Identity { map: None, ..self.identity };
        every_map.check("the landmarks", ("the graph", after.identity()))?;
        if before.map().scale() != after.map().scale() || before.size() != after.size() {
            return Ok(None);
        }
        let changed = Identity { map: Some(before.map().id_with(cells, after.map())), ..self.identity };
        changed.check_equal("the change", ("the graph", after.identity()))?;
        let mut lines = Arc::clone(&self.lines);
        if !before.scanner().gaps.is_same_as(&after.scanner().gaps) {
            lines = Arc::new(with_gaps(&lines, before, after)?);
        }
        let most = lines.states().saturating_mul(lines.count()) / SLOWNESS;
        let Some(seeds) = lowered(before, after, cells, most / lines.count()) else {
            return Ok(None);
        };
        if !seeds.is_empty() {
            let (graph, shift, lines_after) = (after.as_ref(), self.shift, lines.edit()?);
            let mut lowering =
                Lowering { graph, lines: lines_after, shift, slot: 0, open: BinaryHeap::new() };
            if !lowering.run(&seeds, (self.count(), most), interrupt)? {
                return Ok(None);
            }
            lines = Arc::new(lowering.lines.finish());
        }
        Ok(Some(Self { identity: after.identity(), lines, shift: self.shift }))
    }
}

/// The numbers for the gaps of another surface. A corner that became a gap has its number in both states. One
/// that was a gap has that of the quadrant from which it still can be reached, or the lesser of both.
fn with_gaps(lines: &Lines, before: &CostGraph, after: &CostGraph) -> Result<Lines, Interrupted> {
    let (old, new) = (&before.scanner().gaps, &after.scanner().gaps);
    let mut resized = lines.resized(after.states())?;
    let mut numbers = resized.writer();
    for at in old.positions().filter(|&at| new.upper(at).is_none()) {
        let steps = before.scanner().steps.from(at);
        let cells: [(i8, i8); 2] =
            if before.map().weights()[at] > 0 { [(0, 0), (-1, -1)] } else { [(-1, 0), (0, -1)] };
        let states = [Some(at), old.upper(at)];
        let reached = cells
            .into_iter()
            .zip(states)
            .filter(|&((dx, dy), _)| after.map().weights()[steps.to(dx, dy)] > 0);
        let rows = || reached.clone().filter_map(|(_, state)| Some(lines.row(state?)));
        for (slot, to) in numbers.row_mut(at).iter_mut().enumerate() {
            *to = rows().map(|row| row[slot]).min().unwrap_or(NONE);
        }
    }
    for at in new.positions() {
        if let Some(upper) = new.upper(at) {
            numbers.row_mut(upper).copy_from_slice(lines.row(old.upper(at).unwrap_or(at)));
        }
    }
    Ok(resized)
}

/// The ends of all moves that may have become cheaper; `None` for more than so many.
fn lowered(before: &CostGraph, after: &CostGraph, cells: &[(u32, u32)], most: usize) -> Option<Vec<usize>> {
    let (width, height) = (after.map().width(), after.map().height());
    let is_lower = |&(x, y): &(u32, u32)| {
        if x >= width || y >= height {
            return false;
        }
        let at = after.layout().position(x as i32, y as i32);
        let [was, is] = [before, after].map(|graph| graph.map().weights()[at]);
        is > 0 && (was == 0 || is < was)
    };
    ends_near(after, cells.iter().copied().filter(is_lower), most)
}

/// Lowers the numbers of one landmark after the other.
struct Lowering<'s> {
    graph: &'s CostGraph,
    lines: LinesEdit,
    shift: u32,
    slot: usize,
    open: BinaryHeap<Reverse<(u32, u32)>>,
}

impl Lowering<'_> {
    /// Dijkstra's algorithm from seeds. The numbers become the greatest that are right and no greater than
    /// before. Returns whether it scanned no more states than it may.
    fn run(
        &mut self,
        seeds: &[usize],
        (count, most): (usize, usize),
        interrupt: &Interrupt,
    ) -> Result<bool, LandmarksError> {
        let graph = self.graph;
        let mut scanned = 0;
        for slot in 0..count {
            self.slot = slot;
            self.open.clear();
            self.open
                .extend(seeds.iter().map(|&state| Reverse((self.lines.number(state, slot), state as u32))));
            while let Some(Reverse((number, state))) = self.open.pop() {
                let state = state as usize;
                if number == NONE || number != self.lines.number(state, slot) {
                    continue;
                }
                if scanned == most {
                    return Ok(false);
                }
                interrupt.check_every(1 << 12, scanned, "repairing the landmarks")?;
                scanned += 1;
                graph.scan((state, u64::from(number) << self.shift), self);
            }
        }
        Ok(true)
    }
}

impl Visit for Lowering<'_> {
    #[inline]
    fn known(&self, to: usize) -> u64 {
        if self.graph.is_blocked(to) {
            return 0;
        }
        match self.lines.number(to, self.slot) {
            NONE => u64::MAX,
            number => u64::from(number) << self.shift,
        }
    }

    fn relax(&mut self, _: usize, to: usize, cost: u64) {
        let number = (cost >> self.shift).min(u64::from(NONE - 1)) as u32;
        self.lines.set(to, self.slot, number);
        self.open.push(Reverse((number, to as u32)));
    }
}
