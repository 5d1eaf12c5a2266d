//! The part of YAML that the files of ROS maps use: one mapping, of keys at the start of lines, all indented
//! alike, or in braces.
//!
//! A value is a plain or quoted scalar, or a list of these, `[a, b]` or a line each after `- `. The lines
//! that follow a key and are indented, or begin with `-`, belong to its value. Comments, `---` before the
//! keys, `...` after them and directives are read past. All else is an error, except in the value of a key
//! that nobody asks for, which is not looked at.

use super::{
    RosError, flow,
    yaml::{RESERVED, YamlEntry, is_blank, skip_blank, take_scalar},
};
use crate::text::{Line, Lines, quote};

/// The `wanted` keys of a file, in their order, and the number of its lines. Others are not kept: a file may
/// have very many.
pub(super) fn entries(
    bytes: &[u8],
    wanted: impl Fn(&str) -> bool,
) -> Result<(Vec<YamlEntry<'_>>, usize), RosError> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        RosError::NoText { line: before.iter().filter(|&&byte| byte == b'\n').count() + 1 }
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if let Some((before, inner)) = braces(text) {
        return flow::entries(before, inner, wanted);
    }
    let mut indent: Option<usize> = None;
    // Of the last key, whether it is wanted and where its value begins.
    let mut last: Option<(bool, usize)> = None;
    let mut entries: Vec<YamlEntry<'_>> = Vec::new();
    let mut lines = Lines::new(text.as_bytes());
    for line in lines.by_ref() {
        let whole = &text[line.start..line.start + line.text.len()];
        let own = whole.len() - whole.trim_start_matches(' ').len();
        let is_mark = is_blank(whole) || matches!(role(whole), Role::Directive | Role::End);
        // The first key says how far all are indented.
        let indent = if is_mark { 0 } else { *indent.get_or_insert(own) };
        if own < indent {
            return Err(line_error(line));
        }
        let (content, start_of_content) = (&whole[indent..], line.start + indent);
        match role(content) {
            Role::Blank => {}
            Role::Directive if last.is_none() => {}
            Role::End => break,
            Role::Continuation => {
                let (kept, start) = last.ok_or_else(|| line_error(line))?;
                if let Some(entry) = entries.last_mut().filter(|_| kept) {
                    entry.value = &text[start..start_of_content + content.len()];
                }
            }
            Role::Key => {
                let (key, value) = split_key(content).ok_or_else(|| line_error(line))?;
                last = Some((wanted(&key), start_of_content + content.len() - value.len()));
                if wanted(&key) {
                    entries.push(YamlEntry { line: line.number, key, value });
                }
            }
            Role::Directive => return Err(line_error(line)),
        }
    }
    Ok((entries, lines.number()))
}

/// The text before the braces of a mapping in braces, with it, and what follows.
fn braces(text: &str) -> Option<(usize, &str)> {
    let mut rest = text;
    loop {
        rest = skip_blank(rest);
        let line = rest.lines().next()?;
        if let Some(inner) = rest.strip_prefix('{') {
            let before = &text[..text.len() - inner.len()];
            return Some((before.matches('\n').count() + 1, inner));
        }
        rest = match line.strip_prefix("---") {
            // The mapping may follow on the same line.
            Some(after) if after.is_empty() || after.starts_with([' ', '\t']) => &rest[3..],
            _ if line.starts_with('%') => &rest[line.len()..],
            _ => return None,
        };
    }
}

fn line_error(line: Line<'_>) -> RosError {
    RosError::Line { line: line.number, found: quote(line.text) }
}

enum Role {
    Blank,
    /// `---`, or a line that begins with `%`.
    Directive,
    End,
    Continuation,
    Key,
}

fn role(line: &str) -> Role {
    let marks = |mark: &str| line.strip_prefix(mark).is_some_and(is_blank);
    if is_blank(line) {
        Role::Blank
    } else if marks("---") || line.starts_with('%') {
        Role::Directive
    } else if marks("...") {
        Role::End
    } else if line.starts_with([' ', '\t', ']', '}']) || line == "-" || line.starts_with("- ") {
        Role::Continuation
    } else {
        Role::Key
    }
}

/// A key and the text after its colon.
fn split_key(line: &str) -> Option<(String, &str)> {
    if line.starts_with(['"', '\'']) {
        let (key, rest) = take_scalar(line, false)?;
        return Some((key, after_colon(rest.trim_start())?));
    }
    let (key, rest) = line.match_indices(':').find_map(|(at, _)| {
        let rest = after_colon(&line[at..])?;
        Some((&line[..at], rest))
    })?;
    let plain = !key.contains(" #") && !key.starts_with(RESERVED);
    plain.then(|| (key.trim_end().to_owned(), rest))
}

/// The text after a colon that ends a key.
fn after_colon(text: &str) -> Option<&str> {
    let rest = text.strip_prefix(':')?;
    (rest.is_empty() || rest.starts_with([' ', '\t'])).then_some(rest)
}
