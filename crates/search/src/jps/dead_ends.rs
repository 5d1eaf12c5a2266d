//! Jump points that are dead ends: whatever a path does there but go straight on, it ends near by.
//!
//! On maps of games most jump points are such: an alcove, the rough edge of a wall. A search that makes nodes
//! of them expands twice as many. So they are found beforehand, and jumps pass them, as if they were no jump
//! points.
//!
//! **A dead end** is a jump point p of an axial jump from whose forced successors jumps lead to no node, or
//! only to jump points that are dead ends themselves and from which no jump straight on leads to others. All
//! these nodes, and the vertices of diagonal jumps on the way to them, must lie within [`REACH`] cells of p,
//! in both coordinates. To find out costs a few scans; it is given up at a depth of a few nodes.
//!
//! **Nothing is lost** by passing p, unless a path turns at p to a goal in its dead end. There are no nodes
//! but these: so the last leg of the path, which is axial, leads to the goal from p, from one of these nodes,
//! or from a vertex of a diagonal jump, in any case from a vertex within [`REACH`] of p. That vertex is on
//! the *cross* of the goal: the vertices from which an axial move, repeated, leads to the goal. So p is
//! within [`REACH`] of the cross. Near the cross ([`NearGoal`]) dead ends are jump points like others. The
//! nodes on the way from p to the goal are near it as well, since the goal is in their dead end, too.
//!
//! So a diagonal jump stops at a vertex from which axial jumps come to dead ends alone only where these jumps
//! are near the cross; elsewhere they would find nothing.
//!
//! Where intermediate jump points are kept, or gaps are closed, there are no dead ends.

pub(super) mod find;

use mediant_grid::{Vector, Vertex};

use super::axial::AxialStops;

/// How far a dead end may reach. With 32 hardly more jump points are dead ends, and more are near a goal.
pub(super) const REACH: u32 = 16;

/// Where dead ends may hold the goal: jumps along these rows and columns do not pass them.
#[derive(Clone, Copy, Debug)]
pub struct NearGoal {
    /// Of rows, and of columns.
    bands: [Band; 2],
}

/// The numbers from `first` on, `more` beyond that.
#[derive(Clone, Copy, Debug)]
struct Band {
    first: i32,
    more: u32,
}

impl Band {
    /// The band as a mask of 64 numbers: `number` and the next 63 upwards or downwards.
    #[inline]
    const fn of(self, number: i32, up: bool) -> u64 {
        let highest = if up { number.wrapping_add(63) } else { number };
        if highest.wrapping_sub(self.first) as u32 > self.more.saturating_add(63) {
            return 0;
        }
        let (first, last) = (self.first as i64, self.first as i64 + self.more as i64);
        let (from, to) = if up {
            (first - number as i64, last - number as i64)
        } else {
            (number as i64 - last, number as i64 - first)
        };
        !0 << (if from > 0 { from } else { 0 }) & !0 >> (if to < 63 { 63 - to } else { 0 })
    }

    #[inline]
    const fn holds(self, number: i32) -> bool {
        number.wrapping_sub(self.first) as u32 <= self.more
    }
}

impl NearGoal {
    /// Dead ends are nowhere passed.
    pub(super) const EVERYWHERE: Self = {
        let all = Band { first: i32::MIN, more: u32::MAX };
        Self { bands: [all; 2] }
    };

    /// The rows and columns within `reach` of the goal's cross.
    pub(super) fn new(goal: Vertex, axial: &AxialStops, reach: u32) -> Self {
        let [down, right, up, left] = [0, 1, 2, 3].map(|quarter| axial.legal_steps(goal, quarter));
        let band = |at: i32, before: u32, after: u32| Band {
            first: at - (before + reach) as i32,
            more: before + after + 2 * reach,
        };
        Self { bands: [band(goal.y, up, down), band(goal.x, left, right)] }
    }

    /// Whether an axial jump from a vertex in direction `quarter` is along a row or column near the goal.
    #[inline]
    pub(super) const fn holds(&self, from: Vertex, quarter: usize) -> bool {
        let [rows, columns] = self.bands;
        if quarter.is_multiple_of(2) { columns.holds(from.x) } else { rows.holds(from.y) }
    }

    /// The same for a jump along a row (0) or a column (1), by its number. It takes no branch: that could not
    /// be predicted.
    #[inline]
    pub(super) const fn along(&self, line: (usize, i32)) -> bool {
        self.bands[line.0 & 1].holds(line.1)
    }

    /// The same for jumps from 64 vertices, the first one and those that follow it by diagonal moves `v`.
    #[inline]
    pub(super) const fn along_diagonal(&self, first: Vertex, v: Vector, quarter: usize) -> u64 {
        let [rows, columns] = self.bands;
        if quarter.is_multiple_of(2) { columns.of(first.x, v.x > 0) } else { rows.of(first.y, v.y > 0) }
    }
}

/// The dead ends of a map in rows: for axial jumps in each of the four directions a word for 64 vertices.
#[derive(Clone, Debug, Default)]
pub(super) struct DeadEndRows {
    rows: [Vec<u64>; 4],
    per_row: usize,
}

impl DeadEndRows {
    /// For so many columns and rows, with no dead end yet.
    pub(super) fn new((width, height): (u32, u32)) -> Self {
        let per_row = width.div_ceil(64) as usize;
        Self { rows: [0; 4].map(|_| vec![0; per_row * height as usize]), per_row }
    }

    pub(super) fn add(&mut self, at: Vertex, quarter: usize) {
        self.rows[quarter][at.y as usize * self.per_row + at.x as usize / 64] |= 1 << (at.x % 64);
    }

    pub(super) fn remove(&mut self, at: Vertex, quarter: usize) {
        self.rows[quarter][at.y as usize * self.per_row + at.x as usize / 64] &= !(1 << (at.x % 64));
    }

    /// Whether there are none.
    pub(super) const fn is_empty(&self) -> bool {
        self.per_row == 0
    }

    /// Which of the 64 vertices of a row of the map from (x, y) on are dead ends for a direction.
    pub(super) fn in_row(&self, quarter: usize, (x, y): (i32, i32)) -> u64 {
        if self.is_empty() {
            return 0;
        }
        let row = &self.rows[quarter][y as usize * self.per_row..][..self.per_row];
        let word = |i: i32| usize::try_from(i).ok().and_then(|i| row.get(i)).copied().unwrap_or(0);
        let (at, shift) = (x >> 6, x & 63);
        word(at) >> shift | word(at + 1) << 1 << (63 - shift)
    }

    /// The words for a direction; none if there are no dead ends.
    pub(super) fn of(&self, quarter: usize) -> &[u64] {
        &self.rows[quarter]
    }
}

#[cfg(test)]
mod tests;
