//! Paths: their moves, vertices, cells and points, and whether they still hold, against the oracle.

use std::{collections::BTreeSet, f64::consts::PI, sync::Arc};

use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, Placement, PlacementKind, Rectangle, Rules,
    Vertex, draw,
};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{
    Explicit, Fault, Rng, random_free_vertex, random_grid, random_vertex, seeds, segment_is_legal,
    turn_is_legal, validate, vertex_is_free,
};
use mediant_search::{BrokenPath, End, Path};

fn path(waypoints: &[(i32, i32)]) -> Path {
    Path::new(waypoints.iter().map(|&at| at.into()).collect())
}

/// A shortest path, over N(k) or at any angle; half of them with one waypoint moved, left out or repeated.
fn random_path(rng: &mut Rng, grid: &Grid, rules: Rules) -> Option<Path> {
    let kind = rules.placement();
    let start = random_free_vertex(rng, grid, kind)?;
    let goal = random_free_vertex(rng, grid, kind)?;
    let k = [Some(FiniteK::N4), Some(FiniteK::N8), Some(FiniteK::N16), None][rng.below(4) as usize];
    let graph = Explicit::new(grid, rules, k);
    let costs = graph.costs_from(start);
    let mut waypoints = costs.path_to(goal).unwrap_or_else(|| vec![start, goal]);
    let at = rng.below(waypoints.len() as u32) as usize;
    match rng.below(8) {
        0 => waypoints[at] = random_vertex(rng, grid, kind),
        1 => _ = waypoints.remove(at),
        2 => waypoints.insert(at, waypoints[at]),
        3 => waypoints[at].x += rng.below(5) as i32 - 2,
        _ => {}
    }
    Some(Path::new(waypoints))
}

/// A path's first fault, by brute force in the order of [`Path::check`], as the index of a waypoint or
/// segment.
fn first_fault(grid: &Grid, rules: Rules, waypoints: &[Vertex]) -> Option<(&'static str, usize)> {
    let kind = rules.placement();
    let (width, height) = match kind {
        PlacementKind::Center => (grid.width(), grid.height()),
        PlacementKind::Corner => (grid.width() + 1, grid.height() + 1),
    };
    let is_inside = |at: &Vertex| (0..width as i32).contains(&at.x) && (0..height as i32).contains(&at.y);
    let Some(last) = waypoints.len().checked_sub(1) else { return Some(("empty", 0)) };
    if let Some(index) = waypoints.iter().position(|at| !is_inside(at)) {
        return Some(("outside", index));
    }
    if let Some(index) = [0, last].into_iter().find(|&i| !vertex_is_free(grid, kind, waypoints[i])) {
        return Some(("blocked", index));
    }
    let gaps = rules == Rules::Corner(DiagonalGap::Closed);
    for (index, &at) in waypoints.iter().enumerate() {
        // The nearest other vertices: a path that stands still turns where it goes on.
        let before = waypoints[..index].iter().rev().find(|&&other| other != at).copied();
        let after = waypoints[index..].iter().find(|&&other| other != at).copied();
        let next = waypoints.get(index + 1);
        if gaps && next != Some(&at) && !turn_is_legal(grid, before, at, after) {
            return Some(("gap", index));
        }
        if next.is_some_and(|&next| !segment_is_legal(grid, rules, at, next)) {
            return Some(("segment", index));
        }
    }
    None
}

/// To how many waypoints a path can be followed that goes on from the last of them.
fn holds(grid: &Grid, rules: Rules, waypoints: &[Vertex]) -> usize {
    let gaps = rules == Rules::Corner(DiagonalGap::Closed);
    if waypoints.first().is_none_or(|&start| !vertex_is_free(grid, rules.placement(), start)) {
        return 0;
    }
    let goes_on = |index: usize, to: Vertex| {
        let at = waypoints[index];
        let before = waypoints[..index].iter().rev().find(|&&other| other != at).copied();
        let turns = !gaps || turn_is_legal(grid, before, at, Some(to));
        at == to || turns && segment_is_legal(grid, rules, at, to)
    };
    let broken = waypoints.iter().enumerate().skip(1).find(|&(next, &to)| !goes_on(next - 1, to));
    broken.map_or(waypoints.len(), |(next, _)| next)
}

