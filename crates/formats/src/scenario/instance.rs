//! One query of a scenario, and which values a file can hold.

use std::sync::Arc;

use mediant_grid::Vertex;

/// One query of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// The bucket: queries of about the same optimal length share one.
    pub bucket: u32,
    /// The map as the file names it. The name may begin with folders, and may contain spaces where tabs
    /// separate the fields.
    pub map: Arc<str>,
    /// The map's number of columns.
    pub width: u32,
    /// The map's number of rows.
    pub height: u32,
    /// Where the path begins. It may lie outside the map.
    pub start: Vertex,
    /// Where the path ends. It may lie outside the map.
    pub goal: Vertex,
    /// The length of a shortest path in cells, as exactly as the file writes it: over the 8-neighborhood (k =
    /// 3) between cell centers, without cutting corners (`CornerRule::Never`). 0 between two places says that
    /// it is unknown, or that there is no path.
    pub optimal: f64,
}

impl Instance {
    /// The map's name without the folders.
    #[must_use]
    pub fn map_file_name(&self) -> &str {
        self.map.rsplit(['/', '\\']).next().unwrap_or(&self.map)
    }

    /// The length of a shortest path, if the scenario knows it: `None` for a 0 between two places.
    #[must_use]
    pub fn known_optimal(&self) -> Option<f64> {
        (self.optimal > 0.0 || self.start == self.goal).then_some(self.optimal)
    }
}

/// How far the cost of a shortest path may be from the optimal length that a scenario states: 0.005, or 10⁻⁵
/// of the length if that is more.
///
/// Scenario files round. The oldest sets (bg512, wc3maps512) carry two decimals, most of the others about six
/// significant digits of sums in single precision, the street maps eight decimals.
#[must_use]
pub fn scenario_tolerance(optimal: f64) -> f64 {
    f64::max(0.005, 1e-5 * optimal)
}

/// The names that [`is_map_name`] accepts, for error messages.
pub(super) const MAP_NAMES: &str = "a UTF-8 name without control characters and without spaces around it";

/// Whether a line with tabs can hold this name and give it back.
pub(super) fn is_map_name(name: &str) -> bool {
    !name.is_empty() && name.trim_matches(' ') == name && !name.contains(char::is_control)
}

/// The lengths that [`is_length`] accepts, for error messages.
pub(super) const LENGTHS: &str = "a length of 0 or more";

/// Whether a path can have this length: neither negative nor infinite, and not −0 either.
pub(super) fn is_length(length: f64) -> bool {
    length.is_finite() && length.is_sign_positive()
}
