//! Distances to many goals at once.
//!
//! **The nearest goal.** Of each hub's goals only the nearest counts, and subgoals further away than the best
//! goal so far lead to no nearer one. Goals in sight of the start are found by their place, no further away
//! than that goal.

use mediant_grid::{FreeSpace, Identity, Interrupt, Interrupted, Vertex, uninterrupted};
use mediant_moves::Cost;
use mediant_search::{End, QueryError};

use super::{HubLabels, join::Join, near::Strips};
use crate::{edge_path::direct_path, placement::SubgoalPlacement};

/// Goals that many starts ask for: the hubs of each, sorted by hub. Made by [`HubLabels::goals`].
#[derive(Clone, Debug)]
pub struct Goals {
    identity: Identity,
    goals: Vec<Vertex>,
    strips: Strips,
    /// By hub, the number of its first entry.
    first: Vec<u32>,
    /// The cost from the hub to a goal, and the number of the goal; of each hub from the nearest goal on.
    entries: Vec<(u64, u32)>,
}

impl Goals {
    /// The goals, in the order in which they were given.
    #[must_use]
    pub fn vertices(&self) -> &[Vertex] {
        &self.goals
    }

    /// The goals whose paths lead over a hub.
    #[inline]
    fn over(&self, hub: u32) -> &[(u64, u32)] {
        let [first, end] = [hub, hub + 1].map(|hub| self.first[hub as usize] as usize);
        &self.entries[first..end]
    }
}