fn found(result: Result<(), BrokenPath>, waypoints: &[Vertex]) -> Option<(&'static str, usize)> {
    match result {
        Ok(()) => None,
        Err(BrokenPath::Empty) => Some(("empty", 0)),
        Err(BrokenPath::Outside { index, .. }) => Some(("outside", index)),
        Err(BrokenPath::Blocked { end: End::Start, .. }) => Some(("blocked", 0)),
        Err(BrokenPath::Blocked { end: End::Goal, .. }) => Some(("blocked", waypoints.len() - 1)),
        Err(BrokenPath::Segment { index, .. }) => Some(("segment", index)),
        Err(BrokenPath::Gap { index, .. }) => Some(("gap", index)),
        Err(other) => panic!("{other}"),
    }
}

fn check_under(grid: &Arc<Grid>, rules: Rules, path: &Path) -> Result<(), BrokenPath> {
    match rules {
        Rules::Center(rule) => path.check(&FreeSpace::<Centers>::new(Arc::clone(grid), rule)),
        Rules::Corner(rule) | Rules::CenterGap(rule) => {
            path.check(&FreeSpace::<Corners>::new(Arc::clone(grid), rule))
        }
    }
}

/// Whether the oracle finds the path legal, over N(k) or at any angle.
fn is_valid(grid: &Grid, rules: Rules, k: Option<FiniteK>, path: &Path) -> bool {
    let mut waypoints = path.waypoints().to_vec();
    waypoints.dedup();
    let (Some(&start), Some(&goal)) = (waypoints.first(), waypoints.last()) else { return false };
    let result = validate(grid, rules, k, start, goal, &waypoints, path.cost());
    // A way round is no fault here.
    if let Err(Fault::Detour { .. }) = result {
        return first_fault(grid, rules, &waypoints).is_none() && k.is_none_or(|k| path.is_over(k.into()));
    }
    result.is_ok()
}

#[test]
fn a_path_holds_where_the_oracle_says_so() {
    let mut counts = std::collections::BTreeMap::new();
    let mut partly = 0;
    for seed in seeds(250) {
        let grid = Arc::new(random_grid(seed).0);
        for rules in Rules::ALL {
            let rng = &mut Rng::new(seed);
            let Some(path) = random_path(rng, &grid, rules) else { continue };
            let message = || {
                format!("{rules}, seed {seed}: {path}\n{}", draw(&grid, rules.placement(), path.waypoints()))
            };
            let result = check_under(&grid, rules, &path);
            let fault = first_fault(&grid, rules, path.waypoints());
            assert_eq!(found(result, path.waypoints()), fault, "{}", message());
            assert_eq!(result.is_ok(), is_valid(&grid, rules, None, &path), "{}", message());
            if let Err(broken) = result {
                let holds = holds(&grid, rules, path.waypoints());
                assert_eq!(broken.holds_up_to(), holds, "{broken}; {}", message());
                partly += usize::from(holds > 1 && matches!(fault, Some(("blocked" | "outside", _))));
            }
            for k in [FiniteK::N4, FiniteK::N8, FiniteK::N16] {
                let both = result.is_ok() && path.is_over(k.into());
                assert_eq!(both, is_valid(&grid, rules, Some(k), &path), "k = {k}, {}", message());
            }
            assert!(path.is_over(K::ANY));
            *counts.entry(fault.map_or("none", |(what, _)| what)).or_insert(0) += 1;
        }
    }
    let kinds: Vec<_> = counts.keys().copied().collect();
    assert_eq!(kinds, ["blocked", "empty", "gap", "none", "outside", "segment"], "{counts:?}");
    assert!(partly as u64 > seeds(250).end / 50, "{partly} paths hold in part");
}

