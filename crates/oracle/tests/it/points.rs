//! Points anywhere: the rules of motion and costs, each on a map drawn by hand.

use mediant_grid::{AsciiMap, DiagonalGap, Grid};
use mediant_oracle::{
    PARTS_PER_CELL, Parts, PointFault, PointKind, PointVisibility, Rng, describe_points, is_gap, magnified,
    noise, point_is_free, random_free_point, random_point, segment_between_points_is_legal,
    turn_at_point_is_legal, validate_between_points,
};

pub(crate) const GAPS: [DiagonalGap; 2] = [DiagonalGap::Open, DiagonalGap::Closed];

/// Two blocked cells that meet at (1, 1); the cell to the lower right, the gap's own, is free or blocked.
const OWN_FREE: &str = ".#\n#.";
const OWN_BLOCKED: &str = "#.\n.#";

fn grid(drawing: &str) -> Grid {
    AsciiMap::parse(drawing).expect("a drawing in a test").grid
}

/// A point from cells, which are multiples of 1/1024.
fn at(x: f64, y: f64) -> Parts {
    let parts = [x, y].map(|n| n * PARTS_PER_CELL as f64);
    assert_eq!(parts.map(f64::fract), [0.0; 2], "({x}, {y})");
    (parts[0] as i64, parts[1] as i64)
}

pub(crate) fn is_same(a: Option<f64>, b: Option<f64>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * b,
        (None, None) => true,
        _ => false,
    }
}

/// Checks a segment both ways, under gap rules open and closed.
fn check_segment(drawing: &str, a: Parts, b: Parts, expected: [bool; 2]) {
    let grid = grid(drawing);
    for (gap, expected) in GAPS.into_iter().zip(expected) {
        for (a, b) in [(a, b), (b, a)] {
            let legal = segment_between_points_is_legal(&grid, gap, a, b);
            assert_eq!(legal, expected, "{}", describe_points(&grid, gap, a, b, 0));
        }
    }
}

/// Checks the cost of a query both ways, under gap rules open and closed, and its path.
fn check_cost(drawing: &str, start: Parts, goal: Parts, expected: [Option<f64>; 2]) {
    let grid = grid(drawing);
    for (gap, expected) in GAPS.into_iter().zip(expected) {
        let visibility = PointVisibility::new(&grid, gap);
        for (a, b) in [(start, goal), (goal, start)] {
            let context = describe_points(&grid, gap, a, b, 0);
            let costs = visibility.costs_from(a);
            let found = costs.to(b);
            assert!(is_same(found, expected), "{found:?}, not {expected:?}; {context}");
            assert_eq!(visibility.cost(a, b), found, "{context}");
            let path = costs.path_to(b);
            assert_eq!(path.is_some(), found.is_some(), "{context}");
            if let Some((path, cost)) = path.zip(found) {
                let outcome = validate_between_points(&grid, gap, a, b, &path, cost);
                assert_eq!(outcome, Ok(()), "{path:?}; {context}");
            }
        }
    }
}

#[test]
fn a_point_is_free_if_it_touches_a_free_cell() {
    let grid = grid("##.\n##.\n...");
    let check = |x, y, expected| assert_eq!(point_is_free(&grid, at(x, y)), expected, "({x}, {y})");
    let part = 1.0 / 1024.0;
    // Inside cells.
    check(0.5, 0.5, false);
    check(2.5, 0.5, true);
    check(2.0 - part, 0.5, false);
    check(2.0 + part, 0.5, true);
    // On edges: between two blocked cells, between a blocked and a free one, on the border of either.
    check(1.0, 0.5, false);
    check(0.5, 1.0, false);
    check(2.0, 0.5, true);
    check(0.5, 2.0, true);
    check(0.5, 0.0, false);
    check(2.5, 0.0, true);
    check(3.0, 0.5, true);
    check(0.0, 0.5, false);
    check(0.0, 2.5, true);
    // On corners of cells, and beside them.
    check(1.0, 1.0, false);
    check(2.0, 2.0, true);
    check(2.0 - part, 2.0, true);
    check(2.0 - part, 2.0 - part, false);
    check(2.0, 1.0, true);
    check(2.0, 0.0, true);
    check(2.0 - part, 0.0, false);
    check(0.0, 0.0, false);
    check(3.0, 3.0, true);
    // Outside.
    check(3.0 + part, 2.5, false);
    check(2.5, -part, false);
    check(-part, 2.5, false);
    for far in [(i64::MIN, i64::MAX), (i64::MAX, 512), (2560, i64::MIN), (1 << 45, 1 << 45)] {
        assert!(!point_is_free(&grid, far), "{far:?}");
        for gap in GAPS {
            assert!(!segment_between_points_is_legal(&grid, gap, far, at(2.5, 0.5)), "{far:?}");
            assert!(!segment_between_points_is_legal(&grid, gap, at(2.5, 0.5), far), "{far:?}");
        }
        assert!(turn_at_point_is_legal(&grid, Some(far), at(2.0, 1.0), Some(far)), "{far:?}");
    }
}

