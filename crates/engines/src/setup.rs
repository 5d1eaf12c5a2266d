//! All that makes a planner, and whether it can.

use std::num::NonZeroU32;

use mediant_grid::{CornerRule, Rules};
use mediant_hierarchy::{Clustering, FallbackPolicy};
use mediant_moves::{FiniteK, K};
use mediant_search::{Guarantee, Smoothing};
use mediant_subgoal::Hierarchy;

use crate::{About, Engine, HeuristicName, Levels, SetupError, Variant, squares::levels_of};

/// An engine, what it searches, and how.
///
/// As text `ENGINE[:K[:RULE]][,OPTION…]`: K is a number or `any`, RULE is `never`, `one` or `always` at centers, `open` or `closed` at
/// corners. Without them the problem is the scenarios' own, k = 3 at centers under `never`; at corners, which is where `any` and some engines
/// are, it is under `open`, and k is `any` for an engine of any-angle paths. The options are `euclidean`, `zero`, `squared`, `paper`,
/// `limit=N` (jumps of at most N steps), `intermediate` (jump points that are otherwise passed by), `levels=N` or `levels=all` (of a
/// subgoal graph, or of clusters), `side=N` (of a cluster or segment, in cells), `refined` (a path through clusters, not straightened),
/// `second=NAME` (the heuristic of a second phase), `step=N` (a checkpoint every N segments), `detour=N` (how many times as long the way to one may
/// be), and `smooth` or `taut` (the path made shorter afterwards).
///
/// ```
/// use mediant_engines::Setup;
/// let setup: Setup = "astar:5:open,euclidean".parse()?;
/// assert_eq!(setup.to_string(), "astar:5:open,euclidean");
/// assert_eq!("anya".parse::<Setup>()?.to_string(), "anya:any:open");
/// assert!(!setup.solves_scenarios() && "astar".parse::<Setup>()?.solves_scenarios());
/// # Ok::<(), mediant_engines::TextError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Setup {
    /// The engine.
    pub engine: Engine,
    /// The directions that it searches.
    pub k: K,
    /// The placement and its rule of motion.
    pub rules: Rules,
    /// How it searches.
    pub options: Options,
}

/// What only some engines take; all of it may be left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Options {
    /// The heuristic; h_k without it.
    pub heuristic: Option<HeuristicName>,
    /// The variant; the exact one without it.
    pub variant: Option<Variant>,
    /// The most steps of a jump.
    pub jump_limit: Option<NonZeroU32>,
    /// Whether to keep the jump points at which a path only turns on its way to another.
    pub intermediate: bool,
    /// The levels of the subgoal graph, without which it has a contraction hierarchy, or 2 levels where the engine needs levels; or those of
    /// clusters, [`Clustering::default`] without them.
    pub levels: Option<Levels>,
    /// The side of the lowest clusters or of the segments, in cells; without it that of [`Clustering::default`] or of the paper.
    pub side: Option<NonZeroU32>,
    /// Whether to leave the path as it is refined, without straightening it.
    pub refined: bool,
    /// The heuristic of the second phase; that of the first without it.
    pub second: Option<HeuristicName>,
    /// Every how many segments there is a checkpoint; 2 without it.
    pub step: Option<NonZeroU32>,
    /// How many times as long as on an empty grid the way to a checkpoint may be, or the search leaves its plan; that of
    /// [`FallbackPolicy::default`] without it.
    pub detour: Option<NonZeroU32>,
    /// How the path is made shorter afterwards, if it is.
    pub smoothing: Option<Smoothing>,
}

/// What [`Setup::all`] has of smoothed engines: paths over few and over many directions.
const SMOOTHED: [(Engine, Smoothing); 7] = [
    (Engine::AStar, Smoothing::Linear),
    (Engine::AStar, Smoothing::Taut),
    (Engine::Theta, Smoothing::Taut),
    (Engine::Anya, Smoothing::Taut),
    (Engine::Subgoal, Smoothing::Taut),
    (Engine::Hpa, Smoothing::Taut),
    (Engine::Chpa, Smoothing::Linear),
];

/// Whether something holds of an engine.
type Has = fn(About) -> bool;

impl Setup {
    /// The engine with its default options.
    #[must_use]
    pub fn new(engine: Engine, k: impl Into<K>, rules: Rules) -> Self {
        Self { engine, k: k.into(), rules, options: Options::default() }
    }

