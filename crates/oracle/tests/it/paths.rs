//! The validator: what it accepts, and each fault with the place that its message names.

use mediant_grid::{AsciiMap, CornerRule, DiagonalGap, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_oracle::{Fault, validate};

const NEVER: Rules = Rules::Center(CornerRule::Never);
const OPEN: Rules = Rules::Corner(DiagonalGap::Open);
const CLOSED: Rules = Rules::Corner(DiagonalGap::Closed);

/// Validates a path from its first waypoint to its last.
fn outcome(drawing: &str, rules: Rules, k: Option<u32>, path: &[(i32, i32)], cost: f64) -> Result<(), Fault> {
    let path: Vec<Vertex> = path.iter().map(|&at| at.into()).collect();
    let k = k.map(|k| FiniteK::new(k).expect("k in a test"));
    let grid = AsciiMap::parse(drawing).expect("a drawing in a test").grid;
    validate(&grid, rules, k, path[0], path[path.len() - 1], &path, cost)
}

#[track_caller]
fn check_fault(outcome: Result<(), Fault>, message: &str) {
    assert_eq!(outcome.expect_err(message).to_string(), message);
}

#[test]
fn accepts_what_is_right() {
    let root = f64::sqrt;
    let map = "....\n.#..\n....";
    assert_eq!(outcome(map, NEVER, Some(3), &[(0, 0), (2, 0), (3, 1)], 2.0 + root(2.0)), Ok(()));
    assert_eq!(outcome(map, NEVER, Some(4), &[(0, 0), (1, 0), (3, 1)], 1.0 + root(5.0)), Ok(()));
    // One waypoint a repetition is as good as one a run.
    assert_eq!(outcome(map, NEVER, Some(2), &[(0, 0), (1, 0), (2, 0), (3, 0)], 3.0), Ok(()));
    assert_eq!(outcome("...\n...", NEVER, None, &[(0, 0), (2, 1)], root(5.0)), Ok(()));
    assert_eq!(outcome("..", NEVER, Some(2), &[(1, 0)], 0.0), Ok(()));
    assert_eq!(outcome("#.\n.#", OPEN, Some(3), &[(2, 0), (0, 2)], root(8.0)), Ok(()));
    // Start = goal is a path even where nothing can leave.
    assert_eq!(outcome("#.\n.#", CLOSED, Some(3), &[(1, 1)], 0.0), Ok(()));
    // A bend at a gap within one quadrant.
    assert_eq!(outcome("#.\n.#", CLOSED, Some(3), &[(0, 1), (1, 1), (1, 2)], 2.0), Ok(()));
}

#[test]
fn names_the_wrong_end() {
    let grid = AsciiMap::parse("...").unwrap().grid;
    let [a, b, c] = [0, 1, 2].map(|x| Vertex::new(x, 0));
    let k = Some(FiniteK::N8);
    let check = |start, goal, path: &[Vertex], message: &str| {
        check_fault(validate(&grid, NEVER, k, start, goal, path, 1.0), message);
    };
    check(a, c, &[], "the path from (0, 0) to (2, 0) has no waypoint");
    check(a, c, &[b, c], "the path starts at (1, 0), not at (0, 0)");
    check(a, c, &[a, b], "the path ends at (1, 0), not at (2, 0)");
    check(a, c, &[a], "the path ends at (0, 0), not at (2, 0)");
    check(a, a, &[a, b, a], "start and goal are both (0, 0), but the path has 3 waypoints, not 1");
}

#[test]
fn names_the_wrong_step() {
    let root = f64::sqrt;
    let map = "....\n.#..\n....";
    check_fault(
        outcome(map, NEVER, Some(3), &[(0, 0), (1, 1), (2, 2)], root(8.0)),
        "waypoint 1, (1, 1), is blocked or outside the map",
    );
    check_fault(
        outcome(map, NEVER, None, &[(0, 0), (4, 0)], 4.0),
        "waypoint 1, (4, 0), is blocked or outside the map",
    );
    check_fault(
        outcome(map, NEVER, Some(3), &[(0, 0), (0, 0), (1, 0)], 1.0),
        "waypoint 1, (0, 0), is the same as the one before",
    );
    check_fault(
        outcome("...\n...", NEVER, Some(3), &[(0, 0), (2, 1)], root(5.0)),
        "no move of N(3), repeated, leads from (0, 0) to (2, 1)",
    );
    check_fault(
        outcome("....#.", NEVER, Some(2), &[(0, 0), (5, 0)], 5.0),
        "the segment from (3, 0) to (4, 0) is not legal (center, corners never)",
    );
    check_fault(
        outcome("....#.", NEVER, None, &[(0, 0), (5, 0)], 5.0),
        "the segment from (0, 0) to (5, 0) is not legal (center, corners never)",
    );
}

#[test]
fn names_the_gap_that_is_crossed() {
    let root = f64::sqrt;
    let map = "#.\n.#";
    let crossed = "the path crosses the gap (1, 1) or uses a quadrant of it that it may not: ";
    let through = |path: &[(i32, i32)], k, cost| outcome(map, CLOSED, k, path, cost);
    check_fault(
        through(&[(2, 0), (0, 2)], Some(3), root(8.0)),
        &format!("{crossed}(2, 0) → (1, 1) → (0, 2)"),
    );
    check_fault(through(&[(0, 1), (1, 1), (2, 1)], None, 2.0), &format!("{crossed}(0, 1) → (1, 1) → (2, 1)"));
    check_fault(through(&[(0, 1), (1, 1)], Some(2), 1.0), &format!("{crossed}(0, 1) → (1, 1) → goal"));
    check_fault(through(&[(1, 1), (0, 1)], Some(2), 1.0), &format!("{crossed}start → (1, 1) → (0, 1)"));
    check_fault(
        through(&[(2, 0), (0, 2)], None, root(8.0)),
        "the segment from (2, 0) to (0, 2) is not legal (corner, gap closed)",
    );
}

#[test]
fn a_cost_must_be_neither_too_large_nor_too_small() {
    let path = [(0, 0), (2, 0)];
    for wrong in [2.0 + 1e-8, 2.0 - 1e-8, 0.0, f64::INFINITY, f64::NAN, -2.0] {
        check_fault(
            outcome("...", NEVER, Some(3), &path, wrong),
            &format!("the cost from (0, 0) to (2, 0) is given as {wrong}, but the path measures 2"),
        );
    }
    assert_eq!(outcome("...", NEVER, Some(3), &path, 2.0 + 1e-10), Ok(()));
    check_fault(
        outcome("...", NEVER, Some(3), &[(0, 0)], 1e-300),
        &format!("the cost from (0, 0) to (0, 0) is given as {}, but the path measures 0", 1e-300),
    );
}