#[test]
fn segments_keep_out_of_open_interiors() {
    let part = 1.0 / 1024.0;
    check_segment(".#.\n...", at(0.5, 0.5), at(2.5, 0.5), [false; 2]);
    check_segment(".#.\n...", at(0.5, 0.5), at(0.5, 1.5), [true; 2]);
    // To the corner of the blocked cell, past it at a point, and 1/1024 too high or low.
    check_segment(".#.\n...", at(0.5, 0.5), at(1.0, 1.0), [true; 2]);
    check_segment(".#.\n...", at(0.5, 0.5), at(1.5, 1.5), [true; 2]);
    check_segment(".#.\n...", at(0.5, 0.5 - part), at(1.5, 1.5 - part), [false; 2]);
    check_segment(".#.\n...", at(0.5, 0.5), at(1.5, 1.5 - part), [false; 2]);
    check_segment(".#.\n...", at(0.5, 0.5 + part), at(1.5, 1.5), [true; 2]);
    // From a blocked cell's edge to another of its edges is through its inside; along its edge is not.
    check_segment("...\n.#.\n...", at(1.0, 1.5), at(2.0, 1.25), [false; 2]);
    check_segment("...\n.#.\n...", at(1.0, 1.5), at(1.5, 1.0), [false; 2]);
    check_segment("...\n.#.\n...", at(1.0, 1.25), at(1.0, 1.75), [true; 2]);
    check_segment("...\n.#.\n...", at(1.0, 1.5), at(0.25, 1.625), [true; 2]);
    check_segment("...\n.#.\n...", at(1.0, 1.5), at(1.0, 3.0), [true; 2]);
    check_segment("...\n.#.\n...", at(1.0, 1.5), at(1.0 + part, 3.0), [false; 2]);
    // Inside one cell, and with ends that are not free.
    check_segment("#.", at(1.125, 0.0), at(2.0, 0.875), [true; 2]);
    check_segment("#.", at(1.0 - part, 0.5), at(1.5, 0.5), [false; 2]);
    check_segment("#.", at(0.5, 0.5), at(0.5, 0.5), [false; 2]);
    check_segment("#.", at(1.0, 0.5), at(1.0, 0.5), [true; 2]);
    check_segment(".", at(0.5, 0.5), at(0.5, -part), [false; 2]);
}

#[test]
fn edges_between_two_blocked_cells_are_closed() {
    let part = 1.0 / 1024.0;
    let wall = "...\n##.\n##.\n...";
    // Up to the edge, and 1/1024 along it.
    check_segment(wall, at(1.0, 0.5), at(1.0, 1.0), [true; 2]);
    check_segment(wall, at(1.0, 0.5), at(1.0, 1.0 + part), [false; 2]);
    check_segment(wall, at(1.0, 0.5), at(1.0, 3.0), [false; 2]);
    check_segment(wall, at(2.5, 2.0), at(2.0, 2.0), [true; 2]);
    check_segment(wall, at(2.5, 2.0), at(2.0 - part, 2.0), [false; 2]);
    check_segment(wall, at(2.5, 2.0), at(0.0, 2.0), [false; 2]);
    // Along the sides of the wall, and of the map; the border of a blocked cell is closed.
    check_segment(wall, at(0.0, 1.0), at(2.5, 1.0), [true; 2]);
    check_segment(wall, at(2.0, 0.25), at(2.0, 3.75), [true; 2]);
    check_segment(wall, at(3.0, 0.25), at(3.0, 3.75), [true; 2]);
    check_segment(wall, at(0.0, 0.25), at(0.0, 1.0), [true; 2]);
    check_segment(wall, at(0.0, 0.25), at(0.0, 3.75), [false; 2]);
    check_segment(".#.", at(0.5, 0.0), at(2.5, 0.0), [false; 2]);
    check_segment(".#.", at(0.5, 1.0), at(1.0, 1.0), [true; 2]);
    check_segment(".#.", at(0.5, 1.0), at(1.0 + part, 1.0), [false; 2]);
}

