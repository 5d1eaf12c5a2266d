//! Kramm, Rivera, Hernández & Baier 2018, 'A Suboptimality Bound for 2^k Grid Path Planning', Theorem 3:
//! paths over N(k) between centers against any-angle paths that may bend at cell corners.
//!
//! The reference is a grid with each cell divided into four: the centers and the corners of the old cells are
//! corner vertices of the new grid.

use std::sync::Arc;

use mediant_grid::{AsciiMap, CornerRule, DiagonalGap, Grid, Rules, Vertex};
use mediant_moves::{BOUND_WITHOUT_CORNER_CUTTING, FiniteK, bound_at_centers};
use mediant_oracle::{Explicit, Rng, describe, noise};
use mediant_search::Ends;

use crate::common::with_engines;

const SLACK: f64 = 1.0 + 1e-9;

/// A grid, its free cells, and the any-angle optima between all of them.
struct Instance {
    grid: Arc<Grid>,
    corners: CornerRule,
    free: Vec<Vertex>,
    best: Vec<Vec<Option<f64>>>,
}

/// A pair of cells and the ratio of its cost over N(k) to its any-angle optimum.
type Ratio = (f64, Vertex, Vertex);

impl Instance {
    /// The reference has the rule of corners that treats diagonal gaps like `corners`. Under `Never` it may
    /// still touch corners and slide along walls, as in the paper.
    fn new(grid: Grid, corners: CornerRule) -> Self {
        let quarters = Grid::from_fn(2 * grid.width(), 2 * grid.height(), |x, y| {
            grid.is_blocked(x as i32 / 2, y as i32 / 2)
        });
        let gap = if corners == CornerRule::Always { DiagonalGap::Open } else { DiagonalGap::Closed };
        let graph = Explicit::new(&quarters.expect("a valid size"), Rules::Corner(gap), None);
        let (width, height) = (grid.width() as i32, grid.height() as i32);
        let cells = (0..height).flat_map(|y| (0..width).map(move |x| Vertex::new(x, y)));
        let free: Vec<Vertex> = cells.filter(|cell| grid.is_free(cell.x, cell.y)).collect();
        let center = |cell: &Vertex| Vertex::new(2 * cell.x + 1, 2 * cell.y + 1);
        let best = free.iter().map(|start| {
            let costs = graph.costs_from(center(start));
            free.iter().map(|goal| costs.to(center(goal)).map(|cost| cost / 2.0)).collect()
        });
        Self { best: best.collect(), grid: Arc::new(grid), corners, free }
    }

    /// The ratios of all pairs of cells that an any-angle path joins. Checks that no path over N(k) is
    /// shorter, and that there is none where there is no any-angle path.
    fn ratios(&self, k: u32) -> Vec<Ratio> {
        let (mut ratios, rules) = (Vec::new(), Rules::Center(self.corners));
        with_engines(&self.grid, rules, k, |mut engines| {
            for (&start, best) in self.free.iter().zip(&self.best) {
                for (&goal, &best) in self.free.iter().zip(best).filter(|&(&goal, _)| goal != start) {
                    let (answer, _) = engines[0].solve(Ends::new(start, goal)).expect("both ends are free");
                    let cost = answer.path().map_or(f64::INFINITY, |path| path.cost());
                    let best = best.unwrap_or(f64::INFINITY);
                    assert!(cost * SLACK >= best, "k = {k}: {cost} < {best}; {}", self.describe(start, goal));
                    if best.is_finite() {
                        ratios.push((cost / best, start, goal));
                    }
                }
            }
        });
        ratios
    }

    fn worst(&self, k: u32) -> Ratio {
        self.ratios(k).into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default()
    }

    fn describe(&self, start: Vertex, goal: Vertex) -> String {
        describe(&self.grid, Rules::Center(self.corners), start, goal, 0)
    }
}

/// The ratio between `s` and `g`.
fn drawn(drawing: &str, corners: CornerRule, k: u32) -> f64 {
    let map = AsciiMap::parse(drawing).expect("the drawing is a map");
    let (s, g) = (map.mark('s').expect("s is drawn"), map.mark('g').expect("g is drawn"));
    let ratios = Instance::new(map.grid, corners).ratios(k);
    ratios.iter().find(|&&(_, start, goal)| (start, goal) == (s, g)).expect("there is a way").0
}

fn bound(k: u32) -> f64 {
    bound_at_centers(FiniteK::new(k).expect("k is at least 2"))
}

