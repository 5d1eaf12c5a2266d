//! The parts of `mediant run`: queries, answers, sums and reports.

pub(crate) mod answer;
pub(crate) mod csv;
pub(crate) mod distances;
pub(crate) mod jsonl;
pub(crate) mod measure;
pub(crate) mod queries;
pub(crate) mod query_error;
pub(crate) mod report;
pub(crate) mod searchers;
pub(crate) mod session;
pub(crate) mod summary;
pub(crate) mod table;
pub(crate) mod timeline;
pub(crate) mod trace;
