//! A mapping in braces, `{key: value, …}`, over as many lines as it likes.

use super::{
    RosError,
    yaml::{YamlEntry, is_blank, skip_blank, take_scalar},
};
use crate::text::quote;

/// The `wanted` keys of a mapping, and the number of the file's lines. `text` begins after the brace, which
/// is in line `line`.
pub(super) fn entries(
    line: usize,
    text: &str,
    wanted: impl Fn(&str) -> bool,
) -> Result<(Vec<YamlEntry<'_>>, usize), RosError> {
    let line_of = |rest: &str| line + text[..text.len() - rest.len()].matches('\n').count();
    let wrong = |rest: &str| {
        let found = rest.lines().next().unwrap_or_default();
        RosError::Line { line: line_of(rest), found: quote(found.as_bytes()) }
    };
    let mut entries = Vec::new();
    let mut rest = skip_blank(text);
    loop {
        if let Some(after) = rest.strip_prefix('}') {
            let after = skip_blank(after);
            let ends = is_blank(after) || after.lines().next().is_some_and(|line| line.trim_end() == "...");
            let lines = line_of("") - usize::from(text.ends_with('\n'));
            return if ends { Ok((entries, lines)) } else { Err(wrong(after)) };
        }
        let (key, after) = take_key(rest).ok_or_else(|| wrong(rest))?;
        let length = value_length(after).ok_or_else(|| wrong(rest))?;
        let (value, next) = after.split_at(length);
        if wanted(&key) {
            entries.push(YamlEntry { line: line_of(rest), key, value });
        }
        rest = skip_blank(next.strip_prefix(',').unwrap_or(next));
    }
}

/// A key and the text after its colon.
fn take_key(text: &str) -> Option<(String, &str)> {
    if text.starts_with(['"', '\'']) {
        // After a quoted key the colon needs no space.
        let (key, rest) = take_scalar(text, true)?;
        return Some((key, rest.trim_start().strip_prefix(':')?));
    }
    let colon = text.find([':', ',', '}', '{', '[', '\n'])?;
    let (key, rest) = (text[..colon].trim_end(), text[colon..].strip_prefix(':')?);
    let ends = rest.starts_with([' ', '\t', '\r', '\n', '"', '\'', '[']);
    (ends && !key.is_empty()).then(|| (key.to_owned(), rest))
}

/// The length of the value at the start of the text, up to the comma or brace after it; `None` if there is
/// no such.
fn value_length(text: &str) -> Option<usize> {
    // Until when a part is skipped: the quotation mark that ends it, or the end of the line of a comment.
    let (mut depth, mut until, mut before) = (0_u32, None, ' ');
    for (at, c) in text.char_indices() {
        let escaped = until == Some('"') && before == '\\';
        // Whether a scalar or a comment may begin here.
        let fresh = matches!(before, ' ' | '\t' | '\n' | '\r' | '[' | '{' | ',' | ':');
        match (until, c) {
            (Some(end), _) if c == end && !escaped => until = None,
            (Some(_), _) => {}
            (None, '"' | '\'') if fresh => until = Some(c),
            (None, '#') if fresh => until = Some('\n'),
            (None, '[' | '{') => depth += 1,
            (None, ',' | '}') if depth == 0 => return Some(at),
            (None, ']' | '}') => depth = depth.checked_sub(1)?,
            _ => {}
        }
        // Of two backslashes the second does not escape.
        before = if escaped { ' ' } else { c };
    }
    None
}
