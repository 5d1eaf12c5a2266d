//! A robot uncovers a map: D* Lite beside new searches. `cargo bench -p mediant-bench --bench replanning`
//! writes the tables of `docs/measurements/replanning.md`.
//!
//! The robot begins with a map on which all cells are free, or with an outdated one. After each move it sees
//! the cells within its radius, also behind walls, and follows its path until that is blocked. All engines
//! answer the same queries; a new search makes what it needs of the map anew. Nothing counts that is not
//! checked: the exact costs are compared.
#![allow(clippy::print_stdout, reason = "a program talks to its user")]
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "a measurement may fail")]

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use mediant_grid::{Centers, Change, CornerRule, FreeSpace, Grid, GridGraph};
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::{Rng, noise};
use mediant_search::{
    AStar, Answer, BlockJps, Canonical, CanonicalRule, Counters, DStarLite, Ends, Hk, LpaStar, Path, Planner,
    Pruning,
};

const SIDE: u32 = 512;
/// Each way is gone so many times, and of each call the shortest time counts.
const PASSES: usize = 3;

/// Rooms of 20 × 20 cells with walls one cell thick, each with a door of two cells.
fn rooms(rng: &mut Rng) -> Grid {
    let pitch = 21;
    let doors: Vec<[u32; 2]> = (0..25 * 25).map(|_| [rng.below(19), rng.below(19)]).collect();
    let is_wall = |x: u32, y: u32| {
        let ((column, x), (row, y)) = ((x / pitch, x % pitch), (y / pitch, y % pitch));
        let [across, down] = doors[((row * 25 + column) as usize).min(doors.len() - 1)];
        let is_door = |at: u32, door: u32| at == door || at == door + 1;
        x == 20 && !is_door(y, across) || y == 20 && !is_door(x, down)
    };
    Grid::from_fn(SIDE, SIDE, is_wall).unwrap()
}

/// Open ground with 60 walls, one cell thick and 20 to 80 cells long.
fn walls(rng: &mut Rng) -> Grid {
    let walls: Vec<_> =
        (0..60).map(|_| (rng.below(SIDE), rng.below(SIDE), 20 + rng.below(61), rng.chance(50))).collect();
    let is_wall = |x: u32, y: u32| {
        walls.iter().any(|&(left, top, length, is_across)| {
            let (along, across, first, at) = if is_across { (x, y, left, top) } else { (y, x, top, left) };
            across == at && (first..first + length).contains(&along)
        })
    };
    Grid::from_fn(SIDE, SIDE, is_wall).unwrap()
}

/// The calls of one engine.
#[derive(Clone, Debug, Default)]
struct Calls {
    times: Vec<Duration>,
    expanded: u64,
}

impl Calls {
    /// Times an answer. Returns it with the exact cost of its path.
    fn time(&mut self, answer: impl FnOnce(&mut Counters) -> Answer) -> (Answer, Option<Cost>) {
        let (mut counters, begin) = (Counters::default(), Instant::now());
        let answer = answer(&mut counters);
        self.times.push(begin.elapsed());
        self.expanded += counters.expanded;
        let cost = answer.path().map(exact);
        (answer, cost)
    }

    /// Of each call the shorter time.
    fn shorten(&mut self, other: &Self) {
        assert_eq!((self.times.len(), self.expanded), (other.times.len(), other.expanded));
        self.times.iter_mut().zip(&other.times).for_each(|(time, other)| *time = (*time).min(*other));
    }

    fn millis(&self) -> f64 {
        self.times.iter().sum::<Duration>().as_secs_f64() * 1e3 / self.times.len().max(1) as f64
    }

    /// Milliseconds and expansions a call.
    fn text(&self) -> String {
        if self.times.is_empty() {
            return "– | –".into();
        }
        format!("{:.2} | {:.0}", self.millis(), self.expanded as f64 / self.times.len() as f64)
    }
}

fn exact(path: &Path) -> Cost {
    path.waypoints().windows(2).fold(Cost::ZERO, |cost, ends| {
        let v = ends[0].to(ends[1]);
        let times = v.gcd();
        cost + Cost::of_move((v.x / times as i32, v.y / times as i32).into()) * times
    })
}

/// A way of the robot: how often its map changed, by how many cells, how often that blocked its path, how
/// often it needed a new one; and the engines.
#[derive(Debug, Default)]
struct Run {
    changes: u32,
    cells: usize,
    blocked: u32,
    replans: u32,
    /// The edit of the map, its free space and its grid graph, which all engines need.
    edit: Calls,
    first: Calls,
    /// D* Lite at every change, and only where a new path was needed.
    always: Calls,
    robot: Calls,
    astar: Calls,
    canonical: Calls,
    jps: Calls,
}

impl Run {
    fn calls(&mut self) -> [&mut Calls; 7] {
        let Self { edit, first, always, robot, astar, canonical, jps, .. } = self;
        [edit, first, always, robot, astar, canonical, jps]
    }
}

