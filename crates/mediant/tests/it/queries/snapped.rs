//! Snapped ends, and ends that are wrong.

use mediant::{Ends, Query, Vertex, errors::QueryError, grid::Grid, search::End};
use mediant_oracle::Rng;

use super::{
    World,
    ends::{Asked, asked_nearest, blocked, check},
    maps, motions, on_worlds,
};

/// A vertex that may be anywhere.
fn anywhere(world: &World, rng: &mut Rng) -> Vertex {
    let (width, height) = world.size();
    let axis = |rng: &mut Rng, length: i32| match rng.below(8) {
        0 => i32::MIN,
        1 => i32::MAX,
        2 => -1 - rng.below(9) as i32,
        3 => length + rng.below(9) as i32,
        _ => rng.below(length as u32) as i32,
    };
    Vertex::new(axis(rng, width), axis(rng, height))
}

#[test]
fn ends_are_snapped_to_the_nearest_free_vertex() {
    on_worlds(maps(1), |world, rng| {
        for (setup, mut planner) in world.planners() {
            for _ in 0..4 {
                let ends = Ends::new(anywhere(world, rng), anywhere(world, rng));
                let text = || world.text(setup, &ends);
                let snapped = world.snapped(ends.start).zip(world.snapped(ends.goal));
                let Some((start, goal)) = snapped else {
                    assert!(planner.find(ends.snap()).is_err(), "{}", text());
                    continue;
                };
                assert_eq!(planner.find(ends.snap()), planner.find(Query::new(start, goal)), "{}", text());
                let asked = asked_nearest(world, vec![start], vec![goal]);
                if !asked.are_nearest {
                    let query = ends.snap().nearest();
                    check(world, setup, &mut planner, &Asked { query, ..asked });
                }
            }
        }
    });
}

#[test]
fn a_map_without_a_free_vertex_has_no_end_to_snap_to() {
    for motion in motions() {
        let world = World::new(0, Grid::from_fn(3, 2, |_, _| true).expect("a map"), motion);
        for (setup, mut planner) in world.planners() {
            for (start, goal) in [((0, 0), (1, 1)), ((i32::MIN, 0), (1, i32::MAX))] {
                let at = Vertex::new(0, 0);
                let query = Query::new(start, goal).snap().nearest().tolerance(2.0);
                let error = Err(QueryError::NothingFree { end: End::Start, at: at.into() });
                assert_eq!(planner.find(query), error, "{setup}");
            }
        }
    }
}

#[test]
fn wrong_ends_are_named() {
    on_worlds(maps(1), |world, rng| {
        let (Some(free), Some(wall)) = (world.free(rng), blocked(world, rng)) else { return };
        let (width, height) = world.size();
        let last = Vertex::new(width - 1, height - 1);
        let beyond = Vertex::new(width, 0);
        for (setup, mut planner) in world.planners() {
            let mut is_wrong = |query: Query, error: QueryError| {
                assert_eq!(planner.find(query.clone()), Err(error), "{}", world.text(setup, &query));
                assert_eq!(planner.begin(query.clone()), Err(error), "{}", world.text(setup, &query));
                assert_eq!(planner.step(1), Err(QueryError::NotBegun), "{}", world.text(setup, &query));
            };
            let none: [Vertex; 0] = [];
            for (starts, goals, end) in [
                (&none[..], &none[..], End::Start),
                (&none, &[free], End::Start),
                (&[free], &none, End::Goal),
            ] {
                let query = Query::between(starts.iter().copied(), goals.iter().copied());
                is_wrong(query.clone(), QueryError::NoEnd { end });
                is_wrong(query.snap().nearest().tolerance(3.0), QueryError::NoEnd { end });
            }
            for (at, is_outside) in [(wall, false), (beyond, true)] {
                let error = |end: End| match is_outside {
                    true => QueryError::Outside { end, at: at.into(), last },
                    false => QueryError::Blocked { end, at: at.into() },
                };
                is_wrong(Query::between([free, at], [free]), error(End::Start));
                is_wrong(Query::between([free, at], [free, at]).nearest(), error(End::Start));
                is_wrong(Query::between([free], [free, at]), error(End::Goal));
                is_wrong(Query::new(at, free).nearest().tolerance(1e9), error(End::Start));
                is_wrong(Query::new(free, at).tolerance(0.0), error(End::Goal));
            }
            let outside = QueryError::Outside { end: End::Goal, at: beyond.into(), last };
            is_wrong(Query::new(free, beyond).nearest(), outside);
            is_wrong(Query::new(free, beyond).tolerance(1e9), outside);
            for radius in [f64::NAN, -0.5, f64::NEG_INFINITY] {
                is_wrong(Query::new(free, free).tolerance(radius), QueryError::Tolerance);
                is_wrong(Query::new(free, beyond).tolerance(radius).snap(), QueryError::Tolerance);
            }
        }
    });
}
