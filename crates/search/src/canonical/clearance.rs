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

mod repair;

use mediant_grid::{
    CellOffset, Change, Grid, Interrupt, Interrupted, Placement, PlacementKind, Versioned, VertexId, load,
    room_for,
};

use self::repair::Repair;
use crate::filled::filled;

/// The stage that an interrupted call names.
const DURING: &str = "finding how far obstacles are";

/// The clearance of each vertex, two bytes each; 255 also stands for all larger distances.
#[derive(Debug)]
pub(crate) struct Clearance {
    values: Versioned<[u8; 2]>,
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

/// One of the two bytes. Each is the Chebyshev distance between vertices to the nearest marked one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Layer {
    /// [`VertexClearance::free`]: at centers blocked cells are marked, at corners all vertices of blocked
    /// cells. The outside of the map is blocked.
    Free,
    /// [`VertexClearance::corner`]: at centers the cells that touch a convex corner are marked, at corners
    /// convex corners. There is none outside of the map.
    Corner,
}

impl Layer {
    /// The distance of the positions beyond the map.
    const fn outside(self) -> u8 {
        match self {
            Self::Free => 0,
            Self::Corner => u8::MAX,
        }
    }

    /// Which of the 64 vertices of row y from column x on are marked. The bits beyond the last column mean
    /// nothing.
    #[inline]
    fn marked<P: Placement>(self, grid: &Grid, (x, y): (i32, i32)) -> u64 {
        let rows = grid.rows();
        let cells = |dx: i32, dy: i32| load(rows.words(), rows.index(x + dx, y + dy));
        let around =
            |dx: i32, dy: i32| [cells(dx - 1, dy - 1), cells(dx, dy - 1), cells(dx - 1, dy), cells(dx, dy)];
        // See `is_convex_corner`.
        let corners = |dx: i32, dy: i32| {
            let [nw, ne, sw, se] = around(dx, dy);
            (nw | se) ^ (ne | sw)
        };
        match (self, P::KIND) {
            (Self::Free, PlacementKind::Center) => cells(0, 0),
            (Self::Free, PlacementKind::Corner) => around(0, 0).into_iter().fold(0, |any, cells| any | cells),
            (Self::Corner, PlacementKind::Center) => {
                corners(0, 0) | corners(1, 0) | corners(0, 1) | corners(1, 1)
            }
            (Self::Corner, PlacementKind::Corner) => corners(0, 0),
        }
    }
}

impl Clearance {
    pub(crate) fn new<P: Placement>(grid: &Grid, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        let free = distances::<P>(grid, Layer::Free, interrupt)?;
        let corner = distances::<P>(grid, Layer::Corner, interrupt)?;
        let (width, height) = P::vertices(grid);
        let count = width as usize * height as usize;
        room_for::<[u8; 2]>(count, DURING)?;
        let mut values = Vec::with_capacity(count);
        for (free, corner) in rows(&free, width).zip(rows(&corner, width)).take(height as usize) {
            interrupt.check(DURING)?;
            values.extend(free.iter().zip(corner).map(|(&free, &corner)| [free, corner]));
        }
        Ok(Self { values: values.into() })
    }

    /// That of the map after a change, with the same values as a new one, by work that follows the vertices
    /// whose values change; a new one where that would be quicker.
    pub(crate) fn after<P: Placement>(
        &self,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        match self.repaired::<P>(change, interrupt)? {
            Some(repaired) => Ok(repaired),
            None => Self::new::<P>(change.after(), interrupt),
        }
    }