/// Counts the edits that broke a path.
fn check_edits<P: Placement>(seed: u64, rule: P::Rule) -> usize {
    let (grid, rules) = (Arc::new(random_grid(seed).0), P::rules(rule));
    let rng = &mut Rng::new(seed);
    let (Some(start), Some(goal)) =
        (random_free_vertex(rng, &grid, P::KIND), random_free_vertex(rng, &grid, P::KIND))
    else {
        return 0;
    };
    let k = [Some(FiniteK::N8), None][rng.below(2) as usize];
    let graph = Explicit::new(&grid, rules, k);
    let Some(waypoints) = graph.costs_from(start).path_to(goal) else { return 0 };
    let path = Path::new(waypoints);
    assert_eq!(path.check(&FreeSpace::<P>::new(Arc::clone(&grid), rule)), Ok(()), "seed {seed}");
    let mut broken = 0;
    let is_inside = |&(x, y): &(i32, i32)| {
        (0..grid.width() as i32).contains(&x) && (0..grid.height() as i32).contains(&y)
    };
    for (x, y) in path.touched_cells(P::KIND).filter(is_inside) {
        let at = Rectangle { x: x as u32, y: y as u32, width: 1, height: 1 };
        let edited = Arc::new(grid.with_rectangle(at, |_, _| true));
        let result = path.check(&FreeSpace::<P>::new(Arc::clone(&edited), rule));
        let expected = first_fault(&edited, rules, path.waypoints());
        assert_eq!(
            found(result, path.waypoints()),
            expected,
            "{rules}, seed {seed}, cell ({x}, {y}): {path}"
        );
        if let Err(BrokenPath::Segment { index, from, to, by }) = result {
            assert_eq!([from, to], path.waypoints()[index..][..2]);
            let cell = by.cell().expect("both ends are free");
            let was_blocked = grid.is_blocked(cell.0, cell.1);
            assert!(cell == (x, y) || was_blocked, "{rules}, seed {seed}, cell ({x}, {y}): {by}, {path}");
        }
        broken += usize::from(result.is_err());
    }
    broken
}

#[test]
fn an_edited_cell_under_a_path_breaks_the_segment_that_meets_it() {
    let mut broken = [0; 5];
    for seed in seeds(60) {
        for (rules, broken) in Rules::ALL.into_iter().zip(&mut broken) {
            *broken += match rules {
                Rules::Center(rule) => check_edits::<Centers>(seed, rule),
                Rules::Corner(rule) | Rules::CenterGap(rule) => check_edits::<Corners>(seed, rule),
            };
        }
    }
    assert!(broken.iter().all(|&n| n > 50), "{broken:?}");
}

/// The cells that a path between corners touches, by the rational parameters at which each segment is inside
/// of a cell: its open interior, or, along a grid line, the closed cell for more than a point.
fn touched_at_corners(path: &Path) -> BTreeSet<(i32, i32)> {
    let mut touched = BTreeSet::new();
    for ends in path.waypoints().windows(2) {
        let (from, to) = (ends[0], ends[1]);
        let [columns, rows] = [(from.x, to.x), (from.y, to.y)].map(|(a, b)| a.min(b) - 1..=a.max(b));
        for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
            // In units of 1 / (|dx| · |dy|) of the segment, where neither is 0.
            let (dx, dy) = (i64::from(to.x - from.x), i64::from(to.y - from.y));
            let scale = [dx, dy].map(|by| by.abs().max(1)).iter().product::<i64>();
            let inside = |cell: i32, from: i32, by: i64| {
                let low = i64::from(cell - from);
                match by.signum() {
                    0 if (low..=low + 1).contains(&0) => Some((0, scale)),
                    0 => None,
                    1 => Some((low * scale / by, (low + 1) * scale / by)),
                    _ => Some(((low + 1) * scale / by, low * scale / by)),
                }
            };
            let (Some(across), Some(down)) = (inside(x, from.x, dx), inside(y, from.y, dy)) else { continue };
            let (enters, leaves) = (across.0.max(down.0).max(0), across.1.min(down.1).min(scale));
            if enters < leaves {
                touched.insert((x, y));
            }
        }
    }
    touched
}

