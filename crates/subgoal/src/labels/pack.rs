//! The labels as a query reads them.

use mediant_grid::{FreeSpace, Interrupt, Interrupted, Vector, Vertex, room_for, room_in};
use mediant_moves::K;

use super::lists::{Form, LabelLists};
use crate::{
    parts::{Reader, Writer},
    placement::{BuildContext, EdgeCriterion, EdgeFinder},
    subgoals::Subgoals,
};

/// One side of a subgoal: where its groups begin, and what is known of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Side {
    /// 16 times the number of its first group, plus how paths bend here.
    pub(super) first: u32,
    /// The [summary](EdgeFinder::summary) of its edges.
    pub(crate) edges: u32,
}

impl Side {
    /// A side of a subgoal whose edges are these.
    fn new<P: EdgeFinder>(
        space: &FreeSpace<P>,
        first: usize,
        (at, side): (Vertex, u32),
        edges: impl Iterator<Item = Vector>,
    ) -> Option<Self> {
        let first = u32::try_from(first).ok().filter(|&first| first < 1 << 28)?;
        let bends = P::bend_bits(space, at, side);
        Some(Self { first: first << 4 | bends, edges: P::summary(bends, edges) })
    }

    /// The sentinel after the last side.
    const fn last(groups: usize) -> Self {
        Self { first: (groups as u32) << 4, edges: 0 }
    }

    /// How paths bend here.
    #[inline]
    pub(crate) const fn bends(self) -> u32 {
        self.first & 15
    }
}

/// The labels of a side whose paths begin with the same edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Group {
    /// The subgoal to which the edge leads.
    pub(crate) to: u32,
    /// 16 times one more than the number of its last label, plus the [class](EdgeFinder::class) of the edge.
    /// Its first label comes after the last one of the group before.
    bits: u32,
}

impl Group {
    /// The sentinel before the first group.
    const BEFORE: Self = Self { to: 0, bits: 0 };

    fn new(to: u32, class: u32, end: usize) -> Option<Self> {
        let end = u32::try_from(end).ok().filter(|&end| end < 1 << 28)?;
        Some(Self { to, bits: end << 4 | class })
    }

    #[inline]
    pub(crate) const fn end(self) -> usize {
        (self.bits >> 4) as usize
    }

    #[inline]
    pub(crate) const fn class(self) -> u32 {
        self.bits & 15
    }
}

/// A step of a path to a hub.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PathStep {
    at: [u16; 2],
    /// The number of the label that leads on from there; [`END`](Self::END) at the hub.
    label: u32,
}

impl PathStep {
    /// At the hub no label leads on.
    pub(super) const END: u32 = u32::MAX;
    /// The number of a label that is missing.
    pub(super) const MISSING: u32 = u32::MAX - 1;

    /// A step to a subgoal of a map, whose sides have at most 32,768 cells.
    pub(super) const fn new(at: Vertex, label: u32) -> Self {
        Self { at: [at.x as u16, at.y as u16], label }
    }

    /// The subgoal.
    #[inline]
    pub(super) const fn at(self) -> Vertex {
        Vertex::new(self.at[0] as i32, self.at[1] as i32)
    }

    /// The step after this one among those of the labels; `None` at the hub.
    #[inline]
    pub(super) fn next(self, steps: &[Self]) -> Option<Self> {
        steps.get(self.label as usize).copied()
    }

    /// This step as a word.
    pub(super) const fn to_word(self) -> u64 {
        self.at[0] as u64 | (self.at[1] as u64) << 16 | (self.label as u64) << 32
    }

    /// The step that a word is.
    pub(super) const fn from_word(word: u64) -> Self {
        Self { at: [word as u16, (word >> 16) as u16], label: (word >> 32) as u32 }
    }

    /// Whether this is the hub.
    pub(super) const fn is_last(self) -> bool {
        self.label == Self::END
    }
}

/// All labels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Packed {
    /// By slot, and one more that ends the last.
    pub(crate) sides: Box<[Side]>,
    /// The first one has no labels: so each has one before it.
    pub(crate) groups: Box<[Group]>,
    /// The hub, and in the lowest [`cost_bits`](Self::cost_bits) the cost.
    pub(crate) labels: Box<[u64]>,
    /// For each label, the first step of its path: see [`chain`](super::chain).
    pub(super) steps: Box<[PathStep]>,
    pub(crate) cost_bits: u32,
}

/// The stage that an interrupted call names.
const DURING: &str = "packing hub labels";

/// The costs of paths take at most this many bits, so that a search can use those above.
pub(super) const MOST_COST_BITS: u32 = 56;

/// The bits that remain for costs where this many hubs are numbered.
pub(super) fn cost_bits_of(count: usize) -> u32 {
    (count.max(2) as u32 - 1).leading_zeros() + (u64::BITS - u32::BITS)
}

