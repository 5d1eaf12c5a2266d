//! The error of a scenario that does not fit a map.

use std::fmt;

use super::instance::Instance;

/// A scenario that was made for a map of another width or height.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "instance {index} of the scenario: expected the map `{expected}` of {}, found `{found}` of {}; \
     take the scenario that was made for this map",
    Size(*expected_size), Size(*found_size)
)]
pub struct MapMismatch {
    /// The first query that does not fit, from 0.
    pub index: usize,
    /// The map that the query names.
    pub expected: String,
    /// The width and height that the query states.
    pub expected_size: (u32, u32),
    /// The name of the map that was given.
    pub found: String,
    /// Its width and height.
    pub found_size: (u32, u32),
}

struct Size((u32, u32));

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} × {} cells", self.0.0, self.0.1)
    }
}

/// Compares the width and height that each query states with those of a map.
pub(super) fn check(instances: &[Instance], size: (u32, u32), name: &str) -> Result<(), MapMismatch> {
    let differs = |instance: &Instance| (instance.width, instance.height) != size;
    let Some(index) = instances.iter().position(differs) else { return Ok(()) };
    let Instance { map, width, height, .. } = &instances[index];
    Err(MapMismatch {
        index,
        expected: map.to_string(),
        expected_size: (*width, *height),
        found: name.to_owned(),
        found_size: size,
    })
}
