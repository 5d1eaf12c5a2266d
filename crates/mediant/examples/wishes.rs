//! Wishes beyond a path: the nearest place, a tolerance, limits.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use mediant::{Ends, Engine, K, Limits, Map, Motion};

fn main() -> Result<(), mediant::Error> {
    let space = Map::from_fn(80, 60, |x, y| x == 40 && y > 2)?.space(Motion::centers(K::N8))?;
    let mut planner = space.planner(Engine::AStar)?;
    let ends = Ends::new((2, 30), (40, 30)); // The goal is in the wall.
    for query in [ends.nearest(), ends.tolerance(3.0), ends.snap().within(Limits::new().expansions(20))] {
        println!("{:?}", planner.find(query)?);
    }
    Ok(())
}
