//! Legends, which say what each color, marker and dash stands for.

use super::{
    canvas::{Anchor, Canvas},
    geometry::Point,
    style::Marker,
    text::{LINE, TEXT, text_width, wrap},
};

const LINE_SAMPLE: f64 = 30.0;
const MARK_SAMPLE: f64 = 14.0;
const GAP: f64 = 8.0;
const BETWEEN_ENTRIES: f64 = 5.0;
const BETWEEN_COLUMNS: f64 = 24.0;

/// The sample before the name of an entry.
#[derive(Clone, Debug)]
pub(super) enum Sample {
    /// The classes of a line, its width if not that of the class, and a marker with its classes.
    Curve { line: Option<String>, width: Option<f64>, marker: Option<(Marker, String)> },
    /// A letter in a disk.
    Badge(&'static str),
}

impl Sample {
    const fn width(&self) -> f64 {
        if matches!(self, Self::Curve { line: Some(_), .. }) { LINE_SAMPLE } else { MARK_SAMPLE }
    }

    /// Draws the sample at the right of `(x, y)`, in a room of width `whole`.
    fn draw(&self, canvas: &mut Canvas, (x, y): Point, whole: f64) {
        let middle = (x + whole / 2.0, y);
        match self {
            Self::Badge(letter) => badge(canvas, middle, letter),
            Self::Curve { line, width, marker } => {
                if let Some(class) = line {
                    canvas.path(class, &[(x, y), (x + whole, y)], false, *width);
                }
                if let Some((marker, class)) = marker {
                    let radius = width.map_or(4.0, |width| 4.0_f64.max(0.7 * width + 1.0));
                    marker.draw(canvas, class, middle, radius);
                }
            }
        }
    }
}

/// Draws a letter in a disk.
pub(super) fn badge(canvas: &mut Canvas, at: Point, letter: &str) {
    canvas.circle("badge", at, 8.0);
    canvas.text("onbadge", Anchor::Middle, (at.0, at.1 + 4.0), letter);
}

/// A legend whose names are broken into lines.
#[derive(Clone, Debug)]
pub(super) struct Legend {
    entries: Vec<(Sample, Vec<String>)>,
    sample: f64,
    /// The width of the widest entry.
    pub(super) width: f64,
}

impl Legend {
    /// A legend with entries of at most this width. Entries without a name are left out.
    pub(super) fn new(entries: impl Iterator<Item = (String, Sample)>, width: f64) -> Self {
        let entries: Vec<(String, Sample)> = entries.collect();
        let sample = entries.iter().map(|(_, sample)| sample.width()).fold(0.0, f64::max);
        let room = width - sample - GAP;
        let entries = entries.into_iter().map(|(name, sample)| (sample, wrap(&name, TEXT, room)));
        let entries: Vec<_> = entries.filter(|(_, lines)| !lines.is_empty()).collect();
        let widths = entries.iter().flat_map(|(_, lines)| lines).map(|line| text_width(line, TEXT));
        let widest = widths.fold(0.0, f64::max);
        let width = if entries.is_empty() { 0.0 } else { sample + GAP + widest };
        Self { entries, sample, width }
    }

    /// The number of columns that fit into this width.
    pub(super) fn columns(&self, width: f64) -> usize {
        let columns = (width + BETWEEN_COLUMNS) / (self.width + BETWEEN_COLUMNS);
        (columns as usize).clamp(1, self.entries.len().max(1))
    }

    pub(super) fn height(&self, columns: usize) -> f64 {
        self.entries.chunks(columns).map(row_height).sum()
    }

    /// Draws the legend row by row. `at` is its upper left corner.
    pub(super) fn draw(&self, canvas: &mut Canvas, at: Point, columns: usize) {
        let mut y = at.1;
        for row in self.entries.chunks(columns) {
            let mut x = at.0;
            for (sample, lines) in row {
                sample.draw(canvas, (x, y + LINE / 2.0), self.sample);
                for (line, i) in lines.iter().zip(0_u32..) {
                    let base = y + f64::from(i) * LINE + LINE / 2.0 + 4.0;
                    canvas.text("", Anchor::Start, (x + self.sample + GAP, base), line);
                }
                x += self.width + BETWEEN_COLUMNS;
            }
            y += row_height(row);
        }
    }
}

fn row_height(row: &[(Sample, Vec<String>)]) -> f64 {
    LINE * row.iter().map(|(_, lines)| lines.len()).max().unwrap_or(0) as f64 + BETWEEN_ENTRIES
}
