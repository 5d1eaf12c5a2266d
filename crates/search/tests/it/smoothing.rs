//! Smoothed paths are legal, never longer, and as taut as the documentation says, by a slow check of its own.

use std::sync::Arc;

use mediant_grid::{
    AsciiMap, Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Placement, Rules,
    Vector, Vertex,
};
use mediant_moves::FiniteK;
use mediant_oracle::{
    Explicit, Rng, describe, random_free_vertex, seeds, segment_is_legal, suite_grid, turn_is_legal, validate,
};
use mediant_search::{
    AStar, Answer, Counters, Ends, Guarantee, Hk, Path, Planner, Smoothed, Smoothing, ThetaStar, pull_taut,
    smooth,
};

/// Judges paths on a map by the legality tests of the oracle.
struct Judge<'g> {
    grid: &'g Grid,
    rules: Rules,
}

impl Judge<'_> {
    /// Whether these are consecutive waypoints of a legal path, with `None` before its start and after its
    /// goal.
    fn is_legal(&self, way: &[Option<Vertex>]) -> bool {
        let sees = |ends: &[Option<Vertex>]| match *ends {
            [Some(a), Some(b)] => a != b && segment_is_legal(self.grid, self.rules, a, b),
            _ => true,
        };
        let turns = |turn: &[Option<Vertex>]| {
            self.rules != Rules::Corner(DiagonalGap::Closed)
                || turn[1].is_none_or(|at| turn_is_legal(self.grid, turn[0], at, turn[2]))
        };
        way.windows(2).all(sees) && way.windows(3).all(turns)
    }

    /// Whether `instead` can replace a waypoint.
    fn fits(&self, path: &[Vertex], index: usize, instead: &[Vertex]) -> bool {
        self.fits_for(1, path, index, instead)
    }

    /// Whether `instead` can replace `count` waypoints.
    fn fits_for(&self, count: usize, path: &[Vertex], index: usize, instead: &[Vertex]) -> bool {
        let at = |index: Option<usize>| index.and_then(|index| path.get(index).copied());
        let mut way = vec![at(index.checked_sub(2)), at(index.checked_sub(1))];
        way.extend(instead.iter().copied().map(Some));
        way.extend([at(Some(index + count)), at(Some(index + count + 1))]);
        self.is_legal(&way)
    }

    /// Checks all that is documented of the waypoints of a taut path. Returns the first violation.
    fn slack(&self, path: &[Vertex]) -> Option<String> {
        (1..path.len().saturating_sub(1)).find_map(|index| {
            let [a, b, c] = [path[index - 1], path[index], path[index + 1]];
            if self.fits(path, index, &[]) {
                return Some(format!("{b} can be skipped"));
            }
            if index + 2 < path.len() && self.fits_for(2, path, index, &[]) {
                return Some(format!("{b} and {c} can be skipped"));
            }
            let (before, after) = (between(a, b), between(b, c));
            let on_segments = before.iter().chain(&after);
            if let Some(at) = on_segments.copied().find(|&at| self.fits(path, index, &[at])) {
                return Some(format!("{b} can move along a segment to {at}"));
            }
            if let (Some(&p), Some(&q)) = (before.last(), after.first())
                && self.fits(path, index, &[p, q])
            {
                return Some(format!("{b} can be cut off from {p} to {q}"));
            }
            let length = |at: Vertex| a.distance(at) + at.distance(c);
            let around = (-1..=1).flat_map(|y| (-1..=1).map(move |x| b + Vector::new(x, y)));
            let better =
                |at: &Vertex| length(*at) < length(b) - 2.0_f64.powi(-29) && self.fits(path, index, &[*at]);
            if let Some(at) = around.into_iter().find(better) {
                return Some(format!("{b} can move to {at}"));
            }
            let free =
                self.rules.placement() == mediant_grid::PlacementKind::Corner && !self.is_held(a, b, c);
            free.then(|| format!("no obstacle holds {b}"))
        })
    }

    /// Whether one of the four cells at the corner b is blocked and lies within the turn a, b, c.
    fn is_held(&self, a: Vertex, b: Vertex, c: Vertex) -> bool {
        // Whether a direction lies strictly between two others.
        let between = |u: Vector, v: Vector, w: Vector| {
            let side = u.det(v).signum();
            u.det(w) * side > 0 && w.det(v) * side > 0
        };
        // The direction u, turned a little towards v.
        let beside = |u: Vector, v: Vector| u * 1_000 + v;
        [(0, 0), (-1, 0), (0, -1), (-1, -1)].into_iter().any(|(x, y)| {
            let (ba, bc) = (b.to(a), b.to(c));
            let (along, down) = (Vector::new(2 * x + 1, 0), Vector::new(0, 2 * y + 1));
            let meets = [(ba, bc), (bc, ba)].into_iter().any(|(u, v)| between(along, down, beside(u, v)))
                || [(along, down), (down, along)].into_iter().any(|(u, v)| between(ba, bc, beside(u, v)));
            meets && self.grid.is_blocked(b.x + x, b.y + y)
        })
    }
}

