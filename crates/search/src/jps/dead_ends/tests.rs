//! Dead ends against their definition by steps, and searches that pass them against A\*.

use std::{collections::HashSet, sync::Arc};

use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, Grid, GridGraph, Placement, Vertex, VertexId, uninterrupted,
};
use mediant_moves::FiniteK;
use mediant_oracle::{Rng, describe, noise, random_free_vertex, rooms, seeds, suite_grid, wide_grid};

use super::{Band, REACH};
use crate::{
    AStar, BlockJps, Counters, Ends, Hk, JpsPlus, JumpTable, Planner, Zero,
    canonical::{Pruning, pattern_at},
    jps::{BlockFinder, Jps, axial::AxialStops, planes::JumpPlanes},
    successors::{ExpandedNode, KnownPath, Successors},
};

/// A test that runs under each rule of motion.
trait Test {
    fn on<P: Placement>(&mut self, grid: &Arc<Grid>, rule: P::Rule, k: u32, seed: u64);
}

/// Under all rules without closed gaps, at k = 2 and 3.
fn on_all(grids: impl Iterator<Item = (u64, Grid)>, test: &mut impl Test) {
    for (seed, grid) in grids {
        let grid = Arc::new(grid);
        for k in [2, 3] {
            for rule in [CornerRule::Never, CornerRule::One, CornerRule::Always] {
                test.on::<Centers>(&grid, rule, k, seed);
            }
            test.on::<Corners>(&grid, DiagonalGap::Open, k, seed);
        }
    }
}

fn grids(seeds: std::ops::Range<u64>) -> impl Iterator<Item = (u64, Grid)> {
    seeds.map(|seed| {
        let rng = &mut Rng::new(seed);
        let grid = match seed % 4 {
            0 => suite_grid(seed).0,
            1 => wide_grid(seed).0,
            2 => rooms(rng, 70, 40),
            _ => {
                let percent = 2 + rng.below(25);
                noise(rng, 70, 40, percent)
            }
        };
        (seed, grid)
    })
}

fn finder<P: Placement>(graph: &GridGraph<P>, pruning: &Pruning<P>, reach: u32) -> BlockFinder {
    BlockFinder::with_planes(graph, planes(graph, pruning, reach))
}

fn planes<P: Placement>(graph: &GridGraph<P>, pruning: &Pruning<P>, reach: u32) -> JumpPlanes {
    uninterrupted(|never| {
        JumpPlanes::with_dead_ends(graph, pruning, AxialStops::new(graph, never)?, reach, never)
    })
}

/// The definition, by steps: whether all nodes to which the forced successors of a jump point lead, and
/// all steps of diagonal jumps on the way, are within reach of it; and whether there are no such nodes.
fn ends<P: Placement>(graph: &GridGraph<P>, at: Vertex, by: usize, reach: u32) -> (bool, bool) {
    let jps = Jps::new(graph, Hk);
    let pruning = Pruning::new(graph);
    let is_near = |to: Vertex| at.x.abs_diff(to.x).max(at.y.abs_diff(to.y)) <= reach;
    let nowhere = Vertex::new(-1000, -3000);
    let (mut known, mut next, mut ends) = (HashSet::new(), vec![(at, by)], true);
    while let Some((from, by)) = next.pop() {
        let node = ExpandedNode { id: graph.id(from).unwrap(), at: from, by: Some(by) };
        let ahead = |to: Vertex| from.to(to).det(graph.step(by).vector()) == 0;
        jps.successors.for_each(graph, node, nowhere, |to| {
            // Straight on from the first one is what its dead end is not about.
            if (from, ahead(to.at)) != (at, true) && known.insert((to.at, to.by)) {
                next.push((to.at, to.by));
                ends &= is_near(to.at);
            }
            KnownPath::NONE
        });
        pruning.for_each(graph, &node, by, |odd| {
            let (mut to, v) = (from, graph.step(odd).vector());
            while odd % 2 == 1 && ends && graph.is_legal(to, v) {
                to = to + v;
                ends &= is_near(to);
            }
        });
        if !ends {
            break;
        }
    }
    (ends, known.is_empty())
}

/// Dead ends are those of the definition, and all that have no node are found.
#[derive(Default)]
struct Definition {
    dead: u64,
    with_nodes: u64,
    others: u64,
}

