//! Causes whose figures are those of another experiment's record.
//!
//! A claim names such a cause by [`Cause::name`]; when the pages are drawn, its text, with the figures of the
//! record, takes the place of the name.

use mediant_report::Record;

use crate::rivera;

/// A cause that an experiment of its own measures.
pub(crate) struct Cause {
    /// The word by which claims name it.
    pub(crate) name: &'static str,
    /// The experiment whose record holds the figures.
    pub(crate) experiment: &'static str,
    /// Its text; none if the record lacks a figure, as that of a sample may.
    pub(crate) text: fn(&Record) -> Option<String>,
}

/// All of them.
const CAUSES: &[Cause] = rivera::CAUSES;

/// The causes of a claim, one a line, with the texts of those that have an experiment of their own.
pub(crate) fn explained<'r>(causes: &str, record: impl Fn(&str) -> Option<&'r Record>) -> String {
    let line = |line: &str| {
        let Some(cause) = CAUSES.iter().find(|cause| cause.name == line) else {
            return line.to_owned();
        };
        let text = record(cause.experiment).and_then(cause.text);
        text.unwrap_or_else(|| format!("Not measured here: experiment `{}` tells it.", cause.experiment))
    };
    causes.lines().map(line).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use mediant_sets::root;

    use super::*;
    use crate::records::records;

    #[test]
    fn names_give_way_to_texts() {
        let unknown = explained("draw\nrivera2017-causes: ties", |_| None);
        assert_eq!(unknown, "draw\nNot measured here: experiment `rivera2017-causes` tells it.");
        let records = records(&root().join("docs/results")).unwrap();
        let known = |id: &str| records.iter().find(|(_, record)| record.id == id).map(|(_, record)| record);
        for cause in CAUSES {
            let text = explained(cause.name, known);
            assert!(!text.starts_with("Not measured") && text != cause.name, "{text}");
        }
    }
}
