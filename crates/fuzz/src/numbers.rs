//! Numbers of any size: costs, elevations, paces, places in the world, limits.

use mediant::{
    Costs, FiniteK, K, Limits, Map, Motion, Pace, PlacementKind, Point, Query, Rules, Space, WalkingBounds,
};
use mediant_formats::WorldFrame;

use crate::{bytes::Bytes, costmaps};

/// Room for the rounding of costs to integers of 14 digits or more, by each move.
const ROOM: f64 = 1e-3;

/// The first byte chooses what the numbers are.
pub(crate) fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    match bytes.below(5) {
        4 => costmaps::run(&mut bytes),
        0 => costs(&mut bytes),
        1 => walking(&mut bytes),
        2 => world(&mut bytes),
        _ => limits(&mut bytes),
    }
}

/// A small map, its rules for moves over N(k), and a k.
fn motion(bytes: &mut Bytes<'_>) -> (Map, Motion) {
    let (width, height) = (1 + bytes.below(4) as u32, 1 + bytes.below(3) as u32);
    let cells = bytes.word();
    let map = Map::from_fn(width, height, |x, y| cells >> (4 * y + x) & 1 == 1).expect("a small map");
    let rules = Rules::ALL[bytes.below(Rules::ALL.len())];
    // A greater k has tables that take longer than all else.
    let k = FiniteK::new([2, 3, 4, 3, 5, 4, 6, 8][bytes.below(8)]).expect("a k");
    (map, Motion::new(k, rules))
}

/// The cost of each path lies between its length times the least and the greatest cost.
fn costs(bytes: &mut Bytes<'_>) {
    let (map, motion) = motion(bytes);
    let (uniform, side) = (bytes.byte() < 128, (bytes.number(), bytes.number()));
    let first = bytes.number();
    let numbers: Vec<f64> =
        (0..map.width() * map.height()).map(|_| if uniform { first } else { bytes.number() }).collect();
    let Ok(costs) = map.costs(numbers.iter().copied()) else { return };
    are_kept(&costs, &numbers);
    let Ok(costs) = costs.with_cell_size(side.0, side.1) else { return };
    let (least, greatest) = costs.bounds();
    let Ok(space) = costs.space(motion) else { return };
    assert!(costs.unit() > 0.0 && costs.unit().is_finite(), "a unit of {}", costs.unit());
    // Lengths are in cells.
    let (least, greatest) = (least * side.0.min(side.1), greatest * side.0.max(side.1));
    between(&space, |path_cost, length| {
        path_cost >= least * length * (1.0 - ROOM) && path_cost <= greatest * length * (1.0 + ROOM)
    });
}

/// Costs that are integers are kept as they are, others are rounded once.
fn are_kept(costs: &Costs, numbers: &[f64]) {
    let width = costs.map().width() as i32;
    let number =
        |at: usize| costs.cost((at as i32 % width, at as i32 / width)).map(|kept| (kept, numbers[at]));
    let all: Vec<(f64, f64)> = (0..numbers.len()).filter_map(number).collect();
    let greatest = all.iter().map(|&(_, given)| given).fold(0.0, f64::max);
    let are_integers = greatest <= f64::from(u32::MAX) && all.iter().all(|(_, given)| given.fract() == 0.0);
    let room = if are_integers { 0.0 } else { greatest * 0.5_f64.powi(32) };
    for (kept, given) in all {
        assert!((kept - given).abs() <= room, "{given} is kept as {kept}, of up to {greatest}");
    }
}

/// Times are positive, and those to a place and back as fields tell them as well.
fn walking(bytes: &mut Bytes<'_>) {
    let (map, motion) = motion(bytes);
    let pace = match bytes.below(3) {
        0 => Pace::Tobler,
        1 => Pace::Langmuir(mediant::Langmuir {
            a: bytes.number(),
            b: bytes.number(),
            c: bytes.number(),
            d: bytes.number(),
            slope_factor: bytes.number(),
        }),
        _ => Pace::Table((0..bytes.below(5)).map(|_| (bytes.number(), bytes.number())).collect()),
    };
    let (side, with_friction) = ((bytes.number(), bytes.number()), bytes.byte() < 64);
    let ground: Vec<(f64, f64)> = (0..map.width() * map.height())
        .map(|_| (bytes.number(), if with_friction { bytes.number().abs() } else { 0.0 }))
        .collect();
    let of = |x: u32, y: u32| ground[(y * map.width() + x) as usize];
    let Ok(walking) = map.walking_by(side, &pace, Limits::new(), of) else { return };
    assert!(walking.unit() > 0.0 && walking.unit().is_finite(), "a unit of {}", walking.unit());
    let (least, greatest) = walking.bounds();
    assert!(least > 0.0 && greatest >= least && greatest.is_finite());
    let bounds: WalkingBounds = walking.ground_bounds();
    let again = map.walking_in(bounds, side, &pace, Limits::new(), of).expect("the same ground");
    assert_eq!(again.id(), walking.id());
    if let Ok(space) = walking.space(motion) {
        between(&space, |time, length| time > 0.0 || length == 0.0);
    }
}

