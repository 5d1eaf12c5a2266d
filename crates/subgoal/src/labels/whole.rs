//! Pruning labels that do not lead to their hubs.
//!
//! A label says which subgoal comes next on the way to its hub, and a path is followed from label to label.
//! If the label of c to h is the distance between them, the next subgoal n has such a label, too. If a higher
//! subgoal m dominated h at n, m would be on a shortest path between c and h as well; then c would share a
//! hub with h that dominates h at c.
//!
//! Other labels are longer than the distance: the edges of the graph are taut, and shortcuts at bends that
//! are not taut were skipped, so between some subgoals the graph has no shortest path. No shortest path of a
//! query leads over them, but over N(k) some paths over them cost as little. So labels that lead nowhere are
//! pruned; no label that is a distance is.

use mediant_grid::{Interrupt, Interrupted, room_for};

use super::lists::{Form, LabelLists};
use crate::chunks::in_chunks;

/// The stage that an interrupted call names.
const DURING: &str = "checking hub labels";

/// Prunes labels whose parent chain misses the hub, or costs more than they say; `edge` is the cost of an
/// edge.
pub(super) fn keep_whole(
    labels: &mut LabelLists,
    interrupt: &Interrupt,
    edge: impl Fn(u32, u32) -> u128 + Send + Sync,
) -> Result<(), Interrupted> {
    let counts = counts(labels, interrupt)?;
    let (all, form, scratch) = (&*labels, labels.form, || HubChains::new(labels.len()));
    let mut dropped = Vec::new();
    // Some hubs at a time: a list of all labels by hub would take more memory than the labels.
    let most = (labels.total() / 16).max(LEAST);
    let mut end = 0;
    while end < counts.len() {
        let first = end;
        let mut sum = 0;
        while end < counts.len() && (end == first || sum + counts[end] as usize <= most) {
            sum += counts[end] as usize;
            end += 1;
        }
        let by_hub = ByHub::new(all, (first as u32, &counts[first..end]), interrupt)?;
        let broken = in_chunks(end - first, scratch, &|_| {}, |chains, numbers| {
            let mut broken = Vec::new();
            for hub in numbers.map(|number| first as u32 + number) {
                interrupt.check(DURING)?;
                chains.find_broken((hub, form), by_hub.over(hub), &edge, &mut broken);
            }
            Ok(broken)
        })?;
        dropped.extend(broken.into_iter().flatten());
    }
    dropped.sort_unstable();
    for of_one in dropped.chunk_by(|a, b| a.0 == b.0) {
        let numbers: Vec<u32> = of_one.iter().map(|&(_, number)| number).collect();
        labels.drop_some(of_one[0].0, &numbers);
    }
    Ok(())
}

/// The labels that are listed by their hubs at a time, or more.
const LEAST: usize = 1 << 18;

/// A label by its subgoal, and its number among the labels of the subgoal.
type Place = (u32, u32);

/// A label as it is listed by its hub: a copy, since labels of one hub lie far apart.
#[derive(Clone, Copy, Debug, Default)]
struct Listed {
    place: Place,
    words: [u64; 2],
}

/// The subgoals whose labels are looked at between two questions of the interrupt.
const PIECE: u32 = 1 << 10;

/// By hub, the number of its labels.
fn counts(labels: &LabelLists, interrupt: &Interrupt) -> Result<Vec<u32>, Interrupted> {
    room_for::<u32>(labels.len(), DURING)?;
    let mut counts = vec![0_u32; labels.len()];
    for id in 0..labels.len() as u32 {
        interrupt.check_every(PIECE as usize, id as usize, DURING)?;
        let [words, _] = labels.of(id).words;
        words.iter().for_each(|&word| counts[labels.form.id(word) as usize] += 1);
    }
    Ok(counts)
}

/// The labels of some hubs.
struct ByHub {
    /// The first of these hubs.
    from: u32,
    first: Vec<u32>,
    listed: Vec<Listed>,
}

impl ByHub {
    /// The labels of the hubs from one on, which have so many.
    fn new(
        labels: &LabelLists,
        (from, counts): (u32, &[u32]),
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let mut first = Vec::with_capacity(counts.len() + 1);
        let mut sum = 0;
        first.push(sum);
        for count in counts {
            sum += count;
            first.push(sum);
        }
        room_for::<Listed>(sum as usize, DURING)?;
        let (mut next, mut listed) = (first.clone(), vec![Listed::default(); sum as usize]);
        for id in 0..labels.len() as u32 {
            interrupt.check_every(PIECE as usize, id as usize, DURING)?;
            let [kept, rest] = labels.of(id).words;
            for (&word, number) in kept.iter().zip(0..) {
                let hub = labels.form.id(word).wrapping_sub(from) as usize;
                if hub < counts.len() {
                    let at = &mut next[hub];
                    listed[*at as usize] =
                        Listed { place: (id, number), words: [word, rest[number as usize]] };
                    *at += 1;
                }
            }
        }
        Ok(Self { from, first, listed })
    }

    fn over(&self, hub: u32) -> &[Listed] {
        let number = (hub - self.from) as usize;
        let [first, end] = [self.first[number], self.first[number + 1]];
        &self.listed[first as usize..end as usize]
    }
}

/// Scratch memory for following labels to a hub.
struct HubChains {
    /// By subgoal, one more than the number of its label of the hub; 0 for none.
    place: Vec<u32>,
    /// Of each label, whether it leads to the hub, if that is known.
    state: Vec<Option<bool>>,
    /// The labels followed so far.
    chain: Vec<usize>,
}

impl HubChains {
    fn new(count: usize) -> Self {
        Self { place: vec![0; count], state: Vec::new(), chain: Vec::new() }
    }

    /// Finds the labels of a hub that do not lead there.
    fn find_broken(
        &mut self,
        (hub, form): (u32, Form),
        listed: &[Listed],
        edge: &impl Fn(u32, u32) -> u128,
        broken: &mut Vec<Place>,
    ) {
        let Self { place, state, chain } = self;
        for (&Listed { place: (id, _), .. }, number) in listed.iter().zip(1..) {
            place[id as usize] = number;
        }
        state.clear();
        state.resize(listed.len(), None);
        for number in 0..listed.len() {
            chain.clear();
            let mut at = number;
            // Costs descend along the chain, so it ends.
            let is_whole = loop {
                if let Some(known) = state[at] {
                    break known;
                }
                chain.push(at);
                let (id, own) = (listed[at].place.0, form.label(listed[at].words));
                if own.next == hub {
                    break true;
                }
                let Some(next) = (place[own.next as usize] as usize).checked_sub(1) else { break false };
                if form.cost(listed[next].words) + edge(id, own.next) > own.cost() {
                    break false;
                }
                at = next;
            };
            chain.iter().for_each(|&at| state[at] = Some(is_whole));
        }
        let all = listed.iter().zip(&*state);
        broken.extend(all.filter(|(_, state)| **state == Some(false)).map(|(label, _)| label.place));
        listed.iter().for_each(|label| place[label.place.0 as usize] = 0);
    }
}
