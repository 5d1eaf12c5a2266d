//! A cone that advances from line to line: the most frequent step of a search, by additions and words.

use mediant_grid::{
    BitMatrix, BitRow,
    sight::{Crossing, IntervalEnd, Place, Runs, Side, Window, row_ahead},
};

use super::{frontier::Node, goal::Goal};

/// The cone between a root and an interval of a line, before it crosses the row of cells ahead.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone<'g> {
    pub(super) root: Place,
    /// The root's number.
    pub(super) number: u32,
    pub(super) line: i32,
    /// 1 if the cone leads downwards, −1 if upwards.
    pub(super) down: i32,
    /// The line on which its interval may hold the goal.
    pub(super) stop: i32,
    pub(super) left: Edge,
    pub(super) right: Edge,
    pub(super) ahead: BitRow<'g>,
}

/// An edge of a cone: the end of its interval.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    end: IntervalEnd,
    /// Whether it is at the end of the run of free cells behind, so that the ray through it leads into an
    /// obstacle or along it. As long as it stays there it is treated as a vertical; only then it becomes a
    /// ray of its own.
    is_wall: bool,
}

/// The column where a wall cuts an interval off, if one does.
type Wall = Option<i32>;

impl Edge {
    #[inline]
    const fn on(end: IntervalEnd) -> Self {
        Self { end, is_wall: false }
    }

    #[inline]
    const fn wall(x: i32) -> Self {
        Self { end: IntervalEnd::standing(x), is_wall: true }
    }

    /// Moves to the next line.
    #[inline]
    const fn advance(&mut self, next: Crossing, wall: Wall) {
        match wall {
            Some(x) => *self = Self::wall(x),
            None => self.end.here = next,
        }
    }

    /// Where it meets the line.
    #[inline]
    pub(super) const fn here(&self) -> Crossing {
        self.end.here
    }
}

impl<'g> Cone<'g> {
    #[inline]
    pub(super) fn new(rows: &'g BitMatrix, root: Place, node: Node, goal: &Goal) -> Self {
        let Node { root: number, line, left, right } = node;
        let away = Place::parts(line) - root.y;
        let down = away.signum();
        let (ahead, stop) = (row_ahead(rows, line, down), goal.stop(down));
        Self { root, number, line, down, stop, left: Edge::on(left), right: Edge::on(right), ahead }
    }

    /// The cone of a successor on the next line, from a root that sees it.
    #[inline]
    pub(super) fn next(&self, root: Place, successor: Successor) -> Self {
        let Successor { root: number, left, right } = successor;
        let (line, ahead) = (self.line + self.down, self.ahead.below(self.down));
        Self { root, number, line, left: Edge::on(left), right: Edge::on(right), ahead, ..*self }
    }

