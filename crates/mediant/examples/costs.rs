//! Cells that cost: the cheapest path, and the cost of every cell.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use mediant::{K, Map, Motion};

fn main() -> Result<(), mediant::Error> {
    let map = Map::from_fn(80, 60, |x, y| x == 40 && y > 50)?;
    // A road of cost 1 through land of cost 4. 'Knight's move' is k = 4: sixteen directions.
    let land = (0..80 * 60).map(|cell| if cell / 80 == 20 { 1 } else { 4 });
    let space = map.costs(land)?.space(Motion::centers(K::N16))?;
    if let Some(path) = space.path((5, 30), (75, 30))? {
        println!("cost {:.2}, length {:.2}: {path}", path.cost(), path.length());
    }
    println!("{:?}", space.field([(5, 30)])?.get((75, 30)));
    Ok(())
}