/// Asks for paths and for a field, and compares them.
pub(crate) fn between(space: &Space, fits: impl Fn(f64, f64) -> bool) {
    let (width, height) = (space.map().width() as i32, space.map().height() as i32);
    let ends = (0..=height).flat_map(|y| (0..=width).map(move |x| (x, y)));
    let Some(start) = ends.clone().find(|&at| space.is_free(at)) else { return };
    let field = space.field([start]).expect("a free source");
    let mut planner = space.planner(space.engine()).expect("an engine that searches here");
    for goal in ends.filter(|&at| space.is_free(at)) {
        let path = planner.path(start, goal).expect("free ends");
        let Some(path) = path else {
            assert_eq!(field.get(goal), None, "{start:?} to {goal:?}");
            continue;
        };
        let (cost, length) = (path.cost(), path.length());
        assert!(cost.is_finite() && fits(cost, length), "{cost} on {length}: {path}");
        let back = field.get(goal).expect("a path leads there");
        if space.costs().is_some() {
            assert!((back - cost).abs() <= ROOM * cost, "{cost} by a path, {back} by a field");
        }
    }
}

/// A place of the map is found again where the world has it.
fn world(bytes: &mut Bytes<'_>) {
    let (resolution, origin) = (bytes.number(), [bytes.number(), bytes.number(), bytes.number()]);
    let (width, height) = (1 + bytes.word() as u32 % 40_000, 1 + bytes.word() as u32 % 40_000);
    let Ok(frame) = WorldFrame::new(resolution, origin, width, height) else { return };
    let (x, y) = (bytes.number(), bytes.number());
    for placement in PlacementKind::ALL {
        for at in [frame.vertex_at(placement, x, y).map(Point::from), frame.place_at(placement, x, y)] {
            let Some(at) = at else { continue };
            let shift = if placement == PlacementKind::Center { 0.5 } else { 0.0 };
            let (column, row) = (at.x() + shift, at.y() + shift);
            assert!(column >= 0.0 && column <= f64::from(width) && row >= 0.0 && row <= f64::from(height));
            // Far from the origin a cell is less than the last digit; and so is a part of the least cells.
            let is_near = |number: f64| number.abs() < 1e6 * resolution;
            if resolution > 1e-300 && is_near(origin[0]) && is_near(origin[1]) && origin[2].abs() < 1e3 {
                let (x, y) = frame.point_of(placement, at);
                if let Some(again) = frame.place_at(placement, x, y) {
                    assert_eq!(again, at, "{frame:?}");
                }
            }
        }
    }
}

/// A limit on the cost lets through what costs no more, and nothing else.
fn limits(bytes: &mut Bytes<'_>) {
    let space = Map::from_rows(["...", ".#.", "..."]).expect("a map").space(Motion::corners(K::ANY));
    let space = space.expect("any angle");
    let mut coordinate = || f64::from(bytes.byte() % 4) + f64::from(bytes.byte()) / 1024.0;
    let (start, goal) = ((coordinate(), coordinate()), (coordinate(), coordinate()));
    let limit = bytes.number();
    let mut planner = space.planner(mediant::Engine::Anya).expect("any angle");
    let Ok(Some(path)) = planner.path(start, goal) else { return };
    for limit in [path.cost(), path.cost() * 0.999_999, limit] {
        let Ok(answer) = planner.find(Query::new(start, goal).within(Limits::new().cost(limit))) else {
            assert!(limit.is_nan() || limit < 0.0, "a limit of {limit}");
            continue;
        };
        // Between the two either answer is right.
        let (is_within, is_beyond) = (path.cost() <= limit, path.cost() * (1.0 - 1e-6) > limit + 1e-9);
        assert!(answer.path().is_some() || !is_within, "{} within {limit}", path.cost());
        assert!(answer.path().is_none() || !is_beyond, "{} within {limit}", path.cost());
    }
}