    /// The row of cells that the cone crossed last.
    #[inline]
    pub(super) const fn behind(&self) -> BitRow<'g> {
        self.ahead.below(-self.down)
    }

    /// The interval of the cone as a node.
    pub(super) fn node(&self) -> Node {
        let [left, right] = [self.left, self.right].map(|edge| self.end(edge));
        Node { root: self.number, line: self.line, left, right }
    }

    /// The distance of the line from the root, in parts of a cell.
    #[inline]
    pub(super) const fn distance(&self) -> i32 {
        (Place::parts(self.line) - self.root.y) * self.down
    }

    /// The interval end at an edge, with its ray.
    #[inline]
    pub(super) const fn end(&self, edge: Edge) -> IntervalEnd {
        if edge.is_wall { self.corner(edge.end.here.floor()) } else { edge.end }
    }

    /// The interval end at a vertex of the line.
    #[inline]
    pub(super) const fn corner(&self, x: i32) -> IntervalEnd {
        IntervalEnd::corner(x, self.root.x, self.distance())
    }

    /// Whether the interval holds the goal, or the root sees the goal through it, in the next row of cells.
    #[inline]
    pub(super) fn holds(&self, goal: &Goal) -> bool {
        self.line == self.stop && goal.is_seen_by(self)
    }

    /// Advances from line to line while the cone crosses one run of free cells and no corner appears at which
    /// a path may bend.
    #[inline]
    pub(super) fn advance(&mut self, goal: &Goal) -> Ahead {
        loop {
            if !self.is_turning() && self.cross_free_rows(self.stop) && self.holds(goal) {
                return Ahead::Goal;
            }
            let (left, right) = (self.left.end.next(), self.right.end.next());
            let low = self.left.here().floor().min(left.floor());
            let high = self.right.here().ceil().max(right.ceil());
            let walls = if high - low < Window::WIDTH - 1 {
                self.walls(Window::new(self.ahead, low - 1), (left, right), (low, high))
            } else {
                self.walls(self.ahead, (left, right), (low, high))
            };
            let (left_wall, right_wall) = match walls {
                Ok(walls) => walls,
                Err(ahead) => return ahead,
            };
            self.line += self.down;
            self.ahead = self.ahead.below(self.down);
            self.left.advance(left, left_wall);
            self.right.advance(right, right_wall);
            if self.holds(goal) {
                return Ahead::Goal;
            }
        }
    }

    /// Whether an end of the interval is a vertex at the corner of an obstacle behind.
    #[inline]
    fn is_turning(&self) -> bool {
        let behind = self.behind();
        let turns =
            |edge: &Edge, outer: i32| !edge.is_wall && edge.here().is_vertex() && behind.is_blocked(outer);
        turns(&self.left, self.left.here().floor() - 1) || turns(&self.right, self.right.here().ceil())
    }

    /// Crosses rows in which nothing is in the way: all cells are free that the interval crosses or touches,
    /// and the walls that it follows go on. Stops before the first other row, or on line `stop` (then it
    /// returns true). No end may be at the corner of an obstacle behind.
    #[inline]
    fn cross_free_rows(&mut self, stop: i32) -> bool {
        let Self { left, right, .. } = *self;
        let walls = u64::from(left.is_wall) | u64::from(right.is_wall) << 63;
        let (mut from, mut to) = (left.end.here, right.end.here);
        let (mut line, mut ahead) = (self.line, self.ahead);
        let (mut low, mut high) = (from.cell_before(), to.floor());
        let is_stopped = loop {
            let (next_from, next_to) = (left.end.moved_to(from).next(), right.end.moved_to(to).next());
            let (next_low, next_high) = (next_from.cell_before(), next_to.floor());
            let (first, last) = (low.min(next_low), high.max(next_high));
            let is_free = next_from.is_left_of(next_to) && ahead.is_run(first, last, walls);
            if !is_free {
                break false;
            }
            (from, to, low, high) = (next_from, next_to, next_low, next_high);
            line += self.down;
            ahead = ahead.below(self.down);
            if line == stop {
                break true;
            }
        };
        (self.line, self.ahead) = (line, ahead);
        (self.left.end.here, self.right.end.here) = (from, to);
        is_stopped
    }

    /// Where walls cut the interval off on its left and right before the next line; what is ahead if it
    /// splits, ends, or if an obstacle hides something. `left` and `right` are its ends on the next line if
    /// no obstacle is in the way, `low` to `high` the columns that are crossed.
    #[inline(always)]
    fn walls(
        &self,
        ahead: impl Runs,
        (left, right): (Crossing, Crossing),
        (low, high): (i32, i32),
    ) -> Result<(Wall, Wall), Ahead> {
        let (first, last) = (self.left.here().floor(), self.right.here().ceil());
        if self.is_at_corner(&self.left, first - 1, ahead) || self.is_at_corner(&self.right, last, ahead) {
            return Err(Ahead::Corner);
        }
        if ahead.first_blocked(low, high) == high {
            // A vertical beside an obstacle is a wall from here on.
            let stands = |edge: &Edge, x: i32, outer: i32| {
                (edge.end.is_vertical() & edge.here().is_vertex() & ahead.is_blocked(outer)).then_some(x)
            };
            let walls = (stands(&self.left, first, first - 1), stands(&self.right, last, last));
            // Along a wall the interval may shrink to a point.
            return if left.floor() < right.ceil() { Ok(walls) } else { Err(Ahead::Nothing) };
        }
        let inside = ahead.first_free(first, last);
        if inside == last {
            return Err(Ahead::Nothing);
        }
        let start = if inside > first { inside } else { ahead.run_start(first, low) };
        let end = ahead.first_blocked(inside, high);
        let splits = end < last && ahead.first_free(end, last) < last;
        // A left obstacle that ends right of the vertical through the root hides something, and so does a
        // right one that ends left.
        let shades = inside > first && Place::parts(inside) > self.root.x
            || end < last && Place::parts(end) < self.root.x;
        let empties = left.floor() >= end || right.ceil() <= start;
        if splits || shades {
            return Err(Ahead::Corner);
        }
        if empties {
            return Err(Ahead::Nothing);
        }
        let left_wall = inside > first || Side::Left.is_outside(left, start);
        let right_wall = end < last || Side::Right.is_outside(right, end);
        Ok((left_wall.then_some(start), right_wall.then_some(end)))
    }

    /// Whether the obstacle beside an edge, in column `outer`, begins or ends on this line: then a path may
    /// bend around its corner.
    #[inline]
    fn is_at_corner(&self, edge: &Edge, outer: i32, ahead: impl Runs) -> bool {
        let behind = || edge.is_wall || self.behind().is_blocked(outer);
        edge.here().is_vertex() && ahead.is_blocked(outer) != behind()
    }
}

/// The outcome of a cone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ahead {
    /// The goal.
    Goal,
    /// A row in which it splits, or a corner at which a path may bend.
    Corner,
    /// A row that it does not enter.
    Nothing,
}

/// A successor of a cone node: an interval of the next line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Successor {
    /// The number of the root that sees it.
    pub(super) root: u32,
    pub(super) left: IntervalEnd,
    pub(super) right: IntervalEnd,
}

impl Successor {
    /// Whether nothing lies behind the interval, and the goal does not lie in it.
    #[inline]
    pub(super) fn is_cul_de_sac(self, cone: &Cone<'_>, goal: &Goal) -> bool {
        let (left, right) = (self.left.here, self.right.here);
        let (behind, ahead) = (cone.ahead, cone.ahead.below(cone.down));
        let turns =
            |at: Crossing, outer: i32| at.is_vertex() && behind.is_blocked(outer) && !ahead.is_blocked(outer);
        let may_hold_goal = || cone.line + cone.down == cone.stop && goal.may_be_in(left, right);
        ahead.first_free(left.floor(), right.ceil()) == right.ceil()
            && !turns(left, left.floor() - 1)
            && !turns(right, right.floor())
            && !may_hold_goal()
    }
}