#[test]
fn segments_through_gaps() {
    let part = 1.0 / 1024.0;
    // Through the gap at any angle, and along either grid line.
    check_segment(OWN_BLOCKED, at(1.5, 0.5), at(0.5, 1.5), [true, false]);
    check_segment(OWN_BLOCKED, at(1.25, 0.5), at(0.5, 2.0), [true, false]);
    check_segment(OWN_BLOCKED, at(0.5, 1.0), at(1.5, 1.0), [true, false]);
    check_segment(OWN_BLOCKED, at(1.0, 0.25), at(1.0, 1.0 + part), [true, false]);
    check_segment(OWN_FREE, at(0.5, 0.5), at(1.5, 1.5), [true, false]);
    // 1/1024 beside it there is no way.
    check_segment(OWN_FREE, at(0.5, 0.5 + part), at(1.5, 1.5 + part), [false; 2]);
    check_segment(OWN_FREE, at(0.5, 1.0 - part), at(1.5, 1.0 - part), [false; 2]);
    // A segment that ends there is legal by itself.
    check_segment(OWN_FREE, at(0.5, 0.5), at(1.0, 1.0), [true; 2]);
    check_segment(OWN_BLOCKED, at(0.5, 1.0), at(1.0, 1.0), [true; 2]);
    // With a third cell freed it is no gap.
    check_segment("..\n.#", at(1.5, 0.5), at(0.5, 1.5), [true; 2]);
}

/// Across the largest map, through a gap in its middle, and past it by half of 1/1024.
#[test]
fn segments_across_the_largest_map() {
    let side = Grid::MAX_SIDE;
    let middle = side / 2;
    let grid = Grid::from_fn(side, 2, |x, y| (x, y) == (middle, 0) || (x, y) == (middle - 1, 1));
    let grid = grid.expect("a valid size");
    let corner = (i64::from(side) * PARTS_PER_CELL, 2 * PARTS_PER_CELL);
    for (goal, expected) in [(corner, [true, false]), ((corner.0, corner.1 - 1), [false; 2])] {
        for (a, b) in [((0, 0), goal), (goal, (0, 0))] {
            let found = GAPS.map(|gap| segment_between_points_is_legal(&grid, gap, a, b));
            assert_eq!(found, expected, "from {a:?} to {b:?}");
        }
    }
}

#[test]
fn turns_at_gaps() {
    let check = |drawing: &str, before: Option<Parts>, place: Parts, after: Option<Parts>, expected: bool| {
        let grid = grid(drawing);
        for (a, b) in [(before, after), (after, before)] {
            let found = turn_at_point_is_legal(&grid, a, place, b);
            assert_eq!(found, expected, "{a:?} → {place:?} → {b:?}\n{drawing}");
        }
    };
    let gap = at(1.0, 1.0);
    let (upper_left, lower_right) = (Some(at(0.5, 0.75)), Some(at(1.25, 1.5)));
    let (left, right, down) = (Some(at(0.5, 1.0)), Some(at(1.25, 1.0)), Some(at(1.0, 1.25)));
    check(OWN_FREE, upper_left, gap, lower_right, false);
    check(OWN_FREE, left, gap, upper_left, true);
    check(OWN_FREE, left, gap, down, false);
    check(OWN_FREE, right, gap, down, true);
    check(OWN_FREE, None, gap, lower_right, true);
    check(OWN_FREE, None, gap, right, true);
    check(OWN_FREE, None, gap, upper_left, false);
    check(OWN_FREE, None, gap, left, false);
    check(OWN_FREE, None, gap, None, true);
    check(OWN_BLOCKED, left, gap, down, true);
    check(OWN_BLOCKED, None, gap, left, false);
    check(OWN_BLOCKED, None, gap, right, false);
    check(OWN_BLOCKED, None, gap, None, true);
    // Not exactly on it there is no rule, nor at a vertex that is no gap.
    for beside in [(1023, 1024), (1024, 1025), (1025, 1025)] {
        check(OWN_FREE, None, beside, upper_left, true);
        check(OWN_FREE, lower_right, beside, upper_left, true);
    }
    check("..\n#.", None, gap, upper_left, true);
}

