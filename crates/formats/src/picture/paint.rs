//! Pictures in pixels.

use mediant_grid::{Grid, PlacementKind};

use super::{
    Picture, badge,
    color::{self, Rgb},
    contour,
    layout::{Layout, MARGIN},
    raster::{Image, Mask},
    vertex_colors::VertexColors,
};

impl Picture<'_> {
    /// The whole picture.
    pub(super) fn pixels(&self) -> Image {
        let layout = self.layout();
        let painted = VertexColors::of(self);
        let mut image = self.base(painted.as_ref(), layout, MARGIN);
        self.grid_lines(&mut image, layout);
        let contours = contour::lines(self);
        if !(contours.is_empty() && self.paths.is_empty() && self.ends().next().is_none()) {
            let mut mask = Mask::of(&image);
            for [a, b] in contours {
                mask.line(layout.pixel(a), layout.pixel(b), 0.5);
            }
            mask.ink(&mut image, color::INK, color::CONTOUR);
            self.draw_paths(&mut image, &mut mask, layout);
            self.draw_ends(&mut image, &mut mask, layout);
        }
        image
    }

    /// Walls, free cells and the colors of vertices, inside a margin.
    pub(super) fn base(&self, painted: Option<&VertexColors>, layout: Layout, margin: u32) -> Image {
        let Layout { width, height, cell, .. } = layout;
        let mut image = Image::new(width + 2 * margin, height + 2 * margin, color::PAGE);
        let wall = self.wall();
        let mut last = None;
        let mut line = vec![color::FREE; width as usize];
        for y in 0..height {
            // Rows of pixels are alike that show the same cells and vertices.
            let row = (y / cell, self.vertex_at(y, cell));
            if last.replace(row) != Some(row) || layout.cells > 1 {
                if layout.cells > 1 {
                    self.mean_row(painted, layout, y, &mut line);
                } else {
                    self.row(painted, cell, row, wall, &mut line);
                }
            }
            for (pixel, &color) in image.row_mut(margin + y, margin, width).iter_mut().zip(&line) {
                *pixel = color;
            }
        }
        image
    }

    /// Walls are darker beside colors.
    pub(super) fn wall(&self) -> Rgb {
        if self.field.is_empty() { color::WALL } else { color::WALL_IN_FIELD }
    }

    /// The column or row of the vertex nearest to a pixel.
    fn vertex_at(&self, pixel: u32, cell: u32) -> u32 {
        match self.placement {
            PlacementKind::Center => pixel / cell,
            PlacementKind::Corner => (2 * pixel + cell) / (2 * cell),
        }
    }

    fn row(
        &self,
        painted: Option<&VertexColors>,
        cell: u32,
        (y, vertex_y): (u32, u32),
        wall: Rgb,
        line: &mut [Rgb],
    ) {
        for (cells, x) in line.chunks_mut(cell as usize).zip(0..) {
            if self.grid.is_blocked(x, y as i32) {
                cells.fill(wall);
            } else if let Some(painted) = painted {
                let left = x as u32 * cell;
                for (pixel, column) in cells.iter_mut().zip(left..) {
                    *pixel = painted.get(self.vertex_at(column, cell), vertex_y).unwrap_or(color::FREE);
                }
            } else {
                cells.fill(color::FREE);
            }
        }
    }

    /// A row of pixels that each show the mean of several cells.
    fn mean_row(&self, painted: Option<&VertexColors>, layout: Layout, y: u32, line: &mut [Rgb]) {
        let (n, wall) = (layout.cells, self.wall());
        let end = |first: u32, side: u32| first.saturating_add(n).min(side);
        let rows = y * n..end(y * n, self.grid.height());
        for (pixel, left) in line.iter_mut().zip((0..).step_by(n as usize)) {
            let (mut sum, mut count) = ([0_u32; 3], 0);
            for y in rows.clone() {
                for x in left..end(left, self.grid.width()) {
                    let color = if self.grid.is_blocked(x as i32, y as i32) {
                        wall
                    } else {
                        painted.and_then(|painted| painted.get(x, y)).unwrap_or(color::FREE)
                    };
                    sum = [0, 1, 2].map(|i| sum[i] + u32::from(color[i]));
                    count += 1;
                }
            }
            let count = count.max(1);
            *pixel = sum.map(|sum| ((sum + count / 2) / count) as u8);
        }
    }

    /// Lines between free cells, and the frame of the map.
    fn grid_lines(&self, image: &mut Image, layout: Layout) {
        let cell = layout.cell;
        if layout.is_outlined() {
            let is_free = |x: u32, y: u32| is_free(self.grid, x, y);
            for y in 0..self.grid.height() {
                for x in 0..self.grid.width() {
                    let (left, top) = (MARGIN + x * cell, MARGIN + y * cell);
                    if x > 0 && is_free(x, y) && is_free(x - 1, y) {
                        image.fill((left, top), (1, cell), color::INK, color::GRID_LINE);
                    }
                    if y > 0 && is_free(x, y) && is_free(x, y - 1) {
                        image.fill((left, top), (cell, 1), color::INK, color::GRID_LINE);
                    }
                }
            }
        }
        let (near, width, height) = (MARGIN - 1, layout.width, layout.height);
        for (at, size) in [
            ((near, near), (width + 2, 1)),
            ((near, MARGIN + height), (width + 2, 1)),
            ((near, MARGIN), (1, height)),
            ((MARGIN + width, MARGIN), (1, height)),
        ] {
            image.fill(at, size, color::FRAME, 255);
        }
    }

    /// The color of the path with this number.
    pub(super) fn path_color(&self, index: usize) -> Rgb {
        let is_plain = self.field.is_empty() && self.expanded.is_empty();
        let colors = if is_plain { color::PATHS } else { color::PATHS_IN_FIELD };
        colors[index % colors.len()]
    }

    fn draw_paths(&self, image: &mut Image, mask: &mut Mask, layout: Layout) {
        let paths: Vec<Vec<(f64, f64)>> =
            self.paths.iter().map(|path| path.points.iter().map(|&at| layout.pixel(at)).collect()).collect();
        if self.radius > 0.0 {
            for (points, index) in paths.iter().zip(0..) {
                mask.polyline(points, self.radius * layout.scale());
                mask.clear_border(MARGIN);
                mask.ink(image, self.path_color(index), color::WAY);
            }
        }
        let half = |index| layout.line_width(index, paths.len()) / 2.0;
        // Below all paths: a rim must not hide a path that shares the segment.
        for (points, index) in paths.iter().zip(0..) {
            mask.polyline(points, half(index) + 1.0);
        }
        mask.ink(image, color::PAGE, color::RIM);
        for (points, index) in paths.iter().zip(0..) {
            let (half, ink) = (half(index), self.path_color(index));
            mask.polyline(points, half);
            if layout.is_outlined() {
                points.iter().for_each(|&at| mask.disc(at, 1.6 * half + 0.75));
            }
            mask.ink(image, ink, 255);
        }
    }

    fn draw_ends(&self, image: &mut Image, mask: &mut Mask, layout: Layout) {
        let radius = layout.badge();
        for (letter, at) in self.ends() {
            let at = layout.pixel(at);
            mask.disc(at, radius + 1.25);
            mask.ink(image, color::PAGE, 255);
            mask.disc(at, radius);
            mask.ink(image, color::INK, 255);
            mask.polyline(&letter.on(at, radius), badge::stroke(radius));
            mask.ink(image, color::PAGE, 255);
        }
    }
}

fn is_free(grid: &Grid, x: u32, y: u32) -> bool {
    grid.is_free(x as i32, y as i32)
}
