//! The engines: a module for each family prepares an index and makes the searches on it, behind one trait.
//!
//! Without the feature `all-engines` only the options of most of them are compiled.
//!
//! How often a search is compiled decides how long the crate takes to build. So only A* is compiled for every
//! heuristic; the other engines are compiled for one type, [`Admissible`](crate::heuristic::Admissible), that
//! tells heuristics apart at run time.

mod anya;
mod canonical;
mod clusters;
#[cfg(feature = "costs")]
mod costs;
mod earlier;
mod grid_search;
mod jps_plus;
mod jumps;
mod landmarks;
mod segments;
mod source;
mod subgoal_theta;
mod subgoals;
mod theta;
#[cfg(feature = "walking")]
mod walking;

use std::{any::Any, num::NonZeroU32, sync::Arc};

#[cfg(feature = "all-engines")]
use mediant_grid::Centers;
use mediant_grid::{Corners, Interrupt, Interrupted};
use mediant_search::Planner as Search;

pub(crate) use self::source::Source;
use self::{anya::AnyaIndex, canonical::CanonicalIndex, grid_search::GridSearchIndex, jumps::JumpIndex};
pub use self::{
    canonical::CanonicalOptions, clusters::HpaOptions, grid_search::GuidedOptions, jps_plus::JpsPlusOptions,
    jumps::JumpOptions, landmarks::LandmarkOptions, segments::ChpaOptions,
    subgoal_theta::SubgoalThetaOptions, subgoals::SubgoalOptions,
};
#[cfg(feature = "all-engines")]
use self::{
    clusters::ClusterIndex, segments::SegmentIndex, subgoal_theta::SubgoalThetaIndex, subgoals::SubgoalIndex,
    theta::ThetaIndex,
};
use crate::{
    change::Change,
    configured::ConfiguredEngine,
    engine::Engine,
    erased::Erased,
    error::Error,
    labeled::HasLabels,
    option::Levels,
    setup::Setup,
    setup_error::SetupError,
    space::{Placed, PlacementOfSpace as _, Space},
};

/// A search with scratch memory of its own.
pub(crate) type Boxed = Box<dyn Erased + Send>;

/// Erases the type of a search.
fn boxed(search: impl Search + Send + 'static) -> Boxed {
    Box::new(search)
}

/// Lets a search follow to another map, if it is of this type.
fn following<S: Search + 'static, E: Into<Error>>(
    search: &mut Boxed,
    follow: impl FnOnce(&mut S) -> Result<(), E>,
) -> Result<bool, Error> {
    let search: &mut dyn Any = &mut **search;
    let Some(search) = search.downcast_mut() else { return Ok(false) };
    follow(search).map(|()| true).map_err(Into::into)
}

/// An engine with its options, and what it has prepared of a space: what makes the searches of planners.
/// It never changes. The methods with a body are for engines that save, repair or share what they prepare.
pub(crate) trait EngineIndex: Send + Sync {
    /// A search with scratch memory of its own.
    fn search(&self) -> Result<Boxed, Error>;

    /// Makes a search of an index with the same options one of this index, which keeps its scratch memory and
    /// nothing else. Returns whether it did: a search of another type needs a new one in its place. After an
    /// error it is what it was.
    fn follow(&self, search: &mut Boxed) -> Result<bool, Error>;

    /// The scratch memory that a search takes when it is made, in bytes.
    fn scratch_bytes(&self) -> usize;

    /// The same index with other options of its engine; `None` for another engine. It is an error if the
    /// index was prepared by other options.
    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error>;

    /// The memory that is used beyond the space, in bytes.
    fn memory_bytes(&self) -> usize {
        0
    }

    /// The bytes of a saved index; `None` for an engine whose index is not saved.
    fn to_bytes(&self, _interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        Ok(None)
    }

    /// The index of a space of the same map and rules with the setup's k, which shares what does not depend
    /// on k; `None` if nothing can be shared.
    fn for_k(
        &self,
        _setup: Setup,
        _space: &Space,
        _source: Source<'_>,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        Ok(None)
    }

    /// The index for the space after a change of a map of the same size; `None` if it must be prepared anew.
    fn repaired(
        &self,
        _change: &Change,
        _interrupt: &Interrupt,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        Ok(None)
    }

    /// The same index in the form that it has after a repair, so that searches follow from one to the other;
    /// `None` if that is this form.
    fn ready_for_changes(
        &self,
        _space: &Space,
        _interrupt: &Interrupt,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        Ok(None)
    }

    /// Whether nothing is left to make after a repair.
    fn is_finished(&self) -> bool {
        true
    }

    /// The engine that answered the last query of a search in place of the one that was asked for.
    fn answered_by(&self, _search: &Boxed) -> Option<Engine> {
        self.substitute()
    }

    /// The engine with the options by which the index could be prepared again; `None` if no option decides
    /// what is prepared.
    fn as_prepared(&self) -> Option<ConfiguredEngine> {
        None
    }

    /// The levels of its subgoal graph or clusters, or hub labels.
    fn levels(&self) -> Option<Levels> {
        None
    }

    /// The side of its lowest clusters or of its segments, in cells.
    fn side(&self) -> Option<u32> {
        None
    }

    /// The number of its landmarks.
    fn landmarks(&self) -> Option<NonZeroU32> {
        None
    }

    /// Its hub labels.
    fn labels(&self) -> Option<&dyn HasLabels> {
        None
    }

