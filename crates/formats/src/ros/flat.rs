//! The part of YAML that the files of ROS maps use: one mapping, of keys at the start of lines, all indented
//! alike, or in braces.
//!
//! A value is a plain or quoted scalar, or a list of these, `[a, b]` or a line each after `- `. The lines
//! that follow a key and are indented, or begin with `-`, belong to its value. Comments, `---` before the
//! keys, `...` after them and directives are read past. All else is an error, except in the value of a key
//! that nobody asks for, which is not looked at.

use super::{RosError, flow};
use crate::text::{Line, Lines, quote};

/// A key with its value, which is still text.
pub(super) struct YamlEntry<'a> {
    pub(super) line: usize,
    pub(super) key: String,
    pub(super) value: &'a str,
}

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

/// Whether there is nothing but white space and comments.
pub(super) fn is_blank(text: &str) -> bool {
    skip_blank(text).is_empty()
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

/// The value, if it is one scalar.
pub(super) fn scalar(value: &str) -> Option<String> {
    let (scalar, rest) = take_scalar(skip_blank(value), false)?;
    is_blank(rest).then_some(scalar)
}

/// The value, if it is a list of scalars.
pub(super) fn list(value: &str) -> Option<Vec<String>> {
    let mut items = Vec::new();
    let mut rest = skip_blank(value);
    if let Some(inner) = rest.strip_prefix('[') {
        rest = skip_blank(inner);
        while !rest.starts_with(']') {
            let (item, after) = take_scalar(rest, true)?;
            items.push(item);
            rest = skip_blank(after);
            match rest.strip_prefix(',') {
                Some(after) => rest = skip_blank(after),
                None if rest.starts_with(']') => {}
                None => return None,
            }
        }
        return is_blank(&rest[1..]).then_some(items);
    }
    while !rest.is_empty() {
        let item = rest.strip_prefix('-').filter(|item| item.starts_with([' ', '\t']))?;
        let (item, after) = take_scalar(item.trim_start_matches([' ', '\t']), false)?;
        items.push(item);
        rest = skip_blank(after);
    }
    (!items.is_empty()).then_some(items)
}

/// The text after white space, line ends and comments.
pub(super) fn skip_blank(text: &str) -> &str {
    let mut rest = text.trim_start();
    while rest.starts_with('#') {
        rest = rest.find('\n').map_or("", |end| rest[end..].trim_start());
    }
    rest
}

/// Characters that begin no plain scalar.
const RESERVED: [char; 16] = ['[', ']', '{', '}', ',', '&', '*', '!', '|', '>', '%', '@', '`', '#', '?', ':'];

/// A scalar at the start of the text, and what follows it. In a list in brackets, `flow`, a comma or a
/// bracket ends a plain one.
pub(super) fn take_scalar(text: &str, flow: bool) -> Option<(String, &str)> {
    let (scalar, rest) = match text.chars().next()? {
        '"' => take_double_quoted(&text[1..])?,
        '\'' => take_single_quoted(&text[1..])?,
        first if RESERVED.contains(&first) => return None,
        _ => {
            let ends_at = |(at, c): (usize, char)| {
                let comment = c == '#' && text[..at].ends_with([' ', '\t']);
                c == '\n' || comment || flow && matches!(c, ',' | ']' | '[' | '{' | '}')
            };
            let end = text.char_indices().find(|&at| ends_at(at)).map_or(text.len(), |(at, _)| at);
            let plain = text[..end].trim_end();
            let nested = plain.starts_with("- ") || plain.contains(": ") || plain.ends_with(':');
            if plain.is_empty() || plain == "-" || nested {
                return None;
            }
            return Some((plain.to_owned(), &text[end..]));
        }
    };
    let ends = rest.is_empty() || rest.starts_with([' ', '\t', '\r', '\n', ':']);
    (ends || flow && rest.starts_with([',', ']'])).then_some((scalar, rest))
}

/// A scalar after its first quotation mark; two of them stand for one.
fn take_single_quoted(mut text: &str) -> Option<(String, &str)> {
    let mut scalar = String::new();
    loop {
        let (part, rest) = text.split_once('\'')?;
        scalar.push_str(part);
        match rest.strip_prefix('\'') {
            Some(rest) => {
                scalar.push('\'');
                text = rest;
            }
            None => return (!scalar.contains('\n')).then_some((scalar, rest)),
        }
    }
}

/// A scalar after its first quotation mark, with the escapes that programs write for file names.
fn take_double_quoted(text: &str) -> Option<(String, &str)> {
    let mut scalar = String::new();
    let mut chars = text.chars();
    loop {
        match chars.next()? {
            '"' => return Some((scalar, chars.as_str())),
            '\n' => return None,
            '\\' => {
                let digits = match chars.next()? {
                    c @ ('"' | '\\' | '/' | ' ') => {
                        scalar.push(c);
                        continue;
                    }
                    'x' => 2,
                    'u' => 4,
                    'U' => 8,
                    _ => return None,
                };
                let mut code = 0_u32;
                for _ in 0..digits {
                    code = code.checked_mul(16)?.checked_add(chars.next()?.to_digit(16)?)?;
                }
                scalar.push(char::from_u32(code)?);
            }
            c => scalar.push(c),
        }
    }
}

/// A scalar that is read back as this text.
pub(super) fn quoted(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-/".contains(c);
    // A number or a word such as `true` would be a text here, but not to other readers.
    let named = text.starts_with(|c: char| c.is_ascii_alphabetic()) && text.contains(['.', '/']);
    if named && text.chars().all(plain) {
        return text.to_owned();
    }
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() || c == '\u{feff}' => quoted.push_str(&format!("\\U{:08x}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}
