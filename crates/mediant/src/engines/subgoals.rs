//! Subgoals: hub labels where they fit in memory, else a subgoal graph, and another engine where both would
//! be slow.

use std::sync::{Arc, OnceLock};

use mediant_grid::{Change as GridChange, FreeSpace, Identity, Interrupt, Interrupted};
use mediant_search::{Ends, parts::count_work};
use mediant_subgoal::{
    EarlierMap, HubLabelSearch, HubLabels, PreparedSubgoals, SubgoalAStar, SubgoalGraph, SubgoalPlacement,
};

use super::{
    Boxed, EngineIndex, Source, boxed, check_levels,
    earlier::{EarlierIndex, other_after},
    following, prepare, shared, with_options,
};
use crate::{
    change::Change,
    choice::Choice,
    configured::ConfiguredEngine,
    engine::Engine,
    erased::Dynamic,
    error::Error,
    labeled::{HasLabels, Labeled},
    map::Map,
    memory_check,
    motion::Motion,
    option::{
        Levels, Memory,
        slot::{Field, Options, Slot},
        table::{LEVELS, MEMORY},
    },
    setup::Setup,
    setup_error::SetupError,
    space::{PlacementOfSpace, Space},
};

/// Options of subgoals.
///
/// Whatever they are, paths are optimal. If no levels are named, the map decides: hub labels if they fit in
/// `memory`, else a contraction hierarchy; where that would be slow, as on noise, nothing is kept, and
/// another engine searches ([`Index::searched_by`](crate::Index::searched_by)).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SubgoalOptions {
    /// The levels of the graph, a contraction hierarchy, or hub labels; by default the map decides.
    pub levels: Option<Levels>,
    /// The memory that hub labels may take, which is used: what they leave of it goes to labels of vertices,
    /// with which queries are faster on most maps. By default vertices have none, and hub labels may
    /// take that of [`Memory::for_labels_of`] if no levels are named, and as much as they need if
    /// [`Levels::Labels`] are named.
    pub memory: Option<Memory>,
}

impl Options for SubgoalOptions {
    fn slots(&mut self) -> Vec<Slot<'_>> {
        vec![
            Slot::new(&LEVELS, Field::Levels(&mut self.levels)),
            Slot::new(&MEMORY, Field::Memory(&mut self.memory)),
        ]
    }

    fn check(&self, _engine: Engine) -> Result<(), SetupError> {
        match self.levels {
            Some(levels) if levels != Levels::Labels && self.memory.is_some() => {
                Err(SetupError::MemoryWithoutLabels { levels })
            }
            _ => Ok(()),
        }
    }
}

/// The form in which the subgoals of a free space are kept.
pub(super) struct SubgoalIndex<P: PlacementOfSpace> {
    own: SubgoalOptions,
    motion: Motion,
    kept: Kept<P>,
    /// The engine that searches after edits, on this map: made when it is first repaired.
    other: OnceLock<Arc<dyn EngineIndex>>,
}

#[derive(Clone)]
enum Kept<P: PlacementOfSpace> {
    Labels(Labeled<P>),
    Graph(Arc<FreeSpace<P>>, Arc<SubgoalGraph<P>>),
    /// Nothing: the substitute searches.
    Nothing(Identity, Arc<dyn EngineIndex>),
    /// The labels or the graph of an earlier map.
    Earlier(EarlierIndex<P>),
}

