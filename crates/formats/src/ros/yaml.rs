//! The parts of YAML mappings: keys with values, scalars, and lists of scalars.

/// A key with its value, which is still text.
pub(super) struct YamlEntry<'a> {
    pub(super) line: usize,
    pub(super) key: String,
    pub(super) value: &'a str,
}

/// Whether there is nothing but white space and comments.
pub(super) fn is_blank(text: &str) -> bool {
    skip_blank(text).is_empty()
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
pub(super) const RESERVED: [char; 16] =
    ['[', ']', '{', '}', ',', '&', '*', '!', '|', '>', '%', '@', '`', '#', '?', ':'];

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
