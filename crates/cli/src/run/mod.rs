//! What `mediant run` does with its queries: answers, sums and reports.

pub(crate) mod answer;
pub(crate) mod measure;
pub(crate) mod queries;
pub(crate) mod report;
pub(crate) mod session;
pub(crate) mod summary;
pub(crate) mod trace;
