//! The size of text, and its lines. The viewer chooses the font, so widths are estimates.

/// The font size of titles, in pixels. All sizes are those of the style sheet.
pub(super) const TITLE: f64 = 16.0;
/// The font size of most text.
pub(super) const TEXT: f64 = 12.0;
/// The distance between the base lines of that text.
pub(super) const LINE: f64 = 16.0;
/// The font size of the text beside points.
pub(super) const SMALL: f64 = 11.0;

/// The approximate width of a text in common sans-serif fonts.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let width = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' => 0.28,
        ' ' | 'f' | 't' | 'r' | 'I' | '(' | ')' | '[' | ']' | '/' | '-' | '⁻' => 0.36,
        'm' | 'w' | 'M' | 'W' | '@' | '%' | '…' => 0.9,
        '¹' | '²' | '³' | '⁰'..='⁹' => 0.38,
        c if c.is_uppercase() => 0.7,
        c if (c as u32) < 0x2e80 => 0.58,
        _ => 1.0,
    };
    size * text.chars().map(width).sum::<f64>()
}

/// The text in lines of at most this width, broken at spaces; a word that is wider than a line is broken too.
pub(super) fn wrap(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        let joined = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        if text_width(&joined, size) <= width {
            line = joined;
            continue;
        }
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        for c in word.chars() {
            line.push(c);
            if line.chars().count() > 1 && text_width(&line, size) > width {
                line.pop();
                lines.push(std::mem::replace(&mut line, c.to_string()));
            }
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}
