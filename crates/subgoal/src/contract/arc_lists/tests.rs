use std::collections::BTreeMap;

use mediant_oracle::Rng;

use super::{ArcLists, OverlayArc};

fn arc(to: u32, cost: u128) -> OverlayArc {
    OverlayArc { cost, to, ..OverlayArc::NONE }
}

#[test]
fn a_shortcut_replaces_an_arc_that_costs_more_and_no_other() {
    let mut lists = ArcLists::with_room([1, 0].into_iter());
    lists.push(0, arc(1, 5));
    for (cost, kept) in [(7, 5), (5, 5), (3, 3), (4, 3)] {
        lists.add(0, arc(1, cost));
        assert_eq!(lists[0], [arc(1, kept)], "{cost}");
    }
}

/// Arcs that come and go, against a map for each subgoal: room is made and given up many times.
#[test]
fn arcs_are_those_that_were_added_and_not_removed() {
    for seed in 0..20 {
        let (count, mut rng) = (40, Rng::new(seed));
        let mut lists = ArcLists::with_room((0..count).map(|id| id % 3));
        let mut expected: Vec<BTreeMap<u32, u128>> = vec![BTreeMap::new(); count as usize];
        for _ in 0..20_000 {
            let (id, to, cost) = (rng.below(count), rng.below(400), rng.below(50).into());
            let own = &mut expected[id as usize];
            match rng.below(300) {
                0 => {
                    lists.clear(id);
                    own.clear();
                }
                1..80 => {
                    lists.remove(id, to);
                    own.remove(&to);
                }
                _ => {
                    lists.add(id, arc(to, cost));
                    own.entry(to).and_modify(|known| *known = cost.min(*known)).or_insert(cost);
                }
            }
        }
        assert_eq!(lists.total(), expected.iter().map(BTreeMap::len).sum::<usize>(), "seed {seed}");
        for (found, own) in lists.iter().zip(&expected) {
            let found: BTreeMap<u32, u128> = found.iter().map(|arc| (arc.to, arc.cost)).collect();
            assert_eq!(&found, own, "seed {seed}");
        }
    }
}
