//! Vertices as serde reads and writes them.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::Vertex;

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
