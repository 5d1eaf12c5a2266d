//! Rectangles of vertices around the cells that an edit changes.

use mediant_grid::{Change, Grid, Placement, PlacementKind, Rectangle, Vertex, load};

/// The vertices from `first` to `last`, in rows and columns, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Zone {
    pub(super) first: Vertex,
    pub(super) last: Vertex,
}

impl Zone {
    /// The vertices around which a change alters the pattern of cells. Those of cells that are not neighbors
    /// have zones of their own.
    pub(super) fn of_change<P: Placement>(change: &Change) -> Vec<Self> {
        let map = Self::map::<P>(change.after());
        // The pattern of a center holds the next cells on all sides, that of a corner only those around it.
        let before = if P::KIND == PlacementKind::Center { 1 } else { 0 };
        let zone = |cells: Rectangle| {
            let first = Vertex::new(cells.x as i32, cells.y as i32);
            let last = Vertex::new(first.x + cells.width as i32, first.y + cells.height as i32);
            Self { first, last }.grown(before, 0).within(map)
        };
        changed(change).into_iter().map(zone).collect()
    }

    /// All vertices of a map.
    pub(super) fn map<P: Placement>(grid: &Grid) -> Self {
        let (width, height) = P::vertices(grid);
        Self { first: Vertex::default(), last: Vertex::new(width as i32 - 1, height as i32 - 1) }
    }

    /// With so many more rows and columns before its first one, and behind its last one.
    pub(super) const fn grown(self, before: i32, behind: i32) -> Self {
        let Self { first, last } = self;
        let first = Vertex::new(first.x - before, first.y - before);
        Self { first, last: Vertex::new(last.x + behind, last.y + behind) }
    }

    /// The part of it that lies in another one.
    pub(super) fn within(self, other: Self) -> Self {
        let Self { first, last } = self;
        let first = Vertex::new(first.x.max(other.first.x), first.y.max(other.first.y));
        Self { first, last: Vertex::new(last.x.min(other.last.x), last.y.min(other.last.y)) }
    }

    /// The smallest one that holds two vertices.
    pub(super) fn around(a: Vertex, b: Vertex) -> Self {
        let first = Vertex::new(a.x.min(b.x), a.y.min(b.y));
        Self { first, last: Vertex::new(a.x.max(b.x), a.y.max(b.y)) }
    }

    pub(super) fn holds(self, at: Vertex) -> bool {
        let Self { first, last } = self;
        (first.x..=last.x).contains(&at.x) && (first.y..=last.y).contains(&at.y)
    }

    /// The number of its vertices.
    pub(super) fn count(self) -> u64 {
        let side = |first: i32, last: i32| (i64::from(last) - i64::from(first) + 1).max(0) as u64;
        side(self.first.x, self.last.x) * side(self.first.y, self.last.y)
    }

    /// Its vertices, row by row.
    pub(super) fn vertices(self) -> impl Iterator<Item = Vertex> {
        let Self { first, last } = self;
        (first.y..=last.y).flat_map(move |y| (first.x..=last.x).map(move |x| Vertex::new(x, y)))
    }
}

/// Rectangles of the cells that a change alters, and of no others.
fn changed(change: &Change) -> Vec<Rectangle> {
    let mut all = Vec::new();
    // Runs that end in the last row go on where the same cells of the next row change.
    let (mut open, mut next): (Vec<Rectangle>, Vec<Rectangle>) = (Vec::new(), Vec::new());
    for &Rectangle { x, y, width, height } in change.cells() {
        for y in y..y + height {
            let word = |grid: &Grid| load(grid.rows().words(), grid.rows().index(x as i32, y as i32));
            // A rectangle of a change is no wider than a word.
            let mut left = (word(change.before()) ^ word(change.after())) & !0 >> (64 - width.clamp(1, 64));
            while left != 0 {
                let first = left.trailing_zeros();
                let run = Rectangle::new(x + first, y, (left >> first).trailing_ones(), 1);
                left &= left.wrapping_add(1 << first);
                let is_above = |above: &Rectangle| (above.x, above.width) == (run.x, run.width);
                next.push(match open.iter().position(is_above) {
                    Some(at) => {
                        let above = open.swap_remove(at);
                        Rectangle { height: above.height + 1, ..above }
                    }
                    None => run,
                });
            }
            all.append(&mut open);
            std::mem::swap(&mut open, &mut next);
        }
        all.append(&mut open);
    }
    all
}
