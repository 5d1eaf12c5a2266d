//! Repaired planes against new ones, through chains of random edits.

use std::{collections::BTreeSet, sync::Arc};

use mediant_grid::{
    Centers, Change, CornerRule, Corners, DiagonalGap, Grid, GridGraph, Interrupt, Placement, Rectangle,
    Rules, Vertex, uninterrupted,
};
use mediant_moves::FiniteK;
use mediant_oracle::{Rng, caves, describe, noise, random_free_vertex, rooms, seeds, suite_grid, wide_grid};

use super::{Repair, Stop};
use crate::{
    AStar, BlockJps, Ends, Hk, JumpError, Planner,
    canonical::Pruning,
    jps::{
        BlockFinder,
        axial::{AxialStops, JumpPoint},
        dead_ends::{DeadEndRows, REACH},
        diagonals::DiagonalStops,
        planes::{JumpPlanes, PlaneRows},
        stop_rows::Leads,
        zone::Zone,
    },
};

mod tables;

fn grid(seed: u64) -> Grid {
    let rng = &mut Rng::new(seed);
    match seed % 8 {
        0 => suite_grid(seed).0,
        1 => wide_grid(seed).0,
        2 => rooms(rng, 70, 40),
        3 => rooms(rng, 127, 9),
        4 => caves(rng, 66, 50),
        5 => noise(rng, 64, 63, 1),
        6 => noise(rng, 1, 130, 5),
        _ => {
            let percent = 2 + rng.below(35);
            noise(rng, 70, 45, percent)
        }
    }
}

/// A random edit: single cells, scattered ones, rectangles, and seldom all cells.
fn edit(rng: &mut Rng, map: &Arc<Grid>) -> Change {
    let change = Change::new(Arc::clone(map));
    let (width, height) = (map.width(), map.height());
    let flipped = |x: u32, y: u32| map.is_free(x as i32, y as i32);
    let cell = |rng: &mut Rng| (rng.below(width), rng.below(height));
    match rng.below(12) {
        0..=5 => {
            let (x, y) = cell(rng);
            change.edit_cells([(x, y, flipped(x, y))])
        }
        6 | 7 => {
            let cells: Vec<_> = (0..2 + rng.below(20)).map(|_| cell(rng)).collect();
            change.edit_cells(cells.into_iter().map(|(x, y)| (x, y, flipped(x, y))))
        }
        8 | 9 => {
            let at = Rectangle::spanning(cell(rng), cell(rng));
            let (at, blocked) = (Rectangle { width: at.width.min(9), ..at }, rng.chance(50));
            change.edit(at, |_, _| blocked)
        }
        10 => {
            // Two edits of which the second may undo the first.
            let (x, y) = cell(rng);
            let at = Rectangle::new(x, y, 3, 3);
            let percent = rng.below(100);
            change.edit(at, |_, _| rng.chance(percent)).edit(Rectangle::new(x, y, 2, 3), |_, _| false)
        }
        _ => {
            let percent = [0, 5, 20, 100][rng.below(4) as usize];
            change.edit(Rectangle::new(0, 0, width, height), |_, _| rng.chance(percent))
        }
    }
}

/// A test of the chain of maps from a seed, under one rule of motion.
trait Test {
    fn on<P: Placement>(&mut self, rule: P::Rule, k: u32, seed: u64);
}

fn on_all(seeds: std::ops::Range<u64>, test: &mut impl Test) {
    for (seed, k) in seeds.flat_map(|seed| [(seed, 2), (seed, 3)]) {
        for rules in Rules::ALL {
            match rules {
                Rules::Center(corners) => test.on::<Centers>(corners, k, seed),
                Rules::Corner(gap) | Rules::CenterGap(gap) => test.on::<Corners>(gap, k, seed),
            }
        }
    }
}

fn graph<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, k: u32) -> GridGraph<P> {
    GridGraph::new(Arc::clone(grid), FiniteK::new(k).unwrap(), rule).unwrap()
}

fn planes<P: Placement>(graph: &GridGraph<P>, pruning: &Pruning<P>, reach: u32) -> JumpPlanes {
    uninterrupted(|never| {
        JumpPlanes::with_dead_ends(graph, pruning, AxialStops::new(graph, never)?, reach, never)
    })
}

