//! Links are read as they were added.

use mediant_oracle::Rng;

use super::{BlockLinks, EMPTY, Link};

/// Of more masks than 16 bits can number, with slots further apart than 16 bits can tell.
#[test]
fn links_are_read_as_they_were_added() {
    const BLOCKS: usize = 5;
    let (mut rng, mut links) = (Rng::new(11), BlockLinks::new(BLOCKS));
    let (mut added, mut slot) = (vec![Vec::new(); BLOCKS], 7);
    for number in 0..200_000_u64 {
        let block = rng.below(BLOCKS as u32 - 1);
        slot += if number % 1000 == 0 { 150_000 } else { rng.below(3) + 1 };
        let mask = if number % 3 == 0 { !0 } else { rng.below(90_000).into() };
        links.add(Link { block, slot, mask });
        added[block as usize].push((slot, mask));
    }
    let masks: Vec<u64> = links.masks.all().collect();
    assert!(masks.len() > 1 << 16, "{} masks", masks.len());
    for (block, expected) in added.iter().enumerate() {
        let mut at = links.first_slot(block);
        let found = links.of(block).filter_map(|link| {
            at += u32::from(link.after);
            (link.mask != u32::from(EMPTY)).then(|| (at, masks[link.mask as usize]))
        });
        assert!(found.eq(expected.iter().copied()), "block {block}");
    }
    let counted: usize = links.masks.counted().iter().map(|(count, _)| count).sum();
    assert_eq!(counted, added.iter().flatten().filter(|&&(_, mask)| mask != !0).count());
}