/// The vertices strictly between two others, one after the other.
fn between(a: Vertex, b: Vertex) -> Vec<Vertex> {
    let d = a.to(b);
    let n = (1..=d.x.abs().max(d.y.abs())).rev().find(|n| d.x % n == 0 && d.y % n == 0).unwrap_or(1);
    (1..n).map(|i| a + Vector::new(d.x / n * i, d.y / n * i)).collect()
}

/// Checks that [`smooth`] follows the path as long as it is in sight.
fn check_smooth(judge: &Judge<'_>, before: &[Vertex], after: &[Vertex], case: &dyn Fn() -> String) {
    let mut way = vec![before[0]];
    way.extend(before.windows(2).flat_map(|ends| [between(ends[0], ends[1]), vec![ends[1]]].concat()));
    let mut last = 0;
    for at in after.iter().skip(1) {
        let offset = way[last + 1..].iter().position(|vertex| vertex == at);
        let next = last + 1 + offset.unwrap_or_else(|| panic!("{at} is not on the way; {}", case()));
        // With closed gaps it may have seen farther, to a vertex at which the path may not turn.
        if judge.rules == Rules::Corner(DiagonalGap::Closed) {
            last = next;
            continue;
        }
        let mut from = last;
        for (seen, &beyond) in way.iter().enumerate().take(next + 2).skip(last + 2) {
            if !judge.is_legal(&[Some(way[from]), Some(beyond)]) {
                // There is no waypoint where the path goes straight on.
                from = seen - 1;
                assert_eq!(way[last].to(*at).det(way[last].to(way[from])), 0, "{at}; {}", case());
            }
        }
        let is_last = next + 1 == way.len();
        assert!(is_last || from == next, "{} sees {}; {}", way[from], way[next + 1], case());
        last = next;
    }
    assert_eq!(last + 1, way.len(), "{}", case());
}

/// Checks both kinds of smoothing on a path. Returns 1 for each that made it shorter.
fn check<P: Placement>(space: &FreeSpace<P>, path: &Path, case: &dyn Fn() -> String) -> [usize; 2] {
    let judge = Judge { grid: space.grid(), rules: space.rules() };
    let (way, slack) = (path.waypoints(), 1.0 + 1e-12);
    let (start, goal) = (way[0], way[way.len() - 1]);
    let [linear, taut] = [Smoothing::Linear, Smoothing::Taut].map(|smoothing| {
        let smoothed = smoothing.apply(space, path);
        let fault =
            validate(judge.grid, judge.rules, None, start, goal, smoothed.waypoints(), smoothed.cost());
        assert_eq!(fault, Ok(()), "{smoothing:?}; {}", case());
        smoothed
    });
    assert_eq!(linear.waypoints(), smooth(space, way));
    assert_eq!(taut.waypoints(), pull_taut(space, way));
    let costs = [path.cost(), linear.cost(), taut.cost()];
    assert!(costs[1] <= costs[0] * slack && costs[2] <= costs[1] * slack, "{costs:?}; {}", case());
    check_smooth(&judge, way, linear.waypoints(), case);
    for path in [&linear, &taut] {
        let inner = path.waypoints().len().saturating_sub(2);
        assert_eq!(path.bends(), inner, "{path} has a waypoint where nothing turns; {}", case());
    }
    let fault = judge.slack(taut.waypoints());
    assert_eq!(fault, None, "{way:?} became {taut:?}; {}", case());
    assert_eq!(pull_taut(space, taut.waypoints()), taut.waypoints(), "pulled again; {}", case());
    [linear.cost() < path.cost() / slack, taut.cost() < linear.cost() / slack].map(usize::from)
}

