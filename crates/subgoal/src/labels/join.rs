//! The join of two ends: the subgoals over which their shortest path leads.
//!
//! An end is joined to 20 to 130 subgoals on most maps. That is more work than their labels: shortest paths
//! lead on over a few of them only. So the steps that look at all of them are short loops without branches,
//! which could not be predicted.

use mediant_grid::{Corners, FreeSpace, Vertex, sight::Place};
use mediant_moves::Cost;

use super::{
    HubLabels,
    candidates::{Candidates, Joint, Step},
    lines::{Line, sees},
    pack::{MOST_COST_BITS, Packed, PathStep},
    vertices::OfVertex,
};
use crate::placement::SubgoalPlacement;

/// Where the shortest path between two ends turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Meeting {
    pub(super) cost: Cost,
    pub(super) hub: u32,
    /// The subgoals at which the path leaves the start, and arrives at the goal; the hub where the step is
    /// known.
    pub(super) first: u32,
    pub(super) last: u32,
    /// The steps to these two, where they are known.
    pub(super) steps: [Option<PathStep>; 2],
}

impl Meeting {
    /// No path: its cost exceeds all others.
    const NONE: Self = Self::over(0, [0, 0], 1 << MOST_COST_BITS);

    /// A path from the first to the last subgoal over a hub, and what it costs.
    const fn over(hub: u32, [first, last]: [u32; 2], cost: u64) -> Self {
        Self { cost: Cost::from_bits(cost), hub, first, last, steps: [None; 2] }
    }
}

/// Scratch memory: 16 bytes a subgoal.
#[derive(Debug)]
pub(super) struct Join {
    ends: [Candidates<Step>; 2],
    /// The same for ends that need not be vertices.
    points: [Candidates<Line>; 2],
    /// Slots, while those of several blocks are merged.
    lists: [Vec<u32>; 2],
    hubs: Hubs,
}

/// The cheapest known ways from the start to hubs.
#[derive(Debug)]
struct Hubs {
    ways: Vec<Way>,
    /// The number of the query, in the bits above the costs.
    query: u64,
}

/// The cheapest known way to a hub.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// Its cost, below the number of the query, which descends: so what earlier queries left is more than any
    /// cost, and nothing has to be cleared.
    cost: u64,
    /// The subgoal at which it leaves the start.
    first: u32,
}

impl Way {
    /// No way: its cost exceeds all others.
    const NONE: Self = Self { cost: FIRST_QUERY << MOST_COST_BITS, first: 0 };

    /// Takes the cheaper way, without a branch.
    #[inline]
    fn take(&mut self, cost: u64, first: u32) {
        self.first = if cost < self.cost { first } else { self.first };
        self.cost = cost.min(self.cost);
    }
}

/// The largest number of a query. An entry of the last query, less this query's number, plus a path's cost
/// must not overflow.
const FIRST_QUERY: u64 = (1 << (u64::BITS - MOST_COST_BITS - 1)) - 1;

impl Join {
    pub(super) fn new<P: SubgoalPlacement>(index: &HubLabels<P>) -> Self {
        let room = index.geometry.seen.most + 1;
        let hubs = Hubs { ways: vec![Way::NONE; index.subgoals()], query: FIRST_QUERY };
        let points = [Candidates::none(), Candidates::none()];
        let ends = [Candidates::new(room), Candidates::new(room)];
        Self { ends, points, lists: [Vec::new(), Vec::new()], hubs }
    }

    /// Becomes the memory for other labels, and keeps what it has of it.
    pub(super) fn fit<P: SubgoalPlacement>(&mut self, index: &HubLabels<P>) {
        let room = index.geometry.seen.most + 1;
        self.ends.iter_mut().for_each(|end| end.fit(room));
        // All that earlier queries left is more than any cost.
        self.hubs.ways.resize(index.subgoals(), Way::NONE);
    }

    /// The bytes that it takes when it is made, but for the room for what an end sees.
    pub(super) fn bytes<P: SubgoalPlacement>(index: &HubLabels<P>) -> usize {
        index.subgoals().saturating_mul(size_of::<Way>())
    }