/// Repaired planes are new ones, bit by bit, but for dead ends that they do not know; whatever the reach.
/// Each repair is one of a repair, and works on the memory of versions that were dropped.
#[derive(Default)]
struct Planes {
    repaired: u64,
    anew: u64,
    /// The dead ends of repaired planes, and of new ones.
    dead_ends: u64,
    of_new_ones: u64,
    /// The same of planes that were made anew.
    kept: u64,
    of_new: u64,
    /// The marks that ceased to be, and that came to be.
    gone: u64,
    come: u64,
}

impl Test for Planes {
    fn on<P: Placement>(&mut self, rule: P::Rule, k: u32, seed: u64) {
        let (rng, never) = (&mut Rng::new(seed), &Interrupt::NEVER);
        let mut map = Arc::new(grid(seed));
        let reach = [0, REACH, 0, 1, 3, 8][rng.below(6) as usize];
        let first = graph::<P>(&map, rule, k);
        let mut is = planes(&first, &Pruning::new(&first), reach);
        for step in 0..20 {
            let change = edit(rng, &map);
            let graph = graph::<P>(change.after(), rule, k);
            let pruning = Pruning::new(&graph);
            let new = planes(&graph, &pruning, reach);
            let case = || {
                let at = Vertex::default();
                let name = describe(change.before(), P::rules(rule), at, at, seed);
                format!("step {step}, k = {k}, reach {reach}, {:?}, {name}", change.cells())
            };
            let stops = (&is.axial, &is.diagonals, reach);
            let repair = || Repair::new(&graph, pruning.table().unwrap(), stops, never).without_limit();
            if step % 4 == 0 {
                self.made_anew(&graph, &pruning, repair().anew(&pruning, &change).unwrap(), case);
            }
            match repair().follow(&change) {
                Ok((axial, diagonals, _)) => {
                    let (known, all) = (dead_ends(&graph, &axial), dead_ends(&graph, &new.axial));
                    assert!(known.is_subset(&all), "dead ends, {}", case());
                    // With all dead ends, they are new ones.
                    let point = |&(at, quarter)| JumpPoint { at, quarter, is_dead_end: true };
                    let points: Vec<JumpPoint> = all.iter().map(point).collect();
                    assert!(axial.clone().with_jump_points(&points) == new.axial, "axial, {}", case());
                    assert!(diagonals == with_dead_ends(&graph, &pruning, &known), "diagonals, {}", case());
                    let before = dead_ends(&graph, &is.axial);
                    self.gone += before.difference(&known).count() as u64;
                    self.come += known.difference(&before).count() as u64;
                    self.dead_ends += known.len() as u64;
                    self.of_new_ones += all.len() as u64;
                    (is.axial, is.diagonals) = (axial, diagonals);
                    self.repaired += 1;
                }
                Err(stop) => {
                    assert!(stop == Stop::TooMuch && graph.has_closed_gaps() && reach > 0, "{}", case());
                    is = new;
                    self.anew += 1;
                }
            }
            map = Arc::clone(change.after());
        }
    }
}

impl Planes {
    /// Planes that were made anew, with what was known of dead ends.
    fn made_anew<P: Placement>(
        &mut self,
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        is: JumpPlanes,
        case: impl Fn() -> String,
    ) {
        let (known, new) = (dead_ends(graph, &is.axial), planes(graph, pruning, is.reach));
        let all = dead_ends(graph, &new.axial);
        assert!(known.is_subset(&all), "dead ends of new planes, {}", case());
        let point = |&(at, quarter)| JumpPoint { at, quarter, is_dead_end: true };
        let points: Vec<JumpPoint> = all.iter().map(point).collect();
        assert!(is.axial.with_jump_points(&points) == new.axial, "new axial planes, {}", case());
        assert!(is.diagonals == with_dead_ends(graph, pruning, &known), "new diagonal planes, {}", case());
        let rows = known.iter().map(|&(at, quarter)| is.dead_ends.in_row(quarter, (at.x, at.y)) & 1);
        assert_eq!(rows.sum::<u64>(), known.len() as u64, "rows of dead ends, {}", case());
        (self.kept, self.of_new) = (self.kept + known.len() as u64, self.of_new + all.len() as u64);
    }
}