fn check_map<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, k: FiniteK, seed: u64) -> [usize; 2] {
    let grid_graph = GridGraph::<P>::new(Arc::clone(grid), k, rule).expect("k is in range");
    let (mut a_star, mut theta) = (AStar::new(&grid_graph, Hk), ThetaStar::new(&grid_graph, Hk));
    let mut rng = Rng::new(seed ^ 0x500);
    let mut free = || random_free_vertex(&mut rng, grid, P::KIND);
    let queries: Vec<Ends> = (0..6).filter_map(|_| Some(Ends::new(free()?, free()?))).collect();
    let mut shorter = [0; 2];
    for query in queries {
        let answers = [a_star.solve(query), theta.solve(query)];
        let case =
            || format!("k = {k}; {}", describe(grid, grid_graph.rules(), query.start, query.goal, seed));
        for path in answers.iter().filter_map(|answer| answer.as_ref().expect("both ends are free").path()) {
            let counts = check(&grid_graph, path, &case);
            shorter.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
        }
    }
    shorter
}

/// The last vertex in sight may lie on a straight line between the two ends.
#[test]
fn a_smoothed_path_has_waypoints_where_it_turns() {
    let map = AsciiMap::parse("#.\n..").expect("a map");
    let rule = DiagonalGap::Open;
    let graph = GridGraph::<Corners>::new(Arc::new(map.grid), FiniteK::N4, rule).expect("k is in range");
    let answer = AStar::new(&graph, Hk).solve(Ends::new((2, 0), (0, 2))).expect("both ends are free");
    let path = answer.into_path().expect("there is one");
    assert_eq!(smooth(&graph, path.waypoints()), [(2, 0), (0, 2)].map(Vertex::from));
}

#[test]
fn smoothed_paths_keep_all_promises() {
    let mut shorter = [0; 2];
    for seed in seeds(150) {
        let grid = Arc::new(suite_grid(seed).0);
        for (rules, k) in Rules::ALL.into_iter().flat_map(|rules| [2, 3, 5].map(|k| (rules, k))) {
            let k = FiniteK::new(k).expect("k is at least 2");
            let counts = match rules {
                Rules::Center(corners) => check_map::<Centers>(&grid, corners, k, seed),
                Rules::Corner(gap) | Rules::CenterGap(gap) => check_map::<Corners>(&grid, gap, k, seed),
            };
            shorter.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
        }
    }
    let maps = seeds(150).end as usize;
    assert!(shorter.iter().all(|&count| count > 4 * maps), "{shorter:?}");
}

/// The map without the obstacles that a path can surround.
fn without_islands(grid: &Grid) -> Grid {
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    let mut fixed = vec![false; (width * height) as usize];
    let mut reached: Vec<(i32, i32)> = (-1..=width).flat_map(|x| [(x, -1), (x, height)]).collect();
    reached.extend((0..height).flat_map(|y| [(-1, y), (width, y)]));
    while let Some((x, y)) = reached.pop() {
        for (x, y) in [(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)] {
            let inside = (0..width).contains(&x) && (0..height).contains(&y);
            if inside && grid.is_blocked(x, y) && !fixed[(y * width + x) as usize] {
                fixed[(y * width + x) as usize] = true;
                reached.push((x, y));
            }
        }
    }
    Grid::from_fn(grid.width(), grid.height(), |x, y| fixed[(y * grid.width() + x) as usize])
        .expect("a valid size")
}

