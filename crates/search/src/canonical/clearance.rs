//! How far the nearest obstacle is, and the nearest corner of one.
//!
//! **Far from corners there are no forced successors.** Take the box of cells around vertex v that holds all
//! cells that any move from or to v sweeps; its radius is R(k) cells. Suppose no convex corner of an obstacle
//! lies inside the box: no grid point with exactly one blocked cell around it, or with two that touch
//! diagonally.
//!
//! 1. Then every edge-connected component of free cells in the box is a rectangle, as a polyomino without
//!    reflex vertices and without pinches.
//! 2. The move a from u into v and the move b from v to w lie in one such rectangle. With u and w, their
//!    whole bounding box lies in it.
//! 3. Every cheapest path of displacement a + b on an empty grid stays in that bounding box, so it is legal.
//!
//! So every successor that is not natural is pruned, under either placement and every rule of motion. (At
//! corners the box is taken one wider, so that no vertex of the path is a gap.)

use mediant_grid::{CellOffset, GridGraph, Interrupt, Interrupted, Placement, PlacementKind, VertexId};

use crate::filled::filled;

/// The stage that an interrupted call names.
const DURING: &str = "finding how far obstacles are";

/// The clearance of each vertex, two bytes each; 255 also stands for all larger distances.
#[derive(Clone, Debug)]
pub(crate) struct Clearance {
    values: Box<[[u8; 2]]>,
}

/// The clearance of one vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct VertexClearance {
    /// The side of the free square: the largest c such that no cell with an offset of at most c − 1 (at
    /// centers), or from −c to c − 1 (at corners), along either axis is blocked.
    pub(crate) free: u32,
    /// The Chebyshev distance to the nearest convex corner of an obstacle; at centers from the nearest corner
    /// of the vertex's cell.
    pub(crate) corner: u32,
}

impl Clearance {
    pub(crate) fn new<P: Placement>(
        graph: &GridGraph<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let grid = graph.grid();
        let (width, height) = (grid.width() as usize, grid.height() as usize);
        let cells = distances((width, height), 0, interrupt, |x, y| grid.is_blocked(x as i32, y as i32))?;
        let blocked = |x: usize, y: usize| grid.is_blocked(x as i32, y as i32);
        let points = distances((width + 1, height + 1), u8::MAX, interrupt, |x, y| {
            let (left, above) = (x.wrapping_sub(1), y.wrapping_sub(1));
            is_convex_corner([blocked(left, above), blocked(x, above), blocked(left, y), blocked(x, y)])
        })?;
        let point = |x: usize, y: usize| points[y * (width + 1) + x];
        let mut values = Vec::with_capacity(graph.vertex_count());
        match P::KIND {
            PlacementKind::Center => {
                for y in 0..height {
                    interrupt.check(DURING)?;
                    values.extend((0..width).map(|x| {
                        let above = point(x, y).min(point(x + 1, y));
                        [cells[y * width + x], above.min(point(x, y + 1)).min(point(x + 1, y + 1))]
                    }));
                }
            }
            PlacementKind::Corner => {
                let cell =
                    |x: usize, y: usize| if x < width && y < height { cells[y * width + x] } else { 0 };
                for y in 0..=height {
                    interrupt.check(DURING)?;
                    values.extend((0..=width).map(|x| {
                        let (left, above) = (x.wrapping_sub(1), y.wrapping_sub(1));
                        let free = cell(x, y).min(cell(left, y)).min(cell(x, above)).min(cell(left, above));
                        [free, point(x, y)]
                    }));
                }
            }
        }
        Ok(Self { values: values.into_boxed_slice() })
    }

    #[inline]
    pub(crate) fn of(&self, id: VertexId) -> VertexClearance {
        let [free, corner] = self.values.get(id.index()).copied().unwrap_or_default().map(u32::from);
        VertexClearance { free, corner }
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        size_of_val(&*self.values)
    }

    /// The least [`free`](VertexClearance::free) whose square holds this cell.
    pub(crate) fn needed<P: Placement>((x, y): CellOffset) -> u32 {
        let along = |offset: i32| match P::KIND {
            PlacementKind::Corner if offset < 0 => offset.unsigned_abs(),
            _ => offset.unsigned_abs() + 1,
        };
        along(x).max(along(y))
    }

