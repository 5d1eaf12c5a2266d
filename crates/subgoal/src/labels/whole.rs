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

use mediant_grid::{Interrupt, Interrupted};

use super::merge::Label;
use crate::chunks::in_chunks;

/// The stage that an interrupted call names.
const DURING: &str = "checking hub labels";

/// Prunes labels whose parent chain misses the hub, or costs more than they say; `edge` is the cost of an
/// edge.
pub(super) fn keep_whole(
    labels: &mut [Vec<Label>],
    interrupt: &Interrupt,
    edge: impl Fn(u32, u32) -> u128 + Send + Sync,
) -> Result<(), Interrupted> {
    let by_hub = ByHub::new(labels, interrupt)?;
    let all = &*labels;
    let dropped = in_chunks(
        all.len(),
        || HubChains { place: vec![0; all.len()], state: Vec::new(), chain: Vec::new() },
        &|_| {},
        |chains, hubs| {
            let mut dropped = Vec::new();
            for hub in hubs {
                interrupt.check(DURING)?;
                chains.find_broken(hub, by_hub.over(hub), all, &edge, &mut dropped);
            }
            Ok(dropped)
        },
    )?;
    let mut dropped = dropped.concat();
    dropped.sort_unstable();
    for of_one in dropped.chunk_by(|a, b| a.0 == b.0) {
        let mut broken = of_one.iter().map(|&(_, number)| number).peekable();
        let mut number = 0;
        labels[of_one[0].0 as usize].retain(|_| {
            let is_whole = broken.next_if_eq(&number).is_none();
            number += 1;
            is_whole
        });
    }
    Ok(())
}

/// A label by its subgoal, and its number among the labels of the subgoal.
type Place = (u32, u32);

/// The labels by their hubs.
struct ByHub {
    first: Vec<u32>,
    places: Vec<Place>,
}

impl ByHub {
    fn new(labels: &[Vec<Label>], interrupt: &Interrupt) -> Result<Self, Interrupted> {
        const PIECE: usize = 1 << 10;
        let mut first = vec![0_u32; labels.len() + 1];
        for (number, own) in labels.iter().enumerate() {
            interrupt.check_every(PIECE, number, DURING)?;
            own.iter().for_each(|label| first[label.hub as usize + 1] += 1);
        }
        for hub in 0..labels.len() {
            first[hub + 1] += first[hub];
        }
        let (mut next, mut places) = (first.clone(), vec![(0, 0); first[labels.len()] as usize]);
        for (own, id) in labels.iter().zip(0_u32..) {
            interrupt.check_every(PIECE, id as usize, DURING)?;
            for (label, number) in own.iter().zip(0..) {
                let place = &mut next[label.hub as usize];
                places[*place as usize] = (id, number);
                *place += 1;
            }
        }
        Ok(Self { first, places })
    }

    fn over(&self, hub: u32) -> &[Place] {
        let [first, end] = [hub, hub + 1].map(|hub| self.first[hub as usize] as usize);
        &self.places[first..end]
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
    /// Finds the labels of a hub that do not lead there.
    fn find_broken(
        &mut self,
        hub: u32,
        places: &[Place],
        labels: &[Vec<Label>],
        edge: &impl Fn(u32, u32) -> u128,
        broken: &mut Vec<Place>,
    ) {
        let Self { place, state, chain } = self;
        let label = |(id, number): Place| labels[id as usize][number as usize];
        for (&(id, _), number) in places.iter().zip(1..) {
            place[id as usize] = number;
        }
        state.clear();
        state.resize(places.len(), None);
        for number in 0..places.len() {
            chain.clear();
            let mut at = number;
            // Costs descend along the chain, so it ends.
            let is_whole = loop {
                if let Some(known) = state[at] {
                    break known;
                }
                chain.push(at);
                let (id, own) = (places[at].0, label(places[at]));
                if own.next == hub {
                    break true;
                }
                let Some(next) = (place[own.next as usize] as usize).checked_sub(1) else { break false };
                if label(places[next]).cost() + edge(id, own.next) > own.cost() {
                    break false;
                }
                at = next;
            };
            chain.iter().for_each(|&at| state[at] = Some(is_whole));
        }
        broken.extend(
            places.iter().zip(&*state).filter(|(_, state)| **state == Some(false)).map(|(at, _)| *at),
        );
        places.iter().for_each(|&(id, _)| place[id as usize] = 0);
    }
}
