//! Scans of bit planes and lists of jumps against jumps that are made step by step, with forced successors
//! by their definition.

use std::sync::Arc;

use mediant_grid::{
    Centers, Corners, DiagonalGap, Grid, GridGraph, Placement, Rules, Vector, Vertex, VertexId, uninterrupted,
};
use mediant_moves::FiniteK;
use mediant_oracle::{Rng, describe, every, is_gap, noise, seeds, suite_grid, wide_grid};

use super::{
    axial::{AxialStops, Scan},
    diagonals::DiagonalStops,
    finder::{JumpContext, JumpRules},
    planes::PlaneRows,
    to_goal::{GoalLegs, ToGoal},
};
use crate::{canonical::Pruning, successors::ExpandedNode};

const AXES: [Vector; 4] = [Vector::new(0, 1), Vector::new(1, 0), Vector::new(0, -1), Vector::new(-1, 0)];

mod lists;

/// How a jump ends: its steps, and whether it found a jump point or the goal.
type End = (u32, bool);

/// A grid graph, and jumps on it step by step.
struct Reference<P: Placement> {
    graph: GridGraph<P>,
    /// By pattern of cells: the moves with a forced successor, one bit each.
    forced: Vec<u8>,
    /// By vertex: the legal moves.
    legal: Vec<u8>,
}

/// The side of the square of cells that is a pattern.
fn pattern_side<P: Placement>() -> u32 {
    P::PATTERNS.ilog2().isqrt()
}

/// The pattern of cells around a vertex, cell by cell.
fn pattern_at<P: Placement>(grid: &Grid, at: Vertex) -> usize {
    let side = pattern_side::<P>() as i32;
    let bits = (0..side * side).map(|i| (at.x - 1 + i % side, at.y - 1 + i / side));
    bits.enumerate().map(|(i, (x, y))| usize::from(grid.is_blocked(x, y)) << i).sum()
}

/// Which moves a have a forced successor where the cells around a vertex form `pattern`, by the definition: a
/// move b that is not natural is legal, and no path of displacement a + b from the start of a is shorter, or
/// as long with a last move of lower rank. All cells beyond the pattern are blocked, so that only those paths
/// count that the pattern alone makes legal. (Gaps depend on more than that, so they are open here.)
fn forced_of<P: Placement>(rule: P::Rule, k: FiniteK, pattern: usize) -> u8 {
    let side = pattern_side::<P>();
    let grid = Grid::from_fn(side, side, |x, y| pattern >> (x + y * side) & 1 == 1).unwrap();
    let graph = GridGraph::<P>::new(Arc::new(grid), k, rule).unwrap();
    let at = Vertex::new(1, 1);
    let moves: Vec<Vector> = graph.steps().iter().map(|step| step.vector()).collect();
    let last = moves.len() - 1;
    let rank = |index: usize| (index % 2, index);
    (0..moves.len()).fold(0, |forced, a| {
        let from = at + -moves[a];
        let natural = |b| b == a || (a % 2 == 1 && (b == (a + 1) & last || b == (a + last) & last));
        let is_forced = |b: usize| {
            let to = at + moves[b];
            let length = moves[a].norm() + moves[b].norm();
            // If no path is shorter, one that is as long has two moves.
            let straight = to == from || moves.contains(&from.to(to)) && graph.sees(from, to);
            let bent = (0..moves.len()).any(|first| {
                let middle = from + moves[first];
                let Some(then) = moves.iter().position(|&v| v == middle.to(to)) else { return false };
                let other = moves[first].norm() + moves[then].norm();
                let better = other < length - 1e-9 || (other < length + 1e-9 && rank(then) < rank(b));
                better && graph.sees(from, middle) && graph.sees(middle, to)
            });
            graph.sees(at, to) && !straight && !bent
        };
        forced | u8::from((0..moves.len()).any(|b| !natural(b) && is_forced(b))) << a
    })
}

