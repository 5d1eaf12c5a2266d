//! The goal of a search: a vertex, or a place between vertices.

use mediant_grid::{
    BitMatrix, Corners, FreeSpace, Vertex,
    sight::{Crossing, Place, Ray, row_ahead},
};

use super::cone::Cone;

/// The goal of a search.
///
/// A vertex lies on the line of a cone's interval, and the interval holds it or not. A place between
/// vertices is touched by one row of cells, or by two if it lies on a line. A root sees it across the line
/// before such a row if it lies between the rays of the interval, and if the straight way from the root
/// enters the row through the run of free cells in which the goal lies: two determinants a side, and no
/// crossing. A root at the border of the row, or in it, sees the goal if both lie in one run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goal {
    pub(super) at: Place,
    /// The goal, if it is a vertex.
    pub(super) vertex: Option<Vertex>,
    /// For cones that lead downwards, and for those that lead upwards.
    entries: [Entry; 2],
}

/// The way of cones of one direction to the goal.
#[derive(Clone, Copy, Debug)]
struct Entry {
    /// The line of the goal, if it is a vertex; else the last one before a row of cells that touches it.
    line: i32,
    /// The run of free cells of that row in which the goal lies. If it is empty there is none.
    run: (i32, i32),
    /// Whether there is a closed gap on the line where the run starts, and where it ends.
    gaps: (bool, bool),
}

impl Goal {
    /// No goal that any cone comes to.
    pub(super) const NONE: Self = {
        let nowhere = Entry { line: i32::MIN, run: (0, 0), gaps: (false, false) };
        Self { at: Place { x: 0, y: 0 }, vertex: None, entries: [nowhere; 2] }
    };

    /// A goal to which no search leads.
    pub(super) const fn reached(at: Place) -> Self {
        Self { at, ..Self::NONE }
    }

    /// The goal at a place of the map; `rows` are those that are searched.
    pub(super) fn new(space: &FreeSpace<Corners>, rows: &BitMatrix, at: Place) -> Self {
        let vertex = at.vertex();
        let entries = [1, -1].map(|down| match vertex {
            Some(Vertex { y, .. }) => Entry { line: y, run: (0, 0), gaps: (false, false) },
            None => {
                let line = at.line(-down) - down;
                let run = at.run(row_ahead(rows, line, down));
                let is_gap = |x| space.is_closed_gap(Vertex::new(x, line));
                Entry { line, run, gaps: (is_gap(run.0), is_gap(run.1)) }
            }
        });
        Self { at, vertex, entries }
    }

    /// The line at which a cone of this direction is asked whether its root sees the goal.
    #[inline]
    pub(super) const fn stop(&self, down: i32) -> i32 {
        self.entry(down).line
    }

    #[inline]
    const fn entry(&self, down: i32) -> &Entry {
        &self.entries[(down < 0) as usize]
    }

    /// Whether a node on this line may hold the goal: the lines at it, and those before rows that touch it.
    #[inline]
    pub(super) const fn may_be_on(&self, line: i32) -> bool {
        line.wrapping_sub(self.at.floor().y - 1) as u32 <= 2
    }

    /// Whether the root of a cone sees the goal through its interval, on the line where this is asked.
    #[inline]
    pub(super) fn is_seen_by(&self, cone: &Cone<'_>) -> bool {
        match self.vertex {
            Some(Vertex { x, .. }) => cone.left.here().ceil() <= x && x <= cone.right.here().floor(),
            None => self.is_seen_in_row(cone),
        }
    }

    /// Whether a cone's root sees the goal in the row of cells beyond its line.
    #[cold]
    #[inline(never)]
    fn is_seen_in_row(&self, cone: &Cone<'_>) -> bool {
        let &Entry { run: (start, end), gaps, .. } = self.entry(cone.down);
        if start >= end {
            return false;
        }
        let to = cone.root.to(self.at);
        let straight = Ray { dx: to.x, dy: to.y * cone.down };
        let [left, right] = [cone.left, cone.right].map(|edge| cone.end(edge).ray);
        let [first, last] = [start, end].map(|x| cone.corner(x).ray);
        // The way may touch the corners at which the run starts and ends, but pass no closed gap there.
        let is_past = |gap: bool, one: Ray, other: Ray| {
            if gap { one.is_right_of(other) } else { !other.is_right_of(one) }
        };
        !left.is_right_of(straight)
            && !straight.is_right_of(right)
            && is_past(gaps.0, straight, first)
            && is_past(gaps.1, last, straight)
    }

    /// Whether a successor's interval on that line may hold the goal. Of a place between vertices that is
    /// left open.
    #[inline]
    pub(super) fn may_be_in(&self, left: Crossing, right: Crossing) -> bool {
        self.vertex.is_none_or(|at| left.ceil() <= at.x && at.x <= right.floor())
    }

    /// Whether a place in the row of cells beyond a line, or at its border, sees the goal through this row:
    /// whether the cell in a column, which the place touches, is in the goal's run.
    #[inline]
    pub(super) fn is_beside(&self, (line, down): (i32, i32), column: i32) -> bool {
        let entry = self.entry(down);
        entry.line == line && entry.run.0 <= column && column < entry.run.1
    }

    /// Whether a path may end at the goal that comes straight from a root.
    pub(super) fn may_be_entered(&self, space: &FreeSpace<Corners>, from: Place) -> bool {
        let is_gap = |at: Vertex| space.is_closed_gap(at);
        !self.vertex.is_some_and(is_gap) || space.may_turn_at(Some(from.into()), self.at.into(), None)
    }
}
