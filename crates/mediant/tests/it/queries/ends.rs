//! Several ends, tolerances, nearest and snapped ends.

use mediant::{
    Answer, CornerRule, Ends, Engine, Guarantee, K, Limit, Limits, Map, Motion, Path, PlacementKind, Planner,
    Query, Rules, Setup, Smoothing, Vertex, errors::QueryError, grid::Grid, search::End,
};
use mediant_oracle::{Rng, on_all_cores, random_vertex};

use super::{
    TIE, World, end, is_exact, maps, motion, motions, on_worlds, random_grid, start, steps::in_steps,
};

/// A path that a query asks for, if no other is better.
#[derive(Clone, Copy, Debug)]
struct Pair {
    start: Vertex,
    goal: Vertex,
    cost: f64,
}

/// All pairs of ends with a path, those of a goal before those of the next, those of a start before those of
/// the next.
fn pairs(world: &World, starts: &[Vertex], goals: &[Vertex]) -> Vec<Pair> {
    let costs: Vec<_> = starts.iter().map(|&start| (start, world.oracle.costs_from(start))).collect();
    let to = |goal: Vertex| {
        costs
            .iter()
            .filter_map(move |(start, costs)| Some(Pair { start: *start, goal, cost: costs.to(goal)? }))
    };
    goals.iter().flat_map(|&goal| to(goal)).collect()
}

/// A query, with the ends that it asks for, in order.
#[derive(Clone, Debug)]
pub(super) struct Asked {
    pub(super) query: Query,
    pub(super) starts: Vec<Vertex>,
    pub(super) goals: Vec<Vertex>,
    /// Whether the goals are not those of the query, but the nearest that can be reached.
    pub(super) are_nearest: bool,
}

impl Asked {
    /// Whether the goals are those around a goal with a tolerance, and so may be searched all at once: then
    /// the path may be any of the shortest ones.
    fn is_any(&self) -> bool {
        self.starts.len() == 1 && self.goals.len() > self.query.goals().len() && !self.are_nearest
    }
}

/// Checks the answer of a planner: an optimal one gives the first of the shortest paths, another the path
/// that it finds between two of the ends.
pub(super) fn check(world: &World, setup: Setup, planner: &mut Planner, asked: &Asked) {
    let text = || world.text(setup, asked);
    let all = pairs(world, &asked.starts, &asked.goals);
    let answer = planner.find(asked.query.clone());
    assert_eq!(in_steps(planner, &asked.query, 3).map(|(answer, _)| answer), answer, "{}", text());
    let shortest = all.iter().map(|pair| pair.cost).reduce(f64::min);
    let (Some(shortest), Ok(answer)) = (shortest, &answer) else {
        let gave_up = matches!(answer, Err(QueryError::GaveUp { .. })) && setup.engine.kind() == Engine::Chpa;
        assert!(gave_up || all.is_empty() && answer == Ok(Answer::Unreachable), "{answer:?}: {}", text());
        return;
    };
    let path = match answer {
        Answer::Found(path) if !asked.are_nearest => path,
        Answer::Nearest(path) if asked.are_nearest => path,
        other => panic!("{other:?}: {}", text()),
    };
    let ends = (start(path), end(path));
    world.check_path(setup, path, ends, asked);
    if is_exact(planner) {
        let is_shortest = |pair: &&Pair| pair.cost < shortest + TIE;
        let is_first = |pair: &&Pair| !asked.is_any() || (pair.start, pair.goal) == ends;
        let best = all.iter().find(|pair| is_shortest(pair) && is_first(pair)).expect("a shortest");
        assert_eq!(ends, (best.start, best.goal), "{path}, not {best:?}: {}", text());
        assert!(
            (path.cost() - best.cost).abs() < 1e-9 * (1.0 + best.cost),
            "{path}, not {best:?}: {}",
            text()
        );
    } else {
        assert!(all.iter().any(|pair| (pair.start, pair.goal) == ends), "{path}: {}", text());
    }
    let alone = planner.find(Query::new(ends.0, ends.1)).expect("both ends are free");
    if !asked.is_any() {
        assert_eq!(alone.path(), Some(path), "the path between these two ends: {}", text());
    }
    check_limited(world, setup, planner, asked, (&all, shortest));
}