impl<P: Placement> Reference<P> {
    fn new(grid: &Arc<Grid>, rule: P::Rule, k: u32, forced: &[u8]) -> Self {
        let graph = GridGraph::<P>::new(Arc::clone(grid), FiniteK::new(k).unwrap(), rule).unwrap();
        let legal = (0..graph.vertex_count()).map(|id| {
            let at = graph.vertex(VertexId(id as u32));
            let steps = graph.steps().iter().enumerate();
            steps.fold(0, |set, (i, step)| set | u8::from(graph.is_legal(at, step.vector())) << i)
        });
        let legal = legal.collect();
        Self { graph, forced: forced.to_vec(), legal }
    }

    fn vertices(&self) -> impl Iterator<Item = (VertexId, Vertex)> {
        (0..self.graph.vertex_count()).map(|id| {
            let id = VertexId(id as u32);
            (id, self.graph.vertex(id))
        })
    }

    fn is_closed_gap(&self, at: Vertex) -> bool {
        self.graph.rules() == Rules::Corner(DiagonalGap::Closed) && is_gap(self.graph.grid(), at)
    }

    /// Where a legal move leads.
    fn next(&self, from: Vertex, index: usize) -> Option<Vertex> {
        let id = self.graph.id(from).unwrap();
        (self.legal[id.index()] >> index & 1 == 1).then(|| from + self.graph.step(index).vector())
    }

    fn has_forced(&self, at: Vertex, index: usize) -> bool {
        self.forced[pattern_at::<P>(self.graph.grid(), at)] >> index & 1 == 1
    }

    /// The axial jump by an even move.
    fn scan(&self, from: Vertex, index: usize) -> End {
        let (mut at, mut steps) = (from, 0);
        while let Some(to) = self.next(at, index).filter(|&to| !self.is_closed_gap(to)) {
            (at, steps) = (to, steps + 1);
            if self.has_forced(at, index) {
                return (steps, true);
            }
        }
        (steps, false)
    }

    /// The diagonal jump by an odd move.
    fn diagonal(&self, from: Vertex, index: usize) -> End {
        let last = self.move_count() - 1;
        let (mut at, mut steps) = (from, 0);
        while let Some(to) = self.next(at, index).filter(|&to| !self.is_closed_gap(to)) {
            let beside = [(index + 1) & last, (index + last) & last];
            let finds = |&even: &usize| self.scan(to, even).1;
            (at, steps) = (to, steps + 1);
            if self.has_forced(at, index) || beside.iter().any(finds) {
                return (steps, true);
            }
        }
        (steps, false)
    }

    /// Whether a path that came by a move may go on by one of its successors, and from there by an even move
    /// beside it, straight to the goal.
    fn is_in_sight(&self, at: Vertex, by: usize, goal: Vertex) -> bool {
        let (last, mut is_seen) = (self.move_count() - 1, false);
        let node = ExpandedNode { id: self.graph.id(at).unwrap(), at, by: Some(by) };
        Pruning::new(&self.graph).for_each(&self.graph, &node, by, |index| {
            let beside = if index % 2 == 1 { vec![index - 1, (index + 1) & last] } else { vec![] };
            let mut turn = at;
            while let Some(to) = self.next(turn, index).filter(|&to| !self.is_closed_gap(to)) {
                turn = to;
                let comes_there = |&even: &usize| {
                    let (mut at, mut comes) = (turn, false);
                    while let Some(to) = self.next(at, even).filter(|&to| !self.is_closed_gap(to)) {
                        at = to;
                        comes |= at == goal;
                    }
                    comes
                };
                is_seen |= turn == goal || beside.iter().any(comes_there);
            }
        });
        is_seen
    }

    fn move_count(&self) -> usize {
        self.graph.steps().len()
    }
}

/// A check that is done on many grid graphs.
trait Suite {
    fn check<P: Placement>(&mut self, reference: &Reference<P>, case: &dyn Fn(Vertex, Vertex) -> String);
}

