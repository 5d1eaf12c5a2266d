//! Lines of prose that are too long: comments of Rust files, and Markdown.

use proc_macro2::{LineColumn, TokenStream, TokenTree};

use super::finding::Finding;
use crate::tree::Tree;

/// The most characters that a line with prose has.
const COLUMNS: usize = 110;
/// Pages that are drawn by a program, of which none is edited.
const DRAWN: &[&str] = &["docs/results"];

pub(super) fn check(tree: &Tree, findings: &mut Vec<Finding>) {
    let mut find = |path: &std::path::Path, line, text: &str| {
        let columns = text.chars().count();
        let message = format!(
            "{columns} columns of prose, at most {COLUMNS}: longer lines are hard to read and to compare"
        );
        findings.push(Finding { file: path.to_owned(), line, message });
    };
    for (path, text) in tree.texts(&["rs"]) {
        let strings = Strings::of(text);
        let mut markdown = Markdown::default();
        for (line, text) in (1..).zip(text.lines()) {
            let Some(at) = strings.comment(line, text) else {
                markdown = Markdown::default();
                continue;
            };
            let comment = text[at..].trim_start_matches(['/', '!']);
            if markdown.is_prose(comment) && is_too_long(text, comment) {
                find(path, line, text);
            }
        }
    }
    for (path, text) in tree.texts(&["md"]) {
        let mut markdown = Markdown::default();
        for (line, text) in (1..).zip(text.lines()) {
            if markdown.is_prose(text)
                && is_too_long(text, text)
                && !DRAWN.iter().any(|folder| path.starts_with(folder))
            {
                find(path, line, text);
            }
        }
    }
}

/// Whether a line is too long and could be broken: it has prose of more than one word.
fn is_too_long(line: &str, prose: &str) -> bool {
    let mark = |word: &&str| {
        matches!(*word, "-" | "*" | ">")
            || word.strip_suffix('.').is_some_and(|number| number.parse::<u32>().is_ok())
    };
    line.chars().count() > COLUMNS && prose.split_whitespace().skip_while(mark).count() > 1
}

/// Tells the prose of Markdown from its tables and code.
#[derive(Default)]
struct Markdown {
    /// Whether the last line is within a code fence.
    code: bool,
}

impl Markdown {
    fn is_prose(&mut self, line: &str) -> bool {
        let line = line.trim_start();
        let fence = line.starts_with("```");
        self.code ^= fence;
        !self.code && !fence && !line.starts_with('|')
    }
}

/// Where the literals of a Rust file are, in which `//` begins no comment.
struct Strings(Vec<(LineColumn, LineColumn)>);

impl Strings {
    fn of(text: &str) -> Self {
        let mut found = Vec::new();
        collect(text.parse().unwrap_or_default(), &mut found);
        Self(found)
    }

    /// Where on a line its comment begins, in bytes.
    fn comment(&self, line: usize, text: &str) -> Option<usize> {
        let begins = |&(at, _): &(usize, &str)| {
            let here = LineColumn { line, column: text[..at].chars().count() };
            !self.0.iter().any(|(start, end)| *start <= here && here < *end)
        };
        text.match_indices("//").find(begins).map(|(at, _)| at)
    }
}

fn collect(tokens: TokenStream, found: &mut Vec<(LineColumn, LineColumn)>) {
    for token in tokens {
        match token {
            TokenTree::Group(group) => collect(group.stream(), found),
            TokenTree::Literal(literal) => {
                // A documentation comment is a literal too, of an attribute that nobody wrote.
                let comment = literal.span().source_text().is_some_and(|text| text.starts_with("//"));
                if !comment {
                    found.push((literal.span().start(), literal.span().end()));
                }
            }
            _ => {}
        }
    }
}
