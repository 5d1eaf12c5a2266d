//! Shortest any-angle paths between points, over the convex corners that they see.

use mediant_grid::{DiagonalGap, Grid};

use super::{
    Parts, distance, point_is_free, point_of, segment_between_points_is_legal, turn_at_point_is_legal,
};
use crate::Visibility;

/// The convex corners of the obstacles of a grid, to answer any-angle queries between points anywhere.
///
/// An optimal path bends at convex corners only, wherever it starts and ends: it is straight, or leads from
/// the start to a corner that it sees, over the graph of [`Visibility`], and from a corner to the goal.
///
/// Meant for maps as small as those of [`Visibility`]. The segments from a point to all corners are tested
/// anew for each query.
///
/// ```
/// use mediant_grid::{AsciiMap, DiagonalGap};
/// use mediant_oracle::PointVisibility;
///
/// let map = AsciiMap::parse("
///     .#.
///     ...
/// ")?;
/// let visibility = PointVisibility::new(&map.grid, DiagonalGap::Open);
/// // From the center of the first cell to that of the third, under the blocked one.
/// let (start, goal) = ((512, 512), (2560, 512));
/// let costs = visibility.costs_from(start);
/// assert!((costs.to(goal).unwrap() - (1.0 + 2.0_f64.sqrt())).abs() < 1e-12);
/// assert_eq!(costs.path_to(goal), Some(vec![start, (1024, 1024), (2048, 1024), goal]));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Debug)]
pub struct PointVisibility<'g> {
    grid: &'g Grid,
    gap: DiagonalGap,
    visibility: Visibility<'g>,
}

impl<'g> PointVisibility<'g> {
    /// Tests the segments between all pairs of convex corners.
    #[must_use]
    pub fn new(grid: &'g Grid, gap: DiagonalGap) -> Self {
        Self { grid, gap, visibility: Visibility::new(grid, gap) }
    }

    /// The optimal costs from `start` to every corner, and thereby to every point. If `start` is blocked or
    /// outside the map, no point is reached.
    #[must_use]
    pub fn costs_from(&self, start: Parts) -> PointCosts<'_> {
        let corners = self.corners();
        let first = corners.map(|corner| self.sees(start, corner).then(|| distance(start, corner))).collect();
        let (cost, previous) = self.visibility.spread(first, |a, b| distance(point_of(a), point_of(b)));
        PointCosts { visibility: self, start, cost, previous }
    }

    /// The cost of an optimal path from `start` to `goal`, in cells; `None` as for [`PointCosts::to`].
    #[must_use]
    pub fn cost(&self, start: Parts, goal: Parts) -> Option<f64> {
        self.costs_from(start).to(goal)
    }

    /// The convex corners as points.
    fn corners(&self) -> impl Iterator<Item = Parts> {
        self.visibility.corners().iter().map(|&corner| point_of(corner))
    }

    /// Whether a path may start at `end` and go straight to `other`, or come from there and end at `end`.
    fn sees(&self, end: Parts, other: Parts) -> bool {
        self.may_end(end, other) && segment_between_points_is_legal(self.grid, self.gap, end, other)
    }

    /// Whether the rule of closed gaps lets a path start or end at `end`, with `other` next to it.
    fn may_end(&self, end: Parts, other: Parts) -> bool {
        self.gap == DiagonalGap::Open || turn_at_point_is_legal(self.grid, None, end, Some(other))
    }
}

/// The optimal costs from one start, over the convex corners.
#[derive(Clone, Debug)]
pub struct PointCosts<'v> {
    visibility: &'v PointVisibility<'v>,
    start: Parts,
    /// The cost of each corner.
    cost: Vec<f64>,
    /// For each corner the corner before it; `None` if that is the start.
    previous: Vec<Option<u32>>,
}

impl PointCosts<'_> {
    /// The cost of an optimal path to `goal`, in cells, 0 for the start itself; `None` if there is no path,
    /// or if start or goal is blocked or outside the map.
    #[must_use]
    pub fn to(&self, goal: Parts) -> Option<f64> {
        self.last_step(goal).map(|(cost, _)| cost)
    }

    /// The waypoints of an optimal path to `goal`; `None` as for [`to`](Self::to). Those between its ends are
    /// convex corners.
    #[must_use]
    pub fn path_to(&self, goal: Parts) -> Option<Vec<Parts>> {
        let (_, mut last) = self.last_step(goal)?;
        let mut path = vec![goal];
        while let Some(corner) = last {
            path.push(point_of(self.visibility.visibility.corners()[corner as usize]));
            last = self.previous[corner as usize];
        }
        path.push(self.start);
        // Start or goal may be a corner itself.
        path.dedup();
        path.reverse();
        Some(path)
    }

    /// The cost to `goal`, and the corner from which it is reached; `None` for the corner if it is reached
    /// straight from the start.
    fn last_step(&self, goal: Parts) -> Option<(f64, Option<u32>)> {
        let (visibility, start) = (self.visibility, self.start);
        if start == goal {
            return point_is_free(visibility.grid, goal).then_some((0.0, None));
        }
        let is_straight = visibility.may_end(start, goal) && visibility.sees(goal, start);
        let mut best = is_straight.then(|| (distance(start, goal), None));
        for (i, corner) in visibility.corners().enumerate() {
            let cost = self.cost[i] + distance(corner, goal);
            if cost < best.map_or(f64::INFINITY, |(cost, _)| cost) && visibility.sees(goal, corner) {
                best = Some((cost, Some(i as u32)));
            }
        }
        best
    }
}
