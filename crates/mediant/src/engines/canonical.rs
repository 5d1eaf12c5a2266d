//! Canonical A*, which needs a pruning rule, and canonical A* as published, which needs none.

use std::sync::Arc;

use mediant_grid::{GridGraph, Placement};
use mediant_search::{Canonical, PaperCanonical, Pruning, parts::NodeStore};

use super::{Boxed, EngineIndex, Source, boxed, with_options};
use crate::{
    configured::ConfiguredEngine,
    engine::Engine,
    error::Error,
    heuristic::Admissible,
    option::{
        HeuristicName, OptionValue, Variant,
        description::VARIANT,
        slot::{Field, Options, Slot},
    },
    setup_error::SetupError,
    shared_rules::{self, Shared},
};

/// Options of canonical A*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct CanonicalOptions {
    /// The heuristic; h_k by default.
    pub heuristic: Option<HeuristicName>,
    /// [`Variant::Exact`] (the default) or [`Variant::Paper`].
    pub variant: Option<Variant>,
}

impl Options for CanonicalOptions {
    fn slots(&mut self) -> Vec<Slot<'_>> {
        let variant = OptionValue::Variant(self.variant.unwrap_or(Variant::Exact));
        vec![
            Slot::heuristic(&mut self.heuristic),
            Slot::new(&VARIANT, Field::Variant(&mut self.variant)).with_value(Some(variant)),
        ]
    }
}

/// A grid graph with its pruning rule; without one for the engine as published.
pub(super) struct CanonicalIndex<P: Placement> {
    graph: Arc<GridGraph<P>>,
    pruning: Option<Arc<Pruning<P>>>,
    heuristic: Admissible,
}

impl<P: Shared> CanonicalIndex<P> {
    pub(super) fn new(
        graph: &Arc<GridGraph<P>>,
        own: CanonicalOptions,
        source: Source<'_>,
    ) -> Result<Self, Error> {
        let heuristic = Admissible::new(Engine::Canonical, own.heuristic)?;
        let pruning = match own.variant {
            Some(Variant::Paper) => None,
            _ => Some(shared_rules::pruning(graph, source.interrupt)?),
        };
        Ok(Self { graph: Arc::clone(graph), pruning, heuristic })
    }
}

impl<P: Placement> EngineIndex for CanonicalIndex<P> {
    fn search(&self) -> Result<Boxed, Error> {
        let graph = Arc::clone(&self.graph);
        Ok(match &self.pruning {
            Some(pruning) => boxed(Canonical::with_pruning(graph, Arc::clone(pruning), self.heuristic)?),
            None => boxed(PaperCanonical::new(graph, self.heuristic)),
        })
    }

    fn scratch_bytes(&self) -> usize {
        NodeStore::<()>::bytes(self.graph.vertex_count())
    }

    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let ConfiguredEngine::Canonical(own) = engine else { return Ok(None) };
        if (own.variant == Some(Variant::Paper)) != self.pruning.is_none() {
            return Err(SetupError::OtherVariant { engine: Engine::Canonical }.into());
        }
        let (graph, pruning) = (Arc::clone(&self.graph), self.pruning.clone());
        let heuristic = Admissible::new(Engine::Canonical, own.heuristic)?;
        with_options(Ok(Self { graph, pruning, heuristic }))
    }

    fn memory_bytes(&self) -> usize {
        self.pruning.as_ref().map_or(0, |pruning| pruning.memory_bytes())
    }
}