    /// Where the shortest path from start to goal that bends at a subgoal turns; `None` if there is none.
    pub(super) fn meeting<P: SubgoalPlacement>(
        &mut self,
        index: &HubLabels<P>,
        space: &FreeSpace<P>,
        [start, goal]: [Vertex; 2],
    ) -> Option<Meeting> {
        let Self { ends: [departures, arrivals], hubs, .. } = self;
        let [of_start, of_goal] = [start, goal].map(|end| index.labels_of(end));
        if let (Some(of_start), Some(of_goal)) = (of_start, of_goal) {
            // Else the goal's labels would be waited for once the start's are through: whole files of orz900d
            // take 0.91 of the time, of AR0011SR 0.92.
            std::hint::black_box(of_start.touch() ^ of_goal.touch());
        }
        if let Some(of_start) = of_start {
            hubs.leave_vertex(&index.packed, of_start);
        } else {
            departures.find(index, space, start);
            hubs.leave(index, departures);
        }
        let mut meeting = if let Some(of_goal) = of_goal {
            hubs.arrive_at_vertex(&index.packed, of_goal)
        } else {
            arrivals.find(index, space, goal);
            let leading = arrivals.find_leading(index);
            arrivals.find_bounds(index.k, goal.to(start));
            hubs.arrive(index, arrivals, leading)
        }?;
        if let Some(of_start) = of_start {
            // The way was known by the number of its label.
            meeting.steps[0] = of_start.step(meeting.first);
            meeting.first = meeting.hub;
        }
        Some(meeting)
    }

    /// The same at any angle between places that need not be vertices. `sweep` tells the subgoals that a
    /// place sees, where the index does not know what may be seen from there.
    pub(super) fn meeting_of_places<P: SubgoalPlacement>(
        &mut self,
        index: &HubLabels<P>,
        space: &FreeSpace<Corners>,
        [start, goal]: [Place; 2],
        mut sweep: impl FnMut(Place, &mut dyn FnMut(u32)),
    ) -> Option<Meeting> {
        let Self { points: [departures, arrivals], lists, hubs, .. } = self;
        let mut find = |end: &mut Candidates<Line>, at: Place| match (at.vertex(), &index.geometry.seen.cells)
        {
            (Some(vertex), _) => end.find_at(index, space, vertex),
            (None, Some(cells)) => end.find_around(index, space, cells, at, lists),
            (None, None) => {
                end.count = 0;
                sweep(at, &mut |id| (0..P::SIDES).for_each(|side| end.add(id * P::SIDES + side)));
                end.find_lines(index, at);
            }
        };
        find(departures, start);
        find(arrivals, goal);
        hubs.leave(index, departures);
        // Of a vertex it is known.
        let is_seen = |from: Place, id: u32| from.vertex().is_some() || sees(index, space, from, id);
        loop {
            let leading = arrivals.find_leading(index);
            arrivals.find_bounds_to(goal.to(start));
            let meeting = hubs.arrive(index, arrivals, leading)?;
            if !is_seen(start, meeting.first) {
                departures.remove::<P>(meeting.first);
                hubs.leave(index, departures);
            } else if !is_seen(goal, meeting.last) {
                arrivals.remove::<P>(meeting.last);
            } else {
                return Some(meeting);
            }
        }
    }
}

impl Join {
    /// Finds the hubs of an end, and the least costs of paths to them.
    pub(super) fn hubs_of<P: SubgoalPlacement>(
        &mut self,
        index: &HubLabels<P>,
        space: &FreeSpace<P>,
        end: Vertex,
        found: &mut Vec<(u32, u64)>,
    ) {
        let Self { ends: [candidates, _], hubs, .. } = self;
        candidates.find(index, space, end);
        let leading = candidates.find_leading(index);
        let leading = &candidates.leading[..leading];
        hubs.start();
        hubs.join(index, candidates);
        leading.iter().for_each(|&i| hubs.write(index, candidates, i as usize));
        // Again, to take each hub once.
        found.clear();
        let base = hubs.base();
        let mut take = |hub: u32| {
            let way = &mut hubs.ways[hub as usize];
            if (base..base + (1 << MOST_COST_BITS)).contains(&way.cost) {
                found.push((hub, way.cost - base));
                *way = Way::NONE;
            }
        };
        candidates.slots[..candidates.count].iter().for_each(|slot| take(slot / P::SIDES));
        for &i in leading {
            let step = candidates.steps[i as usize];
            index.visit(candidates.slots[i as usize], step, |hub, _| take(hub));
        }
    }
}