#[test]
fn moves_lead_from_vertex_to_vertex() {
    for seed in seeds(200) {
        let rng = &mut Rng::new(seed);
        let (grid, _) = random_grid(seed);
        let count = 1 + rng.below(6);
        let mut waypoints: Vec<_> =
            (0..count).map(|_| random_vertex(rng, &grid, PlacementKind::Corner)).collect();
        waypoints.dedup();
        let path = Path::new(waypoints);
        let (vertices, moves): (Vec<_>, Vec<_>) = (path.vertices().collect(), path.moves().collect());
        assert_eq!(vertices.len(), moves.len() + 1, "seed {seed}");
        for (ends, step) in vertices.windows(2).zip(&moves) {
            assert!(step.is_move() && ends[0] + *step == ends[1], "seed {seed}: {ends:?} by {step:?}");
        }
        let mut rest = vertices.iter();
        assert!(path.waypoints().iter().all(|at| rest.any(|other| other == at)), "seed {seed}");
        // Cells are those of the segments, without one twice in a row.
        for kind in [PlacementKind::Center, PlacementKind::Corner] {
            let cells: Vec<_> = path.touched_cells(kind).collect();
            assert!(cells.windows(2).all(|two| two[0] != two[1]), "seed {seed}");
            let back: Vec<_> = path.reversed().touched_cells(kind).collect();
            let set = |cells: &[(i32, i32)]| cells.iter().copied().collect::<BTreeSet<_>>();
            assert_eq!(set(&back), set(&cells), "seed {seed}");
            if kind == PlacementKind::Corner {
                assert_eq!(set(&cells), touched_at_corners(&path), "seed {seed}: {path}");
            } else {
                assert_eq!(back.len(), cells.len(), "seed {seed}");
                let is_near =
                    |two: &[(i32, i32)]| (two[0].0 - two[1].0).abs().max((two[0].1 - two[1].1).abs()) == 1;
                assert!(cells.windows(2).all(is_near), "seed {seed}: {cells:?}");
            }
        }
        assert_eq!(path.reversed().reversed(), path);
    }
}

#[test]
fn points_are_evenly_spaced() {
    for seed in seeds(300) {
        let rng = &mut Rng::new(seed);
        let count = 2 + rng.below(5);
        let waypoints = (0..count).map(|_| Vertex::new(rng.below(40) as i32, rng.below(40) as i32));
        let path = Path::new(waypoints.collect());
        let spacing = [0.1, 0.25, 1.0, 2.0_f64.sqrt(), 3.7, 1e9][rng.below(6) as usize];
        let points: Vec<_> = path.spaced(spacing).expect("it is positive").collect();
        let ends = [path.waypoints().first(), path.waypoints().last()];
        let ends = ends.map(|at| at.map(|at| (f64::from(at.x), f64::from(at.y))));
        assert_eq!([points.first().copied(), points.last().copied()], ends, "seed {seed}");
        if path.cost() > 0.0 {
            let steps = (path.cost() / spacing - 1e-9).ceil().max(1.0);
            assert_eq!(points.len(), steps as usize + 1, "seed {seed}, spacing {spacing}, {path}");
        }
        for (&(x, y), i) in points.iter().zip(0..points.len() - 1) {
            let (px, py) = path.point_at(f64::from(i as u32) * spacing).expect("it is a number");
            assert!((x - px).abs().max((y - py).abs()) < 1e-9, "seed {seed}: point {i}");
        }
        // Along a segment, the distance is that of the points; around a bend it is less.
        let most = spacing * (1.0 + 1e-9);
        assert!(points.windows(2).all(|two| (two[0].0 - two[1].0).hypot(two[0].1 - two[1].1) <= most));
    }
}

