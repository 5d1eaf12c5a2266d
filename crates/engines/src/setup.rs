//! All that makes a planner, and whether it can.

use std::num::NonZeroU32;

use mediant_grid::{CornerRule, PlacementKind, Rules};
use mediant_moves::{FiniteK, K};
use mediant_search::{Guarantee, Smoothing};

use crate::{
    Engine, EngineKind, EngineOption, HeuristicName, HpaOptions, Levels, SetupError, Variant,
    engine::Capabilities,
};

/// An engine with its options, the k and the rules of motion that it searches under, and how its paths are smoothed.
///
/// As text `ENGINE[:K[:RULE]][,OPTION…]`: K is a number or `any`, RULE is `never`, `one` or `always` at centers, `open` or
/// `closed` at corners. Left out, K and RULE are those of the scenario files, k = 3 at centers under `never`; for an engine
/// that takes only corners, and for k = `any`, RULE is `open`; for an engine of any-angle paths K is `any`. The options are
/// `euclidean`, `zero`, `squared`, `exact`, `complete`, `paper`, `limit=N` (jumps of at most N steps), `intermediate` (keep intermediate
/// jump points), `levels=N` or `levels=all` (of a subgoal graph, or of clusters), `side=N` (of a cluster or segment, in
/// cells), `unstraightened` (paths through clusters, not straightened), `second=NAME` (the heuristic of a second phase),
/// `step=N` (a checkpoint every N segments), `detour=N` (how many times h_k the way to one may cost), and `smooth` or `taut`
/// (how the path is smoothed).
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
    /// The engine and its options.
    pub engine: Engine,
    /// The neighborhood that it searches.
    pub k: K,
    /// The placement and its rule of motion.
    pub rules: Rules,
    /// How the paths are smoothed, if they are.
    pub smoothing: Option<Smoothing>,
}

/// What [`Setup::all`] has of smoothed engines: paths over few and over many directions.
const SMOOTHED: [(EngineKind, Smoothing); 7] = [
    (EngineKind::AStar, Smoothing::Linear),
    (EngineKind::AStar, Smoothing::Taut),
    (EngineKind::Theta, Smoothing::Taut),
    (EngineKind::Anya, Smoothing::Taut),
    (EngineKind::Subgoal, Smoothing::Taut),
    (EngineKind::Hpa, Smoothing::Taut),
    (EngineKind::Chpa, Smoothing::Linear),
];

impl Setup {
    /// An engine on a neighborhood, without smoothing.
    #[must_use]
    pub fn new(engine: impl Into<Engine>, k: impl Into<K>, rules: Rules) -> Self {
        Self { engine: engine.into(), k: k.into(), rules, smoothing: None }
    }

    /// All setups for these rules and this k that the suites try: each engine with its default options and with each other
    /// value of an option, and a few with smoothing. For a finite k the first is A* with h_k; for k = ∞ at centers there is none.
    pub fn all(k: impl Into<K>, rules: Rules) -> impl Iterator<Item = Self> {
        let k = k.into();
        let engines =
            EngineKind::ALL.into_iter().flat_map(samples).map(move |engine| Self::new(engine, k, rules));
        let smoothed = SMOOTHED.into_iter().map(move |(engine, smoothing)| Self {
            smoothing: Some(smoothing),
            ..Self::new(engine, k, rules)
        });
        engines.chain(smoothed).filter(|setup| setup.check().is_ok())
    }

    /// What the engine can do.
    #[must_use]
    pub const fn capabilities(&self) -> Capabilities {
        self.engine.kind().capabilities()
    }

    /// Whether the engine takes all this.
    ///
    /// # Errors
    /// [`SetupError`] for the first thing that it does not take.
    pub fn check(&self) -> Result<(), SetupError> {
        self.engine.check()?;
        let (engine, k, rules) = (self.engine.kind(), self.k, self.rules);
        let capabilities = self.capabilities();
        match (k, capabilities.max_k) {
            (K::Finite(k), Some(max)) if k.get() > max => return Err(SetupError::K { engine, max, k }),
            (K::Finite(k), None) => return Err(SetupError::NeedsAny { engine, k }),
            (K::Any, Some(max)) if !capabilities.any => {
                let others = EngineKind::names_of(|kind| kind.capabilities().any);
                return Err(SetupError::NeedsFiniteK { engine, max, others });
            }
            _ => {}
        }
        let placement = rules.placement();
        match capabilities.placements {
            [needed] if *needed != placement => {
                let others = EngineKind::names_of(|kind| kind.capabilities().placements.contains(&placement));
                Err(SetupError::Placement { engine, needed: *needed, placement, others })
            }
            _ if !takes_together(engine, k, rules) => Err(SetupError::Centers { engine, k, rules }),
            _ => Ok(()),
        }
    }

