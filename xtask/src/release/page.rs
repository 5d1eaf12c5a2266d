//! The first example of a page of the guide.

use std::fs;

use mediant_sets::root;

use crate::Error;

/// The heading that every page about a world has.
const HEADING: &str = "## The first path";

/// The first block in a language below [`HEADING`] on a page, without its fences.
///
/// # Errors
/// [`Error::Lacking`] for a page without one, [`Error::Io`] if there is no such page.
pub(super) fn first_block(page: &str, language: &str) -> Result<String, Error> {
    let path = root().join("docs/guide/src").join(page);
    let text = fs::read_to_string(&path).map_err(Error::at(&path))?;
    first(&text, language).ok_or_else(|| Error::Lacking {
        what: format!("{page} of the guide has no example in {language}"),
        mend: format!("begin one by ```{language} below `{HEADING}`"),
    })
}

fn first(text: &str, language: &str) -> Option<String> {
    let begin = format!("```{language}");
    let below = text.lines().skip_while(|line| *line != HEADING);
    let mut lines = below.skip_while(|line| *line != begin).skip(1).peekable();
    lines.peek()?;
    Some(lines.take_while(|line| *line != "```").map(|line| format!("{line}\n")).collect())
}

#[cfg(test)]
mod tests {
    use super::first;

    #[test]
    fn the_first_block_of_a_language() {
        let text = "```sh\nls\n```\n## The first path\n```c\nint\n\nmain\n```\n```c\nother\n```\n";
        assert_eq!(first(text, "c").as_deref(), Some("int\n\nmain\n"));
        assert_eq!(first(text, "sh"), None);
    }
}