#[test]
fn known_costs() {
    let root = |n: f64| n.sqrt();
    let part = 1.0 / 1024.0;
    // Between centers, past one obstacle.
    check_cost(".#.\n...", at(0.5, 0.5), at(2.5, 0.5), [Some(1.0 + root(2.0)); 2]);
    check_cost(".#.\n...", at(0.5, 0.5), at(2.5, 1.5), [Some(root(0.5) + root(2.5)); 2]);
    check_cost(".#.\n...", at(0.5, 0.5), at(0.5, 0.5), [Some(0.0); 2]);
    check_cost(".#.\n...", at(0.5, 0.5), at(1.5, 1.5), [Some(root(2.0)); 2]);
    // From one edge of the obstacle to the opposite one, to the next one, and along one.
    check_cost(".#.\n...", at(1.0, 0.5), at(2.0, 0.5), [Some(2.0); 2]);
    check_cost(".#.\n...", at(1.0, 0.5), at(1.5, 1.0), [Some(1.0); 2]);
    check_cost(".#.\n...", at(1.25, 1.0), at(1.75, 1.0), [Some(0.5); 2]);
    check_cost(".#.\n...", at(1.0, 1.0), at(2.0, 1.0), [Some(1.0); 2]);
    // 1/1024 beside a corner of it: around it, as straight as can be.
    check_cost(".#.\n...", at(1.0, 1.0 - part), at(1.0 + part, 1.0), [Some(2.0 * part); 2]);
    check_cost(".#.\n...", at(1.0 - part, 1.0), at(1.0, 1.0 - part), [Some(root(2.0) * part); 2]);
    check_cost(
        ".#.\n...",
        at(1.0 - part, 1.0 - part),
        at(1.0 + part, 1.0 + part),
        [Some(root(8.0) * part); 2],
    );
    // No way, and ends that are not free.
    check_cost(".#.", at(0.5, 0.0), at(2.5, 0.0), [None; 2]);
    check_cost("...\n###\n...", at(0.5, 1.0), at(0.5, 2.0), [None; 2]);
    check_cost(".#.\n...", at(0.5, 0.5), at(1.5, 0.5), [None; 2]);
    check_cost(".#.\n...", at(1.5, 0.0), at(1.5, 0.0), [None; 2]);
    check_cost(".#.\n...", at(0.5, 0.5), at(0.5, -part), [None; 2]);
    check_cost(".#.\n...", at(0.5, 0.5), (i64::MAX, i64::MIN), [None; 2]);
    check_cost("#", at(0.5, 0.5), at(0.5, 0.5), [None; 2]);
}

