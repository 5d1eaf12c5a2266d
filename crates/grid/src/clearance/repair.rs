//! A clearance after a change of the map.
//!
//! A site c that comes or goes matters only in rows where it is the nearest one of its own column: elsewhere
//! another site of the column is nearer to every point of the row. In such a row let F be the square of the
//! distance to c, and E the stored square. For a site to the right of c, F less the square of the distance to
//! that site never falls along the row; for one to the left it never rises; in the column of c the
//! difference has one sign. So **the points with F ≤ E form one interval** of each row.
//!
//! A search for the interval to the left ends at a point from which a site is so near that it lies to the
//! left of c or in its column: that site hides c from there on. To the right it is the same.
//!
//! New sites come first: their squares are minima. Then the points that had the square of a site which is
//! gone are measured anew, in one piece of each row. The points beside the piece tell how far the nearest
//! sites are from it.

use std::ops::Range;

use super::{
    Clearance, Outside,
    columns::NONE,
    envelope::Envelope,
    sites::{Measure, Sites},
};
use crate::{Change, Grid, VersionEdit};

/// A repair takes a step for every so many points at most. These steps are less work than half of a new
/// transform.
const SHARE: usize = 4;

impl Clearance {
    /// The clearance after a change of its map, the same as a new one. The work follows the cells whose
    /// nearest obstacle changes; it is measured anew where that would be quicker, and if the change is one of
    /// another map.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use mediant_grid::{Change, Clearance, Fit, Grid, Outside};
    ///
    /// let hall = Arc::new(Grid::from_fn(40, 9, |_, _| false)?);
    /// let clearance = Clearance::new(Arc::clone(&hall), Fit::Centers, Outside::Blocked);
    /// let clearance = clearance.after(&Change::new(hall).edit_cells([(20, 4, true)]));
    /// assert_eq!(clearance.distance((22, 4).into()), 1.5);
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    #[must_use]
    pub fn after(&self, change: &Change) -> Self {
        let (fit, outside, grid) = (self.fit, self.outside, change.after());
        let is_same = change.before().id() == self.grid.id();
        let squared = is_same.then(|| Repair::new(self, change).follow(change)).flatten();
        let Some(squared) = squared else { return Self::new(grid.clone(), fit, outside) };
        // Where there is an obstacle within reach, there is one.
        let unlimited = outside == Outside::Open
            && squared.words().first() == Some(&u32::MAX)
            && grid.free_cells() == u64::from(grid.width()) * u64::from(grid.height());
        Self { grid: grid.clone(), fit, outside, unlimited, squared: squared.finish() }
    }
}

/// A column and a row of points.
type At = (usize, usize);

struct Repair<'c> {
    squared: VersionEdit<u32>,
    /// The sites before and after the change, by columns.
    sites: [Sites<'c>; 2],
    /// The columns and rows of points.
    size: (usize, usize),
    /// The steps that are left until a new transform is quicker.
    left: usize,
}

impl<'c> Repair<'c> {
    fn new(clearance: &Clearance, change: &'c Change) -> Self {
        let (fit, outside) = (clearance.fit, clearance.outside);
        let by_columns = |grid: &'c Grid| Sites { rows: grid.columns(), measure: fit.into(), outside };
        let sites = [by_columns(change.before()), by_columns(change.after())];
        let (height, width) = sites[0].size();
        let left = clearance.squared.len() / SHARE;
        Self { squared: clearance.squared.edit(), sites, size: (width, height), left }
    }