impl Test for Definition {
    fn on<P: Placement>(&mut self, grid: &Arc<Grid>, rule: P::Rule, k: u32, seed: u64) {
        let graph = GridGraph::<P>::new(Arc::clone(grid), FiniteK::new(k).unwrap(), rule).unwrap();
        let pruning = Pruning::new(&graph);
        let plain = uninterrupted(|never| AxialStops::new(&graph, never));
        let reach = [1, 2, 3, 5, 8, REACH][seed as usize % 6];
        let marked = planes(&graph, &pruning, reach);
        let count = graph.steps().len();
        for id in 0..graph.vertex_count() as u32 {
            let from = graph.vertex(VertexId(id));
            for quarter in (0..4).step_by(8 / count).filter(|_| graph.is_free(from)) {
                let scan = plain.scan(from, quarter, true);
                let by = quarter * count / 4;
                assert_eq!(marked.axial.scan(from, quarter, true), scan);
                let at = from + graph.step(by).vector() * scan.steps as i32;
                if !scan.found {
                    continue;
                }
                let is_dead = marked.axial.is_dead_end(at, quarter);
                let (ends, is_empty) = ends(&graph, at, by, reach);
                let case = || describe(grid, P::rules(rule), from, at, seed);
                assert!(ends || !is_dead, "no dead end, reach {reach}, k = {k}, {}", case());
                assert!(is_dead || !(ends && is_empty), "a dead end, reach {reach}, k = {k}, {}", case());
                self.dead += u64::from(is_dead);
                self.with_nodes += u64::from(is_dead && !is_empty);
                self.others += u64::from(!is_dead);
            }
        }
    }
}

#[test]
fn dead_ends_are_those_of_the_definition() {
    let mut test = Definition::default();
    on_all(grids(seeds(6)), &mut test);
    let Definition { dead, with_nodes, others } = test;
    assert!(dead > 2500 && with_nodes > 50 && others > 10_000, "{dead}, {with_nodes}, {others}");
}

/// Diagonal jumps stop where an axial jump leads on that passes dead ends, and where one leads to a dead
/// end if that counts.
#[derive(Default)]
struct Diagonals {
    compared: u64,
    passed: u64,
}

impl Test for Diagonals {
    fn on<P: Placement>(&mut self, grid: &Arc<Grid>, rule: P::Rule, k: u32, seed: u64) {
        let graph = GridGraph::<P>::new(Arc::clone(grid), FiniteK::new(k).unwrap(), rule).unwrap();
        let pruning = Pruning::new(&graph);
        let [plain, marked] = [0, REACH].map(|reach| planes(&graph, &pruning, reach));
        let last = graph.steps().len() - 1;
        let from = (0..graph.vertex_count() as u32).map(|id| graph.vertex(VertexId(id)));
        for (from, index) in from.flat_map(|from| (1..=last).step_by(2).map(move |index| (from, index))) {
            let expected = plain.diagonals.scan(from, index).next(|_| None);
            assert_eq!(marked.diagonals.scan(from, index).next(|_| Some([!0; 2])), expected);
            let (steps, _) = marked.diagonals.scan(from, index).next(|_| None);
            // Of all stops the first at which it ends, or from where an axial jump leads on.
            let mut stops = plain.diagonals.scan(from, index);
            let first = std::iter::repeat_with(|| stops.next(|_| None)).find(|&(steps, leads)| {
                let at = from + graph.step(index).vector() * steps as i32;
                let beside = [index - 1, (index + 1) & last];
                let leads_on = |(even, leads): (usize, bool)| {
                    leads && marked.axial.scan(at, even * 4 / (last + 1), false).found
                };
                let has_forced = || {
                    let by = pattern_at(&graph, at);
                    graph.id(at).is_some() && pruning.has_forced_at(by, index)
                };
                leads == [false; 2] || has_forced() || beside.into_iter().zip(leads).any(leads_on)
            });
            let case = || describe(grid, P::rules(rule), from, from, seed);
            assert_eq!(Some(steps), first.map(|(steps, _)| steps), "move {index}, k = {k}, {}", case());
            self.compared += 1;
            self.passed += u64::from(steps > expected.0);
        }
    }
}

