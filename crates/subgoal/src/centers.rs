//! Subgoals and edges at centers, for k = 2 and 3: the subgoal graphs of Uras, Koenig & Hernández 2013, where
//! corners are never cut.

use mediant_grid::{
    BitIndex, BitMatrix, Centers, CornerRule, FreeSpace, Grid, Interrupt, Interrupted, Vector, Vertex, load,
};
use mediant_moves::{Cost, FiniteK, K};

use crate::{
    bends::{OctileBends, OctileDepartures},
    clearance::{ClearanceBits, DiagonalClearance, convex_corners, zeros_after, zeros_before},
    error::SubgoalError,
    hierarchy::Hierarchy,
    placement::{BuildContext, CellRun, EdgeCriterion, EdgeFinder, EdgeKind, SubgoalPlacement, VertexRun},
};

impl SubgoalPlacement for Centers {}

impl EdgeFinder for Centers {
    const SHARES_SIGHT: bool = false;

    const SIDES: u32 = 1;

    type Scratch = ();
    type Tables = ClearanceBits;

    fn check(space: &FreeSpace<Self>, k: K) -> Result<(), SubgoalError> {
        match k {
            K::Finite(FiniteK::N4) => Ok(()),
            K::Finite(FiniteK::N8) if space.rule() == CornerRule::Never => Ok(()),
            _ => Err(SubgoalError::Centers { k, rules: space.rules() }),
        }
    }

    fn subgoals(space: &FreeSpace<Self>, interrupt: &Interrupt) -> Result<BitMatrix, Interrupted> {
        convex_corners(space.grid().rows(), interrupt)
    }

    fn tables(
        space: &FreeSpace<Self>,
        subgoals: &BitMatrix,
        interrupt: &Interrupt,
    ) -> Result<ClearanceBits, Interrupted> {
        ClearanceBits::new(space.grid(), subgoals, interrupt)
    }

    fn edge_criterion(_: K, _: Hierarchy) -> EdgeCriterion {
        EdgeCriterion::Direct
    }

    fn edges_from(
        context: BuildContext<'_, Self>,
        (): &mut (),
        from: Vertex,
        kind: EdgeKind,
        mut visit: impl FnMut(u32, Cost),
    ) {
        let BuildContext { space, subgoals, tables, metric, k, .. } = context;
        let visit = |to: Vector, cost: Cost| {
            if let Some(id) = subgoals.id(from + to) {
                visit(id, cost);
            }
        };
        let diagonally = k == K::Finite(FiniteK::N8);
        let costs =
            (metric.distance(Vector::new(1, 0)), metric.distance(Vector::new(1, i32::from(diagonally))));
        EdgeSearch { grid: space.grid(), clearance: tables, from, kind, costs, visit, run: |_| {} }
            .run(diagonally);
    }

    type Departures = OctileDepartures;

    const SORTED: bool = false;

    fn bend_bits(space: &FreeSpace<Self>, at: Vertex, _: u32) -> u32 {
        OctileBends::at(space.grid(), at).bits()
    }

    #[inline]
    fn departures(k: K, bits: u32, arrival: Vector) -> OctileDepartures {
        match k {
            K::Finite(FiniteK::N8) if arrival != Vector::new(0, 0) => {
                OctileBends::from_bits(bits).after(arrival)
            }
            _ => OctileDepartures::ALL,
        }
    }

    /// The half octant.
    fn class(edge: Vector) -> u32 {
        OctileDepartures::class(edge)
    }

    #[inline]
    fn allows(departures: OctileDepartures, _: impl Fn() -> Vector, class: u32) -> bool {
        departures.allows_class(class)
    }

    /// Their classes, a bit for each.
    fn summary(_: u32, edges: impl Iterator<Item = Vector>) -> u32 {
        edges.fold(0, |classes, edge| classes | 1 << Self::class(edge))
    }

    #[inline]
    fn leads_on(k: K, bits: u32, arrival: Vector, summary: u32) -> bool {
        Self::departures(k, bits, arrival).allows_any(summary)
    }

    fn side(_: &FreeSpace<Self>, _: Vertex, edge: Vector) -> (u32, f64) {
        (0, Self::class(edge).into())
    }