impl<P: PlacementOfSpace> SubgoalIndex<P> {
    /// Shares what it can with hub labels for another k, which are `beside`; `substitute` prepares the engine
    /// that searches where nothing is kept.
    pub(super) fn new(
        own: SubgoalOptions,
        motion: Motion,
        space: &Arc<FreeSpace<P>>,
        (source, beside): (Source<'_>, Option<&HubLabels<P>>),
        substitute: impl FnOnce(Setup, Source<'_>) -> Result<Arc<dyn EngineIndex>, Error>,
    ) -> Result<Self, Error> {
        let other = Setup::new(substitute_for(motion), motion);
        let prepared = match source.bytes {
            Some(bytes) => {
                PreparedSubgoals::from_bytes_interruptible(space, motion.k, bytes, source.interrupt)?
            }
            None => {
                let prepared = prepared(own, other, space, source, beside)?;
                with_vertices(prepared, own.memory, space, source)?
            }
        };
        let free = Arc::clone(space);
        let kept = match prepared {
            PreparedSubgoals::Labels(labels) => {
                Kept::Labels(Labeled { space: free, labels: Arc::new(labels) })
            }
            PreparedSubgoals::Contracted(graph) => Kept::Graph(free, Arc::new(graph)),
            PreparedSubgoals::Nothing(identity) => {
                Kept::Nothing(identity, substitute(other, Source { bytes: None, ..source })?)
            }
        };
        let index = Self::of(own, motion, kept)?;
        Ok(if source.bytes.is_some() { index.named() } else { index })
    }

    /// Checks that it has the levels that the options name, and that labels take no more memory than they
    /// may.
    fn of(own: SubgoalOptions, motion: Motion, kept: Kept<P>) -> Result<Self, Error> {
        let index = Self { own, motion, kept, other: OnceLock::new() };
        if let Some((most, (found, _))) = own.memory.zip(index.memory_of_labels())
            && found > most
        {
            return Err(Error::Memory { most, found });
        }
        check_levels(own.levels, index.levels())?;
        Ok(index)
    }

    /// The same options on another map.
    fn with(&self, kept: Kept<P>) -> Self {
        Self { own: self.own, motion: self.motion, kept, other: OnceLock::new() }
    }

    /// Its labels or its graph as those of an earlier map, from which the space's does not differ yet; `None`
    /// if it has neither.
    fn earlier(&self, space: &Space, interrupt: &Interrupt) -> Result<Option<EarlierIndex<P>>, Error> {
        let none = GridChange::new(Arc::clone(space.map().grid()));
        let (levels, map) = match &self.kept {
            Kept::Labels(Labeled { space, labels }) => {
                (Levels::Labels, EarlierMap::of_labels(space, labels, space, &none))
            }
            Kept::Graph(space, graph) => {
                (graph.hierarchy().into(), EarlierMap::of_graph(space, graph, space, &none))
            }
            Kept::Earlier(earlier) => return Ok(Some(earlier.clone())),
            Kept::Nothing(..) => return Ok(None),
        };
        let other = match self.other.get() {
            Some(other) => Arc::clone(other),
            None => {
                let other = other_anew(self.motion, space, interrupt)?;
                Arc::clone(self.other.get_or_init(|| other))
            }
        };
        Ok(Some(EarlierIndex::new(map, levels, other)))
    }

    /// The same with options that name what is kept. Of labels the memory is named if they take more than by
    /// default: on another map there may be none.
    fn named(self) -> Self {
        let SubgoalOptions { levels, memory } = self.own;
        let own = match (&self.kept, self.memory_of_labels()) {
            (Kept::Graph(..), _) => SubgoalOptions { levels: self.levels(), memory: None },
            (Kept::Labels(_), Some((bytes, default))) if levels.is_none() && bytes > default => {
                SubgoalOptions { levels, memory: memory.or(Some(bytes)) }
            }
            _ => self.own,
        };
        Self { own, ..self }
    }

    /// The memory that its hub labels take, and that which they may take if the user names none.
    fn memory_of_labels(&self) -> Option<(Memory, Memory)> {
        let Kept::Labels(Labeled { space, labels }) = &self.kept else { return None };
        let grid = space.grid();
        let default = Memory::for_labels_of(grid.width(), grid.height());
        Some((Memory::new(labels.memory_bytes() as u64)?, default))
    }
}

impl<P: PlacementOfSpace> EngineIndex for SubgoalIndex<P> {
    fn search(&self) -> Result<Boxed, Error> {
        match &self.kept {
            Kept::Labels(Labeled { space, labels }) => {
                Ok(boxed(HubLabelSearch::new(Arc::clone(space), Arc::clone(labels))?))
            }
            Kept::Graph(space, graph) => Ok(boxed(SubgoalAStar::new(Arc::clone(space), Arc::clone(graph))?)),
            Kept::Nothing(_, substitute) => substitute.search(),
            Kept::Earlier(earlier) => earlier.search(),
        }
    }

    fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
        match &self.kept {
            Kept::Labels(Labeled { space, labels }) => {
                following(search, |search: &mut HubLabelSearch<_, _>| {
                    search.follow(Arc::clone(space), Arc::clone(labels))
                })
            }
            Kept::Graph(space, graph) => following(search, |search: &mut SubgoalAStar<_, _, P>| {
                search.follow(Arc::clone(space), Arc::clone(graph))
            }),
            Kept::Nothing(_, substitute) => substitute.follow(search),
            Kept::Earlier(earlier) => earlier.follow(search),
        }
    }

    fn scratch_bytes(&self) -> usize {
        match &self.kept {
            Kept::Labels(Labeled { labels, .. }) => HubLabelSearch::scratch_bytes(labels),
            Kept::Graph(_, graph) => SubgoalAStar::scratch_bytes(graph),
            Kept::Nothing(_, substitute) => substitute.scratch_bytes(),
            Kept::Earlier(earlier) => earlier.scratch_bytes(),
        }
    }

    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let ConfiguredEngine::Subgoal(own) = engine else { return Ok(None) };
        with_options(Self::of(own, self.motion, self.kept.clone()).map(Self::named))
    }

