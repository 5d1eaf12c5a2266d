//! All that makes a planner, and whether it can.

use std::num::NonZeroU32;

use mediant_grid::{CornerRule, Rules};
use mediant_moves::{K, Knob};
use mediant_search::{Guarantee, Smoothing};
use mediant_subgoal::Hierarchy;

use crate::{About, Engine, HeuristicName, Levels, SetupError, Variant};

/// An engine, what it searches, and how.
///
/// As text `ENGINE[:K[:RULE]][,OPTION…]`: K is a number or `any`, RULE is `never`, `one` or `always` at centers, `open` or `closed` at
/// corners. Without them the problem is the scenarios' own, k = 3 at centers under `never`; at corners, which is where `any` and some engines
/// are, it is under `open`, and k is `any` for an engine of any-angle paths. The options are `euclidean`, `zero`, `paper`, `limit=N` (jumps
/// of at most N steps), `intermediate` (jump points that are otherwise passed by), `levels=N` or `levels=all` (of a subgoal graph), and
/// `smooth` or `taut` (the path made shorter afterwards).
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
    pub k: Knob,
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
    /// The levels of the subgoal graph; without them it has a contraction hierarchy, or 2 levels where the engine needs levels.
    pub levels: Option<Levels>,
    /// How the path is made shorter afterwards, if it is.
    pub smoothing: Option<Smoothing>,
}

/// What [`Setup::all`] has of smoothed engines: paths over few and over many directions.
const SMOOTHED: [(Engine, Smoothing); 5] = [
    (Engine::AStar, Smoothing::Linear),
    (Engine::AStar, Smoothing::Taut),
    (Engine::Theta, Smoothing::Taut),
    (Engine::Anya, Smoothing::Taut),
    (Engine::Subgoal, Smoothing::Taut),
];

/// Whether something holds of an engine.
type Has = fn(About) -> bool;

impl Setup {
    /// The engine with its default options.
    #[must_use]
    pub fn new(engine: Engine, k: impl Into<Knob>, rules: Rules) -> Self {
        Self { engine, k: k.into(), rules, options: Options::default() }
    }

