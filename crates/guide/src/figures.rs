//! The figures of the guide.

use mediant::{CornerRule, Error, FiniteK, K, Map, Motion, Path};
use mediant_report::{GridDrawing, NeighborhoodDrawing};

/// All figures: the name of each file, and its SVG. The same on every machine.
///
/// # Errors
/// None that a change of the figures did not bring.
pub fn all() -> Result<Vec<(&'static str, String)>, Error> {
    Ok(vec![
        ("moves.svg", moves()?),
        ("reach.svg", reach()?),
        ("paths.svg", paths()?),
        ("between-centers.svg", between_centers()?),
        ("between-corners.svg", between_corners()?),
        ("corner-rules.svg", corner_rules()?),
    ])
}

fn ks(of: std::ops::RangeInclusive<u32>) -> Result<Vec<FiniteK>, Error> {
    Ok(of.map(FiniteK::new).collect::<Result<_, _>>()?)
}

fn moves() -> Result<String, Error> {
    let note = "In color the moves that each k adds: between every two neighbors their sum.";
    Ok(NeighborhoodDrawing::moves("The moves of N(k)", ks(2..=6)?)?.note(note).svg())
}

fn reach() -> Result<String, Error> {
    let note = "On an empty map. The dashed circle is what a straight line of that length reaches.";
    Ok(NeighborhoodDrawing::reach("What a path of one length reaches", ks(2..=5)?)?.note(note).svg())
}

/// The points of a path in cells of the map: centers lie half a cell inside.
fn points(path: &Path, motion: Motion) -> Vec<(f64, f64)> {
    let shift = if motion.rules.placement() == mediant::PlacementKind::Center { 0.5 } else { 0.0 };
    path.points().map(|at| (at.x() + shift, at.y() + shift)).collect()
}

/// Adds the shortest path under each motion to a drawing, with its length.
fn with_paths<'n>(
    drawing: GridDrawing,
    map: &Map,
    (start, goal): ((i32, i32), (i32, i32)),
    motions: impl IntoIterator<Item = (&'n str, Motion)>,
) -> Result<GridDrawing, Error> {
    motions.into_iter().try_fold(drawing, |drawing, (name, motion)| {
        let path = map.space(motion)?.path(start, goal)?;
        Ok(match path {
            Some(path) => drawing.path(format!("{name}: {:.2} cells", path.cost()), points(&path, motion)),
            None => drawing,
        })
    })
}

fn paths() -> Result<String, Error> {
    let map = Map::from_rows([
        "..............................",
        "..............................",
        "........###...................",
        "........####..................",
        ".........###..........##......",
        "......................###.....",
        "...............##.....###.....",
        "..............####............",
        "..............###.............",
        "..............................",
        "....###.......................",
        "....####................###...",
        ".....##.......##........####..",
        "..............###........##...",
        "...............##.............",
        "..............................",
    ])?;
    let named = [("k = 2", K::N4), ("k = 3", K::N8), ("k = 4", K::N16), ("any angle", K::ANY)];
    let motions = named.map(|(name, k)| (name, Motion::corners(k)));
    let drawing = GridDrawing::new("One map, four neighborhoods", map.grid());
    Ok(with_paths(drawing, &map, ((2, 2), (28, 14)), motions)?.in_turn().svg())
}

/// The map of the two placements.
fn few_blocks() -> Result<Map, Error> {
    Map::from_rows(["........", "...##...", "...##...", "........", "........"])
}

fn between_centers() -> Result<String, Error> {
    let map = few_blocks()?;
    let drawing = GridDrawing::new("Centers: from the middle of a cell to that of another", map.grid());
    let motions = [("k = 3", Motion::centers(K::N8)), ("k = 4", Motion::centers(K::N16))];
    Ok(with_paths(drawing, &map, ((1, 1), (6, 2)), motions)?.svg())
}

fn between_corners() -> Result<String, Error> {
    let map = few_blocks()?;
    let drawing = GridDrawing::new("Corners: from corner to corner, along obstacles, too", map.grid());
    let motions = [("k = 3", Motion::corners(K::N8)), ("any angle", Motion::corners(K::ANY))];
    Ok(with_paths(drawing, &map, ((1, 1), (8, 4)), motions)?.svg())
}

fn corner_rules() -> Result<String, Error> {
    let map = Map::from_rows([".......", "..#....", "...#...", ".......", "......."])?;
    let drawing = GridDrawing::new("Three rules for the corners of obstacles", map.grid());
    let rules = [("never", CornerRule::Never), ("one", CornerRule::One), ("always", CornerRule::Always)];
    let motions = rules.map(|(name, rule)| (name, Motion::new(K::N8, rule)));
    Ok(with_paths(drawing, &map, ((1, 3), (4, 0)), motions)?.svg())
}
