//! Parses the text of a scenario.

use std::{str::FromStr, sync::Arc};

use mediant_grid::Vertex;

use super::{
    error::ScenarioError,
    instance::{Instance, LENGTHS, MAP_NAMES, is_length, is_map_name},
};
use crate::dynamic::parse::is_dynamic;
use crate::text::{Line, Lines, quote, quote_line, words};

pub(crate) const COUNTS: &str = "a whole number from 0 to 4294967295";
pub(crate) const COORDINATES: &str = "a whole number from -2147483648 to 2147483647";

/// The queries of a scenario, in the order of its lines.
pub(super) fn instances(text: &[u8]) -> Result<Vec<Instance>, ScenarioError> {
    let mut lines = Lines::new(text);
    let first = lines.next().ok_or(ScenarioError::Empty)?;
    if is_dynamic(text) {
        return Err(ScenarioError::Dynamic);
    }
    if !is_version(first.text) {
        return Err(ScenarioError::Version { found: quote_line(Some(first)) });
    }
    let mut instances: Vec<Instance> = Vec::new();
    for line in lines.filter(|line| !line.is_blank()) {
        let instance = parse_instance(line, instances.last().map(|last| &last.map))?;
        instances.push(instance);
    }
    Ok(instances)
}

/// Whether this line is one with which a scenario begins.
fn is_version(line: &[u8]) -> bool {
    let mut words = words(line).map(|(_, word)| word);
    words.next() == Some(b"version") && matches!(words.next(), Some(b"1" | b"1.0")) && words.next().is_none()
}

/// Parses a line. `last` is the map of the line before: a line with the same name shares it.
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
    /// The column of each field, from 1, and its text.
    fields: [(usize, &'a [u8]); 9],
    taken: usize,
}

impl<'a> Fields<'a> {
    fn of(line: Line<'a>) -> Result<Self, ScenarioError> {
        let text = line.text.trim_ascii_end();
        if text.contains(&b'\t') {
            Self::collect(line.number, text, tab_fields(text))
        } else {
            Self::collect(line.number, text, words(text))
        }
    }

    /// Keeps the first nine fields, and counts all for the error message.
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

    /// The next field as a value; `read` returns `None` for a text that is no such value.
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

/// The fields of a line that are separated by tabs, without the spaces around them, each with its column from
/// 1.
fn tab_fields(text: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut column = 1;
    text.split(|&byte| byte == b'\t').map(move |field| {
        let start = column + field.len() - field.trim_ascii_start().len();
        column += field.len() + 1;
        (start, field.trim_ascii())
    })
}
