//! The way from a subgoal to a hub of it.
//!
//! A label belongs to a group, whose edge leads to the next subgoal on the way, and this subgoal has a label
//! of the same hub. Of several it is one by which a shortest path may leave that arrives along that edge. So
//! it depends on the label alone, and is searched for once, when the labels are made: a [`PathStep`] beside
//! each label holds the next subgoal and its label. A path is a list of such steps, each where the one before
//! says.

use std::marker::PhantomData;

use mediant_grid::{Interrupt, Interrupted, Vector, Vertex};
use mediant_moves::K;

use super::{
    join::Meeting,
    lists::LabelLists,
    pack::{Packed, PathStep},
};
use crate::{
    chunks::in_chunks,
    placement::{BuildContext, EdgeFinder},
    subgoals::Subgoals,
};

/// Packs the labels of all subgoals, each with the first step of its path; `None` if there are too many.
pub(super) fn pack<P: EdgeFinder>(
    context: BuildContext<'_, P>,
    labels: LabelLists,
    interrupt: &Interrupt,
) -> Result<Option<Packed>, Interrupted> {
    let Some(packed) = Packed::new(context, labels, interrupt)? else { return Ok(None) };
    let on = Chains::<P>::new(&packed, context.subgoals, context.k).labels_after(interrupt)?;
    Ok(Some(packed.with_steps(context.subgoals, on.into_iter().flatten())))
}

/// Follows labels to their hubs.
pub(super) struct Chains<'l, P> {
    packed: &'l Packed,
    subgoals: &'l Subgoals,
    k: K,
    placement: PhantomData<P>,
}

impl<'l, P: EdgeFinder> Chains<'l, P> {
    pub(super) const fn new(packed: &'l Packed, subgoals: &'l Subgoals, k: K) -> Self {
        Self { packed, subgoals, k, placement: PhantomData }
    }

    /// For each label, the next subgoal's label that comes after it, in pieces.
    fn labels_after(&self, interrupt: &Interrupt) -> Result<Vec<Vec<u32>>, Interrupted> {
        let packed = self.packed;
        in_chunks(
            self.subgoals.len(),
            || (),
            &|_| {},
            |(), ids| {
                let mut after = Vec::new();
                for id in ids {
                    interrupt.check("packing hub labels")?;
                    let at = self.subgoals.vertex(id);
                    for number in packed.groups(id * P::SIDES, P::SIDES) {
                        let to = packed.groups[number].to;
                        let arrival = at.to(self.subgoals.vertex(to));
                        let own = &packed.labels[packed.begin(number)..packed.groups[number].end()];
                        after.extend(own.iter().map(|&label| {
                            self.label_after((arrival, to), packed.hub(label)).unwrap_or(PathStep::MISSING)
                        }));
                    }
                }
                Ok(after)
            },
        )
    }

    /// The label by which a path that arrives at a subgoal leads on to a hub; [`PathStep::END`] if it is
    /// there.
    pub(super) fn label_after(&self, (arrival, id): (Vector, u32), hub: u32) -> Option<u32> {
        if id == hub { Some(PathStep::END) } else { self.find(id, arrival, hub).map(|label| label as u32) }
    }

    /// The steps from both ends of a path; `arrival` is the direction from an end, by its number, to a
    /// subgoal. `None` if the labels do not lead to the hub.
    pub(super) fn first_steps(
        &self,
        Meeting { hub, first, last, steps, .. }: Meeting,
        arrival: impl Fn(usize, Vertex) -> Vector,
    ) -> Option<[PathStep; 2]> {
        let step = |end: usize, id: u32| {
            let at = self.subgoals.vertex(id);
            let search = || Some(PathStep::new(at, self.label_after((arrival(end, at), id), hub)?));
            steps[end].or_else(search)
        };
        Some([step(0, first)?, step(1, last)?])
    }

    /// Visits the subgoals that come after these two on the paths to their hub; `None` if the labels do not
    /// lead there. It takes turns: so a processor follows both ways at once.
    pub(super) fn visit_both(
        &self,
        [mut first, mut last]: [PathStep; 2],
        mut visit_first: impl FnMut(Vertex),
        mut visit_last: impl FnMut(Vertex),
    ) -> Option<()> {
        let steps = &self.packed.steps;
        // No path visits a subgoal twice: damaged labels do not lead in circles.
        for _ in 0..=self.subgoals.len() {
            if first.is_last() && last.is_last() {
                return Some(());
            }
            if !first.is_last() {
                first = first.next(steps)?;
                visit_first(first.at());
            }
            if !last.is_last() {
                last = last.next(steps)?;
                visit_last(last.at());
            }
        }
        None
    }

    /// The number of the label by which the way leads on to a hub.
    #[inline(never)]
    fn find(&self, id: u32, arrival: Vector, hub: u32) -> Option<usize> {
        // Over N(k) a path that is not taut may cost as little, and the labels may lead along it.
        self.find_taut(id, arrival, hub).or_else(|| self.find_any(id, hub))
    }

    /// That among the edges by which a shortest path may leave.
    fn find_taut(&self, id: u32, arrival: Vector, hub: u32) -> Option<usize> {
        let (packed, subgoals) = (self.packed, self.subgoals);
        let at = subgoals.vertex(id);
        // Most often the arrival tells the side.
        let (first, count) = match arrival.x.signum() {
            1 => (0, 1),
            -1 => (P::SIDES - 1, 1),
            _ => (0, P::SIDES),
        };
        (first..first + count).find_map(|side| {
            let slot = id * P::SIDES + side;
            let departures = P::departures(self.k, packed.sides[slot as usize].bends(), arrival);
            let groups = packed.groups(slot, 1);
            let mut begin = packed.begin(groups.start);
            for group in &packed.groups[groups] {
                let (first, labels) = (begin, &packed.labels[begin..group.end()]);
                begin = group.end();
                if P::allows(departures, || at.to(subgoals.vertex(group.to)), group.class()) {
                    // A group's labels are sorted by hub.
                    let least = u64::from(hub) << packed.cost_bits;
                    let number = labels.partition_point(|&label| label < least);
                    if labels.get(number).is_some_and(|&label| packed.hub(label) == hub) {
                        return Some(first + number);
                    }
                } else if P::SORTED {
                    return None;
                }
            }
            None
        })
    }

    /// That among all edges.
    #[cold]
    fn find_any(&self, id: u32, hub: u32) -> Option<usize> {
        let packed = self.packed;
        let range = packed.groups(id * P::SIDES, P::SIDES);
        let (begin, end) = (packed.begin(range.start), packed.begin(range.end));
        let number = packed.labels[begin..end].iter().position(|&label| packed.hub(label) == hub)?;
        Some(begin + number)
    }
}
