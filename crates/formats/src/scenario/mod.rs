//! MovingAI scenarios, `.scen`.

pub(crate) mod error;
mod instance;
mod mismatch;
pub(crate) mod parse;
mod write;

use std::{io, path::Path};

use mediant_grid::Grid;

pub use error::ScenarioError;
pub use instance::{Instance, scenario_tolerance};
pub use mismatch::MapMismatch;

use crate::read::{ReadError, read_regular};

/// A list of queries, in the order of the file.
///
/// The first line is `version 1` or `version 1.0`. Each further line is a query with nine fields: bucket,
/// map, width, height, start x, start y, goal x, goal y, optimal length. The fields of a line are separated
/// by tabs, or by spaces if the line has no tab. Empty lines are skipped, and so is the byte order mark of
/// UTF-8.
///
/// ```
/// use mediant_formats::Scenario;
/// let text = b"version 1\n0\tmaps/yard.map\t3\t2\t0\t0\t2\t1\t2.41421\n";
/// let scenario = Scenario::parse(text)?;
/// assert_eq!(scenario.instances()[0].goal, (2, 1).into());
/// assert_eq!(scenario.as_bytes(), text);
/// # Ok::<(), mediant_formats::ScenarioError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    text: Vec<u8>,
    instances: Vec<Instance>,
}

impl Scenario {
    /// Parses a scenario.
    ///
    /// # Errors
    /// [`ScenarioError`] says what is wrong and where.
    pub fn parse(bytes: &[u8]) -> Result<Self, ScenarioError> {
        Self::from_bytes(bytes.to_vec())
    }

    /// Parses a scenario and keeps the bytes without copying them, in time and memory linear in their number.
    ///
    /// # Errors
    /// [`ScenarioError`] says what is wrong and where.
    pub fn from_bytes(text: Vec<u8>) -> Result<Self, ScenarioError> {
        let instances = parse::instances(&text)?;
        Ok(Self { text, instances })
    }

    /// Reads and parses a file.
    ///
    /// # Errors
    /// [`ReadError`] for a file that is missing, cannot be read, or is no scenario.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        Self::from_bytes(read_regular(path)?)
            .map_err(|source| ReadError::Scenario { path: path.to_owned(), source })
    }

    /// Makes the scenario of a list of queries: version 1, fields separated by tabs, lengths with as many
    /// digits as it takes to read the same number back.
    ///
    /// # Errors
    /// [`ScenarioError::Unwritable`] for a map's name or a length that would not be read back as it is.
    pub fn from_instances(instances: Vec<Instance>) -> Result<Self, ScenarioError> {
        let text = write::text(&instances)?.into_bytes();
        Ok(Self { text, instances })
    }

    /// The queries, in the order of the file.
    #[must_use]
    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }

    /// Checks that every query was made for a map of this grid's width and height. An error calls the grid
    /// `name`.
    ///
    /// Names are not compared, so that maps can be renamed; a caller can compare [`Instance::map_file_name`]
    /// and warn.
    ///
    /// # Errors
    /// [`MapMismatch`] for the first query of another width or height.
    pub fn check_map(&self, grid: &Grid, name: &str) -> Result<(), MapMismatch> {
        self.check_size((grid.width(), grid.height()), name)
    }

    /// [`check_map`](Self::check_map) by width and height, for callers without a grid.
    ///
    /// # Errors
    /// [`MapMismatch`] for the first query of another width or height.
    pub fn check_size(&self, size: (u32, u32), name: &str) -> Result<(), MapMismatch> {
        mismatch::check(&self.instances, size, name)
    }

    /// The text of the file, byte for byte.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        &self.text
    }

    /// Writes the text of the file, byte for byte.
    ///
    /// # Errors
    /// Errors of the writer.
    pub fn write(&self, mut out: impl io::Write) -> io::Result<()> {
        out.write_all(&self.text)
    }
}
