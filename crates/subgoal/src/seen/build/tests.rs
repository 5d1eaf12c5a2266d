//! The seen index against its definition.

use std::{collections::BTreeSet, sync::Arc};

use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, Interrupt, Vertex, uninterrupted,
};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{Rng, describe, noise, on_all_cores, random_grid, rooms, seeds, wide_grid};

use super::{BlockLinks, FULL, Link, SeenIndex, links};
use crate::{
    build::Ground,
    hierarchy::Hierarchy,
    placement::{EdgeFinder, EdgeKind, SubgoalPlacement},
};

fn ground<P: SubgoalPlacement>(space: &FreeSpace<P>, k: K) -> Ground<P> {
    Ground::new(space, k, Hierarchy::Contracted, &Interrupt::NEVER).expect("there is a graph")
}

fn free<P: SubgoalPlacement>(space: &FreeSpace<P>) -> impl Iterator<Item = Vertex> {
    let (width, height) = P::vertices(space.grid());
    let all = (0..height as i32).flat_map(move |y| (0..width as i32).map(move |x| Vertex::new(x, y)));
    all.filter(|&at| space.is_free(at))
}

/// The slots to which a vertex is joined: each once.
fn slots(index: &SeenIndex, at: Vertex) -> BTreeSet<u32> {
    let mut slots = vec![0; index.most + 1];
    let count = index.slots(at, &mut slots);
    let found: BTreeSet<u32> = slots[..count].iter().copied().collect();
    assert_eq!(found.len(), count, "a slot comes twice at {at}");
    found
}

/// Maps of several blocks, with words and blocks that end in the middle.
fn map(seed: u64) -> Grid {
    let mut rng = Rng::new(seed);
    let (width, height) = (1 + rng.below(90), 1 + rng.below(30));
    match seed % 4 {
        0 => random_grid(seed).0,
        1 => noise(&mut rng, width, height, (seed % 50) as u32 / 2),
        2 => rooms(&mut rng, width, height),
        _ => wide_grid(seed).0,
    }
}

/// Compares with lines of sight from every free vertex. Returns the number of slots found.
fn check_corners(space: &FreeSpace<Corners>, index: &SeenIndex, seed: u64) -> usize {
    let (ground, mut scratch, mut count) = (ground(space, K::Any), Default::default(), 0);
    let context = ground.context(space);
    let vertex = |id: u32| ground.subgoals.vertex(id);
    for at in free(space) {
        let case = |id| describe(space.grid(), space.rules(), at, vertex(id), seed);
        let found = slots(index, at);
        count += found.len();
        for &slot in found.iter().filter(|_| !space.is_closed_gap(at)) {
            let (id, side) = (slot / 2, slot % 2);
            assert!(space.sees(at, vertex(id)), "not seen: {}", case(id));
            let blocked = |x: i32, y: i32| {
                space.grid().is_blocked(vertex(id).x + (x - 1) / 2, vertex(id).y + (y - 1) / 2)
            };
            let sign = if blocked(1, 1) || blocked(-1, -1) { -1 } else { 1 };
            let (v, x) = (vertex(id).to(at), if side == 1 { 1 } else { -1 });
            assert!(v.x * x >= 0 && v.y * x * sign >= 0 && at != vertex(id), "side {side}: {}", case(id));
        }
        let mut expected = BTreeSet::new();
        Corners::edges_from(context, &mut scratch, at, EdgeKind::Query, |id, _| _ = expected.insert(id));
        for &id in &expected {
            // Behind a corner on the same ray an edge leads there first.
            let d = at.to(vertex(id));
            let is_before = |&other: &u32| {
                let v = at.to(vertex(other));
                v.det(d) == 0 && v.dot(d) > 0 && v.norm_squared() < d.norm_squared()
            };
            let is_there = found.contains(&(2 * id)) || found.contains(&(2 * id + 1));
            let is_behind = expected.iter().any(is_before);
            assert!(is_there || is_behind, "an edge is missing: {}", case(id));
        }
    }
    count
}

fn index<P: SubgoalPlacement>(space: &FreeSpace<P>, k: K) -> SeenIndex {
    let ground = ground(space, k);
    let index = uninterrupted(|never| SeenIndex::new(ground.context(space), usize::MAX, &|_| {}, never));
    index.expect("there is memory")
}

#[test]
fn at_corners_each_vertex_sees_its_slots_and_has_all_edges() {
    let check = |seed| {
        let gap = [DiagonalGap::Open, DiagonalGap::Closed][seed as usize / 4 % 2];
        let space = FreeSpace::<Corners>::new(Arc::new(map(seed)), gap);
        check_corners(&space, &index(&space, K::Any), seed)
    };
    let found: usize = on_all_cores(seeds(80), check).into_iter().sum();
    assert!(found > 1000 * seeds(80).end as usize, "{found}");
}

