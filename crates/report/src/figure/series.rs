//! Series of a chart, and how each looks.

use super::{
    legend::Sample,
    style::{Style, reference},
};

/// How the points of a series are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A line through the points, with a marker at each. It breaks at a point that is not finite.
    Line,
    /// Markers alone.
    Points,
    /// A thin dashed line in a muted color, without markers: for bounds and lines such as y = 1.
    Reference,
}

/// Points of a chart that belong together, with a name in the legend.
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

    /// The same series with a short text beside each point, in the order of the points. A point with an empty
    /// text has none.
    #[must_use]
    pub fn labels(self, labels: impl IntoIterator<Item = String>) -> Self {
        Self { labels: labels.into_iter().collect(), ..self }
    }

    /// The same series with the color, marker and dash of this number. Without it, the first series of a
    /// chart has number 0, the next one number 1, and so on; references have numbers of their own.
    #[must_use]
    pub fn style(self, index: usize) -> Self {
        Self { style: Some(index), ..self }
    }

    /// The same series with markers that are not filled.
    #[must_use]
    pub fn hollow(self) -> Self {
        Self { hollow: true, ..self }
    }
}

/// A series with the number of its style.
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

    /// The classes of its line, if it has one.
    pub(super) fn line(&self) -> Option<String> {
        match self.series.mark {
            Mark::Line => Some(self.style().line()),
            Mark::Points => None,
            Mark::Reference => Some(reference(self.index)),
        }
    }

    /// The classes of a marker. A clamped one is always hollow.
    pub(super) fn marker(&self, clamped: bool) -> String {
        self.style().mark(clamped || self.series.hollow)
    }

    /// The name and the sample of its entry in the legend.
    pub(super) fn entry(&self) -> (String, Sample) {
        let marker = (!self.is_reference()).then(|| (self.style().marker(), self.marker(false)));
        (self.series.name.clone(), Sample::Curve { line: self.line(), width: None, marker })
    }
}

/// The series of a chart with their styles. References are counted apart, so that the first series that is
/// none has the first style.
pub(super) fn styled(series: &[Series]) -> Vec<Styled<'_>> {
    let mut counts = [0, 0];
    let styled = series.iter().map(|series| {
        let count = &mut counts[usize::from(series.mark == Mark::Reference)];
        *count += 1;
        Styled { series, index: series.style.unwrap_or(*count - 1) }
    });
    styled.collect()
}
