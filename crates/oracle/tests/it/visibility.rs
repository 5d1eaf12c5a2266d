//! The visibility graph against Dijkstra on the explicit graph of all legal moves, which assumes nothing
//! about optimal paths.

use mediant_grid::{AsciiMap, DiagonalGap, Grid, PlacementKind, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_oracle::{
    Explicit, Rng, Visibility, adversarial, describe, is_exhaustive, is_gap, maps_of_nine_cells,
    random_free_vertex, seeds, suite_grid, validate, vertex_is_free,
};

const GAPS: [DiagonalGap; 2] = [DiagonalGap::Open, DiagonalGap::Closed];

fn k(k: u32) -> Option<FiniteK> {
    Some(FiniteK::new(k).expect("k in a test"))
}

fn at(x: i32, y: i32) -> Vertex {
    Vertex::new(x, y)
}

fn is_same(a: Option<f64>, b: Option<f64>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * b,
        (None, None) => true,
        _ => false,
    }
}

/// Counts of the cases that the suite met: one that meets too few proves nothing.
#[derive(Debug, Default)]
struct Tally {
    found: u64,
    unreachable: u64,
    /// Paths with a bend or more.
    bent: u64,
    /// Paths that bend at a gap.
    bent_at_gap: u64,
    /// Paths under closed gaps that start or end at a gap.
    closed_end: u64,
}

impl Tally {
    /// Compares the costs from `starts` to all free vertices, and checks the paths.
    fn compare(&mut self, grid: &Grid, gap: DiagonalGap, k: Option<FiniteK>, starts: &[Vertex], seed: u64) {
        let rules = Rules::Corner(gap);
        let explicit = Explicit::new(grid, rules, k);
        let visibility = Visibility::new(grid, gap);
        let graph = visibility.over(k);
        for &start in starts {
            let (expected, found) = (explicit.costs_from(start), graph.costs_from(start));
            for goal in explicit.free_vertices() {
                let (expected, cost) = (expected.to(goal), found.to(goal));
                let context = || format!("k = {k:?}; {}", describe(grid, rules, start, goal, seed));
                assert!(is_same(cost, expected), "{cost:?}, not {expected:?}; {}", context());
                let path = found.path_to(goal);
                assert_eq!(path.is_some(), cost.is_some(), "{}", context());
                match path.zip(cost) {
                    Some((path, cost)) => self.check_path(grid, gap, k, &path, (start, goal, cost), &context),
                    None => self.unreachable += 1,
                }
            }
        }
    }

    /// A path is legal, as long as its cost when measured straight (k = ∞) or else no longer, and bends at
    /// corners only.
    fn check_path(
        &mut self,
        grid: &Grid,
        gap: DiagonalGap,
        k: Option<FiniteK>,
        path: &[Vertex],
        (start, goal, cost): (Vertex, Vertex, f64),
        context: &dyn Fn() -> String,
    ) {
        let straight: f64 = path.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let stated = if k.is_none() { cost } else { straight };
        let outcome = validate(grid, Rules::Corner(gap), None, start, goal, path, stated);
        assert_eq!(outcome, Ok(()), "{path:?}; {}", context());
        assert!(straight <= cost * (1.0 + 1e-9), "{path:?} is longer than {cost}; {}", context());
        let inner = path.get(1..path.len().saturating_sub(1)).unwrap_or_default();
        let bends_at_gap = inner.iter().any(|&at| is_gap(grid, at));
        assert!(!bends_at_gap || gap == DiagonalGap::Open, "{path:?}; {}", context());
        self.found += 1;
        self.bent += u64::from(!inner.is_empty());
        self.bent_at_gap += u64::from(bends_at_gap);
        let closed_end =
            gap == DiagonalGap::Closed && start != goal && [start, goal].iter().any(|&end| is_gap(grid, end));
        self.closed_end += u64::from(closed_end);
    }
}

fn free_vertices(grid: &Grid) -> Vec<Vertex> {
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    let all = (0..=height).flat_map(|y| (0..=width).map(move |x| at(x, y)));
    all.filter(|&at| vertex_is_free(grid, PlacementKind::Corner, at)).collect()
}

/// From every vertex to every other.
#[test]
fn exact_on_every_map_of_nine_cells() {
    let mut tally = Tally::default();
    for (cells, grid) in maps_of_nine_cells(3) {
        let starts = free_vertices(&grid);
        for gap in GAPS {
            for k in [k(2), k(3), k(4), None] {
                tally.compare(&grid, gap, k, &starts, cells);
            }
        }
    }
    let (found, unreachable) = if is_exhaustive() { (464_272, 130_288) } else { (155_008, 43_264) };
    assert_eq!((tally.found, tally.unreachable), (found, unreachable), "{tally:?}");
    assert!(tally.bent > 25_000 && tally.bent_at_gap > 9_000 && tally.closed_end > 1200, "{tally:?}");
}

