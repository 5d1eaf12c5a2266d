//! Maps drawn in text: for tests, examples and error reports.

use crate::{Grid, GridError, PlacementKind, Vertex};

/// A grid with the letters and digits that were drawn on it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AsciiMap {
    /// The map.
    pub grid: Grid,
    /// The letters and digits with their cells, row by row.
    pub marks: Vec<(char, Vertex)>,
}

impl AsciiMap {
    /// Reads a drawing with one line a row. `.`, letters and digits are free cells, all other characters are
    /// blocked ones, usually `#` or `@`. [`mark`](Self::mark) finds letters and digits. White space around
    /// the lines and empty lines are ignored.
    ///
    /// ```
    /// use mediant_grid::{AsciiMap, Vertex};
    /// let map = AsciiMap::parse("
    ///     s.#
    ///     .#g
    /// ")?;
    /// assert_eq!(map.mark('g'), Some(Vertex::new(2, 1)));
    /// assert!(map.grid.is_blocked(2, 0));
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    ///
    /// # Errors
    /// [`GridError`] for rows of different lengths or an empty drawing.
    pub fn parse(drawing: &str) -> Result<Self, GridError> {
        let rows: Vec<Vec<char>> = drawing
            .lines()
            .map(str::trim)
            .filter(|row| !row.is_empty())
            .map(|row| row.chars().collect())
            .collect();
        let expected = rows.first().map_or(0, Vec::len);
        if let Some((row, cells)) = rows.iter().enumerate().find(|(_, cells)| cells.len() != expected) {
            return Err(GridError::Ragged { row, found: cells.len(), expected });
        }
        Grid::check_size(expected as u64, rows.len() as u64)?;
        let grid = Grid::from_fn(expected as u32, rows.len() as u32, |x, y| {
            let cell = rows[y as usize][x as usize];
            cell != '.' && !cell.is_alphanumeric()
        })?;
        let cells =
            rows.iter().zip(0..).flat_map(|(row, y)| row.iter().zip(0..).map(move |(&c, x)| (c, x, y)));
        let marks =
            cells.filter(|(c, ..)| c.is_alphanumeric()).map(|(c, x, y)| (c, Vertex::new(x, y))).collect();
        Ok(Self { grid, marks })
    }

    /// The first cell marked with this letter or digit.
    #[must_use]
    pub fn mark(&self, letter: char) -> Option<Vertex> {
        self.marks.iter().find(|(c, _)| *c == letter).map(|&(_, at)| at)
    }
}

/// Draws a grid with the waypoints of a path as 0, 1, … 9, a, b, … z (then `+`), one line a row.
///
/// Under center placement a cell is one character. Under corner placement the drawing is twice as large:
/// vertices stand in the even lines and columns, cells in the odd ones. Waypoints outside the map are left
/// out.
///
/// ```
/// use mediant_grid::{AsciiMap, PlacementKind, draw};
/// let map = AsciiMap::parse("
///     s..
///     .#.
///     ..g
/// ")?;
/// let path = [(0, 0), (2, 0), (2, 2)].map(Into::into);
/// assert_eq!(draw(&map.grid, PlacementKind::Center, &path), "0.1\n.#.\n..2\n");
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[must_use]
pub fn draw(grid: &Grid, placement: PlacementKind, waypoints: &[Vertex]) -> String {
    let (width, height) = (grid.width() as usize, grid.height() as usize);
    let (scale, origin, free) = match placement {
        PlacementKind::Center => (1, 0, '.'),
        PlacementKind::Corner => (2, 1, ' '),
    };
    let mut canvas =
        vec![vec![if scale == 1 { ' ' } else { '·' }; scale * width + origin]; scale * height + origin];
    for (row, line) in canvas.iter_mut().enumerate() {
        for (column, c) in line.iter_mut().enumerate() {
            let at_vertex = scale == 2 && row % 2 == 0 && column % 2 == 0;
            let (x, y) = ((column / scale) as i32, (row / scale) as i32);
            let cells = [(0, 0), (-1, 0), (0, -1), (-1, -1)];
            let touches = |&(dx, dy): &(i32, i32)| (dx == 0 || column % 2 == 0) && (dy == 0 || row % 2 == 0);
            *c = if at_vertex {
                '·'
            } else if cells
                .iter()
                .filter(|d| scale == 2 && touches(d) || **d == (0, 0))
                .all(|d| grid.is_blocked(x + d.0, y + d.1))
            {
                '#'
            } else {
                free
            };
        }
    }
    for (i, at) in waypoints.iter().enumerate() {
        let label = u32::try_from(i).ok().and_then(|i| char::from_digit(i, 36)).unwrap_or('+');
        // A waypoint outside the map is left out.
        let scaled = |n: i32| usize::try_from(n).ok()?.checked_mul(scale);
        let cell = scaled(at.y).zip(scaled(at.x));
        let cell = cell.and_then(|(y, x)| canvas.get_mut(y)?.get_mut(x));
        if let Some(cell) = cell {
            *cell = label;
        }
    }
    canvas.into_iter().map(|line| line.into_iter().collect::<String>().trim_end().to_owned() + "\n").collect()
}