/// A call over many goals that has no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GoalsError {
    /// An end is wrong, or the goals are others.
    #[error(transparent)]
    Query(#[from] QueryError),
    /// It was stopped.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

/// The result of work that nothing stops.
pub(super) fn unstopped<T>(work: impl FnOnce(&Interrupt) -> Result<T, GoalsError>) -> Result<T, QueryError> {
    uninterrupted(|never| match work(never) {
        Ok(done) => Ok(Ok(done)),
        Err(GoalsError::Query(error)) => Ok(Err(error)),
        Err(GoalsError::Interrupted(stopped)) => Err(stopped),
    })
}

/// The stages that interrupted calls name.
const PREPARING: &str = "preparing goals";
pub(super) const FINDING: &str = "finding distances to goals";

impl<P: SubgoalPlacement> HubLabels<P> {
    /// Prepares goals that many starts ask for. This takes about two queries for each goal.
    ///
    /// # Errors
    /// [`QueryError`] for the first goal that is blocked or outside the map; [`QueryError::OtherGoals`] for
    /// the space of another map or other rules.
    pub fn goals(
        &self,
        space: &FreeSpace<P>,
        goals: impl IntoIterator<Item = Vertex>,
    ) -> Result<Goals, QueryError> {
        unstopped(|never| self.goals_interruptible(space, goals, never))
    }

    /// [`goals`](Self::goals), which an interrupt can stop; it asks for each goal.
    ///
    /// # Errors
    /// As for [`goals`](Self::goals), and [`GoalsError::Interrupted`].
    pub fn goals_interruptible(
        &self,
        space: &FreeSpace<P>,
        goals: impl IntoIterator<Item = Vertex>,
        interrupt: &Interrupt,
    ) -> Result<Goals, GoalsError> {
        self.check(space).map_err(|_| QueryError::OtherGoals)?;
        let goals: Vec<Vertex> = goals.into_iter().collect();
        let mut join = Join::new(self);
        let (mut hubs, mut all) = (Vec::new(), Vec::new());
        for (&goal, number) in goals.iter().zip(0..) {
            interrupt.check(PREPARING)?;
            End::Goal.check(space, goal)?;
            join.hubs_of(self, space, goal, &mut hubs);
            all.extend(hubs.iter().map(|&(hub, cost)| (hub, cost, number)));
        }
        let (first, entries) = by_hub(&all, self.subgoals(), interrupt)?;
        Ok(Goals { identity: self.identity, strips: Strips::new(&goals), goals, first, entries })
    }
}

/// By hub the number of its first entry, and the entries: a cost and a goal.
type ByHub = (Vec<u32>, Vec<(u64, u32)>);

/// The entries (hub, cost, goal) sorted by hub, those of each hub by their cost: by hub the number of its
/// first entry, and the entries without the hub.
fn by_hub(all: &[(u32, u64, u32)], hubs: usize, interrupt: &Interrupt) -> Result<ByHub, Interrupted> {
    const PIECE: usize = 1 << 16;
    let mut first = vec![0_u32; hubs + 1];
    for &(hub, ..) in all {
        first[hub as usize + 1] += 1;
    }
    for hub in 0..hubs {
        first[hub + 1] += first[hub];
    }
    let (mut next, mut entries) = (first.clone(), vec![(0, 0); all.len()]);
    for (number, &(hub, cost, goal)) in all.iter().enumerate() {
        interrupt.check_every(PIECE, number, PREPARING)?;
        entries[next[hub as usize] as usize] = (cost, goal);
        next[hub as usize] += 1;
    }
    for (number, ends) in first.windows(2).enumerate() {
        interrupt.check_every(1 << 6, number, PREPARING)?;
        entries[ends[0] as usize..ends[1] as usize].sort_unstable();
    }
    Ok((first, entries))
}

/// By how much the cost of a path at any angle may be off: less than 1 is cut off for each of two lines and
/// labels.
pub(super) const ROUNDED: u64 = 4;

/// The goals between two questions of the interrupt: some microseconds.
const LONG: usize = 1 << 10;

/// Cells that are further than any two vertices are apart: all goals are near.
const FAR: i32 = 1 << 17;

/// Scratch memory for distances to many goals.
#[derive(Debug, Default)]
pub(super) struct ToMany {
    /// Of the last start: each hub once, or, of the nearest goal, all ways to hubs that may lead there.
    hubs: Vec<(u32, u64)>,
    /// Goals near the start.
    near: Vec<u32>,
    waypoints: Vec<Vertex>,
}

impl ToMany {
    /// Checks a start.
    fn check<P: SubgoalPlacement>(
        (labels, space): (&HubLabels<P>, &FreeSpace<P>),
        start: Vertex,
        goals: &Goals,
    ) -> Result<(), QueryError> {
        if goals.identity == labels.identity {
            End::Start.check(space, start)
        } else {
            Err(QueryError::OtherGoals)
        }
    }

    /// Writes the distance from a start to each goal.
    pub(super) fn distances<P: SubgoalPlacement>(
        &mut self,
        index: (&HubLabels<P>, &FreeSpace<P>),
        join: &mut Join,
        (start, goals): (Vertex, &Goals),
        distances: &mut Vec<Option<Cost>>,
        interrupt: &Interrupt,
    ) -> Result<(), GoalsError> {
        Self::check(index, start, goals)?;
        interrupt.check(FINDING)?;
        join.hubs_of(index.0, index.1, start, &mut self.hubs);
        distances.clear();
        distances.resize(goals.goals.len(), None);
        for &(hub, cost) in &self.hubs {
            let over = goals.over(hub);
            // Many hubs have few goals, and a few have nearly all.
            if over.len() > LONG {
                interrupt.check(FINDING)?;
            }
            for &(rest, goal) in over {
                let sum = Cost::from_bits(cost + rest);
                let known = &mut distances[goal as usize];
                *known = Some(known.map_or(sum, |known| known.min(sum)));
            }
        }
        for (number, (&goal, known)) in goals.goals.iter().zip(distances).enumerate() {
            interrupt.check_every(LONG, number, FINDING)?;
            if let Some(cost) = self.direct(index, [start, goal], *known) {
                *known = Some(cost);
            }
        }
        Ok(())
    }

    /// The nearest goal and its distance: of several with the same cost the first.
    pub(super) fn nearest<P: SubgoalPlacement>(
        &mut self,
        index: (&HubLabels<P>, &FreeSpace<P>),
        join: &mut Join,
        (start, goals): (Vertex, &Goals),
        interrupt: &Interrupt,
    ) -> Result<Option<(usize, Cost)>, GoalsError> {
        Self::check(index, start, goals)?;
        interrupt.check(FINDING)?;
        let (mut best, mut most, ways) = (None, u64::MAX, &mut self.hubs);
        ways.clear();
        join.visit_ways(index.0, index.1, start, |hub, cost| {
            if let Some(&(rest, goal)) = goals.over(hub).first()
                && cost + rest <= most
            {
                ways.push((hub, cost));
                let sum = (Cost::from_bits(cost + rest), goal);
                if best.is_none_or(|best| sum < best) {
                    best = Some(sum);
                    // Ways to goals that are as near, whose own costs are rounded, too.
                    most = cost + rest + 4 * ROUNDED;
                }
            }
            most
        });
        let goals_near = self.take_near(start, goals, best.map(|(cost, _)| cost));
        for (turn, &number) in goals_near.iter().enumerate() {
            interrupt.check_every(LONG, turn + 1, FINDING)?;
            let goal = goals.goals[number as usize];
            if let Some(cost) = self.direct(index, [start, goal], best.map(|(cost, _)| cost)) {
                // Costs summed over subgoals on the line may be cut off, so the line replaces its own sum.
                best = match best {
                    Some((_, other)) if other == number => Some((cost, number)),
                    Some(known) => Some(known.min((cost, number))),
                    None => Some((cost, number)),
                };
            }
        }
        self.near = goals_near;
        Ok(best.map(|(cost, goal)| (goal as usize, cost)))
    }

    /// The numbers of the goals that a direct path may join at no more than a cost, up to rounding, in order;
    /// the list is to be given back.
    fn take_near(&mut self, start: Vertex, goals: &Goals, cost: Option<Cost>) -> Vec<u32> {
        let mut near = std::mem::take(&mut self.near);
        // No path is shorter than the straight line.
        let cells = cost.map(|cost| (cost.to_bits() >> Cost::FRACTION_BITS) + 2);
        match cells.and_then(|cells| i32::try_from(cells).ok()).filter(|&cells| cells < FAR) {
            Some(cells) => goals.strips.near(start, cells, &mut near),
            None => {
                near.clear();
                near.extend(0..goals.goals.len() as u32);
            }
        }
        near
    }

    /// The goals whose costs differ from that of the nearest goal by no more than both are rounded, in their
    /// order, with their costs. `start` is that of the last call of [`nearest`](Self::nearest).
    pub(super) fn as_near<P: SubgoalPlacement>(
        &mut self,
        index: (&HubLabels<P>, &FreeSpace<P>),
        start: Vertex,
        goals: &Goals,
        nearest: Cost,
        found: &mut Vec<(u32, Cost)>,
    ) {
        let most = Cost::from_bits(nearest.to_bits() + 2 * ROUNDED);
        found.clear();
        for &(hub, cost) in &self.hubs {
            let sums = goals.over(hub).iter().map(|&(rest, goal)| (goal, Cost::from_bits(cost + rest)));
            found.extend(sums.take_while(|&(_, sum)| sum <= most));
        }
        let near = self.take_near(start, goals, Some(most));
        for &number in &near {
            // A direct path costs no more than what was summed up over subgoals on the line.
            let goal = goals.goals[number as usize];
            if let Some(cost) = self.direct(index, [start, goal], Some(most)).filter(|&cost| cost <= most) {
                found.retain(|&(other, _)| other != number);
                found.push((number, cost));
            }
        }
        self.near = near;
        found.sort_unstable();
        found.dedup_by_key(|&mut (goal, _)| goal);
    }

    /// The cost of the direct path, if there is one and it may cost no more than a known path.
    #[inline]
    fn direct<P: SubgoalPlacement>(
        &mut self,
        (labels, space): (&HubLabels<P>, &FreeSpace<P>),
        [start, goal]: [Vertex; 2],
        known: Option<Cost>,
    ) -> Option<Cost> {
        let v = start.to(goal);
        let may_be_less =
            known.is_none_or(|known| labels.metric.estimate(v).to_bits() <= known.to_bits() + ROUNDED);
        let is_direct = may_be_less
            && space.connected(start, goal)
            && (start == goal || direct_path(space, labels.k, start, goal, &mut self.waypoints));
        is_direct.then(|| labels.metric.distance(v))
    }
}
