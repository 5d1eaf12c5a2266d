//! The guarantees of agents that move along legal paths of their maps, in exact fractions.

use std::sync::Arc;

use mediant_grid::{Clearance, CornerRule, Fit, Grid, Outside, PlacementKind, Rules, Vector, Vertex};
use mediant_moves::FiniteK;
use mediant_oracle::{Rng, neighborhood, random_free_vertex, seeds, segment_is_legal, suite_grid};

use crate::clearance::{KINDS, draw};

/// A number n / d with d > 0.
type Fraction = (i128, i128);

/// A segment in half cells.
#[derive(Clone, Copy, Debug)]
struct Segment {
    from: [i128; 2],
    by: [i128; 2],
}

impl Segment {
    fn new(placement: PlacementKind, from: Vertex, to: Vertex) -> Self {
        let offset = i128::from(placement == PlacementKind::Center);
        let half = |v: Vertex| [v.x, v.y].map(|c| 2 * i128::from(c) + offset);
        let (from, to) = (half(from), half(to));
        Self { from, by: [to[0] - from[0], to[1] - from[1]] }
    }

    /// The t in [0, 1] at which the distance to a rectangle can be least: the ends, where the segment crosses
    /// the lines through the sides, and where a corner's perpendicular meets it.
    fn critical(self, low: [i128; 2], high: [i128; 2]) -> Vec<Fraction> {
        let mut all = vec![(0, 1), (1, 1)];
        for axis in 0..2 {
            all.extend([low, high].map(|side| (side[axis] - self.from[axis], self.by[axis])));
        }
        for corner in [low, high, [low[0], high[1]], [high[0], low[1]]] {
            let dot: i128 = (0..2).map(|axis| (corner[axis] - self.from[axis]) * self.by[axis]).sum();
            all.push((dot, self.by.iter().map(|by| by * by).sum()));
        }
        let positive = all.into_iter().filter(|&(_, d)| d != 0).map(|(n, d)| (n * d.signum(), d.abs()));
        positive.filter(|&(n, d)| 0 <= n && n <= d).collect()
    }

    /// The least squared distance to a closed rectangle, in half cells.
    fn squared_distance(self, low: [i128; 2], high: [i128; 2]) -> Fraction {
        let square = |(n, d): Fraction| {
            let gaps = [0, 1].map(|axis| {
                let at = self.from[axis] * d + self.by[axis] * n;
                (low[axis] * d - at).max(at - high[axis] * d).max(0)
            });
            (gaps.iter().map(|gap| gap * gap).sum::<i128>(), d * d)
        };
        let squares = self.critical(low, high).into_iter().map(square);
        squares.min_by(|a, b| (a.0 * b.1).cmp(&(b.0 * a.1))).expect("the ends")
    }

    /// Whether it meets an open rectangle, apart from its ends.
    fn enters(self, low: [i128; 2], high: [i128; 2]) -> bool {
        let (mut enter, mut leave) = ((0, 1), (1, 1));
        for axis in 0..2 {
            let (from, by) = (self.from[axis], self.by[axis]);
            if by == 0 {
                if from <= low[axis] || from >= high[axis] {
                    return false;
                }
                continue;
            }
            let times = [low, high].map(|side| ((side[axis] - from) * by.signum(), by.abs()));
            let [first, last] = if by > 0 { times } else { [times[1], times[0]] };
            if first.0 * enter.1 > enter.0 * first.1 {
                enter = first;
            }
            if last.0 * leave.1 < leave.0 * last.1 {
                leave = last;
            }
        }
        enter.0 * leave.1 < leave.0 * enter.1
    }
}

/// The obstacles as rectangles in half cells: blocked cells, and the outside if it counts.
fn obstacles(grid: &Grid, outside: Outside) -> Vec<([i128; 2], [i128; 2])> {
    let cells = (0..grid.height() as i32).flat_map(|y| (0..grid.width() as i32).map(move |x| (x, y)));
    let blocked = cells.filter(|&(x, y)| grid.is_blocked(x, y));
    let mut all: Vec<_> = blocked
        .map(|(x, y)| [x, y].map(|c| 2 * i128::from(c)))
        .map(|low| (low, low.map(|c| c + 2)))
        .collect();
    if outside == Outside::Blocked {
        let far = 100_000;
        let (width, height) = (2 * i128::from(grid.width()), 2 * i128::from(grid.height()));
        all.extend([
            ([-far, -far], [0, far]),
            ([width, -far], [far, far]),
            ([-far, -far], [far, 0]),
            ([-far, height], [far, far]),
        ]);
    }
    all
}

/// Random legal segments of a map: moves of N(k), or between any two vertices.
fn segments(map: &Grid, rules: Rules, k: Option<FiniteK>, rng: &mut Rng) -> Vec<(Vertex, Vertex)> {
    let placement = rules.placement();
    let mut end = || {
        let from = random_free_vertex(rng, map, placement)?;
        let to = match k {
            Some(k) => {
                let moves = neighborhood(Some(k), map.width(), map.height());
                let Vector { x, y } = *rng.pick(&moves)?;
                Vertex::new(from.x + x, from.y + y)
            }
            None => random_free_vertex(rng, map, placement)?,
        };
        Some((from, to))
    };
    let ends = (0..12).map_while(|_| end());
    ends.filter(|&(a, b)| a != b && segment_is_legal(map, rules, a, b)).collect()
}

const K: [Option<FiniteK>; 4] = [Some(FiniteK::N4), Some(FiniteK::N8), Some(FiniteK::N16), None];