/// Where every obstacle can be passed on one side only, a locally shortest path is a shortest path.
#[test]
fn without_islands_a_taut_path_at_corners_is_optimal() {
    let mut bends = 0;
    for seed in seeds(150) {
        let grid = Arc::new(without_islands(&suite_grid(seed).0));
        for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
            let any_angle = Explicit::new(&grid, Rules::Corner(gap), None);
            for k in [2, 3] {
                let k = FiniteK::new(k).expect("k is at least 2");
                let grid_graph = GridGraph::<Corners>::new(Arc::clone(&grid), k, gap).expect("k is in range");
                let mut planner =
                    Smoothed::new(AStar::new(&grid_graph, Hk), &grid_graph, Some(Smoothing::Taut))
                        .expect("the planner is of this space");
                let mut rng = Rng::new(seed ^ 0x15);
                for _ in 0..6 {
                    let mut free = || random_free_vertex(&mut rng, &grid, Corners::KIND);
                    let (Some(start), Some(goal)) = (free(), free()) else { continue };
                    let answer = planner.solve(Ends::new(start, goal)).expect("both ends are free");
                    let (cost, best) = (answer.path().map(Path::cost), any_angle.costs_from(start).to(goal));
                    let agrees = match (cost, best) {
                        (Some(cost), Some(best)) => (cost - best).abs() <= best * 1e-9,
                        (cost, best) => cost.is_none() && best.is_none(),
                    };
                    assert!(
                        agrees,
                        "k = {k}: {cost:?}, {best:?}; {}",
                        describe(&grid, Rules::Corner(gap), start, goal, seed)
                    );
                    bends += answer.path().map_or(0, |path| path.waypoints().len().saturating_sub(2));
                }
            }
        }
    }
    assert!(bends > 4 * seeds(150).end as usize, "only {bends} bends");
}

/// Checks the results of `smooth` and `pull_taut` for a path.
#[track_caller]
fn check_paths(drawing: &str, rules: Rules, path: &[(i32, i32)], expected: [&[(i32, i32)]; 2]) {
    let grid = Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid);
    let path: Vec<Vertex> = path.iter().map(|&at| at.into()).collect();
    let found = match rules {
        Rules::Center(corners) => {
            let space = FreeSpace::<Centers>::new(grid, corners);
            [smooth(&space, &path), pull_taut(&space, &path)]
        }
        Rules::Corner(gap) | Rules::CenterGap(gap) => {
            let space = FreeSpace::<Corners>::new(grid, gap);
            [smooth(&space, &path), pull_taut(&space, &path)]
        }
    };
    let expected = expected.map(|path| path.iter().map(|&at| at.into()).collect::<Vec<Vertex>>());
    assert_eq!(found, expected, "{rules}");
}

const NEVER: Rules = Rules::Center(CornerRule::Never);
const OPEN: Rules = Rules::Corner(DiagonalGap::Open);
const CLOSED: Rules = Rules::Corner(DiagonalGap::Closed);

const ROUND: &str = "
    ..........
    ..........
    ....##....
    ...####...
    ...####...
    ....##....
";

#[test]
fn a_string_lies_around_obstacles() {
    let path = [(2, 6), (2, 0), (8, 0), (8, 6)];
    // `smooth` places waypoints where sight ends, not where the path turned.
    check_paths(
        ROUND,
        OPEN,
        &path,
        [&[(2, 6), (4, 0), (8, 4), (8, 6)], &[(2, 6), (3, 3), (4, 2), (6, 2), (7, 3), (8, 6)]],
    );
    // At centers paths keep their distance.
    check_paths(
        ROUND,
        NEVER,
        &[(1, 5), (1, 0), (9, 0), (9, 5)],
        [&[(1, 5), (3, 0), (9, 3), (9, 5)], &[(1, 5), (3, 1), (5, 1), (7, 2), (9, 5)]],
    );
    // A staircase none of whose steps can be left out alone.
    check_paths(
        "..#\n#..",
        NEVER,
        &[(0, 0), (1, 0), (1, 1), (2, 1)],
        [&[(0, 0), (1, 0), (1, 1), (2, 1)], &[(0, 0), (2, 1)]],
    );
}

#[test]
fn odd_paths_are_smoothed_too() {
    // Nothing, one vertex, one vertex twice.
    check_paths(ROUND, OPEN, &[], [&[]; 2]);
    check_paths(ROUND, OPEN, &[(1, 1)], [&[(1, 1)]; 2]);
    check_paths(ROUND, OPEN, &[(1, 1), (1, 1)], [&[(1, 1)]; 2]);
    check_paths(ROUND, OPEN, &[(1, 1), (1, 1), (5, 1), (5, 1), (9, 1)], [&[(1, 1), (9, 1)]; 2]);
    // There and back, and around in a circle.
    check_paths(ROUND, OPEN, &[(1, 1), (9, 1), (1, 1)], [&[(1, 1), (2, 1), (1, 1)], &[(1, 1)]]);
    check_paths(ROUND, OPEN, &[(1, 1), (9, 1), (5, 1)], [&[(1, 1), (5, 1)]; 2]);
    check_paths(
        ROUND,
        NEVER,
        &[(0, 0), (2, 0), (2, 2), (0, 2), (0, 0)],
        [&[(0, 0), (0, 1), (0, 0)], &[(0, 0)]],
    );
}