    fn runs_to(
        context: BuildContext<'_, Self>,
        (): &mut (),
        subgoal: Vertex,
        mut run: impl FnMut(VertexRun),
        _: impl FnMut(CellRun),
    ) {
        let BuildContext { space, tables, k, .. } = context;
        let (from, kind, costs) = (subgoal, EdgeKind::Query, (Cost::ZERO, Cost::ZERO));
        // Paths that begin or end at a subgoal have no other edge there.
        run(VertexRun { first: subgoal, length: 1, is_column: false, is_right: false });
        EdgeSearch { grid: space.grid(), clearance: tables, from, kind, costs, visit: |_, _| {}, run }
            .run(k == K::Finite(FiniteK::N8));
    }
}

/// The search for the subgoals that are directly reachable from a cell.
struct EdgeSearch<'g, F, R> {
    grid: &'g Grid,
    clearance: &'g ClearanceBits,
    from: Vertex,
    kind: EdgeKind,
    /// The costs of an axis move, and of a diagonal one (over N(2), of the other axis move).
    costs: (Cost, Cost),
    /// Called with the displacement and the cost of each subgoal found, and of some blocked cells.
    visit: F,
    /// Called with the cells before them, each once: those that are directly reachable from the cell.
    run: R,
}

/// The cells a·u + b·v, with a, b ≥ 1, between two adjacent moves u and v, of which u is an axis move.
///
/// To find their directly reachable subgoals, go along v step by step. In each row, walk along u to the first
/// subgoal or blocked cell, but stop short of where the walk in an earlier row ended. This is complete: if a
/// subgoal is directly reachable, every optimal path to it on an empty grid is legal and meets no other
/// subgoal, for where two neighboring paths part around a blocked cell, one of them passes a convex corner.
#[derive(Clone, Copy, Debug)]
struct Cone {
    /// Whether u is horizontal.
    is_row: bool,
    /// The direction of u, 1 or −1.
    u: i32,
    /// The components of v along the axis of u (1, −1 or 0), and across it (1 or −1).
    v: (i32, i32),
    /// The number of cells to search along u.
    a: i32,
    /// The number of steps along v.
    b: i32,
}

impl<F: FnMut(Vector, Cost), R: FnMut(VertexRun)> EdgeSearch<'_, F, R> {
    /// Reports the cells from `u` to `length` · `u` beyond a cell, where u is an axis move.
    #[inline]
    fn report(&mut self, is_row: bool, (x, y): (i32, i32), u: i32, length: i32) {
        if length > 0 {
            let start = if u > 0 { 1 } else { -length };
            let (x, y) = if is_row { (x + start, y) } else { (x, y + start) };
            let first = self.from + Vector::new(x, y);
            (self.run)(VertexRun { first, length, is_column: !is_row, is_right: false });
        }
    }

    fn run(mut self, diagonally: bool) {
        let [right, left] = [1, -1].map(|x| self.axis(true, x));
        let [down, up] = [1, -1].map(|y| self.axis(false, y));
        for (x, across) in [(1, right), (-1, left)] {
            for (y, along) in [(1, down), (-1, up)] {
                if y < 0 && self.kind == EdgeKind::Graph {
                    continue;
                }
                if !diagonally {
                    self.cone(Cone { is_row: true, u: x, v: (0, y), a: across, b: along });
                    continue;
                }
                let DiagonalClearance { free: b, meets_subgoal } = self.clearance.diagonal(self.from, (x, y));
                for steps in 1..=b {
                    self.report(true, (x * (steps - 1), y * steps), x, 1);
                }
                if meets_subgoal {
                    (self.visit)(Vector::new(x * (b + 1), y * (b + 1)), self.costs.1 * (b + 1) as u32);
                }
                self.cone(Cone { is_row: true, u: x, v: (x, y), a: across, b });
                self.cone(Cone { is_row: false, u: y, v: (y, x), a: along, b });
            }
        }
    }

    /// Visits the first stop along an axis. Returns the number of cells before it.
    fn axis(&mut self, is_row: bool, u: i32) -> i32 {
        let (bits, at) = self.clearance.along(is_row, self.from);
        let free =
            if u > 0 { zeros_after(bits.words(), at.offset(1)) } else { zeros_before(bits.words(), at) };
        let (x, y) = if is_row { (u * (free + 1), 0) } else { (0, u * (free + 1)) };
        let to = Vector::new(x, y);
        if self.kind.includes(to) {
            (self.visit)(to, self.costs.0 * (free + 1) as u32);
        }
        self.report(is_row, (0, 0), u, free);
        free
    }

    fn cone(&mut self, cone: Cone) {
        if cone.u > 0 { self.sweep::<true>(cone) } else { self.sweep::<false>(cone) }
    }

    fn sweep<const AHEAD: bool>(&mut self, Cone { is_row, u, v, mut a, b }: Cone) {
        let (stops, mut at) = self.clearance.along(is_row, self.from);
        let blocked = if is_row { self.grid.rows() } else { self.grid.columns() };
        let (stops, blocked, step) = (stops.words(), blocked.words(), v.1 * stops.bits_per_row() + v.0);
        for row in 1..=b {
            if a == 0 {
                return;
            }
            at = at.offset(step);
            let word = load(stops, at.offset(if AHEAD { 1 } else { -64 }));
            let zeros = if AHEAD { word.trailing_zeros() } else { word.leading_zeros() } as i32;
            let free = match zeros {
                _ if zeros >= a => a,
                64 => free_beyond::<AHEAD>(stops, at, a),
                _ => zeros,
            };
            let start = if is_row { (v.0 * row, v.1 * row) } else { (v.1 * row, v.0 * row) };
            self.report(is_row, start, u, free);
            if free == a {
                continue;
            }
            a = free;
            let BitIndex(stop) = at.offset(u * (a + 1));
            if blocked.get(stop as usize / 64).is_some_and(|word| word >> (stop % 64) & 1 == 0) {
                let (along, across) = (v.0 * row + u * (a + 1), v.1 * row);
                let to = if is_row { Vector::new(along, across) } else { Vector::new(across, along) };
                (self.visit)(to, self.costs.0 * (a + 1) as u32 + self.costs.1 * row as u32);
            }
        }
    }
}

