//! Drawings of paths that a reader can check by eye, across k, placements and rules.
//!
//! Waypoints are 0, 1, 2, … in order. Under corner placement vertices are at even rows and columns of the
//! drawing, cells at odd ones.

use std::sync::Arc;

use mediant::{Engine, Map, Motion, Setup};
use mediant_grid::{AsciiMap, CornerRule, DiagonalGap, Rules, draw};
use mediant_moves::{FiniteK, K};
use mediant_search::{Answer, Ends, Smoothing};

/// The picture of the best path from `s` to `g`, under its cost.
fn picture(drawing: &str, rules: Rules, k: u32) -> String {
    picture_by(Engine::AStar, drawing, rules, k, None)
}

/// The same, by any engine, and smoothed.
fn picture_by(engine: Engine, drawing: &str, rules: Rules, k: u32, smoothing: Option<Smoothing>) -> String {
    let map = AsciiMap::parse(drawing).expect("the drawing is a map");
    let query = Ends::new(map.mark('s').expect("s is drawn"), map.mark('g').expect("g is drawn"));
    let k = if engine == Engine::Anya { K::Any } else { FiniteK::new(k).expect("k is at least 2").into() };
    let setup = Setup { smoothing, ..Setup::new(engine, Motion::new(k, rules)) };
    let grid = Arc::new(map.grid);
    let mut planner = setup.planner(&Map::from(Arc::clone(&grid))).expect("the engine takes this");
    match planner.find(query).expect("both ends are free") {
        Answer::Found(path) => {
            format!(
                "k = {k}, {rules}: {:.4}\n{}",
                path.cost(),
                draw(&grid, rules.placement(), path.waypoints())
            )
        }
        _ => format!("k = {k}, {rules}: unreachable\n"),
    }
}

const WALL: &str = "
    ...........
    s....#.....
    .....#.....
    .....#...g.
    .....#.....
    ...........
";

const SLALOM: &str = "
    s...#.......
    ....#...#...
    ....#...#...
    ........#...
    ....#...#...
    ....#...#..g
";

const GAP: &str = "
    s..#...
    ...#...
    ...#...
    ###....
    .......
    ......g
";

const NEVER: Rules = Rules::Center(CornerRule::Never);
const OPEN: Rules = Rules::Corner(DiagonalGap::Open);
const CLOSED: Rules = Rules::Corner(DiagonalGap::Closed);

macro_rules! pictures {
    ($($name:ident: $map:expr, $rules:expr, $k:expr;)+) => {
        $(#[test]
        fn $name() {
            insta::assert_snapshot!(picture($map, $rules, $k));
        })+
    };
}

pictures! {
    wall_center_k2: WALL, NEVER, 2;
    wall_center_k3: WALL, NEVER, 3;
    wall_center_k4: WALL, NEVER, 4;
    wall_center_k6: WALL, NEVER, 6;
    wall_center_k3_one: WALL, Rules::Center(CornerRule::One), 3;
    wall_center_k3_always: WALL, Rules::Center(CornerRule::Always), 3;
    wall_corner_k2: WALL, OPEN, 2;
    wall_corner_k3: WALL, OPEN, 3;
    wall_corner_k5: WALL, OPEN, 5;
    wall_corner_k8: WALL, OPEN, 8;
    slalom_center_k5: SLALOM, NEVER, 5;
    slalom_corner_k4: SLALOM, OPEN, 4;
    slalom_corner_k7: SLALOM, OPEN, 7;
    gap_center_never: GAP, NEVER, 3;
    gap_center_always: GAP, Rules::Center(CornerRule::Always), 3;
    gap_corner_open: GAP, OPEN, 4;
    gap_corner_closed: GAP, CLOSED, 4;
}

/// Of the paths of one cost, jump point search finds the canonical one: odd moves first, other turns only
/// where an obstacle forces them.
#[test]
fn slalom_center_k4_canonical() {
    let [a_star, jumps] =
        [Engine::AStar, Engine::Jps].map(|engine| picture_by(engine, SLALOM, NEVER, 4, None));
    insta::assert_snapshot!(format!("A*, {a_star}\nJPS, {jumps}"));
}

