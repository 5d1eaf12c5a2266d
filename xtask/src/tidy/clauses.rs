//! Comments that begin with a clause where the name of a thing should stand.

use std::path::Path;

use super::finding::Finding;
use crate::tree::Tree;

/// The most lines of comments in the project that may begin with a clause. It only falls: whoever rewords
/// some lowers it to the number that is left.
pub const MOST_CLAUSES: usize = 0;
/// The words that begin such a clause: 'What a cell holds', 'Those that are free'.
const WORDS: [&str; 2] = ["What ", "Those "];

pub(super) fn check(tree: &Tree, findings: &mut Vec<Finding>) {
    let lines = tree.texts(&["rs"]).flat_map(|(_, text)| text.lines());
    let count = lines.filter(|line| begins_with_clause(line)).count();
    if count > MOST_CLAUSES {
        let message = format!(
            "{count} lines of comments begin with `What` or `Those`, at most {MOST_CLAUSES}: name the thing, \
             as in 'Edges of a subgoal' instead of 'What a subgoal is joined to'"
        );
        findings.push(Finding { file: Path::new("xtask/src/tidy/clauses.rs").into(), line: 0, message });
    }
}

fn begins_with_clause(line: &str) -> bool {
    let Some(comment) = line.trim_start().strip_prefix("//") else { return false };
    let text = comment.trim_start_matches(['/', '!']).trim_start();
    WORDS.iter().any(|word| text.starts_with(word))
}