/// The largest cost in so many bits.
pub(super) const fn most_cost(cost_bits: u32) -> u64 {
    (1 << if cost_bits < MOST_COST_BITS { cost_bits } else { MOST_COST_BITS }) - 1
}

/// Whether a label is one of so many hubs.
fn holds(count: usize, cost_bits: u32, label: u64) -> bool {
    ((label >> cost_bits) as usize) < count && label & ((1 << cost_bits) - 1) <= most_cost(cost_bits)
}

impl Packed {
    /// Packs the labels of all subgoals, without the steps; `None` if there are too many.
    pub(super) fn new<P: EdgeFinder>(
        context: BuildContext<'_, P>,
        mut labels: LabelLists,
        interrupt: &Interrupt,
    ) -> Result<Option<Self>, Interrupted> {
        let cost_bits = cost_bits_of(labels.len());
        arrange(context, &mut labels, interrupt)?;
        let count = labels.len() * P::SIDES as usize + 1;
        room_for::<Side>(count, DURING)?;
        let mut sides = Vec::with_capacity(count);
        let mut groups = vec![Group::BEFORE];
        let mut end = 0;
        for id in 0..labels.len() as u32 {
            interrupt.check_every(64, id as usize, DURING)?;
            let [_, words] = labels.of(id).words;
            room_in(&mut groups, words.len(), DURING)?;
            let at = context.subgoals.vertex(id);
            let next = |&word: &u64| labels.form.id(word);
            let mut same = words.chunk_by(|a, b| next(a) == next(b)).peekable();
            for side in 0..P::SIDES {
                let first = groups.len();
                while let Some(words) = same.next_if(|words| {
                    let edge = at.to(context.subgoals.vertex(next(&words[0])));
                    P::side(context.space, at, edge).0 == side
                }) {
                    let to = next(&words[0]);
                    end += words.len();
                    let class = P::class(at.to(context.subgoals.vertex(to)));
                    let Some(group) = Group::new(to, class, end) else { return Ok(None) };
                    groups.push(group);
                }
                let edges = groups[first..].iter().map(|group| at.to(context.subgoals.vertex(group.to)));
                let Some(side) = Side::new(context.space, first, (at, side), edges) else { return Ok(None) };
                sides.push(side);
            }
        }
        sides.push(Side::last(groups.len()));
        // Less memory before more is taken.
        let words = labels.into_first_words();
        room_for::<u64>(end, DURING)?;
        let mut packed = Vec::with_capacity(end);
        for (own, id) in words.iter().zip(0..) {
            interrupt.check_every(64, id, DURING)?;
            packed.extend(own.iter().map(|&word| words.form.packed(word)));
        }
        drop(words);
        let (sides, groups, labels) = (sides.into(), groups.into(), packed.into());
        Ok(Some(Self { sides, groups, labels, steps: Box::default(), cost_bits }))
    }

    pub(super) fn write(&self, out: &mut Writer<'_>) -> Result<(), Interrupted> {
        let slots = self.sides.len() as u32 - 1;
        out.part32((0..slots as usize).map(|slot| self.groups(slot as u32, 1).len() as u32))?;
        out.part32(self.groups[1..].iter().map(|group| group.to))?;
        out.part32(
            (1..self.groups.len()).map(|group| (self.groups[group].end() - self.begin(group)) as u32),
        )?;
        out.part64(&self.labels)?;
        out.part32(self.steps.iter().map(|step| step.label))
    }

    /// The same labels with the first steps of their paths, of which each leads on by one of these labels.
    pub(super) fn with_steps(self, subgoals: &Subgoals, on: impl Iterator<Item = u32>) -> Self {
        let groups = (1..self.groups.len()).flat_map(|group| {
            let at = subgoals.vertex(self.groups[group].to);
            (self.begin(group)..self.groups[group].end()).map(move |_| at)
        });
        let steps = groups.zip(on).map(|(at, label)| PathStep::new(at, label)).collect();
        Self { steps, ..self }
    }