    /// All that there are for these rules and this k: each engine with its default options, and with each other one of an option;
    /// smoothed, a few. Of a finite k the first is A* with h_k; any-angle search between centers there is none.
    pub fn all(k: impl Into<K>, rules: Rules) -> impl Iterator<Item = Self> {
        let (k, options) = (k.into(), Options::default());
        let number = |number| NonZeroU32::new(number);
        let levels = |levels| number(levels).map(Levels::Number);
        let others = [
            options,
            Options { heuristic: Some(HeuristicName::Euclidean), ..options },
            Options { heuristic: Some(HeuristicName::Zero), ..options },
            Options { heuristic: Some(HeuristicName::SquaredEuclidean), ..options },
            Options { variant: Some(Variant::Paper), ..options },
            Options { jump_limit: number(2), ..options },
            Options { intermediate: true, ..options },
            Options { levels: levels(1), ..options },
            Options { levels: levels(2), ..options },
            Options { levels: Some(Levels::All), ..options },
            Options { side: number(2), ..options },
            Options { side: number(5), ..options },
            // Small clusters, so that small maps have some of each level.
            Options { side: number(3), levels: levels(3), ..options },
            Options { refined: true, ..options },
            Options { second: Some(HeuristicName::SquaredEuclidean), ..options },
            Options { step: number(1), ..options },
            Options { detour: number(1), ..options },
        ];
        let with = move |engine, options| Self { options, ..Self::new(engine, k, rules) };
        let setups =
            Engine::ALL.into_iter().flat_map(move |engine| others.map(|options| with(engine, options)));
        let smooth = |smoothing| Options { smoothing: Some(smoothing), ..Options::default() };
        let smoothed = SMOOTHED.into_iter().map(move |(engine, smoothing)| with(engine, smooth(smoothing)));
        setups.chain(smoothed).filter(|setup| setup.check().is_ok())
    }

    /// Whether the engine takes all this.
    ///
    /// # Errors
    /// [`SetupError`] for the first thing that it does not take.
    pub fn check(&self) -> Result<(), SetupError> {
        let Self { engine, k, rules, options } = *self;
        let about = engine.about();
        let overestimates = options.heuristic == Some(HeuristicName::SquaredEuclidean);
        let takes: [(bool, Has, &str); 10] = [
            (overestimates, |about| about.overestimates, "heuristic that overestimates"),
            (options.heuristic.is_some(), |about| about.heuristic, "heuristic"),
            (options.jump_limit.is_some(), |about| about.jump_limit, "jump limit"),
            (options.intermediate, |about| about.intermediate, "intermediate jump points"),
            (options.levels.is_some(), |about| about.levels, "levels"),
            (options.side.is_some(), |about| about.side, "side"),
            (options.refined, |about| about.straightens, "option refined"),
            (options.second.is_some(), |about| about.phases, "second heuristic"),
            (options.step.is_some(), |about| about.phases, "step"),
            (options.detour.is_some(), |about| about.phases, "detour"),
        ];
        if let Some(&(_, has, option)) = takes.iter().find(|(given, has, _)| *given && !has(about)) {
            return Err(SetupError::Option { engine, option, others: those(has) });
        }
        self.check_variant()?;
        match (k, about.max_k) {
            (K::Finite(k), Some(max)) if k.get() > max => return Err(SetupError::K { engine, max, k }),
            (K::Finite(k), None) => return Err(SetupError::NeedsAny { engine, k }),
            (K::Any, Some(max)) if !about.any => {
                return Err(SetupError::NeedsFiniteK { engine, max, others: those(|about| about.any) });
            }
            _ => {}
        }
        let placement = rules.placement();
        match about.placements {
            [needed] if *needed != placement => {
                let others = those(|about| about.placements.contains(&placement));
                Err(SetupError::PlacementKind { engine, needed: *needed, placement, others })
            }
            _ if !takes_both(engine, k, rules) => Err(SetupError::Centers { engine, k, rules }),
            _ => Ok(()),
        }
    }

    fn check_variant(&self) -> Result<(), SetupError> {
        let Self { engine, options: Options { variant, detour, .. }, .. } = *self;
        let variants = engine.about().variants;
        match variant {
            Some(variant) if !variants.contains(&variant) => {
                let option = match variant {
                    _ if variants.is_empty() => "variant",
                    Variant::Exact => "variant exact",
                    Variant::Complete => "variant complete",
                    Variant::Paper => "variant paper",
                };
                let others = those(|about| about.variants.contains(&variant));
                Err(SetupError::Option { engine, option, others })
            }
            Some(Variant::Paper) if detour.is_some() => Err(SetupError::DetourAsPublished { engine }),
            _ => Ok(()),
        }
    }

    /// The version of the index that the engine makes.
    ///
    /// # Errors
    /// [`SetupError::Without`] for an engine whose preprocessing is not saved.
    pub fn index_version(&self) -> Result<u32, SetupError> {
        self.engine.about().index.ok_or_else(|| without_index(self.engine))
    }

    /// The heuristic that guides the search; none of these where the search has one of its own, at any angle or on a
    /// graph of levels.
    #[must_use]
    pub fn heuristic(&self) -> Option<HeuristicName> {
        let about = self.engine.about();
        let default = if about.heuristic { HeuristicName::Hk } else { HeuristicName::Zero };
        self.k.finite().filter(|_| !about.levels).map(|_| self.options.heuristic.unwrap_or(default))
    }

    /// The heuristic that guides the second phase, of an engine that has two.
    #[must_use]
    pub fn second(&self) -> Option<HeuristicName> {
        self.heuristic()
            .filter(|_| self.engine.about().phases)
            .map(|first| self.options.second.unwrap_or(first))
    }

