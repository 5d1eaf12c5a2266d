//! Ends in pockets, and in rooms behind single doors: an index may leave these out where a query needs none.

use mediant::{Answer, Ends, Engine, K, Limits, Map, Motion, PlacementKind, Query, Setup, Vertex};
use mediant_oracle::on_all_cores;

use super::{
    World, end,
    ends::{Asked, asked_nearest, check},
    motions,
};

/// Two halls side by side with a door, each with a room behind a door of its own; niches in the halls; and
/// a vault without a door, at the bottom.
const HALLS: [&str; 12] = [
    ".......#.......",
    "..##.......##..",
    "..#....#...##..",
    "..##...#.......",
    ".......#.......",
    "##.##########.#",
    "##.##########.#",
    ".....##...#....",
    ".....##...#.##.",
    ".###.##...#.#..",
    ".....####.#.##.",
    "########..#....",
];

fn world(motion: Motion) -> World {
    let map = Map::from_rows(HALLS).expect("a map");
    World::new(0, map.grid().as_ref().clone(), motion)
}

/// A niche and the middle of each hall, the rooms, and the vault. Each is free in both placements.
const PLACES: [(i32, i32); 8] = [(3, 2), (5, 1), (9, 3), (14, 4), (0, 8), (4, 10), (13, 9), (8, 8)];
const VAULT: Vertex = Vertex::new(8, 8);

#[test]
fn pockets_and_rooms_are_open_where_they_are_needed() {
    let motions: Vec<Motion> =
        motions().into_iter().filter(|motion| motion.rules.placement() == PlacementKind::Corner).collect();
    on_all_cores(0..motions.len() as u64, |number| {
        let world = world(motions[number as usize]);
        let places = PLACES.map(Vertex::from);
        // The others are asked on random maps.
        let planners = world.planners().filter(|(setup, _)| setup.engine.kind() == Engine::Anya);
        for (setup, mut planner) in planners {
            for (number, &start) in places.iter().enumerate() {
                // Alone, together with one elsewhere, and if there is no way.
                let other = places[(number + 3) % places.len()];
                for &goal in &places {
                    let goals = vec![goal, places[(number + 5) % places.len()]];
                    let starts = vec![start, other];
                    let query = Query::between(starts.clone(), goals.clone());
                    let asked = Asked { query, starts, goals, are_nearest: false };
                    check(&world, setup, &mut planner, &asked);
                    let asked = asked_nearest(&world, vec![start], vec![goal]);
                    assert_eq!(asked.are_nearest, (start == VAULT) != (goal == VAULT));
                    check(&world, setup, &mut planner, &asked);
                    let found = planner.find(Query::new(start, goal)).expect("both ends are free");
                    assert_eq!(found.path().is_none(), asked.are_nearest, "{}", world.text(setup, &asked));
                }
            }
        }
    });
}

/// A goal in a room, with a tolerance that reaches through the wall into the hall: the vertices there are
/// ends, too.
#[test]
fn a_tolerance_reaches_through_walls() {
    for motion in motions() {
        let world = world(motion);
        let (start, goal) = (Vertex::new(4, 4), Vertex::new(4, 7));
        let near: Vec<Vertex> = world.oracle.free_vertices().filter(|at| at.distance(goal) <= 3.0).collect();
        assert!(near.contains(&start) && near.iter().any(|at| at.y > 7), "{near:?}");
        for (setup, mut planner) in world.planners() {
            let found = planner.find(Query::new(start, goal).tolerance(3.0));
            assert_eq!(found.map(|answer| answer.cost()), Ok(Some(0.0)), "{setup}");
            let far = Vertex::new(0, 0);
            let found = planner.find(Query::new(far, goal).tolerance(3.0)).expect("both ends are free");
            let best = near.iter().filter_map(|&at| world.optimum(far, at)).fold(f64::INFINITY, f64::min);
            if super::is_exact(&planner) {
                let cost = found.cost().expect("there is a way");
                assert!((cost - best).abs() < 1e-9, "{setup}: {cost}, not {best}");
            }
        }
    }
}

/// A search names only vertices that it reached: stopped early, it ends in the room where it began, though
/// the goal is nearer from outside.
#[test]
fn a_stopped_search_names_what_it_reached() {
    for motion in motions().into_iter().filter(|motion| motion.k == K::Any) {
        let world = world(motion);
        for setup in Setup::all(motion) {
            let mut planner = setup.prepare(&world.space).expect("an index").planner();
            let ends = Ends::new((4, 10), (3, 2));
            let whole = planner.find(ends).expect("both ends are free").into_path().expect("a way");
            for most in 0..40 {
                let query = ends.within(Limits::new().cost(f64::from(most) / 2.0));
                match planner.find(query).expect("both ends are free") {
                    Answer::Stopped(stopped) => {
                        let at = end(&stopped.best);
                        world.check_path(setup, &stopped.best, (ends.start, at), &ends);
                        assert!(stopped.best.cost() <= f64::from(most) / 2.0 + 1e-9, "{setup}");
                    }
                    found => assert_eq!(found.path(), Some(&whole), "{setup}"),
                }
            }
        }
    }
}
