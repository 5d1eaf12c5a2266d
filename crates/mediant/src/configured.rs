//! The engines with their options.
//!
//! Each engine's options are a struct in the engine's module.

use std::num::NonZeroU32;

#[cfg(feature = "publications")]
use crate::option::{
    Variant,
    published::{DETOUR, SECOND, STEP, VARIANT},
};
use crate::{
    engine::Engine,
    engines::{
        CanonicalOptions, ChpaOptions, GuidedOptions, HpaOptions, JpsPlusOptions, JumpOptions,
        LandmarkOptions, SubgoalOptions, SubgoalThetaOptions,
    },
    option::{
        EngineOption, HeuristicName, Levels, OptionValue,
        slot::{Options, Slot},
        table::{HEURISTIC, LANDMARKS, LEVELS, SIDE},
    },
    setup_error::SetupError,
};

/// An engine with its options. An option that is `None` or false is left out: it has its default.
///
/// ```
/// use std::num::NonZeroU32;
/// use mediant::{Engine, options::{ConfiguredEngine, HpaOptions}};
///
/// let large = HpaOptions { side: NonZeroU32::new(16), ..HpaOptions::default() };
/// assert_eq!(ConfiguredEngine::Hpa(large).kind(), Engine::Hpa);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each variant is documented as an `Engine`")]
pub enum ConfiguredEngine {
    AStar(GuidedOptions),
    Dijkstra,
    Wavefront,
    Canonical(CanonicalOptions),
    Jps(JumpOptions),
    JpsBlock(JumpOptions),
    JpsPlus(JpsPlusOptions),
    Theta(GuidedOptions),
    LazyTheta(GuidedOptions),
    Anya,
    Subgoal(SubgoalOptions),
    SubgoalTheta(SubgoalThetaOptions),
    Hpa(HpaOptions),
    Chpa(ChpaOptions),
    Landmarks(LandmarkOptions),
}

impl Default for ConfiguredEngine {
    fn default() -> Self {
        Engine::default().into()
    }
}

/// The engine with its default options.
impl From<Engine> for ConfiguredEngine {
    fn from(kind: Engine) -> Self {
        match kind {
            Engine::AStar => Self::AStar(GuidedOptions::default()),
            Engine::Dijkstra => Self::Dijkstra,
            Engine::Wavefront => Self::Wavefront,
            Engine::Canonical => Self::Canonical(CanonicalOptions::default()),
            Engine::Jps => Self::Jps(JumpOptions::default()),
            Engine::JpsBlock => Self::JpsBlock(JumpOptions::default()),
            Engine::JpsPlus => Self::JpsPlus(JpsPlusOptions::default()),
            Engine::Theta => Self::Theta(GuidedOptions::default()),
            Engine::LazyTheta => Self::LazyTheta(GuidedOptions::default()),
            Engine::Anya => Self::Anya,
            Engine::Subgoal => Self::Subgoal(SubgoalOptions::default()),
            Engine::SubgoalTheta => Self::SubgoalTheta(SubgoalThetaOptions::default()),
            Engine::Hpa => Self::Hpa(HpaOptions::default()),
            Engine::Chpa => Self::Chpa(ChpaOptions::default()),
            Engine::Landmarks => Self::Landmarks(LandmarkOptions::default()),
        }
    }
}

impl ConfiguredEngine {
    /// The engine without its options.
    #[must_use]
    pub const fn kind(self) -> Engine {
        match self {
            Self::AStar(_) => Engine::AStar,
            Self::Dijkstra => Engine::Dijkstra,
            Self::Wavefront => Engine::Wavefront,
            Self::Canonical(_) => Engine::Canonical,
            Self::Jps(_) => Engine::Jps,
            Self::JpsBlock(_) => Engine::JpsBlock,
            Self::JpsPlus(_) => Engine::JpsPlus,
            Self::Theta(_) => Engine::Theta,
            Self::LazyTheta(_) => Engine::LazyTheta,
            Self::Anya => Engine::Anya,
            Self::Subgoal(_) => Engine::Subgoal,
            Self::SubgoalTheta(_) => Engine::SubgoalTheta,
            Self::Hpa(_) => Engine::Hpa,
            Self::Chpa(_) => Engine::Chpa,
            Self::Landmarks(_) => Engine::Landmarks,
        }
    }

    /// The engine's own options; `None` for an engine that takes none.
    fn own(&mut self) -> Option<&mut dyn Options> {
        match self {
            Self::Dijkstra | Self::Wavefront | Self::Anya => None,
            Self::AStar(own) | Self::Theta(own) | Self::LazyTheta(own) => Some(own),
            Self::Canonical(own) => Some(own),
            Self::Jps(own) | Self::JpsBlock(own) => Some(own),
            Self::JpsPlus(own) => Some(own),
            Self::Subgoal(own) => Some(own),
            Self::SubgoalTheta(own) => Some(own),
            Self::Hpa(own) => Some(own),
            Self::Chpa(own) => Some(own),
            Self::Landmarks(own) => Some(own),
        }
    }

