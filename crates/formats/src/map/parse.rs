//! Parses the text of a map.

use mediant_grid::{Grid, Interrupt};

use super::{Tiles, error::MapError};
use crate::{
    foreign,
    text::{Line, Lines, quote, quote_line, words},
};

/// The width and the height that the header states.
pub(super) fn size(text: &[u8]) -> Result<(u32, u32), MapError> {
    if text.is_empty() {
        return Err(MapError::Empty);
    }
    parse_header(&mut Lines::new(text))
}

/// The width of a map, and where each of its rows begins in the text.
pub(super) fn map(text: &[u8], tiles: &Tiles, interrupt: &Interrupt) -> Result<(u32, Vec<usize>), MapError> {
    if text.is_empty() {
        return Err(MapError::Empty);
    }
    let mut lines = Lines::new(text);
    let (width, height) = parse_header(&mut lines)?;
    Ok((width, parse_rows(&mut lines, (width, height), tiles, interrupt)?))
}

/// The width and the height that the header states.
fn parse_header(lines: &mut Lines<'_>) -> Result<(u32, u32), MapError> {
    if let Some(found) = foreign::kind(lines.bytes()) {
        let found = found.to_owned();
        return Err(MapError::Header { line: 1, expected: "`type octile`", found });
    }
    check_line(lines, &[b"type", b"octile"], "`type octile`")?;
    sides(lines)
}

/// The width and the height in the lines above the rows, with the line `map`.
pub(crate) fn sides(lines: &mut Lines<'_>) -> Result<(u32, u32), MapError> {
    let (mut width, mut height) = (None, None);
    let sides = loop {
        let expected = match (width, height) {
            (Some(width), Some(height)) => break (width, height),
            (None, None) => "`height N` or `width N`",
            (Some(_), None) => "`height N`",
            (None, Some(_)) => "`width N`",
        };
        let line = next_filled(lines);
        let text = line.map_or(&b""[..], |line| line.text);
        let (side, value) = match words(text).next() {
            Some((_, b"height")) if height.is_none() => ("height", &mut height),
            Some((_, b"width")) if width.is_none() => ("width", &mut width),
            _ => return Err(header_error(lines, line, expected)),
        };
        *value = Some(parse_side(lines.number(), text, side)?);
    };
    check_line(lines, &[b"map"], "`map`")?;
    Ok(sides)
}

/// Takes a line of exactly the `expected` words, which an error message calls `name`.
fn check_line(lines: &mut Lines<'_>, expected: &[&[u8]], name: &'static str) -> Result<(), MapError> {
    let line = next_filled(lines);
    let found = words(line.map_or(b"", |line| line.text)).map(|(_, word)| word);
    if found.eq(expected.iter().copied()) { Ok(()) } else { Err(header_error(lines, line, name)) }
}

/// The next line that is not empty.
fn next_filled<'a>(lines: &mut Lines<'a>) -> Option<Line<'a>> {
    lines.find(|line| !line.is_blank())
}

fn header_error(lines: &Lines<'_>, line: Option<Line<'_>>, expected: &'static str) -> MapError {
    let number = line.map_or(lines.number() + 1, |line| line.number);
    MapError::Header { line: number, expected, found: quote_line(line) }
}

/// The number in a line `height N` or `width N`.
fn parse_side(line: usize, text: &[u8], side: &'static str) -> Result<u32, MapError> {
    let mut words = words(text).skip(1);
    let (column, word) = words.next().unwrap_or((text.len() + 1, b""));
    let cells = std::str::from_utf8(word).ok().and_then(|word| word.parse::<u32>().ok());
    let Some(cells) = cells.filter(|&cells| Grid::check_size(u64::from(cells), 1).is_ok()) else {
        return Err(MapError::Side { line, column, side, found: quote(word) });
    };
    match words.next() {
        None => Ok(cells),
        Some((column, word)) => {
            Err(MapError::Side { line, column, side, found: format!("also {}", quote(word)) })
        }
    }
}

/// Where each row begins, in a file that ends with the last.
fn parse_rows(
    lines: &mut Lines<'_>,
    (width, height): (u32, u32),
    tiles: &Tiles,
    interrupt: &Interrupt,
) -> Result<Vec<usize>, MapError> {
    let rows = take_rows(lines, (width, height), tiles, interrupt)?;
    match lines.find(|line| !line.is_blank()) {
        None => Ok(rows),
        Some(line) => Err(MapError::ManyRows { line: line.number, height, found: quote(line.text) }),
    }
}

/// Where each row begins. The list grows with the rows that the file has, not with the height that it states.
pub(crate) fn take_rows(
    lines: &mut Lines<'_>,
    (width, height): (u32, u32),
    tiles: &Tiles,
    interrupt: &Interrupt,
) -> Result<Vec<usize>, MapError> {
    let (mut rows, table) = (Vec::new(), tiles.table());
    let known = |tile: u8| table[usize::from(tile)].is_some();
    while rows.len() < height as usize {
        interrupt.check("reading the map")?;
        let Some(line) = lines.next() else {
            let line = lines.number() + 1;
            return Err(MapError::FewRows { line, row: rows.len() + 1, height });
        };
        check_row(line, width, known, tiles)?;
        rows.push(line.start);
    }
    Ok(rows)
}

/// Checks that a row has `width` tiles; an error names the first column that is wrong.
fn check_row(line: Line<'_>, width: u32, known: impl Fn(u8) -> bool, tiles: &Tiles) -> Result<(), MapError> {
    let expected = width as usize;
    let (row, rest) = line.text.split_at(line.text.len().min(expected));
    let spaces = rest.iter().rev().take_while(|byte| byte.is_ascii_whitespace()).count();
    let unknown = row.iter().position(|&tile| !known(tile));
    // A row may end in spaces because cells are missing.
    let found = row.trim_ascii_end().len();
    match unknown {
        Some(at) if at < found => {
            let (line, column, found) = (line.number, at + 1, quote(&row[at..=at]));
            return Err(match row[at].is_ascii_graphic() || row[at] == b' ' {
                true => MapError::Unknown { line, column, found, tiles: tiles.clone() },
                false => MapError::Tile { line, column, found },
            });
        }
        None if row.len() == expected => {}
        _ => {
            let found = if unknown.is_some() { found } else { row.len() };
            return Err(MapError::ShortRow { line: line.number, column: found + 1, expected: width, found });
        }
    }
    match rest.len() - spaces {
        0 => Ok(()),
        found => Err(MapError::LongRow { line: line.number, column: expected + 1, expected: width, found }),
    }
}