#[test]
fn paths_that_are_not_legal_come_back() {
    let [big, small] = [i32::MAX, i32::MIN];
    let through: &[(i32, i32)] = &[(0, 4), (5, 4), (9, 0)];
    let beyond: &[(i32, i32)] = &[(0, 0), (11, 0), (11, 6)];
    let far: &[(i32, i32)] = &[(small, small), (big, 0), (0, big), (0, 0), (0, 0), (big, big)];
    for rules in Rules::ALL {
        for path in [through, beyond, far] {
            check_paths(ROUND, rules, path, [path; 2]);
        }
    }
    let gap = "
        .#
        #.
    ";
    for path in [&[(0, 0), (1, 1), (2, 2)][..], &[(0, 0), (2, 2)], &[(0, 0), (1, 1)]] {
        check_paths(gap, CLOSED, path, [path; 2]);
    }
    check_paths(gap, OPEN, &[(0, 0), (1, 1), (2, 2)], [&[(0, 0), (2, 2)]; 2]);
}

/// A path may touch a gap, but not leave the quadrant.
#[test]
fn closed_gaps_stay_closed() {
    let cell = "
        .#..
        #.#.
        .##.
    ";
    check_paths(cell, CLOSED, &[(1, 1), (2, 1), (2, 2)], [&[(1, 1), (2, 2)]; 2]);
    check_paths(
        cell,
        CLOSED,
        &[(1, 1), (2, 1), (2, 2), (1, 2), (1, 1)],
        [&[(1, 1), (1, 2), (1, 1)], &[(1, 1)]],
    );

    // A vertex in sight may lie in the other quadrant: of the start, or of a gap on the path.
    let gap = "
        .....
        .#...
        #....
        .....
    ";
    let path: &[(i32, i32)] = &[(1, 2), (4, 2), (1, 0)];
    check_paths(gap, CLOSED, path, [path, &[(1, 2), (2, 2), (2, 1), (1, 0)]]);
    check_paths(gap, OPEN, path, [&[(1, 2), (1, 0)]; 2]);
    let path: &[(i32, i32)] = &[(1, 0), (4, 3), (1, 2), (1, 4)];
    check_paths(gap, CLOSED, path, [&[(1, 0), (4, 3), (1, 4)], &[(1, 0), (2, 1), (2, 2), (1, 4)]]);
    check_paths(gap, OPEN, path, [&[(1, 0), (1, 4)]; 2]);
}

#[test]
fn bends_outside_the_map_are_left_as_they_are() {
    let grid = Arc::new(AsciiMap::parse(ROUND).expect("the drawing is a map").grid);
    let space = FreeSpace::<Corners>::new(grid, DiagonalGap::Open);
    let far = [(i32::MIN, 0), (0, 0), (i32::MAX, 6)].map(Vertex::from);
    let near = [(2, 6), (3, 3), (4, 2), (6, 2), (7, 3), (8, 6)].map(Vertex::from);
    for smoothing in Smoothing::ALL {
        for bends in [&far[..], &near, &near[..1], &[]] {
            assert_eq!(smoothing.apply_to_bends(&space, bends).waypoints(), bends, "{smoothing}");
        }
    }
}

