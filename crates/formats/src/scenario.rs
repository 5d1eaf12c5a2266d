//! MovingAI scenarios, `.scen`.

use std::{fmt, io, path::Path, str::FromStr, sync::Arc};

use mediant_grid::{Grid, Vertex};

use crate::{
    ReadError,
    read::read_regular,
    text::{Line, Lines, is_blank, quote, quote_line, words},
};

/// One query of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// The group of queries of about the same length that this one belongs to.
    pub bucket: u32,
    /// The map as the file names it: may begin with folders and, where tabs separate the fields, contain spaces.
    pub map: Arc<str>,
    /// The map's number of columns.
    pub width: u32,
    /// The map's number of rows.
    pub height: u32,
    /// Where the path begins. May lie outside the map.
    pub start: Vertex,
    /// Where the path ends. May lie outside the map.
    pub goal: Vertex,
    /// The length of a shortest path at k = 3, `Center`, corner rule `Never`, in cells; as exact as the file writes it.
    pub optimal: f64,
}

impl Instance {
    /// The map's name without the folders.
    #[must_use]
    pub fn map_file_name(&self) -> &str {
        self.map.rsplit(['/', '\\']).next().unwrap_or(&self.map)
    }
}

/// How far the cost of a shortest path may be from a length that a scenario states: 0.005, or 10⁻⁵ of it.
///
/// Scenario files round. The oldest sets (bg512, wc3maps512) carry two decimals, most of the others about six significant
/// digits of sums in single precision, the street maps eight decimals.
#[must_use]
pub fn scenario_tolerance(optimal: f64) -> f64 {
    f64::max(0.005, 1e-5 * optimal)
}

/// A list of queries, in the order of the file.
///
/// The first line is `version 1` or `version 1.0`. Each further line has nine fields: bucket, map, width, height, start x,
/// start y, goal x, goal y, optimal length. Tabs separate them, or, in a line without tabs, spaces. Empty lines are passed over.
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

/// A text that is not a MovingAI scenario, or instances that cannot be written as one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ScenarioError {
    /// No bytes at all.
    #[error(
        "line 1, column 1: expected a MovingAI scenario, found an empty file; is this the file that you meant?"
    )]
    Empty,
    /// The first line is no version that is known.
    #[error(
        "line 1, column 1: expected `version 1` or `version 1.0`, found {found}; \
         a MovingAI scenario begins with its version, with a line a query below"
    )]
    Version {
        /// What stands there.
        found: String,
    },
    /// A line has too few or too many fields.
    #[error(
        "line {line}, column {column}: expected nine fields (bucket, map, width, height, start x, start y, goal x, goal y, \
         optimal length), found {found}; separate them by tabs if the map's name has spaces"
    )]
    Fields {
        /// The line, from 1.
        line: usize,
        /// Where the first wrong field begins or is missing, in bytes from 1.
        column: usize,
        /// The number of fields.
        found: usize,
    },
    /// A field has a wrong value.
    #[error(
        "line {line}, column {column}: expected {expected} as {field}, found {found}; mend or remove the line"
    )]
    Field {
        /// The line, from 1.
        line: usize,
        /// The column, in bytes from 1.
        column: usize,
        /// The name of the field.
        field: &'static str,
        /// The values that may stand there.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// An instance that a scenario file cannot hold.
    #[error(
        "instance {index}: expected {expected} as {field}, found {found}; change it before it is written"
    )]
    Unwritable {
        /// The instance, from 0.
        index: usize,
        /// The name of the field.
        field: &'static str,
        /// The values that may be written.
        expected: &'static str,
        /// The value.
        found: String,
    },
}

/// A scenario whose map has other sizes than the map at hand.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "instance {index} of the scenario: expected the map `{expected}` of {}, found `{found}` of {}; \
     take the scenario that was made for this map",
    Sides(*expected_sides), Sides(*found_sides)
)]
pub struct ScenarioForOtherMap {
    /// The instance, from 0.
    pub index: usize,
    /// The map that the scenario names.
    pub expected: String,
    /// Its width and height, as the scenario says.
    pub expected_sides: (u32, u32),
    /// The map at hand.
    pub found: String,
    /// Its width and height.
    pub found_sides: (u32, u32),
}

