//! The subgoals that points may see, by the index, against visibility sweeps and lines of sight.

use std::{collections::BTreeSet, sync::Arc};

use mediant_grid::{Corners, DiagonalGap, FreeSpace, Grid, Interrupt, sight::Place};
use mediant_moves::K;
use mediant_oracle::{
    Rng, describe_points, noise, on_all_cores, random_free_point, rooms, seeds, suite_grid, wide_grid,
};

use super::{Candidates, HubLabels, Line, cells_around, vertices_around};
use crate::{corners::PointSight, placement::EdgeFinder};

/// Maps of several blocks, with words and blocks that end in the middle.
fn map(seed: u64) -> Grid {
    let mut rng = Rng::new(seed);
    let (width, height) = (1 + rng.below(90), 1 + rng.below(30));
    match seed % 4 {
        0 => suite_grid(seed).0,
        1 => noise(&mut rng, width, height, 1 + seed as u32 % 7),
        2 => rooms(&mut rng, width, height),
        _ => wide_grid(seed).0,
    }
}

/// The subgoals that some points see, those of them that no vertex around sees, and those that all vertices
/// around see.
type Counts = [usize; 3];

fn check(space: &FreeSpace<Corners>, labels: &HubLabels<Corners>, seed: u64, counts: &mut Counts) {
    let (mut rng, grid) = (Rng::new(seed), space.grid());
    let (seen, subgoals) = (&labels.geometry.seen, &labels.geometry.subgoals);
    let Some(cells) = &seen.cells else { return };
    let mut sight = PointSight::new(space, subgoals.marks());
    let (mut candidates, mut scratch) = (Candidates::<Line>::none(), [Vec::new(), Vec::new()]);
    for _ in 0..24 {
        let Some(point) = random_free_point(&mut rng, grid) else { return };
        let from = Place { x: point.0 as i32, y: point.1 as i32 };
        if from.vertex().is_some() {
            continue;
        }
        candidates.find_around(labels, space, cells, from, &mut scratch);
        let slots = &candidates.slots[..candidates.count];
        let found: BTreeSet<u32> = slots.iter().map(|slot| slot / Corners::SIDES).collect();
        let mut expected = BTreeSet::new();
        sight.seen_from(space, from, |at| expected.extend(subgoals.id(at)));
        let to = |id: u32| Place::of(subgoals.vertex(id));
        let case = |id: u32| {
            let Place { x, y } = to(id);
            describe_points(grid, space.rule(), point, (x.into(), y.into()), seed)
        };
        for &id in &expected {
            // Behind a corner on the same ray the labels lead there over it.
            let line = from.to(to(id));
            let is_before = |&other: &u32| {
                let v = from.to(to(other));
                v.det(line) == 0 && v.dot(line) > 0 && v.norm_squared() < line.norm_squared()
            };
            assert!(found.contains(&id) || found.iter().any(is_before), "not found: {}", case(id));
        }
        let mut around = vec![0; seen.room_around()];
        let mut lists = [around.clone(), around.clone()];
        let [others, merged] = &mut lists;
        let corners = vertices_around(space, from);
        let count = seen.slots_around(corners, &mut around, [others, merged]);
        let around: BTreeSet<u32> = around[..count].iter().map(|slot| slot / Corners::SIDES).collect();
        counts[0] += expected.len();
        counts[1] += expected.difference(&around).count();
        let is_inside = cells_around(from).iter().all(|(low, high)| low == high);
        for &slot in slots.iter().filter(|&&slot| is_inside && seen.joins_all(corners, slot)) {
            let id = slot / Corners::SIDES;
            assert_eq!(space.first_between(from, to(id)), None, "not seen: {}", case(id));
            counts[2] += 1;
        }
    }
}

#[test]
fn points_may_see_what_is_seen_around_them_and_surely_what_all_vertices_see() {
    let of = |seed: u64| {
        let mut counts = [0; 3];
        let gap = [DiagonalGap::Open, DiagonalGap::Closed][seed as usize / 4 % 2];
        let space = FreeSpace::<Corners>::new(Arc::new(map(seed)), gap);
        let labels = HubLabels::within(&space, K::Any, usize::MAX, &|_| {}, &Interrupt::NEVER);
        check(&space, &labels.expect("there is memory"), seed, &mut counts);
        counts
    };
    let counts = on_all_cores(seeds(600), of);
    let counts = counts.into_iter().fold([0; 3], |a, b| [a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
    assert!(counts[0] > 20_000 && counts[1] > 100 && counts[2] > 10_000, "{counts:?}");
}