/// Whether the first of the guarantees holds, and not only the second.
fn is_whole(rules: Rules, k: Option<FiniteK>) -> bool {
    matches!(rules, Rules::Center(_)) && k == Some(FiniteK::N4)
        || rules == Rules::Center(CornerRule::Never) && k == Some(FiniteK::N8)
}

#[test]
fn a_disc_keeps_its_radius_along_every_path_of_its_map() {
    let mut tested = [0; 2];
    for seed in seeds(60) {
        let (grid, kind) = suite_grid(seed);
        let (shared, mut rng) = (Arc::new(grid.clone()), Rng::new(seed));
        for (fit, outside) in KINDS {
            let clearance = Clearance::new(Arc::clone(&shared), fit, outside);
            let obstacles = obstacles(&grid, outside);
            // In 64ths of a cell; some are just the clearance of some cell at centers.
            let radius = [32, 33, 64, 96, 135, 226, rng.below(400)][rng.below(7) as usize];
            let map = clearance.for_disc(f64::from(radius) / 64.0).expect("a radius");
            for (rules, k) in Rules::ALL.into_iter().flat_map(|rules| K.map(|k| (rules, k))) {
                let whole = fit == Fit::WholeCells || is_whole(rules, k);
                assert_eq!(
                    Fit::exact(rules, k.map_or(mediant_moves::K::ANY, Into::into)) == Fit::Centers,
                    is_whole(rules, k)
                );
                for (from, to) in segments(&map, rules, k, &mut rng) {
                    let segment = Segment::new(rules.placement(), from, to);
                    let squares = obstacles.iter().map(|&(low, high)| segment.squared_distance(low, high));
                    let Some((n, d)) = squares.min_by(|a, b| (a.0 * b.1).cmp(&(b.0 * a.1))) else { continue };
                    // √(n/d) / 2 is at least radius / 64, or ½ less, or √½ less.
                    let least = |lost: i128| 32 * 32 * n >= (i128::from(radius) - lost).max(0).pow(2) * d;
                    let holds = match rules {
                        _ if whole => least(0),
                        Rules::Center(_) => least(32),
                        Rules::Corner(_) | Rules::CenterGap(_) => least(46),
                    };
                    assert!(
                        holds,
                        "{fit:?}, {outside:?}, radius {radius}/64, {rules}, k {k:?}: {from} to {to} comes as near as \
                         √({n}/{d})/2; {kind}, seed {seed}:\n{}",
                        draw(&grid)
                    );
                    tested[usize::from(whole)] += 1;
                }
            }
        }
    }
    assert!(tested.iter().all(|&n| n > 500), "{tested:?}");
}

#[test]
fn a_square_is_free_along_every_path_of_its_map() {
    let mut tested = 0;
    for seed in seeds(150) {
        let (grid, kind) = suite_grid(seed);
        let mut rng = Rng::new(seed);
        let n = 1 + rng.below(4);
        let map = grid.for_square(n).expect("a square");
        let obstacles = obstacles(&grid, Outside::Blocked);
        for (rules, k) in Rules::ALL.into_iter().flat_map(|rules| K.map(|k| (rules, k))) {
            // The square that moves, seen from the point of the path, in half cells.
            let n = i128::from(n);
            let (start, side) = match rules {
                _ if is_whole(rules, k) => (-1, 2 * n),
                Rules::Center(_) => (0, 2 * n - 2),
                Rules::Corner(_) | Rules::CenterGap(_) => (0, 2 * n - 2),
            };
            for (from, to) in segments(&map, rules, k, &mut rng) {
                let segment = Segment::new(rules.placement(), from, to);
                let hit = obstacles.iter().find(|(low, high)| {
                    segment.enters(low.map(|c| c - start - side), high.map(|c| c - start))
                });
                assert!(
                    hit.is_none(),
                    "n = {n}, {rules}, k {k:?}: {from} to {to} meets {hit:?}; {kind}, seed {seed}:\n{}",
                    draw(&grid)
                );
                tested += 1;
            }
        }
    }
    assert!(tested > 1000, "{tested}");
}

#[test]
fn the_map_of_a_square_has_the_cells_where_it_fits() {
    let mut rng = Rng::new(1);
    for seed in seeds(200) {
        let (grid, kind) = suite_grid(seed);
        let (width, height) = (grid.width(), grid.height());
        for n in
            [1, 2, 3, 1 + rng.below(8), 1 + rng.below(130), 63, 64, 65, width, height, width + 1, u32::MAX]
        {
            let fits = |x: u32, y: u32| {
                let reach = |from: u32| from as i32..(from + n.min(300)) as i32;
                reach(y).all(|y| reach(x).all(|x| grid.is_free(x, y)))
            };
            let expected = Grid::from_fn(width, height, |x, y| !fits(x, y));
            let found = grid.for_square(n).expect("a square");
            assert_eq!(Ok(found), expected, "n = {n}, {kind}, seed {seed}:\n{}", draw(&grid));
        }
    }
}

/// Squares as wide as words, on maps that are wide in both directions.
#[test]
fn wide_squares_cross_words() {
    let blocked = [(70, 140), (139, 20)];
    let grid = Grid::from_fn(210, 203, |x, y| blocked.contains(&(x, y))).expect("a map");
    for n in [1, 5, 31, 63, 64, 65, 70, 127, 128, 129, 203, 204] {
        let hits =
            |x: u32, y: u32| blocked.iter().any(|&(i, j)| (x..x + n).contains(&i) && (y..y + n).contains(&j));
        let expected = Grid::from_fn(210, 203, |x, y| x + n > 210 || y + n > 203 || hits(x, y));
        assert_eq!(Ok(grid.for_square(n).expect("a square")), expected, "n = {n}");
    }
    assert!(grid.for_square(0).is_err());
}