/// The number of zeros ahead of `at`, or behind it, but at most `most`. The first 64 bits are known to be
/// zeros.
#[cold]
fn free_beyond<const AHEAD: bool>(words: &[u64], at: BitIndex, most: i32) -> i32 {
    let mut free = 64;
    while free < most {
        let word = load(words, at.offset(if AHEAD { 1 + free } else { -64 - free }));
        if word != 0 {
            free += if AHEAD { word.trailing_zeros() } else { word.leading_zeros() } as i32;
            break;
        }
        free += 64;
    }
    free.min(most)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use mediant_grid::{Centers, CornerRule, FreeSpace, Grid, Placement, Vector, Vertex, uninterrupted};
    use mediant_moves::{Cost, FiniteK, K};
    use mediant_oracle::{Explicit, random_grid, wide_grid};
    use mediant_search::parts::Metric;

    use crate::{
        placement::{BuildContext, EdgeCriterion, EdgeFinder, EdgeKind},
        subgoals::Subgoals,
    };

    fn is_subgoal(grid: &Grid, at: Vertex) -> bool {
        let diagonals = [(1, 1), (1, -1), (-1, 1), (-1, -1)];
        grid.is_free(at.x, at.y)
            && diagonals.into_iter().any(|(x, y)| {
                grid.is_blocked(at.x + x, at.y + y)
                    && grid.is_free(at.x + x, at.y)
                    && grid.is_free(at.x, at.y + y)
            })
    }

    /// Compares the edges with searches of the grid graph: they must lead to the subgoals to which an optimal
    /// path is as short as without obstacles and passes no other subgoal.
    fn check(grid: &Grid, k: FiniteK, rule: CornerRule, every: usize, seed: u64) -> usize {
        let space = FreeSpace::<Centers>::new(Arc::new(grid.clone()), rule);
        let metric = Metric::new(K::Finite(k)).expect("a small k");
        let (subgoals, tables) = uninterrupted(|never| {
            let marks = Centers::subgoals(&space, never)?;
            let tables = Centers::tables(&space, &marks, never)?;
            Ok((Subgoals::new(marks, never)?, tables))
        });
        let context = BuildContext {
            space: &space,
            subgoals: &subgoals,
            tables: &tables,
            metric,
            k: K::Finite(k),
            criterion: EdgeCriterion::Direct,
        };
        let explicit = Explicit::new(grid, Centers::rules(rule), Some(k));
        let all: Vec<Vertex> = explicit.free_vertices().filter(|&at| is_subgoal(grid, at)).collect();
        assert_eq!(
            all,
            (0..subgoals.len() as u32).map(|id| subgoals.vertex(id)).collect::<Vec<_>>(),
            "seed {seed}"
        );
        let h = |a: Vertex, b: Vertex| metric.distance(a.to(b));
        // The oracle sums in f64.
        let is_direct =
            |cost: Option<f64>, h: Cost| cost.is_some_and(|cost| (cost - h.to_f64()).abs() < 1e-6);
        let direct: Vec<Vec<bool>> = all
            .iter()
            .map(|&a| {
                let costs = explicit.costs_from(a);
                all.iter().map(|&b| is_direct(costs.to(b), h(a, b))).collect()
            })
            .collect();
        let mut found = 0;
        for from in explicit.free_vertices().step_by(every) {
            let costs = explicit.costs_from(from);
            let near: Vec<usize> = (0..all.len())
                .filter(|&i| all[i] != from && is_direct(costs.to(all[i]), h(from, all[i])))
                .collect();
            let over = |i: usize, j: usize| {
                i != j && direct[j][i] && h(from, all[j]) + h(all[j], all[i]) == h(from, all[i])
            };
            let joined = |i: &usize| !near.iter().any(|&j| over(*i, j));
            for kind in [EdgeKind::Query, EdgeKind::Graph] {
                let below = |to: Vector| to.y > 0 || to.y == 0 && to.x > 0;
                let expected: Vec<(u32, Cost)> = near
                    .iter()
                    .copied()
                    .filter(joined)
                    .filter(|&i| kind == EdgeKind::Query || below(from.to(all[i])))
                    .map(|i| (i as u32, h(from, all[i])))
                    .collect();
                let mut edges = Vec::new();
                Centers::edges_from(context, &mut (), from, kind, |id, cost| edges.push((id, cost)));
                edges.sort_unstable();
                assert_eq!(edges, expected, "seed {seed}, k = {k}, {rule:?}, {kind:?}, from {from:?}");
                found += edges.len();
            }
        }
        found
    }

    /// k, rule.
    const CASES: [(FiniteK, CornerRule); 3] = [
        (FiniteK::N8, CornerRule::Never),
        (FiniteK::N4, CornerRule::Never),
        (FiniteK::N4, CornerRule::Always),
    ];

    #[test]
    fn links_are_what_is_directly_reachable() {
        let mut found = 0;
        for seed in 0..60 {
            let (grid, _) = random_grid(seed);
            for (k, rule) in CASES {
                found += check(&grid, k, rule, 1, seed);
            }
        }
        assert!(found > 10_000, "{found}");
    }

    /// On maps wider than a word.
    #[test]
    fn links_reach_far() {
        let (mut far, widths) = (0, [150, 65, 3]);
        for (seed, width) in (0..).zip(widths) {
            let height = 153 - width;
            let blocked = |x: u32, y: u32| (x * 31 + y * 17 + seed as u32).is_multiple_of(997);
            let grid = Grid::from_fn(width, height, blocked).expect("a valid size");
            for (k, rule) in CASES {
                far += check(&grid, k, rule, 41, seed);
            }
        }
        for seed in 0..4 {
            let (grid, _) = wide_grid(seed);
            far += check(&grid, FiniteK::N8, CornerRule::Never, 41, seed);
        }
        assert!(far > 1000, "{far}");
    }

    #[test]
    fn there_are_none_where_corners_are_cut_or_moves_are_longer() {
        let grid = Arc::new(Grid::from_fn(2, 2, |_, _| false).expect("a valid size"));
        for rule in [CornerRule::Never, CornerRule::One, CornerRule::Always] {
            let space = FreeSpace::<Centers>::new(Arc::clone(&grid), rule);
            let never = rule == CornerRule::Never;
            for (k, is_there) in [(2, true), (3, never), (4, false)] {
                let k = K::Finite(FiniteK::new(k).expect("a valid k"));
                assert_eq!(Centers::check(&space, k).is_ok(), is_there, "k = {k}, {rule:?}");
            }
            assert!(Centers::check(&space, K::Any).is_err(), "{rule:?}");
        }
    }
}
