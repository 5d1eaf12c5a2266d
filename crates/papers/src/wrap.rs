//! Lines of Markdown that are not too long to read as text.

/// The most characters of a line of prose.
const COLUMNS: usize = 110;

/// Breaks the paragraphs, quotes and list items of a page; tables, headings, figures and code stay as they
/// are.
pub(crate) fn wrapped(page: &str) -> String {
    let mut text = String::new();
    let mut code = false;
    for line in page.lines() {
        let fence = line.starts_with("```");
        code ^= fence;
        if code || fence || line.starts_with(['|', '#', '!']) {
            text.push_str(line);
        } else {
            wrap(line, &mut text);
        }
        text.push('\n');
    }
    text
}

fn wrap(line: &str, text: &mut String) {
    let indent = indent(line);
    let mut columns = 0;
    for (at, word) in line.split(' ').enumerate() {
        let length = word.chars().count();
        // Together with what must not begin a line.
        let follows = line.split(' ').skip(at + 1).take_while(|word| begins_a_block(word));
        let together = follows.fold(length, |sum, word| sum + 1 + word.chars().count());
        if at > 0 && columns + 1 + together > COLUMNS && !begins_a_block(word) {
            text.push('\n');
            text.push_str(&indent);
            columns = indent.chars().count();
        } else if at > 0 {
            text.push(' ');
            columns += 1;
        }
        text.push_str(word);
        columns += length;
    }
}

/// The indent of further lines of a quote or list item.
fn indent(line: &str) -> String {
    let first = line.split(' ').next().unwrap_or_default();
    match first {
        ">" => "> ".to_owned(),
        "-" => "  ".to_owned(),
        number if is_list_number(number) => " ".repeat(number.len() + 1),
        _ => String::new(),
    }
}

fn is_list_number(word: &str) -> bool {
    word.strip_suffix(['.', ')']).is_some_and(|number| number.parse::<u32>().is_ok())
}

/// Whether a word would make a list, heading, quote or table of a line that begins with it.
fn begins_a_block(word: &str) -> bool {
    matches!(word, "-" | "+" | "*") || word.starts_with(['#', '>', '|', '=', '!']) || is_list_number(word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prose_is_wrapped_and_nothing_else() {
        let long = "word ".repeat(30);
        let long = long.trim_end();
        let (first, rest) = (["word"; 22].join(" "), ["word"; 8].join(" "));
        assert_eq!(wrapped(&format!("{long}\n\n{long}\n")), format!("{first}\n{rest}\n\n{first}\n{rest}\n"));
        for same in [format!("| {long} |\n"), format!("# {long}\n"), format!("```sh\n{long}\n```\n")] {
            assert_eq!(wrapped(&same), same);
        }
        let (first, rest) = (["word"; 21].join(" "), ["word"; 9].join(" "));
        for (mark, indent) in [(">", "> "), ("-", "  "), ("12.", "    ")] {
            assert_eq!(wrapped(&format!("{mark} {long}\n")), format!("{mark} {first}\n{indent}{rest}\n"));
        }
    }

    #[test]
    fn no_line_begins_with_a_sign_of_its_own() {
        let line = format!("{} A* + MD, and 7. on", "x".repeat(107));
        assert_eq!(wrapped(&line), format!("{}\nA* + MD, and 7. on\n", "x".repeat(107)));
        let line = format!("{} and 7. on", "x".repeat(105));
        assert_eq!(wrapped(&line), format!("{}\nand 7. on\n", "x".repeat(105)));
    }
}
