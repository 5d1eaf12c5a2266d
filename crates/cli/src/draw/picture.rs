//! Maps and paths drawn with characters.
//!
//! A character is a block of 2 × 4 dots (Braille), over two square pixels of ground, the upper and the lower half. The ground
//! is drawn as colors, or as blocks where there is no color; paths are lines of dots, eight times as fine as characters.

use std::io::{self, Write};

use anstyle::{Reset, RgbColor};
use mediant_formats::MapFile;
use mediant_grid::{PlacementKind, Vertex};
use mediant_search::Query;

use crate::{
    draw::braille::{DOT_COLUMNS, DOT_ROWS, Glyph, Sheet, Stroke, steps},
    draw::theme::{INKS, Theme},
    map::Map,
    terminal::screen::Screen,
};

/// A pixel of ground: two by two dots.
#[derive(Clone, Copy)]
struct Ground {
    free: bool,
    color: RgbColor,
}

/// A map in the size of the screen, to be drawn on.
pub(crate) struct Canvas {
    placement: PlacementKind,
    dots_per_cell: f64,
    /// As wide as the sheet in characters and twice as high, row by row.
    ground: Vec<Ground>,
    sheet: Sheet,
}

/// Along each side of a pixel.
const PIXEL_DOTS: usize = DOT_COLUMNS;

impl Canvas {
    /// The rows that a picture may take.
    const MAX_ROWS: f64 = 48.0;

    /// The map, as large as fits on the screen but not larger than is good to look at.
    pub(crate) fn fit(map: &Map, placement: PlacementKind, screen: &Screen) -> Self {
        let (width, height) = (f64::from(map.grid.width()), f64::from(map.grid.height()));
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
        Self::new(map, placement, dots_per_cell)
    }

    fn new(map: &Map, placement: PlacementKind, dots_per_cell: f64) -> Self {
        let chars =
            |cells: u32, dots: usize| (f64::from(cells) * dots_per_cell / dots as f64).ceil() as usize;
        let (columns, rows) = (chars(map.grid.width(), DOT_COLUMNS), chars(map.grid.height(), DOT_ROWS));
        let pixel_in_cells = PIXEL_DOTS as f64 / dots_per_cell;
        let tiles = pixels(&map.file, columns, 2 * rows, pixel_in_cells);
        let ground = paint(&tiles, columns, pixel_in_cells, map.theme);
        Self { placement, dots_per_cell, ground, sheet: Sheet::new(columns, rows) }
    }

    /// Draws a line through the waypoints.
    pub(crate) fn path(&mut self, waypoints: &[Vertex], stroke: Stroke, ink: RgbColor) {
        let mut i = 0;
        for ends in waypoints.windows(2) {
            let (from, to) = (self.position(ends[0]), self.position(ends[1]));
            for (x, y) in steps(from, to) {
                if let Some((column, row)) = self.nearest_dot(x, y).filter(|_| stroke.inks(i)) {
                    self.sheet.dot(column, row, ink);
                }
                i += 1;
            }
        }
    }

    /// Marks both ends of a query.
    pub(crate) fn ends(&mut self, query: Query) {
        self.mark(query.start, START_MARK, INKS.start);
        self.mark(query.goal, GOAL_MARK, INKS.goal);
    }

    fn mark(&mut self, at: Vertex, mark: char, ink: RgbColor) {
        let (x, y) = self.position(at);
        if let Some((column, row)) = self.nearest_dot(x, y) {
            self.sheet.mark(column, row, mark, ink);
        }
    }

    /// Where a vertex is, in dots.
    fn position(&self, at: Vertex) -> (f64, f64) {
        let offset = if self.placement == PlacementKind::Center { 0.5 } else { 0.0 };
        let dots = |cells: i32| (f64::from(cells) + offset) * self.dots_per_cell;
        (dots(at.x), dots(at.y))
    }

    /// The dot at a place. Where the place is on the line between two dots, as all places along grid lines are, the one on
    /// free ground: a path along a wall is drawn beside it.
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