/// Checks what is known of a search before its end: it is between pairs of ends then, or has found some path.
fn check_limited(
    world: &World,
    setup: Setup,
    planner: &mut Planner,
    asked: &Asked,
    (pairs, shortest): (&[Pair], f64),
) {
    let text = || world.text(setup, asked);
    let is_exact = is_exact(planner);
    // Over segments the oracle's paths are the shortest at any angle.
    let is_bound = |bound: f64| !is_exact && !world.over_segments || bound <= shortest * (1.0 + 1e-9);
    planner.begin(asked.query.clone()).expect("the ends were checked");
    let mut last = 0.0;
    while let Ok(None) = planner.step(3) {
        let (bound, best) = (planner.lower_bound(), planner.best().expect("a search was begun"));
        assert!(is_bound(bound) && bound >= last - 1e-9, "a bound of {bound} after {last}: {}", text());
        last = bound;
        let ends = (start(&best), end(&best));
        assert!(pairs.iter().any(|pair| pair.start == ends.0), "{best}: {}", text());
        world.check_path(setup, &best, ends, asked);
    }
    let answer = planner.finish().expect("it was found before");
    for limit in [shortest * (1.0 - 1e-6), shortest, shortest * (1.0 + 1e-6)] {
        let query = asked.query.clone().within(Limits::new().cost(limit));
        let limited = planner.find(query);
        if is_exact && limit < shortest {
            let Ok(Answer::Stopped(stopped)) = limited else { panic!("{limited:?}: {}", text()) };
            assert_eq!(stopped.by, Limit::Cost, "{}", text());
            assert!(is_bound(stopped.lower_bound), "{stopped:?}: {}", text());
            assert!(stopped.lower_bound > limit * (1.0 - 1e-6), "{stopped:?}: {}", text());
            assert!(stopped.best.cost() <= limit * (1.0 + 1e-9), "{stopped:?}: {}", text());
            if pairs.len() < 7 && !asked.is_any() {
                check_nearest_of_pairs(world, setup, planner, (pairs, limit), &stopped.best);
            }
        } else if is_exact {
            match (&limited, asked.is_any()) {
                (Ok(Answer::Found(path)), true) => {
                    assert!((path.cost() - shortest).abs() < 1e-9 * (1.0 + shortest), "{}", text());
                }
                _ => assert_eq!(limited.as_ref(), Ok(&answer), "{}", text()),
            }
        }
    }
}

/// Checks that the best path so far comes as near to a goal as that of any pair alone.
fn check_nearest_of_pairs(
    world: &World,
    setup: Setup,
    planner: &mut Planner,
    (pairs, limit): (&[Pair], f64),
    best: &Path,
) {
    let distance = |path: &Path| pairs.iter().map(|pair| world.distance(end(path), pair.goal)).min();
    let alone = pairs.iter().map(|pair| {
        let ends = Ends::new(pair.start, pair.goal);
        match planner.find(ends.within(Limits::new().cost(limit))) {
            Ok(Answer::Stopped(stopped)) => world.distance(end(&stopped.best), pair.goal),
            answer => panic!("{answer:?}: {}", world.text(setup, pair)),
        }
    });
    assert!(distance(best) <= alone.min(), "{best}: {}", world.text(setup, &(pairs, limit)));
}

/// The vertices nearest to one of the goals, among those that can be reached, row by row.
fn nearest(world: &World, starts: &[Vertex], goals: &[Vertex]) -> Vec<Vertex> {
    let distance = |at: Vertex| goals.iter().map(|&goal| world.distance(at, goal)).min();
    let costs: Vec<_> = starts.iter().map(|&start| world.oracle.costs_from(start)).collect();
    let is_reached = |at: &Vertex| costs.iter().any(|costs| costs.to(*at).is_some());
    let all: Vec<Vertex> = world.oracle.free_vertices().filter(is_reached).collect();
    let least = all.iter().map(|&at| distance(at)).min();
    all.into_iter().filter(|&at| Some(distance(at)) == least).collect()
}

pub(super) fn blocked(world: &World, rng: &mut Rng) -> Option<Vertex> {
    let placement = world.space.motion().rules.placement();
    (0..40).map(|_| random_vertex(rng, &world.grid, placement)).find(|&at| !world.space.is_free(at))
}

