//! The shortest path at any angle, between the corners of cells.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use mediant::{Engine, K, Map, Motion, Query};

fn main() -> Result<(), mediant::Error> {
    let map = Map::from_fn(100, 40, |x, y| x == 50 && y != 39)?;
    let space = map.space(Motion::corners(K::ANY))?;
    let mut planner = space.planner(Engine::Anya)?;
    if let Some(path) = planner.find(Query::new((4, 4), (90.5, 31.25)))?.path() {
        println!("{:.3} cells: {path}", path.cost());
    }
    println!("a straight drive: {}", space.sees((4, 4), (20, 9.5)));
    Ok(())
}