/// The maps of the suites up to 256 cells, every second one of those that are larger replaced by an
/// adversarial one.
#[test]
fn exact_on_random_maps() {
    let (mut tally, mut maps) = (Tally::default(), 0);
    for seed in seeds(30) {
        let mut rng = Rng::new(seed ^ 0x5EED);
        let grid = match suite_grid(seed).0 {
            grid if grid.width() * grid.height() <= 256 => grid,
            _ if seed % 2 == 0 => adversarial(&mut rng, 9, 8),
            _ => continue,
        };
        maps += 1;
        let is_small = grid.width() * grid.height() <= 30;
        let mut starts = free_vertices(&grid);
        if !is_small {
            starts =
                (0..6).filter_map(|_| random_free_vertex(&mut rng, &grid, PlacementKind::Corner)).collect();
        }
        for gap in GAPS {
            for k in [k(2), k(3), k(4), k(5), k(6), None] {
                tally.compare(&grid, gap, k, &starts, seed);
            }
            if is_small {
                tally.compare(&grid, gap, k(8), &starts, seed);
            }
        }
    }
    // A generator that went wrong must not make the suite empty.
    let enough = [
        tally.found >= 2000 * maps,
        tally.unreachable >= 400 * maps,
        tally.bent >= 800 * maps,
        tally.bent_at_gap >= 100 * maps,
        tally.closed_end >= 10 * maps,
    ];
    assert_eq!(enough, [true; 5], "{tally:?} on {maps} maps");
}

/// On an empty map every cost is h_k itself, here for all displacements to 24 × 17.
#[test]
fn exact_on_empty_maps_for_larger_k() {
    let grid = Grid::from_fn(24, 17, |_, _| false).expect("a valid size");
    let mut tally = Tally::default();
    for k in [k(7), k(9), k(12)] {
        tally.compare(&grid, DiagonalGap::Open, k, &[at(0, 0), at(24, 5)], 0);
    }
    assert_eq!((tally.found, tally.bent), (3 * 2 * 25 * 18, 0), "{tally:?}");
}

/// Checks the cost from `start` to `goal` on a drawing, both ways, under gap rules open and closed.
fn check(drawing: &str, (start, goal): (Vertex, Vertex), k: Option<FiniteK>, expected: [Option<f64>; 2]) {
    let grid = AsciiMap::parse(drawing).expect("a drawing in a test").grid;
    for (gap, expected) in GAPS.into_iter().zip(expected) {
        let visibility = Visibility::new(&grid, gap);
        let graph = visibility.over(k);
        for (a, b) in [(start, goal), (goal, start)] {
            let found = graph.costs_from(a).to(b);
            let context = describe(&grid, Rules::Corner(gap), a, b, 0);
            assert!(is_same(found, expected), "{found:?}, not {expected:?}; k = {k:?}; {context}");
        }
    }
}

#[test]
fn corners_are_convex() {
    let check = |drawing: &str, expected: [&[(i32, i32)]; 2]| {
        let grid = AsciiMap::parse(drawing).expect("a drawing in a test").grid;
        for (gap, expected) in GAPS.into_iter().zip(expected) {
            let corners: Vec<Vertex> = expected.iter().map(|&at| at.into()).collect();
            assert_eq!(Visibility::new(&grid, gap).corners(), corners, "{gap:?}\n{drawing}");
        }
    };
    let one = [(1, 1), (2, 1), (1, 2), (2, 2)];
    check("...\n.#.\n...", [&one, &one]);
    // The sides that touch the border have no convex corner there, nor has the border.
    check("#..\n...\n.#.", [&[(1, 1), (1, 2), (2, 2)], &[(1, 1), (1, 2), (2, 2)]]);
    check("...\n...", [&[], &[]]);
    // Two that meet diagonally: five corners and the gap. The one in the angle of an L is concave.
    let around = [(1, 1), (2, 1), (3, 2), (1, 2), (2, 3), (3, 3)];
    let mut with_gap = [&around[..], &[(2, 2)]].concat();
    with_gap.sort_by_key(|&(x, y)| (y, x));
    let mut without = around;
    without.sort_by_key(|&(x, y)| (y, x));
    check("....\n.#..\n..#.\n....", [&with_gap, &without]);
    let l = [(1, 1), (2, 1), (3, 2), (1, 3), (3, 3)];
    check("....\n.#..\n.##.\n....", [&l, &l]);
}

