//! Where a straight segment meets what blocks it.

use std::fmt;

use crate::{FreeSpace, Placement, Point, SweptCells, Vertex, frame::Frame};

/// The first thing on a segment that the rules of motion do not allow: see [`FreeSpace::obstruction`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Obstruction {
    /// An end of the segment is not free, or outside the map.
    End {
        /// The end.
        at: Point,
    },
    /// A blocked cell. At centers the segment touches it, at corners it meets its open interior.
    Cell {
        /// Its column.
        x: i32,
        /// Its row.
        y: i32,
    },
    /// Two blocked cells. Where they share an edge, the segment runs along it (at corners); one of the cells
    /// may lie outside the map. Where they share a corner, the segment passes through it: at centers under
    /// [`CornerRule::One`](crate::CornerRule::One), at corners it is a gap under
    /// [`DiagonalGap::Closed`](crate::DiagonalGap::Closed).
    Between {
        /// Both cells (x, y).
        cells: [(i32, i32); 2],
    },
}

impl Obstruction {
    /// The blocked cell (x, y), or the first one of two; `None` for an end of the segment.
    #[must_use]
    pub const fn cell(self) -> Option<(i32, i32)> {
        match self {
            Self::End { .. } => None,
            Self::Cell { x, y } => Some((x, y)),
            Self::Between { cells: [cell, _] } => Some(cell),
        }
    }

    /// The same on a segment between corners in the coordinates of centers:
    /// [`Point::at_centers`](crate::Point::at_centers). Cells are cells in both.
    #[must_use]
    pub const fn at_centers(self) -> Self {
        match self {
            Self::End { at } => Self::End { at: at.at_centers() },
            other => other,
        }
    }
}

impl fmt::Display for Obstruction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::End { at } => {
                let word = if at.vertex().is_some() { "vertex" } else { "point" };
                write!(f, "{word} {at} is blocked or outside the map")
            }
            Self::Cell { x, y } => write!(f, "cell ({x}, {y}) is blocked"),
            Self::Between { cells: [(ax, ay), (bx, by)] } => {
                write!(f, "it may not pass between the blocked cells ({ax}, {ay}) and ({bx}, {by})")
            }
        }
    }
}

impl<P: Placement> FreeSpace<P> {
    /// The first thing on the straight segment between two vertices, seen from `from`, that the rules of
    /// motion do not allow; `None` if [`sees`](Self::sees) is true.
    ///
    /// The start is looked at first, then whether the end is on the map, then the cells on the way. Of two
    /// blocked cells that the segment touches at one point, the first is the one in the row or column, along
    /// the segment's longer axis, from which it comes. In sight, this takes the time of
    /// [`sees`](Self::sees); else a test for each cell up to the first blocked one is added.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use mediant_grid::{AsciiMap, Centers, CornerRule, FreeSpace, Obstruction};
    /// let map = AsciiMap::parse("
    ///     ...#.
    ///     .....
    /// ")?;
    /// let space = FreeSpace::<Centers>::new(Arc::new(map.grid), CornerRule::Never);
    /// let found = space.obstruction((0, 0).into(), (4, 0).into());
    /// assert_eq!(found, Some(Obstruction::Cell { x: 3, y: 0 }));
    /// assert_eq!(space.obstruction((0, 1).into(), (4, 1).into()), None);
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    #[must_use]
    pub fn obstruction(&self, from: Vertex, to: Vertex) -> Option<Obstruction> {
        if !self.is_free(from) {
            return Some(Obstruction::End { at: from.into() });
        }
        if self.id(to).is_none() {
            return Some(Obstruction::End { at: to.into() });
        }
        if self.sees(from, to) {
            return None;
        }
        // A blocked end has a blocked cell before it.
        Some(self.first_blocked(from, to).unwrap_or(Obstruction::End { at: to.into() }))
    }

    /// The first blocked cells between two different vertices of the map.
    fn first_blocked(&self, from: Vertex, to: Vertex) -> Option<Obstruction> {
        let (frame, d) = Frame::of(from.to(to));
        let place = |cell| {
            let (x, y) = frame.offset::<P>(cell);
            (from.x + x, from.y + y)
        };
        let blocked = |&(x, y): &(i32, i32)| self.grid().is_blocked(x, y);
        let mut found = None;
        P::sweep(self.rule(), d, |cells| {
            found = match cells {
                SweptCells::AllFree { row, first, last } => {
                    let cell = (first..=last).map(|column| place((column, row))).find(blocked);
                    cell.map(|(x, y)| Obstruction::Cell { x, y })
                }
                SweptCells::EitherFree(cells) => {
                    // Along a grid line the sweep names the edges, and not the gaps between them.
                    let gap = if d.y == 0 { self.gap_on_line(from, frame, cells[0].0) } else { None };
                    let cells = cells.map(place);
                    gap.or_else(|| cells.iter().all(blocked).then_some(Obstruction::Between { cells }))
                }
            };
            found.is_none()
        });
        found
    }

    /// The closed gap that is `along` > 0 cells from here along a grid line, if there is one.
    fn gap_on_line(&self, from: Vertex, frame: Frame, along: i32) -> Option<Obstruction> {
        let step = along * frame.long;
        let at = if frame.transposed {
            Vertex::new(from.x, from.y + step)
        } else {
            Vertex::new(from.x + step, from.y)
        };
        if along == 0 || !self.is_closed_gap(at) {
            return None;
        }
        let falling = [(at.x - 1, at.y - 1), (at.x, at.y)];
        let rising = [(at.x, at.y - 1), (at.x - 1, at.y)];
        let cells = if self.grid().is_blocked(at.x, at.y) { falling } else { rising };
        Some(Obstruction::Between { cells })
    }
}