    fn slots(&mut self) -> Vec<Slot<'_>> {
        self.own().map_or_else(Vec::new, Options::slots)
    }

    /// The options that the engine takes.
    #[must_use]
    pub fn options(mut self) -> Vec<&'static EngineOption> {
        self.slots().into_iter().map(|slot| slot.option).collect()
    }

    /// The options that were chosen, with their values, in the order of a setup's text.
    #[must_use]
    pub fn chosen(mut self) -> Vec<(&'static EngineOption, OptionValue)> {
        self.slots().into_iter().filter_map(|slot| Some((slot.option, slot.field.get()?))).collect()
    }

    /// Chooses an option.
    ///
    /// # Errors
    /// [`SetupError::Option`] for an option that the engine does not take, or a value of another kind than
    /// the option's.
    pub fn set(&mut self, option: &EngineOption, value: OptionValue) -> Result<(), SetupError> {
        let engine = self.kind();
        let slot = self.slots().into_iter().find(|slot| slot.option.name == option.name);
        let is_set = slot.is_some_and(|slot| slot.field.set(value));
        if is_set {
            return Ok(());
        }
        let others = names_of_takers(option, |_| true);
        Err(SetupError::Option { engine, option: option.noun(), others })
    }

    /// The value of an option, chosen or by default. `None` if the engine does not take the option, if it is
    /// a flag that is not set, or if its default is no value.
    #[must_use]
    pub fn value(self, option: &EngineOption) -> Option<OptionValue> {
        if option.name == HEURISTIC.name {
            return self.heuristic().map(OptionValue::Heuristic);
        }
        self.own_value(option)
    }

    /// The value of an option that the engine takes.
    fn own_value(mut self, option: &EngineOption) -> Option<OptionValue> {
        self.slots().into_iter().find(|slot| slot.option.name == option.name)?.value
    }

    /// Checks that the engine takes the chosen values, and that they fit together.
    pub(crate) fn check(mut self) -> Result<(), SetupError> {
        #[cfg(feature = "publications")]
        self.check_published()?;
        let kind = self.kind();
        self.own().map_or(Ok(()), |own| own.check(kind))
    }

    /// Checks heuristics that overestimate, and variants.
    #[cfg(feature = "publications")]
    fn check_published(self) -> Result<(), SetupError> {
        let kind = self.kind();
        for (option, value) in self.chosen() {
            match value {
                OptionValue::Heuristic(name)
                    if name.overestimates() && !kind.capabilities().overestimates =>
                {
                    return Err(SetupError::overestimates(kind));
                }
                OptionValue::Variant(variant) if !kind.capabilities().variants.contains(&variant) => {
                    let takes = |kind: Engine| kind.capabilities().variants.contains(&variant);
                    let what = match variant {
                        Variant::Exact => "variant exact",
                        Variant::Complete => "variant complete",
                        Variant::Paper => "variant paper",
                    };
                    let others = names_of_takers(option, takes);
                    return Err(SetupError::Option { engine: kind, option: what, others });
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// The heuristic that guides the search, also where the engine leaves no choice: zero for Dijkstra and
    /// wavefront. `None` for an engine with a heuristic of its own kind.
    #[must_use]
    pub fn heuristic(self) -> Option<HeuristicName> {
        match self {
            Self::Dijkstra | Self::Wavefront => Some(HeuristicName::Zero),
            _ => self.own_value(&HEURISTIC)?.heuristic(),
        }
    }

    /// The variant; `None` for an engine that has only one.
    #[cfg(feature = "publications")]
    #[must_use]
    pub fn variant(self) -> Option<Variant> {
        self.own_value(&VARIANT)?.variant()
    }

    /// The levels of the subgoal graph or of the clusters; `None` for an engine that has no levels, and for
    /// subgoals if the map decides.
    #[must_use]
    pub fn levels(self) -> Option<Levels> {
        self.own_value(&LEVELS)?.levels()
    }

    /// The side of the lowest clusters or of the segments, in cells; `None` for an engine that has neither.
    #[must_use]
    pub fn side(self) -> Option<NonZeroU32> {
        self.own_value(&SIDE)?.number()
    }

    /// The number of landmarks; `None` for an engine that has none.
    #[must_use]
    pub fn landmarks(self) -> Option<NonZeroU32> {
        self.own_value(&LANDMARKS)?.number()
    }

    /// The heuristic of the second phase; `None` for an engine that has only one phase.
    #[cfg(feature = "publications")]
    #[must_use]
    pub fn second(self) -> Option<HeuristicName> {
        self.own_value(&SECOND)?.heuristic()
    }

    /// There is a checkpoint every so many segments; `None` for an engine without checkpoints.
    #[cfg(feature = "publications")]
    #[must_use]
    pub fn step(self) -> Option<NonZeroU32> {
        self.own_value(&STEP)?.number()
    }

    /// The greatest cost of the path to a checkpoint, as a multiple of h_k; `None` for an engine without
    /// such a limit.
    #[cfg(feature = "publications")]
    #[must_use]
    pub fn detour(self) -> Option<NonZeroU32> {
        self.own_value(&DETOUR)?.number()
    }
}

/// The names of the engines that take an option and satisfy a condition.
fn names_of_takers(option: &EngineOption, condition: impl Fn(Engine) -> bool) -> String {
    let takes = |kind| ConfiguredEngine::from(kind).options().iter().any(|taken| taken.name == option.name);
    Engine::names_where(|kind| takes(kind) && condition(kind))
}