    /// The distance to corners from which on there are no forced successors, where moves have coordinates up
    /// to `radius`.
    pub(crate) fn needed_from_corners<P: Placement>(radius: i32) -> u32 {
        radius.unsigned_abs() + u32::from(P::KIND == PlacementKind::Corner)
    }
}

/// Whether of the four cells around a grid point, row by row, exactly one is blocked, or two that touch
/// diagonally.
pub(crate) fn is_convex_corner([nw, ne, sw, se]: [bool; 4]) -> bool {
    match [nw, ne, sw, se].into_iter().filter(|&blocked| blocked).count() {
        1 => true,
        2 => nw == se,
        _ => false,
    }
}

/// The Chebyshev distance of each position to the nearest marked one, in two passes; `outside` is the
/// distance of the positions beyond the edges.
fn distances(
    (width, height): (usize, usize),
    outside: u8,
    interrupt: &Interrupt,
    marked: impl Fn(usize, usize) -> bool,
) -> Result<Vec<u8>, Interrupted> {
    // With a frame around them, positions at the edges need no case of their own.
    let stride = width + 2;
    let mut values = filled(outside, stride * (height + 2), interrupt)?;
    for y in 1..=height {
        interrupt.check(DURING)?;
        for x in 1..=width {
            let at = y * stride + x;
            let above = &values[at - stride - 1..=at - stride + 1];
            let least = above.iter().fold(values[at - 1], |least, &value| least.min(value));
            values[at] = if marked(x - 1, y - 1) { 0 } else { least.saturating_add(1) };
        }
    }
    for y in (1..=height).rev() {
        interrupt.check(DURING)?;
        for x in (1..=width).rev() {
            let at = y * stride + x;
            let below = &values[at + stride - 1..=at + stride + 1];
            let least = below.iter().fold(values[at + 1], |least, &value| least.min(value));
            values[at] = values[at].min(least.saturating_add(1));
        }
    }
    let mut within = Vec::with_capacity(width * height);
    for y in 1..=height {
        interrupt.check(DURING)?;
        within.extend_from_slice(&values[y * stride + 1..=y * stride + width]);
    }
    Ok(within)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, Grid, Vertex};
    use mediant_moves::FiniteK;
    use mediant_oracle::{seeds, suite_grid};

    use super::*;

    fn check<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, seed: u64) {
        let graph = GridGraph::<P>::new(Arc::clone(grid), FiniteK::N4, rule).unwrap();
        let clearance = Clearance::new(&graph, &Interrupt::NEVER).unwrap();
        for id in (0..graph.vertex_count() as u32).map(VertexId) {
            let Vertex { x, y } = graph.vertex(id);
            let free = |c: u32| {
                let reach = -(c as i32) - 1..=c as i32;
                let cells = reach.clone().flat_map(|dy| reach.clone().map(move |dx| (dx, dy)));
                let mut cells = cells.filter(|&cell| Clearance::needed::<P>(cell) <= c);
                cells.all(|(dx, dy)| grid.is_free(x + dx, y + dy))
            };
            let expected = (1..).take_while(|&c| free(c)).last().unwrap_or(0);
            assert_eq!(clearance.of(id).free, expected, "({x}, {y}), seed {seed}");
        }
    }

    #[test]
    fn clearance_is_the_free_square() {
        for seed in seeds(60) {
            let grid = Arc::new(suite_grid(seed).0);
            check::<Centers>(&grid, CornerRule::Never, seed);
            check::<Corners>(&grid, DiagonalGap::Open, seed);
        }
        let open = Arc::new(Grid::from_fn(600, 530, |_, _| false).unwrap());
        let graph = GridGraph::<Centers>::new(open, FiniteK::N4, CornerRule::Never).unwrap();
        let clearance = Clearance::new(&graph, &Interrupt::NEVER).unwrap();
        let at = |x, y| clearance.of(graph.id(Vertex::new(x, y)).unwrap()).free;
        assert_eq!([at(0, 0), at(9, 300), at(300, 253), at(300, 265)], [1, 10, 254, 255]);
    }
}
