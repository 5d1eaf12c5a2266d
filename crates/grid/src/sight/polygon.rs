//! The cells that a convex polygon meets, row by row, and which of them are blocked.

use crate::{BitRow, Grid, Placement, PlacementKind, Vertex};

/// The cells that a convex polygon with corners at vertices meets. Under corner placement a cell is met if
/// the open interiors of both intersect, under center placement if both touch at all.
///
/// Scan conversion, in units of half a cell: in each row of cells the polygon meets the cells that its edges
/// meet and all cells between. If the polygon is higher than wide, rows are columns of the map, so that there
/// are few of them with long runs of bits.
///
/// Hidden: the caller must ensure that polygon and box fit together.
#[derive(Clone, Debug, Default)]
pub struct PolygonCells {
    transposed: bool,
    /// The first row.
    top: i32,
    /// The first and the last cell of each row.
    rows: Vec<(i32, i32)>,
}

impl PolygonCells {
    /// Takes the polygon with these edges, whose bounding box is from `low` to `high`. Its area must not be
    /// 0. The edges may include segments within the polygon, and edges along an axis may be left out.
    pub fn set<P: Placement>(&mut self, low: Vertex, high: Vertex, edges: &[[Vertex; 2]]) {
        self.transposed = high.y - low.y > high.x - low.x;
        let (first, last) = if self.transposed { (low.x, high.x) } else { (low.y, high.y) };
        self.top = first;
        self.rows.clear();
        self.rows.resize((last - first + half::<P>()) as usize, (i32::MAX, i32::MIN));
        for &[a, b] in edges {
            let [a, b] = [a, b].map(|at| if self.transposed { (at.y, at.x) } else { (at.x, at.y) });
            if a.1 < b.1 {
                self.add_edge::<P>(a, b);
            } else if a.1 > b.1 {
                self.add_edge::<P>(b, a);
            }
        }
    }

    /// Adds the cells along the edge from a down to b.
    fn add_edge<P: Placement>(&mut self, a: (i32, i32), b: (i32, i32)) {
        let (dx, dy) = (2 * (b.0 - a.0), 2 * (b.1 - a.1));
        // From one row to the next it is two half cells, but at centers the edge begins and ends in the
        // middle of a row.
        let [one, two] = [dx, 2 * dx].map(|dx| (dx.div_euclid(dy), dx.rem_euclid(dy)));
        let (mut y, end) = (2 * a.1 + half::<P>(), 2 * b.1 + half::<P>());
        // The edge is at x + rest / dy.
        let (mut x, mut rest) = (2 * a.0 + half::<P>(), 0);
        while y < end {
            let is_half = y & 1 == 1 || y + 1 == end;
            let (whole, part) = if is_half { one } else { two };
            let carry = rest + part >= dy;
            let next = (x + whole + i32::from(carry), rest + part - if carry { dy } else { 0 });
            let (low, high) = if dx >= 0 { ((x, rest), next) } else { (next, (x, rest)) };
            // ⌈x / 2⌉ is ⌊x / 2⌋ for even integers only.
            let ceil = |(x, rest): (i32, i32)| (x >> 1) + i32::from(x & 1 == 1 || rest > 0);
            let (first, last) = match P::KIND {
                PlacementKind::Corner => (low.0 >> 1, ceil(high) - 1),
                PlacementKind::Center => (ceil(low) - 1, high.0 >> 1),
            };
            let row = &mut self.rows[((y >> 1) - self.top) as usize];
            *row = (row.0.min(first), row.1.max(last));
            (x, rest) = next;
            y += 2 - i32::from(is_half);
        }
    }

    /// Whether all cells of the polygon are free.
    pub fn is_free(&self, grid: &Grid) -> bool {
        self.rows(grid).all(|(_, row, first, last)| row.first_blocked(first, last + 1) > last)
    }

    /// Vertices around the first and the last blocked cell of each row. At corners: the outer corners of
    /// both, so that the convex hull of the result is that of all blocked cells. At centers: the cells around
    /// both.
    pub fn extremes<P: Placement>(&self, grid: &Grid) -> impl Iterator<Item = Vertex> {
        let ends = self.rows(grid).filter_map(|(y, row, first, last)| {
            let blocked = row.first_blocked(first, last + 1);
            (blocked <= last).then(|| (y, blocked, row.run_start(last + 1, first) - 1))
        });
        let beyond = half::<P>();
        let around = move |(y, first, last)| {
            let columns =
                (-beyond..=0).map(move |x| first + x).chain((1 - beyond..=1).map(move |x| last + x));
            columns.flat_map(move |x| (-beyond..=1).map(move |offset| (x, y + offset)))
        };
        ends.flat_map(around)
            .map(|(x, y)| if self.transposed { Vertex::new(y, x) } else { Vertex::new(x, y) })
    }

    fn rows<'g>(&self, grid: &'g Grid) -> impl Iterator<Item = (i32, BitRow<'g>, i32, i32)> {
        let matrix = if self.transposed { grid.columns() } else { grid.rows() };
        self.rows.iter().zip(self.top..).map(move |(&(first, last), y)| (y, matrix.row(y), first, last))
    }
}

/// The offset of a vertex from the top left corner of its cell, in half cells.
const fn half<P: Placement>() -> i32 {
    match P::KIND {
        PlacementKind::Corner => 0,
        PlacementKind::Center => 1,
    }
}
