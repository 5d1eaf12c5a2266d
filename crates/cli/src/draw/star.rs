//! The moves of N(k) as a star: a ray for each move, with its level at the tip.

use std::io::{self, Write};

use anstyle::RgbColor;
use mediant::moves::{Neighborhood, Vector, level};

use super::braille::{DOT_COLUMNS, DOT_ROWS, Sheet, steps};
use crate::terminal::screen::Screen;

/// The largest k whose star fits on a screen.
pub(crate) const MAX_K: u32 = 7;

/// Colors of the levels, from level 2 up. All can be seen on a light and on a dark screen.
const LEVEL_INKS: [RgbColor; 6] = [
    RgbColor(0xe0, 0x5a, 0x4e),
    RgbColor(0xe0, 0x9a, 0x2b),
    RgbColor(0x5f, 0xaf, 0x4a),
    RgbColor(0x38, 0xa5, 0xb8),
    RgbColor(0x5b, 0x86, 0xe0),
    RgbColor(0xa8, 0x74, 0xd6),
];

/// Draws the star, and says how to read it.
pub(crate) fn draw(neighborhood: Neighborhood, screen: &mut Screen) -> io::Result<()> {
    let radius = neighborhood.quadrant().iter().map(|v| v.x.unsigned_abs() as usize).max().unwrap_or(0);
    // From 7 to 33 rows.
    let rows_per_unit = if radius > 3 { 2 } else { 3 };
    let side = 2 * radius * rows_per_unit + 1;
    let mut sheet = Sheet::new(2 * side, side);
    let tip = |v: Vector| {
        // A unit is a square: as many dots wide as high. The origin is in the middle of a character.
        let place =
            |along: i32, middle: usize| middle as f64 + f64::from(along) * (rows_per_unit * DOT_ROWS) as f64;
        let (middle_x, middle_y) = (side / 2 * 2 * DOT_COLUMNS, side / 2 * DOT_ROWS);
        (place(v.x, middle_x) + DOT_COLUMNS as f64 / 2.0, place(v.y, middle_y) + DOT_ROWS as f64 / 2.0)
    };
    let mut moves: Vec<(u32, Vector)> = neighborhood.iter().filter_map(|v| Some((level(v)?, v))).collect();
    // Low levels are drawn last, over the levels that come from them.
    moves.sort_by_key(|&(level, _)| std::cmp::Reverse(level));
    for &(level, v) in &moves {
        for (x, y) in steps(tip(Vector::ZERO), tip(v)) {
            sheet.dot(x as usize, y as usize, ink(level));
        }
    }
    for &(level, v) in &moves {
        let (x, y) = tip(v);
        sheet.mark(x as usize, y as usize, char::from_digit(level, 10).unwrap_or('+'), ink(level));
    }
    let (x, y) = tip(Vector::ZERO);
    sheet.mark(x as usize, y as usize, '●', ink(2));
    for row in 0..sheet.rows() {
        let letters = sheet.row(row).iter().map(|glyph| match glyph.letter() {
            Some(letter) => screen.paint(screen.ink(glyph.ink), letter).to_string(),
            None => " ".to_owned(),
        });
        let line: String = letters.collect();
        writeln!(screen, "  {}", line.trim_end())?;
    }
    writeln!(
        screen,
        "\n  A move's number is its level: the smallest k that has it, as the sum of its two neighbors."
    )
}

fn ink(level: u32) -> RgbColor {
    LEVEL_INKS.get(level as usize - 2).copied().unwrap_or(LEVEL_INKS[0])
}
