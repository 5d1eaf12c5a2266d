//! Subgoal graphs at centers, over N(2) and N(3): those of Uras, Koenig & Hernández 2013, in which corners are never cut.

use mediant_grid::{BitIndex, BitMatrix, Centers, CornerRule, FreeSpace, Grid, Vector, Vertex, load};
use mediant_moves::{Cost, FiniteK, K};

use crate::{
    Hierarchy, SubgoalError, SubgoalPlacement,
    lines::{Lines, Run, ahead, behind},
    placement::{BuildContext, EdgeKind, Edges},
};

impl SubgoalPlacement for Centers {
    type Scratch = ();
    type Prepared = Lines;

    fn check(space: &FreeSpace<Self>, k: K) -> Result<(), SubgoalError> {
        match k {
            K::Finite(FiniteK::N4) => Ok(()),
            K::Finite(FiniteK::N8) if space.rule() == CornerRule::Never => Ok(()),
            _ => Err(SubgoalError::Centers { k, rules: space.rules() }),
        }
    }

    fn prepare(space: &FreeSpace<Self>) -> (BitMatrix, Lines) {
        Lines::new(space.grid())
    }

    fn edges(_: K, _: Hierarchy) -> Edges {
        Edges::Direct
    }

    fn links(
        map: BuildContext<'_, Self>,
        (): &mut (),
        from: Vertex,
        which: EdgeKind,
        mut tell: impl FnMut(u32, Cost),
    ) {
        let BuildContext { space, subgoals, norm, k, .. } = map;
        let lines = subgoals.prepared();
        let tell = |to: Vector, cost: Cost| {
            if let Some(id) = subgoals.id(from + to) {
                tell(id, cost);
            }
        };
        let diagonally = k == K::Finite(FiniteK::N8);
        let [straight, other] =
            [Vector::new(1, 0), Vector::new(1, i32::from(diagonally))].map(|v| norm.length(v));
        Links { grid: space.grid(), lines, from, which, costs: (straight, other), tell }.find(diagonally);
    }
}

/// The search for the subgoals that are directly reachable from a cell.
struct Links<'l, F> {
    grid: &'l Grid,
    lines: &'l Lines,
    from: Vertex,
    which: EdgeKind,
    /// Of u and v.
    costs: (Cost, Cost),
    /// Is told where a subgoal is, or a blocked cell, and what the way there costs.
    tell: F,
}

/// The cells a·u + b·v, with a, b ≥ 1, between two adjacent moves u and v, of which u is straight.
///
/// Which of their subgoals are directly reachable: go along v step by step, and in each row from there along u up to the first subgoal or
/// blocked cell, but never as far as where a row before ended. For of a subgoal that is directly reachable, every optimal path on an empty grid is legal
/// and meets no other subgoal: where two in a row part around a blocked cell, one has a convex corner there.
#[derive(Clone, Copy, Debug)]
struct Cone {
    /// Whether u lies in a row.
    is_row: bool,
    /// 1 or −1: u.
    u: i32,
    /// v along u's line (1, −1 or 0), and across (1 or −1).
    v: (i32, i32),
    /// How far along u.
    a: i32,
    /// How far along v.
    b: i32,
}

impl<F: FnMut(Vector, Cost)> Links<'_, F> {
    fn find(mut self, diagonally: bool) {
        let [right, left] = [1, -1].map(|x| self.axis(true, x));
        let [down, up] = [1, -1].map(|y| self.axis(false, y));
        for (x, across) in [(1, right), (-1, left)] {
            for (y, along) in [(1, down), (-1, up)] {
                if y < 0 && self.which == EdgeKind::Edges {
                    continue;
                }
                if !diagonally {
                    self.cone(Cone { is_row: true, u: x, v: (0, y), a: across, b: along });
                    continue;
                }
                let Run { free: b, meets } = self.lines.diagonal(self.from, (x, y));
                if meets {
                    (self.tell)(Vector::new(x * (b + 1), y * (b + 1)), self.costs.1 * (b + 1) as u32);
                }
                self.cone(Cone { is_row: true, u: x, v: (x, y), a: across, b });
                self.cone(Cone { is_row: false, u: y, v: (y, x), a: along, b });
            }
        }
    }

    /// Tells what ends the way along an axis. How many cells are before it.
    fn axis(&mut self, is_row: bool, u: i32) -> i32 {
        let (bits, at) = self.lines.along(is_row, self.from);
        let free = if u > 0 { ahead(bits.words(), at.offset(1)) } else { behind(bits.words(), at) };
        let (x, y) = if is_row { (u * (free + 1), 0) } else { (0, u * (free + 1)) };
        let to = Vector::new(x, y);
        if self.which.holds(to) {
            (self.tell)(to, self.costs.0 * (free + 1) as u32);
        }
        free
    }

    fn cone(&mut self, cone: Cone) {
        if cone.u > 0 { self.sweep::<true>(cone) } else { self.sweep::<false>(cone) }
    }

    fn sweep<const AHEAD: bool>(&mut self, Cone { is_row, u, v, mut a, b }: Cone) {
        let (stops, mut at) = self.lines.along(is_row, self.from);
        let blocked = if is_row { self.grid.rows() } else { self.grid.columns() };
        let (stops, blocked, step) = (stops.words(), blocked.words(), v.1 * stops.bits_per_row() + v.0);
        for row in 1..=b {
            if a == 0 {
                return;
            }
            at = at.offset(step);
            let word = load(stops, at.offset(if AHEAD { 1 } else { -64 }));
            let zeros = if AHEAD { word.trailing_zeros() } else { word.leading_zeros() } as i32;
            if zeros >= a {
                continue;
            }
            let free = if zeros < 64 { zeros } else { free_beyond::<AHEAD>(stops, at, a) };
            if free == a {
                continue;
            }
            a = free;
            let BitIndex(stop) = at.offset(u * (a + 1));
            if blocked.get(stop as usize / 64).is_some_and(|word| word >> (stop % 64) & 1 == 0) {
                let (along, across) = (v.0 * row + u * (a + 1), v.1 * row);
                let to = if is_row { Vector::new(along, across) } else { Vector::new(across, along) };
                (self.tell)(to, self.costs.0 * (a + 1) as u32 + self.costs.1 * row as u32);
            }
        }
    }
}

