//! Charts of series over two axes.

use super::{
    axis::Axis,
    legend::Sample,
    plot::Plot,
    style::{Style, reference},
};

/// What stands for the points of a series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A line through the points, with a marker at each. It breaks at a point that is not finite.
    Line,
    /// Markers alone.
    Points,
    /// A thin dashed line in a muted color, without markers: a bound, y = 1.
    Reference,
}

/// Points that belong together.
#[derive(Clone, Debug)]
pub struct Series {
    pub(super) name: String,
    pub(super) mark: Mark,
    pub(super) points: Vec<(f64, f64)>,
    pub(super) labels: Vec<String>,
    style: Option<usize>,
    hollow: bool,
}

impl Series {
    /// A series of points (x, y) in the units of the axes. A point that is not finite is left out.
    pub fn new(name: impl Into<String>, mark: Mark, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = points.into_iter().collect();
        Self { name: name.into(), mark, points, labels: Vec::new(), style: None, hollow: false }
    }

    /// The same with a short text beside each point, in the order of the points; an empty text is none.
    #[must_use]
    pub fn labels(self, labels: impl IntoIterator<Item = String>) -> Self {
        Self { labels: labels.into_iter().collect(), ..self }
    }

    /// The same with the color, marker and dash of this number, instead of those of its place among the chart's series
    /// (references aside).
    #[must_use]
    pub fn style(self, index: usize) -> Self {
        Self { style: Some(index), ..self }
    }

    /// The same with markers that are not filled.
    #[must_use]
    pub fn hollow(self) -> Self {
        Self { hollow: true, ..self }
    }
}

/// A series with its look.
#[derive(Clone, Copy, Debug)]
pub(super) struct Styled<'a> {
    pub(super) series: &'a Series,
    index: usize,
}

impl Styled<'_> {
    pub(super) const fn style(&self) -> Style {
        Style(self.index)
    }

    pub(super) fn is_reference(&self) -> bool {
        self.series.mark == Mark::Reference
    }

    /// The classes of the line, if it has one.
    pub(super) fn line(&self) -> Option<String> {
        match self.series.mark {
            Mark::Line => Some(self.style().line()),
            Mark::Points => None,
            Mark::Reference => Some(reference(self.index)),
        }
    }

    /// The classes of the markers; a clamped one is always hollow.
    pub(super) fn marker(&self, clamped: bool) -> String {
        self.style().mark(clamped || self.series.hollow)
    }

    fn sample(&self) -> Sample {
        let marker = (!self.is_reference()).then(|| (self.style().marker(), self.marker(false)));
        Sample::Curve { line: self.line(), width: None, marker }
    }
}

/// A chart: series over two axes, with a legend.
///
/// A point beyond the range of an axis, or at 0 or below on a logarithmic one, is drawn hollow on the border, where the axis then
/// says '≤' or '≥': it is seen that it is there, and that it is not there.
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
    series: Vec<Series>,
}

impl Chart {
    /// A chart without series.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), note: None, x, y, series: Vec::new() }
    }

    /// The same with a line under the title: sample size, source.
    #[must_use]
    pub fn note(self, note: impl Into<String>) -> Self {
        Self { note: Some(note.into()), ..self }
    }

    /// The same with one more series.
    #[must_use]
    pub fn series(mut self, series: Series) -> Self {
        self.push(series);
        self
    }

    /// Adds a series.
    pub fn push(&mut self, series: Series) {
        self.series.push(series);
    }

    /// The chart as a whole SVG file.
    #[must_use]
    pub fn svg(&self) -> String {
        Plot::new(self, &self.styled()).svg()
    }

    /// References and others are counted apart, so that the first of the others has the first style.
    fn styled(&self) -> Vec<Styled<'_>> {
        let mut counts = [0, 0];
        let styled = self.series.iter().map(|series| {
            let count = &mut counts[usize::from(series.mark == Mark::Reference)];
            *count += 1;
            Styled { series, index: series.style.unwrap_or(*count - 1) }
        });
        styled.collect()
    }

    pub(super) fn entries(series: &[Styled<'_>]) -> impl Iterator<Item = (String, Sample)> {
        series.iter().map(|styled| (styled.series.name.clone(), styled.sample()))
    }

    /// What a reader hears who does not see the chart.
    pub(super) fn description(&self) -> String {
        let names: Vec<&str> = self.series.iter().map(|series| &*series.name).collect();
        let note = self.note.as_deref().map_or(String::new(), |note| format!(" {note}"));
        format!("Chart of {} over {}. Series: {}.{note}", self.y.label, self.x.label, names.join("; "))
    }
}
