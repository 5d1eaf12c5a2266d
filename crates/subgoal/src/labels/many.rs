//! Distances to many goals at once.

use mediant_grid::{FreeSpace, Identity, Vertex};
use mediant_moves::Cost;
use mediant_search::{End, QueryError};

use super::{HubLabels, join::Join};
use crate::{edge_path::direct_path, placement::SubgoalPlacement};

/// Goals that many starts ask for: the hubs of each, sorted by hub. Made by [`HubLabels::goals`].
#[derive(Clone, Debug)]
pub struct Goals {
    identity: Identity,
    goals: Vec<Vertex>,
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
        self.check(space).map_err(|_| QueryError::OtherGoals)?;
        let goals: Vec<Vertex> = goals.into_iter().collect();
        let mut join = Join::new(self);
        let (mut hubs, mut all) = (Vec::new(), Vec::new());
        for (&goal, number) in goals.iter().zip(0..) {
            End::Goal.check(space, goal)?;
            join.hubs_of(self, space, goal, &mut hubs);
            all.extend(hubs.iter().map(|&(hub, cost)| (hub, cost, number)));
        }
        let (first, entries) = by_hub(&all, self.subgoals());
        Ok(Goals { identity: self.identity, goals, first, entries })
    }
}

/// The entries (hub, cost, goal) sorted by hub, those of each hub by their cost: by hub the number of its
/// first entry, and the entries without the hub.
fn by_hub(all: &[(u32, u64, u32)], hubs: usize) -> (Vec<u32>, Vec<(u64, u32)>) {
    let mut first = vec![0_u32; hubs + 1];
    for &(hub, ..) in all {
        first[hub as usize + 1] += 1;
    }
    for hub in 0..hubs {
        first[hub + 1] += first[hub];
    }
    let (mut next, mut entries) = (first.clone(), vec![(0, 0); all.len()]);
    for &(hub, cost, goal) in all {
        entries[next[hub as usize] as usize] = (cost, goal);
        next[hub as usize] += 1;
    }
    for ends in first.windows(2) {
        entries[ends[0] as usize..ends[1] as usize].sort_unstable();
    }
    (first, entries)
}

/// By how much the cost of a path at any angle may be off: less than 1 is cut off for each of two lines and
/// labels.
pub(super) const ROUNDED: u64 = 4;

/// Scratch memory for distances to many goals.
#[derive(Debug, Default)]
pub(super) struct ToMany {
    hubs: Vec<(u32, u64)>,
    waypoints: Vec<Vertex>,
}

impl ToMany {
    /// Finds the hubs of a start.
    fn start<P: SubgoalPlacement>(
        &mut self,
        (labels, space): (&HubLabels<P>, &FreeSpace<P>),
        join: &mut Join,
        start: Vertex,
        goals: &Goals,
    ) -> Result<(), QueryError> {
        if goals.identity != labels.identity {
            return Err(QueryError::OtherGoals);
        }
        End::Start.check(space, start)?;
        join.hubs_of(labels, space, start, &mut self.hubs);
        Ok(())
    }

    /// Writes the distance from a start to each goal.
    pub(super) fn distances<P: SubgoalPlacement>(
        &mut self,
        index: (&HubLabels<P>, &FreeSpace<P>),
        join: &mut Join,
        start: Vertex,
        goals: &Goals,
        distances: &mut Vec<Option<Cost>>,
    ) -> Result<(), QueryError> {
        self.start(index, join, start, goals)?;
        distances.clear();
        distances.resize(goals.goals.len(), None);
        for &(hub, cost) in &self.hubs {
            for &(rest, goal) in goals.over(hub) {
                let sum = Cost::from_bits(cost + rest);
                let known = &mut distances[goal as usize];
                *known = Some(known.map_or(sum, |known| known.min(sum)));
            }
        }
        for (&goal, known) in goals.goals.iter().zip(distances) {
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
        start: Vertex,
        goals: &Goals,
    ) -> Result<Option<(usize, Cost)>, QueryError> {
        self.start(index, join, start, goals)?;
        let over = |&(hub, cost): &(u32, u64)| {
            let &(rest, goal) = goals.over(hub).first()?;
            Some((Cost::from_bits(cost + rest), goal))
        };
        let mut best = self.hubs.iter().filter_map(over).min();
        for (&goal, number) in goals.goals.iter().zip(0..) {
            if let Some(cost) = self.direct(index, [start, goal], best.map(|(cost, _)| cost)) {
                // Costs summed over subgoals on the line may be cut off, so the line replaces its own sum.
                best = match best {
                    Some((_, other)) if other == number => Some((cost, number)),
                    Some(known) => Some(known.min((cost, number))),
                    None => Some((cost, number)),
                };
            }
        }
        Ok(best.map(|(cost, goal)| (goal as usize, cost)))
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
        for (&goal, number) in goals.goals.iter().zip(0..) {
            // A direct path costs no more than what was summed up over subgoals on the line.
            if let Some(cost) = self.direct(index, [start, goal], Some(most)).filter(|&cost| cost <= most) {
                found.retain(|&(other, _)| other != number);
                found.push((number, cost));
            }
        }
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