/// A query for the vertices nearest to these goals, if none of them can be reached; also where a tolerance
/// is asked for that holds no other vertex.
pub(super) fn asked_nearest(world: &World, starts: Vec<Vertex>, goals: Vec<Vertex>) -> Asked {
    let query = Query::between(starts.clone(), goals.clone()).nearest();
    let has_tolerance = goals.len() == 1 && (starts[0].x + goals[0].y) % 2 == 0;
    let query = if has_tolerance { query.tolerance(0.5) } else { query };
    let has_way = !pairs(world, &starts, &goals).is_empty();
    let goals = if has_way { goals } else { nearest(world, &starts, &goals) };
    Asked { query, starts, goals, are_nearest: !has_way }
}

#[test]
fn where_there_is_no_way_the_nearest_vertex_is_reached() {
    let nearest = on_worlds(maps(1), |world, rng| {
        let mut cases = Vec::new();
        for _ in 0..12 {
            let Some(start) = world.free(rng) else { continue };
            let others = [world.free(rng), blocked(world, rng), blocked(world, rng)];
            cases.extend(
                others.into_iter().flatten().map(|goal| asked_nearest(world, vec![start], vec![goal])),
            );
            let starts = [Some(start), world.free(rng)].into_iter().flatten().collect();
            let goals: Vec<Vertex> = others.into_iter().skip(1).flatten().collect();
            if !goals.is_empty() {
                cases.push(asked_nearest(world, starts, goals));
            }
        }
        // Some with a way, and those without: with several vertices that are equally near first.
        cases.sort_by_key(|asked| std::cmp::Reverse(if asked.are_nearest { asked.goals.len() } else { 2 }));
        cases.truncate(9);
        for (setup, mut planner) in world.planners() {
            for asked in &cases {
                check(world, setup, &mut planner, asked);
                if let (false, [start], [goal]) = (asked.are_nearest, &asked.starts[..], &asked.goals[..]) {
                    let ends = Ends::new(*start, *goal);
                    assert_eq!(planner.find(ends.nearest()), planner.find(ends));
                    assert_eq!(planner.find(ends.nearest().tolerance(0.5)), planner.find(ends));
                }
            }
        }
        cases.iter().filter(|asked| asked.are_nearest && asked.goals.len() > 1).count()
    });
    assert!(nearest.iter().sum::<usize>() > 20, "{nearest:?}");
}

/// The first row by row of the vertices that are equally near and equally far, by every engine; also where a
/// tolerance is asked for, which the searches from all goals at once serve.
#[test]
fn of_the_nearest_vertices_the_first_is_reached() {
    let space =
        Map::from_rows(["...", "#.#"]).expect("a map").space(Motion::centers(K::N8)).expect("a space");
    let ends = Ends::new((0, 0), (2, 1));
    for setup in
        Setup::all(Motion::new(K::N8, space.motion().rules)).filter(|setup| setup.smoothing.is_none())
    {
        let mut planner = setup.prepare(&space).expect("an index").planner();
        if !is_exact(&planner) {
            continue;
        }
        for query in [ends.nearest(), ends.nearest().tolerance(0.5)] {
            let answer = planner.find(query).expect("the goal may be blocked");
            let Answer::Nearest(path) = answer else { panic!("{setup}: {answer:?}") };
            assert_eq!(end(&path), (2, 0).into(), "{setup}");
        }
    }
}

/// Where corners are always cut, segments connect what N(2) does not, and so do several ends and limits.
#[test]
fn segments_between_two_blocked_cells_are_paths() {
    let rules = Rules::Center(CornerRule::Always);
    let map = Map::from_rows([".#...", "#....", "....."]).expect("a map");
    let space = map.space(Motion::new(K::N4, rules)).expect("a space");
    for engine in [Engine::Theta, Engine::LazyTheta] {
        let mut planner = space.planner(engine).expect("a planner");
        let near = Ends::new((0, 0), (1, 1));
        assert!(space.sees(near.start, near.goal));
        for query in [Query::from(near), near.nearest(), near.tolerance(0.5)] {
            let answer = planner.find(query).expect("free ends");
            assert_eq!(answer, Answer::Found(Path::new(vec![near.start, near.goal])), "{engine}");
        }
        // The goal that is nearest is one to which N(2) has no path.
        let query = Query::between([(0, 0)], [(4, 2), (1, 1)]).within(Limits::new().expansions(0));
        let Ok(Answer::Stopped(stopped)) = planner.find(query) else { panic!("{engine}: not stopped") };
        assert!(stopped.lower_bound <= 2_f64.sqrt(), "{engine}: {stopped:?}");
        let answer = planner.find(Query::between([(0, 0)], [(4, 2), (1, 1)])).expect("free ends");
        assert_eq!(answer.path().map(end), Some((1, 1).into()), "{engine}");
        // Moves of N(2) lead nowhere.
        let alone = space.planner(Engine::AStar).expect("a planner").find(near);
        assert_eq!(alone, Ok(Answer::Unreachable), "{engine}");
    }
    // Nor do they where they are smoothed afterwards.
    let smoothed =
        Setup { smoothing: Some(Smoothing::Taut), ..Setup::new(Engine::AStar, Motion::new(K::N4, rules)) };
    let mut planner = smoothed.prepare(&space).expect("an index").planner();
    let answer = planner.find(Query::new((0, 0), (1, 1)).nearest()).expect("free ends");
    assert_eq!(answer, Answer::Nearest(Path::new(vec![(0, 0).into()])));
}

