//! Contraction on larger maps: what is left, and that threads change nothing.

use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid};
use mediant_moves::K;
use mediant_oracle::{Rng, noise, random_free_vertex};
use mediant_search::{Ends, Path, Planner};
use mediant_subgoal::{Hierarchy, SubgoalAStar, SubgoalPlacement};

use crate::common::{graph, k, levels, space};

/// Rooms of 19 × 19 cells with doors anywhere in their walls, and a few blocked cells.
fn town(width: u32, height: u32) -> Grid {
    const PITCH: u32 = 20;
    let rooms = (width.div_ceil(PITCH) * height.div_ceil(PITCH)) as usize;
    let mut rng = Rng::new(0xC17);
    let doors: Vec<[u32; 2]> = (0..rooms).map(|_| [(); 2].map(|()| 1 + rng.below(PITCH - 1))).collect();
    let litter = noise(&mut rng, width, height, 1);
    Grid::from_fn(width, height, |x, y| {
        let room = (y / PITCH * width.div_ceil(PITCH) + x / PITCH) as usize;
        let (across, down) = (x % PITCH, y % PITCH);
        let is_wall = (across == 0 && down != doors[room][0]) || (down == 0 && across != doors[room][1]);
        is_wall || (x * 7 + y * 3).is_multiple_of(13) && litter.is_blocked(x as i32, y as i32)
    })
    .expect("a valid size")
}

fn is_contracted_completely<P: SubgoalPlacement>(space: &FreeSpace<P>, k: K) {
    let graph = graph(space, k, Hierarchy::Contracted);
    assert!(graph.subgoals() > 1000, "{}", graph.subgoals());
    assert_eq!(graph.core(), 0, "k = {k}");
}

#[test]
fn a_large_map_of_rooms_has_no_core() {
    let town = town(400, 400);
    is_contracted_completely(&space::<Centers>(&town, CornerRule::Never), k(3));
    is_contracted_completely(&space::<Corners>(&town, DiagonalGap::Open), K::Any);
}

fn costs_stay<P: SubgoalPlacement>(space: &FreeSpace<P>, k: K) {
    let [contracted, flat] = [Hierarchy::Contracted, levels(1)].map(|levels| graph(space, k, levels));
    let [mut contracted, mut flat] = [&contracted, &flat]
        .map(|graph| SubgoalAStar::new(space, graph).expect("the graph is for this space"));
    let mut rng = Rng::new(7);
    let mut found = 0;
    for _ in 0..30 {
        let mut end = || random_free_vertex(&mut rng, space.grid(), P::KIND).expect("there is a free vertex");
        let query = Ends::new(end(), end());
        let [cost, expected] = [contracted.solve(query), flat.solve(query)]
            .map(|answer| answer.expect("both ends are free").path().map(Path::cost));
        let gap = cost.zip(expected).map_or(0.0, |(cost, expected)| (cost - expected).abs());
        assert!(cost.is_some() == expected.is_some() && gap < 1e-6, "{cost:?}, {expected:?}: {query:?}, {k}");
        found += usize::from(cost.is_some());
    }
    assert!(found > 15, "{found}");
}

#[test]
fn costs_are_those_of_the_graph_that_is_not_contracted() {
    let noise = noise(&mut Rng::new(3), 50, 60, 15);
    for grid in [&town(90, 100), &noise] {
        costs_stay(&space::<Centers>(grid, CornerRule::Never), k(3));
        costs_stay(&space::<Corners>(grid, DiagonalGap::Open), k(3));
        costs_stay(&space::<Corners>(grid, DiagonalGap::Open), K::Any);
    }
}

/// A digest of the bytes of graphs (FNV-1a).
fn digest() -> u64 {
    let town = town(160, 150);
    let (centers, corners) =
        (space::<Centers>(&town, CornerRule::Never), space::<Corners>(&town, DiagonalGap::Open));
    let [first, second] = [
        graph(&centers, k(3), Hierarchy::Contracted).to_bytes(),
        graph(&corners, K::Any, Hierarchy::Contracted).to_bytes(),
    ];
    first
        .into_iter()
        .chain(second)
        .fold(0xCBF2_9CE4_8422_2325, |sum: u64, byte| (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3))
}

/// The number changes whenever the rule of contraction does. It is the same with and without the feature
/// `parallel`, and on every platform.
#[test]
fn graphs_are_the_same_everywhere() {
    assert_eq!(digest(), 12_759_723_855_274_832_519);
}

#[cfg(feature = "parallel")]
#[test]
fn graphs_are_the_same_on_any_number_of_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can start");
        pool.install(digest)
    };
    assert_eq!([2, 5].map(on), [on(1); 2]);
}