impl Join {
    /// Visits ways from an end to hubs, with their costs; `visit` returns what a way may cost from then on.
    /// Hubs to which several ways lead come several times.
    pub(super) fn visit_ways<P: SubgoalPlacement>(
        &mut self,
        index: &HubLabels<P>,
        space: &FreeSpace<P>,
        end: Vertex,
        mut visit: impl FnMut(u32, u64) -> u64,
    ) {
        let Self { ends: [candidates, _], .. } = self;
        candidates.find(index, space, end);
        let leading = candidates.find_leading(index);
        let mut most = u64::MAX;
        for (slot, step) in candidates.slots[..candidates.count].iter().zip(&candidates.steps) {
            let cost = step.cost(index);
            if cost <= most {
                most = visit(slot / P::SIDES, cost);
            }
        }
        for &i in &candidates.leading[..leading] {
            let (slot, step) = (candidates.slots[i as usize], candidates.steps[i as usize]);
            if step.cost(index) <= most {
                index.visit(slot, step, |hub, cost| most = visit(hub, cost));
            }
        }
    }
}

/// At least a cost, in cells.
#[inline]
fn above(cost: Cost) -> f32 {
    cost.to_bits() as i64 as f32 * ((1.0 + 1e-6) / (1_u64 << Cost::FRACTION_BITS) as f32)
}

impl Hubs {
    fn start(&mut self) {
        if self.query == 0 {
            self.ways.fill(Way::NONE);
            self.query = FIRST_QUERY;
        }
        self.query -= 1;
    }

    /// The number that is added to the costs of this query.
    #[inline]
    const fn base(&self) -> u64 {
        self.query << MOST_COST_BITS
    }

    /// Writes the costs from the start to all hubs.
    #[inline]
    fn leave<P: SubgoalPlacement>(&mut self, index: &HubLabels<P>, departures: &mut Candidates<impl Joint>) {
        let leading = departures.find_leading(index);
        self.start();
        self.join(index, departures);
        for &i in &departures.leading[..leading] {
            self.write(index, departures, i as usize);
        }
    }

    /// The best of the paths over hubs to the goal, which has so many leading candidates.
    #[inline]
    fn arrive<P: SubgoalPlacement>(
        &self,
        index: &HubLabels<P>,
        arrivals: &mut Candidates<impl Joint>,
        leading: usize,
    ) -> Option<Meeting> {
        // The one with the least bound first: then most others need not be read.
        arrivals.leading_first(leading);
        let mut best = Meeting::NONE;
        for &i in &arrivals.leading[..leading] {
            if arrivals.bounds[i as usize] < above(best.cost) {
                self.read(index, arrivals, i as usize, &mut best);
            }
        }
        self.meet(index, arrivals, &mut best);
        (best != Meeting::NONE).then_some(best)
    }

    /// Writes the costs from a start to all hubs, with the numbers of the labels.
    #[inline]
    fn leave_vertex(&mut self, packed: &Packed, of_start: OfVertex<'_>) {
        self.start();
        let base = self.base();
        let mut number = 0;
        of_start.labels().for_each(|label| {
            if let Some(way) = self.ways.get_mut(packed.hub(label) as usize) {
                *way = Way { cost: base + packed.cost(label), first: number };
            }
            number += 1;
        });
    }

    /// The best of the paths over hubs to a goal.
    #[inline]
    fn arrive_at_vertex(&self, packed: &Packed, of_goal: OfVertex<'_>) -> Option<Meeting> {
        let base = self.base();
        let (mut least, mut found, mut number) = (1 << MOST_COST_BITS, None, 0);
        of_goal.labels().for_each(|label| {
            let hub = packed.hub(label);
            let way = self.ways.get(hub as usize);
            let sum = way.map_or(u64::MAX, |way| way.cost - base + packed.cost(label));
            if sum < least {
                (least, found) = (sum, Some((hub, number)));
            }
            number += 1;
        });
        let (hub, number) = found?;
        let steps = [None, of_goal.step(number)];
        Some(Meeting { steps, ..Meeting::over(hub, [self.ways[hub as usize].first, hub], least) })
    }