#[test]
fn diagonals_pass_vertices_that_lead_to_dead_ends_alone() {
    let mut test = Diagonals::default();
    on_all(grids(seeds(24)), &mut test);
    let Diagonals { compared, passed } = test;
    assert!(compared > 300_000 && passed > 10_000, "{compared}, {passed}");
}

#[test]
fn bands_hold_the_same_numbers_one_by_one_and_in_words() {
    let bands = [(0, 0), (3, 5), (-70, 100), (100, 63), (100, 64), (i32::MIN, u32::MAX)];
    for (band, number) in bands.into_iter().flat_map(|band| (-300..300).map(move |n| (band, n))) {
        let band = Band { first: band.0, more: band.1 };
        for (up, sign) in [(true, 1), (false, -1)] {
            let bits = (0..64).map(|i| u64::from(band.holds(number + sign * i)) << i);
            assert_eq!(band.of(number, up), bits.sum::<u64>(), "{band:?}, {number}, {up}");
        }
    }
}

/// No search loses a path, whatever the reach, also where the goal is in a dead end.
#[derive(Default)]
struct Costs {
    queries: u64,
    expanded: [u64; 2],
    shorter: u64,
    lists: usize,
}

impl Test for Costs {
    fn on<P: Placement>(&mut self, grid: &Arc<Grid>, rule: P::Rule, k: u32, seed: u64) {
        let graph = &GridGraph::<P>::new(Arc::clone(grid), FiniteK::new(k).unwrap(), rule).unwrap();
        let pruning = Arc::new(Pruning::new(graph));
        let mut astar = AStar::new(graph, Hk);
        for reach in [1, 2, 4, REACH] {
            let with = |reach| finder(graph, &pruning, reach);
            let jps = |reach| BlockJps::with_finder(graph, Arc::clone(&pruning), with(reach), Hk).unwrap();
            let mut planners = [jps(reach), jps(0)];
            let mut zero = BlockJps::with_finder(graph, Arc::clone(&pruning), with(reach), Zero).unwrap();
            let planes = planes(graph, &pruning, reach);
            let table = uninterrupted(|never| JumpTable::from_planes(graph, &pruning, planes, never));
            self.lists += table.lists().len();
            let table = Arc::new(table);
            let mut plus = JpsPlus::with_finder(graph, Arc::clone(&pruning), table, Hk).unwrap();
            let rng = &mut Rng::new(seed ^ u64::from(reach));
            for _ in 0..12 {
                let mut free = || random_free_vertex(rng, grid, P::KIND);
                let (Some(start), Some(goal)) = (free(), free()) else { continue };
                let query = Ends::new(start, goal);
                let case = || {
                    format!("reach {reach}, k = {k}, {}", describe(grid, P::rules(rule), start, goal, seed))
                };
                let length = |path: Option<&crate::Path>| path.map(|path| (path.cost() * 1e9).round());
                let expected = length(astar.solve(query).unwrap().path());
                let before = self.expanded;
                for (planner, expanded) in planners.iter_mut().zip(&mut self.expanded) {
                    let mut counters = Counters::default();
                    let found = planner.solve_observed(query, &mut counters).unwrap();
                    assert_eq!(length(found.path()), expected, "{}", case());
                    *expanded += counters.expanded;
                }
                let [with, without] = [0, 1].map(|i| self.expanded[i] - before[i]);
                self.shorter += u64::from(with < without);
                assert_eq!(length(zero.solve(query).unwrap().path()), expected, "{}", case());
                let mut counters = Counters::default();
                let found = plus.solve_observed(query, &mut counters).unwrap();
                assert_eq!(length(found.path()), expected, "{}", case());
                let with = self.expanded[0] - before[0];
                assert!(counters.expanded <= with, "JPS+, {}", case());
                self.queries += 1;
            }
        }
    }
}

#[test]
fn searches_that_pass_dead_ends_lose_no_path() {
    let mut test = Costs::default();
    on_all(grids(seeds(12)), &mut test);
    let [with, without] = test.expanded;
    assert!(test.queries > 2500, "{}", test.queries);
    assert!(test.lists > 25_000, "{} jump lists", test.lists);
    assert!(test.shorter > 250 && with < without, "{}, {with} of {without} expansions", test.shorter);
}
