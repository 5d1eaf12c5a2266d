//! The engines with their options.
//!
//! Each engine's options are a struct, and `ConfiguredEngine::slots` pairs each field with the description of
//! its option. Setups as text, the program's flags and its records know the options of an engine from that
//! list alone.

use std::num::NonZeroU32;

use mediant_hierarchy::{Clustering, FallbackPolicy, SegmentGraph};

use crate::{
    engine::Engine,
    option::{
        EngineOption, HeuristicName, Levels, Memory, OptionValue, Variant,
        description::{
            DETOUR, HEURISTIC, JUMP_LIMIT, KEEP_INTERMEDIATE, LEVELS, MEMORY, SECOND, SIDE, STEP,
            UNSTRAIGHTENED, VARIANT,
        },
    },
    setup_error::SetupError,
};

/// An engine with its options. An option that is `None` or false is left out: it has its default.
///
/// ```
/// use std::num::NonZeroU32;
/// use mediant::{ConfiguredEngine, Engine, JumpOptions};
///
/// let engine = ConfiguredEngine::Jps(JumpOptions { jump_limit: NonZeroU32::new(16), ..JumpOptions::default()
/// }); assert_eq!(engine.kind(), Engine::Jps);
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
}

/// Options of a search that takes only a heuristic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct GuidedOptions {
    /// The heuristic; h_k by default.
    pub heuristic: Option<HeuristicName>,
}

/// Options of canonical A*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct CanonicalOptions {
    /// The heuristic; h_k by default.
    pub heuristic: Option<HeuristicName>,
    /// [`Variant::Exact`] (the default) or [`Variant::Paper`].
    pub variant: Option<Variant>,
}

/// Options of JPS, scanning vertex by vertex or block by block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct JumpOptions {
    /// The heuristic; h_k by default.
    pub heuristic: Option<HeuristicName>,
    /// The most steps that a jump may take; unlimited by default.
    pub jump_limit: Option<NonZeroU32>,
    /// Whether to keep intermediate jump points, at which a path only turns on its way to another jump point.
    pub keep_intermediate: bool,
}

/// Options of JPS+.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct JpsPlusOptions {
    /// The heuristic; h_k by default.
    pub heuristic: Option<HeuristicName>,
    /// Whether to keep intermediate jump points, at which a path only turns on its way to another jump point.
    pub keep_intermediate: bool,
}

/// Options of subgoals.
///
/// Whatever they are, paths are optimal. If no levels are named, the map decides: hub labels if they fit in
/// `memory`, else a contraction hierarchy; where that would be slow, as on noise, nothing is kept, and
/// another engine searches ([`Index::searched_by`](crate::Index::searched_by)).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SubgoalOptions {
    /// The levels of the graph, a contraction hierarchy, or hub labels; by default the map decides.
    pub levels: Option<Levels>,
    /// The memory that hub labels may take. By default that of [`Memory::for_labels_of`] if no levels are
    /// named, and as much as they need if [`Levels::Labels`] are named.
    pub memory: Option<Memory>,
}

/// Options of Sub-Theta*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SubgoalThetaOptions {
    /// The levels of the graph; 2 by default.
    pub levels: Option<Levels>,
}

/// Options of HPA*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct HpaOptions {
    /// The number of levels of clusters; that of [`Clustering::default`] by default.
    pub levels: Option<Levels>,
    /// The side of the lowest clusters, in cells; that of [`Clustering::default`] by default.
    pub side: Option<NonZeroU32>,
    /// Whether to leave out the straightening of paths.
    pub unstraightened: bool,
}