struct Sides((u32, u32));

impl fmt::Display for Sides {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} × {} cells", self.0.0, self.0.1)
    }
}

const MAP_NAMES: &str = "a UTF-8 name without control characters and without spaces around it";
const LENGTHS: &str = "a length of 0 or more";
const COUNTS: &str = "a whole number from 0 to 4294967295";
const COORDINATES: &str = "a whole number from -2147483648 to 2147483647";

impl Scenario {
    /// Parses a scenario.
    ///
    /// # Errors
    /// [`ScenarioError`] says what is wrong and where.
    pub fn parse(bytes: &[u8]) -> Result<Self, ScenarioError> {
        Self::from_bytes(bytes.to_vec())
    }

    /// Parses a scenario and keeps the bytes, without a copy. Takes time and memory linear in their number.
    ///
    /// # Errors
    /// [`ScenarioError`] says what is wrong and where.
    pub fn from_bytes(text: Vec<u8>) -> Result<Self, ScenarioError> {
        let mut lines = Lines::new(&text);
        let first = lines.next().ok_or(ScenarioError::Empty)?;
        if !is_version(first.text) {
            return Err(ScenarioError::Version { found: quote_line(Some(first)) });
        }
        let mut instances: Vec<Instance> = Vec::new();
        for line in lines.filter(|line| !line.text.iter().all(|&byte| is_blank(byte))) {
            let instance = parse_instance(line, instances.last().map(|last| &last.map))?;
            instances.push(instance);
        }
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

    /// The scenario of a list of instances: version 1, separated by tabs, lengths with as many digits as their value needs.
    ///
    /// # Errors
    /// [`ScenarioError::Unwritable`] for a map's name or a length that would not be read back as it is.
    pub fn from_instances(instances: Vec<Instance>) -> Result<Self, ScenarioError> {
        let mut text = "version 1\n".to_owned();
        for (index, instance) in instances.iter().enumerate() {
            let Instance { bucket, map, width, height, start, goal, optimal } = instance;
            if !is_map_name(map) {
                let found = format!("{map:?}");
                return Err(ScenarioError::Unwritable { index, field: "map", expected: MAP_NAMES, found });
            }
            if !is_length(*optimal) {
                let (field, found) = ("optimal length", optimal.to_string());
                return Err(ScenarioError::Unwritable { index, field, expected: LENGTHS, found });
            }
            let Vertex { x: start_x, y: start_y } = start;
            let Vertex { x: goal_x, y: goal_y } = goal;
            text += &format!(
                "{bucket}\t{map}\t{width}\t{height}\t{start_x}\t{start_y}\t{goal_x}\t{goal_y}\t{optimal}\n"
            );
        }
        Ok(Self { text: text.into_bytes(), instances })
    }

    /// The queries, in the order of the file.
    #[must_use]
    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }

    /// Checks that every instance was made for a map of this grid's sizes; `name` is what an error calls it.
    ///
    /// Names are not compared, so that maps can be renamed; [`Instance::map_file_name`] allows a warning.
    ///
    /// # Errors
    /// [`ScenarioForOtherMap`] names both maps.
    pub fn for_map(&self, grid: &Grid, name: &str) -> Result<(), ScenarioForOtherMap> {
        self.for_sides((grid.width(), grid.height()), name)
    }

    /// [`for_map`](Self::for_map) by width and height, where no grid is at hand.
    ///
    /// # Errors
    /// [`ScenarioForOtherMap`] names both maps.
    pub fn for_sides(&self, sides: (u32, u32), name: &str) -> Result<(), ScenarioForOtherMap> {
        let other = |instance: &Instance| (instance.width, instance.height) != sides;
        match self.instances.iter().position(other) {
            None => Ok(()),
            Some(index) => {
                let Instance { map, width, height, .. } = &self.instances[index];
                let (expected, expected_sides) = (map.to_string(), (*width, *height));
                let found = name.to_owned();
                Err(ScenarioForOtherMap { index, expected, expected_sides, found, found_sides: sides })
            }
        }
    }

    /// The text of the file, byte for byte.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        &self.text
    }

    /// Writes the text of the file, byte for byte.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, mut out: impl io::Write) -> io::Result<()> {
        out.write_all(&self.text)
    }
}

