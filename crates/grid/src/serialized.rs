//! Vertices and points as serde reads and writes them.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

use crate::{Point, Vertex};

/// As `[x, y]`.
impl Serialize for Vertex {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (self.x, self.y).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Vertex {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        <(i32, i32)>::deserialize(deserializer).map(Self::from)
    }
}

/// A coordinate: an integer where it is whole.
#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "expected a number for a coordinate")]
enum Coordinate {
    Whole(i32),
    Decimal(f64),
}

/// As `[x, y]`, each an integer where it is whole.
impl Serialize for Point {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let coordinate = |cells: f64| match cells.fract() == 0.0 {
            // No coordinate is beyond those of all vertices.
            true => Coordinate::Whole(cells as i32),
            false => Coordinate::Decimal(cells),
        };
        (coordinate(self.x()), coordinate(self.y())).serialize(serializer)
    }
}

/// The nearest point.
impl<'de> Deserialize<'de> for Point {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (x, y) = <(Coordinate, Coordinate)>::deserialize(deserializer)?;
        let [x, y] = [x, y].map(|coordinate| match coordinate {
            Coordinate::Whole(cells) => f64::from(cells),
            Coordinate::Decimal(cells) => cells,
        });
        Self::nearest(x, y).ok_or_else(|| D::Error::custom("a coordinate is beyond those of all vertices"))
    }
}