    /// Writes the picture, two columns from the left.
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

    /// A row of glyphs with the ground above and below the middle of each.
    fn row(&self, row: usize) -> impl Iterator<Item = (Glyph, Ground, Ground)> {
        let columns = self.sheet.columns();
        let pixels = |row: usize| self.ground[row * columns..][..columns].iter().copied();
        let glyphs = self.sheet.row(row).iter().copied();
        glyphs
            .zip(pixels(2 * row))
            .zip(pixels(2 * row + 1))
            .map(|((glyph, above), below)| (glyph, above, below))
    }

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

    /// Escape sequences only where a color changes.
    fn colored_row(&self, row: usize, screen: &Screen) -> String {
        let mut text = String::new();
        let mut current = (None, None);
        for (glyph, above, below) in self.row(row) {
            let (letter, ink, paper) = match glyph.letter() {
                // A character has one background: under a line it is that of the free half.
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

/// The tile of each pixel. A pixel that covers several cells is free when at least half of them are.
fn pixels(file: &MapFile, columns: usize, rows: usize, pixel_in_cells: f64) -> Vec<u8> {
    const OUTSIDE: u8 = b'@';
    let map: Vec<&[u8]> = file.rows().collect();
    let span = |i: usize, cells: usize| {
        let first = (i as f64 * pixel_in_cells) as usize;
        let last = ((i + 1) as f64 * pixel_in_cells).ceil() as usize;
        first.min(cells)..last.min(cells).max((first + 1).min(cells))
    };
    let mut result = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        for column in 0..columns {
            let lines = &map[span(row, map.len())];
            let cells = || lines.iter().flat_map(|line| &line[span(column, line.len())]).copied();
            let free = cells().filter(|&tile| MapFile::is_free_tile(tile)).count();
            let is_free = 2 * free >= cells().count();
            result.push(cells().find(|&tile| MapFile::is_free_tile(tile) == is_free).unwrap_or(OUTSIDE));
        }
    }
    result
}

/// Colors the pixels by how far they are from the border between free and blocked.
fn paint(tiles: &[u8], columns: usize, pixel_in_cells: f64, theme: Theme) -> Vec<Ground> {
    let depths = depths(tiles, columns);
    let ground = tiles.iter().zip(depths).map(|(&tile, thirds)| {
        let free = MapFile::is_free_tile(tile);
        // Pixels smaller than a cell count as parts of one.
        let depth = (f64::from(thirds) / 3.0 * pixel_in_cells.min(1.0)).ceil() as u32;
        Ground { free, color: theme.color(tile, free, depth) }
    });
    ground.collect()
}

/// How far each pixel is from the nearest one of the other kind, in thirds of a pixel: the chamfer distance (3 for a step along an axis, 4 for a diagonal one), in one pass
/// down and one up.
fn depths(tiles: &[u8], columns: usize) -> Vec<u32> {
    const FAR: u32 = 1 << 20;
    let rows = tiles.len() / columns.max(1);
    let mut depths = vec![FAR; tiles.len()];
    let mut relax = |i: usize, around: [(isize, isize); 4]| {
        let (x, y) = (i % columns, i / columns);
        for (dx, dy) in around {
            let (Some(x), Some(y)) = (x.checked_add_signed(dx), y.checked_add_signed(dy)) else { continue };
            if x >= columns || y >= rows {
                continue;
            }
            let other = y * columns + x;
            let weight = if dx != 0 && dy != 0 { 4 } else { 3 };
            let alike = MapFile::is_free_tile(tiles[i]) == MapFile::is_free_tile(tiles[other]);
            depths[i] = depths[i].min(weight + if alike { depths[other] } else { 0 });
        }
    };
    for i in 0..tiles.len() {
        relax(i, [(-1, -1), (0, -1), (1, -1), (-1, 0)]);
    }
    for i in (0..tiles.len()).rev() {
        relax(i, [(1, 1), (0, 1), (-1, 1), (1, 0)]);
    }
    depths
}
