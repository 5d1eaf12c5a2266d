//! Parts of a map that are joined by single doors: of its rows, or, with rows and columns exchanged, of its
//! columns.
//!
//! **Graph.** The runs of free cells of a map's rows are the vertices of a graph. Its edges are the *doors*:
//! the segments at which runs of two rows touch, and gaps that paths may pass. A door is a *bridge* if there
//! is no way around it, and the parts are the 2-edge-connected components: the sets of runs that bridges
//! leave together. Tarjan's low links find them in linear time (*Depth-first search and linear graph
//! algorithms*, 1972): a depth-first search numbers the runs, and the door by which it enters a run is a
//! bridge if no other door leads from that run or its descendants to a run with a lower number. So parts are
//! the nodes of a tree (one for each component of the map). A path that crosses a bridge and comes back is no
//! shorter, in any norm, than one that keeps to the segment between both places, which is straight and free.
//! So paths need those parts alone that are between their ends in the tree. A bridge is shut by blocking the
//! run beyond it. For what is on this side, that run is a dead end like those of the module above: no corner
//! is added.
//!
//! A run between two bridges, as in a corridor, is no part of its own, but goes with what is beyond it. So a
//! path through a long corridor needs few parts.
//!
//! Where a run has a door with one other run, both touch in one stretch. So the runs above a run are
//! neighbors in their row, and so are those below it.

use std::sync::Arc;

use mediant_grid::{BitMatrix, Interrupt, Interrupted, Versioned, room_for, room_in};

use super::runs::{CellRun, DURING};

/// The runs that are handled between two questions of an interrupt.
const PIECE: usize = 1 << 14;

/// The parts of a map, with their bridges. Part 0 is the root of each of its trees.
#[derive(Clone, Debug)]
pub(super) struct Parts {
    pub(super) lines: Lines,
    /// All but part 0.
    pub(super) parts: Versioned<Part>,
}

/// A part, whose parent has a smaller number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Part {
    pub(super) parent: u32,
    pub(super) link: Link,
    /// The run at its side of the bridge to the parent; empty if there is no bridge.
    pub(super) inner: CellRun,
    /// The run of the parent there.
    pub(super) outer: CellRun,
}

/// The place where a part hangs on its parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Link {
    /// By a bridge.
    Bridge,
    /// Not at all any more: the part and all that hang on it are cut off.
    Cut,
    /// There may be several ways since a repair: the two are one part.
    Joined,
}

/// A run of a row, from one column up to another, in a part. Maps have at most 2¹⁵ columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PartRun {
    pub(super) first: u16,
    pub(super) end: u16,
    pub(super) part: u32,
}

/// For each row its runs that are not in part 0, in bands of rows, so that one version shares with the next
/// the bands and the rows that stay.
#[derive(Clone, Debug)]
pub(super) struct Lines(Arc<Vec<Arc<Band>>>);

type Band = Vec<Arc<[PartRun]>>;

/// The rows of a band.
const BAND: usize = 64;

impl Lines {
    /// The runs of a row.
    pub(super) fn get(&self, y: i32) -> &[PartRun] {
        &self.0[y as usize / BAND][y as usize % BAND]
    }

    pub(super) fn set(&mut self, y: i32, runs: Vec<PartRun>) {
        let band = &mut Arc::make_mut(&mut self.0)[y as usize / BAND];
        Arc::make_mut(band)[y as usize % BAND] = runs.into();
    }

    fn memory_bytes(&self) -> usize {
        // Two counters with each array.
        let line = |line: &Arc<[PartRun]>| match size_of_val(&**line) {
            0 => size_of_val(line),
            bytes => bytes + 2 * size_of::<usize>() + size_of_val(line),
        };
        self.0.iter().flat_map(|band| band.iter().map(line)).sum()
    }
}

impl Parts {
    /// The parts of a map with these rows of cells.
    pub(super) fn new(
        map: &BitMatrix,
        is_vertical: bool,
        gaps_are_open: bool,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let graph = RunGraph::new(map, is_vertical, gaps_are_open, interrupt)?;
        let (of, parts) = graph.parts(interrupt)?;
        let mut runs = graph.vertices.iter().map(|vertex| vertex.run).zip(of).peekable();
        let (empty, mut line) = (Arc::<[PartRun]>::from([]), Vec::new());
        let mut of_row = |y: i32| {
            line.clear();
            while let Some((CellRun { first, end, .. }, part)) = runs.next_if(|(run, _)| run.line == y) {
                if part != 0 {
                    line.push(PartRun { first: first as u16, end: end as u16, part });
                }
            }
            if line.is_empty() { Arc::clone(&empty) } else { Arc::from(&*line) }
        };
        let height = map.height() as i32;
        let mut band =
            |first: i32| Arc::new((first..height.min(first + BAND as i32)).map(&mut of_row).collect());
        let lines = Lines(Arc::new((0..height).step_by(BAND).map(&mut band).collect()));
        Ok(Self { lines, parts: parts.into() })
    }