fn dead_ends<P: Placement>(graph: &GridGraph<P>, axial: &AxialStops) -> BTreeSet<(Vertex, usize)> {
    let all = Zone::map::<P>(graph.grid()).vertices().flat_map(|at| (0..4).map(move |quarter| (at, quarter)));
    all.filter(|&(at, quarter)| axial.is_dead_end(at, quarter)).collect()
}

/// Dead ends in rows.
fn rows_of<P: Placement>(graph: &GridGraph<P>, dead_ends: &BTreeSet<(Vertex, usize)>) -> DeadEndRows {
    let mut rows = DeadEndRows::new(P::vertices(graph.grid()));
    dead_ends.iter().for_each(|&(at, quarter)| rows.add(at, quarter));
    rows
}

/// New diagonal planes where these are the dead ends.
fn with_dead_ends<P: Placement>(
    graph: &GridGraph<P>,
    pruning: &Pruning<P>,
    dead_ends: &BTreeSet<(Vertex, usize)>,
) -> DiagonalStops {
    let rows = rows_of(graph, dead_ends);
    uninterrupted(|never| {
        let PlaneRows { ends, leads, enters } = PlaneRows::new(graph, never)?;
        let live = Leads::new(&ends, &rows, never)?;
        DiagonalStops::new(graph, pruning, (&enters, [&leads, &live]), never)
    })
}

#[test]
fn repaired_planes_are_new_ones() {
    let mut test = Planes::default();
    on_all(seeds(8), &mut test);
    let Planes { repaired, anew, dead_ends, of_new_ones, kept, of_new, gone, come } = test;
    assert!(repaired > 1_200 && anew > 10, "{repaired} repaired, {anew} anew");
    assert!(dead_ends * 20 > of_new_ones * 19, "{dead_ends} of {of_new_ones} dead ends");
    assert!(kept * 20 > of_new * 19 && kept > 500, "{kept} of {of_new} dead ends of new planes");
    assert!(gone > 500 && come > 500, "{gone}, {come}");
}

/// Searches by a finder that was repaired again and again find what A\* finds.
#[derive(Default)]
struct Costs {
    queries: u64,
    found: u64,
    stuck_to_reach: u64,
}

impl Test for Costs {
    fn on<P: Placement>(&mut self, rule: P::Rule, k: u32, seed: u64) {
        let rng = &mut Rng::new(seed);
        let mut map = Arc::new(grid(seed));
        let first = graph::<P>(&map, rule, k);
        let never = &Interrupt::NEVER;
        let mut finder = BlockFinder::new(&first, &Pruning::new(&first)).unwrap();
        let mut for_few = BlockFinder::for_few_searches(&first, &Pruning::new(&first), never).unwrap();
        for _ in 0..20 {
            let change = edit(rng, &map);
            let graph = &graph::<P>(change.after(), rule, k);
            let pruning = Arc::new(Pruning::new(graph));
            finder = finder.repaired(graph, &pruning, &change, never).unwrap();
            // Without dead ends it is a new one in every bit.
            for_few = for_few.repaired(graph, &pruning, &change, never).unwrap();
            let anew = BlockFinder::for_few_searches(graph, &pruning, never);
            assert!(for_few.is_for_few_searches() && Ok(&for_few) == anew.as_ref(), "k = {k}, seed {seed}");
            self.stuck_to_reach += u64::from(finder != BlockFinder::new(graph, &pruning).unwrap());
            let mut jps = BlockJps::with_finder(graph, Arc::clone(&pruning), finder.clone(), Hk).unwrap();
            let mut astar = AStar::new(graph, Hk);
            for _ in 0..3 {
                let mut free = || random_free_vertex(rng, graph.grid(), P::KIND);
                let (Some(start), Some(goal)) = (free(), free()) else { continue };
                let query = Ends::new(start, goal);
                let length = |path: Option<&crate::Path>| path.map(|path| (path.cost() * 1e9).round());
                let expected = length(astar.solve(query).unwrap().path());
                let found = length(jps.solve(query).unwrap().path());
                let case = || describe(graph.grid(), P::rules(rule), start, goal, seed);
                assert_eq!(found, expected, "k = {k}, {}", case());
                self.queries += 1;
                self.found += u64::from(expected.is_some());
            }
            map = Arc::clone(change.after());
        }
    }
}

