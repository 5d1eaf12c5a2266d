//! The way from a subgoal to a hub of it.
//!
//! A label belongs to a group, whose edge leads to the next subgoal on the way, and this subgoal has a label
//! of the same hub. Of several it is one by which a shortest path may leave that arrives along that edge. So
//! it depends on the label alone, and is searched for once, when the labels are made: a byte beside each
//! label says which of the next subgoal's labels it is. Where that does not fit in a byte, a query searches.
//! Another byte says in which of its subgoal's groups the label is: a search for it ends where a processor
//! does not expect it to.

use std::marker::PhantomData;

use mediant_grid::{Interrupt, Interrupted, Vector, Vertex};
use mediant_moves::K;

use super::{lists::LabelLists, pack::Packed};
use crate::{
    chunks::in_chunks,
    placement::{BuildContext, EdgeFinder},
    subgoals::Subgoals,
};

/// The byte of a label whose successor, or whose group, has to be searched for.
const SEARCH: u8 = u8::MAX;

/// Packs the labels of all subgoals, each with the label that comes after it; `None` if there are too
/// many.
pub(super) fn pack<P: EdgeFinder>(
    context: BuildContext<'_, P>,
    labels: LabelLists,
    interrupt: &Interrupt,
) -> Result<Option<Packed>, Interrupted> {
    let Some(packed) = Packed::new(context, labels, interrupt)? else { return Ok(None) };
    let following = Chains::<P>::new(&packed, context.subgoals, context.k).following(interrupt)?;
    Ok(Some(packed.followed_by::<P>(following.iter().copied())))
}

/// A way to a hub.
#[derive(Clone, Copy, Debug)]
struct Walk {
    /// The subgoal that it has come to.
    id: u32,
    /// The label that leads on.
    label: usize,
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
                        let first = packed.first_label(group.to);
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

    /// Visits the subgoals from two to a hub of both, without these, on paths that arrive in some directions;
    /// `None` if the labels do not lead there. It takes turns: so a processor follows both ways at once.
    pub(super) fn visit_both(
        &self,
        [first, last]: [(Vector, u32); 2],
        hub: u32,
        mut visit_first: impl FnMut(Vertex),
        mut visit_last: impl FnMut(Vertex),
    ) -> Option<()> {
        let (mut first, mut last) = (self.begin(first, hub)?, self.begin(last, hub)?);
        // No path visits a subgoal twice: damaged labels do not lead in circles.
        for _ in 0..=self.subgoals.len() {
            let go_on = [first.id != hub, last.id != hub];
            if go_on == [false, false] {
                return Some(());
            }
            if go_on[0] {
                visit_first(self.step(&mut first, hub)?);
            }
            if go_on[1] {
                visit_last(self.step(&mut last, hub)?);
            }
        }
        None
    }

    /// Begins the way from a subgoal, at which it arrives in a direction, to a hub.
    fn begin(&self, (arrival, id): (Vector, u32), hub: u32) -> Option<Walk> {
        let label = if id == hub { 0 } else { self.find(id, arrival, hub)? };
        Some(Walk { id, label })
    }

    /// Goes on to the next subgoal.
    #[inline(always)]
    fn step(&self, walk: &mut Walk, hub: u32) -> Option<Vertex> {
        let (packed, Walk { id, label }) = (self.packed, *walk);
        // Made up labels may lead to another hub.
        let following = *packed.following.get(label)?;
        let next = if following.group == SEARCH {
            self.find_group(id, label)?
        } else {
            let first = (packed.sides[(id * P::SIDES) as usize].first >> 4) as usize;
            packed.groups.get(first + usize::from(following.group))?.to
        };
        let to = self.subgoals.vertex(next);
        let label = match following.label {
            _ if next == hub => label,
            SEARCH => self.find(next, self.subgoals.vertex(id).to(to), hub)?,
            after => packed.first_label(next) + usize::from(after),
        };
        *walk = Walk { id: next, label };
        Some(to)
    }

    /// The subgoal to which the group of a label leads.
    #[cold]
    fn find_group(&self, id: u32, label: usize) -> Option<u32> {
        let groups = &self.packed.groups[self.packed.groups(id * P::SIDES, P::SIDES)];
        Some(groups.iter().find(|group| group.end() > label)?.to)
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
