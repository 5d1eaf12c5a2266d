//! Setups: an engine with all that a planner needs besides a map.

use mediant_grid::{CornerRule, PlacementKind, Rules};
use mediant_moves::{FiniteK, K};
use mediant_search::{Guarantee, Smoothing};

#[cfg(feature = "publications")]
use crate::option::Variant;
use crate::{
    capabilities::{Capabilities, Promise},
    configured::ConfiguredEngine,
    engine::Engine,
    motion::Motion,
    option::{HeuristicName, if_published},
    setup_error::SetupError,
};

/// An engine with its options, the motion that it searches, and how its paths are smoothed.
///
/// As text `ENGINE[:K[:RULE]][,OPTION…]`:
/// - K is a number or `any`. Left out, it is 3, or `any` for Anya.
/// - RULE is `never`, `one` or `always` at centers, `open` or `closed` at corners, and `center-open` or
///   `center-closed` for K = `any` between centers. Left out, it is `never`, or `open` for K = `any` and for
///   an engine that takes only corners. So `astar` solves the scenario files' own problem.
/// - An OPTION is one of the engine's ([`EngineOption::ALL`](crate::options::EngineOption::ALL)), or `smooth`
///   or `taut`: paths are smoothed by [`Smoothing::Linear`] or by [`Smoothing::Taut`].
///
/// ```
/// use mediant::Setup;
/// let setup: Setup = "astar:5:open,euclidean".parse()?;
/// assert_eq!(setup.to_string(), "astar:5:open,euclidean");
/// assert_eq!("anya".parse::<Setup>()?.to_string(), "anya:any:open");
/// assert!(!setup.solves_scenarios() && "astar".parse::<Setup>()?.solves_scenarios());
/// # Ok::<(), mediant::errors::TextError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Setup {
    /// The engine and its options.
    pub engine: ConfiguredEngine,
    /// The neighborhood that it searches over, and the rules of motion.
    pub motion: Motion,
    /// How its paths are smoothed; `None` if they are not.
    pub smoothing: Option<Smoothing>,
}

impl Setup {
    /// A setup without smoothing. Whether its parts fit together, [`check`](Self::check) says.
    #[must_use]
    pub fn new(engine: impl Into<ConfiguredEngine>, motion: impl Into<Motion>) -> Self {
        Self { engine: engine.into(), motion: motion.into(), smoothing: None }
    }

    /// The neighborhood that it searches over.
    #[must_use]
    pub const fn k(&self) -> K {
        self.motion.k
    }

    /// The placement and its rule of motion.
    #[must_use]
    pub const fn rules(&self) -> Rules {
        self.motion.rules
    }

    /// The finite k of a search on a grid graph.
    pub(crate) fn finite_k(&self) -> Result<FiniteK, SetupError> {
        self.k().finite().ok_or_else(|| self.needs_finite_k())
    }

    fn needs_finite_k(&self) -> SetupError {
        let max = self.capabilities().max_k;
        let others = Engine::names_where(|engine| engine.capabilities().any);
        SetupError::NeedsFiniteK { engine: self.engine.kind(), max, others }
    }

    /// The capabilities of the engine.
    #[must_use]
    pub const fn capabilities(&self) -> Capabilities {
        self.engine.kind().capabilities()
    }

    /// Checks that the engine takes its options, the k and the rules.
    ///
    /// # Errors
    /// [`SetupError`] for the first of them that it does not take.
    pub fn check(&self) -> Result<(), SetupError> {
        if !self.engine.kind().is_built() {
            return Err(SetupError::NotBuilt { engine: self.engine.kind() });
        }
        self.engine.check()?;
        let (engine, k, rules) = (self.engine.kind(), self.k(), self.rules());
        let capabilities = self.capabilities();
        let max = capabilities.max_k;
        match k {
            K::Finite(k) if k.get() > max => return Err(SetupError::K { engine, max, k }),
            K::Any if !capabilities.any => return Err(self.needs_finite_k()),
            _ => {}
        }
        self.motion.check_searched()?;
        // Paths at any angle between centers are searched between corners.
        let placement = if rules.gap().is_some() { PlacementKind::Corner } else { rules.placement() };
        match capabilities.placements {
            [needed] if *needed != placement => Err(SetupError::placement(engine, *needed, placement)),
            _ if capabilities.few_k_at_centers && !is_few_k_at_centers(self.motion) => {
                Err(SetupError::Centers { engine, k, rules })
            }
            _ => Ok(()),
        }
    }

    /// The version of the engine's saved index.
    ///
    /// # Errors
    /// [`SetupError::Without`] for an engine whose index is not saved.
    pub fn index_version(&self) -> Result<u32, SetupError> {
        self.engine.kind().index_version()
    }

    /// The guarantee of the planner's paths where no cell has a cost of its own;
    /// [`Planner::guarantee`](crate::Planner::guarantee) is right there, too.
    #[must_use]
    pub fn guarantee(&self) -> Guarantee {
        let unsmoothed = match (self.capabilities().guarantee, self.k()) {
            (Promise::Suboptimal, _) => Guarantee::Suboptimal,
            _ if self.engine.heuristic().is_some_and(HeuristicName::overestimates) => Guarantee::Suboptimal,
            _ if if_published!(self.engine.variant() == Some(Variant::Paper), else false) => {
                Guarantee::Suboptimal
            }
            (Promise::FewestMoves, k) if k != K::N4 => Guarantee::Suboptimal,
            (Promise::Optimal | Promise::FewestMoves, K::Any) => Guarantee::OptimalAnyAngle,
            (Promise::Optimal | Promise::FewestMoves, K::Finite(k)) => Guarantee::Optimal(k),
        };
        if self.smoothing.is_some() { unsmoothed.smoothed() } else { unsmoothed }
    }

    /// The k over which its paths are optimal; `None` if they need not be optimal.
    #[must_use]
    pub fn optimal_over(&self) -> Option<K> {
        match self.guarantee() {
            Guarantee::Optimal(k) | Guarantee::Cheapest(k) => Some(K::Finite(k)),
            Guarantee::OptimalAnyAngle => Some(K::Any),
            Guarantee::AtMost(_) | Guarantee::AtMostCheapest(_) | Guarantee::Suboptimal => None,
        }
    }

    /// The k over which its paths are: that of the search, or ∞ if the engine or the smoothing leaves N(k).
    #[must_use]
    pub fn paths(&self) -> K {
        if self.capabilities().any_angle || self.smoothing.is_some() { K::Any } else { self.k() }
    }

    /// Whether its paths are as long as the scenario files say: optimal for k = 3 at centers under `never`.
    #[must_use]
    pub fn solves_scenarios(&self) -> bool {
        self.rules() == Rules::Center(CornerRule::Never) && self.optimal_over() == Some(K::N8)
    }
}

/// Whether k and rules are among those of an engine with few k at centers.
fn is_few_k_at_centers(motion: Motion) -> bool {
    match (motion.rules, motion.k) {
        (Rules::Corner(_) | Rules::CenterGap(_), _) | (_, K::Finite(FiniteK::N4)) => true,
        (Rules::Center(rule), K::Finite(FiniteK::N8)) => rule == CornerRule::Never,
        (Rules::Center(_), _) => false,
    }
}
