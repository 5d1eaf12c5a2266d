//! Directions as numbers, as other programs write them.

use mediant_moves::Vector;

use super::CostField;

/// A way to write a direction to the source as a number in a raster.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DirectionCode {
    /// The back link of ArcGIS's Cost Back Link: 1 to 8 clockwise from east, 0 at a source. It has no number
    /// for moves of k = 4 and more.
    ArcGisBackLink,
    /// The back direction of ArcGIS's Distance Accumulation: degrees clockwise from north, above 0 to 360, 0
    /// at a source. (There directions are of any angle, here of N(k).)
    ArcGisDegrees,
    /// The movement directions of GRASS's `r.cost` and `r.walk`: degrees counterclockwise from east, above 0
    /// to 360. A source has none. Moves of k = 4 have the nominal multiples of 22.5.
    Grass,
}

impl DirectionCode {
    /// The number of a move; `None` if the code has none for it.
    #[must_use]
    pub fn of(self, v: Vector) -> Option<f64> {
        // y is down on the map, and up in angles.
        let (x, y) = (f64::from(v.x), -f64::from(v.y));
        match self {
            Self::ArcGisBackLink => {
                const CLOCKWISE: [(i32, i32); 8] =
                    [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];
                let place = CLOCKWISE.iter().position(|&known| known == (v.x, v.y))?;
                Some(place as f64 + 1.0)
            }
            Self::ArcGisDegrees => Some(positive(x.atan2(y).to_degrees())),
            Self::Grass if v.abs() == (1, 2) || v.abs() == (2, 1) => {
                Some(positive((y.atan2(x).to_degrees() / 22.5).round() * 22.5))
            }
            Self::Grass => Some(positive(y.atan2(x).to_degrees())),
        }
    }

    /// The number of a source; `None` if it has none.
    #[must_use]
    pub const fn of_source(self) -> Option<f64> {
        match self {
            Self::ArcGisBackLink | Self::ArcGisDegrees => Some(0.0),
            Self::Grass => None,
        }
    }
}

/// Degrees above 0, up to 360.
fn positive(degrees: f64) -> f64 {
    if degrees > 0.0 { degrees } else { degrees + 360.0 }
}

impl CostField {
    /// The directions of all vertices to their nearest source, row by row, by a code; `None` where a vertex
    /// is not in the field, or the code has no number.
    pub fn directions(&self, code: DirectionCode) -> impl Iterator<Item = Option<f64>> {
        self.vertices().map(move |at| match self.direction(at) {
            Some(v) => code.of(v),
            None => self.cost(at).and_then(|_| code.of_source()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_those_of_the_programs() {
        let of = |code: DirectionCode, x, y| code.of(Vector::new(x, y));
        use DirectionCode::{ArcGisBackLink, ArcGisDegrees, Grass};
        // East, south-east, north.
        assert_eq!([of(ArcGisBackLink, 1, 0), of(ArcGisBackLink, 1, 1)], [Some(1.0), Some(2.0)]);
        assert_eq!([of(ArcGisBackLink, 0, -1), of(ArcGisBackLink, 2, 1)], [Some(7.0), None]);
        assert_eq!([of(ArcGisDegrees, 1, 0), of(ArcGisDegrees, 1, 1)], [Some(90.0), Some(135.0)]);
        assert_eq!([of(ArcGisDegrees, 0, -1), of(ArcGisDegrees, -1, 0)], [Some(360.0), Some(270.0)]);
        assert_eq!(
            [of(Grass, 1, 0), of(Grass, 1, -1), of(Grass, 0, 1)],
            [Some(360.0), Some(45.0), Some(270.0)]
        );
        assert_eq!([of(Grass, 2, -1), of(Grass, -1, -2)], [Some(22.5), Some(112.5)]);
        // GRASS has no longer moves: the angle of one is its own.
        assert!(of(Grass, 3, -1).is_some_and(|degrees| (degrees - 18.435).abs() < 1e-3));
    }
}
