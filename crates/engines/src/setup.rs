//! All that makes a planner, and whether it can.

use std::num::NonZeroU32;

use mediant_grid::{CornerRule, Rules};
use mediant_moves::K;
use mediant_search::Guarantee;

use crate::{About, Engine, HeuristicName, SetupError, Variant};

/// An engine, what it searches, and how.
///
/// As text `ENGINE[:K[:RULE]][,OPTION…]`: RULE is `never`, `one` or `always` at centers, `open` or `closed` at corners; without it
/// the problem is the scenarios' own, k = 3 at centers under `never`. The options are `euclidean`, `zero`, `paper`,
/// `limit=N` (jumps of at most N steps) and `intermediate` (jump points that are otherwise passed by).
///
/// ```
/// use mediant_engines::Setup;
/// let setup: Setup = "astar:5:open,euclidean".parse()?;
/// assert_eq!((setup.k.get(), setup.to_string().as_str()), (5, "astar:5:open,euclidean"));
/// assert!(!setup.solves_scenarios() && "astar".parse::<Setup>()?.solves_scenarios());
/// # Ok::<(), mediant_engines::TextError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Setup {
    /// The engine.
    pub engine: Engine,
    /// The neighborhood.
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
}

/// Whether something holds of an engine.
type Has = fn(About) -> bool;

impl Setup {
    /// The engine with its default options.
    #[must_use]
    pub const fn new(engine: Engine, k: K, rules: Rules) -> Self {
        let options = Options { heuristic: None, variant: None, jump_limit: None, intermediate: false };
        Self { engine, k, rules, options }
    }

    /// All that there are for these rules and this k: each engine with its default options, and with each other one of an option. The
    /// first is A* with h_k.
    pub fn all(k: K, rules: Rules) -> impl Iterator<Item = Self> {
        let options = Options::default();
        let others = [
            options,
            Options { heuristic: Some(HeuristicName::Euclidean), ..options },
            Options { heuristic: Some(HeuristicName::Zero), ..options },
            Options { variant: Some(Variant::Paper), ..options },
            Options { jump_limit: NonZeroU32::new(2), ..options },
            Options { intermediate: true, ..options },
        ];
        let setups = Engine::ALL
            .into_iter()
            .flat_map(move |engine| others.map(|options| Self { options, ..Self::new(engine, k, rules) }));
        setups.filter(|setup| setup.check().is_ok())
    }

    /// Whether the engine takes all this.
    ///
    /// # Errors
    /// [`SetupError`] for the first thing that it does not take.
    pub fn check(&self) -> Result<(), SetupError> {
        let Self { engine, k, options, .. } = *self;
        let about = engine.about();
        let takes: [(bool, Has, &str); 4] = [
            (options.heuristic.is_some(), |about| about.heuristic, "heuristic"),
            (options.variant.is_some(), |about| about.variant, "variant"),
            (options.jump_limit.is_some(), |about| about.jump_limit, "jump limit"),
            (options.intermediate, |about| about.intermediate, "intermediate jump points"),
        ];
        if let Some(&(_, has, option)) = takes.iter().find(|(given, has, _)| *given && !has(about)) {
            return Err(SetupError::Option { engine, option, others: those(has) });
        }
        if k.get() > about.max_k {
            return Err(SetupError::K { engine, max: about.max_k, k: k.get() });
        }
        Ok(())
    }

    /// The version of the index that the engine makes.
    ///
    /// # Errors
    /// [`SetupError::Without`] for an engine whose preprocessing is not saved.
    pub fn index_version(&self) -> Result<u32, SetupError> {
        self.engine.about().index.ok_or_else(|| without_index(self.engine))
    }

    /// The heuristic that guides the search.
    #[must_use]
    pub fn heuristic(&self) -> HeuristicName {
        let default = if self.engine.about().heuristic { HeuristicName::Hk } else { HeuristicName::Zero };
        self.options.heuristic.unwrap_or(default)
    }

    /// The variant, of an engine that has several.
    #[must_use]
    pub fn variant(&self) -> Option<Variant> {
        self.engine.about().variant.then(|| self.options.variant.unwrap_or_default())
    }

    /// What the planner will promise.
    #[must_use]
    pub fn guarantee(&self) -> Guarantee {
        let exact = match self.engine {
            Engine::Wavefront => self.k == K::FOUR_CONNECTED,
            _ => self.variant() != Some(Variant::Paper),
        };
        if exact { Guarantee::Optimal(self.k) } else { Guarantee::Suboptimal }
    }

    /// Whether its paths are as long as the scenario files say: those are optimal for k = 3 at centers under `never`.
    #[must_use]
    pub fn solves_scenarios(&self) -> bool {
        self.rules == Rules::Center(CornerRule::Never)
            && self.guarantee() == Guarantee::Optimal(K::EIGHT_CONNECTED)
    }
}

pub(crate) fn without_index(engine: Engine) -> SetupError {
    SetupError::Without { engine, what: "index", others: those(|about| about.index.is_some()) }
}

/// The names of the engines of which something holds.
pub(crate) fn those(has: impl Fn(About) -> bool) -> String {
    let names: Vec<&str> =
        Engine::ALL.into_iter().filter(|engine| has(engine.about())).map(Engine::name).collect();
    names.join(", ")
}