/// Does it under all rules, for k = 2 and 3.
fn on_all(grids: impl Iterator<Item = (u64, Grid)>, suite: &mut impl Suite) {
    fn on_one<P: Placement>(grids: &[(u64, Arc<Grid>)], rule: P::Rule, k: u32, suite: &mut impl Suite) {
        let forced = |pattern| forced_of::<P>(rule, FiniteK::new(k).unwrap(), pattern);
        let forced: Vec<u8> = (0..P::PATTERNS).map(forced).collect();
        for (seed, grid) in grids {
            let case = |from, to| format!("k = {k}, {}", describe(grid, P::rules(rule), from, to, *seed));
            suite.check(&Reference::<P>::new(grid, rule, k, &forced), &case);
        }
    }
    let grids: Vec<_> = grids.map(|(seed, grid)| (seed, Arc::new(grid))).collect();
    for (rules, k) in Rules::ALL.into_iter().flat_map(|rules| [(rules, 2), (rules, 3)]) {
        match rules {
            Rules::Center(corners) => on_one::<Centers>(&grids, corners, k, suite),
            Rules::Corner(gap) | Rules::CenterGap(gap) => on_one::<Corners>(&grids, gap, k, suite),
        }
    }
}

/// Small maps, and some wider or higher than a word.
fn suite_grids() -> impl Iterator<Item = (u64, Grid)> {
    let wide = seeds(100).step_by(10).map(|seed| (seed, wide_grid(seed).0));
    seeds(100).map(|seed| (seed, suite_grid(seed).0)).chain(wide)
}

/// Long and narrow maps, almost empty: with jumps longer than an entry can say.
fn long_grids() -> impl Iterator<Item = (u64, Grid)> {
    (0..4).map(|seed| {
        let rng = &mut Rng::new(seed);
        let (long, short) = (380 + rng.below(10), 1 + 2 * rng.below(2));
        let (width, height) = if seed % 2 == 0 { (long, short) } else { (short, long) };
        let blocked: Vec<(u32, u32)> = (0..3).map(|_| (rng.below(width), rng.below(height))).collect();
        (seed, Grid::from_fn(width, height, |x, y| short > 1 && blocked.contains(&(x, y))).unwrap())
    })
}

/// Scans give what steps give: from every free vertex in every direction.
struct Scans {
    compared: usize,
}

impl Suite for Scans {
    fn check<P: Placement>(&mut self, reference: &Reference<P>, case: &dyn Fn(Vertex, Vertex) -> String) {
        let graph = &reference.graph;
        let stops = uninterrupted(|never| AxialStops::new(graph, never));
        let count = graph.steps().len();
        for (_, from) in reference.vertices().filter(|&(_, at)| graph.is_free(at)) {
            for (quarter, &towards) in AXES.iter().enumerate() {
                let index = quarter * count / 4;
                if index % 2 == 1 {
                    continue;
                }
                let (steps, found) = reference.scan(from, index);
                let expected = Scan { steps, found, scanned: steps + u32::from(!found) };
                assert_eq!(stops.scan(from, quarter, false), expected, "{towards:?}, {}", case(from, from));
                self.compared += 1;
            }
        }
    }
}

/// Scans of diagonals stop where steps stop, and know which axial jumps lead on from there.
struct DiagonalScans {
    compared: usize,
    longest: u32,
}

