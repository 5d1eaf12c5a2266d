//! Line of sight: whether a whole straight segment obeys the rules of motion, in integers.

use crate::{
    Centers, Corners, Grid, Placement, PlacementKind, Rules, Vertex, frame::Frame, placement::SweptCells,
    points::centers_see,
};

/// Whether the straight segment from one vertex to another obeys the rules of motion: see
/// [`CornerRule`](crate::CornerRule) for placement at centers, [`DiagonalGap`](crate::DiagonalGap) for
/// placement at corners.
///
/// A segment that leaves the map does not obey them; one of length 0 does if its vertex is free. Under
/// [`DiagonalGap::Closed`](crate::DiagonalGap::Closed) the segment may not pass through a gap. Whether a path
/// may start, end or turn at one is answered by [`FreeSpace::may_turn`](crate::FreeSpace::may_turn).
///
/// Tests 64 cells at once, row by row, or column by column where the segment crosses fewer columns than rows.
///
/// ```
/// use mediant_grid::{AsciiMap, Centers, CornerRule, Vertex, sight::line_of_sight};
/// let map = AsciiMap::parse("
///     ...#
///     .#..
/// ")?;
/// let sees = |to: (i32, i32)| {
///     line_of_sight::<Centers>(&map.grid, CornerRule::Never, Vertex::new(0, 0), to.into())
/// };
/// assert!(sees((2, 0)) && !sees((3, 1)));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[must_use]
pub fn line_of_sight<P: Placement>(grid: &Grid, rule: P::Rule, from: Vertex, to: Vertex) -> bool {
    if !P::is_free(grid, from) || !P::is_free(grid, to) {
        return false;
    }
    if from == to {
        return true;
    }
    let (frame, d) = Frame::of(from.to(to));
    let (matrix, u, v) =
        if frame.transposed { (grid.columns(), from.y, from.x) } else { (grid.rows(), from.x, from.y) };
    if d.y == 0 && P::KIND == PlacementKind::Corner {
        // A whole run of edges at once.
        let (low, high) = (u.min(u + frame.long * d.x), u.max(u + frame.long * d.x));
        let gap = P::closes_gaps(rule) && matrix.any_gap(v, low + 1, high - 1);
        return !gap && !matrix.any_edge(v, low, high - 1);
    }
    P::sweep(rule, d, |cells| match cells {
        SweptCells::AllFree { row, first, last } => {
            let (a, y) = frame.cell::<P>((first, row));
            let (b, _) = frame.cell::<P>((last, row));
            !matrix.any(v + y, u + a.min(b), u + a.max(b))
        }
        SweptCells::EitherFree(cells) => cells.iter().any(|&(i, j)| {
            let (x, y) = frame.cell::<P>((i, j));
            !matrix.get(u + x, v + y)
        }),
    })
}

/// [`line_of_sight`] with the rules as a value; between centers at any angle that of the segment between the
/// middles of two cells of the map.
#[must_use]
pub fn line_of_sight_under(grid: &Grid, rules: Rules, from: Vertex, to: Vertex) -> bool {
    match rules {
        Rules::Center(corners) => line_of_sight::<Centers>(grid, corners, from, to),
        Rules::Corner(gap) => line_of_sight::<Corners>(grid, gap, from, to),
        Rules::CenterGap(gap) => centers_see(grid, gap, from, to),
    }
}
