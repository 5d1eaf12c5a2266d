//! Robots' costmaps from any bytes: inflation by any radii, and costs.

use mediant::{CornerRule, Costmap, Costs, FiniteK, Inflation, Motion, Traversal};

use crate::{bytes::Bytes, numbers::between};

/// Room for the rounding of costs to integers.
const ROOM: f64 = 1e-6;

pub(crate) fn run(bytes: &mut Bytes<'_>) {
    let (width, height) = (1 + bytes.below(7) as u32, 1 + bytes.below(6) as u32);
    let flags = bytes.byte();
    let inflation = inflation(bytes, flags);
    let (weight, cell_size) = (bytes.number(), bytes.number());
    let cells: Vec<u8> = (0..width * height).map(|_| bytes.byte()).collect();
    assert!(Costmap::from_bytes(width, height + 1, cells.clone()).is_err(), "too few bytes");
    let costmap = Costmap::from_bytes(width, height, cells.clone()).expect("a byte for each cell");
    assert_eq!(costmap.bytes(), cells);
    assert_eq!(costmap.flipped().flipped(), costmap);
    let Ok(inflated) = costmap.inflated(&inflation) else {
        return costs_of(&costmap, flags, weight, cell_size);
    };
    for y in 0..height as i32 {
        for x in 0..width as i32 {
            let (before, after) = (costmap.get((x, y)), inflated.get((x, y)));
            let expected = cost_of(&costmap, &inflation, (x, y));
            // An exponential may be rounded otherwise.
            let is_near = expected.iter().zip(&after).all(|(one, other)| one.abs_diff(*other) <= 1);
            assert!(
                is_near,
                "({x}, {y}): {before:?}, then {after:?}, not {expected:?}: {inflation:?} {cells:?}"
            );
        }
    }
    costs_of(&inflated, flags, weight, cell_size);
}

/// Radii and a factor: two in three are such as robots have.
fn inflation(bytes: &mut Bytes<'_>, flags: u8) -> Inflation {
    let inflate_unknown = flags & 1 != 0;
    let inflate_around_unknown = flags & 2 != 0;
    let [resolution, inscribed_radius, beyond, cost_scaling_factor] = if flags % 3 == 0 {
        std::array::from_fn(|_| bytes.number())
    } else {
        let [radius, beyond, factor] = [bytes.byte(), bytes.byte(), bytes.byte()].map(f64::from);
        [0.05, radius / 640.0, beyond / 320.0, factor / 16.0]
    };
    let inflation_radius = inscribed_radius + beyond;
    Inflation {
        resolution,
        inscribed_radius,
        inflation_radius,
        cost_scaling_factor,
        inflate_unknown,
        inflate_around_unknown,
    }
}

/// The byte of a cell after inflation, from the distance to the nearest obstacle.
fn cost_of(costmap: &Costmap, by: &Inflation, (x, y): (i32, i32)) -> Option<u8> {
    let byte = costmap.get((x, y))?;
    let is_obstacle = |byte: u8| byte == 254 || byte == 255 && by.inflate_around_unknown;
    let (width, height) = (costmap.width() as i32, costmap.height() as i32);
    let cells = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let obstacles = cells.filter(|&at| costmap.get(at).is_some_and(is_obstacle));
    let nearest = obstacles.map(|at| (at.0 - x).pow(2) + (at.1 - y).pow(2)).min();
    let reach = (by.inflation_radius / by.resolution).ceil();
    let Some(squared) = nearest.filter(|&squared| reach > 0.0 && f64::from(squared) <= reach * reach) else {
        return Some(byte);
    };
    let distance = f64::from(squared).sqrt() * by.resolution;
    let cost = if squared == 0 {
        254
    } else if distance <= by.inscribed_radius {
        253
    } else {
        (252.0 * (-by.cost_scaling_factor * (distance - by.inscribed_radius)).exp()) as u8
    };
    let least_on_unknown = if by.inflate_unknown { 1 } else { 253 };
    let is_known = byte == 255 && cost >= least_on_unknown;
    Some(if is_known { cost } else { cost.max(byte) })
}

/// Paths over the costs of a costmap cost as its cells do.
fn costs_of(costmap: &Costmap, flags: u8, weight: f64, cell_size: f64) {
    let traversal =
        Traversal { cell_size, unknown: (flags & 4 != 0).then_some(flags), inscribed: flags & 8 != 0 };
    let Ok(costs) = costmap.costs_with(weight, &traversal) else { return };
    for y in 0..costmap.height() as i32 {
        for x in 0..costmap.width() as i32 {
            let is_free = match costmap.get((x, y)) {
                Some(255) => traversal.unknown.is_some(),
                Some(254) => false,
                Some(253) => traversal.inscribed,
                _ => true,
            };
            assert_eq!(costs.map().is_blocked((x, y)), !is_free, "({x}, {y}) of {:?}", costmap.bytes());
        }
    }
    legal(&costs, flags, cell_size);
}

fn legal(costs: &Costs, flags: u8, cell_size: f64) {
    let (least, greatest) = costs.bounds();
    let k = FiniteK::new(2 + u32::from(flags / 64)).expect("a k");
    let rule = CornerRule::ALL[usize::from(flags / 16) % CornerRule::ALL.len()];
    let Ok(space) = costs.space(Motion::new(k, rule)) else { return };
    between(&space, |cost, length| {
        let length = length * cell_size;
        cost >= least * length * (1.0 - ROOM) && cost <= greatest * length * (1.0 + ROOM)
    });
}
