//! Many paths on one map: prepared once, searched by eight threads.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use mediant::{K, Map, Motion, Query};

fn main() -> Result<(), mediant::Error> {
    let map = Map::from_fn(512, 512, |x, y| x % 9 == 4 && y % 7 != 3)?;
    let space = map.space(Motion::centers(K::N8))?;
    let index = space.prepare(space.engine())?;
    std::thread::scope(|scope| {
        for row in 0..8 {
            let mut planner = index.planner();
            let query = Query::new((0, row), (500, 400));
            scope.spawn(move || println!("{:?}", planner.find(query).map(|answer| answer.cost())));
        }
    });
    Ok(())
}
