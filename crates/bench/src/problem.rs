//! Maps with their queries, loaded and checked.

use std::sync::Arc;

use mediant_formats::{MapError, MapFile, MapMismatch, Scenario, ScenarioError, Tiles};
use mediant_grid::Grid;
use mediant_search::Ends;
use mediant_sets::{Archive, ArchiveError};

/// A map with the queries that are measured on it.
#[derive(Clone, Debug)]
pub struct Problem {
    pub(crate) set: String,
    pub(crate) name: String,
    pub(crate) grid: Arc<Grid>,
    pub(crate) cases: Vec<Case>,
}

/// One query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Case {
    /// Its index in the scenario, from 0.
    pub(crate) index: usize,
    pub(crate) query: Ends,
    /// The length of a shortest path at k = 3 between centers without cut corners, as exactly as the scenario
    /// gives it.
    pub(crate) optimum: f64,
}

/// A map or scenario that is not fit for a measurement.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ProblemError {
    /// A file that exists, but cannot be read.
    #[error(transparent)]
    Archive(#[from] ArchiveError),
    /// A file that is no map.
    #[error("map `{name}`: {source}")]
    Map {
        /// The map's name.
        name: String,
        /// The fault.
        source: MapError,
    },
    /// A file that is no scenario.
    #[error("scenario of map `{name}`: {source}")]
    Scenario {
        /// The map's name.
        name: String,
        /// The fault.
        source: ScenarioError,
    },
    /// The scenario of another map.
    #[error(transparent)]
    OtherMap(#[from] MapMismatch),
    /// No instance is kept, or one starts or ends at a cell that is not free.
    #[error("scenario of map `{name}`: {wrong}")]
    Instances {
        /// The map's name.
        name: String,
        /// The fault.
        wrong: String,
    },
}

impl Problem {
    /// Loads a map and those instances of its scenario whose index `every` divides (0 counts as 1). `None` if
    /// the archive lacks the map or the scenario.
    ///
    /// # Errors
    /// [`ProblemError`] for a file that cannot be read or is wrong; it says which and why.
    pub fn load(
        archive: &Archive,
        set: &str,
        name: &str,
        every: usize,
    ) -> Result<Option<Self>, ProblemError> {
        let (Some(map), Some(scenario)) = (archive.map(set, name)?, archive.scenario(set, name)?) else {
            return Ok(None);
        };
        let map = MapFile::from_bytes(map, Tiles::default())
            .map_err(|source| ProblemError::Map { name: name.to_owned(), source })?;
        let scenario = Scenario::from_bytes(scenario)
            .map_err(|source| ProblemError::Scenario { name: name.to_owned(), source })?;
        Self::new(set, name, map.to_grid(), &scenario, every).map(Some)
    }

    /// The problem of a map and of those instances of a scenario whose index `every` divides (0 counts as 1).
    ///
    /// # Errors
    /// [`ProblemError::OtherMap`] for a scenario of another map, [`ProblemError::Instances`] for none or
    /// wrong instances.
    pub fn new(
        set: &str,
        name: &str,
        grid: Grid,
        scenario: &Scenario,
        every: usize,
    ) -> Result<Self, ProblemError> {
        scenario.check_map(&grid, name)?;
        let wrong = |wrong: String| ProblemError::Instances { name: name.to_owned(), wrong };
        let instances = scenario.instances().iter().enumerate().step_by(every.max(1));
        let cases: Vec<Case> = instances
            .map(|(index, instance)| Case {
                index,
                query: Ends::new(instance.start, instance.goal),
                optimum: instance.optimal,
            })
            .collect();
        for Case { index, query, .. } in &cases {
            if let Some(at) = [query.start, query.goal].into_iter().find(|at| !grid.is_free(at.x, at.y)) {
                return Err(wrong(format!("instance {index} starts or ends at {at}, which is no free cell")));
            }
        }
        if cases.is_empty() {
            return Err(wrong("it has no instances".to_owned()));
        }
        Ok(Self { set: set.to_owned(), name: name.to_owned(), grid: Arc::new(grid), cases })
    }

    /// The map's name, without extension.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The map.
    #[must_use]
    pub const fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// The number of queries, at least one.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a problem is never empty")]
    pub const fn len(&self) -> usize {
        self.cases.len()
    }
}