/// Options of CHPA*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ChpaOptions {
    /// The heuristic of the first phase; h_k by default.
    pub heuristic: Option<HeuristicName>,
    /// [`Variant::Complete`] (the default) or [`Variant::Paper`].
    pub variant: Option<Variant>,
    /// The side of the segments, in cells; 3, as in the paper, by default.
    pub side: Option<NonZeroU32>,
    /// The heuristic of the second phase; that of the first by default.
    pub second: Option<HeuristicName>,
    /// Every how many segments there is a checkpoint (Pstep of Teleiša & Čalnerytė 2023); 2 by default.
    pub step: Option<NonZeroU32>,
    /// How many times h_k the path to a checkpoint may cost before the search skips that checkpoint; that of
    /// [`FallbackPolicy::default`] by default. Only for [`Variant::Complete`].
    pub detour: Option<NonZeroU32>,
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
        }
    }

    /// The options that the engine takes, each with the field that holds it, in the order of a setup's text.
    fn slots(&mut self) -> Vec<(&'static EngineOption, Slot<'_>)> {
        match self {
            Self::Dijkstra | Self::Wavefront | Self::Anya => Vec::new(),
            Self::AStar(own) | Self::Theta(own) | Self::LazyTheta(own) => {
                vec![(&HEURISTIC, Slot::Heuristic(&mut own.heuristic))]
            }
            Self::Canonical(own) => vec![
                (&HEURISTIC, Slot::Heuristic(&mut own.heuristic)),
                (&VARIANT, Slot::Variant(&mut own.variant)),
            ],
            Self::Jps(own) | Self::JpsBlock(own) => vec![
                (&HEURISTIC, Slot::Heuristic(&mut own.heuristic)),
                (&JUMP_LIMIT, Slot::Number(&mut own.jump_limit)),
                (&KEEP_INTERMEDIATE, Slot::Flag(&mut own.keep_intermediate)),
            ],
            Self::JpsPlus(own) => vec![
                (&HEURISTIC, Slot::Heuristic(&mut own.heuristic)),
                (&KEEP_INTERMEDIATE, Slot::Flag(&mut own.keep_intermediate)),
            ],
            Self::Subgoal(own) => {
                vec![(&LEVELS, Slot::Levels(&mut own.levels)), (&MEMORY, Slot::Memory(&mut own.memory))]
            }
            Self::SubgoalTheta(own) => vec![(&LEVELS, Slot::Levels(&mut own.levels))],
            Self::Hpa(own) => vec![
                (&LEVELS, Slot::Levels(&mut own.levels)),
                (&SIDE, Slot::Number(&mut own.side)),
                (&UNSTRAIGHTENED, Slot::Flag(&mut own.unstraightened)),
            ],
            Self::Chpa(own) => vec![
                (&HEURISTIC, Slot::Heuristic(&mut own.heuristic)),
                (&VARIANT, Slot::Variant(&mut own.variant)),
                (&SIDE, Slot::Number(&mut own.side)),
                (&SECOND, Slot::Heuristic(&mut own.second)),
                (&STEP, Slot::Number(&mut own.step)),
                (&DETOUR, Slot::Number(&mut own.detour)),
            ],
        }
    }

    /// The options that the engine takes.
    #[must_use]
    pub fn options(mut self) -> Vec<&'static EngineOption> {
        self.slots().into_iter().map(|(option, _)| option).collect()
    }

    /// The options that were chosen, with their values, in the order of a setup's text.
    #[must_use]
    pub fn chosen(mut self) -> Vec<(&'static EngineOption, OptionValue)> {
        self.slots().into_iter().filter_map(|(option, slot)| Some((option, slot.get()?))).collect()
    }

    /// Chooses an option.
    ///
    /// # Errors
    /// [`SetupError::Option`] for an option that the engine does not take, or a value of another kind than
    /// the option's.
    pub fn set(&mut self, option: &EngineOption, value: OptionValue) -> Result<(), SetupError> {
        let engine = self.kind();
        let slot = self.slots().into_iter().find(|(known, _)| known.name == option.name);
        let is_set = slot.is_some_and(|(_, slot)| slot.set(value));
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
        let name = option.name;
        match () {
            () if name == HEURISTIC.name => self.heuristic().map(OptionValue::Heuristic),
            () if name == VARIANT.name => self.variant().map(OptionValue::Variant),
            () if name == LEVELS.name => self.levels().map(OptionValue::Levels),
            () if name == SIDE.name => self.side().map(OptionValue::Number),
            () if name == SECOND.name => self.second().map(OptionValue::Heuristic),
            () if name == STEP.name => self.step().map(OptionValue::Number),
            () if name == DETOUR.name => self.detour().map(OptionValue::Number),
            () => self.chosen().into_iter().find(|(chosen, _)| chosen.name == name).map(|(_, value)| value),
        }
    }

    /// Checks that the engine takes the chosen values, and that they fit together.
    pub(crate) fn check(self) -> Result<(), SetupError> {
        let (kind, chosen) = (self.kind(), self.chosen());
        let refused = |option: &EngineOption, what, takes: &dyn Fn(Engine) -> bool| {
            Err(SetupError::Option { engine: kind, option: what, others: names_of_takers(option, takes) })
        };
        for &(option, value) in &chosen {
            match value {
                OptionValue::Heuristic(HeuristicName::SquaredEuclidean)
                    if !kind.capabilities().overestimates =>
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
                    return refused(option, what, &takes);
                }
                OptionValue::Levels(Levels::Contracted) if kind != Engine::Subgoal => {
                    return refused(option, "contraction hierarchy", &|kind| kind == Engine::Subgoal);
                }
                OptionValue::Levels(Levels::Labels) if kind != Engine::Subgoal => {
                    return refused(option, "hub labels", &|kind| kind == Engine::Subgoal);
                }
                _ => {}
            }
        }
        match self {
            Self::Chpa(ChpaOptions { variant: Some(Variant::Paper), detour: Some(_), .. }) => {
                Err(SetupError::DetourAsPublished { engine: kind })
            }
            Self::Subgoal(SubgoalOptions { levels: Some(levels), memory: Some(_) })
                if levels != Levels::Labels =>
            {
                Err(SetupError::MemoryWithoutLabels { levels })
            }
            _ => Ok(()),
        }
    }

    /// The heuristic that guides the search, also where the engine leaves no choice: zero for Dijkstra and
    /// wavefront. `None` for an engine with a heuristic of its own kind.
    #[must_use]
    pub fn heuristic(self) -> Option<HeuristicName> {
        let chosen = match self {
            Self::Dijkstra | Self::Wavefront => Some(HeuristicName::Zero),
            Self::Anya | Self::Subgoal(_) | Self::SubgoalTheta(_) | Self::Hpa(_) => return None,
            Self::AStar(own) | Self::Theta(own) | Self::LazyTheta(own) => own.heuristic,
            Self::Canonical(own) => own.heuristic,
            Self::Jps(own) | Self::JpsBlock(own) => own.heuristic,
            Self::JpsPlus(own) => own.heuristic,
            Self::Chpa(own) => own.heuristic,
        };
        Some(chosen.unwrap_or_default())
    }

    /// The variant; `None` for an engine that has only one.
    #[must_use]
    pub fn variant(self) -> Option<Variant> {
        match self {
            Self::Canonical(own) => Some(own.variant.unwrap_or(Variant::Exact)),
            Self::Chpa(own) => Some(own.variant.unwrap_or(Variant::Complete)),
            _ => None,
        }
    }

    /// The levels of the subgoal graph or of the clusters; `None` for an engine that has no levels, and for
    /// subgoals if the map decides.
    #[must_use]
    pub fn levels(self) -> Option<Levels> {
        match self {
            Self::Subgoal(own) => own.levels,
            Self::SubgoalTheta(own) => Some(own.levels()),
            Self::Hpa(own) => own.levels(),
            _ => None,
        }
    }

    /// The side of the lowest clusters or of the segments, in cells; `None` for an engine that has neither.
    #[must_use]
    pub fn side(self) -> Option<NonZeroU32> {
        match self {
            Self::Hpa(own) => own.side.or(NonZeroU32::new(Clustering::default().side)),
            Self::Chpa(own) => own.side.or(NonZeroU32::new(SegmentGraph::PAPER_SIDE)),
            _ => None,
        }
    }

    /// The heuristic of the second phase; `None` for an engine that has only one phase.
    #[must_use]
    pub fn second(self) -> Option<HeuristicName> {
        match self {
            Self::Chpa(own) => Some(own.heuristics()[1]),
            _ => None,
        }
    }

    /// There is a checkpoint every so many segments; `None` for an engine without checkpoints.
    #[must_use]
    pub fn step(self) -> Option<NonZeroU32> {
        match self {
            Self::Chpa(own) => Some(own.step()),
            _ => None,
        }
    }

    /// How many times h_k the path to a checkpoint may cost; `None` for an engine without such a limit.
    #[must_use]
    pub fn detour(self) -> Option<NonZeroU32> {
        let Self::Chpa(own) = self else { return None };
        match own.fallback_policy() {
            FallbackPolicy::Complete { detour } => Some(detour),
            FallbackPolicy::Paper => None,
        }
    }
}

