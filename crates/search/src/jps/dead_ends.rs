//! Jump points that are dead ends: whatever a path does there but go straight on, it ends near by.
//!
//! On maps of games most jump points are such: an alcove, the rough edge of a wall. A search that makes nodes
//! of them expands twice as many. So they are found beforehand, and jumps pass them, as if they were no jump
//! points.
//!
//! **A dead end** is a jump point p of an axial jump from whose forced successors jumps lead to no node, or
//! only to jump points that are dead ends themselves and from which no jump straight on leads to others. All
//! these nodes, and the vertices of diagonal jumps on the way to them, must lie within [`REACH`] cells of p,
//! in both coordinates. To find out costs a few scans; it is given up at a depth of [`DEPTH`] nodes.
//!
//! **Nothing is lost** by passing p, unless a path turns at p to a goal in its dead end. There are no nodes
//! but these: so the last leg of the path, which is axial, leads to the goal from p, from one of these nodes,
//! or from a vertex of a diagonal jump, in any case from a vertex within [`REACH`] of p. That vertex is on
//! the *cross* of the goal: the vertices from which an axial move, repeated, leads to the goal. So p is
//! within [`REACH`] of the cross. Near the cross ([`NearGoal`]) dead ends are jump points like others. The
//! nodes on the way from p to the goal are near it as well, since the goal is in their dead end, too.
//!
//! Where intermediate jump points are kept, or gaps are closed, there are no dead ends.

use mediant_grid::{GridGraph, Placement, Vector, Vertex};

use super::{axial::AxialStops, diagonals::DiagonalStops};
use crate::{
    canonical::{PatternTable, Pruning, pattern_at},
    successors::ExpandedNode,
};

/// How far a dead end may reach. With 32 hardly more jump points are dead ends, and more are near a goal.
pub(super) const REACH: u32 = 16;

/// The most jump points one behind the other in a dead end.
const DEPTH: u32 = 4;

/// Where dead ends may hold the goal: jumps along these rows and columns do not pass them.
#[derive(Clone, Copy, Debug)]
pub struct NearGoal {
    rows: Band,
    columns: Band,
}

/// The numbers from `first` on, `more` beyond that.
#[derive(Clone, Copy, Debug)]
struct Band {
    first: i32,
    more: u32,
}

impl Band {
    /// Those of 64 numbers that it holds: the first one and those that follow it upwards or downwards.
    #[inline]
    const fn of(self, number: i32, up: bool) -> u64 {
        let highest = if up { number.wrapping_add(63) } else { number };
        if highest.wrapping_sub(self.first) as u32 > self.more.saturating_add(63) {
            return 0;
        }
        let (first, last) = (self.first as i64, self.first as i64 + self.more as i64);
        let (from, to) = if up {
            (first - number as i64, last - number as i64)
        } else {
            (number as i64 - last, number as i64 - first)
        };
        !0 << (if from > 0 { from } else { 0 }) & !0 >> (if to < 63 { 63 - to } else { 0 })
    }

    #[inline]
    const fn holds(self, number: i32) -> bool {
        number.wrapping_sub(self.first) as u32 <= self.more
    }
}

impl NearGoal {
    /// Dead ends are nowhere passed.
    pub(super) const EVERYWHERE: Self = {
        let all = Band { first: i32::MIN, more: u32::MAX };
        Self { rows: all, columns: all }
    };

    /// What is near a goal, from which there are so many legal steps in the four directions.
    pub(super) fn new(goal: Vertex, [down, right, up, left]: [u32; 4], reach: u32) -> Self {
        let band = |at: i32, before: u32, after: u32| Band {
            first: at - (before + reach) as i32,
            more: before + after + 2 * reach,
        };
        Self { rows: band(goal.y, up, down), columns: band(goal.x, left, right) }
    }

    /// Whether an axial jump from a vertex in direction `quarter` is along a row or column near the goal.
    #[inline]
    pub(super) const fn holds(&self, from: Vertex, quarter: usize) -> bool {
        if quarter.is_multiple_of(2) { self.columns.holds(from.x) } else { self.rows.holds(from.y) }
    }

    /// The same for jumps from 64 vertices, the first one and those that follow it by diagonal moves `v`.
    #[inline]
    pub(super) const fn from_diagonal(&self, first: Vertex, v: Vector, quarter: usize) -> u64 {
        if quarter.is_multiple_of(2) {
            self.columns.of(first.x, v.x > 0)
        } else {
            self.rows.of(first.y, v.y > 0)
        }
    }
}

