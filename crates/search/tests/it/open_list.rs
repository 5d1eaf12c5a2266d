//! The open list against a sorted list.

use std::collections::{BTreeSet, HashMap};

use mediant_grid::VertexId;
use mediant_moves::Cost;
use mediant_oracle::Rng;
use mediant_search::parts::{Entry, OpenList};

#[test]
fn entries_are_ordered_by_f_then_h_then_id() {
    let entry = |f, h, id| Entry::new(Cost::from_bits(f), Cost::from_bits(h), VertexId(id));
    let step = 1 << 16;
    let ascending = [
        entry(1, 9 * step, 9),
        entry(2, 0, 0),
        entry(2, 0, 1),
        entry(2, step, 0),
        // h is compared in steps of 2^-16 cells: below that the id decides.
        entry(2, step + 1, 1),
        entry(2, step, 2),
        // From 2^16 cells on, all h are equal: they saturate, rather than being cut to 32 bits.
        entry(2, (1 << 48) - 2 * step, 9),
        entry(2, (1 << 48) - step, 0),
        entry(2, 1 << 48, 1),
        entry(2, (1 << 48) + 7 * step, 2),
        entry(2, u64::MAX, 3),
        entry(2, 1 << 48, 4),
        entry(u64::MAX, 0, 0),
    ];
    assert!(ascending.is_sorted());
    assert_eq!(ascending[4].f(), Cost::from_bits(2));
    assert_eq!(ascending[4].id(), VertexId(1));
}

#[test]
fn the_heap_yields_what_a_sorted_set_yields_and_knows_every_slot() {
    for seed in 0..50 {
        let mut rng = Rng::new(seed);
        let (mut open, mut slots) = (OpenList::default(), HashMap::new());
        let (mut sorted, mut h_of) = (BTreeSet::new(), HashMap::new());
        for id in 0..2_000 {
            let (f, h) = (
                Cost::from_bits(u64::from(500 + rng.below(500))),
                Cost::from_bits(u64::from(rng.below(9)) << 16),
            );
            open.push(Entry::new(f, h, VertexId(id)), |id, slot| _ = slots.insert(id, slot));
            sorted.insert(Entry::new(f, h, VertexId(id)));
            h_of.insert(VertexId(id), h);
            if rng.chance(40) {
                let (first, _) =
                    open.pop(|id, slot| _ = slots.insert(id, slot)).expect("an entry was pushed");
                assert_eq!(Some(first), sorted.pop_first(), "seed {seed}");
                slots.remove(&first.id());
            }
            if let Some(&entry) = sorted.iter().nth(rng.below(20) as usize) {
                let gain = Cost::from_bits(u64::from(rng.below(50)));
                open.decrease(slots[&entry.id()], gain, |id, slot| _ = slots.insert(id, slot));
                sorted.remove(&entry);
                sorted.insert(Entry::new(entry.f() - gain, h_of[&entry.id()], entry.id()));
            }
            // Any entry, whether it becomes less or greater, or leaves.
            let any = sorted.iter().nth(rng.below(sorted.len().max(1) as u32) as usize).copied();
            if let Some(entry) = any.filter(|_| rng.chance(50)) {
                let slot = slots[&entry.id()];
                sorted.remove(&entry);
                if rng.chance(40) {
                    open.remove(slot, |id, slot| _ = slots.insert(id, slot));
                    slots.remove(&entry.id());
                } else {
                    let f = Cost::from_bits(u64::from(500 + rng.below(500)));
                    let other = Entry::new(f, h_of[&entry.id()], entry.id());
                    open.replace(slot, other, |id, slot| _ = slots.insert(id, slot));
                    sorted.insert(other);
                }
            }
            assert_eq!(open.len(), sorted.len());
            if id % 50 == 0 {
                for entry in &sorted {
                    assert_eq!(open.get(slots[&entry.id()]), Some(*entry), "seed {seed}");
                }
            }
        }
        while let Some((first, _)) = open.pop(|_, _| ()) {
            assert_eq!(Some(first), sorted.pop_first(), "seed {seed}");
        }
        assert!(sorted.is_empty());
    }
}

#[test]
fn swaps_are_counted() {
    let mut open = OpenList::default();
    let entry = |f: u32| Entry::new(Cost::from_bits(u64::from(f)), Cost::ZERO, VertexId(f));
    // Pushed in falling order, each entry climbs to the root: floor(log2(position)) swaps.
    let pushed: Vec<u32> = (0..7).rev().map(|f| open.push(entry(f), |_, _| ())).collect();
    assert_eq!(pushed, [0, 1, 1, 2, 2, 2, 2]);
    // The heap is 0; 3 1; 6 4 5 2: the last entry, 2, replaces the root and changes places with 1 alone.
    assert_eq!(open.pop(|_, _| ()), Some((entry(0), 1)));
    assert_eq!(open.decrease(99, Cost::ZERO, |_, _| ()), 0);
    assert_eq!((open.remove(99, |_, _| ()), open.replace(99, entry(0), |_, _| ()), open.len()), (0, 0, 6));
}