/// Leads a robot through a map. New searches are timed at each `every`-th time that a new path is needed.
fn lead(map: &Grid, known: &Arc<Grid>, ends: Ends, k: FiniteK, radius: i32, every: u32) -> Run {
    let mut run = Run::default();
    let rule = Arc::new(CanonicalRule::<Centers>::new(k, CornerRule::Never));
    let mut space = FreeSpace::<Centers>::new(Arc::clone(known), CornerRule::Never);
    let mut graph = Arc::new(GridGraph::in_space(&space, k).unwrap());
    let mut astar = AStar::new(Arc::clone(&graph), Hk);
    let (mut robot, mut always) =
        (DStarLite::new(Arc::clone(&graph), ends), DStarLite::new(Arc::clone(&graph), ends));
    let (answer, _) = run.first.time(|counters| robot.path_observed(counters).unwrap());
    always.path().unwrap();
    let mut path = answer.into_path().unwrap();
    let (mut at, mut untold) = (ends.start, Change::new(Arc::clone(space.grid())));
    loop {
        let known = Arc::clone(space.grid());
        let disc = (-radius..=radius).flat_map(|dy| (-radius..=radius).map(move |dx| (dx, dy)));
        let seen = disc
            .filter(|(dx, dy)| dx * dx + dy * dy <= radius * radius)
            .map(|(dx, dy)| (at.x + dx, at.y + dy));
        let is_new = |&(x, y): &(i32, i32)| {
            let is_inside = [x, y].iter().all(|at| (0..SIDE as i32).contains(at));
            is_inside && map.is_blocked(x, y) != known.is_blocked(x, y)
        };
        let new: Vec<_> =
            seen.filter(is_new).map(|(x, y)| (x as u32, y as u32, map.is_blocked(x, y))).collect();
        if !new.is_empty() {
            run.changes += 1;
            run.cells += new.len();
            let begin = Instant::now();
            let change = Change::new(Arc::clone(&known)).edit_cells(new);
            space = space.after(&change);
            graph = Arc::new(GridGraph::in_space(&space, k).unwrap());
            run.edit.times.push(begin.elapsed());
            untold = untold.then(change.clone()).unwrap();
            let (_, cost) = run.always.time(|counters| {
                always.move_to(at);
                always.change(Arc::clone(&graph), &change);
                always.path_observed(counters).unwrap()
            });
            let is_blocked = path.check(&space).is_err();
            run.blocked += u32::from(is_blocked);
            // Cells that became free may have made a shorter way.
            if is_blocked || cost != Some(exact(&path)) {
                run.replans += 1;
                let (answer, by_robot) = run.robot.time(|counters| {
                    robot.move_to(at);
                    robot.change(Arc::clone(&graph), &untold);
                    robot.path_observed(counters).unwrap()
                });
                untold = Change::new(Arc::clone(space.grid()));
                assert_eq!(by_robot, cost);
                if run.replans % every == 0 {
                    search_anew(&mut run, &graph, &rule, &mut astar, Ends::new(at, ends.goal), cost);
                }
                path = answer.into_path().unwrap();
            }
        }
        let Some(next) = path.vertices().nth(1) else { return run };
        path = path.rest(next).unwrap();
        at = next;
    }
}

/// The same query by new searches.
fn search_anew(
    run: &mut Run,
    graph: &Arc<GridGraph<Centers>>,
    rule: &Arc<CanonicalRule<Centers>>,
    astar: &mut AStar<Arc<GridGraph<Centers>>, Hk>,
    ends: Ends,
    cost: Option<Cost>,
) {
    let (_, by_astar) = run.astar.time(|counters| {
        astar.follow(Arc::clone(graph));
        astar.solve_observed(ends, counters).unwrap()
    });
    assert_eq!(by_astar, cost);
    let (_, by_canonical) = run.canonical.time(|counters| {
        let pruning = Arc::new(Pruning::with_rule(graph, Arc::clone(rule)).unwrap());
        let mut canonical = Canonical::with_pruning(Arc::clone(graph), pruning, Hk).unwrap();
        canonical.solve_observed(ends, counters).unwrap()
    });
    assert_eq!(by_canonical, cost);
    if graph.k() == FiniteK::N8 {
        let (_, by_jps) = run.jps.time(|counters| {
            BlockJps::new(Arc::clone(graph), Hk).unwrap().solve_observed(ends, counters).unwrap()
        });
        assert_eq!(by_jps, cost);
    }
}

/// The first seed whose map has a way between two opposite corners, which are free.
fn map(make: impl Fn(&mut Rng) -> Grid) -> (Grid, Ends) {
    let ends = Ends::new((5, 5), (SIDE as i32 - 6, SIDE as i32 - 6));
    let has_way = |grid: &Grid| {
        let space = FreeSpace::<Centers>::new(Arc::new(grid.clone()), CornerRule::Never);
        space.connected(ends.start, ends.goal)
    };
    let mut maps = (0..).map(|seed| make(&mut Rng::new(seed)));
    (maps.find(has_way).unwrap(), ends)
}

