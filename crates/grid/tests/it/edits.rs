//! Free spaces that follow edits, against those of the edited maps made anew.

use std::sync::Arc;

use mediant_grid::{
    Centers, Change, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Placement, Vertex,
};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{Rng, caves, maze, noise, on_all_cores, random_change, rooms, seeds};

/// A map of some tiles of 64 × 64, some of them narrow.
fn map(rng: &mut Rng) -> Grid {
    let [width, height] = [0; 2].map(|_| {
        let most = if rng.below(4) == 0 { 8 } else { 200 };
        1 + rng.below(most)
    });
    match rng.below(5) {
        0 => rooms(rng, width, height),
        1 => maze(rng, width, height),
        2 => caves(rng, width, height),
        3 => noise(rng, width, height, 60),
        _ => {
            let percent = rng.below(45);
            noise(rng, width, height, percent)
        }
    }
}

/// Checks that both say the same of all vertices, and of which are connected: each with the first vertex that
/// has its component in the new space, and these with one another.
fn check_same<P: Placement>(repaired: &FreeSpace<P>, message: &str) {
    let new = FreeSpace::<P>::for_k(Arc::clone(repaired.grid()), repaired.rule(), k_of(repaired));
    assert_eq!(repaired.identity(), new.identity(), "{message}");
    assert_eq!(repaired.has_closed_gaps(), new.has_closed_gaps(), "{message}");
    let mut firsts: Vec<Vertex> = Vec::new();
    let (width, height) = P::vertices(new.grid());
    for at in (0..height as i32).flat_map(|y| (0..width as i32).map(move |x| Vertex::new(x, y))) {
        assert_eq!(repaired.is_closed_gap(at), new.is_closed_gap(at), "{message}, {at}");
        if !new.is_free(at) {
            continue;
        }
        match firsts.iter().position(|&first| new.connected(first, at)) {
            Some(known) => assert!(repaired.connected(firsts[known], at), "{message}, {at}"),
            // To compare all of them takes long where there are many.
            None if firsts.len() < 40 => {
                let apart = firsts.iter().all(|&first| !repaired.connected(first, at));
                assert!(apart, "{message}, {at}");
                firsts.push(at);
            }
            None => {}
        }
    }
    assert_eq!(repaired.components().count(), new.components().count(), "{message}");
}

fn k_of<P: Placement>(space: &FreeSpace<P>) -> K {
    space.identity().k.unwrap_or(K::Any)
}

/// A chain of edits. Some of the old versions are kept for a while, and are still right in the end.
fn follow<P: Placement>(seed: u64, rule: P::Rule, k: K) {
    let mut rng = Rng::new(seed);
    let mut space = FreeSpace::<P>::for_k(Arc::new(map(&mut rng)), rule, k);
    let mut kept = Vec::new();
    for step in 0..20 {
        let change = random_change(&mut rng, space.grid());
        let next = space.after(&change);
        let message = format!("seed {seed}, {:?}, edit {step}: {:?}", space.rules(), change.cells());
        check_same(&next, &message);
        if rng.below(4) == 0 {
            kept.push((space, step));
        }
        space = next;
        kept.truncate(3);
    }
    for (space, step) in kept {
        check_same(&space, &format!("seed {seed}, the version before edit {step}"));
    }
}

#[test]
fn free_spaces_follow_edits() {
    on_all_cores(seeds(16), |seed| {
        follow::<Corners>(seed, DiagonalGap::Open, K::Any);
        follow::<Corners>(seed, DiagonalGap::Closed, K::Any);
        follow::<Centers>(seed, CornerRule::Never, K::Any);
        follow::<Centers>(seed, CornerRule::Always, K::Any);
        follow::<Centers>(seed, CornerRule::Always, K::N4);
    });
}

/// A door between two halves, in the middle of a tile, on its border and at its corner.
#[test]
fn a_door_joins_and_parts_two_halves() {
    for (door, wall) in [(10, 100), (63, 100), (64, 64), (10, 63), (63, 64)] {
        let map = Arc::new(Grid::from_fn(200, 150, |x, _| x == wall).expect("a map"));
        let closed = FreeSpace::<Centers>::new(Arc::clone(&map), CornerRule::Never);
        let open = Change::new(map).edit_cells([(wall, door, false)]);
        let opened = closed.after(&open);
        let again = opened.after(&Change::new(Arc::clone(open.after())).edit_cells([(wall, door, true)]));
        let [west, east] = [(0, 0), (199, 149)].map(Vertex::from);
        let connected = [&closed, &opened, &again].map(|space| space.connected(west, east));
        assert_eq!(connected, [false, true, false], "a door at ({wall}, {door})");
    }
}

/// A change of another map, or to another size.
#[test]
fn a_change_that_does_not_fit_makes_the_free_space_anew() {
    let [small, large] = [(3, 4), (70, 80)].map(|(width, height)| {
        Arc::new(Grid::from_fn(width, height, |x, y| x % 3 == 1 && y > 1).expect("a map"))
    });
    let space = FreeSpace::<Corners>::new(Arc::clone(&small), DiagonalGap::Closed);
    let other = Change::new(large).edit_cells([(5, 6, true), (69, 79, true)]);
    check_same(&space.after(&other), "a change of another map");
    let four = GridGraph::<Centers>::new(small, FiniteK::N4, CornerRule::Always).expect("k = 2 is searched");
    check_same(&four.after(&other), "k = 2");
}