#[test]
fn of_several_ends_the_best_are_chosen() {
    on_worlds(maps(1), |world, rng| {
        for (setup, mut planner) in world.planners() {
            let some = |rng: &mut Rng| -> Vec<Vertex> {
                (0..1 + rng.below(4)).filter_map(|_| world.free(rng)).collect()
            };
            let (mut starts, goals) = (some(rng), some(rng));
            if starts.is_empty() {
                continue;
            }
            if rng.chance(20) {
                starts.push(starts[0]);
            }
            let query = Query::between(starts.clone(), goals.clone());
            check(world, setup, &mut planner, &Asked { query, starts, goals, are_nearest: false });
        }
    });
}

/// Of two goals the one that may be nearer is searched first, the other as long as it may be better.
#[test]
fn what_cannot_be_the_best_is_not_searched() {
    let searched = on_worlds(maps(1), |world, rng| {
        let mut searched = 0;
        for (setup, mut planner) in world.planners() {
            let draws = (0..12).filter_map(|_| Some((world.free(rng)?, world.free(rng)?, world.free(rng)?)));
            // The bound that orders the pairs: h_k, or for any-angle paths the straight line.
            let is_first = |start: Vertex, [first, second]: [Vertex; 2]| {
                let straight = start.to(first).norm_squared() < start.to(second).norm_squared();
                straight && world.least(start, first) < world.least(start, second)
            };
            for (start, first, second) in draws {
                let goals = [first, second];
                if pairs(world, &[start], &goals).len() < 2 || !is_first(start, goals) {
                    continue;
                }
                let expansions = |planner: &mut Planner, query: Query| {
                    let cost = planner.find(query).ok().and_then(|answer| answer.cost());
                    (cost, planner.expansions())
                };
                let both = expansions(&mut planner, Query::between([start], [second, first])).1;
                let (Some(cost), alone) = expansions(&mut planner, Query::between([start], [first])) else {
                    continue;
                };
                // The costs of smoothed paths are not those of the search.
                if setup.smoothing.is_some() {
                    continue;
                }
                let is_optimal = matches!(planner.guarantee(), Guarantee::Optimal(_));
                let straight = start.distance(second);
                let least = if is_optimal { world.least(start, second) } else { straight };
                if least > cost + TIE {
                    assert_eq!(both, alone, "{}", world.text(setup, &(start, goals)));
                }
                let rest =
                    expansions(&mut planner, Query::new(start, second).within(Limits::new().cost(cost))).1;
                assert!(both <= alone + rest, "{}", world.text(setup, &(start, goals)));
                searched += u64::from(rest > 0);
            }
        }
        searched
    });
    assert!(searched.iter().sum::<u64>() > 200, "{searched:?}");
}

