//! From which vertex to which a query asks for a path.

use mediant_grid::{Point, Vector, Vertex};
use mediant_moves::Cost;

use super::{EndSpace, PointEnds, Wishes, nearest::nearest};
use crate::{
    limit::with_room,
    metric::Metric,
    query::{End, QueryError},
};

/// No path by a displacement costs less.
pub(super) type Bound<'b> = dyn Fn(Vector) -> Cost + 'b;

/// A path that answers the query, if it is the shortest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pair {
    pub(super) ends: PointEnds,
    /// No path between the two costs less: the straight line, or h_k where paths are over N(k).
    pub(super) least: Cost,
    /// Its place in the order of goals, then of starts.
    pub(super) rank: (u32, u32),
}

/// The pairs of start and goal that a query asks for, in the coordinates of its search.
#[derive(Debug)]
pub(super) struct EndSets {
    /// The connected pairs, by their least cost, then by rank.
    pub(super) pairs: Vec<Pair>,
    /// The first start.
    pub(super) start: Point,
    /// Whether the goals are the vertices nearest to those of the query.
    pub(super) are_nearest: bool,
}

impl EndSets {
    /// The one start that all pairs have, if there are several pairs between vertices, and it is no goal
    /// itself.
    pub(super) fn only_start(&self) -> Option<Vertex> {
        let first = self.pairs.first().filter(|first| self.pairs.len() > 1 && first.least != Cost::ZERO)?;
        let start = first.ends.start;
        let is_from_start = |pair: &Pair| pair.ends.start == start && pair.ends.goal.vertex().is_some();
        start.vertex().filter(|_| self.pairs.iter().all(is_from_start))
    }

    /// The pairs of a query. `metric` is h_k or the straight line, by which 'near' is measured.
    pub(super) fn new(
        space: &impl EndSpace,
        metric: Metric,
        bound: &Bound<'_>,
        wishes: &Wishes,
    ) -> Result<Self, QueryError> {
        wishes.limits.check()?;
        if wishes.tolerance.is_nan() || wishes.tolerance < 0.0 {
            return Err(QueryError::Tolerance);
        }
        let starts = free_ends(space, metric, wishes, End::Start, &wishes.starts)?;
        let goals = free_ends(space, metric, wishes, End::Goal, &wishes.goals)?;
        let start = *starts.first().ok_or(QueryError::NoEnd { end: End::Start })?;
        let mut ends = Self { pairs: Vec::new(), start: space.searched(start), are_nearest: false };
        ends.add(space, bound, &starts, &goals);
        if ends.pairs.is_empty() && wishes.nearest {
            ends.are_nearest = true;
            ends.add_nearest(space, metric, bound, &starts, wishes);
        }
        ends.pairs.sort_unstable_by_key(|pair| (pair.least, pair.rank));
        Ok(ends)
    }

    /// Adds the pairs that are connected.
    fn add(&mut self, space: &impl EndSpace, bound: &Bound<'_>, starts: &[Point], goals: &[Point]) {
        for (&goal, goal_rank) in goals.iter().zip(0..) {
            for (&start, start_rank) in starts.iter().zip(0..) {
                if space.connected(start, goal) {
                    let ends = PointEnds::new(start, goal);
                    let least = match ends.vertices() {
                        Some(ends) => bound(ends.start.to(ends.goal)),
                        None => Metric::Euclidean.between(start, goal),
                    };
                    let ends = PointEnds::new(space.searched(start), space.searched(goal));
                    self.pairs.push(Pair { ends, least, rank: (goal_rank, start_rank) });
                }
            }
        }
    }

    /// Adds the vertices that can be reached and are nearest to a goal of the query.
    fn add_nearest(
        &mut self,
        space: &impl EndSpace,
        metric: Metric,
        bound: &Bound<'_>,
        starts: &[Point],
        wishes: &Wishes,
    ) {
        let is_reachable = |at: Vertex| starts.iter().any(|&start| space.connected(start, at.into()));
        let mut near: Option<(Cost, Vec<Vertex>)> = None;
        for &goal in &wishes.goals {
            let goal = space.clamped(goal);
            let Some((cost, vertices)) = nearest(space, metric, goal, is_reachable) else { continue };
            match &mut near {
                Some((least, _)) if *least < cost => {}
                Some((least, known)) if *least == cost => known.extend(vertices),
                _ => near = Some((cost, vertices)),
            }
        }
        let mut goals = near.map_or(Vec::new(), |(_, vertices)| vertices);
        goals.sort_unstable_by_key(|at| (at.y, at.x));
        goals.dedup();
        let goals: Vec<Point> = goals.into_iter().map(Into::into).collect();
        self.add(space, bound, starts, &goals);
    }
}

/// The points at which paths may begin or end: the free ones among the ends of a query, the vertices within
/// the tolerance of a goal, and those to which blocked ends are moved.
fn free_ends(
    space: &impl EndSpace,
    metric: Metric,
    wishes: &Wishes,
    end: End,
    ends: &[Point],
) -> Result<Vec<Point>, QueryError> {
    if ends.is_empty() {
        return Err(QueryError::NoEnd { end });
    }
    let mut free = Vec::with_capacity(ends.len());
    for &at in ends {
        // Over N(k) a point between vertices is no end, whatever is wished.
        if at.vertex().is_none() && !matches!(metric, Metric::Euclidean) {
            return Err(QueryError::Between { end, at });
        }
        let known = free.len();
        let checked = space.check(end, at);
        if end == End::Goal && wishes.tolerance > 0.0 && space.clamped(at) == at {
            free.extend(around(space, at, wishes.tolerance).map(Point::from));
            if at.vertex().is_none() && checked.is_ok() {
                free.push(at);
            }
        } else if checked.is_ok() {
            free.push(at);
        }
        if free.len() > known {
            continue;
        }
        if wishes.snap {
            let at = space.clamped(at);
            let moved = nearest(space, metric, at, |at| space.is_free(at))
                .and_then(|(_, near)| near.first().copied());
            free.push(moved.map(Point::from).ok_or_else(|| nothing_free(space, end, at))?);
        } else if end == End::Start || !wishes.nearest || space.clamped(at) != at {
            checked?;
        }
    }
    Ok(free)
}

/// The error of an end on a map on which no vertex is free.
fn nothing_free(space: &impl EndSpace, end: End, at: Point) -> QueryError {
    space.check(end, at).err().unwrap_or(QueryError::NothingFree { end, at })
}

/// The free vertices within a distance of a goal, row by row.
fn around<S: EndSpace>(space: &S, goal: Point, cells: f64) -> impl Iterator<Item = Vertex> {
    let (width, height) = space.size();
    // A float that is too large becomes the greatest integer.
    let reach = with_room(cells) as i32;
    let (low, high) = (goal.floor(), goal.ceil());
    let rows = (low.y.saturating_sub(reach)).max(0)..=high.y.saturating_add(reach).min(height as i32 - 1);
    let columns = (low.x.saturating_sub(reach)).max(0)..=high.x.saturating_add(reach).min(width as i32 - 1);
    let all = rows.flat_map(move |y| columns.clone().map(move |x| Vertex::new(x, y)));
    let greatest = with_room(cells) * with_room(cells);
    all.filter(move |&at| goal.distance_squared(at.into()) <= greatest && space.is_free(at))
}