    /// That of the map after a change, unless too many values change.
    fn repaired<P: Placement>(
        &self,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<Self>, Interrupted> {
        let mut values = self.values.edit_if_room(DURING)?;
        for layer in [Layer::Free, Layer::Corner] {
            if !Repair::new::<P>(&mut values, change.after(), layer).follow::<P>(change, interrupt)? {
                return Ok(None);
            }
        }
        Ok(Some(Self { values: values.finish() }))
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
pub(crate) const fn is_convex_corner([nw, ne, sw, se]: [bool; 4]) -> bool {
    // Neither diagonal is free with the other one, nor do both have a blocked cell.
    (nw | se) != (ne | sw)
}

/// The distance of each vertex to the nearest marked one, in two passes, with a frame of one position on all
/// sides: with that, vertices at the edges need no case of their own.
fn distances<P: Placement>(grid: &Grid, layer: Layer, interrupt: &Interrupt) -> Result<Vec<u8>, Interrupted> {
    let (width, height) = P::vertices(grid);
    let (width, height) = (width as usize, height as usize);
    let stride = width + 2;
    let mut values = filled(layer.outside(), stride * (height + 2), interrupt)?;
    for y in 1..=height {
        interrupt.check(DURING)?;
        let mut marked = 0;
        for x in 0..width {
            marked =
                if x % 64 == 0 { layer.marked::<P>(grid, (x as i32, y as i32 - 1)) } else { marked >> 1 };
            let at = y * stride + x + 1;
            let above = &values[at - stride - 1..=at - stride + 1];
            let least = above.iter().fold(values[at - 1], |least, &value| least.min(value));
            values[at] = if marked & 1 == 1 { 0 } else { least.saturating_add(1) };
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
    Ok(values)
}

/// The rows of so many vertices, without the frame.
fn rows(values: &[u8], width: u32) -> impl Iterator<Item = &[u8]> {
    let width = width as usize;
    values.chunks_exact(width + 2).skip(1).map(move |row| &row[1..=width])
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, GridGraph, Vertex};
    use mediant_moves::FiniteK;
    use mediant_oracle::{Rng, caves, noise, on_all_cores, random_change, rooms, seeds, suite_grid};

    use super::*;

    fn check<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, seed: u64) {
        let graph = GridGraph::<P>::new(Arc::clone(grid), FiniteK::N4, rule).unwrap();
        let clearance = Clearance::new::<P>(grid, &Interrupt::NEVER).unwrap();
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
        let clearance = Clearance::new::<Centers>(graph.grid(), &Interrupt::NEVER).unwrap();
        let at = |x, y| clearance.of(graph.id(Vertex::new(x, y)).unwrap()).free;
        assert_eq!([at(0, 0), at(9, 300), at(300, 253), at(300, 265)], [1, 10, 254, 255]);
    }

    fn large(seed: u64) -> Grid {
        let rng = &mut Rng::new(seed);
        match seed % 6 {
            0 => suite_grid(seed).0,
            1 => rooms(rng, 170, 140),
            2 => caves(rng, 166, 150),
            3 => noise(rng, 640, 90, 0),
            4 => noise(rng, 264, 163, 1),
            _ => noise(rng, 150, 130, 20),
        }
    }

    /// Of so many changes, how many were not too large.
    fn follows<P: Placement>(seed: u64, steps: u32) -> u32 {
        let rng = &mut Rng::new(seed);
        let (mut map, never, mut repaired) = (Arc::new(large(seed)), &Interrupt::NEVER, 0);
        let mut clearance = Clearance::new::<P>(&map, never).unwrap();
        for step in 0..steps {
            let change = random_change(rng, &map);
            let new = Clearance::new::<P>(change.after(), never).unwrap();
            repaired += u32::from(clearance.repaired::<P>(&change, never).unwrap().is_some());
            let next = clearance.after::<P>(&change, never).unwrap();
            let wrong = next.values.iter().zip(&*new.values).position(|(one, other)| one != other);
            assert_eq!(wrong, None, "seed {seed}, edit {step}: {:?}", change.cells());
            (clearance, map) = (next, Arc::clone(change.after()));
        }
        repaired
    }

    #[test]
    fn clearance_follows_edits() {
        on_all_cores(seeds(18), |seed| {
            let repaired = follows::<Centers>(seed, 20) + follows::<Corners>(seed, 20);
            assert!(seed % 6 == 0 || repaired > 4, "seed {seed}: {repaired} of 40");
        });
    }

    /// A list of cells is blocked or freed, first one of them, then two, and so on. Counts the changes that
    /// the distances follow. After all others they are made anew, and are equal: only these counts show when
    /// a repair is given up.
    #[test]
    fn the_number_of_repairs_is_pinned() {
        fn repaired<P: Placement>() -> [usize; 2] {
            let (rng, never) = (&mut Rng::new(3), &Interrupt::NEVER);
            let map = Arc::new(rooms(rng, 170, 140));
            let cells: Vec<(u32, u32)> = (0..200).map(|_| (rng.below(170), rng.below(140))).collect();
            let clearance = Clearance::new::<P>(&map, never).unwrap();
            [true, false].map(|is_blocked| {
                let is_repaired = |&count: &usize| {
                    let cells = cells[..count].iter().map(|&(x, y)| (x, y, is_blocked));
                    let change = Change::new(Arc::clone(&map)).edit_cells(cells);
                    clearance.repaired::<P>(&change, never).unwrap().is_some()
                };
                (1..=cells.len()).filter(is_repaired).count()
            })
        }
        assert_eq!([repaired::<Centers>(), repaired::<Corners>()], [[12, 48]; 2]);
    }
}