#[test]
fn planners_smooth_their_paths() {
    let grid = Arc::new(AsciiMap::parse(ROUND).expect("the drawing is a map").grid);
    let k = FiniteK::N8;
    let grid_graph =
        Arc::new(GridGraph::<Corners>::new(Arc::clone(&grid), k, DiagonalGap::Open).expect("k is in range"));
    let space = Arc::new(FreeSpace::<Corners>::new(grid, DiagonalGap::Open));
    let query = Ends::new((2, 6), (8, 6));
    let plain = AStar::new(&*grid_graph, Hk).solve(query).expect("both ends are free");
    let best = pull_taut(&space, plain.path().expect("a path").waypoints());

    let planner = || AStar::new(Arc::clone(&grid_graph), Hk);
    let mut passing =
        Smoothed::new(planner(), Arc::clone(&grid_graph), None).expect("the planner is of this space");
    assert_eq!((passing.guarantee(), passing.solve(query).as_ref()), (Guarantee::Optimal(k), Ok(&plain)));
    let mut taut = Smoothed::new(planner(), Arc::clone(&space), Some(Smoothing::Taut))
        .expect("the planner is of this space");
    assert_eq!(taut.guarantee(), Guarantee::AtMost(k));
    let mut counters = [Counters::default(); 2];
    let answer = taut.solve_observed(query, &mut counters[0]).expect("both ends are free");
    assert_eq!(answer, Answer::Found(Path::new(best)));
    planner().solve_observed(query, &mut counters[1]).expect("both ends are free");
    assert_eq!(counters[0], counters[1]);
    assert!(counters[0].expanded > 0);

    // Errors and unreachable goals are passed on.
    assert_eq!(taut.solve(Ends::new((0, 0), (5, 4))), planner().solve(Ends::new((0, 0), (5, 4))));
    let smoothed = Smoothed::new(ThetaStar::new(&*grid_graph, Hk), &*grid_graph, Some(Smoothing::Linear))
        .expect("the planner is of this space");
    assert_eq!(smoothed.guarantee(), Guarantee::Suboptimal);
}

/// Compares the bounds of a guarantee with the any-angle optimum. Returns how many lower bounds exceeded the
/// straight line.
fn check_bounds<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, k: FiniteK, seed: u64) -> usize {
    let grid_graph = GridGraph::<P>::new(Arc::clone(grid), k, rule).expect("k is in range");
    let (rules, any_angle) = (grid_graph.rules(), Explicit::new(grid, grid_graph.rules(), None));
    let mut rng = Rng::new(seed ^ 0xB0D);
    let mut closer = 0;
    for smoothing in [None, Some(Smoothing::Linear), Some(Smoothing::Taut)] {
        let mut planner = Smoothed::new(AStar::new(&grid_graph, Hk), &grid_graph, smoothing)
            .expect("the planner is of this space");
        let mut free = || random_free_vertex(&mut rng, grid, P::KIND);
        let (Some(start), Some(goal)) = (free(), free()) else { continue };
        let answer = planner.solve(Ends::new(start, goal)).expect("both ends are free");
        let (Some(path), Some(best)) = (answer.path(), any_angle.costs_from(start).to(goal)) else {
            continue;
        };
        let (guarantee, straight) = (planner.guarantee(), start.distance(goal));
        let bound = guarantee.lower_bound(rules, path.cost(), straight);
        let case = || format!("k = {k}, {smoothing:?}; {}", describe(grid, rules, start, goal, seed));
        assert!(straight <= bound && bound <= best * (1.0 + 1e-9), "{bound} of {best}; {}", case());
        if let Some(ratio) = guarantee.bound(rules) {
            assert!(path.cost() <= best * ratio * (1.0 + 1e-9), "{} of {best}; {}", path.cost(), case());
        }
        closer += usize::from(bound > straight);
    }
    closer
}

#[test]
fn guarantees_bound_the_any_angle_optimum() {
    let mut closer = [0; 5];
    for seed in seeds(100) {
        let grid = Arc::new(suite_grid(seed).0);
        for ((rules, k), count) in Rules::ALL
            .into_iter()
            .zip([2, 3, 4, 5, 6].into_iter().cycle().skip(seed as usize % 5))
            .zip(&mut closer)
        {
            let k = FiniteK::new(k).expect("k is at least 2");
            *count += match rules {
                Rules::Center(corners) => check_bounds::<Centers>(&grid, corners, k, seed),
                Rules::Corner(gap) | Rules::CenterGap(gap) => check_bounds::<Corners>(&grid, gap, k, seed),
            };
        }
    }
    let [never, one, always, open, closed] = closer;
    // At centers no bound holds against paths that bend at corners: there is the straight line alone.
    assert!(never + one + always == 0 && open.min(closed) > 10, "{closer:?}");
    // An engine without a guarantee has no bound.
    for rules in Rules::ALL {
        let (best, none) = (Guarantee::OptimalAnyAngle, Guarantee::Suboptimal);
        assert_eq!((best.bound(rules), none.bound(rules)), (Some(1.0), None));
        assert_eq!((best.lower_bound(rules, 5.0, 3.0), none.lower_bound(rules, 5.0, 3.0)), (5.0, 3.0));
    }
}