#[test]
fn odd_spacings_and_distances() {
    let around = path(&[(0, 0), (3, 0), (3, 4)]);
    for spacing in [0.0, -0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
        let error = around.spaced(spacing).map(Iterator::count).expect_err("it is not positive");
        assert!(error.to_string().starts_with("points cannot be"), "{error}");
    }
    let points = |spacing| around.spaced(spacing).expect("it is positive");
    assert!(points(f64::INFINITY).eq([(0.0, 0.0), (3.0, 4.0)]));
    assert!(points(3.5).eq([(0.0, 0.0), (3.0, 0.5), (3.0, 4.0)]));
    // A multiple: no last step of almost nothing.
    assert_eq!(points(0.1).count(), 71);
    assert_eq!(points(7.0 / 55.0).count(), 56);
    assert_eq!(points(1e-300).nth(100), Some((100.0 * 1e-300, 0.0)));
    assert_eq!(path(&[]).spaced(1.0).map(Iterator::count), Ok(0));
    assert_eq!(path(&[(2, 3), (2, 3)]).spaced(1.0).map(Iterator::count), Ok(1));
    for (distance, expected) in [(-1.0, (0.0, 0.0)), (3.0, (3.0, 0.0)), (1e9, (3.0, 4.0)), (5.0, (3.0, 2.0))]
    {
        assert_eq!(around.point_at(distance), Some(expected));
    }
    assert_eq!(around.point_at(f64::INFINITY), Some((3.0, 4.0)));
    assert_eq!(around.point_at(f64::NAN), None);
    assert_eq!(path(&[]).point_at(0.0), None);
}

#[test]
fn turns_are_positive_to_the_right() {
    let turns = |waypoints: &[(i32, i32)]| -> Vec<_> {
        path(waypoints)
            .turns()
            .map(|turn| (turn.at.vertex().map(<(i32, i32)>::from), turn.angle / PI))
            .collect()
    };
    // East, then south: to the right, since y is down.
    assert_eq!(turns(&[(0, 0), (2, 0), (2, 2)]), [(Some((2, 0)), 0.5)]);
    assert_eq!(turns(&[(0, 0), (2, 0), (2, -2)]), [(Some((2, 0)), -0.5)]);
    assert_eq!(turns(&[(0, 0), (2, 0), (3, 1)]), [(Some((2, 0)), 0.25)]);
    assert_eq!(turns(&[(0, 0), (2, 1), (2, 1), (4, 2), (0, 0)]), [(Some((4, 2)), 1.0)]);
    assert_eq!(path(&[(0, 0), (2, 1), (4, 2)]).bends(), 0);
    let headings: Vec<_> = path(&[(0, 0), (1, 0), (1, 0), (1, 1), (0, 1), (0, 0)]).headings().collect();
    assert_eq!(headings, [0.0, PI / 2.0, PI, -PI / 2.0]);
}

#[test]
fn joined_paths_merge_where_they_go_straight_on() {
    let joined = |a: &[(i32, i32)], b: &[(i32, i32)]| path(a).joined(&path(b));
    assert_eq!(joined(&[(0, 0), (2, 0)], &[(2, 0), (2, 5)]), Ok(path(&[(0, 0), (2, 0), (2, 5)])));
    assert_eq!(joined(&[(0, 0), (2, 2)], &[(2, 2), (5, 5), (6, 6)]), Ok(path(&[(0, 0), (5, 5), (6, 6)])));
    // Back is not straight on.
    assert_eq!(joined(&[(0, 0), (2, 0)], &[(2, 0), (0, 0)]), Ok(path(&[(0, 0), (2, 0), (0, 0)])));
    assert_eq!(joined(&[(0, 0)], &[(0, 0), (1, 0)]), Ok(path(&[(0, 0), (1, 0)])));
    assert_eq!(joined(&[(0, 0), (1, 0)], &[(1, 0)]), Ok(path(&[(0, 0), (1, 0)])));
    assert_eq!(joined(&[], &[(4, 4)]), Ok(path(&[(4, 4)])));
    assert_eq!(joined(&[(4, 4)], &[]), Ok(path(&[(4, 4)])));
    let error = joined(&[(0, 0), (2, 0)], &[(3, 0)]).expect_err("they do not meet");
    assert_eq!(
        error.to_string(),
        "the path ends at (2, 0), and the other one begins at (3, 0): they must meet to be joined"
    );
}

