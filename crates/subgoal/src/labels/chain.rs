//! The way from a subgoal to a hub of it.
//!
//! A label belongs to a group, whose edge leads to the next subgoal on the way, and this subgoal has a label
//! of the same hub. Of several it is one by which a shortest path may leave that arrives along that edge. So
//! it depends on the label alone, and is searched for once, when the labels are made: a byte beside each
//! label says which of the next subgoal's labels it is. Where that does not fit in a byte, a query searches.

use std::marker::PhantomData;

use mediant_grid::{Interrupt, Interrupted, Vector, Vertex};
use mediant_moves::K;

use super::{merge::Label, pack::Packed};
use crate::{
    chunks::in_chunks,
    placement::{BuildContext, EdgeFinder},
    subgoals::Subgoals,
};

/// The byte of a label whose successor has to be searched for.
const SEARCH: u8 = u8::MAX;

/// Packs the labels of all subgoals, each with the label that comes after it; `None` if a cost is too large.
pub(super) fn pack<P: EdgeFinder>(
    context: BuildContext<'_, P>,
    labels: &[Vec<Label>],
    interrupt: &Interrupt,
) -> Result<Option<Packed>, Interrupted> {
    let Some(packed) = Packed::new(context, labels, interrupt)? else { return Ok(None) };
    let following = Chains::<P>::new(&packed, context.subgoals, context.k).following(interrupt)?;
    Ok(Some(Packed { following, ..packed }))
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

    /// For each label, which of the next subgoal's labels comes after it.
    pub(super) fn following(&self, interrupt: &Interrupt) -> Result<Box<[u8]>, Interrupted> {
        let packed = self.packed;
        let chunks = in_chunks(
            self.subgoals.len(),
            || (),
            &|_| {},
            |(), ids| {
                let mut following = Vec::new();
                for id in ids {
                    interrupt.check("packing hub labels")?;
                    let at = self.subgoals.vertex(id);
                    for number in packed.groups(id * P::SIDES, P::SIDES) {
                        let group = packed.groups[number];
                        let arrival = at.to(self.subgoals.vertex(group.to));
                        let first = packed.first_label::<P>(group.to);
                        following.extend(packed.labels[packed.begin(number)..group.end()].iter().map(
                            |&label| {
                                let hub = packed.hub(label);
                                let after =
                                    if hub == group.to { None } else { self.find(group.to, arrival, hub) };
                                after.and_then(|label| u8::try_from(label - first).ok()).unwrap_or(SEARCH)
                            },
                        ));
                    }
                }
                Ok(following)
            },
        )?;
        Ok(chunks.concat().into())
    }

    /// Visits the subgoals from one to a hub of it, without the first, on a path that arrives in a direction;
    /// `None` if the labels do not lead there.
    pub(super) fn visit(
        &self,
        arrival: Vector,
        mut id: u32,
        hub: u32,
        mut visit: impl FnMut(Vertex),
    ) -> Option<()> {
        if id == hub {
            return Some(());
        }
        let (packed, subgoals) = (self.packed, self.subgoals);
        let mut at = subgoals.vertex(id);
        let mut label = self.find(id, arrival, hub)?;
        // Costs descend, so that damaged labels do not lead in circles.
        let mut rest = u64::MAX;
        loop {
            let cost = packed.cost(packed.labels[label]);
            let groups = &packed.groups[packed.groups(id * P::SIDES, P::SIDES)];
            let next = groups.iter().find(|group| group.end() > label).filter(|_| cost < rest)?.to;
            let to = subgoals.vertex(next);
            visit(to);
            if next == hub {
                return Some(());
            }
            label = match packed.following[label] {
                SEARCH => self.find(next, at.to(to), hub)?,
                // Made up labels may lead to another hub.
                after => Some(packed.first_label::<P>(next) + usize::from(after)).filter(|&label| {
                    packed.labels.get(label).is_some_and(|&label| packed.hub(label) == hub)
                })?,
            };
            (id, at, rest) = (next, to, cost);
        }
    }

    /// The number of the label by which the way leads on to a hub.
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
