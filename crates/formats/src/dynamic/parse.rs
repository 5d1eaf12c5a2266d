//! Parses the text of a scenario of a map that changes.

use std::{str::FromStr, sync::Arc};

use mediant_grid::{Grid, Rectangle, Vertex};

use super::{DynamicEvent, DynamicQuery, Optimal, Patch, PlacedPatch, error::DynamicError};
use crate::{
    scenario::parse::{COORDINATES, COUNTS},
    text::{Line, Lines, decimal, quote, quote_line, words},
};

/// The cost that is the length of a path.
const OCTILE: &[u8] = b"octile";

/// The header of a scenario, and the lines after it.
pub(super) struct Header<'a> {
    pub(super) size: (u32, u32),
    pub(super) patch_file: String,
    /// The number of costs of each query.
    costs: usize,
    /// Which of them is the length.
    octile: Option<usize>,
    lines: Lines<'a>,
}

/// Whether a text begins with the line `version 2`.
pub(crate) fn is_dynamic(text: &[u8]) -> bool {
    Lines::new(text).next().is_some_and(|line| is_version_2(line.text))
}

fn is_version_2(line: &[u8]) -> bool {
    let mut words = words(line).map(|(_, word)| word);
    words.next() == Some(b"version") && matches!(words.next(), Some(b"2" | b"2.0")) && words.next().is_none()
}

/// Parses the header.
pub(super) fn header(text: &[u8]) -> Result<Header<'_>, DynamicError> {
    let mut lines = Lines::new(text);
    let first = lines.next();
    if !first.is_some_and(|line| is_version_2(line.text)) {
        let found = quote_line(first);
        return Err(DynamicError::Header { line: 1, expected: "`version 2`".to_owned(), found });
    }
    let (mut width, mut height, mut costs, mut patch_file) = (None, None, None, None);
    loop {
        let line = lines.find(|line| !line.is_blank());
        let text = line.map_or(&b""[..], |line| line.text);
        match (line, words(text).next()) {
            (Some(line), Some((_, b"height"))) if height.is_none() => height = Some(side(line, "height")?),
            (Some(line), Some((_, b"width"))) if width.is_none() => width = Some(side(line, "width")?),
            (Some(line), Some((_, b"cost"))) if costs.is_none() => costs = Some(cost_names(line)?),
            (Some(line), Some((_, b"patch"))) if patch_file.is_none() => {
                patch_file = Some(file_name(line)?);
            }
            (Some(_), Some((_, b"commands")))
                if width.is_some() && height.is_some() && patch_file.is_some() =>
            {
                break;
            }
            _ => {
                let missing = [
                    (height.is_none(), "`height N`"),
                    (width.is_none(), "`width N`"),
                    (patch_file.is_none(), "`patch FILE`"),
                ];
                let missing: Vec<&str> =
                    missing.into_iter().filter(|(is_missing, _)| *is_missing).map(|(_, name)| name).collect();
                let expected =
                    if missing.is_empty() { "`commands`".to_owned() } else { missing.join(" or ") };
                let number = line.map_or(lines.number() + 1, |line| line.number);
                return Err(DynamicError::Header { line: number, expected, found: quote_line(line) });
            }
        }
    }
    let (costs, octile) = costs.unwrap_or((0, None));
    let size = (width.unwrap_or(1), height.unwrap_or(1));
    Ok(Header { size, patch_file: patch_file.unwrap_or_default(), costs, octile, lines })
}

/// The number in a line `height N` or `width N`.
fn side(line: Line<'_>, field: &'static str) -> Result<u32, DynamicError> {
    let mut words = Words::of(line);
    let side = words.next(field, "a number of cells from 1 to 32768", |word| {
        word.parse().ok().filter(|&cells| Grid::check_size(u64::from(cells), 1).is_ok())
    })?;
    words.end(side, || format!("`{field} N`"))
}

/// The number of costs in a line `cost N NAMES`, and which of them is the length.
fn cost_names(line: Line<'_>) -> Result<(usize, Option<usize>), DynamicError> {
    let mut words = Words::of(line);
    let count: usize = words.next("number of costs", COUNTS, |word| word.parse().ok())?;
    let names: Vec<&[u8]> = words.rest.by_ref().map(|(_, word)| word).collect();
    if names.len() != count {
        let expected = format!("`cost {} NAMES` for the {0} names in it", names.len());
        return Err(DynamicError::Header { line: line.number, expected, found: quote(line.text) });
    }
    Ok((count, names.iter().position(|&name| name == OCTILE)))
}

/// The name in a line `patch FILE`, which may have spaces in it.
fn file_name(line: Line<'_>) -> Result<String, DynamicError> {
    let name = line.text.trim_ascii().get(b"patch".len()..).unwrap_or_default().trim_ascii();
    let name =
        std::str::from_utf8(name).ok().filter(|name| !name.is_empty() && !name.contains(char::is_control));
    let wrong = || DynamicError::Header {
        line: line.number,
        expected: "`patch FILE` with a name in UTF-8".to_owned(),
        found: quote(line.text),
    };
    name.map(str::to_owned).ok_or_else(wrong)
}

