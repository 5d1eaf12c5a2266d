//! From which vertex to which a query asks for a path.

use mediant_grid::{FreeSpace, Placement, Vector, Vertex};
use mediant_moves::Cost;

use super::{Wishes, nearest::nearest};
use crate::{
    limit::with_room,
    metric::Metric,
    query::{End, Ends, QueryError},
};

/// No path by a displacement costs less.
pub(super) type Bound<'b> = dyn Fn(Vector) -> Cost + 'b;

/// A path that answers the query, if it is the shortest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pair {
    pub(super) ends: Ends,
    /// No path between the two costs less: the straight line, or h_k where paths are over N(k).
    pub(super) least: Cost,
    /// Its place in the order of goals, then of starts.
    pub(super) rank: (u32, u32),
}

/// The pairs of start and goal that a query asks for.
#[derive(Debug)]
pub(super) struct EndSets {
    /// The connected pairs, by their least cost, then by rank.
    pub(super) pairs: Vec<Pair>,
    /// The first start.
    pub(super) start: Vertex,
    /// Whether the goals are the vertices nearest to those of the query.
    pub(super) are_nearest: bool,
}

impl EndSets {
    /// The one start that all pairs have, if there are several pairs, and it is no goal itself.
    pub(super) fn only_start(&self) -> Option<Vertex> {
        let first = self.pairs.first().filter(|first| self.pairs.len() > 1 && first.least != Cost::ZERO)?;
        let start = first.ends.start;
        self.pairs.iter().all(|pair| pair.ends.start == start).then_some(start)
    }

    /// The pairs of a query. `metric` is h_k or the straight line, by which 'near' is measured.
    pub(super) fn new<P: Placement>(
        space: &FreeSpace<P>,
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
        let mut ends = Self { pairs: Vec::new(), start, are_nearest: false };
        ends.add(space, bound, &starts, &goals);
        if ends.pairs.is_empty() && wishes.nearest {
            ends.are_nearest = true;
            ends.add_nearest(space, metric, bound, &starts, wishes);
        }
        ends.pairs.sort_unstable_by_key(|pair| (pair.least, pair.rank));
        Ok(ends)
    }

    /// Adds the pairs that are connected.
    fn add<P: Placement>(
        &mut self,
        space: &FreeSpace<P>,
        bound: &Bound<'_>,
        starts: &[Vertex],
        goals: &[Vertex],
    ) {
        for (&goal, goal_rank) in goals.iter().zip(0..) {
            for (&start, start_rank) in starts.iter().zip(0..) {
                if space.connected(start, goal) {
                    let least = bound(start.to(goal));
                    let rank = (goal_rank, start_rank);
                    self.pairs.push(Pair { ends: Ends::new(start, goal), least, rank });
                }
            }
        }
    }

    /// Adds the vertices that can be reached and are nearest to a goal of the query.
    fn add_nearest<P: Placement>(
        &mut self,
        space: &FreeSpace<P>,
        metric: Metric,
        bound: &Bound<'_>,
        starts: &[Vertex],
        wishes: &Wishes,
    ) {
        let is_reachable = |at: Vertex| starts.iter().any(|&start| space.connected(start, at));
        let mut near: Option<(Cost, Vec<Vertex>)> = None;
        for &goal in &wishes.goals {
            let goal = clamped(space, goal);
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
        self.add(space, bound, starts, &goals);
    }
}

/// The vertices at which paths may begin or end: the free ones among the ends of a query, those within the
/// tolerance of a goal, and those to which blocked ends are moved.
fn free_ends<P: Placement>(
    space: &FreeSpace<P>,
    metric: Metric,
    wishes: &Wishes,
    end: End,
    ends: &[Vertex],
) -> Result<Vec<Vertex>, QueryError> {
    if ends.is_empty() {
        return Err(QueryError::NoEnd { end });
    }
    let mut free = Vec::with_capacity(ends.len());
    for &at in ends {
        let known = free.len();
        if end == End::Goal && wishes.tolerance > 0.0 && space.id(at).is_some() {
            free.extend(around(space, at, wishes.tolerance));
        } else if space.is_free(at) {
            free.push(at);
        }
        if free.len() > known {
            continue;
        }
        if wishes.snap {
            let at = clamped(space, at);
            let moved = nearest(space, metric, at, |at| space.is_free(at))
                .and_then(|(_, near)| near.first().copied());
            free.push(moved.ok_or_else(|| end.blocked(space, at))?);
        } else if end == End::Start || !wishes.nearest || space.id(at).is_none() {
            end.check(space, at)?;
        }
    }
    Ok(free)
}

/// The free vertices within a distance of a goal, row by row.
fn around<P: Placement>(space: &FreeSpace<P>, goal: Vertex, cells: f64) -> impl Iterator<Item = Vertex> {
    let (width, height) = P::vertices(space.grid());
    // A float that is too large becomes the greatest integer.
    let reach = with_room(cells) as i32;
    let rows = (goal.y.saturating_sub(reach)).max(0)..=goal.y.saturating_add(reach).min(height as i32 - 1);
    let columns = (goal.x.saturating_sub(reach)).max(0)..=goal.x.saturating_add(reach).min(width as i32 - 1);
    let all = rows.flat_map(move |y| columns.clone().map(move |x| Vertex::new(x, y)));
    let greatest = with_room(cells) * with_room(cells);
    all.filter(move |&at| at.to(goal).norm_squared() as f64 <= greatest && space.is_free(at))
}

/// The vertex of the map's rectangle that is nearest along each axis.
fn clamped<P: Placement>(space: &FreeSpace<P>, at: Vertex) -> Vertex {
    let (width, height) = P::vertices(space.grid());
    Vertex::new(at.x.clamp(0, width as i32 - 1), at.y.clamp(0, height as i32 - 1))
}
