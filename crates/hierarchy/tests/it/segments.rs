//! The index of CHPA* has the edges of the definition: a window slides over the padded map, and joins
//! segments where a 4-connected path leads through it (Teleiša & Čalnerytė 2023, Section 3). Diagonal edges,
//! for eight neighbors, are not in the paper: there the path leads to the corner cell of the diagonal
//! neighbor.

use crate::common::{grid_graph, k, map, segments};
use mediant_grid::{AsciiMap, CornerRule, Grid, Identity, Vertex};
use mediant_hierarchy::{HierarchyError, SegmentGraph};
use mediant_oracle::{Rng, describe, on_all_cores, seeds};

const EAST: u8 = 1;
const SOUTH: u8 = 2;
const SOUTH_EAST: u8 = 4;
const SOUTH_WEST: u8 = 8;
const EDGES: [u8; 4] = [EAST, SOUTH, SOUTH_EAST, SOUTH_WEST];

/// Whether each cell of a window is free, row by row.
struct Window {
    width: usize,
    free: Vec<bool>,
}

impl Window {
    /// A cell beyond the map is free if the nearest cell on it is.
    fn new(grid: &Grid, left: i32, top: i32, width: usize, height: usize) -> Self {
        let is_free = |i: usize| {
            let (x, y) = (left + (i % width) as i32, top + (i / width) as i32);
            grid.is_free(x.clamp(0, grid.width() as i32 - 1), y.clamp(0, grid.height() as i32 - 1))
        };
        Self { width, free: (0..width * height).map(is_free).collect() }
    }

    /// Whether a 4-connected path leads from a free cell in `from` to a free cell in `to`.
    fn joins(&self, from: impl Fn(usize, usize) -> bool, to: impl Fn(usize, usize) -> bool) -> bool {
        let (width, height) = (self.width, self.free.len() / self.width);
        let cells = || (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let mut trail: Vec<_> = cells().filter(|&(x, y)| from(x, y)).collect();
        let mut seen = vec![false; self.free.len()];
        while let Some((x, y)) = trail.pop() {
            let is_on = x < width && y < height;
            if !is_on || !self.free[y * width + x] || std::mem::replace(&mut seen[y * width + x], true) {
                continue;
            }
            // Left of and above the window, numbers wrap around to ones that are outside as well.
            trail.extend([(x + 1, y), (x.wrapping_sub(1), y), (x, y + 1), (x, y.wrapping_sub(1))]);
        }
        cells().any(|(x, y)| to(x, y) && seen[y * width + x])
    }
}

/// Whether there is this edge from the segment in column `x` and row `y`.
fn is_edge(grid: &Grid, side: u32, diagonals: bool, (x, y): (u32, u32), edge: u8) -> bool {
    let (columns, rows) = (grid.width().div_ceil(side), grid.height().div_ceil(side));
    let (left, top, side) = ((x * side) as i32, (y * side) as i32, side as usize);
    let (has_right, has_below) = (x + 1 < columns, y + 1 < rows);
    match edge {
        EAST => {
            let window = Window::new(grid, left, top, side + 1, side);
            has_right && window.joins(|x, _| x == 0, |x, _| x == side)
        }
        SOUTH => {
            let window = Window::new(grid, left, top, side, side + 1);
            has_below && window.joins(|_, y| y == 0, |_, y| y == side)
        }
        SOUTH_EAST => {
            let window = Window::new(grid, left, top, side + 1, side + 1);
            let from = |x, y| x == 0 || y == 0;
            diagonals && has_right && has_below && window.joins(from, |x, y| (x, y) == (side, side))
        }
        _ => {
            let window = Window::new(grid, left - 1, top, side + 1, side + 1);
            let from = |x, y| x == side || y == 0;
            diagonals && x > 0 && has_below && window.joins(from, |x, y| (x, y) == (0, side))
        }
    }
}

/// The edges of each segment: the bytes behind the identity and the side.
fn edges(graph: &SegmentGraph) -> Vec<u8> {
    graph.to_bytes().split_off(Identity::BYTES + 4)
}

/// Checks an index. Returns how many windows of each kind had no edge, and how many had one.
fn check(grid: &Grid, side: u32, number: u32, seed: u64) -> [[usize; 4]; 2] {
    let grid_graph = grid_graph(grid, k(number), CornerRule::Never);
    let graph = segments(&grid_graph, side);
    let (columns, rows) = (grid.width().div_ceil(side), grid.height().div_ceil(side));
    let edges = edges(&graph);
    let case = || {
        let map = describe(grid, grid_graph.rules(), Vertex::new(-1, -1), Vertex::new(-1, -1), seed);
        format!("k = {number}, segments of {side}; {map}")
    };
    assert_eq!(graph.segments(), (columns * rows) as usize, "{}", case());
    assert_eq!(edges.len(), graph.segments(), "{}", case());
    let mut counts = [[0; 4]; 2];
    let places = (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y)));
    for (place, found) in places.zip(&edges) {
        assert!(*found < 16, "{found} at {place:?}; {}", case());
        for (kind, edge) in EDGES.into_iter().enumerate() {
            let expected = is_edge(grid, side, number == 3, place, edge);
            assert_eq!(found & edge != 0, expected, "edge {edge} of segment {place:?}; {}", case());
            counts[usize::from(expected)][kind] += 1;
        }
    }
    let [_, joined] = counts;
    assert_eq!(graph.edges(), joined.iter().sum::<usize>(), "{}", case());
    counts
}

