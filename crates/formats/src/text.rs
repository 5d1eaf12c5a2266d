//! Splits a text into numbered lines and words, and quotes them in error messages.

/// One line, without its line end.
#[derive(Clone, Copy)]
pub(crate) struct Line<'a> {
    /// The number of the line, from 1.
    pub(crate) number: usize,
    /// The offset in the file at which the line begins.
    pub(crate) start: usize,
    pub(crate) text: &'a [u8],
}

impl Line<'_> {
    /// Whether the line has nothing but spaces and tabs.
    pub(crate) fn is_blank(self) -> bool {
        self.text.iter().all(|&byte| is_blank(byte))
    }
}

/// The lines of a file that end in LF or CRLF; the last may end with the file.
pub(crate) struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    number: usize,
}

/// The byte order mark of UTF-8, which some editors write before a text.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

impl<'a> Lines<'a> {
    /// The lines after the byte order mark, if there is one.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        let at = if bytes.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len() } else { 0 };
        Self { bytes, at, number: 0 }
    }

    /// The whole text.
    pub(crate) const fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// The number of the last line that was taken.
    pub(crate) const fn number(&self) -> usize {
        self.number
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length = rest.iter().position(|&byte| byte == b'\n');
        let text = &rest[..length.unwrap_or(rest.len())];
        let line =
            Line { number: self.number + 1, start: self.at, text: text.strip_suffix(b"\r").unwrap_or(text) };
        self.at += length.map_or(rest.len(), |length| length + 1);
        self.number += 1;
        Some(line)
    }
}

/// The words of a line, separated by spaces and tabs, each with its column from 1.
pub(crate) fn words(text: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut column = 1;
    text.split(|&byte| is_blank(byte)).filter_map(move |word| {
        let at = column;
        column += word.len() + 1;
        (!word.is_empty()).then_some((at, word))
    })
}

const fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t')
}

/// Quotes bytes for an error message: shortened, on one line, printable.
pub(crate) fn quote(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    match bytes {
        [] => "nothing".to_owned(),
        _ if bytes.len() > LONGEST => format!("`{}…`", bytes[..LONGEST].escape_ascii()),
        _ => format!("`{}`", bytes.escape_ascii()),
    }
}

/// Quotes a line for an error message, or tells that there is none.
pub(crate) fn quote_line(line: Option<Line<'_>>) -> String {
    match line {
        None => "the end of the file".to_owned(),
        Some(Line { text: [], .. }) => "an empty line".to_owned(),
        Some(line) => quote(line.text),
    }
}

/// The finite number that a text of digits, sign, point and exponent stands for. Names such as `inf`, which
/// Rust reads too, are no numbers here.
pub(crate) fn decimal(text: &str) -> Option<f64> {
    let plain = text.bytes().all(|byte| byte.is_ascii_digit() || b"+-.eE".contains(&byte));
    text.parse().ok().filter(|number: &f64| plain && number.is_finite())
}