/// LPA* after changes of so many random cells anywhere, beside A*: how much may change.
fn scatter(map: &Grid, ends: Ends, k: FiniteK, count: usize) -> [Calls; 2] {
    let mut rng = Rng::new(5);
    let mut space = FreeSpace::<Centers>::new(Arc::new(map.clone()), CornerRule::Never);
    let mut graph = Arc::new(GridGraph::in_space(&space, k).unwrap());
    let mut astar = AStar::new(Arc::clone(&graph), Hk);
    let mut lpa = LpaStar::new(Arc::clone(&graph), ends);
    lpa.path().unwrap();
    let (mut by_lpa, mut by_astar) = (Calls::default(), Calls::default());
    for _ in 0..if count > 100 { 5 } else { 20 } {
        let grid = Arc::clone(space.grid());
        // As many cells become blocked as free, so that the map stays as it is.
        let mut cells = Vec::new();
        while cells.len() < count {
            let (x, y) = (rng.below(SIDE), rng.below(SIDE));
            let is_end = [ends.start, ends.goal].contains(&(x as i32, y as i32).into());
            let blocked = grid.is_blocked(x as i32, y as i32);
            if !is_end && blocked == (cells.len() % 2 == 1) {
                cells.push((x, y, !blocked));
            }
        }
        let change = Change::new(grid).edit_cells(cells);
        space = space.after(&change);
        graph = Arc::new(GridGraph::in_space(&space, k).unwrap());
        let (_, cost) = by_lpa.time(|counters| {
            lpa.change(Arc::clone(&graph), &change);
            lpa.path_observed(counters).unwrap()
        });
        astar.follow(Arc::clone(&graph));
        let (_, by_new) = by_astar.time(|counters| astar.solve_observed(ends, counters).unwrap());
        assert_eq!(by_new, cost);
    }
    [by_lpa, by_astar]
}

/// The map with one cell in 100 wrong.
fn outdated(map: &Grid) -> Grid {
    let mut rng = Rng::new(9);
    let is_wrong: Vec<bool> = (0..SIDE * SIDE).map(|_| rng.chance(1)).collect();
    let is_blocked = |x: u32, y: u32| map.is_blocked(x as i32, y as i32) != is_wrong[(y * SIDE + x) as usize];
    Grid::from_fn(SIDE, SIDE, is_blocked).unwrap()
}

fn main() {
    let maps =
        [("noise", map(|rng| noise(rng, SIDE, SIDE, 20))), ("rooms", map(rooms)), ("walls", map(walls))];
    println!("| map | k | cells | LPA* | exp. | A* | exp. |\n|---|{}", "--:|".repeat(6));
    for (name, (map, ends)) in &maps {
        for (k, count) in (3..=7).step_by(2).flat_map(|k| [1, 10, 100, 1_000, 5_000].map(|count| (k, count)))
        {
            let scatter = || scatter(map, *ends, FiniteK::new(k).unwrap(), count);
            let mut calls = scatter();
            for _ in 1..PASSES {
                calls.iter_mut().zip(&scatter()).for_each(|(calls, other)| calls.shorten(other));
            }
            println!("| {name} | {k} | {count} | {} |", calls.map(|calls| calls.text()).join(" | "));
        }
    }
    println!(
        "\n| map | k | radius | changes | cells | blocked | replans | edit | first | exp. | D* Lite, every \
         change | exp. | D* Lite | exp. | A* | exp. | canonical | exp. | jps-block | exp. |"
    );
    println!("|---|{}", "--:|".repeat(19));
    for is_outdated in [false, true] {
        for (name, (map, ends)) in &maps {
            let known =
                if is_outdated { outdated(map) } else { Grid::from_fn(SIDE, SIDE, |_, _| false).unwrap() };
            let (known, name) =
                (Arc::new(known), format!("{name}{}", if is_outdated { ", outdated" } else { "" }));
            for (k, radius) in (3..=7).flat_map(|k| [10, 25, 50].map(|radius| (k, radius))) {
                let every = if is_outdated { 1 } else { 4 };
                let lead = || lead(map, &known, *ends, FiniteK::new(k).unwrap(), radius, every);
                let mut run = lead();
                for _ in 1..PASSES {
                    let mut other = lead();
                    run.calls()
                        .into_iter()
                        .zip(other.calls())
                        .for_each(|(calls, other)| calls.shorten(other));
                }
                let (cells, edit) = (run.cells as f64 / f64::from(run.changes.max(1)), run.edit.millis());
                let engines = run.calls().map(|calls| calls.text())[1..].join(" | ");
                println!(
                    "| {name} | {k} | {radius} | {} | {cells:.0} | {} | {} | {edit:.3} | {engines} |",
                    run.changes, run.blocked, run.replans,
                );
            }
        }
    }
}