    /// The part of a cell.
    pub(super) fn of(&self, x: i32, y: i32) -> u32 {
        let runs = self.lines.get(y);
        let at = runs.partition_point(|run| i32::from(run.end) <= x);
        runs.get(at).filter(|run| i32::from(run.first) <= x).map_or(0, |run| run.part)
    }

    /// Calls `visit` for the parts of some cells one below the other, again and again for each of them.
    pub(super) fn for_each_across(&self, x: i32, (first, end): (i32, i32), mut visit: impl FnMut(u32)) {
        let mut is_in_first = false;
        for y in first..end {
            if self.lines.get(y).is_empty() {
                is_in_first = true;
            } else {
                visit(self.of(x, y));
            }
        }
        if is_in_first {
            visit(0);
        }
    }

    /// A part other than part 0.
    pub(super) fn part(&self, number: u32) -> Part {
        self.parts[number as usize - 1]
    }

    /// The memory that they take, in bytes.
    pub(super) fn memory_bytes(&self) -> usize {
        self.lines.memory_bytes() + size_of_val(&*self.parts)
    }

    /// Shuts the bridges of all parts but part 0 in rows of the map.
    pub(super) fn shut(&self, rows: &mut BitMatrix) {
        self.parts.iter().for_each(|part| part.inner.set(rows, true));
    }
}

/// The graph of the runs of a map.
struct RunGraph {
    vertices: Vec<RunVertex>,
}

/// A run with its neighbors: vertices in a row above and below.
struct RunVertex {
    run: CellRun,
    above: (u32, u32),
    below: (u32, u32),
}

impl RunVertex {
    /// Its `index`-th neighbor.
    const fn neighbor(&self, index: u32) -> Option<u32> {
        let above = self.above.1 - self.above.0;
        if index < above {
            Some(self.above.0 + index)
        } else if index - above < self.below.1 - self.below.0 {
            Some(self.below.0 + index - above)
        } else {
            None
        }
    }
}

/// The state of a vertex in Tarjan's search for bridges.
#[derive(Clone, Copy)]
struct Visit {
    /// When it was first reached, from 1 on; 0 if it was not.
    time: u32,
    /// The neighbor from which it was reached; itself where the search began.
    parent: u32,
    /// The next neighbor to look at; later the vertex's low link, the earliest time that it or a descendant
    /// reaches.
    next: u32,
}

impl RunGraph {
    fn new(
        map: &BitMatrix,
        is_vertical: bool,
        gaps_are_open: bool,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let mut vertices: Vec<RunVertex> = Vec::new();
        let width = map.width() as i32;
        let (mut above, reach) = (0, i32::from(gaps_are_open));
        for y in 0..map.height() as i32 {
            interrupt.check(DURING)?;
            room_in(&mut vertices, width as usize, DURING)?;
            let (row, start) = (map.row(y), vertices.len());
            let mut first = row.first_free(0, width);
            while first < width {
                let end = row.first_blocked(first, width);
                // The runs above that end before this one, or at its corner if paths may not pass there.
                while above < start && vertices[above].run.end + reach <= first {
                    above += 1;
                }
                let (number, mut last) = (vertices.len() as u32, above);
                while last < start && vertices[last].run.first < end + reach {
                    let below = &mut vertices[last].below;
                    *below = (if below.1 == 0 { number } else { below.0 }, number + 1);
                    last += 1;
                }
                let run = CellRun { is_vertical, line: y, first, end };
                vertices.push(RunVertex { run, above: (above as u32, last as u32), below: (0, 0) });
                first = row.first_free(end, width);
            }
            above = start;
        }
        Ok(Self { vertices })
    }

    /// The part of each run, and all parts but part 0.
    fn parts(&self, interrupt: &Interrupt) -> Result<(Vec<u32>, Vec<Part>), Interrupted> {
        room_for::<(Visit, [u32; 3], Part)>(self.vertices.len(), DURING)?;
        let (mut visits, order) = self.visit_all(interrupt)?;
        for (number, &v) in order.iter().rev().enumerate() {
            interrupt.check_every(PIECE, number, DURING)?;
            visits[v as usize].next = self.earliest(v, &visits);
        }
        let is_bridge = |v: u32| {
            let Visit { time, parent, next: earliest } = visits[v as usize];
            parent != v && earliest >= time
        };
        // The bridges from a run to others beyond it; what else is beyond it counts as two.
        let mut beyond = vec![0_u32; visits.len()];
        for (number, &v) in order.iter().enumerate() {
            interrupt.check_every(PIECE, number, DURING)?;
            let parent = visits[v as usize].parent;
            if parent != v {
                beyond[parent as usize] += if is_bridge(v) { 1 } else { 2 };
            }
        }
        let (mut of, mut parts) = (vec![0; visits.len()], Vec::new());
        for (number, v) in order.into_iter().enumerate() {
            interrupt.check_every(PIECE, number, DURING)?;
            let parent = visits[v as usize].parent;
            let above = of[parent as usize];
            let is_in_corridor = beyond[parent as usize] == 1 && is_bridge(parent);
            of[v as usize] = if is_in_corridor || !is_bridge(v) {
                above
            } else {
                let [inner, outer] = [v, parent].map(|v| self.vertices[v as usize].run);
                parts.push(Part { parent: above, link: Link::Bridge, inner, outer });
                parts.len() as u32
            };
        }
        Ok((of, parts))
    }