/// Theorem 3 on every map of 3 × 3 cells, some of which attain the bound.
#[test]
fn theorem_3_holds_with_rule_one_on_small_maps_and_is_tight() {
    let mut worst = [0.0_f64; 5];
    for cells in 0..1_u32 << 9 {
        let grid = Grid::from_fn(3, 3, |x, y| cells >> (3 * y + x) & 1 == 1).expect("a valid size");
        let instance = Instance::new(grid, CornerRule::One);
        for (k, worst) in (2..).zip(&mut worst) {
            let (ratio, start, goal) = instance.worst(k);
            assert!(ratio <= bound(k) * SLACK, "k = {k}: {ratio}; {}", instance.describe(start, goal));
            *worst = worst.max(ratio);
        }
    }
    let root = std::f64::consts::SQRT_2;
    let [two, more @ ..] = worst;
    assert!((two - 6.0 / (2.0 + root)).abs() < 1e-9, "{worst:?}");
    assert!(more.iter().all(|ratio| (ratio - (3.0 * root - 3.0)).abs() < 1e-9), "{worst:?}");
}

/// No path over N(k) is shorter than the any-angle optimum, and none is missing. The bound of Theorem 3 is
/// hardly ever exceeded: on 60 maps by none of 84,620 pairs, on 600 maps by six of 738,000.
#[test]
fn random_maps_rarely_exceed_the_bound_with_rule_one() {
    let (mut pairs, mut beyond) = (0, 0);
    for seed in mediant_oracle::seeds(60) {
        let mut rng = Rng::new(seed);
        let (width, height, percent) = (2 + rng.below(7), 2 + rng.below(6), 10 + rng.below(50));
        let instance = Instance::new(noise(&mut rng, width, height, percent), CornerRule::One);
        for k in 2..=6 {
            for (ratio, start, goal) in instance.ratios(k) {
                let case = || instance.describe(start, goal);
                assert!(
                    ratio <= BOUND_WITHOUT_CORNER_CUTTING.max(bound(k)) * SLACK,
                    "seed {seed}, k = {k}: {ratio}; {}",
                    case()
                );
                beyond += usize::from(ratio > bound(k) * SLACK);
                pairs += 1;
            }
        }
    }
    assert!(pairs > 20_000, "only {pairs} pairs");
    assert!(beyond * 10_000 < pairs, "{beyond} of {pairs} pairs");
}

/// The worst case (as in Figure 6): from a cell around an obstacle to the cell that touches it diagonally.
#[test]
fn figure_6_is_the_worst_case_for_every_k() {
    const FIGURE: &str = "
        #s.
        g#.
        ...
    ";
    for k in 2..=8 {
        let ratio = drawn(FIGURE, CornerRule::One, k);
        assert!((ratio - bound(k)).abs() < 1e-9, "k = {k}: {ratio}");
    }
}

/// Where a path follows walls on both sides in turn, moves between centers zigzag around it.
#[test]
fn theorem_3_fails_with_rule_one() {
    const WALLS_IN_TURN: &str = "
        ..#...
        s#....
        ...#..
        ..#..#
        ..#.#g
        ..#...
    ";
    let root = std::f64::consts::SQRT_2;
    let ratio = drawn(WALLS_IN_TURN, CornerRule::One, 3);
    assert!((ratio - (6.0 * root + 2.0) / (7.0 + root)).abs() < 1e-9, "{ratio}");
    assert!(ratio > bound(3) + 0.003, "{ratio}");
    // With longer moves this map has shorter paths.
    assert!(drawn(WALLS_IN_TURN, CornerRule::One, 4) < bound(4));
}

/// Where moves may pass gaps, an any-angle path runs straight between the rows, while moves between centers
/// zigzag.
#[test]
fn theorem_3_fails_with_rule_always() {
    const CHECKERBOARD: &str = "
        s#.#g
        #.#.#
    ";
    let root = std::f64::consts::SQRT_2;
    for k in 3..=8 {
        let ratio = drawn(CHECKERBOARD, CornerRule::Always, k);
        assert!((ratio - 4.0 * root / (3.0 + root)).abs() < 1e-9, "k = {k}: {ratio}");
        assert!(ratio > bound(k) + 0.03, "k = {k}: {ratio}");
    }
    // Over N(2) there is no path at all.
    assert_eq!(drawn(CHECKERBOARD, CornerRule::Always, 2), f64::INFINITY);
}

/// Where no move may touch a corner, a straight line can be legal and no diagonal step beside it.
#[test]
fn theorem_3_fails_with_rule_never() {
    const STEP: &str = "
        s.#
        #.g
    ";
    let ratio = drawn(STEP, CornerRule::Never, 3);
    assert!((ratio - 3.0 / 5.0_f64.sqrt()).abs() < 1e-9, "{ratio}");
    assert!(ratio > bound(3) && ratio <= BOUND_WITHOUT_CORNER_CUTTING);
    // The move (2, 1) is the straight line.
    assert!((drawn(STEP, CornerRule::Never, 4) - 1.0).abs() < 1e-9);
}