/// How many zeros there are ahead of, or behind, `at`, of which 64 are known; `most` if there are as many.
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

    use mediant_grid::{Centers, CornerRule, FreeSpace, Grid, Placement, Vector, Vertex};
    use mediant_moves::{Cost, FiniteK, K};
    use mediant_oracle::{Explicit, random_grid, wide_grid};

    use crate::{
        SubgoalPlacement,
        norm::Norm,
        placement::{BuildContext, EdgeKind, Edges},
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

    /// Of all subgoals those to which an optimal path among obstacles is as short as without any, and does not lead over another one: by
    /// searches of the grid graph.
    fn check(grid: &Grid, k: FiniteK, rule: CornerRule, every: usize, seed: u64) -> usize {
        let space = FreeSpace::<Centers>::new(Arc::new(grid.clone()), rule);
        let norm = Norm::new(K::Finite(k)).expect("a small k");
        let subgoals = Subgoals::new(Centers::prepare(&space));
        let edges = Edges::Direct;
        let map = BuildContext { space: &space, subgoals: &subgoals, norm: &norm, k: K::Finite(k), edges };
        let explicit = Explicit::new(grid, Centers::rules(rule), Some(k));
        let all: Vec<Vertex> = explicit.free_vertices().filter(|&at| is_subgoal(grid, at)).collect();
        assert_eq!(
            all,
            (0..subgoals.len() as u32).map(|id| subgoals.vertex(id)).collect::<Vec<_>>(),
            "seed {seed}"
        );
        let h = |a: Vertex, b: Vertex| norm.length(a.to(b));
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
        let mut told = 0;
        for from in explicit.free_vertices().step_by(every) {
            let costs = explicit.costs_from(from);
            let near: Vec<usize> = (0..all.len())
                .filter(|&i| all[i] != from && is_direct(costs.to(all[i]), h(from, all[i])))
                .collect();
            let over = |i: usize, j: usize| {
                i != j && direct[j][i] && h(from, all[j]) + h(all[j], all[i]) == h(from, all[i])
            };
            let joined = |i: &usize| !near.iter().any(|&j| over(*i, j));
            for which in [EdgeKind::All, EdgeKind::Edges] {
                let below = |to: Vector| to.y > 0 || to.y == 0 && to.x > 0;
                let expected: Vec<(u32, Cost)> = near
                    .iter()
                    .copied()
                    .filter(joined)
                    .filter(|&i| which == EdgeKind::All || below(from.to(all[i])))
                    .map(|i| (i as u32, h(from, all[i])))
                    .collect();
                let mut links = Vec::new();
                Centers::links(map, &mut (), from, which, |id, cost| links.push((id, cost)));
                links.sort_unstable();
                assert_eq!(links, expected, "seed {seed}, k = {k}, {rule:?}, {which:?}, from {from:?}");
                told += links.len();
            }
        }
        told
    }

    /// k, rule.
    const CASES: [(FiniteK, CornerRule); 3] = [
        (FiniteK::N8, CornerRule::Never),
        (FiniteK::N4, CornerRule::Never),
        (FiniteK::N4, CornerRule::Always),
    ];

    #[test]
    fn links_are_what_is_directly_reachable() {
        let mut told = 0;
        for seed in 0..60 {
            let (grid, _) = random_grid(seed);
            for (k, rule) in CASES {
                told += check(&grid, k, rule, 1, seed);
            }
        }
        assert!(told > 10_000, "{told}");
    }

    /// Wider than a word.
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
