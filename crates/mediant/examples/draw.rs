//! Draws a map with three paths into a picture: `cargo run -p mediant --example draw`.
#![allow(clippy::print_stdout, reason = "an example says where the picture is")]

use std::error::Error;

use mediant::{K, Map, Motion};
use mediant_formats::Picture;

fn main() -> Result<(), Box<dyn Error>> {
    let map = Map::from_fn(60, 36, |x, y| (x % 14 == 9 && y % 17 > 4) || (y == 20 && x > 20 && x < 44))?;
    let (start, goal) = ((2, 30), (57, 5));
    let mut picture = Picture::new(map.grid(), mediant::PlacementKind::Corner).start(start).goal(goal);
    for (name, k) in [("k = 2", K::N4), ("k = 3", K::N8), ("any angle", K::ANY)] {
        if let Some(path) = map.space(Motion::corners(k))?.path(start, goal)? {
            let name = format!("{name}: {:.2} cells", path.cost());
            picture = picture.path(name, path.points().map(|at| (at.x(), at.y())));
        }
    }
    let file = std::env::temp_dir().join("mediant-paths.svg");
    picture.write_to(&file)?;
    println!("{}", file.display());
    Ok(())
}