#[test]
fn known_costs() {
    let root = |n: f64| Some(n.sqrt());
    let block = "....\n.##.\n.##.\n....";
    let across = (at(0, 0), at(3, 3));
    for (k, expected) in [(k(2), 6.0), (k(3), 4.0 + 2.0_f64.sqrt()), (k(4), 3.0 + 5.0_f64.sqrt())] {
        check(block, across, k, [Some(expected); 2]);
    }
    for k in [k(5), None] {
        check(block, across, k, [Some(2.0 + 10.0_f64.sqrt()); 2]);
    }
    // Corridors one cell wide: along either wall, from one to the other, and around a corner.
    check("....", (at(0, 0), at(4, 0)), None, [Some(4.0); 2]);
    check("....", (at(0, 0), at(4, 1)), None, [root(17.0); 2]);
    check("....", (at(0, 0), at(4, 1)), k(3), [Some(3.0 + 2.0_f64.sqrt()); 2]);
    check("..\n#.\n#.", (at(0, 0), at(2, 3)), None, [Some(2.0_f64.sqrt() + 5.0_f64.sqrt()); 2]);
    check("..\n#.\n#.", (at(0, 0), at(2, 3)), k(3), [Some(1.0 + 8.0_f64.sqrt()); 2]);
    // The border beside a blocked cell is closed.
    check(".#.", (at(0, 0), at(3, 0)), None, [None; 2]);
}

#[test]
fn known_costs_at_gaps() {
    let root = |n: f64| Some(n.sqrt());
    // Straight through, bent, and around where there is a way around.
    check("#.\n.#", (at(2, 0), at(0, 2)), None, [root(8.0), None]);
    check("#.\n.#", (at(1, 0), at(0, 1)), None, [Some(2.0), None]);
    check("#..\n.#.\n...", (at(2, 0), at(0, 2)), k(3), [root(8.0), Some(4.0)]);
    // An end at the gap, its own cell on the lower right, or blocked.
    check(".#\n#.", (at(1, 1), at(2, 2)), k(2), [Some(2.0); 2]);
    check(".#\n#.", (at(1, 1), at(0, 0)), None, [root(2.0), None]);
    check("#.\n.#", (at(1, 1), at(0, 1)), None, [Some(1.0), None]);
    check("#.\n.#", (at(1, 1), at(1, 1)), None, [Some(0.0); 2]);
    // Both ends at gaps, in one cell across: the upper left one is entered through that cell, the other is
    // not.
    check(".#.\n#.#\n.#.", (at(1, 1), at(2, 2)), None, [root(2.0), None]);
    check(".#.\n#.#\n.#.", (at(1, 1), at(2, 1)), None, [Some(1.0), None]);
}

/// From one corner of a cell to the opposite one, the others being gaps: N(2) has to touch one of these,
/// though it is no vertex of the graph under closed gaps.
#[test]
fn four_connected_costs_lead_past_a_closed_gap() {
    let cell = "##.\n#.#\n.##";
    check(cell, (at(1, 1), at(2, 2)), k(2), [Some(2.0); 2]);
    check(cell, (at(1, 1), at(2, 2)), k(3), [Some(2.0_f64.sqrt()); 2]);
    let grid = AsciiMap::parse(cell).expect("a drawing in a test").grid;
    assert_eq!(Visibility::new(&grid, DiagonalGap::Closed).corners(), []);
    let explicit = Explicit::new(&grid, Rules::Corner(DiagonalGap::Closed), k(2));
    let path = explicit.costs_from(at(1, 1)).path_to(at(2, 2)).expect("there is a path");
    assert!(is_gap(&grid, path[1]), "{path:?}");
}

#[test]
fn blocked_and_outside_vertices_have_no_cost() {
    let grid = AsciiMap::parse("##.\n##.").expect("a drawing in a test").grid;
    for gap in GAPS {
        let visibility = Visibility::new(&grid, gap);
        let graph = visibility.over(None);
        let free = at(3, 2);
        assert_eq!(graph.costs_from(free).path_to(free), Some(vec![free]));
        assert_eq!(graph.costs_from(free).to(free), Some(0.0));
        for bad in [at(0, 0), at(1, 1), at(4, 1), at(-1, 0), at(i32::MAX, i32::MIN)] {
            assert_eq!(graph.costs_from(free).to(bad), None, "{bad}");
            assert_eq!(graph.costs_from(bad).to(free), None, "{bad}");
            assert_eq!(graph.costs_from(bad).to(bad), None, "{bad}");
            assert_eq!(graph.costs_from(bad).path_to(bad), None, "{bad}");
        }
    }
}
