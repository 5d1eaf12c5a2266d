//! The effect of a change of the map on a path.

use mediant_grid::{Change, FreeSpace, Placement, PlacementKind, Point, Rectangle, Vertex};

use super::{BrokenPath, Path};

impl Path {
    /// [`check`](Self::check) in the space after a change, of a path that held before: only at the changed
    /// cells anything is looked at, so the work follows the path. The result is the same.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use mediant_grid::{Centers, Change, CornerRule, FreeSpace, Grid};
    /// use mediant_search::Path;
    ///
    /// let space = FreeSpace::<Centers>::new(Arc::new(Grid::from_fn(9, 9, |_, _| false)?), CornerRule::Never);
    /// let path = Path::new(vec![(0, 0).into(), (8, 8).into()]);
    /// let change = Change::new(Arc::clone(space.grid())).edit_cells([(4, 4, true)]);
    /// assert!(path.check_after(&space.after(&change), &change).is_err());
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    ///
    /// # Errors
    /// As for [`check`](Self::check).
    pub fn check_after<P: Placement>(&self, space: &FreeSpace<P>, change: &Change) -> Result<(), BrokenPath> {
        if !self.is_empty() && !self.may_break(space, change.cells()) {
            return Ok(());
        }
        self.check(space)
    }

    /// Whether the path does not hold any more, if it held before these cells changed.
    fn may_break<P: Placement>(&self, space: &FreeSpace<P>, cells: &[Rectangle]) -> bool {
        if self.points.is_some() {
            return self.check(space).is_err();
        }
        let mut near = cells.iter().map(Near::of);
        let Some(first) = near.next() else { return false };
        // Most segments are near none of them.
        let around = near.fold(first, Near::around);
        let is_near = |one: Vertex, other: Vertex| {
            around.meets(one, other)
                && (cells.len() == 1 || cells.iter().any(|at| Near::of(at).meets(one, other)))
        };
        let waypoints = &self.waypoints;
        let ends = [waypoints.first(), waypoints.last()];
        ends.into_iter().flatten().any(|&end| is_near(end, end) && !space.is_free(end))
            || waypoints
                .windows(2)
                .any(|ends| is_near(ends[0], ends[1]) && space.obstruction(ends[0], ends[1]).is_some())
            || space.has_closed_gaps()
                && waypoints.iter().any(|&at| is_near(at, at) && space.is_closed_gap(at))
    }

    /// The length below which no path from its start to its goal is that passes cells which a change has
    /// freed; infinite if it has freed none on any way. So a shortest path is still a shortest one after the
    /// change if it holds, and is no longer than this.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use mediant_grid::{Centers, Change, CornerRule, FreeSpace, Grid};
    /// use mediant_search::Path;
    ///
    /// let walled = Arc::new(Grid::from_fn(9, 9, |x, y| x == 4 && y > 0)?);
    /// let path = Path::new(vec![(3, 8).into(), (3, 0).into(), (5, 0).into(), (5, 8).into()]);
    /// let far = Change::new(Arc::clone(&walled)).edit_cells([(4, 1, false)]);
    /// let near = Change::new(walled).edit_cells([(4, 7, false)]);
    /// assert!(path.cost() == 18.0 && path.least_by_freed::<Centers>(&far) > 13.0);
    /// assert!(path.least_by_freed::<Centers>(&near) < 2.0);
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    #[must_use]
    pub fn least_by_freed<P: Placement>(&self, change: &Change) -> f64 {
        let (Some(start), Some(goal)) = (self.start(), self.goal()) else {
            return f64::INFINITY;
        };
        let (before, after) = (change.before(), change.after());
        // The corner of cell (0, 0), in the coordinates of vertices.
        let corner = if P::KIND == PlacementKind::Center { -0.5 } else { 0.0 };
        let distance = |at: Point, &Rectangle { x, y, width, height }: &Rectangle| {
            let beyond = |at: f64, first: u32, length: u32| {
                let first = f64::from(first) + corner;
                (first - at).max(at - first - f64::from(length)).max(0.0)
            };
            beyond(at.x(), x, width).hypot(beyond(at.y(), y, height))
        };
        // A cell that was blocked can end a closed gap, at which a path starts then.
        let frees = |&Rectangle { x, y, width, height }: &Rectangle| {
            let is_freed =
                |x: u32, y: u32| before.is_blocked(x as i32, y as i32) && after.is_free(x as i32, y as i32);
            (y..y + height).any(|y| (x..x + width).any(|x| is_freed(x, y)))
        };
        let least = |at: &Rectangle| {
            let [from, to] = [start, goal].map(|end| distance(end, at));
            (from == 0.0 || to == 0.0 || frees(at)).then_some(from + to)
        };
        change.cells().iter().filter_map(least).fold(f64::INFINITY, f64::min)
    }
}

/// Around changed cells: the vertices, of either placement, from which a path may touch the cells.
#[derive(Clone, Copy)]
struct Near {
    first: Vertex,
    last: Vertex,
}

impl Near {
    const fn of(&Rectangle { x, y, width, height }: &Rectangle) -> Self {
        let (x, y) = (x as i32, y as i32);
        Self { first: Vertex::new(x - 1, y - 1), last: Vertex::new(x + width as i32, y + height as i32) }
    }

    fn around(self, other: Self) -> Self {
        let (one, two) = (self, other);
        Self {
            first: Vertex::new(one.first.x.min(two.first.x), one.first.y.min(two.first.y)),
            last: Vertex::new(one.last.x.max(two.last.x), one.last.y.max(two.last.y)),
        }
    }

    /// Whether the rectangle around two vertices meets this one.
    #[inline]
    fn meets(&self, one: Vertex, other: Vertex) -> bool {
        one.x.min(other.x) <= self.last.x
            && one.x.max(other.x) >= self.first.x
            && one.y.min(other.y) <= self.last.y
            && one.y.max(other.y) >= self.first.y
    }
}
