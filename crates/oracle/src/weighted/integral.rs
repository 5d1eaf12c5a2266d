//! The exact integral of the weights along a straight segment.

use mediant_grid::{PlacementKind, Vertex};
use mediant_moves::Vector;

use super::WeightedMap;

/// Which cells a straight segment passes, relative to its first vertex, and the share of its length that
/// each of them has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shares {
    by: Vector,
    pieces: Vec<Piece>,
    denominator: u128,
}

/// A piece of a segment, of positive length.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// The cell in which the piece lies; two if it lies on the grid line between them.
    pub cells: Vec<Vector>,
    /// The share of the segment's length, times the common denominator.
    pub numerator: u128,
}

/// The integral of the weights along a segment, divided by the length of the segment: numerator /
/// denominator is a mean of weights. The fraction is not reduced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Integral {
    /// The displacement of the segment.
    pub by: Vector,
    /// The sum of the weights of the cells, each times the numerator of its share.
    pub numerator: u128,
    /// The common denominator of the shares.
    pub denominator: u128,
}

impl Shares {
    /// The shares of a segment with displacement d. The common denominator is 2·|x|·|y| between centers and
    /// |x|·|y| between corners, where 0 counts as 1. A segment of length 0 has no pieces.
    ///
    /// Every cell around the segment is clipped against it: time is proportional to |x|·|y|.
    #[must_use]
    pub fn new(placement: PlacementKind, d: Vector) -> Self {
        let by = [i128::from(d.x), i128::from(d.y)];
        let [width, height] = by.map(|n| n.abs().max(1));
        // In half cells the segment runs from (first, first) by (2x, 2y), in this time. So it meets grid
        // lines at whole times, at even ones from a corner.
        let whole = 2 * width * height;
        let (first, unit) = match placement {
            PlacementKind::Center => (1, 1),
            PlacementKind::Corner => (0, 2),
        };
        let range = |n: i32| n.min(0) - 1..=n.max(0) + 1;
        let cells = range(d.y).flat_map(|y| range(d.x).map(move |x| Vector::new(x, y)));
        let piece = |cell: Vector| {
            let (mut enter, mut leave) = (0, whole);
            let mut sides = vec![cell];
            let axes =
                [(cell.x, by[0], height, Vector::new(1, 0)), (cell.y, by[1], width, Vector::new(0, 1))];
            for (cell_at, by, time_a_line, step) in axes {
                let (low, high) = (2 * i128::from(cell_at), 2 * i128::from(cell_at) + 2);
                if by == 0 {
                    // A segment on the line between two cells is a piece of the one with the line as its low
                    // side.
                    if !(low..high).contains(&first) {
                        return None;
                    }
                    if low == first {
                        sides.push(cell - step);
                    }
                } else {
                    let times = [low, high].map(|line| (line - first) * by.signum() * time_a_line);
                    enter = enter.max(times[0].min(times[1]));
                    leave = leave.min(times[0].max(times[1]));
                }
            }
            (enter < leave).then(|| Piece { cells: sides, numerator: ((leave - enter) / unit) as u128 })
        };
        let pieces = if by == [0, 0] { Vec::new() } else { cells.filter_map(piece).collect() };
        Self { by: d, pieces, denominator: (whole / unit) as u128 }
    }

    /// The displacement of the segment.
    #[must_use]
    pub fn by(&self) -> Vector {
        self.by
    }

    /// The pieces of the segment, in no particular order.
    #[must_use]
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The common denominator of the shares.
    #[must_use]
    pub fn denominator(&self) -> u128 {
        self.denominator
    }

    /// The integral along the segment that starts at `at`; `None` if a piece has no free cell. A piece
    /// between two free cells has the smaller of their weights.
    #[must_use]
    pub fn integral(&self, map: &WeightedMap, at: Vertex) -> Option<Integral> {
        let weight = |cell: &Vector| map.weight(at.x + cell.x, at.y + cell.y);
        let part =
            |piece: &Piece| Some(piece.numerator * u128::from(piece.cells.iter().filter_map(weight).min()?));
        let numerator = self.pieces.iter().map(part).sum::<Option<u128>>()?;
        Some(Integral { by: self.by, numerator, denominator: self.denominator })
    }
}

