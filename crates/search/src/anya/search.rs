//! A search: the successors of a node.

use mediant_grid::{
    BitMatrix, Corners, FreeSpace, Vertex,
    sight::{IntervalEnd, Place, Runs, Side, Window, row_ahead},
};

use super::{
    cone::{Ahead, Cone, Successor},
    frontier::{Frontier, Node},
    goal::Goal,
    norm::{Interval, Norm},
};
use crate::observer::{NodeEvent, Observer};

/// A search.
pub(super) struct AnyaSearch<'s, N: Norm, O> {
    pub(super) space: &'s FreeSpace<Corners>,
    /// The rows of the map, of which dead ends may be left out.
    pub(super) rows: &'s BitMatrix,
    pub(super) frontier: &'s mut Frontier<N>,
    pub(super) goal: Goal,
    pub(super) observer: &'s mut O,
    /// Scratch memory for the successors of one node.
    pub(super) next: &'s mut Vec<Successor>,
}

impl<N: Norm, O: Observer> AnyaSearch<'_, N, O> {
    /// Forgets the last search and queues the nodes that the start sees.
    pub(super) fn start(&mut self, at: Place) {
        self.frontier.start(at);
        // From a closed gap a path leaves into the quadrant of the vertex's own cell.
        let gap = at.vertex().is_some_and(|at| self.space.is_closed_gap(at));
        for down in [1, -1] {
            if gap && down < 0 {
                continue;
            }
            let line = at.line(down);
            let (start, end) = at.run(row_ahead(self.rows, line, down));
            let first = if gap { at.columns().0 } else { start };
            if first < end {
                self.see_goal(0, (line, down), first);
                let away = (Place::parts(line + down) - at.y) * down;
                let [left, right] = [first, end].map(|x| IntervalEnd::corner(x, at.x, away));
                self.push(Node { root: 0, line: line + down, left, right });
            }
        }
        if at.line(1) != at.line(-1) {
            return;
        }
        let (before, after) = at.columns();
        for (right, x) in [(1, before), (-1, after)] {
            if !gap || right > 0 {
                self.push_flat(0, Vertex::new(x, at.line(1)), right);
            }
        }
    }

    /// Queues the goal, if a root sees it through the row of cells beyond its line, of which it touches the
    /// cell in a column.
    #[inline(always)]
    fn see_goal(&mut self, root: u32, row: (i32, i32), column: i32) {
        if self.goal.vertex.is_none() {
            self.see_goal_between(root, row, column);
        }
    }

    /// [`see_goal`](Self::see_goal) of a goal between vertices.
    #[cold]
    #[inline(never)]
    fn see_goal_between(&mut self, root: u32, row: (i32, i32), column: i32) {
        if self.goal.is_beside(row, column) {
            let to = self.frontier.root(root).at.to(self.goal.at);
            self.add(Node::of_goal(root), self.frontier.norm().bound(to));
        }
    }

    /// Whether the node holds the goal, and a path from its root may end there.
    pub(super) fn reaches_goal(&self, node: Node) -> bool {
        if !self.goal.may_be_on(node.line) {
            return node.is_of_goal()
                && self.goal.may_be_entered(self.space, self.frontier.root(node.root).at);
        }
        let root = self.frontier.root(node.root).at;
        let found = if Place::parts(node.line) == root.y {
            self.goal.at == Place { x: root.x + node.left.ray.dx, y: root.y }
        } else {
            Cone::new(self.rows, root, node, &self.goal).holds(&self.goal)
        };
        found && self.goal.may_be_entered(self.space, root)
    }

    /// Puts the successors of a node on the open list.
    pub(super) fn expand(&mut self, node: Node) {
        let root = self.frontier.root(node.root).at;
        if Place::parts(node.line) == root.y {
            return self.expand_flat(node, root);
        }
        let mut cone = Cone::new(self.rows, root, node, &self.goal);
        loop {
            self.next.clear();
            match cone.advance(&self.goal) {
                Ahead::Corner => {}
                Ahead::Nothing => break,
                Ahead::Goal => {
                    self.push(cone.node());
                    break;
                }
            }
            self.cross_row(&cone);
            if self.next.len() > 1 {
                self.next.retain(|next| !next.is_cul_de_sac(&cone, &self.goal));
            }
            if let [only] = self.next[..] {
                cone = cone.next(self.frontier.root(only.root).at, only);
                if !cone.holds(&self.goal) {
                    continue;
                }
                self.push(cone.node());
                break;
            }
            for i in 0..self.next.len() {
                let Successor { root, left, right } = self.next[i];
                self.push(Node { root, line: cone.line + cone.down, left, right });
            }
            break;
        }
    }

    /// Puts a cone node on the open list.
    fn push(&mut self, node: Node) {
        let root = self.frontier.root(node.root);
        let n = (Place::parts(node.line) - root.at.y).abs();
        let [left, right] = [node.left, node.right].map(|end| end.ray.column(root.at.x, n));
        let interval = Interval { root: root.at, line: node.line, left, right };
        self.add(node, self.frontier.norm().bound_through(interval, self.goal.at));
    }

    /// Puts a node on the open list, with its h.
    fn add(&mut self, node: Node, h: N::Bound) {
        let f = self.frontier.push(node, h);
        let root = self.frontier.root(node.root);
        let (parent, f) = (self.frontier.parent(node.root), N::cost_of_priority(f));
        self.observer.generated(NodeEvent { at: root.at.floor(), parent, g: N::cost(root.g), f });
    }

    /// Queues the flat node at the next vertex beyond `from`, on the line of a root, at which a path may turn
    /// or end.
    fn push_flat(&mut self, root: u32, from: Vertex, right: i32) {
        let [above, below] = [-1, 1].map(|down| row_ahead(self.rows, from.y, down));
        let closed = self.space.has_closed_gaps();
        let mut passed = 0;
        let (steps, dead) = loop {
            let first = if right > 0 { from.x + passed } else { from.x - passed - 64 };
            let [(u, u_next), (d, d_next)] =
                [above, below].map(|strip| (strip.word(first), strip.word(first + right)));
            let dead = u & d;
            let turn = u & !u_next | d & !d_next;
            let gap = if closed { u & !u_next & !d & d_next | d & !d_next & !u & u_next } else { 0 };
            let stop = dead | turn;
            if stop != 0 {
                let (n, bit) = if right > 0 {
                    (stop.trailing_zeros(), stop & stop.wrapping_neg())
                } else {
                    (stop.leading_zeros(), 1 << (63 - stop.leading_zeros()))
                };
                let is_dead = dead & bit != 0;
                break (passed + n as i32 + i32::from(!is_dead), is_dead || gap & bit != 0);
            }
            passed += 64;
        };
        let (goal, from) = (self.goal.at, Place::of(from));
        let to_goal = (goal.x - from.x) * right;
        let is_goal = goal.y == from.y && 0 < to_goal && to_goal <= Place::parts(steps);
        if dead && !is_goal {
            return;
        }
        let at = if is_goal { goal } else { Place { x: from.x + right * Place::parts(steps), ..from } };
        let start = self.frontier.root(root);
        let norm = self.frontier.norm();
        let h = norm.bound(start.at.to(at)) + norm.bound(at.to(goal));
        self.add(Node::aside(root, at.floor().y, at.x - start.at.x), h);
    }

    /// Queues the successors of a flat node: paths that turn up or down at its vertex, and the next flat node
    /// on the line.
    fn expand_flat(&mut self, node: Node, root: Place) {
        let right = node.left.ray.dx.signum();
        let at = Place { x: root.x + node.left.ray.dx, ..root }.floor();
        let (passed, entered) = if right > 0 { (at.x - 1, at.x) } else { (at.x, at.x - 1) };
        // The goal, at which this path may not end. No path passes a closed gap.
        if self.space.is_closed_gap(at) {
            return;
        }
        for down in [-1, 1] {
            let strip = row_ahead(self.rows, at.y, down);
            if !strip.is_blocked(passed) || strip.is_blocked(entered) {
                continue;
            }
            let Some(number) = self.frontier.add_root(node.root, at) else { continue };
            let far = if right > 0 { strip.first_blocked(at.x, i32::MAX) } else { strip.run_start(at.x, 0) };
            self.see_goal(number, (at.y, down), entered);
            let far = IntervalEnd::corner(far, Place::parts(at.x), Place::parts(1));
            let near = IntervalEnd::standing(at.x);
            let (left, right) = if right > 0 { (near, far) } else { (far, near) };
            self.push(Node { root: number, line: at.y + down, left, right });
        }
        self.push_flat(node.root, at, right);
    }

    /// Finds the successors on the next line.
    #[inline]
    fn cross_row(&mut self, cone: &Cone<'_>) {
        let (left, right) = (cone.end(cone.left), cone.end(cone.right));
        let low = left.here.floor().min(left.next().floor());
        let high = right.here.ceil().max(right.next().ceil());
        // From the column before `low` to the one after `high`, beyond which the last run may end.
        if high - low < Window::WIDTH - 2 {
            let [ahead, behind] = [cone.ahead, cone.behind()].map(|row| Window::new(row, low - 1));
            self.cross_row_of(cone, (ahead, behind), (left, right));
        } else {
            self.cross_row_of(cone, (cone.ahead, cone.behind()), (left, right));
        }
    }

    /// [`cross_row`](Self::cross_row), given the rows of cells.
    #[inline(always)]
    fn cross_row_of(
        &mut self,
        cone: &Cone<'_>,
        (ahead, behind): (impl Runs, impl Runs),
        (left, right): (IntervalEnd, IntervalEnd),
    ) {
        let (first, last) = (left.here.floor(), right.here.ceil());
        let turns = |end: IntervalEnd, outer: i32| {
            end.here.is_vertex() & behind.is_blocked(outer) & !ahead.is_blocked(outer)
        };
        if turns(left, first - 1) {
            self.turn_at_end(cone, left, Side::Left);
        }
        if turns(right, last) {
            self.turn_at_end(cone, right, Side::Right);
        }
        let (next_left, next_right) = (left.next(), right.next());
        let (low, high) = (first.min(next_left.floor()), last.max(next_right.ceil()));
        let mut column = first;
        loop {
            column = ahead.first_free(column, last);
            if column >= last {
                break;
            }
            // Only the part of a run that the cone reaches matters.
            let start = if column == first { ahead.run_start(column, low) } else { column };
            let stop = ahead.first_blocked(column, high);
            self.add_visible(cone, ahead, (left, right), (start, stop));
            column = stop + 1;
        }
    }

    /// Where an end of the interval is the corner of an obstacle on the near side of the line: adds the paths
    /// that bend around it into what the obstacle hides.
    fn turn_at_end(&mut self, cone: &Cone<'_>, end: IntervalEnd, side: Side) {
        let ahead = cone.ahead;
        let x = end.here.floor();
        let (outer, inner) = side.columns(x);
        let at = Vertex::new(x, cone.line);
        let is_closed_gap = ahead.is_blocked(inner);
        if is_closed_gap && self.space.is_closed_gap(at) {
            return;
        }
        let (start, stop) = (ahead.run_start(x, 0), ahead.first_blocked(x, i32::MAX));
        let (far, limit) = match side {
            Side::Left => (start, stop),
            Side::Right => (stop, start),
        };
        // Between two obstacles everything is hidden.
        let end = if is_closed_gap { IntervalEnd::standing(x) } else { end };
        let Some(number) = self.frontier.add_root(cone.number, at) else { return };
        self.see_goal(number, (cone.line, cone.down), outer);
        if side.is_inside(end.next(), far) {
            self.add_behind(number, x, side, (far, limit), end);
        }
        self.push_flat(number, at, side.sign());
    }

    /// For a run of free cells that the cone enters: adds the interval behind it that the root sees, and
    /// those that the obstacles at the ends of the run hide.
    #[inline(always)]
    fn add_visible(
        &mut self,
        cone: &Cone<'_>,
        ahead: impl Runs,
        (left, right): (IntervalEnd, IntervalEnd),
        (start, stop): (i32, i32),
    ) {
        let left = if start > left.here.floor() { cone.corner(start) } else { left };
        let right = if stop < right.here.ceil() { cone.corner(stop) } else { right };
        let (next_left, next_right) = (left.next(), right.next());
        let is_corner = |end: IntervalEnd, x: i32, outer: i32| {
            end.here.is_vertex() & (end.here.floor() == x) & ahead.is_blocked(outer)
        };
        if is_corner(left, start, start - 1) {
            self.add_hidden(cone, start, Side::Left, stop, left);
        }
        if is_corner(right, stop, stop) {
            self.add_hidden(cone, stop, Side::Right, start, right);
        }
        if (next_left.floor() < stop) & (next_right.ceil() > start) {
            let clipped = |x: i32| IntervalEnd::corner(x, cone.root.x, cone.distance() + Place::parts(1));
            let is_wall = Side::Left.is_outside(next_left, start);
            let left = if is_wall { clipped(start) } else { left.moved_to(next_left) };
            let is_wall = Side::Right.is_outside(next_right, stop);
            let right = if is_wall { clipped(stop) } else { right.moved_to(next_right) };
            self.next.push(Successor { root: cone.number, left, right });
        }
    }

    /// Adds what the corner of an obstacle in column `x`, at the end of a run that the cone enters, hides of
    /// that run, up to its other end `limit`.
    #[inline(always)]
    fn add_hidden(&mut self, cone: &Cone<'_>, x: i32, side: Side, limit: i32, end: IntervalEnd) {
        if side.is_inside(end.next(), x) {
            let at = Vertex::new(x, cone.line);
            let Some(root) = self.frontier.add_root(cone.number, at) else { return };
            let (_, inner) = side.columns(x);
            self.see_goal(root, (cone.line, cone.down), inner);
            self.add_behind(root, x, side, (x, limit), end);
        }
    }

    /// Adds what the corner of an obstacle in column `x`, a root, hides of a run: on the next line the
    /// interval from `far` to where the ray past the corner meets it, at most to `limit`.
    #[inline]
    fn add_behind(&mut self, root: u32, x: i32, side: Side, (far, limit): (i32, i32), end: IntervalEnd) {
        let next = end.next();
        let to = |column: i32| IntervalEnd::corner(column, Place::parts(x), Place::parts(1));
        let near = if side.is_inside(next, limit) { to(limit) } else { end.moved_to(next) };
        let (left, right) = match side {
            Side::Left => (to(far), near),
            Side::Right => (near, to(far)),
        };
        self.next.push(Successor { root, left, right });
    }
}