    /// The engine that searches in place of the one that was asked for, which kept nothing.
    fn substitute(&self) -> Option<Engine> {
        None
    }

    /// Whether it left out what does not pay for a single path.
    fn is_for_one_path(&self) -> bool {
        false
    }
}

/// Prepares the index of a setup's engine, or reads a saved one. This is the only place where all engines are
/// told apart.
pub(crate) fn prepare(
    setup: Setup,
    space: &Space,
    source: Source<'_>,
) -> Result<Arc<dyn EngineIndex>, Error> {
    use ConfiguredEngine as E;
    /// For an engine that takes both placements.
    macro_rules! either {
        ($layers:ident => $index:expr) => {
            match space.placed() {
                Placed::Centers($layers) => shared($index),
                Placed::Corners($layers) => shared($index),
            }
        };
    }
    #[cfg(feature = "costs")]
    if let E::Landmarks(own) = setup.engine {
        return shared(landmarks::LandmarkIndex::new(space, own, source));
    }
    #[cfg(feature = "costs")]
    if let Some(surface) = space.surface() {
        return shared(costs::CostIndex::new(space, surface, setup.engine));
    }
    #[cfg(feature = "walking")]
    if let Some(walk) = space.walk() {
        return shared(walking::WalkingIndex::new(space, walk, setup.engine));
    }
    let (k, engine) = (setup.finite_k(), setup.engine.kind());
    match setup.engine {
        E::AStar(own) => either!(layers => GridSearchIndex::a_star(layers.graph(k?)?, own)),
        E::Dijkstra => either!(layers => GridSearchIndex::dijkstra(layers.graph(k?)?)),
        #[cfg(feature = "all-engines")]
        E::Wavefront => either!(layers => GridSearchIndex::wavefront(layers.graph(k?)?)),
        E::Canonical(own) => either!(layers => CanonicalIndex::new(layers.graph(k?)?, own, source)),
        E::Jps(own) => either!(layers => JumpIndex::stepwise(layers.graph(k?)?, own, source)),
        E::JpsBlock(own) => either!(layers => JumpIndex::by_blocks(layers.graph(k?)?, own, source)),
        #[cfg(feature = "all-engines")]
        E::JpsPlus(own) => either!(layers => JumpIndex::by_table(layers.graph(k?)?, own, source)),
        #[cfg(feature = "all-engines")]
        E::Theta(own) => either!(layers => ThetaIndex::new(layers.graph(k?)?, own)),
        #[cfg(feature = "all-engines")]
        E::LazyTheta(own) => either!(layers => ThetaIndex::lazy(layers.graph(k?)?, own)),
        E::Anya => shared(AnyaIndex::new(&Corners::layers(space, engine)?.free, setup.k(), source)),
        #[cfg(feature = "all-engines")]
        E::Subgoal(own) => either!(layers => {
            let substitute = |setup, source: Source<'_>| prepare(setup, space, source);
            SubgoalIndex::new(own, setup.motion, &layers.free, (source, None), substitute)
        }),
        #[cfg(feature = "all-engines")]
        E::SubgoalTheta(own) => {
            shared(SubgoalThetaIndex::new(own, setup.k(), &Corners::layers(space, engine)?.free, source))
        }
        #[cfg(feature = "all-engines")]
        E::Hpa(own) => shared(ClusterIndex::new(own, Centers::layers(space, engine)?.graph(k?)?, source)),
        #[cfg(feature = "all-engines")]
        E::Chpa(own) => shared(SegmentIndex::new(own, Centers::layers(space, engine)?.graph(k?)?, source)),
        #[cfg(feature = "all-engines")]
        E::Landmarks(_) => Err(SetupError::NotBuilt { engine }.into()),
        #[cfg(not(feature = "all-engines"))]
        _ => Err(SetupError::NotBuilt { engine }.into()),
    }
}

fn shared(index: Result<impl EngineIndex + 'static, Error>) -> Result<Arc<dyn EngineIndex>, Error> {
    Ok(Arc::new(index?))
}

/// The same for other options.
fn with_options(
    index: Result<impl EngineIndex + 'static, Error>,
) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
    shared(index).map(Some)
}

/// Checks that an index has the side that the options name.
fn check_side(named: Option<NonZeroU32>, found: u32) -> Result<(), Error> {
    match named.map(NonZeroU32::get) {
        Some(expected) if expected != found => Err(Error::Side { expected, found }),
        _ => Ok(()),
    }
}

/// Checks that an index has the levels that the options name. More levels than there can be are all levels:
/// subgoal graphs have one word for both.
fn check_levels(named: Option<Levels>, found: Option<Levels>) -> Result<(), Error> {
    let same = |levels| if levels == Levels::Number(NonZeroU32::MAX) { Levels::All } else { levels };
    match named {
        Some(expected) if found.map(same) != Some(same(expected)) => Err(Error::Levels { expected, found }),
        _ => Ok(()),
    }
}

/// Checks that levels are a number of levels, or all.
fn check_counted(engine: Engine, levels: Option<Levels>) -> Result<(), SetupError> {
    let option = match levels {
        Some(Levels::Contracted) => "contraction hierarchy",
        Some(Levels::Labels) => "hub labels",
        Some(Levels::Number(_) | Levels::All) | None => return Ok(()),
    };
    Err(SetupError::Option { engine, option, others: Engine::Subgoal.to_string() })
}