impl Integral {
    /// The mean weight along the segment.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }

    /// The integral itself, on cells of this size.
    #[must_use]
    pub fn length(&self, cell_size: (f64, f64)) -> f64 {
        self.mean() * (f64::from(self.by.x) * cell_size.0).hypot(f64::from(self.by.y) * cell_size.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pieces, with their cells and numerators, in the order of cells, and the denominator.
    type Listed = (Vec<(Vec<(i32, i32)>, u128)>, u128);

    fn shares(placement: PlacementKind, x: i32, y: i32) -> Listed {
        let shares = Shares::new(placement, Vector::new(x, y));
        let cells = |piece: &Piece| piece.cells.iter().map(|cell| (cell.x, cell.y)).collect();
        let mut pieces: Vec<_> = shares.pieces.iter().map(|piece| (cells(piece), piece.numerator)).collect();
        pieces.sort();
        (pieces, shares.denominator)
    }

    /// Pieces in one cell each.
    fn single(pieces: &[((i32, i32), u128)], denominator: u128) -> Listed {
        (pieces.iter().map(|&(cell, numerator)| (vec![cell], numerator)).collect(), denominator)
    }

    #[test]
    fn shares_between_centers_by_hand() {
        let shares = |x, y| shares(PlacementKind::Center, x, y);
        assert_eq!(shares(1, 0), single(&[((0, 0), 1), ((1, 0), 1)], 2));
        assert_eq!(shares(0, -1), single(&[((0, -1), 1), ((0, 0), 1)], 2));
        assert_eq!(shares(-1, 1), single(&[((-1, 1), 1), ((0, 0), 1)], 2));
        assert_eq!(shares(1, 2), single(&[((0, 0), 1), ((0, 1), 1), ((1, 1), 1), ((1, 2), 1)], 4));
        assert_eq!(shares(-2, 1), single(&[((-2, 1), 1), ((-1, 0), 1), ((-1, 1), 1), ((0, 0), 1)], 4));
        // Crosses x = 1/2 at 1/4 of its length, 3/2 at 3/4, and so y at 1/6, 1/2, 5/6.
        let (a, b, c) = ([((0, 0), 2), ((0, 1), 1)], [((1, 1), 3), ((1, 2), 3)], [((2, 2), 1), ((2, 3), 2)]);
        assert_eq!(shares(2, 3), single(&[a, b, c].concat(), 12));
        // Through a corner of cells.
        assert_eq!(shares(3, 1), single(&[((0, 0), 1), ((1, 0), 2), ((2, 1), 2), ((3, 1), 1)], 6));
        assert_eq!(shares(3, 0), single(&[((0, 0), 1), ((1, 0), 2), ((2, 0), 2), ((3, 0), 1)], 6));
        assert_eq!(shares(2, 2), single(&[((0, 0), 2), ((1, 1), 4), ((2, 2), 2)], 8));
        assert_eq!(shares(0, 0).0, []);
    }

    #[test]
    fn shares_between_corners_by_hand() {
        let shares = |x, y| shares(PlacementKind::Corner, x, y);
        assert_eq!(shares(1, 0), (vec![(vec![(0, 0), (0, -1)], 1)], 1));
        assert_eq!(shares(0, -1), (vec![(vec![(0, -1), (-1, -1)], 1)], 1));
        assert_eq!(shares(0, 2), (vec![(vec![(0, 0), (-1, 0)], 1), (vec![(0, 1), (-1, 1)], 1)], 2));
        assert_eq!(shares(1, 1), single(&[((0, 0), 1)], 1));
        assert_eq!(shares(-1, 1), single(&[((-1, 0), 1)], 1));
        assert_eq!(shares(1, 2), single(&[((0, 0), 1), ((0, 1), 1)], 2));
        assert_eq!(shares(2, -3), single(&[((0, -2), 1), ((0, -1), 2), ((1, -3), 2), ((1, -2), 1)], 6));
        assert_eq!(shares(2, 2), single(&[((0, 0), 2), ((1, 1), 2)], 4));
    }
}
