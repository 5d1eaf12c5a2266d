//! Operations, timed.

use std::{
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

use mediant::Engine;

use super::{SoakError, kind::Kind, latency::Log};

/// Times operations, and refuses those that take too long.
#[derive(Debug)]
pub(super) struct Timer<'a> {
    pub(super) log: Log,
    longest: Duration,
    folder: &'a Path,
}

impl<'a> Timer<'a> {
    /// A timer without operations. None may take longer than `longest`; files are in `folder`.
    pub(super) fn new(longest: Duration, folder: &'a Path) -> Self {
        Self { log: Log::default(), longest, folder }
    }

    /// Does an operation, and counts its latency.
    pub(super) fn time<T>(
        &mut self,
        kind: Kind,
        engine: Engine,
        work: impl FnOnce() -> T,
    ) -> Result<T, SoakError> {
        let begin = Instant::now();
        let result = work();
        let latency = begin.elapsed();
        self.log.add(kind, latency);
        if latency > self.longest {
            let (took, bound) = (latency.as_millis(), self.longest.as_millis());
            return Err(SoakError::Wrong(format!(
                "{engine}, {kind}: took {took} ms, the bound is {bound} ms"
            )));
        }
        Ok(result)
    }

    /// The file to which indexes are saved.
    pub(super) fn file(&self) -> PathBuf {
        self.folder.join("index")
    }

    /// An error of an engine.
    pub(super) fn wrong(&self, engine: Engine, text: impl std::fmt::Display) -> SoakError {
        SoakError::Wrong(format!("{engine}: {text}"))
    }
}