    /// Every how many segments there is a checkpoint (Pstep of Teleiša & Čalnerytė 2023), of an engine that plans.
    #[must_use]
    pub fn step(&self) -> Option<NonZeroU32> {
        let step = self.options.step.unwrap_or(NonZeroU32::MIN.saturating_add(1));
        self.engine.about().phases.then_some(step)
    }

    /// How many times as long as on an empty grid the way to a checkpoint may be, of an engine that otherwise leaves its plan.
    #[must_use]
    pub fn detour(&self) -> Option<NonZeroU32> {
        match self.fallback_policy() {
            FallbackPolicy::Complete { detour } if self.engine.about().phases => Some(detour),
            _ => None,
        }
    }

    pub(crate) fn fallback_policy(&self) -> FallbackPolicy {
        match self.options.detour {
            _ if self.variant() == Some(Variant::Paper) => FallbackPolicy::Paper,
            Some(detour) => FallbackPolicy::Complete { detour },
            None => FallbackPolicy::default(),
        }
    }

    /// The hierarchy of the subgoal graph or the levels of clusters, of an engine that searches such a graph.
    #[must_use]
    pub fn hierarchy(&self) -> Option<Hierarchy> {
        let chosen = self.options.levels.map(Hierarchy::from);
        match self.engine {
            Engine::Subgoal => Some(chosen.unwrap_or_default()),
            Engine::SubgoalTheta => chosen.or(NonZeroU32::new(2).map(Hierarchy::Levels)),
            Engine::Hpa => {
                let Clustering { side, levels } = Clustering::default();
                let side = self.options.side.map_or(side, NonZeroU32::get);
                levels_of(self.options.levels, side).or(NonZeroU32::new(levels)).map(Hierarchy::Levels)
            }
            _ => None,
        }
    }

    /// The variant, of an engine that has several.
    #[must_use]
    pub fn variant(&self) -> Option<Variant> {
        let default = self.engine.about().variants.first()?;
        Some(self.options.variant.unwrap_or(*default))
    }

    /// What the planner will promise.
    #[must_use]
    pub fn guarantee(&self) -> Guarantee {
        use Engine::{Anya, Chpa, Hpa, LazyTheta, SubgoalTheta, Theta, Wavefront};
        let plain = match (self.engine, self.k) {
            (Theta | LazyTheta | SubgoalTheta | Hpa | Chpa, _) => Guarantee::Suboptimal,
            _ if self.heuristic() == Some(HeuristicName::SquaredEuclidean) => Guarantee::Suboptimal,
            (Wavefront, k) if k != K::Finite(FiniteK::N4) => Guarantee::Suboptimal,
            _ if self.variant() == Some(Variant::Paper) => Guarantee::Suboptimal,
            (Anya, _) | (_, K::Any) => Guarantee::OptimalAnyAngle,
            (_, K::Finite(k)) => Guarantee::Optimal(k),
        };
        match plain {
            Guarantee::Optimal(k) if self.options.smoothing.is_some() => Guarantee::AtMost(k),
            plain => plain,
        }
    }

    /// The directions over which no path under its rules is shorter than its own; none where it does not promise that.
    #[must_use]
    pub fn optimal_over(&self) -> Option<K> {
        match self.guarantee() {
            Guarantee::Optimal(k) => Some(K::Finite(k)),
            Guarantee::OptimalAnyAngle => Some(K::Any),
            Guarantee::AtMost(_) | Guarantee::Suboptimal => None,
        }
    }

    /// The directions that its paths may take: those that it searches, or every one where it straightens what it finds.
    #[must_use]
    pub fn paths(&self) -> K {
        let straightens = matches!(self.engine, Engine::Theta | Engine::LazyTheta | Engine::SubgoalTheta);
        if straightens || self.options.smoothing.is_some() { K::Any } else { self.k }
    }

    /// Whether its paths are as long as the scenario files say: those are optimal for k = 3 at centers under `never`.
    #[must_use]
    pub fn solves_scenarios(&self) -> bool {
        self.rules == Rules::Center(CornerRule::Never) && self.optimal_over() == Some(K::Finite(FiniteK::N8))
    }
}

pub(crate) fn without_index(engine: Engine) -> SetupError {
    SetupError::Without { engine, what: "index", others: those(|about| about.index.is_some()) }
}

/// Whether an engine that takes this placement and this k takes both together: at centers there are subgoal graphs, clusters and segments for
/// the smallest k alone.
fn takes_both(engine: Engine, k: K, rules: Rules) -> bool {
    match (rules, k) {
        _ if !matches!(engine, Engine::Subgoal | Engine::Hpa | Engine::Chpa) => true,
        (Rules::Corner(_), _) | (_, K::Finite(FiniteK::N4)) => true,
        (Rules::Center(corners), K::Finite(FiniteK::N8)) => corners == CornerRule::Never,
        (Rules::Center(_), _) => false,
    }
}

/// The names of the engines of which something holds.
pub(crate) fn those(has: impl Fn(About) -> bool) -> String {
    let names: Vec<&str> =
        Engine::ALL.into_iter().filter(|engine| has(engine.about())).map(Engine::name).collect();
    names.join(", ")
}
