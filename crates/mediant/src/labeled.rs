//! Hub labels of either placement, and their searches of distances to many goals.

use std::sync::Arc;

use mediant_grid::{FreeSpace, Interrupt, Vertex};
use mediant_moves::Cost;
use mediant_search::parts::HasFreeSpace;
use mediant_subgoal::{Goals, GoalsError, HubLabelSearch, HubLabels, SubgoalPlacement};

use crate::error::Error;

/// Hub labels of either placement.
pub(crate) trait HasLabels {
    /// [`HubLabels::goals_interruptible`].
    fn goals(&self, goals: &[Vertex], interrupt: &Interrupt) -> Result<Goals, GoalsError>;

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
    fn goals(&self, goals: &[Vertex], interrupt: &Interrupt) -> Result<Goals, GoalsError> {
        self.labels.goals_interruptible(&self.space, goals.iter().copied(), interrupt)
    }

    fn to_goals(&self) -> Result<Box<dyn ToGoals + Send>, Error> {
        Ok(Box::new(HubLabelSearch::new(Arc::clone(&self.space), Arc::clone(&self.labels))?))
    }
}

/// Distances to many goals by hub labels.
pub(crate) trait ToGoals {
    /// [`HubLabelSearch::distances_interruptible`].
    fn distances(
        &mut self,
        start: Vertex,
        goals: &Goals,
        distances: &mut Vec<Option<Cost>>,
        interrupt: &Interrupt,
    ) -> Result<(), GoalsError>;

    /// [`HubLabelSearch::nearest_interruptible`].
    fn nearest(
        &mut self,
        start: Vertex,
        goals: &Goals,
        interrupt: &Interrupt,
    ) -> Result<Option<(usize, Cost)>, GoalsError>;
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
        interrupt: &Interrupt,
    ) -> Result<(), GoalsError> {
        self.distances_interruptible(start, goals, distances, interrupt)
    }

    fn nearest(
        &mut self,
        start: Vertex,
        goals: &Goals,
        interrupt: &Interrupt,
    ) -> Result<Option<(usize, Cost)>, GoalsError> {
        self.nearest_interruptible(start, goals, interrupt)
    }
}

/// The many-goals search of a planner, and its scratch memory.
#[derive(Default)]
pub(crate) struct Asked {
    /// Made when it is first needed.
    pub(crate) search: Option<Box<dyn ToGoals + Send>>,
    pub(crate) costs: Vec<Option<Cost>>,
}
