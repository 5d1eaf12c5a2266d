//! Hub labels of either placement, and their searches of distances to many goals.

use std::sync::Arc;

use mediant_grid::{FreeSpace, Vertex};
use mediant_moves::Cost;
use mediant_search::{QueryError, parts::HasFreeSpace};
use mediant_subgoal::{Goals, HubLabelSearch, HubLabels, SubgoalPlacement};

use crate::error::Error;

/// Hub labels of either placement.
pub(crate) trait HasLabels {
    /// [`HubLabels::goals`].
    fn goals(&self, goals: &mut dyn Iterator<Item = Vertex>) -> Result<Goals, Error>;

    /// A search of distances to many goals.
    fn to_goals(&self) -> Result<Box<dyn ToGoals + Send>, Error>;
}

/// A free space with its hub labels.
#[derive(Clone)]
pub(crate) struct Labeled<P: SubgoalPlacement> {
    pub(crate) space: Arc<FreeSpace<P>>,
    pub(crate) labels: Arc<HubLabels<P>>,
}

impl<P: SubgoalPlacement> HasLabels for Labeled<P> {
    fn goals(&self, goals: &mut dyn Iterator<Item = Vertex>) -> Result<Goals, Error> {
        Ok(self.labels.goals(&self.space, goals)?)
    }

    fn to_goals(&self) -> Result<Box<dyn ToGoals + Send>, Error> {
        Ok(Box::new(HubLabelSearch::new(Arc::clone(&self.space), Arc::clone(&self.labels))?))
    }
}

/// Distances to many goals by hub labels.
pub(crate) trait ToGoals {
    /// [`HubLabelSearch::distances`].
    fn distances(
        &mut self,
        start: Vertex,
        goals: &Goals,
        distances: &mut Vec<Option<Cost>>,
    ) -> Result<(), QueryError>;

    /// [`HubLabelSearch::nearest`].
    fn nearest(&mut self, start: Vertex, goals: &Goals) -> Result<Option<(usize, Cost)>, QueryError>;
}

impl<S, P> ToGoals for HubLabelSearch<Arc<S>, Arc<HubLabels<P>>>
where
    P: SubgoalPlacement,
    S: HasFreeSpace<Placement = P>,
{
    fn distances(
        &mut self,
        start: Vertex,
        goals: &Goals,
        distances: &mut Vec<Option<Cost>>,
    ) -> Result<(), QueryError> {
        self.distances(start, goals, distances)
    }

    fn nearest(&mut self, start: Vertex, goals: &Goals) -> Result<Option<(usize, Cost)>, QueryError> {
        self.nearest(start, goals)
    }
}

/// The many-goals search of a planner, and its scratch memory.
#[derive(Default)]
pub(crate) struct Asked {
    /// Made when it is first needed.
    pub(crate) search: Option<Box<dyn ToGoals + Send>>,
    pub(crate) costs: Vec<Option<Cost>>,
}
