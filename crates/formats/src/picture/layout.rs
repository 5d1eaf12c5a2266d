//! How large a picture is, and where its parts are.

use mediant_grid::Grid;

/// The empty border around the map, in pixels.
pub(super) const MARGIN: u32 = 16;
/// The longer side of a map that has room for it, in pixels.
const COMFORTABLE: u32 = 1200;
/// The largest side of a cell, in pixels.
const LARGEST_CELL: u32 = 40;
/// From this side on, cells are outlined and the points of paths marked.
const OUTLINED: f64 = 8.0;

/// The scale of a picture. A cell is a whole number of pixels wide, or a pixel a whole number of cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Layout {
    /// Pixels along a cell's side; 1 where a pixel covers several cells.
    pub(super) cell: u32,
    /// Cells along a pixel's side.
    pub(super) cells: u32,
    /// The map in pixels.
    pub(super) width: u32,
    pub(super) height: u32,
}

impl Layout {
    pub(super) fn new(grid: &Grid, largest_side: u32) -> Self {
        let side = grid.width().max(grid.height()).max(1);
        let cell = (COMFORTABLE.min(largest_side) / side).clamp(1, LARGEST_CELL);
        let cells = side.div_ceil(largest_side).max(1);
        let pixels = |cells_on_side: u32| cells_on_side.div_ceil(cells) * cell;
        Self { cell, cells, width: pixels(grid.width()), height: pixels(grid.height()) }
    }

    /// Pixels a cell.
    pub(super) fn scale(&self) -> f64 {
        f64::from(self.cell) / f64::from(self.cells)
    }

    /// From cells of the map to pixels of the picture.
    pub(super) fn pixel(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let margin = f64::from(MARGIN);
        (margin + x * self.scale(), margin + y * self.scale())
    }

    pub(super) fn is_outlined(&self) -> bool {
        self.scale() >= OUTLINED
    }

    /// The width of the path with this number, of so many, in pixels.
    pub(super) fn line_width(&self, index: usize, count: usize) -> f64 {
        let above = count.saturating_sub(index + 1).min(9) as f64;
        (self.thinnest() + 1.75 * above).min(9.0)
    }

    /// Thicker where cells are large, and where the picture is.
    fn thinnest(&self) -> f64 {
        (self.scale() / 11.0).clamp(2.25, 3.5).max((self.longer_side() / 450.0).min(5.0))
    }

    fn longer_side(&self) -> f64 {
        f64::from(self.width.max(self.height))
    }

    /// The radius of the badges of start and goal.
    pub(super) fn badge(&self) -> f64 {
        (self.scale() * 0.36).clamp(8.0, 12.0).max((self.longer_side() / 130.0).min(20.0))
    }
}
