//! The axes of a chart.

/// How values become distances on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences have equal lengths.
    Linear,
    /// Equal ratios have equal lengths.
    Log,
}

/// An axis of a [`Chart`](super::Chart). Its range is that of the points, unless [`range`](Self::range) sets
/// it.
#[derive(Clone, Debug)]
pub struct Axis {
    pub(super) label: String,
    pub(super) scale: Scale,
    pub(super) range: Option<(f64, f64)>,
    /// Ticks with their names; without any, the ticks are round numbers.
    pub(super) named: Vec<(f64, String)>,
}

impl Axis {
    /// A linear axis. The label includes the unit.
    pub fn new(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Linear, range: None, named: Vec::new() }
    }

    /// The same axis with a logarithmic scale.
    #[must_use]
    pub fn log(self) -> Self {
        Self { scale: Scale::Log, ..self }
    }

    /// The same axis from `low` to `high`. A range that the scale cannot show is ignored: one that is empty
    /// or not finite, or not positive on a logarithmic scale.
    #[must_use]
    pub fn range(self, low: f64, high: f64) -> Self {
        Self { range: Some((low.min(high), low.max(high))), ..self }
    }

    /// The same axis with these ticks (value and name) instead of round numbers. A range that is not set
    /// includes them.
    #[must_use]
    pub fn ticks(self, ticks: impl IntoIterator<Item = (f64, String)>) -> Self {
        Self { named: ticks.into_iter().collect(), ..self }
    }

    /// Whether its ticks are round numbers, since none were given.
    pub(super) fn has_round_ticks(&self) -> bool {
        self.named.is_empty()
    }

    /// The scale.
    #[must_use]
    pub fn scale(&self) -> Scale {
        self.scale
    }
}
