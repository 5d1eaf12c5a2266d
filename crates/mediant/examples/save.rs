//! An index that is saved, and loaded by another program or on another day.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use mediant::{Engine, K, Map, Motion, Query};

fn main() -> Result<(), mediant::Error> {
    let map = Map::from_fn(64, 64, |x, y| x % 9 == 4 && y % 7 != 3)?;
    let space = map.space(Motion::corners(K::ANY))?;
    let file = std::env::temp_dir().join("mediant-example.idx");
    space.prepare(Engine::Subgoal)?.save(&file)?;

    let mut planner = space.load(&file)?.planner();
    println!("{:?}", planner.find(Query::new((0, 0), (60, 50)))?.cost());
    Ok(())
}