#[test]
fn known_costs_at_gaps() {
    let root = |n: f64| n.sqrt();
    let part = 1.0 / 1024.0;
    // Straight through, bent at the gap, and around where there is a way around.
    check_cost(OWN_BLOCKED, at(1.5, 0.5), at(0.5, 1.5), [Some(root(2.0)), None]);
    check_cost(OWN_BLOCKED, at(1.5, 1.0), at(1.0, 1.5), [Some(1.0), None]);
    check_cost(OWN_BLOCKED, at(1.5, 0.25), at(0.5, 1.5), [Some(root(0.8125) + root(0.5)), None]);
    let around = root(0.5) + 2.0 + root(0.5);
    check_cost("...\n.#.\n..#\n...", at(1.5, 2.5), at(2.5, 1.5), [Some(root(2.0)), Some(around)]);
    check_cost(".#.\n#..\n...", at(0.5, 0.5), at(1.5, 1.5), [Some(root(2.0)), None]);
    // An end exactly at the gap is left through its own cell or not at all.
    check_cost(OWN_FREE, at(1.0, 1.0), at(1.5, 1.5), [Some(root(0.5)); 2]);
    check_cost(OWN_FREE, at(1.0, 1.0), at(1.5, 1.0), [Some(0.5); 2]);
    check_cost(OWN_FREE, at(1.0, 1.0), at(0.5, 0.5), [Some(root(0.5)), None]);
    check_cost(OWN_FREE, at(1.0, 1.0), at(0.5, 1.0), [Some(0.5), None]);
    check_cost(OWN_FREE, at(1.0, 1.0), at(1.0, 1.0), [Some(0.0); 2]);
    check_cost(OWN_BLOCKED, at(1.0, 1.0), at(0.5, 1.5), [Some(root(0.5)), None]);
    check_cost(OWN_BLOCKED, at(1.0, 1.0), at(1.0, 1.0), [Some(0.0); 2]);
    // 1/1024 beside it each free quadrant has its own points, and no rule.
    check_cost(OWN_BLOCKED, at(1.0 - part, 1.0), at(0.5, 1.0), [Some(0.5 - part); 2]);
    check_cost(OWN_BLOCKED, at(1.0 - part, 1.0), at(1.5, 1.0), [Some(0.5 + part), None]);
    check_cost(OWN_BLOCKED, at(1.0, 1.0 + part), at(1.0, 1.0 - part), [Some(2.0 * part), None]);
    check_cost(OWN_BLOCKED, at(1.0, 1.0 - part), at(1.0 + part, 1.0), [Some(root(2.0) * part); 2]);
}

/// All faults, each on a path that is right but for that.
#[test]
fn faults_of_paths() {
    let grid = grid(".#.\n...");
    let (start, goal) = (at(0.5, 0.5), at(2.5, 0.5));
    let corners = [at(1.0, 1.0), at(2.0, 1.0)];
    let cost = 1.0 + 2.0_f64.sqrt();
    let check = |path: &[Parts], cost: f64, expected: Result<(), PointFault>| {
        for gap in GAPS {
            let found = validate_between_points(&grid, gap, start, goal, path, cost);
            assert_eq!(found, expected, "{path:?}");
        }
    };
    check(&[start, corners[0], corners[1], goal], cost, Ok(()));
    check(&[start, at(1.5, 1.5), goal], 8.0_f64.sqrt(), Ok(()));
    check(&[], 0.0, Err(PointFault::Start));
    check(&[corners[0], corners[1], goal], cost, Err(PointFault::Start));
    check(&[start, corners[0], corners[1]], cost, Err(PointFault::Goal));
    check(&[start, at(1.5, 0.5), goal], 2.0, Err(PointFault::NotFree(1)));
    check(&[start, corners[0], corners[0], corners[1], goal], cost, Err(PointFault::Still(2)));
    check(&[start, goal], 2.0, Err(PointFault::Segment(1)));
    check(&[start, corners[0], at(2.0, 0.5), goal], cost, Err(PointFault::Segment(2)));
    for stated in [cost + 1e-6, cost - 1e-6, f64::NAN, f64::INFINITY] {
        let path = [start, corners[0], corners[1], goal];
        let found = validate_between_points(&grid, DiagonalGap::Open, start, goal, &path, stated);
        assert!(matches!(found, Err(PointFault::Cost { .. })), "{found:?} for {stated}");
    }
    let still = |path: &[Parts]| validate_between_points(&grid, DiagonalGap::Closed, start, start, path, 0.0);
    assert_eq!(still(&[start]), Ok(()));
    assert_eq!(still(&[start, corners[0], start]), Err(PointFault::Detour(3)));
}

