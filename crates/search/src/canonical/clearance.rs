//! How far the nearest obstacle is.

use mediant_grid::{CellOffset, Grid, Lattice, Place, Placement, VertexId};

/// For each vertex, the side of the free square around it: the largest c such that no cell with an offset of at most c − 1 (at
/// centers), or from −c to c − 1 (at corners), along either axis is blocked. A byte a vertex; 255 stands for all above.
#[derive(Clone, Debug)]
pub(crate) struct Clearance {
    values: Box<[u8]>,
}

impl Clearance {
    pub(crate) fn new<P: Place>(lattice: &Lattice<P>) -> Self {
        let cells = of_cells(lattice.grid());
        let (width, height) = (lattice.grid().width() as usize, lattice.grid().height() as usize);
        let values = match P::PLACEMENT {
            Placement::Center => cells,
            Placement::Corner => {
                let of = |x: usize, y: usize| if x < width && y < height { cells[y * width + x] } else { 0 };
                let corner = |x: usize, y: usize| {
                    let (left, above) = (x.wrapping_sub(1), y.wrapping_sub(1));
                    of(x, y).min(of(left, y)).min(of(x, above)).min(of(left, above))
                };
                (0..=height).flat_map(|y| (0..=width).map(move |x| corner(x, y))).collect()
            }
        };
        Self { values: values.into_boxed_slice() }
    }

    #[inline]
    pub(crate) fn of(&self, id: VertexId) -> u32 {
        self.values.get(id.index()).copied().map_or(0, u32::from)
    }

    pub(crate) fn bytes(&self) -> usize {
        self.values.len()
    }

    /// The clearance from which on this cell is known to be free.
    pub(crate) fn needed<P: Place>((x, y): CellOffset) -> u32 {
        let along = |offset: i32| match P::PLACEMENT {
            Placement::Corner if offset < 0 => offset.unsigned_abs(),
            _ => offset.unsigned_abs() + 1,
        };
        along(x).max(along(y))
    }
}

/// The Chebyshev distance of each cell to the nearest blocked one, in two passes.
fn of_cells(grid: &Grid) -> Vec<u8> {
    let (width, height) = (grid.width() as usize, grid.height() as usize);
    let mut values = vec![0_u8; width * height];
    for y in 0..height {
        for x in 0..width {
            if grid.is_blocked(x as i32, y as i32) {
                continue;
            }
            let least = if x == 0 || y == 0 || x + 1 == width || y + 1 == height {
                0
            } else {
                let above = &values[(y - 1) * width + x - 1..=(y - 1) * width + x + 1];
                above.iter().fold(values[y * width + x - 1], |least, &value| least.min(value))
            };
            values[y * width + x] = least.saturating_add(1);
        }
    }
    for y in (0..height.saturating_sub(1)).rev() {
        for x in (1..width.saturating_sub(1)).rev() {
            let below = &values[(y + 1) * width + x - 1..=(y + 1) * width + x + 1];
            let least = below.iter().fold(values[y * width + x + 1], |least, &value| least.min(value));
            let value = &mut values[y * width + x];
            *value = (*value).min(least.saturating_add(1));
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, Vertex};
    use mediant_moves::K;
    use mediant_oracle::{seeds, suite_grid};

    use super::*;

    fn check<P: Place>(grid: &Arc<Grid>, rule: P::Rule, seed: u64) {
        let lattice = Lattice::<P>::new(Arc::clone(grid), K::FOUR_CONNECTED, rule).unwrap();
        let clearance = Clearance::new(&lattice);
        for id in (0..lattice.vertex_count() as u32).map(VertexId) {
            let Vertex { x, y } = lattice.vertex(id);
            let free = |c: u32| {
                let reach = -(c as i32) - 1..=c as i32;
                let cells = reach.clone().flat_map(|dy| reach.clone().map(move |dx| (dx, dy)));
                let mut cells = cells.filter(|&cell| Clearance::needed::<P>(cell) <= c);
                cells.all(|(dx, dy)| grid.is_free(x + dx, y + dy))
            };
            let expected = (1..).take_while(|&c| free(c)).last().unwrap_or(0);
            assert_eq!(clearance.of(id), expected, "({x}, {y}), seed {seed}");
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
        let lattice = Lattice::<Centers>::new(open, K::FOUR_CONNECTED, CornerRule::Never).unwrap();
        let at = |x, y| Clearance::new(&lattice).of(lattice.id(Vertex::new(x, y)).unwrap());
        assert_eq!([at(0, 0), at(9, 300), at(300, 253), at(300, 265)], [1, 10, 254, 255]);
    }
}
