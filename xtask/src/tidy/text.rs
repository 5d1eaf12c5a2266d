//! Rules about any file: sizes, spaces, marks of unfinished work, and paths of one machine.

use super::finding::Finding;
use crate::tree::Tree;

const LARGEST: usize = 512 << 10;

pub(super) fn check(tree: &Tree, findings: &mut Vec<Finding>) {
    for (path, bytes) in tree.files() {
        let mut find =
            |line, message: String| findings.push(Finding { file: path.to_owned(), line, message });
        if bytes.len() > LARGEST {
            let message = format!(
                "{} KiB, at most {} KiB: what git has taken in, every clone carries for ever",
                bytes.len() >> 10,
                LARGEST >> 10
            );
            find(0, message);
        }
        let Ok(text) = std::str::from_utf8(bytes) else { continue };
        for (line, text) in (1..).zip(text.lines()) {
            for folder in machine_folders(text) {
                find(line, format!("`{folder}` is a path of one machine: it means nothing on another"));
            }
        }
    }
    for (path, text) in tree.texts(&["rs", "md", "toml"]) {
        let mut find =
            |line, message: String| findings.push(Finding { file: path.to_owned(), line, message });
        for (line, text) in (1..).zip(text.split('\n')) {
            if text.ends_with(char::is_whitespace) {
                find(
                    line,
                    "white space at the end of the line: differences should show what changed".to_owned(),
                );
            }
            if text.trim_end().contains('\t') {
                find(line, "a tab: its width depends on who looks".to_owned());
            }
            for mark in [concat!("FIX", "ME"), concat!("X", "XX")] {
                if words(text).any(|word| word == mark) {
                    find(line, format!("`{mark}`: mend it, or say what is so; nobody comes back for a mark"));
                }
            }
        }
    }
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_')
}

/// The folders of one machine with which a path in this text begins.
fn machine_folders(text: &str) -> impl Iterator<Item = &'static str> {
    const FOLDERS: [&str; 5] = [
        concat!("/ho", "me/"),
        concat!("/ro", "ot/"),
        concat!("/wo", "rk/"),
        concat!("/t", "mp/"),
        concat!("/Us", "ers/"),
    ];
    FOLDERS.into_iter().filter(|folder| {
        let inside = |c: char| c.is_alphanumeric() || matches!(c, '.' | '_' | '-' | '}' | ')' | '>');
        text.match_indices(folder).any(|(at, _)| !text[..at].ends_with(inside))
    })
}