/// Whether this is the first line of a scenario.
fn is_version(line: &[u8]) -> bool {
    let mut words = words(line).map(|(_, word)| word);
    words.next() == Some(b"version") && matches!(words.next(), Some(b"1" | b"1.0")) && words.next().is_none()
}

/// A length can be neither negative nor infinite; −0 is refused as well.
fn is_length(length: f64) -> bool {
    length.is_finite() && length.is_sign_positive()
}

/// What a tab-separated line can hold and give back.
fn is_map_name(name: &str) -> bool {
    !name.is_empty() && name.trim_matches(' ') == name && !name.contains(char::is_control)
}

/// One line. The name of the map is shared with the line before where both are the same.
fn parse_instance(line: Line<'_>, last: Option<&Arc<str>>) -> Result<Instance, ScenarioError> {
    let mut fields = Fields::of(line)?;
    let bucket = fields.number("bucket", COUNTS)?;
    let map = fields.next("map", MAP_NAMES, |name| Some(name).filter(|name| is_map_name(name)))?;
    let map = last.filter(|last| ***last == *map).map_or_else(|| Arc::from(map), Arc::clone);
    let (width, height) = (fields.number("width", COUNTS)?, fields.number("height", COUNTS)?);
    let start = Vertex::new(fields.number("start x", COORDINATES)?, fields.number("start y", COORDINATES)?);
    let goal = Vertex::new(fields.number("goal x", COORDINATES)?, fields.number("goal y", COORDINATES)?);
    let length = |word: &str| word.parse().ok().filter(|&length| is_length(length));
    let optimal = fields.next("optimal length", LENGTHS, length)?;
    Ok(Instance { bucket, map, width, height, start, goal, optimal })
}

/// The fields of a line, taken from left to right.
struct Fields<'a> {
    line: usize,
    /// Columns from 1, and what stands there.
    fields: [(usize, &'a [u8]); 9],
    taken: usize,
}

impl<'a> Fields<'a> {
    fn of(line: Line<'a>) -> Result<Self, ScenarioError> {
        let text = line.text.trim_ascii_end();
        if text.contains(&b'\t') {
            Self::collect(line.number, text, cells(text))
        } else {
            Self::collect(line.number, text, words(text))
        }
    }

    /// Counts all fields, and keeps the first nine.
    fn collect(
        line: usize,
        text: &[u8],
        all: impl Iterator<Item = (usize, &'a [u8])>,
    ) -> Result<Self, ScenarioError> {
        let mut fields = [(0, &b""[..]); 9];
        let (mut found, mut tenth) = (0, 0);
        for (column, field) in all {
            if found < fields.len() {
                fields[found] = (column, field);
            } else if found == fields.len() {
                tenth = column;
            }
            found += 1;
        }
        let column = if found < fields.len() { text.len() + 1 } else { tenth };
        if found == fields.len() {
            Ok(Self { line, fields, taken: 0 })
        } else {
            Err(ScenarioError::Fields { line, column, found })
        }
    }

    /// The next field, by a reading that accepts its text or does not.
    fn next<T>(
        &mut self,
        field: &'static str,
        expected: &'static str,
        read: impl FnOnce(&'a str) -> Option<T>,
    ) -> Result<T, ScenarioError> {
        let (column, bytes) = self.fields[self.taken];
        self.taken += 1;
        std::str::from_utf8(bytes).ok().and_then(read).ok_or_else(|| {
            let found = quote(bytes);
            ScenarioError::Field { line: self.line, column, field, expected, found }
        })
    }

    fn number<T: FromStr>(
        &mut self,
        field: &'static str,
        expected: &'static str,
    ) -> Result<T, ScenarioError> {
        self.next(field, expected, |word| word.parse().ok())
    }
}

/// The fields of a line that tabs separate, without the spaces around them, each with its column from 1.
fn cells(text: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut column = 1;
    text.split(|&byte| byte == b'\t').map(move |cell| {
        let start = column + cell.len() - cell.trim_ascii_start().len();
        column += cell.len() + 1;
        (start, cell.trim_ascii())
    })
}