/// The dead ends of a map in rows: for axial jumps in each of the four directions a word for 64 vertices.
#[derive(Clone, Debug, Default)]
pub(super) struct DeadEndRows {
    rows: [Vec<u64>; 4],
    per_row: usize,
}

impl DeadEndRows {
    /// For so many columns and rows, with no dead end yet.
    pub(super) fn new((width, height): (u32, u32)) -> Self {
        let per_row = width.div_ceil(64) as usize;
        Self { rows: [0; 4].map(|_| vec![0; per_row * height as usize]), per_row }
    }

    fn add(&mut self, at: Vertex, quarter: usize) {
        self.rows[quarter][at.y as usize * self.per_row + at.x as usize / 64] |= 1 << (at.x % 64);
    }

    /// Whether there are none.
    pub(super) const fn is_empty(&self) -> bool {
        self.per_row == 0
    }

    /// The words for a direction; none if there are no dead ends.
    pub(super) fn of(&self, quarter: usize) -> &[u64] {
        &self.rows[quarter]
    }
}

/// Finds the dead ends of a grid graph.
pub(super) struct DeadEnds<'g, P: Placement> {
    pub(super) graph: &'g GridGraph<P>,
    pub(super) pruning: &'g Pruning<P>,
    pub(super) table: &'g PatternTable,
    pub(super) diagonals: &'g DiagonalStops,
    pub(super) reach: u32,
}

impl<P: Placement> DeadEnds<'_, P> {
    /// Marks all dead ends.
    pub(super) fn mark(&self, axial: &mut AxialStops) -> DeadEndRows {
        let mut rows = DeadEndRows::default();
        for quarter in (0..4).step_by(8 / self.graph.steps().len()) {
            axial.mark(quarter, |axial, at| {
                let holds = self.holds(axial, at, quarter);
                if holds {
                    if rows.is_empty() {
                        rows = DeadEndRows::new(P::vertices(self.graph.grid()));
                    }
                    rows.add(at, quarter);
                }
                holds
            });
        }
        rows
    }

    /// Whether a jump point of the axial jumps in direction `quarter` is a dead end; false outside the map.
    fn holds(&self, axial: &AxialStops, at: Vertex, quarter: usize) -> bool {
        self.graph.is_free(at)
            && self.ends(axial, at, quarter << (self.graph.k().get() - 2), self.reach, DEPTH)
    }

    /// Whether all jumps by forced successors of a jump point, at which a path arrived by move `by`, end
    /// within `reach`.
    fn ends(&self, axial: &AxialStops, at: Vertex, by: usize, reach: u32, depth: u32) -> bool {
        let mut forced = self.forced(at, by);
        while forced != 0 {
            let index = forced.trailing_zeros() as usize;
            let ends = if index % 2 == 1 {
                self.diagonal_ends(axial, at, index, reach, depth)
            } else {
                self.axial_ends(axial, at, index, reach, depth)
            };
            if !ends {
                return false;
            }
            forced &= forced - 1;
        }
        true
    }

    fn diagonal_ends(&self, axial: &AxialStops, from: Vertex, index: usize, reach: u32, depth: u32) -> bool {
        let mut scan = self.diagonals.scan(from, index);
        let beside = [index - 1, (index + 1) % self.graph.steps().len()];
        loop {
            let (gone, leads) = scan.next(|_| None);
            let at = self.after(from, index, gone);
            // Where it cannot enter the vertex at which it stops, it ends before.
            if leads == [false; 2] && !self.is_legal(from, index, gone - 1) {
                return gone - 1 <= reach;
            }
            // A forced successor of a diagonal move would be one more case.
            if gone > reach || self.forced(at, index) != 0 {
                return false;
            }
            for (even, leads) in beside.into_iter().zip(leads) {
                if leads && !self.axial_ends(axial, at, even, reach - gone, depth) {
                    return false;
                }
            }
        }
    }

    fn axial_ends(&self, axial: &AxialStops, from: Vertex, index: usize, reach: u32, depth: u32) -> bool {
        let quarter = index >> (self.graph.k().get() - 2);
        let mut gone = 0;
        loop {
            let at = self.after(from, index, gone);
            let scan = axial.scan(at, quarter, None, true);
            if !scan.found {
                return true;
            }
            gone += scan.steps;
            if depth == 0 || gone > reach {
                return false;
            }
            if !self.ends(axial, self.after(from, index, gone), index, reach - gone, depth - 1) {
                return false;
            }
        }
    }

    /// The forced successors of a path that arrives by a move.
    fn forced(&self, at: Vertex, by: usize) -> u8 {
        self.table.forced(by, self.table.successors(by, pattern_at(self.graph, at)))
    }

    /// Whether a diagonal jump may take one more step after so many.
    fn is_legal(&self, from: Vertex, index: usize, gone: u32) -> bool {
        let at = self.after(from, index, gone);
        let node = |id| ExpandedNode { id, at, by: Some(index) };
        self.graph.id(at).is_some_and(|id| self.pruning.is_legal(self.graph, &node(id), index))
    }

    fn after(&self, from: Vertex, index: usize, steps: u32) -> Vertex {
        from + self.graph.step(index).vector() * steps as i32
    }
}

