//! The land of a picture: the costs or the elevations of cells.

use mediant::{Costs, PlacementKind, Vertex, Walking};

use crate::map::NamedMap;

/// The number of each free cell.
pub(super) struct Land<'m> {
    costs: Option<&'m Costs>,
    walking: Option<&'m Walking>,
    least: f64,
    greatest: f64,
    /// The meaning of the numbers.
    pub(super) caption: &'static str,
}

impl<'m> Land<'m> {
    /// The land of a map; `None` if its cells have no numbers.
    pub(super) fn of(map: &'m NamedMap) -> Option<Self> {
        let (costs, walking) = (map.costs.as_ref(), map.walking.as_ref());
        let caption = match (costs, walking) {
            (Some(_), _) => "colors: what a unit of length costs",
            (None, Some(_)) => "colors: elevation",
            (None, None) => return None,
        };
        let land = Self { costs, walking, least: 0.0, greatest: 0.0, caption };
        let numbers = map.cells_by_row().filter_map(|(x, y)| land.number(x, y));
        let (least, greatest) = numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), number| {
            (low.min(number), high.max(number))
        });
        Some(Self { least, greatest, ..land })
    }

    /// Whether lines of equal numbers mean something: those of elevations do.
    pub(super) const fn has_contours(&self) -> bool {
        self.walking.is_some()
    }

    /// The number of a cell; `None` for a blocked one.
    fn number(&self, x: i32, y: i32) -> Option<f64> {
        let elevation = || self.walking.and_then(|walking| walking.elevation((x, y)));
        self.costs.map_or_else(elevation, |costs| costs.cost((x, y)))
    }

    /// The number at a vertex: at corners the mean of the free cells around it.
    pub(super) fn at(&self, placement: PlacementKind, at: Vertex) -> Option<f64> {
        if placement == PlacementKind::Center {
            return self.number(at.x, at.y);
        }
        let around = [(0, 0), (-1, 0), (0, -1), (-1, -1)];
        let numbers = around.into_iter().filter_map(|(dx, dy)| self.number(at.x + dx, at.y + dy));
        let (sum, count) = numbers.fold((0.0, 0.0), |(sum, count), number| (sum + number, count + 1.0));
        (count > 0.0).then(|| sum / count)
    }

    /// The place of a cell's number between the least and the greatest, 0 to 1.
    pub(super) fn share(&self, x: i32, y: i32) -> Option<f64> {
        let width = (self.greatest - self.least).max(f64::MIN_POSITIVE);
        self.number(x, y).map(|number| (number - self.least) / width)
    }
}
