//! Lines of dots: a Braille character is two dots wide and four high.

use anstyle::RgbColor;

/// Dots above each other in one character.
pub(crate) const DOT_ROWS: usize = 4;
/// Dots beside each other in one character.
pub(crate) const DOT_COLUMNS: usize = 2;

/// The pattern of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stroke {
    Solid,
    Dashed,
    Dotted,
}

impl Stroke {
    /// Whether the `i`-th dot of a line is drawn.
    pub(crate) const fn inks(self, i: usize) -> bool {
        match self {
            Self::Solid => true,
            Self::Dashed => i % 6 < 4,
            Self::Dotted => i.is_multiple_of(3),
        }
    }

    /// Two characters of such a line.
    pub(crate) const fn sample(self) -> &'static str {
        match self {
            Self::Solid => "⠤⠤",
            Self::Dashed => "⠤⠄",
            Self::Dotted => "⠄⠠",
        }
    }
}

/// The content of one character: a mark or dots, and their color.
#[derive(Clone, Copy)]
pub(crate) struct Glyph {
    dots: u8,
    mark: Option<char>,
    pub(crate) ink: RgbColor,
}

impl Glyph {
    const NONE: Self = Self { dots: 0, mark: None, ink: RgbColor(0, 0, 0) };

    /// The mark, else the dots as a character; `None` without either.
    pub(crate) fn letter(self) -> Option<char> {
        let dots = (self.dots != 0).then(|| char::from_u32(0x2800 + u32::from(self.dots))).flatten();
        self.mark.or(dots)
    }
}

/// Rows of characters to draw dots and marks on.
pub(crate) struct Sheet {
    columns: usize,
    rows: usize,
    glyphs: Vec<Glyph>,
}

impl Sheet {
    /// An empty sheet.
    pub(crate) fn new(columns: usize, rows: usize) -> Self {
        Self { columns, rows, glyphs: vec![Glyph::NONE; columns * rows] }
    }

    /// Its width in characters.
    pub(crate) const fn columns(&self) -> usize {
        self.columns
    }

    /// Its height in characters.
    pub(crate) const fn rows(&self) -> usize {
        self.rows
    }

    /// The glyphs of a row of characters.
    pub(crate) fn row(&self, row: usize) -> &[Glyph] {
        &self.glyphs[row * self.columns..][..self.columns]
    }

    /// Draws the dot of column x and row y, both in dots. Outside the sheet it draws nothing.
    pub(crate) fn dot(&mut self, x: usize, y: usize, ink: RgbColor) {
        // Unicode counts the dots down the left column, then down the right one, but for the lowest two.
        const BITS: [[u8; DOT_COLUMNS]; DOT_ROWS] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];
        let Some(glyph) = self.glyph(x, y) else { return };
        if glyph.ink != ink {
            // A character has one color: the line drawn last replaces the others.
            *glyph = Glyph { ink, ..Glyph::NONE };
        }
        glyph.dots |= BITS[y % DOT_ROWS][x % DOT_COLUMNS];
    }

    /// Puts a mark in place of the character that holds the dot (x, y).
    pub(crate) fn mark(&mut self, x: usize, y: usize, mark: char, ink: RgbColor) {
        if let Some(glyph) = self.glyph(x, y) {
            *glyph = Glyph { dots: 0, mark: Some(mark), ink };
        }
    }

    /// The character that holds the dot (x, y), if it is on the sheet.
    fn glyph(&mut self, x: usize, y: usize) -> Option<&mut Glyph> {
        let (column, row) = (x / DOT_COLUMNS, y / DOT_ROWS);
        if column >= self.columns {
            return None;
        }
        self.glyphs.get_mut(row * self.columns + column)
    }
}

/// The positions of a line's dots, in dots: one for each unit step along the longer axis, at the middle of
/// the step.
pub(crate) fn steps(from: (f64, f64), to: (f64, f64)) -> impl Iterator<Item = (f64, f64)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let steps = dx.abs().max(dy.abs()).round().max(1.0);
    (0..steps as u32).map(move |step| {
        let t = (f64::from(step) + 0.5) / steps;
        (from.0 + t * dx, from.1 + t * dy)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const INK: RgbColor = RgbColor(1, 2, 3);

    #[test]
    fn dots_add_up_in_one_color_and_marks_cover_them() {
        let letters = |sheet: &Sheet| sheet.row(0).iter().map(|glyph| glyph.letter()).collect::<Vec<_>>();
        let mut sheet = Sheet::new(2, 1);
        for (x, y) in [(0, 0), (1, 3), (2, 1), (4, 0), (0, 4)] {
            sheet.dot(x, y, INK);
        }
        assert_eq!(letters(&sheet), [Some('⢁'), Some('⠂')]);
        sheet.dot(1, 0, RgbColor(9, 9, 9));
        sheet.mark(3, 3, 'x', INK);
        assert_eq!(letters(&sheet), [Some('⠈'), Some('x')]);
    }

    #[test]
    fn a_line_has_a_dot_for_each_step_along_its_longer_axis() {
        let dots: Vec<_> = steps((0.0, 0.0), (4.0, -2.0)).collect();
        assert_eq!(dots, [(0.5, -0.25), (1.5, -0.75), (2.5, -1.25), (3.5, -1.75)]);
        assert_eq!(steps((1.0, 1.0), (1.0, 1.0)).count(), 1);
    }
}