/// A map and its mirror image, side by side: to two goals that are images of each other, paths from the
/// middle are equally long, and some vertices are equally near.
#[test]
fn ties_are_decided_by_the_order_of_the_ends() {
    let ties = on_all_cores(maps(1), |seed| {
        let rng = &mut Rng::new(seed);
        let motion = motion(seed);
        let half = random_grid(rng, if motion.k == K::Any { 5 } else { 9 });
        // The middle is a column of vertices.
        let (width, extra) = (half.width(), u32::from(motion.rules.placement() == PlacementKind::Center));
        let whole = 2 * width - extra;
        let mirrored = |x: u32| if x < width { x } else { whole - 1 - x };
        let is_blocked = |x: u32, y: u32| half.is_blocked(mirrored(x) as i32, y as i32);
        let grid = Grid::from_fn(whole, half.height(), is_blocked).expect("a small map");
        let world = World::new(seed, grid, motion);
        let (columns, last) = world.size();
        let middle = columns / 2;
        let image = |at: Vertex| Vertex::new(columns - 1 - at.x, at.y);
        let on_axis: Vec<Vertex> =
            (0..last).map(|y| Vertex::new(middle, y)).filter(|&at| world.space.is_free(at)).collect();
        let mut ties = 0;
        for (setup, mut planner) in world.planners() {
            let Some((&at, goal)) = rng.pick(&on_axis).zip(world.free(rng)) else { continue };
            let goals = vec![image(goal), goal];
            if pairs(&world, &[at], &goals).len() < 2 {
                continue;
            }
            ties += usize::from(goal.x != middle);
            for goals in [goals.clone(), vec![goal, image(goal)]] {
                let query = Query::between([at], goals.clone());
                let asked = Asked { query, starts: vec![at], goals: goals.clone(), are_nearest: false };
                check(&world, setup, &mut planner, &asked);
                let query = Query::between(goals.clone(), [at]);
                let asked = Asked { query, starts: goals, goals: vec![at], are_nearest: false };
                check(&world, setup, &mut planner, &asked);
            }
            if let Some(wall) = blocked(&world, rng).filter(|_| rng.chance(50)) {
                check(&world, setup, &mut planner, &asked_nearest(&world, vec![at], vec![wall, image(wall)]));
            }
        }
        ties
    });
    assert!(ties.iter().sum::<usize>() > 100, "{ties:?}");
}

#[test]
fn a_tolerance_is_the_radius_of_a_disc() {
    on_worlds(maps(1), |world, rng| {
        for (setup, mut planner) in world.planners() {
            let Some((start, goal)) = world.free(rng).zip(world.free(rng)) else { continue };
            let goal = if rng.chance(50) { blocked(world, rng).unwrap_or(goal) } else { goal };
            for radius in [0.0, 0.5, 1.0, 1.5, 3.7, 1e9] {
                let query = Query::new(start, goal).tolerance(radius);
                // The square of a radius is exact enough: no integer is as near to 3.7² as its rounding.
                let is_near = |at: &Vertex| at.to(goal).norm_squared() as f64 <= radius * radius;
                let goals: Vec<Vertex> = world.oracle.free_vertices().filter(is_near).collect();
                if goals.is_empty() {
                    let error = Err(QueryError::Blocked { end: End::Goal, at: goal.into() });
                    assert_eq!(planner.find(query.clone()), error, "{}", world.text(setup, &query));
                    if radius > 1.0 {
                        let query = query.nearest();
                        let goals = nearest(world, &[start], &[goal]);
                        let asked = Asked { query, starts: vec![start], goals, are_nearest: true };
                        check(world, setup, &mut planner, &asked);
                    }
                } else {
                    let asked = Asked { query, starts: vec![start], goals, are_nearest: false };
                    check(world, setup, &mut planner, &asked);
                }
            }
            // Discs around two goals.
            let other = world.free(rng).unwrap_or(goal);
            let disc =
                |goal: Vertex| world.oracle.free_vertices().filter(move |at| at.to(goal).norm_squared() <= 4);
            if disc(goal).next().is_some() {
                let query = Query::between([start], [other, goal]).tolerance(2.0);
                let goals = disc(other).chain(disc(goal)).collect();
                check(
                    world,
                    setup,
                    &mut planner,
                    &Asked { query, starts: vec![start], goals, are_nearest: false },
                );
            }
        }
    });
}

/// Straight to one goal, around a corner to the other: both paths are 4 · √10 long, but the sum of two
/// rounded lengths is not that of the whole.
#[test]
fn paths_at_any_angle_can_be_equally_long_in_different_pieces() {
    let block = |x: u32, y: u32| x < 6 && y >= 2;
    let grid = Grid::from_fn(13, 9, block).expect("a map");
    let motion = motions().into_iter().find(|motion| motion.k == K::Any).expect("there are two");
    let world = World::new(0, grid, motion);
    let (start, straight, bent) = (Vertex::new(0, 0), Vertex::new(12, 4), Vertex::new(8, 8));
    for (setup, mut planner) in world.planners() {
        for goals in [vec![straight, bent], vec![bent, straight]] {
            let query = Query::between([start], goals.clone());
            let asked = Asked { query, starts: vec![start], goals, are_nearest: false };
            check(&world, setup, &mut planner, &asked);
        }
    }
}
