//! A robot that keeps off walls: the shortest path takes a narrow door, costs around walls a wide gate.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use mediant::{Error, Inflation, Map, Motion, Path};

fn main() -> Result<(), Error> {
    let map = Map::from_fn(40, 20, |x, y| x == 20 && !(4..7).contains(&y) && y < 12)?;
    // In meters: cells of 5 cm, and a robot of radius 5 cm. Costs reach 40 cm, and fall as in nav2.
    let radii = Inflation { resolution: 0.05, inscribed_radius: 0.05, inflation_radius: 0.4, ..falling() };
    let costs = map.inflated(&radii)?.costs(3.0)?;
    let (start, goal) = ((5, 5), (35, 5));
    let space = map.space(Motion::centers(4))?;
    let by_costs = costs.space(Motion::centers(4))?.path(start, goal)?;
    let widest = space.widest_path(start, goal, 0.5)?.map(|widest| widest.path);
    let paths = [space.path(start, goal)?, widest, by_costs];
    draw(&map, &paths);
    Ok(())
}

fn falling() -> Inflation {
    Inflation { cost_scaling_factor: 3.0, ..Inflation::default() }
}

/// Draws the shortest path as `s`, the widest as `w`, and that by costs as `c`.
fn draw(map: &Map, paths: &[Option<Path>; 3]) {
    let mut rows: Vec<Vec<char>> = map.to_string().lines().map(|row| row.chars().collect()).collect();
    for (path, mark) in paths.iter().zip(['s', 'w', 'c']) {
        for at in path.iter().flat_map(Path::vertices) {
            rows[at.y as usize][at.x as usize] = mark;
        }
    }
    rows.iter().for_each(|row| println!("{}", row.iter().collect::<String>()));
}
