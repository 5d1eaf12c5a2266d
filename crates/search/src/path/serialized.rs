//! Paths as serde reads and writes them.

use mediant_grid::Point;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Path;

/// As its points, `[[x, y], …]`, without a cost of its own.
impl Serialize for Path {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.points())
    }
}

/// The length is measured anew, and is the cost.
impl<'de> Deserialize<'de> for Path {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::<Point>::deserialize(deserializer).map(Self::through)
    }
}