    /// All that there are for these rules and this k: each engine with its default options, and with each other one of an option;
    /// smoothed, a few. Of a finite k the first is A* with h_k; any-angle search between centers there is none.
    pub fn all(k: impl Into<Knob>, rules: Rules) -> impl Iterator<Item = Self> {
        let (k, options) = (k.into(), Options::default());
        let others = [
            options,
            Options { heuristic: Some(HeuristicName::Euclidean), ..options },
            Options { heuristic: Some(HeuristicName::Zero), ..options },
            Options { variant: Some(Variant::Paper), ..options },
            Options { jump_limit: NonZeroU32::new(2), ..options },
            Options { intermediate: true, ..options },
            Options { levels: NonZeroU32::new(1).map(Levels::Number), ..options },
            Options { levels: NonZeroU32::new(2).map(Levels::Number), ..options },
            Options { levels: Some(Levels::All), ..options },
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
        let takes: [(bool, Has, &str); 5] = [
            (options.heuristic.is_some(), |about| about.heuristic, "heuristic"),
            (options.variant.is_some(), |about| about.variant, "variant"),
            (options.jump_limit.is_some(), |about| about.jump_limit, "jump limit"),
            (options.intermediate, |about| about.intermediate, "intermediate jump points"),
            (options.levels.is_some(), |about| about.levels, "levels"),
        ];
        if let Some(&(_, has, option)) = takes.iter().find(|(given, has, _)| *given && !has(about)) {
            return Err(SetupError::Option { engine, option, others: those(has) });
        }
        match (k, about.max_k) {
            (Knob::K(k), Some(max)) if k.get() > max => return Err(SetupError::K { engine, max, k }),
            (Knob::K(k), None) => return Err(SetupError::NeedsAny { engine, k }),
            (Knob::Any, Some(max)) if !about.any => {
                return Err(SetupError::NeedsFiniteK { engine, max, others: those(|about| about.any) });
            }
            _ => {}
        }
        let placement = rules.placement();
        match about.placements {
            [needed] if *needed != placement => {
                let others = those(|about| about.placements.contains(&placement));
                Err(SetupError::Placement { engine, needed: *needed, placement, others })
            }
            _ if engine == Engine::Subgoal && !has_subgoals(k, rules) => {
                Err(SetupError::Centers { engine, k, rules })
            }
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

    /// The heuristic that guides the search; none of these where the search has one of its own, at any angle or on a subgoal graph.
    #[must_use]
    pub fn heuristic(&self) -> Option<HeuristicName> {
        let about = self.engine.about();
        let default = if about.heuristic { HeuristicName::Hk } else { HeuristicName::Zero };
        self.k.finite().filter(|_| !about.levels).map(|_| self.options.heuristic.unwrap_or(default))
    }

    /// The hierarchy of the subgoal graph, of an engine that searches one.
    #[must_use]
    pub fn hierarchy(&self) -> Option<Hierarchy> {
        let chosen = self.options.levels.map(Hierarchy::from);
        match self.engine {
            Engine::Subgoal => Some(chosen.unwrap_or_default()),
            Engine::SubgoalTheta => chosen.or(NonZeroU32::new(2).map(Hierarchy::Levels)),
            _ => None,
        }
    }

    /// The variant, of an engine that has several.
    #[must_use]
    pub fn variant(&self) -> Option<Variant> {
        self.engine.about().variant.then(|| self.options.variant.unwrap_or_default())
    }

    /// What the planner will promise.
    #[must_use]
    pub fn guarantee(&self) -> Guarantee {
        let plain = match (self.engine, self.k) {
            (Engine::Theta | Engine::LazyTheta | Engine::SubgoalTheta, _) => Guarantee::Suboptimal,
            (Engine::Wavefront, k) if k != Knob::K(K::FOUR_CONNECTED) => Guarantee::Suboptimal,
            _ if self.variant() == Some(Variant::Paper) => Guarantee::Suboptimal,
            (Engine::Anya, _) | (_, Knob::Any) => Guarantee::OptimalAnyAngle,
            (_, Knob::K(k)) => Guarantee::Optimal(k),
        };
        match plain {
            Guarantee::Optimal(k) if self.options.smoothing.is_some() => Guarantee::AtMost(k),
            plain => plain,
        }
    }

    /// The directions over which no path under its rules is shorter than its own; none where it does not promise that.
    #[must_use]
    pub fn optimal_over(&self) -> Option<Knob> {
        match self.guarantee() {
            Guarantee::Optimal(k) => Some(Knob::K(k)),
            Guarantee::OptimalAnyAngle => Some(Knob::Any),
            Guarantee::AtMost(_) | Guarantee::Suboptimal => None,
        }
    }

    /// The directions that its paths may take: those that it searches, or every one where it straightens what it finds.
    #[must_use]
    pub fn paths(&self) -> Knob {
        let straightens = matches!(self.engine, Engine::Theta | Engine::LazyTheta | Engine::SubgoalTheta);
        if straightens || self.options.smoothing.is_some() { Knob::Any } else { self.k }
    }

    /// Whether its paths are as long as the scenario files say: those are optimal for k = 3 at centers under `never`.
    #[must_use]
    pub fn solves_scenarios(&self) -> bool {
        self.rules == Rules::Center(CornerRule::Never)
            && self.optimal_over() == Some(Knob::K(K::EIGHT_CONNECTED))
    }
}

pub(crate) fn without_index(engine: Engine) -> SetupError {
    SetupError::Without { engine, what: "index", others: those(|about| about.index.is_some()) }
}

/// Whether there is a subgoal graph for these directions under these rules.
fn has_subgoals(k: Knob, rules: Rules) -> bool {
    match (rules, k) {
        (Rules::Corner(_), _) | (_, Knob::K(K::FOUR_CONNECTED)) => true,
        (Rules::Center(corners), Knob::K(K::EIGHT_CONNECTED)) => corners == CornerRule::Never,
        (Rules::Center(_), _) => false,
    }
}

/// The names of the engines of which something holds.
pub(crate) fn those(has: impl Fn(About) -> bool) -> String {
    let names: Vec<&str> =
        Engine::ALL.into_iter().filter(|engine| has(engine.about())).map(Engine::name).collect();
    names.join(", ")
}
