//! Visitors of the intervals of a visibility sweep: one finds targets, one all vertices and cells.

use crate::{BitRow, Vertex};

use super::{piece::Piece, place::Place, row_summary::RowSummary, targets::Targets};

/// A visitor of the intervals that a sweep follows.
pub(super) trait Visitor<'m> {
    /// The targets on one line; nothing where all vertices count.
    type Line: Copy;

    /// The targets on line `y`.
    fn line(&self, y: i32) -> Self::Line;

    /// The same of the line that is `lines` lines below.
    fn below(line: Self::Line, lines: i32) -> Self::Line;

    /// An interval whose cells beyond the line are all free, as are those before it.
    fn between_free_cells(&mut self, piece: Piece, down: i32, line: Self::Line);

    /// Any other interval.
    fn interval(&mut self, piece: Piece, down: i32, line: Self::Line);

    /// Intervals of this and further lines, on to the next band of rows; all cells on the way are free.
    fn band(&mut self, piece: Piece, down: i32, line: Self::Line);

    /// On the way to the next line the columns of cells from `first` to `end`, and those beside them, are
    /// looked at.
    #[inline]
    fn looks_at(&mut self, _line: i32, _first: i32, _end: i32) {}
}

/// Looks for targets.
pub(super) struct TargetsOf<'m, 'f, F> {
    pub(super) marks: Targets<'m>,
    pub(super) from: Place,
    pub(super) found: &'f mut F,
}

impl<'m, F: FnMut(Vertex)> Visitor<'m> for TargetsOf<'m, '_, F> {
    type Line = [BitRow<'m>; 2];

    fn line(&self, y: i32) -> Self::Line {
        [self.marks.same, self.marks.opposite].map(|marks| marks.row(y))
    }

    #[inline]
    fn below(line: Self::Line, lines: i32) -> Self::Line {
        line.map(|marks| marks.below(lines))
    }

    /// Only the ends of the interval can be corners of obstacles.
    #[inline]
    fn between_free_cells(&mut self, piece: Piece, down: i32, marks: Self::Line) {
        for edge in [piece.left, piece.right] {
            let x = edge.end.here.floor();
            if edge.end.here.is_vertex() && self.is_marked(x, down, marks) {
                (self.found)(Vertex::new(x, piece.line));
            }
        }
    }

    fn interval(&mut self, piece: Piece, down: i32, marks: Self::Line) {
        let ((x, after), line) = (self.from.columns(), piece.line);
        let (first, last) = piece.columns();
        let [left, right] = if down > 0 { [marks[1], marks[0]] } else { marks };
        if first < after {
            report(left, line, first, last.min(after - 1), self.found);
        }
        if x == after && first <= x && x <= last && self.is_marked(x, down, marks) {
            (self.found)(Vertex::new(x, line));
        }
        if last > x {
            report(right, line, first.max(x + 1), last, self.found);
        }
    }

    #[inline]
    fn band(&mut self, piece: Piece, down: i32, marks: Self::Line) {
        self.between_free_cells(piece, down, marks);
    }
}

impl<F> TargetsOf<'_, '_, F> {
    /// Whether the vertex in column x is a target, given the rows of targets of its line.
    #[inline]
    fn is_marked(&self, x: i32, down: i32, [same, opposite]: [BitRow<'_>; 2]) -> bool {
        match (Place::parts(x) - self.from.x) * down {
            0 => same.is_blocked(x) || opposite.is_blocked(x),
            1.. => same.is_blocked(x),
            _ => opposite.is_blocked(x),
        }
    }
}

/// Looks for all vertices, and for cells that are seen between them.
pub(super) struct RunsOf<'f, F, C> {
    pub(super) run: &'f mut F,
    pub(super) cells: &'f mut C,
    /// The interval that was told last, and whether it goes down (1) or up (−1).
    pub(super) interval: Option<(Piece, i32)>,
}

impl<F: FnMut(i32, i32, i32), C: FnMut(i32, i32, i32)> RunsOf<'_, F, C> {
    fn vertices(&mut self, piece: Piece) {
        let (first, last) = piece.columns();
        if first <= last {
            (self.run)(piece.line, first, last);
        }
    }