    /// The version of the index that the engine makes.
    ///
    /// # Errors
    /// [`SetupError::Without`] for an engine whose index is not saved.
    pub fn index_version(&self) -> Result<u32, SetupError> {
        self.capabilities().index.ok_or_else(|| without_index(self.engine.kind()))
    }

    /// The guarantee of the planner.
    #[must_use]
    pub fn guarantee(&self) -> Guarantee {
        use EngineKind::{Anya, Chpa, Hpa, LazyTheta, SubgoalTheta, Theta, Wavefront};
        let unsmoothed = match (self.engine.kind(), self.k) {
            (Theta | LazyTheta | SubgoalTheta | Hpa | Chpa, _) => Guarantee::Suboptimal,
            _ if self.engine.heuristic() == Some(HeuristicName::SquaredEuclidean) => Guarantee::Suboptimal,
            (Wavefront, k) if k != K::N4 => Guarantee::Suboptimal,
            _ if self.engine.variant() == Some(Variant::Paper) => Guarantee::Suboptimal,
            (Anya, _) | (_, K::Any) => Guarantee::OptimalAnyAngle,
            (_, K::Finite(k)) => Guarantee::Optimal(k),
        };
        if self.smoothing.is_some() { unsmoothed.smoothed() } else { unsmoothed }
    }

    /// The neighborhood over which no path is shorter than its own; `None` where it does not promise that.
    #[must_use]
    pub fn optimal_over(&self) -> Option<K> {
        match self.guarantee() {
            Guarantee::Optimal(k) => Some(K::Finite(k)),
            Guarantee::OptimalAnyAngle => Some(K::Any),
            Guarantee::AtMost(_) | Guarantee::Suboptimal => None,
        }
    }

    /// The neighborhood that its paths are over: the one that it searches, or ∞ where it pulls paths straight.
    #[must_use]
    pub fn paths(&self) -> K {
        use EngineKind::{LazyTheta, SubgoalTheta, Theta};
        let is_straight = matches!(self.engine.kind(), Theta | LazyTheta | SubgoalTheta);
        if is_straight || self.smoothing.is_some() { K::Any } else { self.k }
    }

    /// Whether its paths are as long as the scenario files say: those are optimal for k = 3 at centers under `never`.
    #[must_use]
    pub fn solves_scenarios(&self) -> bool {
        self.rules == Rules::Center(CornerRule::Never) && self.optimal_over() == Some(K::N8)
    }
}

/// An engine with its default options, and with each other value of an option that the suites try.
fn samples(kind: EngineKind) -> Vec<Engine> {
    let mut engines = vec![Engine::from(kind)];
    for option in EngineOption::ALL {
        for value in option.samples() {
            let mut engine = Engine::from(kind);
            if engine.set(option, value).is_ok() {
                engines.push(engine);
            }
        }
    }
    if kind == EngineKind::Hpa {
        // Small clusters, so that small maps have several on each level.
        let (side, levels) = (NonZeroU32::new(3), NonZeroU32::new(3).map(Levels::Number));
        engines.push(Engine::Hpa(HpaOptions { side, levels, unstraightened: false }));
    }
    engines
}

pub(crate) fn without_index(engine: EngineKind) -> SetupError {
    let others = EngineKind::names_of(|kind| kind.capabilities().index.is_some());
    SetupError::Without { engine, what: "index", others }
}

/// Whether an engine that takes this placement and this k takes both together: at centers there are subgoal graphs,
/// clusters and segments for the smallest k only.
fn takes_together(engine: EngineKind, k: K, rules: Rules) -> bool {
    if !matches!(engine, EngineKind::Subgoal | EngineKind::Hpa | EngineKind::Chpa) {
        return true;
    }
    match (rules.placement(), k) {
        (PlacementKind::Corner, _) | (_, K::Finite(FiniteK::N4)) => true,
        (PlacementKind::Center, K::Finite(FiniteK::N8)) => rules == Rules::Center(CornerRule::Never),
        (PlacementKind::Center, _) => false,
    }
}