    /// Searches all runs depth first, from the longest one on, so that part 0 is likely to be a large one.
    fn visit_all(&self, interrupt: &Interrupt) -> Result<(Vec<Visit>, Vec<u32>), Interrupted> {
        let count = self.vertices.len() as u32;
        let mut visits = vec![Visit { time: 0, parent: 0, next: 0 }; count as usize];
        let mut order = Vec::with_capacity(count as usize);
        let longest = (0..count).max_by_key(|&v| {
            let CellRun { first, end, .. } = self.vertices[v as usize].run;
            end - first
        });
        for from in longest.into_iter().chain(0..count) {
            if visits[from as usize].time != 0 {
                continue;
            }
            let (mut v, mut parent) = (from, from);
            loop {
                let visit = &mut visits[v as usize];
                if visit.time == 0 {
                    interrupt.check_every(PIECE, order.len(), DURING)?;
                    order.push(v);
                    *visit = Visit { time: order.len() as u32, parent, next: 0 };
                }
                let next = self.vertices[v as usize].neighbor(visit.next);
                visit.next += 1;
                match next {
                    Some(u) if visits[u as usize].time == 0 => (v, parent) = (u, v),
                    Some(_) => {}
                    None if visits[v as usize].parent == v => break,
                    None => v = visits[v as usize].parent,
                }
            }
        }
        Ok((visits, order))
    }

    /// The earliest time that is reached from a run and its descendants, where it is known of them.
    fn earliest(&self, v: u32, visits: &[Visit]) -> u32 {
        let Visit { time, parent, .. } = visits[v as usize];
        let vertex = &self.vertices[v as usize];
        let neighbors = (0..).map_while(|index| vertex.neighbor(index));
        let reached = neighbors.map(|u| {
            let visit = visits[u as usize];
            if visit.parent == v && visit.time > time {
                visit.next
            } else if u == parent && !self.is_gap(v, u) {
                time
            } else {
                visit.time
            }
        });
        reached.fold(time, u32::min)
    }

    /// Whether two neighbors touch at a gap alone. That is no straight door, so it counts as two ways.
    fn is_gap(&self, v: u32, u: u32) -> bool {
        let [v, u] = [v, u].map(|v| self.vertices[v as usize].run);
        v.end == u.first || u.end == v.first
    }
}

#[cfg(test)]
mod tests {
    use mediant_grid::{AsciiMap, uninterrupted};

    use super::*;

    /// The parts of the cells, `#` where they are blocked.
    fn draw(drawing: &str, gaps_are_open: bool) -> String {
        let grid = AsciiMap::parse(drawing).expect("the drawing is a map").grid;
        let parts = uninterrupted(|never| Parts::new(grid.rows(), false, gaps_are_open, never));
        let cell = |x, y| match grid.is_blocked(x, y) {
            true => '#',
            false => char::from_digit(parts.of(x, y), 10).expect("few parts"),
        };
        let (width, height) = (grid.width() as i32, grid.height() as i32);
        (0..height).map(|y| (0..width).map(|x| cell(x, y)).collect()).collect::<Vec<String>>().join("\n")
    }

    /// A ring at the top, and a corridor with a ring at the bottom.
    #[test]
    fn what_bridges_leave_together_is_a_part() {
        let rings = ".....\n.#.#.\n.....\n#.###\n#.###\n...##\n.#.##\n...##";
        let parts = "00000\n0#0#0\n00000\n#1###\n#1###\n111##\n1#1##\n111##";
        assert_eq!(draw(rings, true), parts);
        assert_eq!(draw(rings, false), parts);
    }

    /// Where paths may pass a gap, it is a way around others, and never a bridge.
    #[test]
    fn gaps_are_ways() {
        assert_eq!(draw("..#\n.#.\n...", true), "00#\n0#0\n000");
        assert_eq!(draw("..#\n.#.\n...", false), "11#\n1#2\n000");
        assert_eq!(draw("..##\n##..", true), "00##\n##00");
    }
}