    /// The cells between an interval and the next line, of the columns from `start` to `end`, but for those
    /// that touch a vertex of the interval.
    #[inline]
    fn cells_beyond(&mut self, piece: Piece, down: i32, start: i32, end: i32) {
        let ([left, right], (first, last)) = ([piece.left, piece.right], piece.columns());
        let low = left.end.here.floor().min(left.after(1).end.here.floor()).max(start);
        let high = right.end.here.ceil().max(right.after(1).end.here.ceil()).min(end);
        let row = piece.line + (down - 1) / 2;
        if first > last {
            if low < high {
                (self.cells)(row, low, high);
            }
            return;
        }
        if low < first - 1 {
            (self.cells)(row, low, high.min(first - 1));
        }
        if last + 1 < high {
            (self.cells)(row, low.max(last + 1), high);
        }
    }
}

impl<F: FnMut(i32, i32, i32), C: FnMut(i32, i32, i32)> Visitor<'_> for RunsOf<'_, F, C> {
    type Line = ();

    fn line(&self, _: i32) {}

    fn below((): (), _: i32) {}

    #[inline]
    fn between_free_cells(&mut self, piece: Piece, down: i32, (): ()) {
        self.vertices(piece);
        self.interval = Some((piece, down));
    }

    #[inline]
    fn interval(&mut self, piece: Piece, down: i32, (): ()) {
        self.between_free_cells(piece, down, ());
    }

    fn band(&mut self, piece: Piece, down: i32, (): ()) {
        for lines in 0..RowSummary::LINES {
            let [left, right] = [piece.left, piece.right].map(|edge| edge.after(lines));
            let piece = Piece { line: piece.line + down * lines, left, right };
            self.vertices(piece);
            self.cells_beyond(piece, down, i32::MIN, i32::MAX);
        }
    }

    #[inline]
    fn looks_at(&mut self, _: i32, first: i32, end: i32) {
        if let Some((piece, down)) = self.interval {
            self.cells_beyond(piece, down, first, end);
        }
    }
}

/// Looks for the box around all that is looked at.
pub(super) struct BoundsOf {
    pub(super) low: Vertex,
    pub(super) high: Vertex,
}

impl BoundsOf {
    /// Takes in the vertices of a line from column `first` to `last`.
    pub(super) fn add(&mut self, line: i32, first: i32, last: i32) {
        let Self { low, high } = self;
        *low = Vertex::new(low.x.min(first), low.y.min(line));
        *high = Vertex::new(high.x.max(last), high.y.max(line));
    }
}

impl Visitor<'_> for BoundsOf {
    type Line = ();

    fn line(&self, _: i32) {}

    fn below((): (), _: i32) {}

    fn between_free_cells(&mut self, piece: Piece, _: i32, (): ()) {
        self.add(piece.line, piece.left.end.here.floor(), piece.right.end.here.ceil());
    }

    fn interval(&mut self, piece: Piece, down: i32, (): ()) {
        self.between_free_cells(piece, down, ());
    }

    fn band(&mut self, piece: Piece, down: i32, (): ()) {
        self.between_free_cells(piece, down, ());
    }

    fn looks_at(&mut self, line: i32, first: i32, end: i32) {
        self.add(line, first, end);
    }
}

/// Reports the targets of a row from column `first` to column `last`.
#[inline]
fn report(marks: BitRow<'_>, line: i32, first: i32, last: i32, found: &mut impl FnMut(Vertex)) {
    let mut from = first;
    while from <= last {
        let width = (last - from + 1).min(64);
        let mut bits = marks.word(from) & (!0 >> (64 - width));
        while bits != 0 {
            found(Vertex::new(from + bits.trailing_zeros() as i32, line));
            bits &= bits - 1;
        }
        from += 64;
    }
}
