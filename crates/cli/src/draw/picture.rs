//! Maps and paths drawn with characters.
//!
//! A character shows 2 × 4 dots (Braille) over two square pixels of ground, its upper and its lower half. The
//! ground is drawn in colors, or without color as blocks. Paths are lines of dots.

use std::io::{self, Write};

use anstyle::{Reset, RgbColor};
use mediant::{PlacementKind, Point};
use mediant_formats::MapFile;

use super::{
    braille::{DOT_COLUMNS, DOT_ROWS, Glyph, Sheet, Stroke, steps},
    ground::{Ground, paint, pixels, shade},
    theme::{INKS, Theme},
};
use crate::terminal::screen::Screen;

/// A picture of a map that fits on the screen, to draw paths on.
pub(crate) struct Canvas {
    placement: PlacementKind,
    dots_per_cell: f64,
    /// As wide as the sheet in characters and twice as high, row by row.
    ground: Vec<Ground>,
    sheet: Sheet,
}

/// The dots along each side of a pixel.
const PIXEL_DOTS: usize = DOT_COLUMNS;

impl Canvas {
    /// The most rows of a picture; half as many if a cell is larger than a pixel.
    const MAX_ROWS: f64 = 48.0;

    /// The map, as large as fits on the screen, but a small map not larger than is good to look at.
    pub(crate) fn fit(map: &MapFile, theme: Theme, placement: PlacementKind, screen: &Screen) -> Self {
        let (width, height) = (f64::from(map.width()), f64::from(map.height()));
        // Margins, and the frame where there is no color.
        let columns = screen.columns().max(24) as f64 - 6.0;
        let fits = |dots: f64| {
            let rows = height * dots / DOT_ROWS as f64;
            let limit = if dots > 2.0 { Self::MAX_ROWS / 2.0 } else { Self::MAX_ROWS };
            width * dots / DOT_COLUMNS as f64 <= columns && rows <= limit
        };
        let shrunk = (2..).map(|cells| 1.0 / f64::from(cells));
        let dots_per_cell =
            [8.0, 4.0, 2.0, 1.0].into_iter().chain(shrunk).find(|&dots| fits(dots)).unwrap_or(1.0);
        Self::new(map, theme, placement, dots_per_cell)
    }

    /// The map, with so many dots along the side of a cell.
    fn new(map: &MapFile, theme: Theme, placement: PlacementKind, dots_per_cell: f64) -> Self {
        let chars =
            |cells: u32, dots: usize| (f64::from(cells) * dots_per_cell / dots as f64).ceil() as usize;
        let (columns, rows) = (chars(map.width(), DOT_COLUMNS), chars(map.height(), DOT_ROWS));
        let pixel_in_cells = PIXEL_DOTS as f64 / dots_per_cell;
        let tiles = pixels(map, columns, 2 * rows, pixel_in_cells);
        let ground = paint(map, &tiles, columns, pixel_in_cells, theme);
        Self { placement, dots_per_cell, ground, sheet: Sheet::new(columns, rows) }
    }

    /// Colors free ground by a share of each free cell, from 0 to 1.
    pub(crate) fn shade(&mut self, share: impl Fn(i32, i32) -> Option<f64>) {
        let pixel_in_cells = PIXEL_DOTS as f64 / self.dots_per_cell;
        shade(&mut self.ground, self.sheet.columns(), pixel_in_cells, share);
    }

    /// Draws a line through the waypoints.
    pub(crate) fn path(&mut self, waypoints: &[impl Into<Point> + Copy], stroke: Stroke, ink: RgbColor) {
        let mut i = 0;
        for ends in waypoints.windows(2) {
            let (from, to) = (self.position(ends[0].into()), self.position(ends[1].into()));
            for (x, y) in steps(from, to) {
                if let Some((column, row)) = self.nearest_dot(x, y).filter(|_| stroke.inks(i)) {
                    self.sheet.dot(column, row, ink);
                }
                i += 1;
            }
        }
    }

    /// Marks the starts and the goals of a query.
    pub(crate) fn ends(&mut self, starts: &[Point], goals: &[Point]) {
        starts.iter().for_each(|&at| self.mark(at, START_MARK, INKS.start));
        goals.iter().for_each(|&at| self.mark(at, GOAL_MARK, INKS.goal));
    }