    /// Writes the costs from the start to the subgoals that it is joined to.
    #[inline]
    fn join<P: SubgoalPlacement>(&mut self, index: &HubLabels<P>, ends: &Candidates<impl Joint>) {
        let base = self.base();
        for (slot, &step) in ends.slots[..ends.count].iter().zip(&ends.steps) {
            let id = slot / P::SIDES;
            self.ways[id as usize].take(base + step.cost(index), id);
        }
    }

    /// Reads the costs of paths over the subgoals that the goal is joined to, if their bounds allow.
    #[inline]
    fn meet<P: SubgoalPlacement>(
        &self,
        index: &HubLabels<P>,
        ends: &Candidates<impl Joint>,
        best: &mut Meeting,
    ) {
        let (base, limit) = (self.base(), above(best.cost));
        let (mut least, mut found) = (best.cost.to_bits(), None);
        let bounded = ends.slots[..ends.count].iter().zip(&ends.steps).zip(&ends.bounds);
        for ((slot, &step), _) in bounded.filter(|(_, bound)| **bound < limit) {
            let id = slot / P::SIDES;
            let sum = self.ways[id as usize].cost - base + step.cost(index);
            if sum < least {
                (least, found) = (sum, Some(id));
            }
        }
        if let Some(id) = found {
            *best = Meeting::over(id, [self.ways[id as usize].first, id], least);
        }
    }

    /// Writes the costs from the start to the hubs of a candidate.
    #[inline]
    fn write<P: SubgoalPlacement>(&mut self, index: &HubLabels<P>, ends: &Candidates<impl Joint>, i: usize) {
        let (base, subgoal) = (self.base(), ends.slots[i] / P::SIDES);
        let ways = &mut self.ways;
        index.visit(ends.slots[i], ends.steps[i], |hub, cost| {
            if let Some(way) = ways.get_mut(hub as usize) {
                way.take(base + cost, subgoal);
            }
        });
    }

    /// Reads the costs of paths over the hubs of a candidate to the goal.
    #[inline]
    fn read<P: SubgoalPlacement>(
        &self,
        index: &HubLabels<P>,
        ends: &Candidates<impl Joint>,
        i: usize,
        best: &mut Meeting,
    ) {
        let (base, ways) = (self.base(), &self.ways);
        let (mut least, mut found) = (best.cost.to_bits(), None);
        index.visit(ends.slots[i], ends.steps[i], |hub, cost| {
            let sum = ways.get(hub as usize).map_or(u64::MAX, |way| way.cost - base + cost);
            if sum < least {
                (least, found) = (sum, Some(hub));
            }
        });
        if let Some(hub) = found {
            let (first, last) = (self.ways[hub as usize].first, ends.slots[i] / P::SIDES);
            *best = Meeting::over(hub, [first, last], least);
        }
    }
}

impl<P: SubgoalPlacement> HubLabels<P> {
    /// Visits the hubs to which a shortest path can lead on over a slot, and the costs of these paths.
    #[inline]
    pub(super) fn visit(&self, slot: u32, step: impl Joint, mut visit: impl FnMut(u32, u64)) {
        let packed = &self.packed;
        let g = step.cost(self);
        let side = packed.sides[slot as usize];
        let departures = P::departures(self.k, side.bends(), step.arrival());
        let groups = packed.groups(slot, 1);
        let mut begin = packed.begin(groups.start);
        let subgoals = &self.geometry.subgoals;
        let at = subgoals.vertex(slot / P::SIDES);
        for group in &packed.groups[groups] {
            let end = group.end();
            if P::allows(departures, || at.to(subgoals.vertex(group.to)), group.class()) {
                for &label in &packed.labels[begin..end] {
                    visit(packed.hub(label), g + packed.cost(label));
                }
            } else if P::SORTED {
                return;
            }
            begin = end;
        }
    }
}
