//! A path now: three rows of cells, one line for the path.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use mediant::Map;

fn main() -> Result<(), mediant::Error> {
    let map = Map::from_rows(["...#....", ".#.#.##.", ".#...#.."])?;
    match map.path((0, 0), (7, 0))? {
        Some(path) => println!("{:.3} cells: {path}", path.cost()),
        None => println!("no path"),
    }
    Ok(())
}