    /// The squares after the change; `None` where new ones are quicker.
    fn follow(mut self, change: &Change) -> Option<VersionEdit<u32>> {
        let (mut new, mut gone) = (Vec::new(), Vec::new());
        for at in change.cells() {
            let more = usize::from(self.sites[0].measure.is_from_corners());
            let side = |first: u32, count: u32| first as usize..(first + count) as usize + more;
            let (columns, rows) = (side(at.x, at.width), side(at.y, at.height));
            self.spend(columns.len() * rows.len())?;
            for at in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
                match self.sites.map(|sites| is_site(sites, at)) {
                    [false, true] => new.push(at),
                    [true, false] => gone.push(at),
                    _ => {}
                }
            }
        }
        for site in new {
            for y in self.rows(self.sites[1], site) {
                for x in self.nearest(site, y)? {
                    let (at, square) = (y * self.size.0 + x, self.square(site, (x, y)));
                    if square < self.squared.words()[at] {
                        self.squared.set(at, square);
                    }
                }
            }
        }
        let mut pieces = Vec::new();
        for site in gone {
            for y in self.rows(self.sites[0], site) {
                let columns = self.nearest(site, y)?;
                if !columns.is_empty() {
                    pieces.push((y, columns.start, columns.end));
                }
            }
        }
        self.measure(pieces)?;
        Some(self.squared)
    }

    fn spend(&mut self, steps: usize) -> Option<()> {
        self.left = self.left.checked_sub(steps)?;
        Some(())
    }

    /// The rows in which no site of its column is nearer than this one.
    fn rows(&self, sites: Sites<'_>, (x, y): At) -> Range<usize> {
        let last = self.size.1 - 1;
        // Half of the way to the next site.
        let half = |next: Option<usize>, all: usize| next.map_or(all, |rows| rows.div_ceil(2).min(all));
        let above = y.checked_sub(1).and_then(|above| upwards(sites, (x, above)));
        let below = (y < last).then(|| downwards(sites, (x, y + 1))).flatten();
        y - half(above, y)..y + half(below, last - y) + 1
    }

    /// The square of the distance from a point to a site.
    fn square(&self, site: At, at: At) -> u32 {
        let [across, along] = [site.0.abs_diff(at.0), site.1.abs_diff(at.1)].map(|points| {
            let points = points as u64;
            match self.sites[0].measure {
                Measure::CentersToSquares => (2 * points).saturating_sub(1),
                Measure::CornersToSquares | Measure::CentersToCenters => points,
            }
        });
        u32::try_from(across * across + along * along).unwrap_or(u32::MAX)
    }

    /// The points of a row that are as near to a site as their squares say, or nearer.
    fn nearest(&mut self, site: At, y: usize) -> Option<Range<usize>> {
        let (start, width) = (y * self.size.0, self.size.0);
        let row = &self.squared.words()[start..start + width];
        let holds = |x: &usize| self.square(site, (*x, y)) <= row[*x];
        let scale = if self.sites[0].measure == Measure::CentersToSquares { 2 } else { 1 };
        // Whether a site that is as near to this point as the square says is not beyond the column of `site`.
        let is_hidden = |x: usize| {
            let within = (scale * x.abs_diff(site.0) as u64).saturating_sub(1);
            within > 0 && within * within >= u64::from(row[x])
        };
        let mut steps = 1;
        let mut looked_at = |x: &usize| {
            steps += 1;
            holds(x) || is_hidden(*x)
        };
        let found = if holds(&site.0) {
            Some(site.0)
        } else {
            let left = (0..site.0).rev().find(&mut looked_at).filter(holds);
            left.or_else(|| (site.0 + 1..width).find(&mut looked_at).filter(holds))
        };
        let columns = found.map_or(0..0, |found| {
            let first = (0..found).rev().take_while(holds).last().unwrap_or(found);
            first..(found + 1..width).take_while(holds).last().unwrap_or(found) + 1
        });
        self.spend(steps + columns.len())?;
        Some(columns)
    }

    /// Measures pieces of rows anew: of each the row, the first column, and the one after the last.
    fn measure(&mut self, mut pieces: Vec<(usize, usize, usize)>) -> Option<()> {
        pieces.sort_unstable();
        pieces.dedup_by(|next, piece| {
            let joined = next.0 == piece.0 && next.1 <= piece.2;
            if joined {
                piece.2 = piece.2.max(next.2);
            }
            joined
        });
        let (mut envelope, mut columns, mut squares) = (Envelope::default(), Vec::new(), Vec::new());
        let (sites, width) = (self.sites[1], self.size.0);
        for (y, first, end) in pieces {
            let start = y * width;
            // A site nearest to a point of the piece is not farther from the point beside it than that.
            let row = &self.squared.words()[start..start + width];
            let from =
                first.checked_sub(1).map_or(0, |beside| beside.saturating_sub(columns_within(row[beside])));
            let to = row
                .get(end)
                .map_or(width, |&square| width.min((end + 1).saturating_add(columns_within(square))));
            self.spend(4 * (to - from))?;
            columns.clear();
            columns.extend((from..to).map(|x| rows_to_site(sites, (x, y))));
            squares.clear();
            squares.resize(to - from, 0);
            let edge = if sites.outside == Outside::Blocked { 0 } else { NONE };
            let beyond = [from == 0, to == width].map(|is_edge| if is_edge { edge } else { NONE });
            envelope.row(sites.measure, beyond, &columns, &mut squares);
            for x in first..end {
                self.squared.set(start + x, squares[x - from]);
            }
        }
        Some(())
    }
}