#[test]
fn repaired_finders_lose_no_path() {
    let mut test = Costs::default();
    on_all(seeds(8), &mut test);
    let Costs { queries, found, stuck_to_reach } = test;
    assert!(queries > 3_000 && found > 1_500, "{found} of {queries}");
    // Where a new finder would decide otherwise on dead ends.
    assert!(stuck_to_reach > 2, "{stuck_to_reach}");
}

/// A list of cells changes, first one of them, then two, and so on. Counts the changes that planes follow,
/// and the dead ends that are known after every eighth of these, and after every 64th change if planes are
/// made anew. No path shows when a repair is given up, nor which dead ends are not known.
#[test]
fn the_number_of_repairs_is_pinned() {
    fn repaired<P: Placement>(rule: P::Rule, k: u32) -> [usize; 3] {
        let (rng, never) = (&mut Rng::new(11), &Interrupt::NEVER);
        let map = Arc::new(caves(rng, 150, 120));
        let cells: Vec<(u32, u32)> = (0..300).map(|_| (rng.below(150), rng.below(120))).collect();
        let first = graph::<P>(&map, rule, k);
        let is = planes(&first, &Pruning::new(&first), REACH);
        let (mut known, mut known_anew) = (0, 0);
        let is_repaired = |&count: &usize| {
            let cells = cells[..count].iter().map(|&(x, y)| (x, y, map.is_free(x as i32, y as i32)));
            let change = Change::new(Arc::clone(&map)).edit_cells(cells);
            let graph = graph::<P>(change.after(), rule, k);
            let pruning = Pruning::new(&graph);
            let stops = (&is.axial, &is.diagonals, REACH);
            let repair = || Repair::new(&graph, pruning.table().unwrap(), stops, never);
            let repaired = repair().follow(&change);
            if let (Ok((axial, ..)), 0) = (&repaired, count % 8) {
                known += dead_ends(&graph, axial).len();
            }
            if count % 64 == 0 {
                known_anew += dead_ends(&graph, &repair().anew(&pruning, &change).unwrap().axial).len();
            }
            repaired.is_ok()
        };
        [(1..=cells.len()).filter(is_repaired).count(), known, known_anew]
    }
    let found = [2, 3].map(|k| {
        [
            repaired::<Centers>(CornerRule::Never, k),
            repaired::<Centers>(CornerRule::Always, k),
            repaired::<Corners>(DiagonalGap::Open, k),
            repaired::<Corners>(DiagonalGap::Closed, k),
        ]
    });
    let by_rows_and_columns = [[16, 3_279, 0], [16, 3_279, 0], [23, 506, 251], [0; 3]];
    let with_diagonals = [[23, 6_688, 0], [148, 36_785, 2_025], [26, 1_616, 537], [0; 3]];
    assert_eq!(found, [by_rows_and_columns, with_diagonals]);
}

#[test]
fn changes_of_other_maps_are_refused() {
    let map = Arc::new(noise(&mut Rng::new(1), 20, 10, 20));
    let change = Change::new(Arc::clone(&map)).edit_cells([(3, 3, map.is_free(3, 3))]);
    let [before, after] =
        [change.before(), change.after()].map(|map| graph::<Centers>(map, CornerRule::Never, 3));
    let [old, new] = [&before, &after].map(Pruning::new);
    let finder = BlockFinder::new(&before, &old).unwrap();
    let never = &Interrupt::NEVER;
    let back = Change::between(Arc::clone(change.after()), Arc::clone(&map)).unwrap();
    let nothing = Change::new(Arc::clone(&map));
    let refused = |result| assert!(matches!(result, Err(JumpError::Mismatch(_))), "{result:?}");
    refused(finder.repaired(&after, &new, &back, never));
    refused(finder.repaired(&after, &old, &change, never));
    refused(finder.repaired(&before, &old, &change, never));
    refused(finder.repaired(&after, &new, &nothing, never));
    let other = graph::<Corners>(change.after(), DiagonalGap::Open, 3);
    refused(finder.repaired(&other, &Pruning::new(&other), &change, never));
    assert_eq!(finder.repaired(&before, &old, &nothing, never), Ok(finder.clone()));
    assert_eq!(finder.repaired(&after, &new, &change, never), BlockFinder::new(&after, &new));
}
