//! Canonical A*, which needs a pruning rule; for publications also canonical A* as published, which needs
//! none.

use std::sync::Arc;

use mediant_grid::{GridGraph, Interrupt, Placement};
#[cfg(feature = "publications")]
use mediant_search::PaperCanonical;
use mediant_search::{Canonical, Pruning, parts::NodeStore};

use super::{Boxed, EngineIndex, Source, boxed, following, shared, with_options};
#[cfg(feature = "publications")]
use crate::option::Variant;
use crate::{
    change::Change,
    configured::ConfiguredEngine,
    engine::Engine,
    error::Error,
    heuristic::Admissible,
    option::{
        HeuristicName, if_published,
        slot::{Options, Slot},
    },
    setup_error::SetupError,
    shared_rules::{self, Shared},
    space::PlacementOfSpace,
};

/// Options of canonical A*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct CanonicalOptions {
    /// The heuristic; h_k by default.
    pub heuristic: Option<HeuristicName>,
    /// [`Variant::Exact`] (the default) or [`Variant::Paper`].
    #[cfg(feature = "publications")]
    pub variant: Option<Variant>,
}

impl Options for CanonicalOptions {
    fn slots(&mut self) -> Vec<Slot<'_>> {
        Vec::from([
            Slot::heuristic(&mut self.heuristic),
            #[cfg(feature = "publications")]
            Slot::variant(&mut self.variant, Variant::Exact),
        ])
    }
}

impl CanonicalOptions {
    /// Whether it is the engine as published.
    fn is_as_published(self) -> bool {
        if_published!(self.variant == Some(Variant::Paper), else false)
    }
}

/// A grid graph with its pruning rule.
pub(super) struct CanonicalIndex<P: Placement> {
    graph: Arc<GridGraph<P>>,
    rule: Rule<P>,
    heuristic: Admissible,
}

#[derive(Clone)]
enum Rule<P: Placement> {
    Pruning(Arc<Pruning<P>>),
    /// As published, without a pruning rule.
    #[cfg(feature = "publications")]
    AsPublished,
}

impl<P: Placement> Rule<P> {
    fn is_as_published(&self) -> bool {
        if_published!(matches!(self, Self::AsPublished), else false)
    }
}

impl<P: Shared> CanonicalIndex<P> {
    pub(super) fn new(
        graph: &Arc<GridGraph<P>>,
        own: CanonicalOptions,
        source: Source<'_>,
    ) -> Result<Self, Error> {
        let heuristic = Admissible::new(Engine::Canonical, own.heuristic)?;
        let graph = Arc::clone(graph);
        #[cfg(feature = "publications")]
        if own.is_as_published() {
            return Ok(Self { graph, rule: Rule::AsPublished, heuristic });
        }
        let pruning = shared_rules::pruning(&graph, source.interrupt)?;
        Ok(Self { graph, rule: Rule::Pruning(pruning), heuristic })
    }
}

impl<P: PlacementOfSpace> EngineIndex for CanonicalIndex<P> {
    fn search(&self) -> Result<Boxed, Error> {
        let graph = Arc::clone(&self.graph);
        Ok(match &self.rule {
            Rule::Pruning(pruning) => {
                boxed(Canonical::with_pruning(graph, Arc::clone(pruning), self.heuristic)?)
            }
            #[cfg(feature = "publications")]
            Rule::AsPublished => boxed(PaperCanonical::new(graph, self.heuristic)),
        })
    }

    fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
        let graph = Arc::clone(&self.graph);
        match &self.rule {
            Rule::Pruning(pruning) => following(search, |search: &mut Canonical<_, Admissible, P>| {
                search.follow(graph, Arc::clone(pruning))
            }),
            #[cfg(feature = "publications")]
            Rule::AsPublished => following(search, |search: &mut PaperCanonical<_, Admissible>| {
                search.follow(graph);
                Ok::<_, Error>(())
            }),
        }
    }

    fn scratch_bytes(&self) -> usize {
        NodeStore::<()>::bytes(self.graph.vertex_count())
    }

    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let ConfiguredEngine::Canonical(own) = engine else { return Ok(None) };
        if own.is_as_published() != self.rule.is_as_published() {
            return Err(SetupError::OtherVariant { engine: Engine::Canonical }.into());
        }
        let (graph, rule) = (Arc::clone(&self.graph), self.rule.clone());
        let heuristic = Admissible::new(Engine::Canonical, own.heuristic)?;
        with_options(Ok(Self { graph, rule, heuristic }))
    }

    fn memory_bytes(&self) -> usize {
        match &self.rule {
            Rule::Pruning(pruning) => pruning.memory_bytes(),
            #[cfg(feature = "publications")]
            Rule::AsPublished => 0,
        }
    }

    fn repaired(
        &self,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let k = self.graph.k();
        let graph = P::layers(change.after(), Engine::Canonical)?.graph(k)?;
        let rule = match &self.rule {
            Rule::Pruning(pruning) => match shared_rules::repaired(pruning, graph, change, interrupt)? {
                Some(pruning) => Rule::Pruning(pruning),
                None => return Ok(None),
            },
            #[cfg(feature = "publications")]
            Rule::AsPublished => Rule::AsPublished,
        };
        shared(Ok(Self { graph: Arc::clone(graph), rule, heuristic: self.heuristic })).map(Some)
    }
}
