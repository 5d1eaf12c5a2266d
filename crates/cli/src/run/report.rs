//! The trait of both forms of a report, and the phrases that they share.

use std::io;

use mediant::{Choice, Engine, FiniteK, K, Motion};

use super::{
    answer::{EditRecord, QueryRecord, RunHead},
    summary::Summary,
};
use crate::terminal::numbers::grouped;

/// Reports a run: first the run, then its queries and edits in order, last their summary.
pub(crate) trait Report {
    /// Reports the head of the run.
    fn begin(&mut self, run: &RunHead<'_>) -> io::Result<()>;

    /// Reports an edit.
    fn edit(&mut self, record: &EditRecord<'_>) -> io::Result<()>;

    /// Reports a query and its answer.
    fn query(&mut self, record: QueryRecord) -> io::Result<()>;

    /// Reports the summary.
    fn end(&mut self, summary: &Summary) -> io::Result<()>;
}

/// That another engine searches in place of the one that was asked for.
pub(crate) fn falls_back(engine: Engine, searched_by: Engine) -> String {
    format!("{engine} falls back to {searched_by}: on this map its graph would be slower than no index")
}

/// The choice of `auto`, in words.
pub(crate) fn by_auto(choice: Choice) -> String {
    format!("auto took {}: {}", choice.engine, choice.why)
}

/// That queries have no path.
pub(crate) fn without_path(number: u64, all: u64) -> String {
    match (number, all) {
        (_, 1) => "there is no path, and --require-path asks for one".to_owned(),
        (1, _) => format!("1 of {} has no path, and --require-path asks for all", grouped(all)),
        _ => format!("{} of {} have no path, and --require-path asks for all", grouped(number), grouped(all)),
    }
}

/// A k with the number of its moves, which people expect where k stands.
pub(crate) fn k_in_words(k: K) -> String {
    match k.finite().and_then(FiniteK::moves) {
        Some(moves) => format!("k = {k} ({} moves)", grouped(moves)),
        None => format!("k = {k}"),
    }
}

/// Rules and k, with the number of its moves.
pub(crate) fn motion_in_words(motion: Motion) -> String {
    format!("{}, {}", motion.rules, k_in_words(motion.k))
}

/// The ends of paths to which places of the world are moved, in words.
pub(crate) fn ends_in_words(k: K) -> &'static str {
    if k == K::Any { "multiples of 1/1024 of a cell" } else { "vertices" }
}