/// At any angle: the optimal path, the one that Theta* finds, and smoothed ones.
#[test]
fn slalom_any_angle() {
    let by = |engine, smoothing| picture_by(engine, SLALOM, OPEN, 3, smoothing);
    let anya = by(Engine::Anya, None);
    let theta = by(Engine::Theta, None);
    let linear = by(Engine::AStar, Some(Smoothing::Linear));
    let taut = by(Engine::AStar, Some(Smoothing::Taut));
    insta::assert_snapshot!(format!(
        "Anya, {anya}\nTheta*, {theta}\nA*, smoothed, {linear}\nA*, pulled taut, {taut}"
    ));
}

#[test]
fn gap_any_angle() {
    let [open, closed] = [OPEN, CLOSED].map(|rules| picture_by(Engine::Anya, GAP, rules, 0, None));
    insta::assert_snapshot!(format!("{open}\n{closed}"));
}

/// A road `_` costs 1, grass `,` 3, water `~` 9.
const TERRAIN: [&str; 8] = [
    ",,,,,,~~,,,,",
    ",,,,,,~~,,,,",
    ",___,,~~,,,,",
    ",_#_,,~~,__,",
    ",_#_________",
    ",_#,,,~~,,,_",
    ",,,,,~~~,,,_",
    ",,,,~~~,,,,_",
];

/// The picture of the cheapest path between two vertices, in the ground that it crosses.
fn picture_of_costs(engine: Engine, rules: Rules, k: u32, ends: Ends) -> String {
    let sign = |x: u32, y: u32| TERRAIN[y as usize].as_bytes()[x as usize];
    let map = Map::from_fn(12, 8, |x, y| sign(x, y) == b'#').expect("a map");
    let cost = |sign: u8| match sign {
        b'_' => 1.0,
        b',' => 3.0,
        _ => 9.0,
    };
    let costs = map.costs(TERRAIN.iter().flat_map(|row| row.bytes()).map(cost)).expect("costs");
    let space = costs.space(Motion::new(FiniteK::new(k).expect("a k"), rules)).expect("a small k");
    let mut planner = space.planner(engine).expect("it knows costs");
    let path = planner.find(ends).expect("both ends are free").into_path().expect("there is a way");
    let drawing = draw(map.grid(), rules.placement(), path.waypoints());
    let (scale, origin) =
        if rules.placement() == mediant_grid::PlacementKind::Center { (1, 0) } else { (2, 1) };
    let columns = (scale * 12 + origin) as usize;
    let padded = |line: &str| line.chars().chain(std::iter::repeat(' ')).take(columns).collect();
    let mut lines: Vec<Vec<char>> = drawing.lines().map(padded).collect();
    for y in 0..8 {
        for x in 0..12 {
            let at = &mut lines[(scale * y + origin) as usize][(scale * x + origin) as usize];
            if [' ', '.'].contains(at) {
                *at = char::from(sign(x, y));
            }
        }
    }
    let lines: Vec<String> =
        lines.iter().map(|line| line.iter().collect::<String>().trim_end().to_owned()).collect();
    format!("k = {k}, {rules}: costs {:.4}, {:.4} long\n{}\n", path.cost(), path.length(), lines.join("\n"))
}

/// Over the road and its bridge, and the shortcuts that more directions find.
#[test]
fn terrain_center() {
    let ends = Ends::new((1, 6), (11, 0));
    let pictures = [2, 3, 4, 5, 8].map(|k| picture_of_costs(Engine::AStar, NEVER, k, ends));
    insta::assert_snapshot!(pictures.join("\n"));
}

/// Along grid lines a path costs the cheaper of the two cells beside it.
#[test]
fn terrain_corner() {
    let ends = Ends::new((1, 7), (12, 0));
    let pictures =
        [(OPEN, 2), (OPEN, 3), (CLOSED, 5)].map(|(rules, k)| picture_of_costs(Engine::AStar, rules, k, ends));
    insta::assert_snapshot!(pictures.join("\n"));
}
