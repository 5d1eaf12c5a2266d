//! Theta* and Lazy Theta*, which search a grid graph as it is, for paths at any angle.

use std::sync::Arc;

use mediant_grid::{GridGraph, Interrupt, Placement};
use mediant_search::{
    LazyThetaStar, ThetaStar,
    parts::{Eager, Lazy, SightCheck, Theta},
};

use super::{Boxed, EngineIndex, boxed, following, grid_search::GuidedOptions, shared, with_options};
use crate::{
    change::Change, configured::ConfiguredEngine, engine::Engine, error::Error, heuristic::Admissible,
    space::PlacementOfSpace,
};

/// A grid graph, and which of the engines searches it.
pub(super) struct ThetaIndex<P: Placement> {
    graph: Arc<GridGraph<P>>,
    is_lazy: bool,
    heuristic: Admissible,
}

impl<P: Placement> ThetaIndex<P> {
    /// For Theta*.
    pub(super) fn new(graph: &Arc<GridGraph<P>>, own: GuidedOptions) -> Result<Self, Error> {
        let heuristic = Admissible::new(Engine::Theta, own.heuristic)?;
        Ok(Self { graph: Arc::clone(graph), is_lazy: false, heuristic })
    }

    /// For Lazy Theta*.
    pub(super) fn lazy(graph: &Arc<GridGraph<P>>, own: GuidedOptions) -> Result<Self, Error> {
        let heuristic = Admissible::new(Engine::LazyTheta, own.heuristic)?;
        Ok(Self { graph: Arc::clone(graph), is_lazy: true, heuristic })
    }
}

impl<P: Placement> ThetaIndex<P> {
    fn follow_by<S: SightCheck + 'static>(&self, search: &mut Boxed) -> Result<bool, Error> {
        following(search, |search: &mut Theta<Arc<GridGraph<P>>, Admissible, S>| {
            search.follow(Arc::clone(&self.graph));
            Ok::<_, Error>(())
        })
    }
}

impl<P: PlacementOfSpace> EngineIndex for ThetaIndex<P> {
    fn search(&self) -> Result<Boxed, Error> {
        let graph = Arc::clone(&self.graph);
        Ok(match self.is_lazy {
            false => boxed(ThetaStar::new(graph, self.heuristic)),
            true => boxed(LazyThetaStar::new(graph, self.heuristic)),
        })
    }

    fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
        if self.is_lazy { self.follow_by::<Lazy>(search) } else { self.follow_by::<Eager>(search) }
    }

    fn scratch_bytes(&self) -> usize {
        ThetaStar::<&GridGraph<P>, ()>::scratch_bytes(&self.graph)
    }

    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        with_options(match (self.is_lazy, engine) {
            (false, ConfiguredEngine::Theta(own)) => Self::new(&self.graph, own),
            (true, ConfiguredEngine::LazyTheta(own)) => Self::lazy(&self.graph, own),
            _ => return Ok(None),
        })
    }

    fn repaired(&self, change: &Change, _: &Interrupt) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let graph = P::layers(change.after(), Engine::Theta)?.graph(self.graph.k())?;
        shared(Ok(Self { graph: Arc::clone(graph), ..*self })).map(Some)
    }
}