#[test]
fn faults_at_gaps() {
    let grid = grid(OWN_BLOCKED);
    let (gap, up, down) = (at(1.0, 1.0), at(1.0, 0.5), at(0.5, 1.0));
    let check = |path: &[Parts], cost: f64, expected: [Result<(), PointFault>; 2]| {
        for (rule, expected) in GAPS.into_iter().zip(expected) {
            let (start, goal) = (path[0], path[path.len() - 1]);
            assert_eq!(validate_between_points(&grid, rule, start, goal, path, cost), expected, "{path:?}");
        }
    };
    check(&[up, gap, down], 1.0, [Ok(()), Err(PointFault::Turn(1))]);
    check(&[gap, down], 0.5, [Ok(()), Err(PointFault::Turn(0))]);
    check(&[up, gap], 0.5, [Ok(()), Err(PointFault::Turn(1))]);
    check(&[up, gap, at(1.5, 1.0)], 1.0, [Ok(()); 2]);
    check(&[gap], 0.0, [Ok(()); 2]);
    check(&[up, at(1.0, 1.5)], 1.0, [Ok(()), Err(PointFault::Segment(1))]);
}

/// Each kind of point is where it should be, both free and blocked if it can be.
#[test]
fn points_of_all_kinds() {
    let rng = &mut Rng::new(3);
    let grid = noise(rng, 9, 7, 45);
    let line = |n: i64| n.rem_euclid(PARTS_PER_CELL);
    let nearest = |n: i64| (n + PARTS_PER_CELL / 2).div_euclid(PARTS_PER_CELL);
    let is_beside = |n: i64| line(n) == 1 || line(n) == PARTS_PER_CELL - 1;
    for kind in PointKind::ALL {
        let (mut free, mut blocked) = (0, 0);
        for _ in 0..400 {
            let (x, y) = random_point(rng, &grid, kind);
            let vertex = ((nearest(x) as i32), (nearest(y) as i32)).into();
            let near = [x, y].iter().all(|&n| line(n) == 0 || is_beside(n));
            let is_right = match kind {
                PointKind::Anywhere => (0..=9216).contains(&x) && (0..=7168).contains(&y),
                PointKind::Center => line(x) == 512 && line(y) == 512,
                PointKind::OnColumn => line(x) == 0,
                PointKind::OnRow => line(y) == 0,
                PointKind::BesideLine => is_beside(x) || is_beside(y),
                PointKind::Vertex => line(x) == 0 && line(y) == 0,
                PointKind::BesideVertex => near && (is_beside(x) || is_beside(y)),
                PointKind::Gap => line(x) == 0 && line(y) == 0 && is_gap(&grid, vertex),
                PointKind::BesideGap => near && (is_beside(x) || is_beside(y)) && is_gap(&grid, vertex),
                _ => false,
            };
            assert!(is_right, "{kind:?}: ({x}, {y})");
            *if point_is_free(&grid, (x, y)) { &mut free } else { &mut blocked } += 1;
        }
        let is_free = kind == PointKind::Gap;
        assert!(free > 100 && (is_free || blocked > 20), "{kind:?}: {free} free, {blocked} blocked");
    }
}

#[test]
fn free_points_are_free() {
    let rng = &mut Rng::new(4);
    assert_eq!(random_free_point(rng, &grid("##\n##")), None);
    for drawing in [".", "#.#\n###\n###", "#.\n.#", ".#..#\n#....\n.##.#"] {
        let grid = grid(drawing);
        let points: Vec<_> = (0..200).filter_map(|_| random_free_point(rng, &grid)).collect();
        assert_eq!(points.len(), 200, "{drawing}");
        assert!(points.iter().all(|&at| point_is_free(&grid, at)), "{drawing}");
        let vertices = points.iter().filter(|at| at.0 % 1024 == 0 && at.1 % 1024 == 0).count();
        assert!((20..100).contains(&vertices), "{vertices} vertices; {drawing}");
    }
}

#[test]
fn magnified_maps() {
    for (times, expected) in [(1, ".#\n##\n.."), (2, "..##\n..##\n####\n####\n....\n....")] {
        let (found, expected) = (magnified(&grid(".#\n##\n.."), times), grid(expected));
        assert_eq!((found.width(), found.height()), (expected.width(), expected.height()));
        let cells =
            (0..expected.height() as i32).flat_map(|y| (0..expected.width() as i32).map(move |x| (x, y)));
        for (x, y) in cells {
            assert_eq!(found.is_blocked(x, y), expected.is_blocked(x, y), "({x}, {y}), {times} times");
        }
    }
}