#[test]
fn it_is_the_same_for_every_k_at_corners() {
    let space = FreeSpace::<Corners>::new(Arc::new(map(5)), DiagonalGap::Open);
    for k in 2..9 {
        let k = K::Finite(FiniteK::new(k).expect("at least 2"));
        assert_eq!(index(&space, k), index(&space, K::Any), "k = {k}");
    }
}

#[test]
fn at_centers_it_holds_the_direct_edges() {
    let check = |seed: u64| {
        let grid = Arc::new(map(seed));
        let mut count = 0;
        for (k, rule) in [(2, CornerRule::Never), (2, CornerRule::Always), (3, CornerRule::Never)] {
            let k = K::Finite(FiniteK::new(k).expect("at least 2"));
            let space = FreeSpace::<Centers>::new(Arc::clone(&grid), rule);
            let (ground, index) = (ground(&space, k), index(&space, k));
            for at in free(&space) {
                let mut expected = BTreeSet::new();
                match ground.subgoals.id(at) {
                    Some(id) => _ = expected.insert(id),
                    None => {
                        Centers::edges_from(ground.context(&space), &mut (), at, EdgeKind::Query, |id, _| {
                            expected.insert(id);
                        });
                    }
                }
                assert_eq!(
                    slots(&index, at),
                    expected,
                    "k = {k}: {}",
                    describe(&grid, space.rules(), at, at, seed)
                );
                count += expected.len();
            }
        }
        count
    };
    let found: usize = on_all_cores(seeds(80), check).into_iter().sum();
    assert!(found > 500 * seeds(80).end as usize, "{found}");
}

/// With few masks, most links become entries of rows, and say the same.
#[test]
fn a_full_dictionary_changes_no_answer() {
    let grid = noise(&mut Rng::new(3), 100, 75, 4);
    let space = FreeSpace::<Corners>::new(Arc::new(grid), DiagonalGap::Open);
    let ground = ground(&space, K::Any);
    let whole = index(&space, K::Any);
    // The full mask, the empty one and those of rows: no others, or few.
    let rows = 2 + 8 * 255;
    assert!(whole.masks.len() > rows + 500, "{} masks", whole.masks.len());
    let with_masks = |most| {
        let context = ground.context(&space);
        uninterrupted(|never| SeenIndex::with_masks(context, usize::MAX, most, &|_| {}, never))
    };
    for most in [rows, rows + 300, whole.masks.len() - 1] {
        let part = with_masks(most).expect("there is memory");
        assert!(part.masks.len() <= most && part.entries.len() > whole.entries.len(), "{most}");
        for at in free(&space) {
            assert_eq!(slots(&part, at), slots(&whole, at), "{most} masks, at {at}");
        }
    }
    let same = with_masks(whole.masks.len());
    assert_eq!(same.as_ref(), Some(&whole), "just as many as there are");
}

/// Entries that come further than 16 bits can tell.
#[test]
fn slots_may_be_far_apart() {
    let far = u32::from(u16::MAX);
    let last = 9 * far + 17;
    let links = [(1, 3, 1), (1, 4, FULL), (1, 3 + far, 1), (1, 4 + 2 * far, 2), (1, last, 3), (2, last, 1)];
    let mut all = BlockLinks::new(3);
    links.into_iter().for_each(|(block, slot, mask)| all.add(Link { block, slot, mask }));
    let index = uninterrupted(|never| SeenIndex::of_links(&all, 3, 65_536, never));
    let at = |x| slots(&index, Vertex::new(x, 0)).into_iter().collect::<Vec<_>>();
    assert_eq!(at(0), []);
    assert_eq!(at(8), [3, 4, 3 + far, last]);
    assert_eq!(at(9), [4, 4 + 2 * far, last]);
    assert_eq!(at(10), [4]);
    assert_eq!((at(16), at(17)), (vec![last], vec![]));
}

/// No more memory than allowed, and links that are found once only.
#[test]
fn it_keeps_within_its_memory() {
    let space = FreeSpace::<Corners>::new(Arc::new(map(5)), DiagonalGap::Open);
    let ground = ground(&space, K::Any);
    let whole = index(&space, K::Any);
    let of = |most| uninterrupted(|never| SeenIndex::new(ground.context(&space), most, &|_| {}, never));
    let within = |most| of(most).is_some();
    assert!(within(whole.memory_bytes()) && !within(0) && !within(whole.entries.len() * 4));
    let free = vec![!0; whole.blocks.len() - 1];
    let links = |fits: &dyn Fn(usize) -> bool| {
        let blocks = (whole.columns, &free[..]);
        uninterrupted(|never| links(ground.context(&space), blocks, fits, &|_| {}, never))
    };
    let (all, _) = links(&|_| true).expect("they fit");
    assert!(all.total >= whole.entries.len());
    assert!(links(&|count| count < all.total).is_none());
}