    fn memory_bytes(&self) -> usize {
        match &self.kept {
            Kept::Labels(Labeled { labels, .. }) => labels.memory_bytes(),
            Kept::Graph(_, graph) => graph.memory_bytes(),
            Kept::Nothing(_, substitute) => substitute.memory_bytes(),
            Kept::Earlier(earlier) => earlier.memory_bytes(),
        }
    }

    fn to_bytes(&self, interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        Ok(match &self.kept {
            Kept::Labels(Labeled { labels, .. }) => Some(labels.to_bytes_interruptible(interrupt)?),
            Kept::Graph(_, graph) => Some(graph.to_bytes_interruptible(interrupt)?),
            Kept::Nothing(identity, _) => Some(PreparedSubgoals::<P>::Nothing(*identity).to_bytes()),
            Kept::Earlier(earlier) => earlier.to_bytes(interrupt)?,
        })
    }

    fn repaired(
        &self,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let anew = |space: &Space| other_anew(self.motion, space, interrupt);
        let kept = match &self.kept {
            Kept::Nothing(identity, substitute) => {
                let identity = Identity { map: change.after().identity().map, ..*identity };
                Kept::Nothing(identity, other_after(substitute, change, anew, interrupt)?)
            }
            Kept::Labels(_) | Kept::Graph(..) | Kept::Earlier(_) => {
                let Some(earlier) = self.earlier(change.before(), interrupt)? else { return Ok(None) };
                let earlier = earlier.repaired(change, anew, interrupt)?;
                Kept::Earlier(earlier)
            }
        };
        shared(Ok(self.with(kept))).map(Some)
    }

    fn ready_for_changes(
        &self,
        space: &Space,
        interrupt: &Interrupt,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let Some(earlier) = self.earlier(space, interrupt)? else { return Ok(None) };
        shared(Ok(self.with(Kept::Earlier(earlier)))).map(Some)
    }

    fn is_finished(&self) -> bool {
        !matches!(&self.kept, Kept::Earlier(earlier) if !earlier.is_present())
    }

    fn answered_by(&self, search: &Boxed) -> Option<Engine> {
        let is_by_other = match &self.kept {
            Kept::Labels(_) | Kept::Graph(..) => false,
            Kept::Nothing(..) => true,
            Kept::Earlier(earlier) => earlier.is_by_other(search),
        };
        is_by_other.then(|| substitute_for(self.motion))
    }

    /// Labels at corners share what does not depend on k.
    fn for_k(
        &self,
        setup: Setup,
        space: &Space,
        source: Source<'_>,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let beside = match &self.kept {
            Kept::Labels(Labeled { labels, .. }) if P::SHARES_SIGHT => Some(&**labels),
            _ => None,
        };
        let substitute = |setup: Setup, source: Source<'_>| {
            let shared = match &self.kept {
                Kept::Nothing(_, known) if self.substitute() == Some(setup.engine.kind()) => {
                    known.for_k(setup, space, source)?
                }
                _ => None,
            };
            shared.map_or_else(|| prepare(setup, space, source), Ok)
        };
        let free = &P::layers(space, Engine::Subgoal)?.free;
        shared(Self::new(self.own, setup.motion, free, (source, beside), substitute)).map(Some)
    }

    fn as_prepared(&self) -> Option<ConfiguredEngine> {
        Some(ConfiguredEngine::Subgoal(self.own))
    }

    fn levels(&self) -> Option<Levels> {
        match &self.kept {
            Kept::Labels(_) => Some(Levels::Labels),
            Kept::Graph(_, graph) => Some(graph.hierarchy().into()),
            Kept::Nothing(..) => None,
            Kept::Earlier(earlier) => Some(earlier.levels),
        }
    }

    fn labels(&self) -> Option<&dyn HasLabels> {
        match &self.kept {
            Kept::Labels(labeled) => Some(labeled),
            Kept::Earlier(earlier) => earlier.labels(),
            Kept::Graph(..) | Kept::Nothing(..) => None,
        }
    }

    fn substitute(&self) -> Option<Engine> {
        match &self.kept {
            Kept::Labels(_) | Kept::Graph(..) | Kept::Earlier(EarlierIndex { map: Some(_), .. }) => None,
            Kept::Nothing(..) | Kept::Earlier(_) => Some(substitute_for(self.motion)),
        }
    }

    fn is_for_one_path(&self) -> bool {
        match &self.kept {
            Kept::Labels(_) | Kept::Graph(..) | Kept::Earlier(_) => false,
            Kept::Nothing(_, substitute) => substitute.is_for_one_path(),
        }
    }
}