    /// The labels that were written for these subgoals; `None` if there are none of them.
    pub(super) fn read<P: EdgeFinder>(
        reader: &mut Reader<'_>,
        space: &FreeSpace<P>,
        subgoals: &Subgoals,
        cost_bits: u32,
    ) -> Option<Self> {
        let count = subgoals.len();
        let (counts, to, lengths) = (reader.part32()?, reader.part32()?, reader.part32()?);
        let (labels, on) = (reader.part64()?, reader.part32()?);
        if counts.len() != count * P::SIDES as usize
            || to.len() != lengths.len()
            || on.len() != labels.len()
            || cost_bits != cost_bits_of(count)
            || !labels.iter().all(|&label| holds(count, cost_bits, label))
        {
            return None;
        }
        let mut rest = to.zip(lengths);
        let (mut sides, mut groups) = (Vec::with_capacity(counts.len() + 1), vec![Group::BEFORE]);
        let (mut end, mut edges) = (0_usize, Vec::new());
        for (slot, of) in (0..).zip(counts) {
            let at = subgoals.vertex(slot / P::SIDES);
            let first = groups.len();
            edges.clear();
            for _ in 0..of {
                let (to, length) = rest.next().filter(|&(to, _)| (to as usize) < count)?;
                let edge = at.to(subgoals.vertex(to));
                end = end.checked_add(length as usize)?;
                groups.push(Group::new(to, P::class(edge), end)?);
                edges.push(edge);
            }
            sides.push(Side::new(space, first, (at, slot % P::SIDES), edges.iter().copied())?);
        }
        sides.push(Side::last(groups.len()));
        let is_whole = rest.next().is_none() && end == labels.len();
        let (sides, groups) = (sides.into(), groups.into());
        let packed = Self { sides, groups, labels, steps: Box::default(), cost_bits };
        is_whole.then(|| packed.with_steps(subgoals, on))
    }

    /// The numbers of the groups of the slots from `slot` on, `count` of them.
    #[inline]
    pub(crate) fn groups(&self, slot: u32, count: u32) -> std::ops::Range<usize> {
        let [first, end] = [slot, slot + count].map(|slot| (self.sides[slot as usize].first >> 4) as usize);
        first..end
    }

    /// The number of the first label of a group.
    #[inline]
    pub(crate) fn begin(&self, group: usize) -> usize {
        self.groups[group - 1].end()
    }

    /// The hub of a label.
    #[inline]
    pub(crate) const fn hub(&self, label: u64) -> u32 {
        (label >> self.cost_bits) as u32
    }

    /// The cost of the path to the hub of a label.
    #[inline]
    pub(crate) const fn cost(&self, label: u64) -> u64 {
        label & ((1 << self.cost_bits) - 1)
    }

    /// Whether a label is one of so many subgoals.
    pub(super) fn may_hold(&self, label: u64, subgoals: usize) -> bool {
        holds(subgoals, self.cost_bits, label)
    }

    /// The label of a hub, with the cost of the path to it.
    #[inline]
    pub(super) const fn label(&self, hub: u32, cost: u64) -> u64 {
        (hub as u64) << self.cost_bits | cost
    }

    /// The memory used, in bytes.
    pub(crate) const fn memory_bytes(&self) -> usize {
        let Self { sides, groups, labels, steps, cost_bits: _ } = self;
        let of_labels = size_of_val(&**labels) + size_of_val(&**steps);
        size_of_val(&**sides) + size_of_val(&**groups) + of_labels
    }
}

/// The form of labels, whose first words have costs in units of [`Cost`](mediant_moves::Cost).
pub(super) fn form<P: EdgeFinder>(context: BuildContext<'_, P>) -> Form {
    let rest_bits = match (context.criterion, context.k) {
        (EdgeCriterion::Direct, _) => 0,
        (EdgeCriterion::Taut, K::Any) => 32,
        (EdgeCriterion::Taut, K::Finite(_)) => 64,
    };
    Form::new(context.subgoals.len(), rest_bits)
}

/// Sorts the labels of each subgoal by the edges with which their paths begin, then by hub.
fn arrange<P: EdgeFinder>(
    context: BuildContext<'_, P>,
    labels: &mut LabelLists,
    interrupt: &Interrupt,
) -> Result<(), Interrupted> {
    let form = labels.form;
    let scratch = || (Vec::new(), Vec::new());
    labels.arrange(scratch, |(sorted, edges), id, [kept, rest]| {
        interrupt.check(DURING)?;
        let at = context.subgoals.vertex(id);
        sorted.clear();
        sorted.extend(kept.iter().zip(&*rest).map(|(&kept, &rest)| (form.id(rest), form.packed(kept), rest)));
        sorted.sort_unstable();
        edges.clear();
        let mut end = 0;
        for same in sorted.chunk_by(|(a, ..), (b, ..)| a == b) {
            let (next, first) = (same[0].0, end);
            end += same.len();
            let (side, slope) = P::side(context.space, at, at.to(context.subgoals.vertex(next)));
            edges.push((side, slope, next, first..end));
        }
        edges.sort_unstable_by(|(side, slope, next, _), (other_side, other, other_next, _)| {
            side.cmp(other_side).then(slope.total_cmp(other)).then(next.cmp(other_next))
        });
        let in_order = edges.iter().flat_map(|(.., range)| &sorted[range.clone()]);
        for ((kept, rest), &(_, packed, way)) in kept.iter_mut().zip(rest).zip(in_order) {
            (*kept, *rest) = (form.unpacked(packed), way);
        }
        Ok(())
    })
}