impl SubgoalThetaOptions {
    /// The levels of the graph.
    pub(crate) fn levels(self) -> Levels {
        self.levels.unwrap_or(Levels::Number(TWO))
    }
}

impl HpaOptions {
    /// The clusters that they name.
    pub(crate) fn clustering(self) -> Clustering {
        let default = Clustering::default();
        let side = self.side.map_or(default.side, NonZeroU32::get);
        let levels = match self.levels {
            Some(Levels::Number(number)) => number.get(),
            // Each level's clusters are twice as long as those of the one below.
            Some(Levels::All) => (Clustering::MAX_SIDE / side).checked_ilog2().unwrap_or(0) + 1,
            _ => default.levels,
        };
        Clustering { side, levels }
    }

    /// The levels of the clusters.
    fn levels(self) -> Option<Levels> {
        NonZeroU32::new(self.clustering().levels).map(Levels::Number)
    }
}

impl ChpaOptions {
    /// The heuristics of the first and of the second phase.
    pub(crate) fn heuristics(self) -> [HeuristicName; 2] {
        let first = self.heuristic.unwrap_or_default();
        [first, self.second.unwrap_or(first)]
    }

    /// Every how many segments there is a checkpoint.
    pub(crate) fn step(self) -> NonZeroU32 {
        self.step.unwrap_or(TWO)
    }