fn sum(all: impl IntoIterator<Item = [[usize; 4]; 2]>) -> [[usize; 4]; 2] {
    let mut sum = [[0; 4]; 2];
    for counts in all {
        sum.iter_mut().flatten().zip(counts.iter().flatten()).for_each(|(sum, count)| *sum += count);
    }
    sum
}

#[test]
fn edges_are_those_of_the_definition() {
    let check = |seed: u64| {
        let (grid, mut rng) = (map(seed), Rng::new(seed ^ 0x5E6));
        let largest = SegmentGraph::MAX_SIDE;
        let side = if rng.chance(5) { largest - rng.below(4) } else { 1 + rng.below(9) };
        sum([2, 3].map(|number| check(&grid, side, number, seed)))
    };
    let counts = sum(on_all_cores(seeds(400), check));
    let maps = seeds(400).end as usize;
    assert!(counts.iter().flatten().all(|&count| count > maps), "{counts:?} on {maps} maps");
}

/// Every map of 3 × 3 cells, in segments of side 1, 2 and 3.
#[test]
fn edges_are_right_on_every_map_of_nine_cells() {
    let check = |cells: u64| {
        let grid = Grid::from_fn(3, 3, |x, y| cells >> (3 * y + x) & 1 == 1).expect("a valid size");
        let cases = [1, 2, 3].into_iter().flat_map(|side| [2, 3].map(|number| (side, number)));
        sum(cases.map(|(side, number)| check(&grid, side, number, cells)))
    };
    let counts = sum(on_all_cores(0..1 << 9, check));
    assert_eq!(counts.iter().flatten().sum::<usize>(), 512 * 2 * 4 * (9 + 4 + 1));
    assert!(counts.iter().flatten().all(|&count| count > 512), "{counts:?}");
}

/// Checks the edges of the upper left segment of a drawing, in segments of side 3.
#[track_caller]
fn check_drawing(drawing: &str, expected: u8) {
    let grid = AsciiMap::parse(drawing).expect("the drawing is a map").grid;
    let grid_graph = grid_graph(&grid, k(3), CornerRule::Never);
    assert_eq!(edges(&segments(&grid_graph, 3))[0], expected, "of {drawing}");
}

#[test]
fn known_windows() {
    check_drawing("......\n......\n......\n......\n......\n......", EAST + SOUTH + SOUTH_EAST);
    // The wall is in the last column of the segment, or in the first of the next one.
    check_drawing("..#...\n..#...\n..#...\n......\n......\n......", SOUTH + SOUTH_EAST);
    check_drawing("...#..\n...#..\n...#..\n......\n......\n......", SOUTH + SOUTH_EAST);
    // The wall is one column further, outside the window.
    check_drawing("....#.\n....#.\n....#.\n....#.\n....#.\n....#.", EAST + SOUTH + SOUTH_EAST);
    // A path outside of the window does not count, nor do diagonal steps.
    check_drawing(".#....\n##....\n......\n......\n......\n......", EAST + SOUTH + SOUTH_EAST);
    check_drawing("..#...\n.#....\n#.....\n......\n......\n......", SOUTH_EAST);
    // Only the first column of the next segment is free.
    check_drawing("...#\n...#\n...#\n...#", SOUTH);
}

#[test]
fn sides_out_of_range_are_refused() {
    let grid = Grid::from_fn(70, 3, |_, _| false).expect("a valid size");
    let grid_graph = grid_graph(&grid, k(3), CornerRule::Never);
    let max = SegmentGraph::MAX_SIDE;
    assert_eq!(max, 63);
    for side in [0, max + 1, max + 2, u32::MAX] {
        let error = SegmentGraph::new(&grid_graph, side).expect_err("there are no such windows");
        assert_eq!(error, HierarchyError::Side { found: side, min: 1, max });
    }
    for side in [1, max] {
        let graph = SegmentGraph::new(&grid_graph, side).expect("there are such windows");
        assert_eq!((graph.side(), graph.segments()), (side, if side == 1 { 210 } else { 2 }));
    }
}
