//! One goal for many agents of a size.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use mediant::{K, Map, Motion};

fn main() -> Result<(), mediant::Error> {
    let map = Map::from_fn(80, 60, |x, y| x == 40 && y > 2)?;
    // A disc of radius 1.5 cells, and where it can go: over eight directions, at most 50 cells far.
    let motion = Motion::centers(K::N8);
    let space = map.for_disc(1.5, motion)?.space(motion)?;
    let field = space.field_within([(2, 30), (70, 40)], 50.0)?;
    for agent in [(10, 10), (60, 50)] {
        println!("{:?} cells, next to {:?}", field.get(agent), field.next(agent));
    }
    Ok(())
}