    /// The search's fallback where its plan fails.
    pub(crate) fn fallback_policy(self) -> FallbackPolicy {
        match self.detour {
            _ if self.variant == Some(Variant::Paper) => FallbackPolicy::Paper,
            Some(detour) => FallbackPolicy::Complete { detour },
            None => FallbackPolicy::default(),
        }
    }
}

/// The field of an engine that holds the value of an option.
#[derive(Debug)]
enum Slot<'e> {
    Flag(&'e mut bool),
    Number(&'e mut Option<NonZeroU32>),
    Heuristic(&'e mut Option<HeuristicName>),
    Variant(&'e mut Option<Variant>),
    Levels(&'e mut Option<Levels>),
    Memory(&'e mut Option<Memory>),
}

impl Slot<'_> {
    /// The value, if it was chosen.
    fn get(&self) -> Option<OptionValue> {
        match self {
            Self::Flag(is_set) => is_set.then_some(OptionValue::Flag),
            Self::Number(number) => number.map(OptionValue::Number),
            Self::Heuristic(name) => name.map(OptionValue::Heuristic),
            Self::Variant(variant) => variant.map(OptionValue::Variant),
            Self::Levels(levels) => levels.map(OptionValue::Levels),
            Self::Memory(memory) => memory.map(OptionValue::Memory),
        }
    }

    /// Chooses a value. Returns false if it is of another kind than the field.
    fn set(self, value: OptionValue) -> bool {
        match (self, value) {
            (Self::Flag(slot), OptionValue::Flag) => *slot = true,
            (Self::Number(slot), OptionValue::Number(number)) => *slot = Some(number),
            (Self::Heuristic(slot), OptionValue::Heuristic(name)) => *slot = Some(name),
            (Self::Variant(slot), OptionValue::Variant(variant)) => *slot = Some(variant),
            (Self::Levels(slot), OptionValue::Levels(levels)) => *slot = Some(levels),
            (Self::Memory(slot), OptionValue::Memory(memory)) => *slot = Some(memory),
            _ => return false,
        }
        true
    }
}

/// The names of the engines that take an option and satisfy a condition.
fn names_of_takers(option: &EngineOption, condition: impl Fn(Engine) -> bool) -> String {
    let takes = |kind| ConfiguredEngine::from(kind).options().iter().any(|taken| taken.name == option.name);
    Engine::names_where(|kind| takes(kind) && condition(kind))
}

const TWO: NonZeroU32 = NonZeroU32::MIN.saturating_add(1);
