//! The cells that a convex polygon meets, row by row, and which of them are blocked.

use mediant_grid::{BitRow, Grid, Placement, PlacementKind, Vertex};

/// The cells that a convex polygon between vertices meets: at corners those whose open interior its own meets, at centers those that it touches
/// at all.
///
/// Scan conversion, in half cells: what the polygon covers of a row of cells is what its edges cover there, and all between. Rows are columns of the
/// map where the polygon is higher than wide, so that there are few of them, and runs of bits in each.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cover {
    transposed: bool,
    /// The first row.
    top: i32,
    /// For each row the first and the last cell.
    rows: Vec<(i32, i32)>,
}

impl Cover {
    /// Covers the polygon, not a flat one, that has these edges and fills the box from `low` to `high`. Lines within the polygon may be
    /// among the edges, and edges along an axis may be missing.
    pub(crate) fn set<P: Placement>(&mut self, low: Vertex, high: Vertex, edges: &[[Vertex; 2]]) {
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
        // From a row to the next one it is two half cells, but at centers the edge begins and ends half way.
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

    /// Whether no cell is blocked.
    pub(crate) fn is_free(&self, grid: &Grid) -> bool {
        self.rows(grid).all(|(_, row, first, last)| row.first_blocked(first, last + 1) > last)
    }

    /// Vertices around the first and the last blocked cell of each row: at corners the two outer corners of each, the hull of which is that of all
    /// blocked cells; at centers the cells around both.
    pub(crate) fn extremes<P: Placement>(&self, grid: &Grid) -> impl Iterator<Item = Vertex> {
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

/// In half cells, how far a vertex is from the corner of its cell.
const fn half<P: Placement>() -> i32 {
    match P::KIND {
        PlacementKind::Corner => 0,
        PlacementKind::Center => 1,
    }
}

#[cfg(test)]
mod tests {
    use mediant_grid::{Centers, Corners};
    use mediant_oracle::{Rng, random_grid};

    use super::*;

    /// Whether the triangle and cell (x, y) meet, by separating lines, in half cells: at corners their interiors, at centers both with their rims.
    fn meets<P: Placement>(triangle: [Vertex; 3], x: i32, y: i32) -> bool {
        let t = triangle.map(|at| (i64::from(2 * at.x + half::<P>()), i64::from(2 * at.y + half::<P>())));
        let (x, y) = (i64::from(2 * x), i64::from(2 * y));
        let square = [(x, y), (x + 2, y), (x, y + 2), (x + 2, y + 2)];
        let mut normals = vec![(1, 0), (0, 1)];
        normals.extend([(0, 1), (1, 2), (2, 0)].map(|(i, j)| (t[j].1 - t[i].1, t[i].0 - t[j].0)));
        normals.into_iter().all(|(u, v)| {
            let range = |points: &[(i64, i64)]| {
                let along = points.iter().map(|&(x, y)| u * x + v * y);
                (along.clone().min().expect("a point"), along.max().expect("a point"))
            };
            let (one, other) = (range(&t), range(&square));
            match P::KIND {
                PlacementKind::Corner => one.0 < other.1 && other.0 < one.1,
                PlacementKind::Center => one.0 <= other.1 && other.0 <= one.1,
            }
        })
    }

    fn check<P: Placement>(seed: u64) -> [usize; 2] {
        let (grid, _) = random_grid(seed);
        let (width, height) = P::vertices(&grid);
        let mut rng = Rng::new(seed ^ 0xC0);
        let mut counts = [0; 2];
        for _ in 0..20 {
            let mut vertex = || Vertex::new(rng.below(width) as i32, rng.below(height) as i32);
            let [a, b, c] = [vertex(), vertex(), vertex()];
            if a.to(b).det(a.to(c)) == 0 {
                continue;
            }
            let mut cover = Cover::default();
            let low = Vertex::new(a.x.min(b.x).min(c.x), a.y.min(b.y).min(c.y));
            let high = Vertex::new(a.x.max(b.x).max(c.x), a.y.max(b.y).max(c.y));
            cover.set::<P>(low, high, &[[a, b], [b, c], [c, a]]);
            let cells = (0..grid.height() as i32).flat_map(|y| (0..grid.width() as i32).map(move |x| (x, y)));
            let blocked: Vec<(i32, i32)> =
                cells.filter(|&(x, y)| grid.is_blocked(x, y) && meets::<P>([a, b, c], x, y)).collect();
            let case = format!("seed {seed}: {a} {b} {c}");
            assert_eq!(cover.is_free(&grid), blocked.is_empty(), "{case}");
            // Each extreme corner is one of a blocked cell, and in its row, or column, none lies beyond it.
            let corners: Vec<Vertex> = cover.extremes::<Corners>(&grid).collect();
            let all = blocked.iter().flat_map(|&(x, y)| [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)]);
            let all: Vec<Vertex> = all.map(Vertex::from).collect();
            assert!(corners.iter().all(|at| all.contains(at)), "{case}");
            for at in all {
                let beyond =
                    corners.iter().filter(|p| if cover.transposed { p.x == at.x } else { p.y == at.y });
                let along = |p: &Vertex| if cover.transposed { p.y } else { p.x };
                assert!(beyond.clone().any(|p| along(p) <= along(&at)), "{case}: {at}");
                assert!(beyond.clone().any(|p| along(p) >= along(&at)), "{case}: {at}");
            }
            counts[usize::from(blocked.is_empty())] += 1;
        }
        counts
    }

    #[test]
    fn a_triangle_covers_what_no_line_separates_from_it() {
        let mut counts = [0; 4];
        for seed in 0..300 {
            let seen = [check::<Corners>(seed), check::<Centers>(seed)];
            counts.iter_mut().zip(seen.as_flattened()).for_each(|(count, seen)| *count += seen);
        }
        assert!(counts.iter().all(|&count| count > 200), "{counts:?}");
    }
}