#[test]
fn what_broke_a_path_is_said_in_words() {
    let grid = Arc::new(Grid::from_fn(6, 4, |x, y| matches!((x, y), (2, 1) | (3, 2))).expect("it is small"));
    let rules = Rules::Corner(DiagonalGap::Closed);
    let text = |waypoints: &[(i32, i32)]| match check_under(&grid, rules, &path(waypoints)) {
        Ok(()) => String::new(),
        Err(broken) => format!("{broken}; up to {}", broken.holds_up_to()),
    };
    insta::assert_snapshot!(
        [
            text(&[]),
            text(&[(0, 0), (9, 0)]),
            text(&[(0, 0), (0, 4), (6, 0)]),
            text(&[(0, 0), (0, 2), (6, 2)]),
            text(&[(1, 3), (3, 2), (4, 1)]),
            text(&[(3, 2), (4, 1)]),
            text(&[(4, 1), (3, 2)]),
            text(&[(4, 1), (3, 2), (3, 2)]),
            text(&[(0, 0), (6, 0), (6, 4)]),
        ]
        .join("\n")
    );
}

/// How far a path can be followed does not depend on what of it is named as broken.
#[test]
fn a_path_holds_up_to_a_blocked_goal() {
    let grid = Arc::new(Grid::from_fn(3, 2, |x, y| (x, y) == (2, 1)).expect("it is small"));
    let rules = Rules::Center(CornerRule::Never);
    let held = |waypoints: &[(i32, i32)]| {
        check_under(&grid, rules, &path(waypoints)).map_or_else(|broken| broken.holds_up_to(), |()| 99)
    };
    assert_eq!(held(&[(0, 1), (0, 0), (2, 0), (2, 1)]), 3);
    assert_eq!(held(&[(0, 1), (0, 0), (2, 0), (2, 9)]), 3);
    assert_eq!(held(&[(0, 1), (2, 1), (2, 0), (2, 9)]), 1);
    assert_eq!(held(&[(0, 0), (2, 1), (2, 1)]), 1);
    assert_eq!(held(&[(2, 1), (2, 0)]), 0);
    assert_eq!(held(&[(9, 9), (2, 0)]), 0);
    assert_eq!(held(&[(0, 0), (2, 0)]), 99);
}

#[test]
fn coordinates_of_all_sizes() {
    const FAR: i32 = i32::MAX;
    let odd = path(&[(i32::MIN, i32::MIN), (FAR, FAR), (FAR, 0), (i32::MIN, 3), (i32::MIN, 3)]);
    assert_eq!(odd.vertices().nth(2), Some(Vertex::new(i32::MIN + 2, i32::MIN + 2)));
    assert_eq!(odd.reversed().vertices().take(3).count(), 3);
    assert!(odd.moves().take(3).all(|step| step == (1, 1).into()));
    assert_eq!(path(&[(i32::MIN, 0), (FAR, 1)]).moves().count(), 0);
    assert_eq!(odd.turns().count(), odd.headings().count() - 1);
    for kind in [PlacementKind::Center, PlacementKind::Corner] {
        assert!(odd.touched_cells(kind).take(5).count() <= 5);
    }
    assert!(!path(&[(i32::MIN, 0), (FAR, 1)]).is_over(K::N64));
    for rules in Rules::ALL {
        let grid = Arc::new(Grid::from_fn(2, 2, |_, _| false).expect("it is small"));
        assert!(matches!(check_under(&grid, rules, &odd), Err(BrokenPath::Outside { index: 0, .. })));
    }
}

#[test]
fn a_cost_of_its_own_stays_with_a_path() {
    let path = Path::with_cost(vec![(0, 0).into(), (3, 4).into()], 20.0);
    for moved in [path.at_centers(), path.at_corners(), path.at_corners().at_centers(), path.reversed()] {
        assert_eq!((moved.cost(), moved.length()), (20.0, 5.0), "{moved}");
    }
    assert_ne!(path.at_centers(), path);
    assert_eq!(path.at_corners().at_centers(), path);
}
