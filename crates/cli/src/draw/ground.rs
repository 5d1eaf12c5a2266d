//! The ground of a picture: the map in pixels, and their colors.

use anstyle::RgbColor;
use mediant_formats::MapFile;

use super::theme::{Theme, of_share};

/// A pixel of ground: two by two dots.
#[derive(Clone, Copy)]
pub(super) struct Ground {
    pub(super) free: bool,
    pub(super) color: RgbColor,
}

/// For each character of a map whether it is free.
fn free_tiles(file: &MapFile) -> Vec<bool> {
    (0..=u8::MAX).map(|tile| file.is_free(tile)).collect()
}

/// The map's tile at each pixel, row by row. A pixel that covers several cells is free if at least half of
/// them are.
pub(super) fn pixels(file: &MapFile, columns: usize, rows: usize, pixel_in_cells: f64) -> Vec<u8> {
    const OUTSIDE: u8 = b'@';
    let (map, free_tile): (Vec<&[u8]>, _) = (file.rows().collect(), free_tiles(file));
    let is_free_tile = |tile: u8| free_tile[usize::from(tile)];
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
            let free = cells().filter(|&tile| is_free_tile(tile)).count();
            let is_free = 2 * free >= cells().count();
            result.push(cells().find(|&tile| is_free_tile(tile) == is_free).unwrap_or(OUTSIDE));
        }
    }
    result
}

/// Colors the pixels by how far they are from the border between free and blocked.
pub(super) fn paint(
    file: &MapFile,
    tiles: &[u8],
    columns: usize,
    pixel_in_cells: f64,
    theme: Theme,
) -> Vec<Ground> {
    let free_tile = free_tiles(file);
    let is_free_tile = |tile: u8| free_tile[usize::from(tile)];
    let depths = depths(tiles, columns, is_free_tile);
    let ground = tiles.iter().zip(depths).map(|(&tile, thirds)| {
        let free = is_free_tile(tile);
        // Depth is in pixels, or in cells if pixels are smaller than cells.
        let depth = (f64::from(thirds) / 3.0 * pixel_in_cells.min(1.0)).ceil() as u32;
        Ground { free, color: theme.color(tile, free, depth) }
    });
    ground.collect()
}

/// Colors the free pixels by the mean share of their free cells.
pub(super) fn shade(
    ground: &mut [Ground],
    columns: usize,
    pixel_in_cells: f64,
    share: impl Fn(i32, i32) -> Option<f64>,
) {
    let span = |i: usize| {
        let first = (i as f64 * pixel_in_cells) as i32;
        first..(((i + 1) as f64 * pixel_in_cells).ceil() as i32).max(first + 1)
    };
    for (number, pixel) in ground.iter_mut().enumerate().filter(|(_, pixel)| pixel.free) {
        let (row, column) = (number / columns, number % columns);
        let shares = span(row).flat_map(|y| span(column).map(move |x| (x, y)));
        let shares = shares.filter_map(|(x, y)| share(x, y));
        let (sum, count) = shares.fold((0.0, 0.0), |(sum, count), share| (sum + share, count + 1.0));
        if count > 0.0 {
            pixel.color = of_share(sum / count);
        }
    }
}

/// The distance of each pixel from the nearest pixel of the other kind, in thirds of a pixel: the chamfer
/// distance (3 for a step along an axis, 4 for a diagonal one), computed in one pass down and one up.
fn depths(tiles: &[u8], columns: usize, is_free_tile: impl Fn(u8) -> bool) -> Vec<u32> {
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
            let alike = is_free_tile(tiles[i]) == is_free_tile(tiles[other]);
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
