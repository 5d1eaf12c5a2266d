//! Text for people: made harmless, and wrapped.

/// Text with its control characters escaped, since a file's name may hold escape sequences that a terminal
/// obeys.
pub(crate) fn printable(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() { shown.extend(c.escape_default()) } else { shown.push(c) }
    }
    shown
}

/// Words on as many lines as they need. The first line begins with `first`, each other with as many spaces.
pub(crate) fn wrap(first: &str, words: impl IntoIterator<Item = String>, columns: usize) -> String {
    let indent = " ".repeat(first.chars().count());
    let (mut text, mut used, mut fresh) = (first.to_owned(), first.chars().count(), true);
    for word in words {
        let length = word.chars().count();
        if !fresh && used + 1 + length > columns {
            text += "\n";
            text += &indent;
            (used, fresh) = (indent.len(), true);
        }
        if !fresh {
            text += " ";
            used += 1;
        }
        text += &word;
        used += length;
        fresh = false;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_control_characters_are_escaped() {
        assert_eq!(printable("\u{1b}[31mé\r\n\u{9b}`\\'"), r"\u{1b}[31mé\r\n\u{9b}`\'");
    }

    #[test]
    fn words_are_wrapped_and_indented() {
        let words = ["aa", "bb", "cc", "dddddddddd"].map(str::to_owned);
        assert_eq!(wrap("x: ", words, 8), "x: aa bb\n   cc\n   dddddddddd");
    }
}
