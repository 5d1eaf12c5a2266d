//! The cells that a segment meets, in order.

use std::iter::FusedIterator;

use mediant_moves::Vector;

use crate::{
    Centers, CornerRule, Corners, DiagonalGap, Placement, PlacementKind, SweptCells, Vertex, frame::Frame,
};

/// The rows that are kept at a time, so that the memory does not grow with the segment.
const ROWS: usize = 4096;

/// The cells that the straight segment between two vertices meets, from its start to its end, each once, as
/// (x, y). Neither vertex has to be on a map, and cells outside of any map are among them.
///
/// - [`PlacementKind::Center`]: every cell that the closed segment touches. Where it passes exactly through a
///   corner of cells these are all four cells there: first the one that it leaves, then the two that it
///   touches in this point alone, then the one that it enters. So these are the cells that must be free
///   under [`CornerRule::Never`]. A segment of length 0 touches its own cell.
/// - [`PlacementKind::Corner`]: every cell whose open interior the segment meets. Where it passes exactly
///   through a vertex these are the cell that it leaves and the one that it enters. Along a grid line it
///   meets no interior: there are no cells.
///
/// A segment between vertices 2³¹ or more apart along an axis, as no map has them, has no cells.
///
/// ```
/// use mediant_grid::{PlacementKind, sight::segment_cells};
/// let cells = |kind, to: (i32, i32)| segment_cells(kind, (0, 0).into(), to.into()).collect::<Vec<_>>();
/// assert_eq!(cells(PlacementKind::Center, (1, 1)), [(0, 0), (1, 0), (0, 1), (1, 1)]);
/// assert_eq!(cells(PlacementKind::Corner, (2, 2)), [(0, 0), (1, 1)]);
/// assert_eq!(cells(PlacementKind::Corner, (2, -1)), [(0, -1), (1, -1)]);
/// assert_eq!(cells(PlacementKind::Corner, (5, 0)), []);
/// ```
#[must_use]
pub fn segment_cells(placement: PlacementKind, from: Vertex, to: Vertex) -> SegmentCells {
    let d = displacement(from, to);
    let (frame, d) = Frame::of(d.unwrap_or(Vector::ZERO));
    let rows = match placement {
        _ if displacement(from, to).is_none() => 0,
        PlacementKind::Center => d.y.saturating_add(1),
        PlacementKind::Corner => d.y,
    };
    SegmentCells { placement, from, frame, d, rows, read: 0, runs: Vec::new(), columns: None }
}

/// The displacement between two vertices, if it fits and its negative does.
fn displacement(from: Vertex, to: Vertex) -> Option<Vector> {
    let along = |from: i32, to: i32| to.checked_sub(from).filter(|&d| d != i32::MIN);
    Some(Vector::new(along(from.x, to.x)?, along(from.y, to.y)?))
}

/// The iterator of [`segment_cells`].
#[derive(Clone, Debug)]
pub struct SegmentCells {
    placement: PlacementKind,
    from: Vertex,
    frame: Frame,
    /// The displacement in the frame.
    d: Vector,
    /// The number of rows of cells in the frame.
    rows: i32,
    /// How many of them were read.
    read: i32,
    /// Rows that were read, the next one last: row, first and last column.
    runs: Vec<(i32, i32, i32)>,
    /// Cells left in the current row: row, next and last column.
    columns: Option<(i32, i32, i32)>,
}

impl SegmentCells {
    /// Reads some more rows. The sweep begins anew, which few segments need: those of maps have at most
    /// 32,769 rows.
    fn read_rows(&mut self) {
        let (read, runs) = (self.read, &mut self.runs);
        let keep = |cells: SweptCells| {
            if let SweptCells::AllFree { row, first, last } = cells
                && row >= read
            {
                runs.push((row, first, last));
            }
            runs.len() < ROWS
        };
        match self.placement {
            PlacementKind::Center => Centers::sweep(CornerRule::Never, self.d, keep),
            PlacementKind::Corner => Corners::sweep(DiagonalGap::Open, self.d, keep),
        };
        // If there are none, there are no more.
        self.read = self.runs.last().map_or(self.rows, |&(row, _, _)| row.saturating_add(1));
        self.runs.reverse();
    }

    fn cell(&self, column: i32, row: i32) -> (i32, i32) {
        let (x, y) = match self.placement {
            PlacementKind::Center => self.frame.offset::<Centers>((column, row)),
            PlacementKind::Corner => self.frame.offset::<Corners>((column, row)),
        };
        (self.from.x + x, self.from.y + y)
    }
}

impl Iterator for SegmentCells {
    type Item = (i32, i32);

    fn next(&mut self) -> Option<(i32, i32)> {
        if self.columns.is_none() {
            if self.runs.is_empty() && self.read < self.rows {
                self.read_rows();
            }
            self.columns = self.runs.pop();
        }
        let (row, column, last) = self.columns?;
        self.columns = (column < last).then(|| (row, column + 1, last));
        Some(self.cell(column, row))
    }
}

impl FusedIterator for SegmentCells {}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(placement: PlacementKind, from: (i32, i32), to: (i32, i32)) -> usize {
        segment_cells(placement, from.into(), to.into()).count()
    }

    #[test]
    fn rows_are_read_in_parts() {
        for n in [4095, 4096, 4097, 32_768] {
            assert_eq!(count(PlacementKind::Corner, (0, 0), (n, n)), n as usize);
            assert_eq!(count(PlacementKind::Center, (0, 0), (n, n)), 3 * n as usize + 1);
            let steep = segment_cells(PlacementKind::Corner, Vertex::new(7, 0), Vertex::new(8 - n, -n));
            let cells: Vec<_> = steep.collect();
            assert!(cells.windows(2).all(|two| two[0] != two[1]));
            assert_eq!((cells[0], cells.last()), ((6, -1), Some(&(8 - n, -n))));
        }
    }

    #[test]
    fn the_ends_of_the_coordinates() {
        const FAR: i32 = i32::MAX;
        let first = |placement, from: (i32, i32), to: (i32, i32)| {
            segment_cells(placement, from.into(), to.into()).take(3).collect::<Vec<_>>()
        };
        for placement in [PlacementKind::Center, PlacementKind::Corner] {
            assert_eq!(count(placement, (i32::MIN, 0), (0, 0)), 0);
            assert_eq!(count(placement, (-FAR, -FAR), (FAR, FAR)), 0);
            assert_eq!(first(placement, (0, 0), (FAR, FAR))[0], (0, 0));
            assert_eq!(first(placement, (0, 0), (FAR, FAR - 1))[..2], [(0, 0), (1, 0)]);
        }
        assert_eq!(first(PlacementKind::Corner, (FAR, FAR), (0, 0))[0], (FAR - 1, FAR - 1));
        assert_eq!(first(PlacementKind::Corner, (0, i32::MIN), (9, i32::MIN)), []);
        assert_eq!(first(PlacementKind::Center, (FAR, FAR), (FAR, FAR)), [(FAR, FAR)]);
        assert_eq!(count(PlacementKind::Corner, (3, 3), (3, 3)), 0);
    }
}
