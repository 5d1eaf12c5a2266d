//! Pixels, and lines and discs on them with smooth rims.

use super::color::{Rgb, mixed};

/// Coverage has this many steps, so that pictures have few colors and their files are small.
const STEPS: f64 = 15.0;

/// A picture in pixels, row by row.
#[derive(Clone, Debug)]
pub(super) struct Image {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) pixels: Vec<Rgb>,
}

impl Image {
    pub(super) fn new(width: u32, height: u32, color: Rgb) -> Self {
        Self { width, height, pixels: vec![color; width as usize * height as usize] }
    }

    /// The pixels of a row from column `first` on, at most `count`; none outside.
    pub(super) fn row_mut(&mut self, y: u32, first: u32, count: u32) -> &mut [Rgb] {
        let (first, last) = (first.min(self.width), first.saturating_add(count).min(self.width));
        let row = y as usize * self.width as usize;
        self.pixels.get_mut(row + first as usize..row + last as usize).unwrap_or_default()
    }

    /// Puts some ink, of 255, on a rectangle.
    pub(super) fn fill(&mut self, (x, y): (u32, u32), (width, height): (u32, u32), ink: Rgb, part: u8) {
        for row in y..y.saturating_add(height).min(self.height) {
            for pixel in self.row_mut(row, x, width) {
                *pixel = mixed(*pixel, ink, part);
            }
        }
    }
}

/// How much of each pixel a figure covers. Lines and discs of one figure do not add up where they overlap.
pub(super) struct Mask {
    width: u32,
    height: u32,
    cover: Vec<u8>,
    /// The rows that may be covered: first and after the last.
    rows: (u32, u32),
}

impl Mask {
    pub(super) fn of(image: &Image) -> Self {
        let (width, height) = (image.width, image.height);
        Self { width, height, cover: vec![0; width as usize * height as usize], rows: (height, 0) }
    }

    /// A line with round ends: all within `radius` of the segment.
    pub(super) fn line(&mut self, from: (f64, f64), to: (f64, f64), radius: f64) {
        let reach = radius + 1.0;
        let ((ax, ay), (dx, dy)) = (from, (to.0 - from.0, to.1 - from.1));
        let squared = dx * dx + dy * dy;
        let clip = |value: f64, side: u32| value.clamp(0.0, f64::from(side)) as u32;
        let first = clip((ay.min(to.1) - reach).floor(), self.height);
        let last = clip((ay.max(to.1) + reach).ceil(), self.height);
        self.rows = (self.rows.0.min(first), self.rows.1.max(last));
        for row in first..last {
            let y = f64::from(row) + 0.5;
            let (mut low, mut high) = (ax.min(to.0) - reach, ax.max(to.0) + reach);
            if dy != 0.0 {
                let (middle, half) = (ax + (y - ay) * dx / dy, reach * squared.sqrt() / dy.abs());
                (low, high) = (low.max(middle - half), high.min(middle + half));
            }
            let (low, high) = (clip(low.floor(), self.width), clip(high.ceil(), self.width));
            let start = row as usize * self.width as usize;
            let pixels = self.cover.get_mut(start + low as usize..start + high.max(low) as usize);
            for (cover, column) in pixels.unwrap_or_default().iter_mut().zip(low..) {
                let (px, py) = (f64::from(column) + 0.5 - ax, y - ay);
                let along = if squared > 0.0 { (px * dx + py * dy) / squared } else { 0.0 };
                let along = along.clamp(0.0, 1.0);
                let (x, y) = (px - along * dx, py - along * dy);
                let part = (radius + 0.5 - (x * x + y * y).sqrt()).clamp(0.0, 1.0);
                *cover = (*cover).max(((part * STEPS + 0.5).floor() * (255.0 / STEPS)) as u8);
            }
        }
    }

    /// Lines from point to point; a disc for a single point.
    pub(super) fn polyline(&mut self, points: &[(f64, f64)], radius: f64) {
        if let [at] = points {
            self.disc(*at, radius);
        }
        for ends in points.windows(2) {
            self.line(ends[0], ends[1], radius);
        }
    }

    pub(super) fn disc(&mut self, center: (f64, f64), radius: f64) {
        self.line(center, center, radius);
    }

    /// Takes away what of the figure is less than this far from the image's border, in pixels.
    pub(super) fn clear_border(&mut self, wide: u32) {
        let (wide, width, height) = (wide as usize, self.width as usize, self.height as usize);
        for (row, y) in self.cover.chunks_mut(width.max(1)).zip(0..) {
            if y < wide || y + wide >= height {
                row.fill(0);
            } else {
                row.iter_mut().take(wide).for_each(|cover| *cover = 0);
                row.iter_mut().rev().take(wide).for_each(|cover| *cover = 0);
            }
        }
    }

    /// Puts `part` / 255 of ink where the figure is, and clears the mask.
    pub(super) fn ink(&mut self, image: &mut Image, ink: Rgb, part: u8) {
        let range = self.rows.0 as usize * self.width as usize..self.rows.1 as usize * self.width as usize;
        self.rows = (self.height, 0);
        let (Some(cover), Some(pixels)) = (self.cover.get_mut(range.clone()), image.pixels.get_mut(range))
        else {
            return;
        };
        for (cover, pixel) in cover.iter_mut().zip(pixels) {
            if *cover > 0 {
                *pixel = mixed(*pixel, ink, (u32::from(*cover) * u32::from(part) / 255) as u8);
                *cover = 0;
            }
        }
    }
}
