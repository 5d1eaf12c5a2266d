//! Whatever numbers come in, the answer is a value or an error: nothing panics, nothing overflows.

use mediant::{Engine, K, Map, Motion, Query, Rectangle, Setup, Vertex};
use mediant_grid::Rules;

use super::{k, map};

const NUMBERS: [i32; 9] = [i32::MIN, i32::MIN + 1, -65, -1, 0, 5, 9, 64, i32::MAX];

fn vertices() -> impl Iterator<Item = Vertex> {
    NUMBERS.into_iter().flat_map(|x| NUMBERS.map(|y| Vertex::new(x, y)))
}

fn motions() -> impl Iterator<Item = Motion> {
    let ks = [2, 3, 5].map(|n| K::Finite(k(n))).into_iter().chain([K::Any]);
    ks.flat_map(|k| Rules::ALL.map(|rules| Motion::new(k, rules)))
}

#[test]
fn vertices_may_be_anywhere() {
    let mut asked = 0;
    for space in motions().filter_map(|motion| map().space(motion).ok()) {
        let on_map = |at: Vertex| (0..=9).contains(&at.x) && (0..=5).contains(&at.y);
        for (a, b) in vertices().flat_map(|a| vertices().map(move |b| (a, b))) {
            let both = space.is_free(a) && space.is_free(b);
            assert!(both || !space.connected(a, b), "{a}, {b}, {}", space.motion());
            assert!(both || !space.sees(a, b), "{a}, {b}, {}", space.motion());
            assert!(on_map(a) || !space.is_free(a), "{a}, {}", space.motion());
            asked += 1;
        }
        let engines = Setup::all(space.motion());
        let mut planners: Vec<_> =
            engines.map(|setup| setup.prepare(&space).expect("it fits").planner()).collect();
        for at in vertices().filter(|&at| !space.is_free(at)) {
            for planner in &mut planners {
                assert!(planner.find(Query::new(at, (0, 0))).is_err());
                assert!(planner.find(Query::new((0, 0), at)).is_err());
            }
            assert!(space.path(at, (0, 0)).is_err());
            assert!(space.distances(Engine::Dijkstra, at).is_err());
        }
    }
    assert!(asked > 100_000, "{asked}");
}

#[test]
fn edits_may_be_anywhere() {
    let numbers = [0, 1, 4, 8, 9, 64, u32::MAX - 1, u32::MAX];
    for (x, y) in numbers.into_iter().flat_map(|x| numbers.map(|y| (x, y))) {
        for (width, height) in numbers.into_iter().flat_map(|width| numbers.map(|height| (width, height))) {
            let at = Rectangle { x, y, width, height };
            let edited = map().edit(at, |_, _| true);
            assert_eq!(edited.is_ok(), x < 9 && y < 5, "{at:?}");
            let Ok(edited) = edited else { continue };
            let is_blocked = |x: u32, y: u32| {
                let inside = x >= at.x && x - at.x < width && y >= at.y && y - at.y < height;
                inside || map().is_blocked((x, y))
            };
            assert_eq!(edited, Map::from_fn(9, 5, is_blocked).expect("a map"), "{at:?}");
        }
    }
}

/// The smallest maps, and maps without any free cell, in every space, with every engine.
#[test]
fn maps_may_be_tiny_or_full() {
    for (width, height, blocked) in
        [(1, 1, false), (1, 1, true), (1, 70, false), (70, 1, true), (2, 2, false)]
    {
        let map = Map::from_fn(width, height, |_, _| blocked).expect("a map");
        for space in motions().filter_map(|motion| map.space(motion).ok()) {
            let choice = space.engine();
            assert!(space.planner(choice).is_ok(), "{choice}");
            for setup in Setup::all(space.motion()) {
                let index = setup.prepare(&space).unwrap_or_else(|error| panic!("{setup}: {error}"));
                let answer = index.planner().find(Query::new((0, 0), (0, 0)));
                assert_eq!(answer.is_ok(), !blocked, "{setup}");
                if let Ok(bytes) = index.to_bytes() {
                    assert!(space.index_from_bytes(bytes).is_ok(), "{setup}");
                }
            }
        }
    }
}