/// At least as many columns as the nearest site can be away from a point with this square, in cells or in
/// half cells.
fn columns_within(square: u32) -> usize {
    if square == u32::MAX { usize::MAX } else { square.isqrt() as usize + 2 }
}

/// Whether a point is a site. All of these take sites by columns.
fn is_site(sites: Sites<'_>, (x, y): At) -> bool {
    sites.word(y / 64, x) >> (y % 64) & 1 == 1
}

/// The rows from a point to the nearest site of its column, [`NONE`] if there is none.
fn rows_to_site(sites: Sites<'_>, at: At) -> u16 {
    let rows = [upwards(sites, at), downwards(sites, at)].into_iter().flatten().min();
    rows.map_or(NONE, |rows| rows as u16)
}

/// The rows from a point to the nearest site above it in its column, 0 if it is one itself.
fn upwards(sites: Sites<'_>, (x, y): At) -> Option<usize> {
    for word in (0..=y / 64).rev() {
        let beyond = if word == y / 64 { 63 - y % 64 } else { 0 };
        let bits = sites.word(word, x) << beyond;
        if bits != 0 {
            return Some(y - (64 * word + 63 - beyond - bits.leading_zeros() as usize));
        }
    }
    (sites.outside == Outside::Blocked).then_some(y + 1)
}

/// The rows from a point to the nearest site below it in its column, 0 if it is one itself.
fn downwards(sites: Sites<'_>, (x, y): At) -> Option<usize> {
    let height = sites.size().0;
    for word in y / 64..sites.words() {
        let first = y.max(64 * word);
        let bits = sites.word(word, x) >> (first % 64);
        let row = first + bits.trailing_zeros() as usize;
        if bits != 0 && row < height {
            return Some(row - y);
        }
    }
    (sites.outside == Outside::Blocked).then_some(height - y)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{super::Fit, *};
    use crate::Rectangle;

    /// Squares with sides of 1 to 60 cells are blocked, or freed. Counts the changes that the clearance
    /// follows. After all others it is measured anew, and is equal: only these counts show when a repair is
    /// given up.
    #[test]
    fn the_number_of_repairs_is_pinned() {
        let is_wall = |x: u32, y: u32| (x * 7 + y * 13).is_multiple_of(41) || x % 24 == 5 && y % 17 > 3;
        let map = Arc::new(Grid::from_fn(200, 150, is_wall).expect("a map"));
        let repaired = |fit, outside, is_blocked| {
            let clearance = Clearance::new(Arc::clone(&map), fit, outside);
            let is_repaired = |&side: &u32| {
                let change = Change::new(Arc::clone(&map));
                let change = change.edit(Rectangle::new(70, 50, side, side), |_, _| is_blocked);
                Repair::new(&clearance, &change).follow(&change).is_some()
            };
            (1..=60).filter(is_repaired).count()
        };
        let found = [Fit::Centers, Fit::WholeCells].map(|fit| {
            [Outside::Open, Outside::Blocked]
                .map(|outside| [true, false].map(|is_blocked| repaired(fit, outside, is_blocked)))
        });
        assert_eq!(found, [[[29, 22]; 2], [[34, 23]; 2]]);
    }
}
