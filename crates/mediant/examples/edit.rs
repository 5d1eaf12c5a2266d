//! A map that changes: a door opens, the index is repaired, and the planner follows.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use mediant::{Engine, K, Map, Motion, Query, Rectangle};

fn main() -> Result<(), mediant::Error> {
    let walled = Map::from_fn(64, 64, |x, _| x == 30)?.space(Motion::centers(K::N8))?;
    let index = walled.prepare(Engine::JpsBlock)?;
    let mut planner = index.planner();

    let change = walled.edit(Rectangle::new(30, 20, 1, 2), |_, _| false)?;
    let repaired = index.repair(&change)?;
    for index in [index, repaired] {
        planner.follow(&index)?;
        let answer = planner.find(Query::new((0, 0), (60, 50)))?;
        println!("{:?}: {:?}", index.origin(), answer.cost());
    }
    Ok(())
}