    /// Puts a character at a vertex.
    fn mark(&mut self, at: Point, mark: char, ink: RgbColor) {
        let (x, y) = self.position(at);
        if let Some((column, row)) = self.nearest_dot(x, y) {
            self.sheet.mark(column, row, mark, ink);
        }
    }

    /// The position of a point, in dots.
    fn position(&self, at: Point) -> (f64, f64) {
        let offset = if self.placement == PlacementKind::Center { 0.5 } else { 0.0 };
        let dots = |cells: f64| (cells + offset) * self.dots_per_cell;
        (dots(at.x()), dots(at.y()))
    }

    /// The dot at a position. A position on a grid line is between two dots: there it is the one on free
    /// ground, so that a path along a wall is drawn beside the wall.
    fn nearest_dot(&self, x: f64, y: f64) -> Option<(usize, usize)> {
        const NEAR: f64 = 1e-6;
        let (columns, rows) = (self.sheet.columns() * DOT_COLUMNS, self.sheet.rows() * DOT_ROWS);
        let choices = [(NEAR, NEAR), (-NEAR, NEAR), (NEAR, -NEAR), (-NEAR, -NEAR)];
        let dots = choices.map(|(dx, dy)| ((x + dx).floor(), (y + dy).floor()));
        let inside = |&(x, y): &(f64, f64)| x >= 0.0 && y >= 0.0 && x < columns as f64 && y < rows as f64;
        let mut dots = dots.into_iter().filter(inside).map(|(x, y)| (x as usize, y as usize));
        let is_free = |&(column, row): &(usize, usize)| {
            self.ground[row / PIXEL_DOTS * self.sheet.columns() + column / PIXEL_DOTS].free
        };
        dots.clone().find(is_free).or_else(|| dots.next())
    }

    /// Writes the picture, indented by two columns.
    pub(crate) fn write(&self, screen: &mut Screen) -> io::Result<()> {
        if screen.has_color() {
            for row in 0..self.sheet.rows() {
                let row = self.colored_row(row, screen);
                writeln!(screen, "  {row}")?;
            }
            return Ok(());
        }
        let edge = "─".repeat(self.sheet.columns());
        writeln!(screen, "  ┌{edge}┐")?;
        for row in 0..self.sheet.rows() {
            writeln!(screen, "  │{}│", self.plain_row(row))?;
        }
        writeln!(screen, "  └{edge}┘")
    }

    /// A row of glyphs, each with the ground of its upper and its lower half.
    fn row(&self, row: usize) -> impl Iterator<Item = (Glyph, Ground, Ground)> {
        let columns = self.sheet.columns();
        let pixels = |row: usize| self.ground[row * columns..][..columns].iter().copied();
        let glyphs = self.sheet.row(row).iter().copied();
        glyphs
            .zip(pixels(2 * row))
            .zip(pixels(2 * row + 1))
            .map(|((glyph, above), below)| (glyph, above, below))
    }

    /// A row without color: glyphs, and blocks for blocked ground.
    fn plain_row(&self, row: usize) -> String {
        let blocks = |(glyph, above, below): (Glyph, Ground, Ground)| {
            glyph.letter().unwrap_or(match (above.free, below.free) {
                (false, false) => '█',
                (false, true) => '▀',
                (true, false) => '▄',
                (true, true) => ' ',
            })
        };
        self.row(row).map(blocks).collect()
    }

    /// A row with escape sequences wherever a color changes.
    fn colored_row(&self, row: usize, screen: &Screen) -> String {
        let mut text = String::new();
        let mut current = (None, None);
        for (glyph, above, below) in self.row(row) {
            let (letter, ink, paper) = match glyph.letter() {
                // A character has one background. Under a line it is the free half's.
                Some(letter) => (letter, Some(glyph.ink), if above.free { above.color } else { below.color }),
                None if above.color == below.color => (' ', None, below.color),
                None => ('▀', Some(above.color), below.color),
            };
            if let Some(ink) = ink.filter(|_| ink != current.0) {
                text += &screen.color(ink).render_fg().to_string();
                current.0 = Some(ink);
            }
            if Some(paper) != current.1 {
                text += &screen.color(paper).render_bg().to_string();
                current.1 = Some(paper);
            }
            text.push(letter);
        }
        text + &Reset.render().to_string()
    }
}

/// The sign of a query's start.
pub(crate) const START_MARK: char = '●';
/// The sign of a query's goal.
pub(crate) const GOAL_MARK: char = '◆';