#[cfg(test)]
mod tests {
    use std::{collections::HashSet, sync::Arc};

    use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, Grid};
    use mediant_moves::FiniteK;
    use mediant_oracle::{Rng, describe, noise, random_free_vertex, rooms, seeds, suite_grid, wide_grid};

    use super::*;
    use crate::{
        AStar, BlockJps, Counters, Hk, Planner, Query, Zero,
        jps::{BlockFinder, Jps, planes::JumpPlanes},
        successors::Successors,
    };

    /// What a rule of motion is tested for.
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
        let planes = JumpPlanes::with_dead_ends(graph, pruning, AxialStops::new(graph), reach);
        BlockFinder::with_planes(graph, planes)
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
                None
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
            let plain = AxialStops::new(&graph);
            let reach = [1, 2, 3, 5, 8, REACH][seed as usize / 4 % 6];
            let marked = finder(&graph, &pruning, reach);
            let count = graph.steps().len();
            for id in 0..graph.vertex_count() as u32 {
                let from = graph.vertex(mediant_grid::VertexId(id));
                for quarter in (0..4).step_by(8 / count).filter(|_| graph.is_free(from)) {
                    let scan = plain.scan(from, quarter, None, true);
                    let by = quarter * count / 4;
                    let at = from + graph.step(by).vector() * scan.steps as i32;
                    if !scan.found {
                        continue;
                    }
                    let is_dead = marked.axial().is_dead_end(at, quarter);
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
        on_all(grids(seeds(24)), &mut test);
        let Definition { dead, with_nodes, others } = test;
        assert!(dead > 10_000 && with_nodes > 500 && others > 10_000, "{dead}, {with_nodes}, {others}");
    }

    /// No search loses a path, whatever the reach, also where the goal is in a dead end.
    #[derive(Default)]
    struct Costs {
        queries: u64,
        expanded: [u64; 2],
        shorter: u64,
    }

    impl Test for Costs {
        fn on<P: Placement>(&mut self, grid: &Arc<Grid>, rule: P::Rule, k: u32, seed: u64) {
            let graph = &GridGraph::<P>::new(Arc::clone(grid), FiniteK::new(k).unwrap(), rule).unwrap();
            let pruning = Arc::new(Pruning::new(graph));
            let mut astar = AStar::new(graph, Hk);
            for reach in [1, 2, 4, REACH] {
                let with = |reach| finder(graph, &pruning, reach);
                let jps =
                    |reach| BlockJps::with_finder(graph, Arc::clone(&pruning), with(reach), Hk).unwrap();
                let mut planners = [jps(reach), jps(0)];
                let mut zero = BlockJps::with_finder(graph, Arc::clone(&pruning), with(reach), Zero).unwrap();
                let rng = &mut Rng::new(seed ^ u64::from(reach));
                for _ in 0..12 {
                    let mut free = || random_free_vertex(rng, grid, P::KIND);
                    let (Some(start), Some(goal)) = (free(), free()) else { continue };
                    let query = Query::new(start, goal);
                    let case = || {
                        format!(
                            "reach {reach}, k = {k}, {}",
                            describe(grid, P::rules(rule), start, goal, seed)
                        )
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
                    self.queries += 1;
                }
            }
        }
    }

    #[test]
    fn searches_that_pass_dead_ends_lose_no_path() {
        let mut test = Costs::default();
        on_all(grids(seeds(48)), &mut test);
        let [with, without] = test.expanded;
        assert!(test.queries > 10_000, "{}", test.queries);
        assert!(test.shorter > 1000 && with < without, "{}, {with} of {without} expansions", test.shorter);
    }
}