/// Prepares the subgoals of a free space, beside hub labels for another k if there are some. `other` searches
/// where subgoals do not pay.
fn prepared<P: SubgoalPlacement>(
    SubgoalOptions { levels, memory }: SubgoalOptions,
    other: Setup,
    space: &FreeSpace<P>,
    source: Source<'_>,
    beside: Option<&HubLabels<P>>,
) -> Result<PreparedSubgoals<P>, Error> {
    let Source { progress, interrupt, .. } = source;
    let k = other.k();
    let most = |default: Memory| memory.unwrap_or(default).as_usize();
    let Some(levels) = levels else {
        let grid = space.grid();
        let most = most(Memory::for_labels_of(grid.width(), grid.height()));
        // Made only if it is asked.
        let mut search = None;
        let mut counted = |query: Ends| {
            let search = match &mut search {
                Some(search) => search,
                none => match search_in(space, other, interrupt) {
                    Ok(search) => none.insert(search),
                    // Asked again, so that it is known what stopped it.
                    Err(_) => return interrupt.check("comparing engines").map(|()| None),
                },
            };
            Ok(count_work(&mut Dynamic(&mut **search), query, interrupt)?.ok())
        };
        let (progress, counted) = ((&progress, interrupt), &mut counted);
        return Ok(PreparedSubgoals::within(space, k, beside, most, progress, counted)?);
    };
    let most = most(Memory::MAX);
    Ok(match (levels.hierarchy(), beside) {
        (Some(hierarchy), _) => {
            let graph = SubgoalGraph::with_progress(space, k, hierarchy, &progress, interrupt)?;
            PreparedSubgoals::Contracted(graph)
        }
        (None, None) => PreparedSubgoals::Labels(HubLabels::within(space, k, most, &progress, interrupt)?),
        (None, Some(labels)) => PreparedSubgoals::Labels(labels.for_k(space, k, most, &progress, interrupt)?),
    })
}

/// Hub labels with labels of vertices besides, for which they use the memory that was named.
fn with_vertices<P: SubgoalPlacement>(
    prepared: PreparedSubgoals<P>,
    memory: Option<Memory>,
    space: &FreeSpace<P>,
    Source { progress, interrupt, .. }: Source<'_>,
) -> Result<PreparedSubgoals<P>, Error> {
    Ok(match (prepared, memory) {
        (PreparedSubgoals::Labels(labels), Some(memory)) => {
            PreparedSubgoals::Labels(labels.with_vertices(space, memory.as_usize(), &progress, interrupt)?)
        }
        (prepared, _) => prepared,
    })
}

/// A search of a setup in a space of its own, which goes with it: Anya as the typed crate measures it, with
/// no dead ends left out.
fn search_in<P: SubgoalPlacement>(
    space: &FreeSpace<P>,
    setup: Setup,
    interrupt: &Interrupt,
) -> Result<Boxed, Error> {
    let space = Space::new(&Map::from(Arc::clone(space.grid())), setup.motion, interrupt)?;
    let source = Source { for_one_path: true, interrupt, ..Source::new(&|_| {}) };
    let index = prepare(setup, &space, source)?;
    memory_check::check("the planner", index.scratch_bytes() as u64)?;
    index.search()
}

/// The index of the engine that searches where labels of an earlier map do not prove the answer.
fn other_anew(motion: Motion, space: &Space, interrupt: &Interrupt) -> Result<Arc<dyn EngineIndex>, Error> {
    let setup = Setup::new(substitute_for(motion), motion);
    prepare(setup, space, Source { interrupt, ..Source::new(&|_| {}) })
}

/// The engine that searches where no subgoals were kept: the best that prepares little.
fn substitute_for(motion: Motion) -> Engine {
    Choice::for_some_paths(motion).engine
}
