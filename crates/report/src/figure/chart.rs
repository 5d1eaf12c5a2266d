//! Charts of series over two axes.

use super::{axis::Axis, series::Series};

/// A chart: series over two axes, with a legend.
///
/// A point beyond the range of an axis, or at 0 or below on a logarithmic axis, is drawn as a hollow marker
/// on the border, where the axis says '≤' or '≥'. So no point is lost, and none is taken for a point on the
/// border.
///
/// ```
/// use mediant_report::{Axis, Chart, Mark, Series};
/// let chart = Chart::new("Nodes expanded", Axis::new("k"), Axis::new("nodes").log())
///     .series(Series::new("A*", Mark::Line, [(2.0, 31.0), (3.0, 470.0), (4.0, 1250.0)]))
///     .series(Series::new("bound", Mark::Reference, [(2.0, 2000.0), (4.0, 2000.0)]));
/// assert!(chart.svg().contains("A*"));
/// ```
#[derive(Clone, Debug)]
pub struct Chart {
    pub(super) title: String,
    pub(super) note: Option<String>,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) series: Vec<Series>,
}

impl Chart {
    /// A chart without series.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), note: None, x, y, series: Vec::new() }
    }

    /// The same chart with a line under the title: sample size, source.
    #[must_use]
    pub fn note(self, note: impl Into<String>) -> Self {
        Self { note: Some(note.into()), ..self }
    }

    /// The same chart with one more series.
    #[must_use]
    pub fn series(mut self, series: Series) -> Self {
        self.push(series);
        self
    }

    /// Adds a series.
    pub fn push(&mut self, series: Series) {
        self.series.push(series);
    }

    /// The chart in words, for a screen reader.
    pub(super) fn description(&self) -> String {
        let names: Vec<&str> = self.series.iter().map(|series| &*series.name).collect();
        let note = self.note.as_deref().map_or(String::new(), |note| format!(" {note}"));
        format!("Chart of {} over {}. Series: {}.{note}", self.y.label, self.x.label, names.join("; "))
    }
}