/// Parses the lines after the header.
pub(super) fn events(header: Header<'_>, patches: &[Arc<Patch>]) -> Result<Vec<DynamicEvent>, DynamicError> {
    let Header { size, costs, octile, lines, .. } = header;
    let form = move || match costs {
        1 => "one cost".to_owned(),
        _ => format!("{costs} costs"),
    };
    let wrong =
        |line: Line<'_>| DynamicError::Command { line: line.number, costs: form(), found: quote(line.text) };
    let mut events = Vec::new();
    for line in lines.filter(|line| !line.is_blank()) {
        let count = words(line.text).count();
        let mut fields = Words::of(line);
        match words(line.text).next() {
            Some((_, b"P")) if count == 5 => {
                events.push(DynamicEvent::Patch(patch(&mut fields, patches, size)?));
            }
            // One word is the letter; no file has so many costs that this overflows.
            Some((_, b"Q")) if count.checked_sub(6) == Some(costs) => {
                events.push(DynamicEvent::Query(query(&mut fields, costs, octile)?));
            }
            _ => return Err(wrong(line)),
        }
    }
    Ok(events)
}

/// Parses a line `P bucket patch x y`.
fn patch(
    words: &mut Words<'_>,
    patches: &[Arc<Patch>],
    size: (u32, u32),
) -> Result<PlacedPatch, DynamicError> {
    let _bucket: u32 = words.number("bucket", COUNTS)?;
    let number: u32 = words.number("patch", COUNTS)?;
    let (line, column) = (words.line, words.column);
    let Some(patch) = patches.get(number as usize) else {
        return Err(DynamicError::NoPatch { line, column, found: number as usize, patches: patches.len() });
    };
    let x: u32 = words.number("x", COUNTS)?;
    let column = words.column;
    let y: u32 = words.number("y", COUNTS)?;
    let fits = |at: u32, cells: u32, side: u32| u64::from(at) + u64::from(cells) <= u64::from(side);
    if !(fits(x, patch.width(), size.0) && fits(y, patch.height(), size.1)) {
        let at = Rectangle::new(x, y, patch.width(), patch.height());
        return Err(DynamicError::OutsideMap { line, column, at, size });
    }
    Ok(PlacedPatch { patch: Arc::clone(patch), x, y })
}

/// Parses a line `Q bucket x y x y costs…`.
fn query(words: &mut Words<'_>, costs: usize, octile: Option<usize>) -> Result<DynamicQuery, DynamicError> {
    let bucket = words.number("bucket", COUNTS)?;
    let start = Vertex::new(words.number("start x", COORDINATES)?, words.number("start y", COORDINATES)?);
    let goal = Vertex::new(words.number("goal x", COORDINATES)?, words.number("goal y", COORDINATES)?);
    let mut optimal = Optimal::Unknown;
    for cost in 0..costs {
        if octile == Some(cost) {
            optimal =
                words.next(
                    "octile cost",
                    "a length of 0 or more, or -1 for no path",
                    |word| match decimal(word)? {
                        -1.0 => Some(Optimal::NoPath),
                        length => length.is_sign_positive().then_some(Optimal::Length(length)),
                    },
                )?;
        } else {
            words.next("cost", "a number", decimal)?;
        }
    }
    Ok(DynamicQuery { bucket, start, goal, optimal })
}

/// The words of a line after its first, taken from left to right.
struct Words<'a> {
    line: usize,
    /// The column of the word that was taken last, from 1.
    column: usize,
    text: &'a [u8],
    rest: Box<dyn Iterator<Item = (usize, &'a [u8])> + 'a>,
}

impl<'a> Words<'a> {
    fn of(line: Line<'a>) -> Self {
        Self { line: line.number, column: 1, text: line.text, rest: Box::new(words(line.text).skip(1)) }
    }

    /// The next word as a value; `read` returns `None` for a text that is no such value.
    fn next<T>(
        &mut self,
        field: &'static str,
        expected: &'static str,
        read: impl FnOnce(&'a str) -> Option<T>,
    ) -> Result<T, DynamicError> {
        let (column, word) = self.rest.next().unwrap_or((self.text.len() + 1, b""));
        self.column = column;
        std::str::from_utf8(word).ok().and_then(read).ok_or_else(|| {
            let found = quote(word);
            DynamicError::Field { line: self.line, column, field, expected, found }
        })
    }

    fn number<T: FromStr>(&mut self, field: &'static str, expected: &'static str) -> Result<T, DynamicError> {
        self.next(field, expected, |word| word.parse().ok())
    }

    /// The value, if no word is left.
    fn end<T>(mut self, value: T, expected: impl FnOnce() -> String) -> Result<T, DynamicError> {
        match self.rest.next() {
            None => Ok(value),
            Some(_) => {
                Err(DynamicError::Header { line: self.line, expected: expected(), found: quote(self.text) })
            }
        }
    }
}