impl Suite for DiagonalScans {
    fn check<P: Placement>(&mut self, reference: &Reference<P>, case: &dyn Fn(Vertex, Vertex) -> String) {
        let graph = &reference.graph;
        let stops = uninterrupted(|never| {
            let PlaneRows { leads, enters, .. } = PlaneRows::new(graph, never)?;
            DiagonalStops::new(graph, &Pruning::new(graph), (&enters, [&leads; 2]), never)
        });
        let last = graph.steps().len() - 1;
        for (_, from) in reference.vertices() {
            for index in (1..=last).step_by(2) {
                let towards = graph.step(index).vector();
                let (steps, leads) = stops.scan(from, index).next(|_| None);
                let (expected, found) = reference.diagonal(from, index);
                let name = || format!("{towards:?}, {}", case(from, from + towards * steps as i32));
                assert_eq!(steps, expected + u32::from(!found), "{}", name());
                let to = from + towards * steps as i32;
                let finds = [index - 1, (index + 1) & last].map(|even| found && reference.scan(to, even).1);
                assert_eq!(leads, finds, "{}", name());
                self.compared += 1;
                self.longest = self.longest.max(steps);
            }
        }
    }
}

#[test]
fn scans_of_diagonals_stop_where_steps_stop() {
    let mut suite = DiagonalScans { compared: 0, longest: 0 };
    on_all(suite_grids().chain(long_grids()), &mut suite);
    assert!(suite.compared > 150_000, "{}", suite.compared);
    assert!(suite.longest > 3 * 64, "{}", suite.longest);
}

#[test]
fn scans_end_where_steps_end() {
    let mut suite = Scans { compared: 0 };
    on_all(suite_grids().chain(long_grids()), &mut suite);
    assert!(suite.compared > 150_000, "{}", suite.compared);
}

/// The formulas on words, on every pattern and under each rule.
struct Patterns;

impl Suite for Patterns {
    fn check<P: Placement>(&mut self, reference: &Reference<P>, case: &dyn Fn(Vertex, Vertex) -> String) {
        Scans { compared: 0 }.check(reference, case);
        DiagonalScans { compared: 0, longest: 0 }.check(reference, case);
        lists::Lists::default().check(reference, case);
    }
}

#[test]
fn turns_are_those_of_the_definition_in_every_pattern() {
    // Each 3 × 3 pattern, and with it each 2 × 2 one, in the middle of a free map.
    let grids = (0..512).step_by(every(3)).map(|pattern: u64| {
        let blocked = |x: u32, y: u32| {
            (2..5).contains(&x) && (1..4).contains(&y) && pattern >> (x - 2 + 3 * (y - 1)) & 1 == 1
        };
        (pattern, Grid::from_fn(7, 5, blocked).unwrap())
    });
    on_all(grids, &mut Patterns);
}

#[test]
fn the_way_to_the_goal_is_that_of_the_moves() {
    let grid = Arc::new(noise(&mut Rng::new(1), 9, 9, 0));
    for k in [FiniteK::N4, FiniteK::N8] {
        let graph = &GridGraph::<Centers>::new(Arc::clone(&grid), k, Default::default()).unwrap();
        let (from, pruning) = (Vertex::new(4, 4), &Pruning::new(graph));
        for goal in (0..81).map(|i| Vertex::new(i % 9, i / 9)) {
            let to_goal = ToGoal::new(from.to(goal), k);
            let rules = &JumpRules::PLAIN;
            let context = JumpContext { graph, pruning, goal, rules, stepwise: false, to_goal };
            for (index, step) in graph.steps().iter().enumerate() {
                let name = || format!("k = {k}, {goal}, {:?}", step.vector());
                if index % 2 == 0 {
                    let steps = context.steps_to_goal(from, step.vector());
                    assert_eq!(to_goal.straight(index), steps, "{}", name());
                } else {
                    let legs = GoalLegs::new(graph, from.to(goal), (index, context.beside(index)));
                    // Where no axial leg follows, its direction says nothing.
                    let parts =
                        |(diagonal, even, axial)| (diagonal, axial, if axial == 0 { 0 } else { even });
                    let expected = legs.map(|legs| parts((legs.diagonal, legs.index, legs.axial)));
                    let (even, axial) = to_goal.then;
                    let found = (to_goal.index == index).then(|| parts((to_goal.steps, even, axial)));
                    assert_eq!(found, expected, "{}", name());
                }
            }
        }
    }
}
